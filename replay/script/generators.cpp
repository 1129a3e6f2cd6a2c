#include "replay/script/generators.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace sesame::replay {
namespace {

constexpr std::uint64_t always_counted = std::uint64_t{1} << 16;

std::optional<int> parse_degree(std::string_view text) {
  int degree = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), degree);
  const bool is_right = failed == std::errc{} && end == text.data() + text.size() && degree >= 0;
  return is_right ? std::optional{degree} : std::nullopt;
}

std::optional<ChainLength> length(const engine::CellChain& chain, std::uint64_t at_most,
                                  const GeneratorOptions& options) {
  if (at_most > 0) {
    return ChainLength{at_most, false};
  }
  return chain.terms.size() > options.most_terms ? std::optional{ChainLength{chain.terms.size(), true}} : std::nullopt;
}

}  // namespace

bool GeneratorOptions::wants(int degree) const {
  return degrees.empty() || std::any_of(degrees.begin(), degrees.end(), [degree](const auto& range) {
           return range.first <= degree && degree <= range.second;
         });
}

Result<std::vector<std::pair<int, int>>> parse_degrees(std::string_view text) {
  std::vector<std::pair<int, int>> degrees;
  for (std::string_view rest = text;; rest.remove_prefix(rest.find(',') + 1)) {
    const std::string_view range = rest.substr(0, rest.find(','));
    const std::size_t dash = range.find('-');
    const std::optional<int> from = parse_degree(range.substr(0, dash));
    const std::optional<int> to = dash == std::string_view::npos ? from : parse_degree(range.substr(dash + 1));
    if (!from || !to || *from > *to) {
      return Error{Errc::bad_input, "\"" + std::string{text} + "\" should be dimensions, such as 1 or 0-2 or 0,2-4"};
    }
    degrees.emplace_back(*from, *to);
    if (range.size() == rest.size()) {
      return degrees;
    }
  }
}

std::optional<ChainLength> length_of_cycle(const engine::Generator& generator, const GeneratorOptions& options) {
  return length(generator.cycle, generator.terms_of_cycle, options);
}

std::optional<ChainLength> length_of_bounding(const engine::Generator& generator, const GeneratorOptions& options) {
  return length(generator.bounding, generator.terms_of_bounding, options);
}

void visit_generators(engine::Engine& engine, int degree, const GeneratorOptions& options,
                      const std::function<bool(const engine::Generator&)>& visit) {
  engine.visit_generators(degree, std::max(options.most_terms, always_counted), visit);
}

}  // namespace sesame::replay
