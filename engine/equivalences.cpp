#include "engine/equivalences.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

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

/// The splits after which an object of so many cells is begun afresh.
std::uint64_t splits_of(std::span<const std::uint64_t> counts, const RebasePolicy& policy) {
  std::uint64_t cells = 0;
  for (const std::uint64_t count : counts) {
    cells += std::min(count, many / 64);
  }
  return policy.least_splits + cells / policy.cells_per_split;
}

}  // namespace

Equivalences::Equivalences(std::unique_ptr<HomologyTracker> first, const RebasePolicy& policy) : policy_{policy} {
  trackers_.push_back(std::move(first));
}

bool Equivalences::extend(std::span<const std::uint64_t> counts) {
  if (now().extend(budget_of(counts, policy_)) &&
      (now().copies() == 0 || now().copies() < splits_of(counts, policy_))) {
    return false;
  }
  std::unique_ptr<HomologyTracker> next = now().afresh();
  done_by_others_ += now().work();
  trackers_.push_back(std::move(next));
  return true;
}

void Equivalences::undo_to_mark() {
  if (now().marks() == 0) {
    sparse::expects(trackers_.size() > 1, "only what is remembered can be undone");
    done_by_others_ += now().work();
    trackers_.pop_back();
    done_by_others_ -= now().work();
  }
  now().undo_to_mark();
}

}  // namespace sesame::engine
