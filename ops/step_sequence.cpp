#include "ops/step_sequence.hpp"

#include <algorithm>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using reductions::ChainComplex;
using reductions::GradedMap;
using sparse::Index;
using sparse::Matrix;
using sparse::Rest;
using sparse::Ring;
using sparse::Terms;

bool was_current(const Structure& structure, CellId c, Moment moment) {
  return c < moment.created && structure.find_at(c, moment.links) == c;
}

Index size_at(const std::vector<Index>& sizes, std::size_t p) { return p < sizes.size() ? sizes[p] : 0; }

/// A map of degree 0 whose columns are `rest` but for those that `column(p, cell)` gives for the cells of `stored`.
template <Ring R, class Column>
GradedMap<R> map_with_columns(const R& ring, const CellBasis& source, const CellBasis& target, Rest rest,
                              const CellBasis& stored, Column column) {
  const std::vector<Index> from = source.sizes();
  const std::vector<Index> to = target.sizes();
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < from.size(); ++p) {
    Matrix<R> part(ring, size_at(to, p), from[p], rest);
    if (p < stored.cells().size()) {
      for (const CellId cell : stored.cells()[p]) {
        Terms<R> terms = column(cell);
        sparse::normalize(ring, terms);
        part.set_column(source.index(cell), terms);
      }
    }
    parts.push_back(std::move(part));
  }
  return GradedMap<R>(ring, 0, from, to, std::move(parts));
}

template <Ring R>
StepSequence<R> added(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis old_cells = cells_at(structure, before);
  CellBasis all = old_cells;
  CellBasis fresh;
  for (CellId c = before.created; c < after.created; ++c) {
    all.add(structure.dimension(c), c);
    fresh.add(structure.dimension(c), c);
  }
  const CellBasis none_stored;
  const auto itself_in = [&ring](const CellBasis& basis) {
    return [&ring, &basis](CellId c) { return Terms<R>{{basis.index(c), ring.one()}}; };
  };
  auto i = map_with_columns(ring, old_cells, all, Rest::identity, none_stored, itself_in(all));
  auto r = map_with_columns(ring, all, old_cells, Rest::identity, none_stored, itself_in(all));
  auto j = map_with_columns(ring, all, fresh, Rest::zero, fresh, itself_in(fresh));
  auto s = map_with_columns(ring, fresh, all, Rest::zero, fresh, itself_in(all));
  return {Direction::backward,
          {chain_complex(structure, old_cells, before, ring), chain_complex(structure, all, after, ring),
           chain_complex(structure, fresh, after, ring), std::move(i), std::move(j), std::move(r), std::move(s)},
          std::move(old_cells),
          std::move(all),
          std::move(fresh)};
}

template <Ring R>
StepSequence<R> identified(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis kept = cells_at(structure, after);
  CellBasis all = kept;
  CellBasis removed;
  for (LinkId link = before.links; link < after.links; ++link) {
    const CellId c = structure.removed(link);
    all.add(structure.dimension(c), c);
    removed.add(structure.dimension(c), c);
  }
  const auto survivor = [&](CellId c) { return structure.find_at(c, after.links); };
  const auto minus_one = ring.negate(ring.one());
  const CellBasis none_stored;
  auto i = map_with_columns(ring, removed, all, Rest::zero, removed, [&](CellId c) {
    return Terms<R>{{all.index(survivor(c)), ring.one()}, {all.index(c), minus_one}};
  });
  auto r = map_with_columns(ring, all, removed, Rest::zero, removed, [&](CellId c) {
    return Terms<R>{{removed.index(c), minus_one}};
  });
  auto j = map_with_columns(ring, all, kept, Rest::identity, removed, [&](CellId c) {
    return Terms<R>{{kept.index(survivor(c)), ring.one()}};
  });
  auto s = map_with_columns(ring, kept, all, Rest::identity, none_stored, [&](CellId c) {
    return Terms<R>{{all.index(c), ring.one()}};
  });
  ChainComplex<R> c1 = chain_complex(structure, all, before, ring);
  std::vector<Matrix<R>> d0;
  for (int p = 0; p < static_cast<int>(removed.cells().size()); ++p) {
    d0.push_back(r.at(p - 1) * c1.boundary(p) * i.at(p));
  }
  ChainComplex<R> c0(ring, removed.sizes(), std::move(d0));
  return {Direction::forward,
          {std::move(c0), std::move(c1), chain_complex(structure, kept, after, ring), std::move(i), std::move(j),
           std::move(r), std::move(s)},
          std::move(removed),
          std::move(all),
          std::move(kept)};
}

}  // namespace

void CellBasis::add(int degree, CellId cell) {
  const auto p = static_cast<std::size_t>(degree);
  if (p >= cells_.size()) {
    cells_.resize(p + 1);
  }
  index_.emplace(cell, static_cast<Index>(cells_[p].size()));
  cells_[p].push_back(cell);
}

std::vector<Index> CellBasis::sizes() const {
  std::vector<Index> sizes;
  for (const auto& cells : cells_) {
    sizes.push_back(static_cast<Index>(cells.size()));
  }
  return sizes;
}

CellBasis cells_at(const Structure& structure, Moment moment) {
  CellBasis basis;
  for (CellId c = 0; c < moment.created; ++c) {
    if (was_current(structure, c, moment)) {
      basis.add(structure.dimension(c), c);
    }
  }
  return basis;
}

template <Ring R>
ChainComplex<R> chain_complex(const Structure& structure, const CellBasis& basis, Moment moment, const R& ring) {
  const std::vector<Index> sizes = basis.sizes();
  std::vector<Matrix<R>> boundaries;
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    Matrix<R> boundary(ring, p == 0 ? 0 : sizes[p - 1], 0);
    for (const CellId cell : basis.cells()[p]) {
      Terms<R> terms;
      const auto faces = structure.faces_as_created(cell);
      for (std::size_t k = 0; k < faces.size(); ++k) {
        const CellId face = structure.find_at(faces[k], moment.links);
        if (basis.contains(face)) {
          terms.push_back({basis.index(face), ring.from(structure.type(cell).faces[k].sign)});
        }
      }
      sparse::normalize(ring, terms);
      boundary.append_column(terms);
    }
    boundaries.push_back(std::move(boundary));
  }
  return ChainComplex<R>(ring, sizes, std::move(boundaries));
}

template <Ring R>
StepSequence<R> step_sequence(const Structure& structure, Moment before, Moment after, const R& ring) {
  const bool adds = after.created > before.created;
  const bool removes = after.links > before.links;
  sparse::expects(!(adds && removes), "a step adds cells or removes cells, not both");
  return removes ? identified(structure, before, after, ring) : added(structure, before, after, ring);
}

#define SESAME_INSTANTIATE(R)                                                                   \
  template ChainComplex<R> chain_complex(const Structure&, const CellBasis&, Moment, const R&); \
  template StepSequence<R> step_sequence(const Structure&, Moment, Moment, const R&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::ops
