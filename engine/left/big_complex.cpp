#include "engine/left/big_complex.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::engine {

template <Ring R>
BigComplex<R>::BigComplex(R ring, const Window& window)
    : ring_{ring},
      window_{window},
      structure_{window.structure()},
      generators_{window},
      deletions_{window},
      shifts_{ring, generators_},
      families_{ring, window, shifts_},
      maps_{ring, window, generators_, deletions_, shifts_, families_},
      boundary_(ring, 0, 0) {
  generators_.reserve(window_.cells().size());
  boundary_.reserve(window_.cells().size(), 2 * window_.cells().size());
  for (const CellId cell : window_.cells()) {
    begin_column();
    window_.for_each_first_face(cell, [this](CellId face, int sign) {
      gathered_.push_back({generators_.of(face), ring_.from(sign)});
    });
    append_column(generators_.append_first(cell));
  }
}

// ------------------------------------------------------------------------------------------------------------- growth

template <Ring R>
GeneratorId BigComplex<R>::append_cell(CellId cell) {
  sparse::expects(cell == generators_.cells(), "cells are appended in the order of their creation");
  begin_column();
  window_.for_each_first_face(cell, [this](CellId face, int sign) {
    if (structure_.forest().parent(face) != ops::none) {
      add_to_column(face, sign);
    }
  });
  const GeneratorId generator = generators_.append_cell(cell);
  append_column(generator);
  return generator;
}

template <Ring R>
GeneratorId BigComplex<R>::append_removal(LinkId link) {
  sparse::expects(link == generators_.links(), "removals are appended in the order in which they happened");
  begin_column();
  const CellId removed = structure_.forest().removed(link);
  if (const CellId survivor = structure_.forest().parent(removed); survivor != ops::none) {
    add_to_column(survivor, structure_.forest().sign_of(link));
  }
  add_to_column(removed, -1);
  const GeneratorId generator = generators_.append_removal(link);
  append_column(generator);
  return generator;
}

template <Ring R>
GeneratorId BigComplex<R>::append_of_family(ops::FamilyId family, int degree,
                                            std::span<const sparse::Term<R, GeneratorId>> boundary) {
  begin_column();
  for (const sparse::Term<R, GeneratorId>& term : boundary) {
    gathered_.push_back(term);
  }
  const GeneratorId generator = generators_.append_of_family(family, degree);
  append_column(generator);
  return generator;
}

template <Ring R>
GeneratorId BigComplex<R>::append_copy(CellId copy) {
  sparse::expects(copy == generators_.cells(), "cells are appended in the order of their creation");
  const CellId first = structure_.splits().copy(copy)->moment.created;  // of the copies of this step
  begin_column();
  const CellId source = structure_.splits().copy(copy)->source;
  const auto add = [&](CellId face, int sign) {
    if (face >= first && !ops::is_asked_for(face) && structure_.splits().copy(face) != nullptr) {
      gathered_.push_back({generators_.of(face), ring_.from(sign)});
    }
  };
  for (std::uint32_t k = 0; k < structure_.cells().type(copy).faces.size(); ++k) {
    add(structure_.cells().faces(copy)[k], structure_.faces().sign_as_created(copy, k));
    add(structure_.faces().of(source)[k], -structure_.faces().sign(source, k));
  }
  for (const ops::SplitHistory::Copy* of = window_.copy(copy); of != nullptr; of = window_.copy(of->source)) {
    if (!window_.is_lazy(of->source)) {
      follow(of->source);
    }
  }
  const GeneratorId generator = generators_.append_cell(copy);
  follow(copy);
  append_column(generator);
  return generator;
}

template <Ring R>
void BigComplex<R>::begin_column() {
  gathered_.clear();
  gathered_lazy_.clear();
}

template <Ring R>
void BigComplex<R>::add_to_column(CellId cell, int sign) {
  const auto coefficient = ring_.from(sign);
  maps_.add_g(cell, coefficient, gathered_);
  maps_.add_lazy_part(cell, coefficient, gathered_lazy_);
}

/// Appends the column that has been gathered as the boundary of the last generator.
template <Ring R>
void BigComplex<R>::append_column(GeneratorId generator) {
  gathered_.finish(ring_, column_);
  if (!columns_followed_.empty()) {
    for (const sparse::Term<R, GeneratorId>& term : column_) {
      if (const auto followed = columns_followed_.find(term.index); followed != columns_followed_.end()) {
        followed->second.push_back(generator);
      }
    }
  }
  boundary_.append_rows(1);
  boundary_.append_column(column_);
  entries_appended_ += column_.size();
  if (!gathered_lazy_.empty()) {
    families_.attach(generator, std::move(gathered_lazy_).normal(ring_));
  }
}

