#include "replay/page/tower_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <span>

#include "ops/vocabulary/json_text.hpp"
#include "replay/page/page_bars.hpp"
#include "replay/page/page_file.hpp"
#include "replay/picture/barcode_summary.hpp"
#include "replay/picture/svg.hpp"
#include "replay/text/text_buffer.hpp"
#include "sesame/version.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using ops::JsonText;
using TracedBar = engine::BarCycles::TracedBar;

/// JavaScript has doubles only.
void write_label(std::uint64_t label, JsonText& out) {
  constexpr std::uint64_t largest_exact = std::uint64_t{1} << 53U;
  if (label > largest_exact) {
    out.value(std::to_string(label));
  } else {
    out.value(label);
  }
}

template <class Labels>
void write_labels(const Labels& labels, JsonText& out) {
  out.begin_list();
  for (const std::uint64_t label : labels) {
    write_label(label, out);
  }
  out.end_list();
}

/// A bar whose chains go into the page.
struct Chosen {
  TracedBar traced;
  std::uint64_t number;    ///< of the bar
  std::uint64_t rank = 0;  ///< among those of its dimension, the longest first
};

/// Which bars have chains, and how many terms these took.
class ClassWriter {
 public:
  ClassWriter(const TowerClasses& classes, const TowerPageLimits& limits) : classes_{classes}, limits_{limits} {}

  /// Adds a list. Returns how many bars it has.
  std::uint64_t write(std::span<const Chosen> bars, JsonText& out) {
    out.begin_list();
    std::uint64_t written = 0;
    for (const Chosen& chosen : bars) {
      const bool is_full = !classes_.wanted && (written == limits_.bars || terms_ >= limits_.terms);
      if (is_full || (classes_.stop != nullptr && classes_.stop->load())) {
        break;
      }
      write_bar(chosen, out);
      ++written;
    }
    out.end_list();
    return written;
  }

 private:
  void write_bar(const Chosen& chosen, JsonText& out) {
    const TracedBar& traced = chosen.traced;
    const bool is_open = traced.bar.death == engine::never;
    out.begin_object();
    out.field("bar", chosen.number);
    write_operation("born", traced.born_by, classes_.chains.moment_of_birth(traced), out);
    if (!is_open) {
      write_operation("killed", traced.killed_by, classes_.chains.moment_of_death(traced), out);
    }
    const BarChains chains = classes_.chains.chains(traced);
    write_chain("cycle", chains.cycle, out);
    write_chain(is_open ? "now" : "bounds", chains.second, out);
    out.end_object();
  }

  /// `moment`: the last operation at the same time.
  void write_operation(std::string_view name, std::uint64_t operation, std::uint64_t moment, JsonText& out) const {
    out.key(name);
    out.begin_object();
    out.field("line", classes_.operations.line(operation));
    out.field("text", classes_.operations.text(operation));
    out.field("after", moment + 1);
    out.end_object();
  }

  void write_chain(std::string_view name, const TowerHistory::NamedChain& chain, JsonText& out) {
    const std::uint64_t most = classes_.wanted ? classes_.wanted->most_terms : limits_.terms_of_chain;
    if (chain.terms.size() > most) {
      out.field(fmt::format("{}_terms", name), chain.terms.size());
      return;
    }
    terms_ += chain.terms.size();
    out.key(name);
    out.begin_list();
    for (const auto& [coefficient, labels] : chain.terms) {
      out.begin_list();
      if (const auto word = coefficient.to_int64()) {
        out.value(*word);
      } else {
        out.value(coefficient.to_string());
      }
      write_labels(labels, out);
      out.end_list();
    }
    out.end_list();
  }

  const TowerClasses& classes_;
  const TowerPageLimits& limits_;
  std::uint64_t terms_ = 0;
};

/// Those that are on the page and wanted, in the order in which they are written: each dimension has its turn, the
/// longest first. What was asked for comes in the order of the barcode.
std::vector<Chosen> chosen_bars(const TowerClasses& classes, std::span<const Bar> bars) {
  PageBarNumbers numbers(bars);
  std::vector<Chosen> chosen;
  for (const TracedBar& traced : classes.chains.cycles().bars()) {
    const bool is_wanted = !classes.wanted || classes.wanted->wants(traced.bar.dimension);
    if (const auto number = is_wanted ? numbers.next(traced.bar) : std::nullopt) {
      chosen.push_back({traced, *number});
    }
  }
  if (!classes.wanted) {
    std::ranges::stable_sort(chosen, [](const Chosen& x, const Chosen& y) {
      return x.traced.bar.dimension != y.traced.bar.dimension ? x.traced.bar.dimension < y.traced.bar.dimension
                                                              : is_longer(x.traced.bar, y.traced.bar);
    });
    std::map<int, std::uint64_t> met;
    for (Chosen& each : chosen) {
      each.rank = met[each.traced.bar.dimension]++;
    }
    std::ranges::stable_sort(chosen, {}, &Chosen::rank);
  }
  return chosen;
}

