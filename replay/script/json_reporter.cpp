#include <map>
#include <utility>

#include "ops/cells/analogue_chain.hpp"
#include "ops/vocabulary/json_text.hpp"
#include "replay/script/reporter.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using engine::CellChain;
using ops::JsonText;
using sparse::Rational;

/// Fractions as texts: "1/2".
void write(const Rational& n, JsonText& out) {
  if (n.is_integer()) {
    out.value(n.numerator());
  } else {
    out.value(n.to_string());
  }
}

void write_term(const Rational& coefficient, const std::string& name, JsonText& out) {
  out.begin_list();
  write(coefficient, out);
  out.value(name);
  out.end_list();
}

/// Chains as lists of coefficients and names: of their cells, or of the simplices of the analogues of maps, which is
/// worked out as a whole, since what lies within is often left out.
class ChainWriter {
 public:
  ChainWriter(const ops::Structure& structure, bool in_simplices)
      : structure_{structure}, in_simplices_{in_simplices} {}

  /// Passes the coefficient and the name of each term to `visit`.
  template <class Visit>
  void for_each(const CellChain& chain, Visit visit) const {
    if (!in_simplices_) {
      for (const auto& [coefficient, cell] : chain.terms) {
        visit(coefficient, structure_.name(cell));
      }
      return;
    }
    for (const auto& [name, coefficient] : sums(chain)) {
      if (!coefficient.is_zero()) {
        visit(coefficient, name);
      }
    }
  }

 private:
  [[nodiscard]] std::map<std::string, Rational> sums(const CellChain& chain) const {
    std::map<std::string, Rational> sums;
    const auto add = [&](const std::string& name, const Rational& coefficient) {
      const auto [at, is_new] = sums.emplace(name, coefficient);
      at->second = is_new ? coefficient : at->second + coefficient;
    };
    for (const auto& [coefficient, cell] : chain.terms) {
      if (const auto simplices = ops::in_analogue(structure_, cell)) {
        for (const auto& [times, name] : *simplices) {
          add(name, coefficient * Rational{sparse::Integer{times}});
        }
      } else {
        add(structure_.name(cell), coefficient);
      }
    }
    return sums;
  }

  const ops::Structure& structure_;
  bool in_simplices_;
};

void write(const engine::ClassAnswer& found, const ChainWriter& chains, JsonText& out) {
  out.begin_object();
  out.field("cycle", found.is_cycle);
  out.field("zero", found.is_zero);
  out.key("coefficients");
  if (found.is_cycle) {
    out.begin_list();
    for (const Rational& coefficient : found.coefficients) {
      write(coefficient, out);
    }
    out.end_list();
  } else {
    out.null();
  }
  out.key("bounds");
  if (found.bounds) {
    out.begin_list();
    chains.for_each(*found.bounds,
                    [&](const Rational& coefficient, const std::string& name) { write_term(coefficient, name, out); });
    out.end_list();
  } else {
    out.null();
  }
  out.end_object();
}

/// A member `name`, or `name_of_length` when the chain is too long.
void add_chain(TextBuffer& text, const char* name, const char* name_of_length, const CellChain& chain,
               const std::optional<ChainLength>& length, const ChainWriter& chains) {
  if (length) {
    text.add(",\"").add(name_of_length).add(length->is_exact ? "\":" : "_at_most\":").add_integer(length->terms);
    return;
  }
  text.add(",\"").add(name).add("\":[");
  std::string separated;
  JsonText out(separated);
  chains.for_each(chain, [&](const Rational& coefficient, const std::string& of_cell) {
    write_term(coefficient, of_cell, out);
    text.add(separated);
    separated.clear();
  });
  text.add(']');
}

