#include "engine/integral_classes.hpp"

#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;

void IntegralClasses::reach(std::size_t dimension) {
  if (levels_.size() <= dimension) {
    levels_.resize(dimension + 1);
  }
}

void IntegralClasses::begin_sum(std::size_t dimension) {
  dimension_ = dimension;
  levels_[dimension].space.clear_sum();
  if (core_) {
    core_->sum.clear();
  }
}

void IntegralClasses::add(ClassRef ref, bool is_negative) {
  if (ref.is_zero()) {
    return;
  }
  Level& level = levels_[dimension_];
  is_negative ^= ref.is_negative();
  if (!core_ || ref.node() < level.space.nodes()) {
    level.space.add_to_sum(ref.node(), is_negative);
    return;
  }
  const std::uint32_t what = level.later[ref.node() - level.space.nodes()];
  if ((what & kept_bit) == 0) {
    core_->sum.push_back({GeneratorId{what}, is_negative ? -1 : 1});
    return;
  }
  for (const auto& [generator, coefficient] : core_->kept[what & ~kept_bit]) {
    core_->sum.push_back({generator, is_negative ? -coefficient : coefficient});
  }
}

ClassRef IntegralClasses::append() {
  if (!core_) {
    ClassSpace<Z>& space = levels_[dimension_].space;
    if (space.sum_is_zero()) {
      return ClassRef{levels_[dimension_ + 1].space.add(0)};
    }
    if (space.kill_sum() != ClassSpace<Z>::no_node) {
      return {};
    }
    begin_core();
  }
  return append_to_core();
}

ClassRef IntegralClasses::append_vertex() {
  return core_ ? add_later(0, core_->append(0, {})) : ClassRef{levels_[0].space.add(0)};
}

ClassRef IntegralClasses::append_to_core() {
  return add_later(dimension_ + 1, core_->append(dimension_ + 1, core_sum()));
}

ClassRef IntegralClasses::keep_sum() {
  if (!core_) {
    ClassSpace<Z>& space = levels_[dimension_].space;
    return space.sum_is_zero() ? ClassRef{} : ClassRef{space.keep_sum()};
  }
  const Terms<Z, GeneratorId>& sum = core_sum();
  if (sum.empty()) {
    return {};
  }
  expects(core_->kept.size() < kept_bit, "fewer than 2^31 sums are kept");
  core_->kept.push_back(sum);
  return add_later(dimension_, kept_bit | static_cast<std::uint32_t>(core_->kept.size() - 1));
}

void IntegralClasses::retire(std::size_t dimension, std::vector<ClassRef>& refs) {
  ClassSpace<Z>& space = levels_[dimension].space;
  if (!core_ && space.nodes() > 2 * (space.alive() + refs.size()) + most_idle) {
    space.retire(refs);
  }
}

// ---- the core

GeneratorId IntegralClasses::Core::append(std::size_t dimension, const Terms<Z, GeneratorId>& boundary_of_it) {
  const GeneratorId generator{boundary.columns()};
  expects(generator < kept_bit, "fewer than 2^31 generators");
  boundary.append_rows(1);
  boundary.append_column(boundary_of_it);
  rewriter.append(static_cast<int>(dimension));
  return generator;
}

/// The classes alive become the generators of a big complex. The sum under construction stays what it is.
void IntegralClasses::begin_core() {
  core_ = std::make_unique<Core>();
  for (std::size_t d = 0; d < levels_.size(); ++d) {
    Level& level = levels_[d];
    level.generators.resize(level.space.nodes(), ops::none);
    for (Node node = 0; node < level.space.nodes(); ++node) {
      if (level.space.is_alive(node)) {
        level.generators[node] = core_->append(d, {});
      }
    }
  }
}

/// The sum under construction, in generators.
const Terms<sparse::Integers, GeneratorId>& IntegralClasses::core_sum() {
  const Level& level = levels_[dimension_];
  for (const ClassTerm<Z>& term : level.space.sum()) {
    core_->sum.push_back({level.generators[term.node], term.coefficient});
  }
  core_->sum.finish(Z{}, core_->column);
  return core_->column;
}

ClassRef IntegralClasses::add_later(std::size_t dimension, std::uint32_t what) {
  Level& level = levels_[dimension];
  const std::size_t node = level.space.nodes() + level.later.size();
  expects(node < ClassRef::most_nodes, "fewer than 2^31 classes are held");
  level.later.push_back(what);
  return ClassRef{static_cast<std::uint32_t>(node)};
}

// ---- the groups

void IntegralClasses::homology(std::size_t dimensions, Homology& homology) {
  const auto at = [](const auto& counts, std::size_t p) -> std::int64_t { return p < counts.size() ? counts[p] : 0; };
  homology.betti.resize(dimensions);
  homology.torsion.resize(dimensions);
  if (!core_) {
    for (std::size_t p = 0; p < dimensions; ++p) {
      homology.betti[p] = p < levels_.size() ? static_cast<std::int64_t>(levels_[p].space.alive()) : 0;
    }
    return;
  }
  const Groups<Z>::Torsion& torsion = core_->groups.torsion();
  const std::vector<std::uint32_t>& small = core_->rewriter.small_counts();
  for (std::size_t p = 0; p < dimensions; ++p) {
    homology.betti[p] = at(small, p) - at(torsion.ranks, p) - at(torsion.ranks, p + 1);
    if (p < torsion.coefficients.size()) {
      homology.torsion[p] = torsion.coefficients[p];
    } else {
      homology.torsion[p].clear();
    }
  }
}

}  // namespace sesame::engine
