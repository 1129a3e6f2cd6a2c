#include "tools/bench/eager_method.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <variant>

#include "ops/cells/cofaces.hpp"
#include "ops/plan/step_sequence.hpp"

namespace sesame::tools {

using ops::CellId;
using sparse::Index;

namespace {

/// The terms on some cells, written by the positions of those.
template <sparse::Ring R>
sparse::Terms<R> restricted(const R& ring, const sparse::Terms<R>& chain, const std::map<CellId, Index>& positions) {
  sparse::RawTerms<R> part;
  for (const auto& term : chain) {
    if (const auto at = positions.find(CellId{term.index}); at != positions.end()) {
      part.push_back({at->second, term.coefficient});
    }
  }
  return std::move(part).normal(ring);
}

template <sparse::Ring R>
sparse::Terms<R> difference(const R& ring, sparse::Terms<R> a, const sparse::Terms<R>& b) {
  sparse::add_multiple<R>(ring, a, ring.negate(ring.one()), b);
  return a;
}

}  // namespace

template <sparse::Ring R>
Status EagerMethod<R>::apply(const ops::Operation& operation) {
  if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
    return take_back(undo->steps);
  }
  Status status = construct(operation);
  if (status) {
    done_.push_back(operation);
  }
  return status;
}

template <sparse::Ring R>
Status EagerMethod<R>::construct(const ops::Operation& operation) {
  if (Status planned = object_.plan(operation); !planned) {
    return planned;
  }
  if (Status possible = check(); !possible) {
    return possible;
  }
  switch (object_.planned().kind()) {
    case ops::StepKind::removal:
      remove_cells();
      break;
    case ops::StepKind::split:
      split_cells();
      break;
    default:
      add_cells();
  }
  return Done{};
}

template <sparse::Ring R>
Status EagerMethod<R>::check() const {
  const ops::StepKind kind = object_.planned().kind();
  if (kind == ops::StepKind::product || kind == ops::StepKind::lazy_cone) {
    return Error{Errc::refused, "the eager method makes no products: they are no exact sequences"};
  }
  if (kind == ops::StepKind::deletion || kind == ops::StepKind::replacement) {
    return Error{Errc::refused, "the eager method takes no cells away"};
  }
  if (keep_ == Keep::small_only && kind == ops::StepKind::split) {
    return Error{Errc::refused, "splitting cells needs the maps gS and hS, which are not kept"};
  }
  return Done{};
}

template <sparse::Ring R>
Status EagerMethod<R>::take_back(std::uint64_t steps) {
  const std::uint64_t before = object_.steps().size();
  if (Status status = object_.take_back(steps); !status) {
    return status;
  }
  done_.resize(before - steps);
  const Status emptied = object_.take_back(done_.size());
  sparse::expects(emptied.has_value(), "as many steps were done as are remembered");
  touched_before_undo_ += equivalence_.entries_touched();
  equivalence_ = EagerEquivalence<R>(ring_, keep_);
  for (const ops::Operation& operation : done_) {
    const Status again = construct(operation);
    sparse::expects(again.has_value(), "what was done once can be done again");
  }
  return Done{};
}

template <sparse::Ring R>
void EagerMethod<R>::add_cells() {
  object_.carry_out();
  const ops::Plan& plan = object_.planned();
  const ops::Structure& structure = object_.structure();
  const ops::Moment now = structure.now();
  std::vector<CellId> cells;
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    cells.push_back(plan.first + k);
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [&](CellId a, CellId b) { return structure.dimension(a) < structure.dimension(b); });
  for (const CellId cell : cells) {
    equivalence_.add_cell(cell, structure.dimension(cell), boundary(cell, now));
  }
}

