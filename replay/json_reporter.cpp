#include <nlohmann/json.hpp>

#include "replay/reporter.hpp"

namespace sesame::replay {
namespace {

using Json = nlohmann::ordered_json;
using engine::CellChain;
using sparse::Integer;

/// Integers beyond 64 bits are written as strings of digits: most JSON readers would round them.
Json number(const Integer& n) {
  const auto word = n.to_int64();
  return word ? Json(*word) : Json(n.to_string());
}

Json numbers(const std::vector<Integer>& list) {
  Json out = Json::array();
  for (const Integer& n : list) {
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

Json generators(engine::Engine& engine) {
  Json out = Json::array();
  for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
    for (const engine::Generator& generator : engine.generators(p)) {
      Json item{{"dim", generator.degree},
                {"order", number(generator.order)},
                {"chain", chain(generator.cycle, engine.structure())}};
      if (!generator.order.is_zero()) {
        item["bounds"] = chain(generator.bounding, engine.structure());
      }
      out.push_back(std::move(item));
    }
  }
  return out;
}

class JsonReporter final : public Reporter {
 public:
  explicit JsonReporter(std::ostream& out) : out_{out} {}

  void step(engine::Engine& engine, const ReportedStep& reported) override {
    Json object{{"step", reported.step.step},       {"op", reported.step.op},
                {"cells", engine.cells()},          {"euler", engine.euler_characteristic()},
                {"betti", reported.homology.betti}, {"torsion", torsion(reported.homology.torsion)},
                {"small", reported.homology.small}, {"big", reported.homology.big}};
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
    if (summary.interrupted) {
      object["interrupted"] = true;
    }
    if (summary.with_generators) {
      object["generators"] = generators(engine);
    }
    out_ << object.dump() << '\n' << std::flush;
  }

 private:
  std::ostream& out_;
};

}  // namespace

std::unique_ptr<Reporter> json_reporter(std::ostream& out) { return std::make_unique<JsonReporter>(out); }

}  // namespace sesame::replay
