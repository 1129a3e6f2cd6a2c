#include <fmt/format.h>
#include <fmt/ranges.h>

#include "replay/script/groups.hpp"
#include "replay/script/reporter.hpp"

namespace sesame::replay {
namespace {

/// Longer chains are cut in the table; --json has them whole.
constexpr std::size_t most_terms = 40;

std::string short_time(double microseconds) {
  if (microseconds < 1e3) {
    return fmt::format("{:.1f} us", microseconds);
  }
  return microseconds < 1e6 ? fmt::format("{:.1f} ms", microseconds / 1e3)
                            : fmt::format("{:.2f} s", microseconds / 1e6);
}

std::string already_text(std::uint64_t simplices) {
  return fmt::format("{} to be inserted {} there already",
                     simplices == 1 ? "1 simplex" : fmt::format("{} simplices", simplices),
                     simplices == 1 ? "was" : "were");
}

class TableReporter final : public Reporter {
 public:
  TableReporter(std::ostream& out, bool colour) : out_{out}, colour_{colour} {}

  void step(engine::Engine& engine, const ReportedStep& reported) override {
    if (!has_header_) {
      out_ << bold(fmt::format("{:>6}  {:<10} {:<18} {:>6} {:>10}  homology over {}", "step", "op", "cells", "euler",
                               "time", sparse::ring_name(engine.ring())))
           << '\n';
      has_header_ = true;
    }
    const std::string homology = homology_line(reported.homology, engine.ring());
    out_ << fmt::format("{:>6}  {:<10} {:<18} {:>6} {:>10}  ", reported.step.step, reported.step.op,
                        fmt::format("{}", fmt::join(engine.cells(), " ")), engine.euler_characteristic(),
                        short_time(reported.microseconds))
         << (homology == last_ ? homology : changed(homology)) << '\n';
    last_ = homology;
    if (reported.step.already > 0) {
      out_ << std::string(8, ' ') << already_text(reported.step.already) << '\n';
    }
    if (reported.step.answer) {
      answer(engine, *reported.step.answer);
    }
    out_ << std::flush;
  }

  void summary(engine::Engine& engine, const Summary& summary) override {
    if (has_header_) {
      out_ << '\n';
    }
    const double rate = summary.seconds > 0 ? static_cast<double>(summary.steps) / summary.seconds : 0;
    out_ << fmt::format("{}{} steps in {} ({:.0f} a second)\n", summary.interrupted ? "interrupted: " : "",
                        summary.steps, short_time(summary.seconds * 1e6), rate);
    out_ << fmt::format("cells {}, Euler characteristic {}\n",
                        engine.cells().empty() ? "none" : fmt::format("{}", fmt::join(engine.cells(), " ")),
                        engine.euler_characteristic());
    if (summary.already > 0) {
      out_ << already_text(summary.already) << '\n';
    }
    const engine::Homology homology = engine.homology();
    int p = 0;
    for (const std::string& name : group_names(homology, engine.ring())) {
      out_ << fmt::format("H{} = {}\n", p, bold(name));
      if (summary.generators != nullptr && summary.generators->wants(p) && !generators(engine, p, summary)) {
        out_ << "interrupted: these are not all generators\n";
        break;
      }
      ++p;
    }
    out_ << std::flush;
  }

 private:
  /// Writes them one after another. Whether these are all.
  bool generators(engine::Engine& engine, int degree, const Summary& summary) {
    const GeneratorOptions& options = *summary.generators;
    bool goes_on = true;
    visit_generators(engine, degree, options, [&](const engine::Generator& g) {
      goes_on = !summary.is_stopped() && out_;
      if (goes_on) {
        const std::string order = g.order.is_zero() ? "free" : "order " + g.order.to_string();
        out_ << fmt::format("    {:<9} {}\n", order, text_of(g.cycle, length_of_cycle(g, options), engine.structure()));
        if (!g.order.is_zero()) {
          out_ << fmt::format("    {:<9} {} times it bounds {}\n", "", g.order.to_string(),
                              text_of(g.bounding, length_of_bounding(g, options), engine.structure()));
        }
      }
      return goes_on;
    });
    return goes_on;
  }

  static std::string text_of(const engine::CellChain& chain, const std::optional<ChainLength>& length,
                             const ops::Structure& structure) {
    if (length) {
      return fmt::format("a chain of {}{} terms", length->is_exact ? "" : "at most ", length->terms);
    }
    return chain_text(chain, structure, most_terms);
  }

  void answer(engine::Engine& engine, const engine::ClassAnswer& found) {
    const std::string indent(8, ' ');
    if (!found.is_cycle) {
      out_ << indent << "not a cycle: it has no class\n";
    } else if (!found.is_zero) {
      std::string coefficients;
      for (const sparse::Rational& c : found.coefficients) {
        coefficients += (coefficients.empty() ? "" : ", ") + c.to_string();
      }
      out_ << indent << "a cycle of class (" << coefficients << ") on the generators\n";
    } else {
      out_ << indent << "bounds " << chain_text(*found.bounds, engine.structure(), most_terms) << '\n';
    }
  }

  [[nodiscard]] std::string bold(const std::string& text) const { return coloured("1", text); }
  [[nodiscard]] std::string changed(const std::string& text) const { return coloured("32", text); }
  [[nodiscard]] std::string coloured(const char* code, const std::string& text) const {
    return colour_ ? fmt::format("\033[{}m{}\033[0m", code, text) : text;
  }

  std::ostream& out_;
  bool colour_;
  bool has_header_ = false;
  std::string last_;
};

}  // namespace

std::unique_ptr<Reporter> table_reporter(std::ostream& out, bool colour) {
  return std::make_unique<TableReporter>(out, colour);
}

}  // namespace sesame::replay
