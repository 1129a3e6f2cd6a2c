#include "replay/export/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace sesame::replay {
namespace {

constexpr std::uint64_t most_numbers = 100'000'000;

double nearest_double(const sparse::Integer& integer) {
  const std::string digits = integer.to_string();
  double nearest = 0;
  const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), nearest);
  return failed == std::errc{} ? nearest : integer.sign() * std::numeric_limits<double>::infinity();
}

}  // namespace

Result<std::vector<NamedGenerator>> named_generators(engine::Engine& engine, const GeneratorOptions& options,
                                                     int highest, std::uint64_t cells_drawn,
                                                     const std::atomic<bool>* stop) {
  const engine::Homology homology = engine.homology();
  const int degrees = std::min(highest + 1, static_cast<int>(homology.betti.size()));
  std::uint64_t wanted = 0;
  for (int degree = 0; degree < degrees; ++degree) {
    const auto p = static_cast<std::size_t>(degree);
    wanted += options.wants(degree) ? static_cast<std::uint64_t>(homology.betti[p]) + homology.torsion[p].size() : 0;
  }
  if (cells_drawn > 0 && wanted > most_numbers / cells_drawn) {
    return Error{Errc::refused, fmt::format("{} generators with a number for each of {} cells are too much for a file; "
                                            "choose some by --generators=DEGREES",
                                            wanted, cells_drawn)};
  }
  std::vector<NamedGenerator> generators;
  for (int degree = 0; degree < degrees; ++degree) {
    std::size_t number = 0;
    const auto take = [&](const engine::Generator& generator) {
      generators.push_back({fmt::format("H{}_{}", degree, number++), generator});
      return stop == nullptr || !stop->load();
    };
    if (options.wants(degree)) {
      visit_generators(engine, degree, options, take);
    }
  }
  return generators;
}

CoefficientColumn::CoefficientColumn(const ObjectCells& cells, const engine::Generator& generator)
    : degree_{generator.degree}, coefficients_(cells.of(static_cast<std::size_t>(generator.degree)).size()) {
  for (const auto& [coefficient, cell] : generator.cycle.terms) {
    coefficients_[cells.number(cell)] =
        nearest_double(coefficient.numerator()) / nearest_double(coefficient.denominator());
    const auto word = coefficient.to_int64();
    is_integral_ = is_integral_ && word && *word == static_cast<std::int32_t>(*word);
  }
}

}  // namespace sesame::replay
