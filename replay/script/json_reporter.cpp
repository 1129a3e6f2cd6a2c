#include <nlohmann/json.hpp>
#include <utility>

#include "replay/script/reporter.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using Json = nlohmann::ordered_json;
using engine::CellChain;
using sparse::Integer;
using sparse::Rational;

/// Integers beyond 64 bits are written as strings of digits: most JSON readers would round them.
Json number(const Integer& n) {
  const auto word = n.to_int64();
  return word ? Json(*word) : Json(n.to_string());
}

/// Fractions too: "1/2".
Json number(const Rational& n) { return n.is_integer() ? number(n.numerator()) : Json(n.to_string()); }

template <class Number>
Json numbers(const std::vector<Number>& list) {
  Json out = Json::array();
  for (const Number& n : list) {
    out.push_back(number(n));
  }
  return out;
}

Json torsion(const std::vector<std::vector<Integer>>& by_degree) {
  Json out = Json::array();
  for (const auto& factors : by_degree) {
    out.push_back(numbers(factors));
  }
  return out;
}

Json chain(const CellChain& chain, const ops::Structure& structure) {
  Json out = Json::array();
  for (const auto& [coefficient, cell] : chain.terms) {
    out.push_back(Json::array({number(coefficient), structure.name(cell)}));
  }
  return out;
}

Json answer(const engine::ClassAnswer& found, const ops::Structure& structure) {
  Json out{{"cycle", found.is_cycle}, {"zero", found.is_zero}, {"coefficients", nullptr}, {"bounds", nullptr}};
  if (found.is_cycle) {
    out["coefficients"] = numbers(found.coefficients);
  }
  if (found.bounds) {
    out["bounds"] = chain(*found.bounds, structure);
  }
  return out;
}

/// A member `name`, or `name_of_length` when the chain is too long.
void add_chain(TextBuffer& text, const char* name, const char* name_of_length, const CellChain& chain,
               const std::optional<ChainLength>& length, const ops::Structure& structure) {
  if (length) {
    text.add(",\"").add(name_of_length).add(length->is_exact ? "\":" : "_at_most\":").add_integer(length->terms);
    return;
  }
  text.add(",\"").add(name).add("\":[");
  bool is_first = true;
  for (const auto& [coefficient, cell] : chain.terms) {
    text.add(is_first ? "" : ",").add(Json::array({number(coefficient), structure.name(cell)}).dump());
    is_first = false;
  }
  text.add(']');
}

void add_generator(TextBuffer& text, const engine::Generator& generator, const GeneratorOptions& options,
                   const ops::Structure& structure) {
  text.add(R"({"dim":)").add_integer(generator.degree).add(R"(,"order":)").add(number(generator.order).dump());
  add_chain(text, "chain", "terms", generator.cycle, length_of_cycle(generator, options), structure);
  if (!generator.order.is_zero()) {
    add_chain(text, "bounds", "bounds_terms", generator.bounding, length_of_bounding(generator, options), structure);
  }
  text.add('}');
}

class JsonReporter final : public Reporter {
 public:
  explicit JsonReporter(std::ostream& out) : out_{out} {}

  void step(engine::Engine& engine, const ReportedStep& reported) override {
    Json object{{"step", reported.step.step},       {"op", reported.step.op},
                {"cells", engine.cells()},          {"euler", engine.euler_characteristic()},
                {"betti", reported.homology.betti}, {"torsion", torsion(reported.homology.torsion)},
                {"small", reported.homology.small}, {"big", reported.homology.big}};
    if (reported.step.already > 0) {
      object["already"] = reported.step.already;
    }
    if (reported.step.answer) {
      object["class"] = answer(*reported.step.answer, engine.structure());
    }
    object["us"] = reported.microseconds;
    out_ << object.dump() << '\n' << std::flush;  // live: a program may be waiting for it
  }

  void refused(const RefusedStep& refused) override {
    const Json object{{"step", refused.step}, {"error", {{"line", refused.line}, {"what", refused.what}}}};
    // What a script says may be no UTF-8.
    out_ << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
  }

  void summary(engine::Engine& engine, const Summary& summary) override {
    const engine::Homology homology = engine.homology();
    Json object{{"summary", true},
                {"ring", sparse::ring_name(engine.ring())},
                {"steps", summary.steps},
                {"cells", engine.cells()},
                {"euler", engine.euler_characteristic()},
                {"betti", homology.betti},
                {"torsion", torsion(homology.torsion)},
                {"seconds", summary.seconds}};
    if (summary.already > 0) {
      object["already"] = summary.already;
    }
    bool is_interrupted = summary.interrupted;
    std::string text = object.dump();
    text.pop_back();  // the brace
    out_ << text;
    if (summary.generators != nullptr) {
      is_interrupted = !generators(engine, summary) || is_interrupted;
    }
    out_ << (is_interrupted ? R"(,"interrupted":true})" : "}") << '\n' << std::flush;
  }

 private:
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
          add_generator(text, generator, *summary.generators, engine.structure());
        }
        return goes_on;
      });
    }
    text.add(']');
    return goes_on;
  }

  std::ostream& out_;
};

}  // namespace

std::unique_ptr<Reporter> json_reporter(std::ostream& out) { return std::make_unique<JsonReporter>(out); }

}  // namespace sesame::replay
