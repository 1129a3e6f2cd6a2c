#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "replay/picture/barcode_sheet.hpp"
#include "replay/picture/svg.hpp"
#include "tools/bench/plot.hpp"
#include "tools/bench/report.hpp"
#include "tools/bench/scaling.hpp"

namespace sesame::tools {
namespace {

using replay::xml_escaped;

constexpr std::string_view page_style = R"(:root{color-scheme:light dark}
body{margin:2rem auto;max-width:1240px;padding:0 1rem;font:15px/1.5 system-ui,"Segoe UI",Roboto,sans-serif;
background:#fff;color:#222}
h1{font-size:1.5rem;margin:0 0 .3rem}h2{font-size:1.15rem;margin:2.2rem 0 .5rem}
.facts,.note{color:#5f6368}.wide{overflow-x:auto}.plots{display:flex;flex-wrap:wrap;gap:1.5rem 2rem;margin-top:1.2rem}
svg{display:block;max-width:100%;height:auto}
table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums;white-space:nowrap}
th,td{padding:.15rem .7rem .15rem 0;text-align:right;border-bottom:1px solid #e3e5e8}
th:first-child,td:first-child,th:nth-child(3),td:nth-child(3),.runs th:last-child,.runs td:last-child{text-align:left}
.runs td:last-child{white-space:normal}
@media (prefers-color-scheme:dark){body{background:#16181b;color:#e8e8e8}.facts,.note{color:#a8adb3}
th,td{border-color:#33373c}
)";

std::string row(const std::vector<std::string>& cells, std::string_view tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) {
    text += fmt::format("<{0}>{1}</{0}>", tag, xml_escaped(cell));
  }
  return text + "</tr>\n";
}

std::string measurement_row(const Measurement& m) {
  const auto time = [](double seconds) { return seconds > 0 ? short_time(seconds) : "\u2013"; };
  const auto bytes = [](std::uint64_t n) { return n > 0 ? short_bytes(n) : "\u2013"; };
  const bool is_measured = m.verdict == Verdict::right || m.verdict == Verdict::cut || m.verdict == Verdict::wrong;
  if (!is_measured) {
    return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td colspan=\"13\">{}: {}</td></tr>\n",
                       xml_escaped(m.scenario), m.size, xml_escaped(m.method), verdict_name(m.verdict),
                       xml_escaped(m.remark));
  }
  std::string remark =
      m.verdict == Verdict::right ? m.remark : fmt::format("{}: {}", verdict_name(m.verdict), m.remark);
  if (const std::string text = disturbance(m); !text.empty()) {
    remark += (remark.empty() ? "" : "; ") + text;
  }
  return row({m.scenario, std::to_string(m.size), m.method, replay::with_separators(m.steps), time(m.seconds.median),
              time(m.seconds.max - m.seconds.min), time(m.step.mean / 1e6), time(m.step.p50 / 1e6),
              time(m.step.p99 / 1e6), time(m.step.max / 1e6), bytes(m.memory.resident), bytes(m.memory.heap),
              per_step(m, true), per_step(m, false), checked_text(m), remark},
             "td");
}

std::string measurement_table(const std::vector<const Measurement*>& measurements) {
  std::string text = "<div class=\"wide\"><table class=\"runs\">\n" +
                     row({"scenario", "size", "method", "steps", "median", "spread", "mean", "p50", "p99", "max",
                          "resident", "heap", "alloc./step", "touched/step", "checked", "remarks"},
                         "th");
  for (const Measurement* m : measurements) {
    text += measurement_row(*m);
  }
  return text + "</table></div>\n";
}

/// The latency of the steps in the course of one scenario, a pair of curves a method.
std::string timeline(const std::vector<const Measurement*>& measurements) {
  std::vector<Curve> curves;
  int colour = 0;
  for (const Measurement* m : measurements) {
    if (m->timeline.empty()) {
      continue;
    }
    Curve means{m->method, {}, false, false, colour}, worst{"", {}, false, true, colour};
    for (const TimelinePoint& point : m->timeline) {
      means.points.push_back({static_cast<double>(point.last_step), point.mean});
      worst.points.push_back({static_cast<double>(point.last_step), point.max});
    }
    curves.push_back(std::move(worst));
    curves.push_back(std::move(means));
    ++colour;
  }
  if (curves.empty()) {
    return "";
  }
  const Measurement& any = *measurements.front();
  const std::string title = fmt::format("{}, size {}", any.scenario, any.size);
  return plot({title, "step", "microseconds", false, 370, 230}, curves);
}

/// Calls visit(name, list) for each run of measurements with the same `member`.
template <class Visit>
void for_each_group(const std::vector<const Measurement*>& measurements, std::string Measurement::*member,
                    Visit visit) {
  for (std::size_t begin = 0; begin < measurements.size();) {
    std::size_t end = begin;
    while (end < measurements.size() && measurements[end]->*member == measurements[begin]->*member) {
      ++end;
    }
    visit(measurements[begin]->*member,
          std::vector<const Measurement*>(measurements.begin() + static_cast<std::ptrdiff_t>(begin),
                                          measurements.begin() + static_cast<std::ptrdiff_t>(end)));
    begin = end;
  }
}

void write_measurements(std::ostream& out, const Report& report) {
  std::vector<const Measurement*> all;
  for (const Measurement& m : report.measurements) {
    all.push_back(&m);
  }
  for_each_group(all, &Measurement::family, [&](const std::string& family, const auto& of_family) {
    out << "<h2>" << xml_escaped(family) << "</h2>\n" << measurement_table(of_family) << "<div class=\"plots\">\n";
    for_each_group(of_family, &Measurement::scenario,
                   [&](const std::string&, const auto& of_scenario) { out << timeline(of_scenario); });
    out << "</div>\n";
  });
}

struct ScalingPlot {
  PlotFrame frame;
  std::vector<Curve> curves;
};

/// The points of an experiment and the fitted power law, all methods together.
ScalingPlot scaling_plot(const std::vector<const Scaling*>& scalings) {
  std::vector<Curve> times, fits;
  int colour = 0;
  for (const Scaling* scaling : scalings) {
    const std::optional<PowerLaw> law = fit_times(*scaling, &Latency::mean);
    Curve curve{fmt::format("{}: exponent {}", scaling->method, exponent_text(law)), {}, true, false, colour};
    for (const ScalingPoint& point : scaling->points) {
      curve.points.push_back({static_cast<double>(point.x), point.step.mean});
    }
    if (law) {
      Curve fitted{"", {}, false, true, colour};
      for (const Sighting& end : {curve.points.front(), curve.points.back()}) {
        fitted.points.push_back({end.x, law->factor * std::pow(end.x, law->exponent)});
      }
      fits.push_back(std::move(fitted));
    }
    times.push_back(std::move(curve));
    ++colour;
  }
  times.insert(times.end(), fits.begin(), fits.end());
  const Scaling& any = *scalings.front();
  return {{fmt::format("{} (theory: exponent {:g})", any.experiment, any.expected), any.x_name,
           "microseconds a step, on average", true, 540, 300},
          std::move(times)};
}

/// A plot for each experiment, in their order.
std::vector<ScalingPlot> scaling_plots(const Report& report) {
  std::vector<ScalingPlot> plots;
  for (std::size_t begin = 0; begin < report.scalings.size();) {
    std::vector<const Scaling*> group;
    const std::string& name = report.scalings[begin].experiment;
    for (; begin < report.scalings.size() && report.scalings[begin].experiment == name; ++begin) {
      group.push_back(&report.scalings[begin]);
    }
    plots.push_back(scaling_plot(group));
  }
  return plots;
}

/// Where, when and of what.
std::vector<std::string> facts(const Report& report) {
  const Machine& machine = report.machine;
  const Build& build = report.build;
  return {fmt::format("sesame {} at {}", build.version, build.commit),
          fmt::format("{} {}", build.compiler, build.flags),
          fmt::format("{}, {} cores, {}", machine.cpu, machine.cores, short_bytes(machine.memory_bytes)),
          machine.system, report.date};
}

void write_scalings(std::ostream& out, const Report& report) {
  if (report.scalings.empty()) {
    return;
  }
  out << "<h2>Scaling</h2>\n<div class=\"wide\"><table>\n"
      << row({"experiment", "up to", "method", "mean", "p50", "p99", "max", "exponent of the mean", "of p50",
              "of what is touched", "theory"},
             "th");
  for (const Scaling& scaling : report.scalings) {
    const auto [largest, step, touched] = scaling.points.empty() ? ScalingPoint{} : scaling.points.back();
    const auto time = [](double us) { return short_time(us / 1e6); };
    out << row({scaling.experiment, replay::with_separators(largest) + " " + scaling.x_name, scaling.method,
                time(step.mean), time(step.p50), time(step.p99), time(step.max),
                exponent_text(fit_times(scaling, &Latency::mean)), exponent_text(fit_times(scaling, &Latency::p50)),
                exponent_text(fit_counts(scaling)), fmt::format("{:g}", scaling.expected)},
               "td");
  }
  out << "</table></div>\n<div class=\"plots\">\n";
  for (const ScalingPlot& scaling : scaling_plots(report)) {
    out << plot(scaling.frame, scaling.curves);
  }
  out << "</div>\n";
}

}  // namespace

void write_page(std::ostream& out, const Report& report) {
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      << "<title>sesame bench</title>\n<style>\n"
      << replay::svg_style(false) << page_style << replay::svg_style(true)
      << "}\n</style>\n</head>\n<body>\n<h1>sesame bench</h1>\n<p class=\"facts\">"
      << xml_escaped(fmt::format("{}", fmt::join(facts(report), " \u00B7 ")))
      << "</p>\n<p class=\"note\">Times are medians over runs, each in a process of its own; the spread is that of the "
         "slowest and the quickest run. In the pictures of latency, full lines are means and dashed lines the slowest "
         "steps, each over a 240th of the run.</p>\n";
  write_scalings(out, report);
  write_measurements(out, report);
  out << "</body>\n</html>\n";
}

void write_figure(std::ostream& out, const Report& report) {
  constexpr std::size_t columns = 2;
  constexpr double gap = 30;
  const std::string title = "Time per step";
  std::vector<replay::PlacedPanel> placed;
  double width = 0, y = 0, height = 0;  // of the figure; the top of the present row, and how high it is
  for (const ScalingPlot& scaling : scaling_plots(report)) {
    replay::Panel panel = plot_panel(scaling.frame, scaling.curves);
    const auto column = static_cast<double>(placed.size() % columns);
    if (column == 0) {
      y += std::exchange(height, 0) + (placed.empty() ? 0 : gap);
    }
    height = std::max(height, panel.height);
    placed.push_back({column * (panel.width + gap), y, std::move(panel)});
    width = std::max(width, placed.back().x + placed.back().panel.width);
  }
  replay::SheetHead head(width);
  head.title(title).facts(facts(report));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" << sheet(head.panel(), placed, title, replay::svg_style(false));
}

}  // namespace sesame::tools
