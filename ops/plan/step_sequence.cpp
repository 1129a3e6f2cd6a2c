#include "ops/plan/step_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ops/plan/double_boundary.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using reductions::ChainComplex;
using reductions::map_by_columns;
using sparse::Index;
using sparse::Matrix;
using sparse::RawTerms;
using sparse::Rest;
using sparse::Ring;
using sparse::Terms;

template <Ring R>
Terms<R, CellId> unit(const R& ring, CellId c) {
  return {{c, ring.one()}};
}

/// The node that a cell of the object is after a step: itself, but for the cells that a lazy cone was taken over.
CellId after_step(const Structure& structure, CellId c, Moment after) {
  const FamilyId family = structure.lazy().consumed_by(c);
  return family < after.families ? structure.lazy().cell(family, LazyPart::base, structure.values().plain(c)) : c;
}

/// The sequence of a subcomplex C0 of C1 and of the rest C2, modulo it: i and r are implicit identities, and only the
/// columns of the rest are stored.
template <Ring R>
StepSequence<R> subcomplex(const Structure& structure, const R& ring, Direction direction, CellBasis part,
                           Moment moment_of_part, CellBasis all, CellBasis rest, Moment moment_of_all) {
  const CellBasis none_stored;
  const auto itself = [&ring](CellId c) { return unit(ring, c); };
  auto i = map_by_columns(ring, part, all, Rest::identity, none_stored, itself);
  auto r = map_by_columns(ring, all, part, Rest::identity, none_stored, itself);
  auto j = map_by_columns(ring, all, rest, Rest::zero, rest, itself);
  auto s = map_by_columns(ring, rest, all, Rest::zero, rest, itself);
  return {direction,
          {chain_complex(structure, part, moment_of_part, ring), chain_complex(structure, all, moment_of_all, ring),
           chain_complex(structure, rest, moment_of_all, ring), std::move(i), std::move(j), std::move(r), std::move(s)},
          std::move(part),
          std::move(all),
          std::move(rest)};
}

template <Ring R>
StepSequence<R> added(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis old_cells = cells_at(structure, before);
  CellBasis all;
  CellBasis fresh;
  std::unordered_map<CellId, CellId> before_step;
  for (const auto& cells : old_cells.generators()) {
    for (const CellId c : cells) {
      const CellId now = after_step(structure, c, after);
      before_step.emplace(now, c);
      all.add(structure.dimension(c), now);
    }
  }
  const CellBasis now_cells = cells_at(structure, after);
  for (const auto& cells : now_cells.generators()) {
    for (const CellId c : cells) {
      if (!before_step.contains(c)) {
        all.add(structure.dimension(c), c);
        fresh.add(structure.dimension(c), c);
      }
    }
  }
  return subcomplex(structure, ring, Direction::backward, std::move(old_cells), before, std::move(all),
                    std::move(fresh), after);
}

/// The sequence in which C0 is spanned by some cells of C1 as differences: i, j and r have a column for each of those,
/// s and the rest of j are identities, and d0 = r d1 i.
template <Ring R, class I, class J>
StepSequence<R> differences(const Structure& structure, const R& ring, Direction direction, CellBasis small,
                            CellBasis all, Moment moment_of_all, CellBasis quotient, Moment moment_of_quotient, I i_of,
                            J j_of, const typename R::Element& r_of) {
  const CellBasis none_stored;
  auto i = map_by_columns(ring, small, all, Rest::zero, small, i_of);
  auto r = map_by_columns(ring, all, small, Rest::zero, small, [&](CellId c) { return Terms<R, CellId>{{c, r_of}}; });
  auto j = map_by_columns(ring, all, quotient, Rest::identity, small, j_of);
  auto s = map_by_columns(ring, quotient, all, Rest::identity, none_stored, [&](CellId c) { return unit(ring, c); });
  ChainComplex<R> c1 = chain_complex(structure, all, moment_of_all, ring);
  std::vector<Matrix<R>> d0;
  for (int p = 0; p < static_cast<int>(small.generators().size()); ++p) {
    d0.push_back(r.at(p - 1) * c1.boundary(p) * i.at(p));
  }
  ChainComplex<R> c0(ring, small.sizes(), std::move(d0));
  return {direction,
          {std::move(c0), std::move(c1), chain_complex(structure, quotient, moment_of_quotient, ring), std::move(i),
           std::move(j), std::move(r), std::move(s)},
          std::move(small),
          std::move(all),
          std::move(quotient)};
}

template <Ring R>
StepSequence<R> removed_cells(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis kept = cells_at(structure, after);
  CellBasis all = kept;
  CellBasis removed;
  for (LinkId link = before.links; link < after.links; ++link) {
    const CellId c = structure.forest().removed(link);
    all.add(structure.dimension(c), c);
    removed.add(structure.dimension(c), c);
  }
  const auto minus_one = ring.negate(ring.one());
  /// The cell that c became, with its orientation, or 0 when that is degenerate.
  const auto became = [&](CellId c) {
    const auto [survivor, sign] = structure.forest().find_oriented_at(c, after.links);
    return survivor == none ? Terms<R, CellId>{} : Terms<R, CellId>{{survivor, ring.from(sign)}};
  };
  const auto i_of = [&](CellId c) {
    RawTerms<R, CellId> terms = became(c);
    terms.push_back({c, minus_one});
    return terms;
  };
  return differences(structure, ring, Direction::forward, removed, all, before, kept, after, i_of, became, minus_one);
}

