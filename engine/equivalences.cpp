#include "engine/equivalences.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "engine/live_equivalence.hpp"
#include "engine/log.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t many = HomologyTracker::unlimited / 1024;  ///< sums and multiples of less do not overflow

/// The terms that a step may cost when the object has so many cells.
std::uint64_t budget_of(std::span<const std::uint64_t> counts, const RebasePolicy& policy) {
  std::uint64_t faces = 0;
  for (std::size_t p = 0; p < counts.size(); ++p) {
    faces += std::min(counts[p], many / 64 / 64) * (p + 2);
  }
  return faces > many / (policy.terms_per_face + 1) ? HomologyTracker::unlimited
                                                    : policy.least_terms + policy.terms_per_face * faces;
}

std::uint64_t cells_of(std::span<const std::uint64_t> counts) {
  std::uint64_t cells = 0;
  for (const std::uint64_t count : counts) {
    cells += std::min(count, many / 64);
  }
  return cells;
}

}  // namespace

Equivalences::Equivalences(const sparse::AnyRing& ring, const ops::Structure& structure, const RebasePolicy& policy)
    : ring_{ring}, structure_{structure}, policy_{policy} {
  parts_.push_back({make_tracker(ring, structure), 0, 0});
}

bool Equivalences::extend(std::uint64_t moves) {
  const std::uint64_t cells = cells_of(structure_.counts());
  const bool is_done_at_once =
      moves > 0 && cells <= policy_.cells_begun_at_once + policy_.cells_per_move * std::min(moves, many);
  const std::uint64_t splits_allowed = is_done_at_once ? 0 : policy_.least_splits + cells / policy_.cells_per_split;
  const std::uint64_t budget = budget_of(structure_.counts(), policy_);
  const std::uint64_t copies = now().copies();
  const std::uint64_t deletions = now().deletions();
  const std::uint64_t deletions_allowed = policy_.least_deletions + cells * policy_.deletions_per_cell;
  const bool is_within_budget = is_done_at_once || now().extend(budget);
  if (is_within_budget && (copies == 0 || copies < splits_allowed) && deletions <= deletions_allowed) {
    return false;
  }
  const auto start = Clock::now();
  std::unique_ptr<HomologyTracker> next = now().afresh();
  parts_.back().cells = cells;
  cells_kept_ += parts_.back().cells;
  begin_part(std::move(next));
  give_up_oldest();
  const auto level = is_done_at_once ? spdlog::level::debug : spdlog::level::info;
  if (rebase_log().should_log(level)) {
    const std::chrono::duration<double, std::micro> took = Clock::now() - start;
    rebase_log().log(level, "begun afresh from {} cells, as {}; took {:.1f} us", cells,
                     is_done_at_once ? "a split of so few is not worth taking in"
                     : is_within_budget
                         ? fmt::format("{} cells were {} since the last time", std::max(copies, deletions),
                                       copies > deletions ? "split" : "removed")
                         : fmt::format("the step would have read more than {} terms", budget),
                     took.count());
  }
  return true;
}

void Equivalences::begin_afresh(const EliminationRecord* record) {
  sparse::expects(parts_.size() == 1 && parts_.back().marks == 0, "who begins afresh remembers nothing");
  parts_.back().tracker = make_tracker_afresh(ring_, structure_, {}, record);
}

std::optional<EliminationRecord> Equivalences::record_afresh() const {
  if (structure_.lazy().families() > 0) {
    return std::nullopt;  // their cells would have to be made
  }
  return make_tracker_afresh(ring_, structure_, {})->record();
}

void Equivalences::push_mark() {
  now().push_mark();
  ++parts_.back().marks;
}

void Equivalences::begin_part(std::unique_ptr<HomologyTracker> tracker) {
  if (parts_.back().tracker != nullptr) {
    done_by_others_ += now().work();
  }
  parts_.push_back({std::move(tracker), 0, 0});
}

/// All but what the policy keeps, and the last that can be resumed.
void Equivalences::give_up_oldest() {
  const std::uint64_t most = policy_.least_cells_kept + policy_.objects_kept * cells_of(structure_.counts());
  for (; cells_kept_ > most && first_kept_ + 2 < parts_.size(); ++first_kept_) {
    give_up(first_kept_);
  }
}

void Equivalences::give_up(std::size_t part) {
  Part& old = parts_[part];
  rebase_log().debug("undo will not go back exactly to an object of {} cells: its equivalence is given up", old.cells);
  const Window& window = old.tracker->window();
  const ops::CellId noted_before = notes_.empty() ? ops::CellId{} : notes_.back().cells.made_since;
  if (window.begin().created >= noted_before + made_for_each_noted * std::max<std::size_t>(window.cells().size(), 1)) {
    notes_.push_back({forgotten_ + part, {window.cells(), window.begin().created, window.begin().asked}});
  }
  cells_kept_ -= old.cells;
  old.tracker.reset();
}

void Equivalences::end_last_part() {
  sparse::expects(parts_.size() > 1, "only what is remembered can be undone");
  if (parts_.back().tracker != nullptr) {
    done_by_others_ += now().work();
  }
  parts_.pop_back();
  while (!notes_.empty() && notes_.back().part >= forgotten_ + parts_.size()) {
    notes_.pop_back();
  }
  if (Part& resumed = parts_.back(); resumed.tracker != nullptr) {
    done_by_others_ -= resumed.tracker->work();
    cells_kept_ -= resumed.cells;
    rebase_log().debug("undo resumes the equivalence before, of {} cells", resumed.cells);
  }
}

void Equivalences::undo(std::uint64_t marks) {
  for (; marks > 0; --marks) {
    while (parts_.back().marks == 0) {
      end_last_part();
    }
    --parts_.back().marks;
    if (parts_.back().tracker != nullptr) {
      now().undo_to_mark();
    }
  }
  first_kept_ = std::min(first_kept_, parts_.size());
  if (parts_.back().tracker == nullptr) {
    begin_part(make_tracker_afresh(ring_, structure_, notes_.empty() ? CellsToLookAt{} : notes_.back().cells));
    first_kept_ = parts_.size() - 1;
    rebase_log().info("begun afresh from {} cells, as undo goes back further than equivalences are kept",
                      cells_of(structure_.counts()));
  }
}

void Equivalences::forget_oldest_mark() {
  sparse::expects(parts_.front().marks > 0, "only what is remembered can be forgotten");
  --parts_.front().marks;
  if (parts_.front().tracker != nullptr) {
    parts_.front().tracker->forget_oldest_mark();
  }
  for (; parts_.front().marks == 0 && parts_.size() > 1; parts_.pop_front()) {
    ++forgotten_;
    if (first_kept_ > 0) {
      --first_kept_;
    } else {
      cells_kept_ -= parts_.front().cells;
    }
  }
  while (notes_.size() > 1 && notes_[1].part <= forgotten_) {
    notes_.pop_front();
  }
}

}  // namespace sesame::engine
