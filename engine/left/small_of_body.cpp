#include "engine/left/small_of_body.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace sesame::engine {
namespace {

/// By a look at all small generators.
template <Ring R>
std::vector<Symbol> among_all(ops::BodyId body, const BigComplex<R>& big, const Rewriter<R>& rewriter) {
  std::vector<Symbol> symbols;
  rewriter.for_each_small([&](Symbol x) {
    if (big.body_of(rewriter.generator_in(x)) == body) {
      symbols.push_back(x);
    }
  });
  return symbols;
}

/// By a look at the nodes of the body, as long as they are no more than `most`; nothing for a body with a lazy family.
template <Ring R>
std::optional<std::vector<Symbol>> among_nodes(ops::BodyId body, std::uint64_t most, const Structure& structure,
                                               const BigComplex<R>& big, const Rewriter<R>& rewriter) {
  std::vector<Symbol> symbols;
  const auto add = [&](GeneratorId generator) {
    if (const Symbol x = rewriter.small_of(generator); x != no_symbol) {
      symbols.push_back(x);
    }
  };
  std::uint64_t looked_at = 0;
  std::vector<ops::BodyId> pending{structure.bodies().find(body)};
  while (!pending.empty()) {
    const ops::Bodies::Made& made = structure.bodies().made(pending.back());
    pending.pop_back();
    pending.insert(pending.end(), made.children.begin(), made.children.end());
    ++looked_at;
    for (const auto& [first, last] : made.cells) {
      looked_at += last - first;
    }
    if (made.family != ops::none || looked_at > most) {
      return std::nullopt;
    }
    for (const auto& [first, last] : made.cells) {
      for (CellId node = first; node < last; ++node) {
        big.generators().for_each_of(node, add);
      }
    }
  }
  return symbols;
}

}  // namespace

template <Ring R>
std::vector<Symbol> small_of_body(ops::BodyId body, const Structure& structure, const BigComplex<R>& big,
                                  const Rewriter<R>& rewriter) {
  const auto& counts = rewriter.small_counts();
  const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  std::optional<std::vector<Symbol>> found = among_nodes(body, all, structure, big, rewriter);
  std::vector<Symbol> symbols = found ? std::move(*found) : among_all(body, big, rewriter);
  std::sort(symbols.begin(), symbols.end());
  return symbols;
}

#define SESAME_INSTANTIATE(R) \
  template std::vector<Symbol> small_of_body(ops::BodyId, const Structure&, const BigComplex<R>&, const Rewriter<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