void add_generator(TextBuffer& text, const engine::Generator& generator, const GeneratorOptions& options,
                   const ChainWriter& chains) {
  std::string order;
  JsonText(order).value(generator.order);
  text.add(R"({"dim":)").add_integer(generator.degree).add(R"(,"order":)").add(order);
  add_chain(text, "chain", "terms", generator.cycle, length_of_cycle(generator, options), chains);
  if (!generator.order.is_zero()) {
    add_chain(text, "bounds", "bounds_terms", generator.bounding, length_of_bounding(generator, options), chains);
  }
  text.add('}');
}

class JsonReporter final : public Reporter {
 public:
  JsonReporter(std::ostream& out, bool in_simplices) : out_{out}, in_simplices_{in_simplices} {}

  void step(engine::Engine& engine, const ReportedStep& reported) override {
    text_.clear();
    JsonText out(text_);
    out.begin_object();
    out.field("step", reported.step.step);
    out.field("op", reported.step.op);
    write_state(engine, reported.homology, out);
    out.field("small", reported.homology.small);
    out.field("big", reported.homology.big);
    if (reported.step.already > 0) {
      out.field("already", reported.step.already);
    }
    if (reported.step.answer) {
      out.key("class");
      write(*reported.step.answer, {engine.structure(), in_simplices_}, out);
    }
    out.field("us", reported.microseconds);
    out.end_object();
    end_line();
  }

  void refused(const RefusedStep& refused) override {
    text_.clear();
    JsonText out(text_);
    out.begin_object();
    out.field("step", refused.step);
    out.key("error");
    out.begin_object();
    out.field("line", refused.line);
    out.field("what", refused.what);
    out.end_object();
    out.end_object();
    end_line();
  }

  void summary(engine::Engine& engine, const Summary& summary) override {
    text_.clear();
    JsonText out(text_);
    out.begin_object();
    out.field("summary", true);
    out.field("ring", sparse::ring_name(engine.ring()));
    out.field("steps", summary.steps);
    write_state(engine, engine.homology(), out);
    out.field("seconds", summary.seconds);
    if (summary.already > 0) {
      out.field("already", summary.already);
    }
    out_ << text_;
    bool is_interrupted = summary.interrupted;
    if (summary.generators != nullptr) {
      is_interrupted = !generators(engine, summary) || is_interrupted;
    }
    out_ << (is_interrupted ? R"(,"interrupted":true})" : "}") << '\n' << std::flush;
  }

 private:
  static void write_state(engine::Engine& engine, const engine::Homology& homology, JsonText& out) {
    out.field("cells", engine.cells());
    out.field("euler", engine.euler_characteristic());
    out.field("betti", homology.betti);
    out.field("torsion", homology.torsion);
  }

  /// Live: a program may be waiting for it.
  void end_line() {
    text_ += '\n';
    out_ << text_ << std::flush;
  }

  /// Writes them one after another. Whether these are all.
  bool generators(engine::Engine& engine, const Summary& summary) {
    TextBuffer text(out_);
    text.add(R"(,"generators":[)");
    bool goes_on = true;
    bool is_first = true;
    for (int p = 0; goes_on && p < static_cast<int>(engine.cells().size()); ++p) {
      if (!summary.generators->wants(p)) {
        continue;
      }
      visit_generators(engine, p, *summary.generators, [&](const engine::Generator& generator) {
        goes_on = !summary.is_stopped() && out_;
        if (goes_on) {
          text.add(std::exchange(is_first, false) ? "" : ",");
          add_generator(text, generator, *summary.generators, {engine.structure(), in_simplices_});
        }
        return goes_on;
      });
    }
    text.add(']');
    return goes_on;
  }

  std::ostream& out_;
  bool in_simplices_;
  std::string text_;  ///< of a line; kept for the next one
};

}  // namespace

std::unique_ptr<Reporter> json_reporter(std::ostream& out) { return std::make_unique<JsonReporter>(out, false); }

std::unique_ptr<Reporter> json_reporter_in_simplices(std::ostream& out) {
  return std::make_unique<JsonReporter>(out, true);
}

}  // namespace sesame::replay
