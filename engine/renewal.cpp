#include "engine/renewal.hpp"

#include <spdlog/logger.h>

#include <algorithm>
#include <numeric>

#include "engine/log.hpp"

namespace sesame::engine {
namespace {

// From one successor to the next: so many times the steps that can be undone, once when that one was ended.
constexpr std::uint64_t undoable_between = 8;
constexpr std::uint64_t nodes_of_cell = 8;  // known for each cell that is there
constexpr std::uint64_t least_nodes = 4096;

std::uint64_t sum_of(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::uint64_t nodes_of(const ops::Structure& structure) {
  return std::uint64_t{structure.cells().size()} + ops::number_of(structure.cells().asked());
}

bool have_same_groups(const Homology& one, const Homology& other) {
  return one.betti == other.betti && one.torsion == other.torsion;
}

}  // namespace

bool Renewal::after_step(const LiveObject& object, const ops::Operation& step) {
  if (next_ == nullptr) {
    if (is_time(object)) {
      begin(object);
    }
    return false;
  }
  if (!follows(object, step)) {
    end(object);
    return false;
  }
  return next_->undoable() >= undoable_;
}

std::unique_ptr<LiveObject> Renewal::successor(const LiveObject& object, const Homology& groups) {
  if (!have_same_groups(groups, next_->homology())) {
    rebase_log().error("a successor of the object has other groups, and is dropped");
    end(object);
    return nullptr;
  }
  rebase_log().info("a successor that knows {} cells takes the place of an object that knew {}",
                    nodes_of(next_->structure()), nodes_of(object.structure()));
  return std::move(next_);
}

bool Renewal::is_time(const LiveObject& object) const {
  return object.undoable_here() == object.undoable() && object.applied() >= next_time_ &&
         nodes_of(object.structure()) >=
             least_nodes + nodes_of_cell * std::min(sum_of(object.cells()), UINT64_MAX / 16);
}

void Renewal::end(const LiveObject& object) {
  next_.reset();
  next_time_ = object.applied() + undoable_;
}

void Renewal::begin(const LiveObject& object) {
  begun_ = object.applied();
  next_time_ = begun_ + undoable_between * undoable_;
  next_ = begin_();
  next_->begin_with(object);
}

bool Renewal::follows(const LiveObject& object, const ops::Operation& step) {
  const Result<StepReport> report = next_->apply(step, [](const ops::Operation&) { return Done{}; });
  if (!report) {
    rebase_log().debug("a successor of the object is dropped after {} steps, as it refuses one: {}",
                       object.applied() - begun_, report.error().what);
    return false;
  }
  const bool is_same = next_->applied() == object.applied() && std::ranges::equal(next_->cells(), object.cells());
  if (!is_same) {
    rebase_log().error("a successor of the object has other cells, and is dropped");
  }
  return is_same;
}

}  // namespace sesame::engine