template <sparse::Ring R>
void EagerMethod<R>::remove_cells() {
  const ops::Structure& structure = object_.structure();
  std::map<CellId, Index> positions;
  std::set<CellId> touched;  // cells that have a removed one as a face
  std::vector<CellId> removed;
  for (const ops::Merge& merge : object_.planned().merges) {
    positions.emplace(merge.removed, static_cast<Index>(removed.size()));
    removed.push_back(merge.removed);
    const std::vector<CellId> around = cofaces(structure, merge.removed);
    touched.insert(around.begin(), around.end());
  }
  const ops::Moment before = structure.now();
  object_.carry_out();
  const auto after = structure.now();
  using Removed = typename EagerEquivalence<R>::Removed;
  std::vector<Removed> list;
  for (const CellId x : removed) {
    Removed& entry = list.emplace_back(Removed{x, structure.dimension(x), {}, {}});
    Terms change = boundary(x, before);  // of x - j(x): r is -1 on removed cells
    if (const auto [survivor, sign] = structure.forest().find_oriented_at(x, after.links); survivor != ops::none) {
      entry.becomes = {{survivor, ring_.from(sign)}};
      sparse::add_multiple<R>(ring_, change, ring_.from(-sign), boundary(survivor, before));
    }
    entry.boundary = restricted(ring_, change, positions);
  }
  typename EagerEquivalence<R>::Columns chi;
  for (const CellId c : touched) {
    if (!positions.contains(c)) {
      chi.emplace_back(c, difference(ring_, Terms{}, restricted(ring_, boundary(c, before), positions)));
    }
  }
  equivalence_.remove_cells(list, chi);
}

template <sparse::Ring R>
void EagerMethod<R>::split_cells() {
  object_.carry_out();
  const ops::Plan& plan = object_.planned();
  const ops::Structure& structure = object_.structure();
  const ops::Moment now = structure.now();
  std::map<CellId, Index> positions;
  for (Index k = 0; k < plan.sources.size(); ++k) {
    positions.emplace(plan.first + k, k);
  }
  using Copy = typename EagerEquivalence<R>::Copy;
  std::vector<Copy> copies;
  for (Index k = 0; k < plan.sources.size(); ++k) {
    const CellId copy = plan.first + k, source = plan.sources[k];
    const Terms change = difference(ring_, boundary(copy, now), boundary(source, now));
    copies.push_back({copy, source, structure.dimension(copy), restricted(ring_, change, positions)});
  }
  std::set<CellId> moved;
  for (const ops::Move& move : plan.moves) {
    moved.insert(move.cell);
  }
  typename EagerEquivalence<R>::Columns chi;
  for (const CellId c : moved) {
    chi.emplace_back(c, restricted(ring_, boundary(c, now), positions));
  }
  equivalence_.split_cells(copies, chi);
}

template <sparse::Ring R>
auto EagerMethod<R>::boundary(CellId cell, const ops::Moment& moment) const -> Terms {
  sparse::RawTerms<R> terms;
  object_.structure().faces().for_each_at(cell, moment, [&](CellId face, int sign) {
    terms.push_back({face, ring_.from(sign)});
  });
  return std::move(terms).normal(ring_);
}

template <sparse::Ring R>
std::vector<std::pair<std::string, std::uint64_t>> EagerMethod<R>::counts() const {
  return {{"entries_touched", touched_before_undo_ + equivalence_.entries_touched()},
          {"entries_held", equivalence_.entries_held()}};
}

template <sparse::Ring R>
reductions::Equivalence<R> EagerMethod<R>::matrices() const {
  const ops::Structure& structure = object_.structure();
  const ops::Moment now = structure.now();
  const ops::CellBasis basis = ops::cells_at(structure, now);
  return equivalence_.matrices(ops::chain_complex(structure, basis, now, ring_), basis);
}

namespace {

std::unique_ptr<Method> make(const sparse::AnyRing& ring, Keep keep) {
  return std::visit([keep]<sparse::Ring R>(
                        const R& r) -> std::unique_ptr<Method> { return std::make_unique<EagerMethod<R>>(r, keep); },
                    ring);
}

}  // namespace

std::unique_ptr<Method> make_eager_method(const sparse::AnyRing& ring) { return make(ring, Keep::all_maps); }
std::unique_ptr<Method> make_small_eager_method(const sparse::AnyRing& ring) { return make(ring, Keep::small_only); }

#define SESAME_INSTANTIATE(R) template class EagerMethod<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools
