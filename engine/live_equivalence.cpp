#include "engine/live_equivalence.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/audit.hpp"
#include "engine/left/new_family.hpp"
#include "engine/left/small_of_body.hpp"
#include "ops/cells/cell_order.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;

namespace {

/// The cells of the object, lazy ones written out, by dimension and age. Cost: those that have to be looked at, and the
/// families.
std::vector<CellId> current_cells(const Structure& structure, std::span<const CellId> among, CellId made_since,
                                  CellId asked_since) {
  structure.lazy().make_all();
  const bool has_families = structure.lazy().families() > 0;
  std::vector<CellId> cells;
  cells.reserve(among.size() + (structure.cells().size() - made_since));
  const auto add = [&](CellId c) {
    if (structure.is_current(c) && !(has_families && structure.lazy().is_consumed(c))) {
      cells.push_back(c);
    }
  };
  std::for_each(among.begin(), among.end(), add);
  for (CellId c = made_since; c < structure.cells().size(); ++c) {
    add(c);
  }
  if (has_families) {  // else nodes that were asked for are degenerate
    for (CellId c = asked_since; c < structure.cells().asked(); ++c) {
      add(c);
    }
  }
  ops::sort_by_dimension_and_age(structure, cells);
  return cells;
}

}  // namespace

template <Ring R>
LiveEquivalence<R>::LiveEquivalence(R ring, Window window, const EliminationRecord* record)
    : ring_{ring},
      window_{std::move(window)},
      structure_{window_.structure()},
      big_{ring, window_},
      rewriter_{ring, big_.boundary()},
      frozen_{ring, big_, rewriter_},
      chains_{ring, structure_, big_.maps(), rewriter_},
      classes_{ring, big_, rewriter_, chains_},
      position_{window_.start()} {
  rewriter_.reserve(big_.size());
  if (record != nullptr) {
    std::vector<int> degrees;
    degrees.reserve(big_.size());
    for (GeneratorId generator = 0; generator < big_.size(); ++generator) {
      degrees.push_back(big_.degree(generator));
    }
    rewriter_.append_recorded(degrees, *record);
  } else {
    for (GeneratorId generator = 0; generator < big_.size(); ++generator) {
      rewriter_.append(big_.degree(generator));
    }
  }
  take_in_step();
}

template <Ring R>
std::unique_ptr<HomologyTracker> LiveEquivalence<R>::afresh() const {
  const ops::Moment& begin = window_.begin();
  return std::make_unique<LiveEquivalence>(
      ring_, Window{structure_, current_cells(structure_, window_.cells(), begin.created, begin.asked)});
}

// ------------------------------------------------------------------------------------------------------- maintenance

template <Ring R>
bool LiveEquivalence<R>::extend(std::uint64_t budget) {
  classes_.forget_groups();
  rewriter_.set_budget(window_.has_changes() ? budget : unlimited);
  try {
    take_in_step();
  } catch (const OverBudget&) {
    rewriter_.drop_work();
    rewriter_.set_budget(unlimited);
    go_back_to(unpacked(marks_.last()));
    return false;
  }
  rewriter_.set_budget(unlimited);
  return true;
}

/// Reads the journal from where it has come to.
template <Ring R>
void LiveEquivalence<R>::take_in_step() {
  const RuleId time = rewriter_.rules();
  GeneratorId first_copy = ops::none;
  std::uint32_t first_move = ops::none, last_move = ops::none;
  const auto take_in = [&](const ops::Journal::Run& run) {
    switch (run.kind) {
      case ops::EventKind::cell:
        for (CellId c{run.first}; c < run.first + run.count; ++c) {
          rewriter_.append(big_.degree(big_.append_cell(c)));
        }
        break;
      case ops::EventKind::copy:
        for (CellId c{run.first}; c < run.first + run.count; ++c) {
          const GeneratorId copy = big_.append_copy(c);
          first_copy = std::min(first_copy, copy);
          rewriter_.append(big_.degree(copy));
        }
        break;
      case ops::EventKind::move:  // looking at a face may have made nodes between two of them
        first_move = std::min(first_move, run.first);
        last_move = run.first + run.count - 1;
        break;
      case ops::EventKind::family:
        append_family(ops::FamilyId{run.first}, structure_, frozen_, big_, rewriter_);
        break;
      case ops::EventKind::removal:
        for (LinkId link{run.first}; link < run.first + run.count; ++link) {
          rewriter_.append(big_.degree(big_.append_removal(link)));
        }
        break;
      case ops::EventKind::deletion:
        for (LinkId link{run.first}; link < run.first + run.count; ++link) {
          take_away(link);
        }
        break;
      default:  // nothing that homology knows of
        break;
    }
  };
  const ops::Journal& journal = structure_.journal();
  while (position_ < journal.end()) {  // looking at cells may make others
    const ops::Journal::Position begin = std::exchange(position_, journal.end());
    journal.for_each_since(begin, take_in);
  }
  if (first_move != ops::none) {
    expects(first_copy != ops::none, "incidences move to copies made in the same step");
    const std::vector<GeneratorId> changed = big_.split(first_copy, {first_move, last_move + 1});
    if (!changed.empty()) {
      rewriter_.perturb(time, first_copy, changed);
    }
  }
}

template <Ring R>
void LiveEquivalence<R>::take_away(LinkId link) {
  const RuleId time = rewriter_.rules();
  const GeneratorId generator = big_.append_deletion(link);
  rewriter_.append(big_.degree(generator));
  rewriter_.take_away(time, generator, big_.take_away(generator));
}

template <Ring R>
typename LiveEquivalence<R>::Mark LiveEquivalence<R>::mark() {
  return {position_, big_.mark(), frozen_.mark(), rewriter_.mark()};
}

template <Ring R>
void LiveEquivalence<R>::push_mark() {
  marks_.push(packed(mark()));
}

template <Ring R>
typename LiveEquivalence<R>::PackedMark LiveEquivalence<R>::packed(const Mark& mark) {
  const auto& [position, big, frozen, rewriter] = mark;
  return {position,      big.generators.generators, big.generators.cells, big.generators.links,   big.changed,
          big.shifts,    big.families.families,     big.families.gained,  frozen.images,          frozen.homotopies,
          frozen.lifts,  rewriter.rules.symbols,    rewriter.rules.rules, rewriter.perturbations, rewriter.core,
          rewriter.memos};
}

template <Ring R>
typename LiveEquivalence<R>::Mark LiveEquivalence<R>::unpacked(const PackedMark& mark) {
  return {mark[0],
          {{GeneratorId{mark[1]}, CellId{mark[2]}, LinkId{mark[3]}}, mark[4], mark[5], {mark[6], mark[7]}},
          {mark[8], mark[9], mark[10]},
          {{Symbol{mark[11]}, RuleId{mark[12]}}, mark[13], mark[14], mark[15]}};
}

template <Ring R>
void LiveEquivalence<R>::undo_to_mark() {
  go_back_to(unpacked(marks_.pop()));
}

template <Ring R>
void LiveEquivalence<R>::forget_oldest_mark() {
  marks_.forget_oldest();
  rewriter_.forget_before(marks_.empty() ? rewriter_.mark() : unpacked(marks_.oldest()).rewriter);
}

template <Ring R>
void LiveEquivalence<R>::go_back_to(const Mark& mark) {
  classes_.forget_groups();
  rewriter_.undo(mark.rewriter);
  big_.truncate(mark.big);
  frozen_.truncate(mark.frozen);
  position_ = mark.position;
}

template <Ring R>
std::uint64_t LiveEquivalence<R>::small_of(ops::BodyId body) const {
  return small_of_body(body, structure_, big_, rewriter_).size();
}

template <Ring R>
std::vector<Lifetime> LiveEquivalence<R>::lifetimes() const {
  expects(R::is_field, "classes live and die over fields");
  std::vector<GeneratorId> before;  // per step: the generators that there were
  marks_.for_each([&](const PackedMark& mark) { before.push_back(unpacked(mark).big.size()); });
  const auto step_of = [&](GeneratorId generator) {
    return static_cast<std::size_t>(std::upper_bound(before.begin(), before.end(), generator) - before.begin()) - 1;
  };
  std::vector<Lifetime> lifetimes;
  rewriter_.for_each_pair([&](GeneratorId a, GeneratorId b) {
    lifetimes.push_back({big_.degree(a), step_of(a), step_of(b)});
  });
  rewriter_.for_each_small([&](Symbol x) {
    lifetimes.push_back({rewriter_.degree(x), step_of(rewriter_.generator_in(x)), Lifetime::never});
  });
  return lifetimes;
}

template <Ring R>
std::optional<std::string> LiveEquivalence<R>::first_defect(ops::StepKind last_step, ops::Moment before_it) {
  return engine::first_defect(*this, last_step, before_it);
}

template <Ring R>
reductions::Equivalence<R> LiveEquivalence<R>::matrices() {
  return matrices_of(*this);
}

namespace {

std::unique_ptr<HomologyTracker> make_tracker_of(const sparse::AnyRing& ring, Window window,
                                                 const EliminationRecord* record = nullptr) {
  return std::visit(
      [&]<class R>(const R& k) -> std::unique_ptr<HomologyTracker> {
        return std::make_unique<LiveEquivalence<R>>(k, std::move(window), record);
      },
      ring);
}

}  // namespace

std::unique_ptr<HomologyTracker> make_tracker(const sparse::AnyRing& ring, const Structure& structure) {
  return make_tracker_of(ring, Window{structure});
}

std::unique_ptr<HomologyTracker> make_tracker_afresh(const sparse::AnyRing& ring, const Structure& structure,
                                                     const CellsToLookAt& among, const EliminationRecord* record) {
  return make_tracker_of(
      ring, Window{structure, current_cells(structure, among.cells, among.made_since, among.asked_since)}, record);
}

#define SESAME_INSTANTIATE(R) template class LiveEquivalence<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
