#include "engine/classes.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

template <Ring R>
Homology Classes<R>::homology(std::size_t dimensions) {
  const typename Groups<R>::Torsion& core = groups_.torsion();
  const std::vector<std::uint32_t>& small = rewriter_.small_counts();
  const auto at = [](const auto& counts, std::size_t p) -> std::int64_t { return p < counts.size() ? counts[p] : 0; };
  Homology homology;
  for (std::size_t p = 0; p < dimensions; ++p) {
    homology.betti.push_back(at(small, p) - at(core.ranks, p) - at(core.ranks, p + 1));
    homology.torsion.push_back(p < core.coefficients.size() ? core.coefficients[p] : std::vector<Integer>{});
    homology.small.push_back(static_cast<std::uint32_t>(at(small, p)));
  }
  homology.big = big_.counts();
  homology.big.resize(std::max(dimensions, homology.big.size()), 0);
  return homology;
}

template <Ring R>
std::shared_ptr<const Group<R>> Classes<R>::group(int degree) {
  std::shared_ptr<const Group<R>>& known = known_[degree];
  if (known == nullptr) {
    known = std::make_shared<const Group<R>>(groups_.of(degree));
  }
  return known;
}

template <Ring R>
void Classes<R>::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
  KnownTraces<R> known;
  const auto write_out = [&](int p, const Terms<R, Symbol>& symbols, CellChain& chain, std::uint64_t& terms) {
    const Terms<R, GeneratorId> lift = rewriter_.lift(symbols, {}, &known);
    terms = most_terms == uncountable ? 0 : big_.maps().terms_of_f(lift);
    if (terms > most_terms) {
      chain.degree = p;
    } else {
      terms = 0;
      chain = chains_.f(p, lift);
    }
  };
  const std::shared_ptr<const Group<R>> group = this->group(degree);
  group->for_each_generator(ring_, [&](const GroupGenerator<R>& found) {
    Generator generator;
    generator.degree = degree;
    generator.order = found.order;
    write_out(degree, found.cycle, generator.cycle, generator.terms_of_cycle);
    if (!found.order.is_zero()) {
      write_out(degree + 1, found.bounding, generator.bounding, generator.terms_of_bounding);
    }
    return visit(std::move(generator));
  });
}

template <Ring R>
ClassAnswer Classes<R>::classify(const CellChain& chain) {
  ClassAnswer answer;
  if (!chains_.boundary(chain).terms.empty()) {
    return answer;
  }
  answer.is_cycle = true;
  const Terms<R, GeneratorId> z = chains_.g(chain);
  auto [coefficients, rest_bounds] = group(chain.degree)->class_of(ring_, rewriter_.rewrite(z));
  answer.coefficients = std::move(coefficients);
  answer.is_zero = std::all_of(answer.coefficients.begin(), answer.coefficients.end(),
                               [](const Rational& a) { return a.is_zero(); });
  if (answer.is_zero) {
    answer.bounds = chains_.bounding(chain, z, rest_bounds);
  }
  return answer;
}

#define SESAME_INSTANTIATE(R) template class Classes<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