// --------------------------------------------------------------------------------------------------- de-identification

template <Ring R>
std::vector<GeneratorId> BigComplex<R>::split(GeneratorId first, ops::MoveRange moves) {
  Changes changes = gains_of_moves(first, moves);
  shift_basis(first, moves, changes);
  for (const auto& [generator, change] : changes) {
    for (const sparse::Term<R, GeneratorId>& term : change) {
      columns_followed_[term.index].push_back(generator);
    }
  }
  return amend(changes);
}

/// Adds what boundaries gain. Returns the generators of those that do.
template <Ring R>
std::vector<GeneratorId> BigComplex<R>::amend(const Changes& changes) {
  std::vector<GeneratorId> changed;
  for (const auto& [generator, change] : changes) {
    if (!change.empty()) {
      if (change.front().index + 1 == size()) {  // of a deletion: it comes below all that is there
        boundary_.extend_column(generator, change);
      } else {
        boundary_.add_to_column(generator, ring_.one(), change);
      }
      entries_appended_ += change.size();
      changed.push_back(generator);
    }
  }
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  return changed;
}

/// What boundaries gain by moves in the basis as it was.
template <Ring R>
typename BigComplex<R>::Changes BigComplex<R>::gains_of_moves(GeneratorId first, ops::MoveRange moves) {
  std::map<CellId, RawTerms<R, GeneratorId>> gathered;  // per cell: what its boundary gains
  for (std::uint32_t number = moves.begin; number < moves.end; ++number) {
    const ops::SplitHistory::MadeMove move = structure_.splits().move(number);
    const int sign = structure_.faces().sign(move.cell, move.slot);
    gathered[move.cell].push_back({generators_.of(move.after), ring_.from(sign)});
  }
  Changes changes;
  typename Families<R>::Gains of_lazy;
  for (auto& [cell, sum] : gathered) {
    const Terms<R, GeneratorId> gain = std::move(sum).normal(ring_);
    if (!gain.empty()) {
      add_gains(cell, gain, first, changes, of_lazy);
    }
  }
  families_.add_gains(of_lazy, changes);
  return changes;
}

/// The boundary of a current cell has gained a chain of copies: so have those of all nodes that it stands for.
template <Ring R>
void BigComplex<R>::add_gains(CellId cell, const Terms<R, GeneratorId>& gain, GeneratorId first, Changes& changes,
                              typename Families<R>::Gains& of_lazy) const {
  const auto add = [&](GeneratorId generator, int sign) {
    if (generator < first) {
      sparse::add_multiple<R>(ring_, changes[generator], ring_.from(sign), gain);
      for (const GeneratorId other : shifts_.with(generator)) {
        sparse::add_multiple<R>(ring_, changes[other], ring_.from(sign), gain);
      }
    }
  };
  window_.for_each_member(cell, [&](CellId node) {
    const int sign = structure_.forest().find_oriented(node).sign;
    if (window_.is_lazy(node)) {
      sparse::add_multiple<R>(ring_, of_lazy[node], ring_.from(sign), gain);
    } else {
      add(generators_.of(node), sign);
    }
    window_.for_each_copy_of(node, [&](CellId copy) { add(generators_.of(copy), -sign); });
    deletions_.for_each_over(node, [&](GeneratorId u, int coefficient) { add(u, -sign * coefficient); });
  });
}

// ----------------------------------------------------------------------------------------------------------- deletion

template <Ring R>
GeneratorId BigComplex<R>::append_deletion(LinkId link) {
  sparse::expects(link == generators_.links(), "removals are appended in the order in which they happened");
  begin_column();
  const GeneratorId generator = generators_.append_deletion(link);
  deletions_.add(generator, link);
  append_column(generator);
  return generator;
}

/// As if the cell had gained the new generator in its boundary.
template <Ring R>
std::vector<GeneratorId> BigComplex<R>::take_away(GeneratorId deletion) {
  const CellId cell = structure_.forest().removed(generators_.link(deletion));
  Changes changes;
  typename Families<R>::Gains of_lazy;
  add_gains(cell, {{deletion, ring_.one()}}, deletion, changes, of_lazy);
  families_.add_gains(of_lazy, changes);
  return amend(changes);
}

// ---------------------------------------------------------------------------------------------------- changes of basis

