#include "tools/bench/theorem_method.hpp"

#include <variant>

#include "reductions/elimination.hpp"
#include "reductions/homology.hpp"

namespace sesame::tools {
namespace {

using ops::CellBasis;
using ops::CellId;
using reductions::Equivalence;
using reductions::GradedMap;

/// The equivalence with the generators of its object in another order.
template <sparse::Ring R>
Equivalence<R> reordered(const Equivalence<R>& equivalence, const CellBasis& from, const CellBasis& to) {
  const auto itself = [&](CellId cell) { return sparse::Terms<R, CellId>{{cell, equivalence.object().ring().one()}}; };
  const R& ring = equivalence.object().ring();
  return {compose(equivalence.left,
                  reductions::isomorphism(equivalence.object(), reductions::map_by_columns(ring, 0, from, to, itself),
                                          reductions::map_by_columns(ring, 0, to, from, itself))),
          equivalence.right};
}

template <sparse::Ring R>
std::uint64_t entries_of(const GradedMap<R>& map) {
  std::uint64_t entries = 0;
  for (int p = 0; p < static_cast<int>(map.source().size()); ++p) {
    entries += map.at(p).nonzeros();
  }
  return entries;
}

template <sparse::Ring R>
std::uint64_t entries_of(const reductions::Reduction<R>& reduction) {
  return entries_of(reduction.f) + entries_of(reduction.g) + entries_of(reduction.h) +
         entries_of(differential(reduction.small));
}

}  // namespace

template <sparse::Ring R>
TheoremMethod<R>::TheoremMethod(R ring) : ring_{ring} {
  states_.push_back(
      {reductions::trivial_equivalence(reductions::ChainComplex<R>::with_zero_boundary(ring, {})), CellBasis{}});
}

template <sparse::Ring R>
Status TheoremMethod<R>::apply(const ops::Operation& operation) {
  if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
    Status status = object_.take_back(undo->steps);
    if (status) {
      states_.resize(object_.steps().size() + 1, states_.front());
    }
    return status;
  }
  if (Status planned = object_.plan(operation); !planned) {
    return planned;
  }
  const ops::StepKind kind = object_.planned().kind();
  if (kind == ops::StepKind::product || kind == ops::StepKind::lazy_cone) {
    return Error{Errc::refused, "the theorem makes no products: they are no exact sequences"};
  }
  if (kind == ops::StepKind::deletion || kind == ops::StepKind::replacement) {
    return Error{Errc::refused, "this method follows the theorem in two of its directions: it removes no cells"};
  }
  object_.carry_out();
  const std::size_t last = object_.steps().size() - 1;
  const auto steps = ops::step_sequences(object_.structure(), kind, object_.before(last), object_.after(last), ring_);
  if (steps.empty()) {
    states_.push_back(states_.back());
    return Done{};
  }
  auto state = next(steps.front(), kind);
  sparse::expects(state.has_value(), "the sequence of a step breaks no law");
  states_.push_back(std::move(*state));
  return Done{};
}

template <sparse::Ring R>
auto TheoremMethod<R>::next(const ops::StepSequence<R>& step, ops::StepKind kind) const -> Result<State> {
  const auto& [now, cells] = states_.back();
  const auto& sequence = step.sequence;
  const auto shrunk = [](const Equivalence<R>& equivalence) {
    return shrink(equivalence, reductions::reduce(equivalence.small()));
  };
  if (step.direction == ops::Direction::forward) {
    const auto before = reordered(now, cells, step.basis1);
    return State{shrunk(forward(sequence, reductions::trivial_equivalence(sequence.c0), before)), step.basis2};
  }
  const auto after =
      kind == ops::StepKind::split
          ? backward(sequence, reductions::trivial_equivalence(sequence.c0), reordered(now, cells, step.basis2))
          : backward(sequence, reordered(now, cells, step.basis0), reductions::trivial_equivalence(sequence.c2));
  if (!after) {
    return after.error();
  }
  return State{shrunk(*after), step.basis1};
}

template <sparse::Ring R>
engine::Homology TheoremMethod<R>::homology() {
  const auto groups = reductions::homology_groups(equivalence().small());
  engine::Homology homology;
  for (std::size_t p = 0; p < object_.structure().counts().size(); ++p) {
    const bool is_there = p < groups.size();
    homology.betti.push_back(is_there ? groups[p].rank : 0);
    homology.torsion.push_back(is_there ? groups[p].torsion : std::vector<sparse::Integer>{});
    homology.small.push_back(equivalence().small().size(static_cast<int>(p)));
    homology.big.push_back(equivalence().big().size(static_cast<int>(p)));
  }
  return homology;
}

template <sparse::Ring R>
std::uint64_t TheoremMethod<R>::generators() {
  std::uint64_t terms = 0;
  for (const auto& group : reductions::homology(equivalence().small())) {
    for (const auto& generator : group.generators) {
      terms += equivalence().left.f.apply(equivalence().right.g.apply(generator.cycle)).terms().size();
    }
  }
  return terms;
}

template <sparse::Ring R>
std::vector<std::pair<std::string, std::uint64_t>> TheoremMethod<R>::counts() const {
  return {{"entries_held", entries_of(equivalence().left) + entries_of(equivalence().right) +
                               entries_of(differential(equivalence().big()))}};
}

std::unique_ptr<Method> make_theorem_method(const sparse::AnyRing& ring) {
  return std::visit(
      []<sparse::Ring R>(const R& r) -> std::unique_ptr<Method> { return std::make_unique<TheoremMethod<R>>(r); },
      ring);
}

#define SESAME_INSTANTIATE(R) template class TheoremMethod<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