/// To eight digits, which is more than a picture has.
void write_place(double x, JsonText& out) {
  const double scale = std::pow(10.0, 8 - std::ceil(std::log10(std::max(std::abs(x), 1e-6))));
  const double rounded = std::round(x * scale) / scale;
  if (std::abs(rounded) < 1e15 && rounded == std::trunc(rounded)) {
    out.value(static_cast<std::int64_t>(rounded));
  } else {
    out.value(std::isfinite(rounded) ? rounded : x);
  }
}

/// What happened, for the complex at any moment, and where its vertices are.
void write_complex(const OperationList& operations, const PointList& points, const PageTimes& times, JsonText& out) {
  std::vector<std::uint64_t> ends;  ///< how many operations there were after each moment
  std::uint64_t labels = 0;
  out.begin_object();
  out.key("dims");
  out.begin_list();
  for (std::size_t k = 0; k < operations.size(); ++k) {
    out.value(operations.dimension(k));
    if (k + 1 == operations.size() || operations.time(k + 1) != operations.time(k)) {
      ends.push_back(k + 1);
    }
    for (const std::uint64_t label : operations.labels(k)) {
      labels = std::max(labels, label + 1);
    }
  }
  out.end_list();
  out.key("labels");
  out.begin_list();
  for (std::size_t k = 0; k < operations.size(); ++k) {
    for (const std::uint64_t label : operations.labels(k)) {
      write_label(label, out);
    }
  }
  out.end_list();
  out.field("ends", ends);
  out.key("times");
  out.begin_list();
  for (const std::uint64_t end : ends) {
    times.write(operations.time(end - 1), out);
  }
  out.end_list();
  out.key("points");
  out.begin_list();
  for (std::size_t k = 0; k < std::min<std::uint64_t>(labels, points.points.size()); ++k) {
    for (const double x : points.points[k]) {
      write_place(x, out);
    }
  }
  out.end_list();
  out.field("coordinates", points.coordinates);
  out.end_object();
}

/// A page is shown to others, whom the folders of who made it do not concern.
std::string title_of_page(const TowerPage& page) {
  Provenance provenance = page.provenance;
  provenance.source = std::filesystem::path(provenance.source).filename().string();
  return title_of(provenance, page.options);
}

}  // namespace

std::string tower_page_data(const TowerPage& page, const TowerPageLimits& limits) {
  const DrawnBarcode shown = drawn(page.barcode, page.options);
  const PageTimes times(shown.counted.bars);
  std::string text;
  JsonText out(text);
  out.begin_object();
  out.field("kind", "tower");
  out.field("format", 1);
  out.field("version", SESAME_VERSION);
  out.field("title", title_of_page(page));
  out.field("ring", page.provenance.ring);
  out.field("time_name", page.options.time_name);
  out.field("facts", facts(shown, page.provenance, page.options));
  out.field("origin", number_text(times.origin()));
  out.key("bars");
  write_page_bars(shown.bars.bars, times, out);
  std::vector<Bar> left_out;
  std::ranges::set_difference(shown.counted.bars, shown.bars.bars, std::back_inserter(left_out));
  out.key("left_out");
  write_page_bars(left_out, times, out);
  std::vector<std::string> notes;
  if (!page.note.empty()) {
    notes.push_back(page.note);
  }
  out.key("classes");
  std::uint64_t written = 0;
  if (page.classes != nullptr) {
    ClassWriter writer(*page.classes, limits);
    written = writer.write(chosen_bars(*page.classes, shown.bars.bars), out);
  } else {
    out.list_of();
  }
  if (page.classes != nullptr && written < shown.bars.bars.size()) {
    notes.push_back(fmt::format("{} of the {} have their class on this page{}", with_separators(written),
                                counted(shown.bars.bars.size(), "bar"),
                                page.classes->wanted ? ", as --generators says."
                                                     : ", the longest of each dimension; --generators brings all."));
  }
  if (times.are_rounded()) {
    notes.emplace_back("Times beyond 2^53 that are far apart are shown as the nearest doubles.");
  }
  out.key("complex");
  const bool has_room = page.operations != nullptr && page.operations->size() <= limits.operations;
  if (page.points != nullptr && has_room) {
    write_complex(*page.operations, *page.points, times, out);
  } else {
    out.null();
  }
  if (page.points != nullptr && !has_room) {
    notes.push_back(
        fmt::format("The complex is not drawn: it has more than {} operations.", with_separators(limits.operations)));
  }
  if (page.points != nullptr && page.points->coordinates > 3) {
    notes.push_back(
        fmt::format("The points have {} coordinates: the first three are drawn.", page.points->coordinates));
  }
  out.field("notes", notes);
  out.end_object();
  return text;
}

void write_tower_page(std::ostream& out, const TowerPage& page, const TowerPageLimits& limits) {
  write_page_file(out, tower_page_data(page, limits));
}

}  // namespace sesame::replay
