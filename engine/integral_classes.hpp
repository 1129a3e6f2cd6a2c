/// \file
/// The homology classes of all dimensions along a tower, over Z.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/groups.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/towers/class_space.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// What a ClassSpace is for one dimension over a field, for all of them over Z.
///
/// As long as each class dies by a unit the reduction is as over a field, and there is a ClassSpace for each dimension.
/// The first boundary that has none begins the *core*: the classes alive at this moment are a small complex with
/// boundary 0, and that is a big complex as good as any. From then on generators are appended to it, and a Rewriter
/// reduces it further, with the torsion that there is. What was a class before stays a sum of the classes of that
/// moment.
///
/// Cost: before the core as over a field; then that of the Rewriter, and memory grows with all that happens.
class IntegralClasses {
 public:
  /// Makes room for dimensions up to one.
  void reach(std::size_t dimension);
  [[nodiscard]] std::size_t dimensions() const { return levels_.size(); }

  // ---- one sum of classes of one dimension at a time is under construction
  void begin_sum(std::size_t dimension);
  void add(ClassRef ref, bool is_negative);
  /// Appends a generator one dimension higher, whose boundary is the sum. Returns its class: 0 when it killed one.
  ClassRef append();
  /// A class that is the sum.
  [[nodiscard]] ClassRef keep_sum();
  /// Appends a generator of dimension 0. Returns its class.
  ClassRef append_vertex();

  /// Begins to load what `add` will read of a class.
  void prefetch(std::size_t dimension, ClassRef ref) const {
    if (!core_ && !ref.is_zero()) {
      levels_[dimension].space.prefetch(ref.node());
    }
  }
  /// Forgets classes of a dimension that nobody refers to when they are many; `refs` are all references that there are.
  void retire(std::size_t dimension, std::vector<ClassRef>& refs);

  /// Whether there was a boundary without a unit.
  [[nodiscard]] bool has_core() const { return core_ != nullptr; }
  /// The groups of the dimensions below `dimensions`, into `homology`. Cost: where the core has changed that of
  /// Groups::torsion.
  void homology(std::size_t dimensions, Homology& homology);

 private:
  using Z = sparse::Integers;
  using Node = ClassSpace<Z>::Node;

  struct Level {
    ClassSpace<Z> space{Z{}};
    // Once there is a core the space does not change, and nodes go on here.
    std::vector<GeneratorId> generators;  ///< per node of the space: what it is, if it was alive
    std::vector<std::uint32_t> later;     ///< per node after those: a generator, or kept_bit | which of the sums kept
  };
  struct Core {
    Core() : boundary{Z{}, 0, 0}, rewriter{Z{}, boundary}, groups{Z{}, rewriter} {}
    GeneratorId append(std::size_t dimension, const Terms<Z, GeneratorId>& boundary_of_it);

    sparse::ColumnStore<Z, GeneratorId> boundary;
    Rewriter<Z> rewriter;
    Groups<Z> groups;
    std::vector<Terms<Z, GeneratorId>> kept;  ///< sums
    RawTerms<Z, GeneratorId> sum;             ///< the later nodes of the sum under construction
    Terms<Z, GeneratorId> column;             ///< scratch
  };
  static constexpr std::uint32_t kept_bit = 0x8000'0000U;
  /// Nodes that nobody needs are looked for when there are as many again as can be needed, and so many more.
  static constexpr std::size_t most_idle = 4096;

  void begin_core();
  const Terms<Z, GeneratorId>& core_sum();
  ClassRef add_later(std::size_t dimension, std::uint32_t what);
  ClassRef append_to_core();

  std::vector<Level> levels_;
  std::size_t dimension_ = 0;  ///< of the sum
  std::unique_ptr<Core> core_;
};

}  // namespace sesame::engine
