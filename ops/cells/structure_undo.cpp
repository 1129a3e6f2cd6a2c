// How each kind of event is taken back.
#include "ops/cells/structure.hpp"

namespace sesame::ops {

void Structure::undo_last_family() {
  const LazyFamily& family = lazy_.family(lazy_.families() - 1);
  add_counts(family.counts, counts_, true);
  bodies_.undo_family(family.body, family.bodies, family.counts,
                      [this](std::span<const std::uint64_t> counts) { add_counts(counts, counts_, false); });
  if (family.kind == FamilyKind::cone) {
    cones_.pop_back();
  }
  lazy_.pop_family();
}

void Structure::undo_last_cell() {
  const CellId c = cells_.size() - 1;
  coface_index_.on_undo_of_cell(c);
  count(c, -1);
  directory_.forget_order(c);
  directory_.pop_back_of(c);
  bodies_.drop_cell(cells_.body(c), c);
  forest_.pop_back(c);
  cells_.pop_back();
}

void Structure::undo_last_asked() {
  forest_.pop_back(cells_.asked() - 1);
  cells_.pop_asked();
}

void Structure::undo_last_copy() {
  splits_.undo_last_copy();
  undo_last_cell();
}

void Structure::undo_last_removal() {
  const CellId current = forest_.undo_last_link();
  count(current, 1);
  coface_index_.on_undo_of_removal(current);
}

void Structure::undo_last_move() {
  const std::uint32_t last = splits_.moves() - 1;
  const CellId cell = splits_.move(last).cell, before = splits_.face_before(last);
  splits_.undo_last_move();
  coface_index_.on_new_face(cell, before);
}

void Structure::undo_last_event() {
  switch (journal_.pop()) {
    case EventKind::cell:
      return undo_last_cell();
    case EventKind::copy:
      return undo_last_copy();
    case EventKind::degenerate:
      values_.undo_degenerate(cells_.asked() - 1);
      return undo_last_asked();
    case EventKind::lazy:
      lazy_.undo_last_cell();
      return undo_last_asked();
    case EventKind::expansion:
      return lazy_.undo_last_expansion();
    case EventKind::removal:
    case EventKind::deletion:
      return undo_last_removal();
    case EventKind::move:
      return undo_last_move();
    case EventKind::family:
      return undo_last_family();
    case EventKind::cone:
      return cones_.pop_back();
    case EventKind::name:
      return directory_.pop_back();
    case EventKind::body:
      return bodies_.undo_last();
    case EventKind::union_of_bodies:
      return bodies_.undo_last_union();
    case EventKind::body_kind:
      return bodies_.undo_last_kind_change();
    case EventKind::simplicial:
      return abstract_.truncate(abstract_.mark() - 1);
    case EventKind::darts:
      return darts_.undo_last_event();
  }
}

void Structure::truncate(Journal::Position position) {
  while (journal_.end() > position) {
    undo_last_event();
  }
}

}  // namespace sesame::ops