/// The object after the step is what is left of the one before it modulo the cells that went: a subcomplex.
template <Ring R>
StepSequence<R> deleted_cells(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis kept = cells_at(structure, after);
  CellBasis all = kept;
  CellBasis deleted;
  for (LinkId link = before.links; link < after.links; ++link) {
    const CellId c = structure.forest().removed(link);
    all.add(structure.dimension(c), c);
    deleted.add(structure.dimension(c), c);
  }
  return subcomplex(structure, ring, Direction::kernel, std::move(kept), after, std::move(all), std::move(deleted),
                    before);
}

template <Ring R>
StepSequence<R> split_cells(const Structure& structure, Moment before, Moment after, const R& ring) {
  CellBasis old_cells = cells_at(structure, before);
  CellBasis all = old_cells;
  CellBasis copies;
  for (CellId c = before.created; c < after.created; ++c) {
    if (structure.splits().copy(c) != nullptr) {
      all.add(structure.dimension(c), c);
      copies.add(structure.dimension(c), c);
    }
  }
  const auto source = [&](CellId c) { return structure.splits().copy(c)->source; };
  const auto i_of = [&](CellId c) {
    return RawTerms<R, CellId>{{c, ring.one()}, {source(c), ring.negate(ring.one())}};
  };
  const auto j_of = [&](CellId c) { return unit(ring, source(c)); };
  return differences(structure, ring, Direction::backward, copies, all, after, old_cells, before, i_of, j_of,
                     ring.one());
}

}  // namespace

CellBasis cells_at(const Structure& structure, Moment moment) {
  CellBasis basis;
  structure.lazy().make_all();
  structure.cells().for_each_node([&](CellId c) {
    if (was_current(structure, c, moment)) {
      basis.add(structure.dimension(c), c);
    }
  });
  return basis;
}

namespace {

/// The faces of an abstract simplex should be those on all but one of its vertices, in its order.
std::optional<std::string> broken_vertex_law(const Structure& structure, CellId cell) {
  const AbstractComplex& complex = structure.abstract();
  const auto vertices = complex.vertices(cell);
  const auto faces = structure.faces().of(cell);
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    std::vector<VertexId> opposite(vertices.begin(), vertices.end());
    opposite.erase(opposite.begin() + k);
    const Value face = structure.values().face_of_cell(cell, k);
    if (face.is_degenerate() || face.cell != complex.find(opposite) ||
        face.order != structure.maps().order(places_in(complex.vertices(face.cell), opposite))) {
      return fmt::format("face {} of {} is not the simplex opposite to its vertex {}", k, structure.name(cell), k);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> first_broken_face_law(const Structure& structure, const CellBasis& basis) {
  for (const auto& cells : basis.generators()) {
    for (const CellId c : cells) {
      const bool is_abstract = structure.bodies().kind(structure.body_of(c)).is_abstract;
      if (auto broken = is_abstract ? broken_vertex_law(structure, c) : std::nullopt) {
        return broken;
      }
      if (is_by_boundary(structure.cells().type(c).type)) {
        const CellId left = left_of_double_boundary(
            c, structure.maps(), [&](CellId cell) -> const TypeInfo& { return structure.cells().type(cell); },
            [&](CellId cell, std::uint32_t k) { return structure.values().face_of_cell(cell, k); });
        if (left != none) {
          return fmt::format("{} is left in the boundary of the boundary of {}", structure.name(left),
                             structure.name(c));
        }
      }
      const Value cell = structure.values().of(c);
      for (const FaceLaw& law : structure.cells().type(c).laws) {
        const Value one = structure.values().face(structure.values().face(cell, law.first), law.second);
        const Value other = structure.values().face(structure.values().face(cell, law.other_first), law.other_second);
        if (!(one == (law.other_dart == 0 ? other : structure.maps().seen_from(law.other_dart, other)))) {
          return fmt::format("face {} of face {} of {} is not its face {} of face {}", law.second, law.first,
                             structure.name(c), law.other_second, law.other_first);
        }
      }
    }
  }
  return std::nullopt;
}

template <Ring R>
ChainComplex<R> chain_complex(const Structure& structure, const CellBasis& basis, Moment moment, const R& ring) {
  return reductions::complex_by_columns(ring, basis, [&](CellId cell) {
    RawTerms<R, CellId> terms;
    structure.faces().for_each_at(cell, moment, [&](CellId face, int sign) {
      if (basis.contains(face)) {
        terms.push_back({face, ring.from(sign)});
      }
    });
    return terms;
  });
}

template <Ring R>
std::vector<StepSequence<R>> step_sequences(const Structure& structure, StepKind kind, Moment before, Moment after,
                                            const R& ring) {
  std::vector<StepSequence<R>> sequences;
  switch (kind) {
    case StepKind::removal:
      sparse::expects(before.created == after.created, "cells become others in a step that adds none");
      sequences.push_back(removed_cells(structure, before, after, ring));
      break;
    case StepKind::deletion:
      sequences.push_back(deleted_cells(structure, before, after, ring));
      break;
    case StepKind::replacement: {
      Moment between = after;  // with the new cells and the old ones
      between.links = before.links;
      sequences.push_back(added(structure, before, between, ring));
      sequences.push_back(deleted_cells(structure, between, after, ring));
      break;
    }
    case StepKind::split:
      sequences.push_back(split_cells(structure, before, after, ring));
      break;
    case StepKind::addition:
    case StepKind::lazy_cone:
      sequences.push_back(added(structure, before, after, ring));
      break;
    case StepKind::nothing:
    case StepKind::product:
      break;
  }
  return sequences;
}

#define SESAME_INSTANTIATE(R)                                                                   \
  template ChainComplex<R> chain_complex(const Structure&, const CellBasis&, Moment, const R&); \
  template std::vector<StepSequence<R>> step_sequences(const Structure&, StepKind, Moment, Moment, const R&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::ops