/// Changes the basis where that saves changing boundaries.
template <Ring R>
void BigComplex<R>::shift_basis(GeneratorId first, ops::MoveRange moves, Changes& changes) {
  MoveSet made;
  std::set<std::pair<CellId, CellId>> candidates;
  for (std::uint32_t number = moves.begin; number < moves.end; ++number) {
    const ops::SplitHistory::MadeMove move = structure_.splits().move(number);
    made.emplace(move.cell, move.slot, move.after);
    if (const CellId before = window_.known(structure_.splits().face_before(number)); !window_.is_lazy(before)) {
      candidates.emplace(before, move.after);
    }
  }
  for (const auto& [node, copy] : candidates) {
    if (moves_wholly(node, copy, made)) {
      add_changes_of_shift(node, copy, first, changes);
      shifts_.shift(node, copy);
    }
  }
}

/// Whether all incidences of a node go to one copy, and it pays to change the basis; a node with very many others is
/// not looked through.
template <Ring R>
bool BigComplex<R>::moves_wholly(CellId node, CellId copy, const MoveSet& moves) const {
  constexpr std::size_t most_others = 64;
  // A place that is glued and split again and again collects generators, or else terms in old boundaries: measured over
  // 100 to 6,000 times at one place, this is where the two cost least together.
  constexpr std::size_t most_generators = 24;
  if (structure_.forest().find_oriented(node).sign < 0) {
    return false;  // the generators would become G - e
  }
  const std::size_t most_places = most_others + 4 * moves.size();
  const auto places = window_.places_of(node, most_places);
  if (places.size() > most_places || shifts_.generators_of(node).size() > most_generators) {
    return false;
  }
  return std::all_of(places.begin(), places.end(), [&](const auto& place) {
    const auto& [owner, slot] = place;
    const CellId cell = structure_.find(owner);
    if (cell == ops::none || moves.contains({cell, slot, copy})) {
      return true;
    }
    // An incidence that moved away before does not count.
    return structure_.is_current(owner) && window_.known(structure_.faces().of(owner)[slot]) != node;
  });
}

/// How boundaries change when G + e takes the place of each generator G of a node, e that of a copy.
template <Ring R>
void BigComplex<R>::add_changes_of_shift(CellId node, CellId copy, GeneratorId first, Changes& changes) const {
  const GeneratorId e = generators_.of(copy);
  const Terms<R, GeneratorId> unit{{e, ring_.one()}};
  const Terms<R, GeneratorId> boundary_of_e = boundary_.column(e);
  for (const GeneratorId generator : shifts_.generators_of(node)) {
    for (const GeneratorId column : columns_with(generator)) {
      if (column < first) {
        const auto coefficient = boundary_.entry(generator, column);
        sparse::add_multiple<R>(ring_, changes[column], ring_.negate(coefficient), unit);
      }
    }
    sparse::add_multiple<R>(ring_, changes[generator], ring_.one(), boundary_of_e);
  }
}

/// The columns that may have an entry at the generator of a cell or copy, and perhaps others, increasing: those of the
/// cells that it was a face of at their creation, of the removals next to it, and those remembered.
template <Ring R>
std::vector<GeneratorId> BigComplex<R>::columns_with(GeneratorId generator) const {
  const CellId node = generators_.cell(generator);
  std::vector<GeneratorId> columns;
  for (const auto& [owner, slot] : window_.places_of(node)) {
    columns.push_back(generators_.of(owner));
  }
  const auto add_link = [&](LinkId link) {
    if (link < generators_.links()) {
      columns.push_back(generators_.of_link(link));
    }
  };
  add_link(structure_.forest().link_of(node));
  window_.for_each_child_link(node, add_link);
  if (const auto followed = columns_followed_.find(generator); followed != columns_followed_.end()) {
    columns.insert(columns.end(), followed->second.begin(), followed->second.end());
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

// --------------------------------------------------------------------------------------------------------- truncation

template <Ring R>
void BigComplex<R>::truncate(const Mark& mark) {
  const GeneratorId size = mark.size();
  for (; changed_.size() > mark.changed; changed_.pop_back()) {
    if (const GeneratorId generator = changed_.back(); generator < size) {
      Terms<R, GeneratorId> column = boundary_.column(generator);
      std::erase_if(column, [size](const sparse::Term<R, GeneratorId>& term) { return term.index >= size; });
      boundary_.set_column(generator, column);
    }
  }
  if (!columns_followed_.empty()) {
    for (GeneratorId generator = size; generator < this->size(); ++generator) {
      columns_followed_.erase(generator);
    }
  }
  shifts_.truncate(mark.shifts, size);
  deletions_.truncate(size);
  families_.truncate(mark.families, size);
  boundary_.truncate(size, size);
  generators_.truncate(mark.generators);
}

#define SESAME_INSTANTIATE(R) template class BigComplex<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
