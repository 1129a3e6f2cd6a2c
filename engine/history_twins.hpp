/// \file
/// The objects before and after the last map of a history, with generators of both.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/engine.hpp"
#include "engine/history_maps.hpp"
#include "engine/zigzag/space_zigzag.hpp"

namespace sesame::engine {

/// Two engines, a map apart, and the map in the homology of both. Chains are of cells as they are oriented themselves;
/// both engines have the same cells, as far as there are any. Threads: one at a time, for queries too.
template <sparse::Ring R>
class HistoryTwins {
 public:
  using Vector = typename SpaceZigzag<R>::Vector;
  using Images = typename SpaceZigzag<R>::Images;
  using Chain = sparse::Terms<R, ops::CellId>;

  HistoryTwins(R ring, const ops::Limits& limits, const RebasePolicy& rebases)
      : ring_{ring}, before_{make(limits, rebases)}, after_{make(limits, rebases)} {}

  /// Carries out an operation that is a map, as part of a step. Errors: refused, when it is none; those of steps.
  Status apply(ops::Operation operation, std::uint64_t step);
  /// The last one.
  [[nodiscard]] const HistoryMap& map() const { return map_; }
  /// Which has done all maps.
  [[nodiscard]] const ops::Structure& structure() const { return after_->structure(); }

  /// One more than the largest degree in which there is something before or after the map.
  [[nodiscard]] std::size_t degrees() const { return std::max(generators_before_.size(), generators_after_.size()); }
  /// Betti number p after it.
  [[nodiscard]] std::size_t betti(std::size_t p) const { return generators(generators_after_, p).size(); }
  /// The map of H_p, in generators. Cost: the classes of those that are not sent to others.
  [[nodiscard]] Images images(std::size_t p);
  [[nodiscard]] Chain image(const Chain& chain) const;

  /// A cycle after the map, by its class in the generators.
  [[nodiscard]] Chain chain_of(std::size_t p, const Vector& vector) const;
  /// The class of a chain of cells that may be gone, if it is a cycle after the map.
  [[nodiscard]] std::optional<Vector> class_after(std::size_t p, const Chain& chain);

 private:
  using Generators = std::vector<std::vector<Chain>>;  ///< by degree

  [[nodiscard]] std::unique_ptr<Engine> make(const ops::Limits& limits, const RebasePolicy& rebases) const {
    return std::make_unique<Engine>(sparse::AnyRing{ring_}, limits, rebases);
  }
  static const std::vector<Chain>& generators(const Generators& all, std::size_t p) {
    static const std::vector<Chain> none;
    return p < all.size() ? all[p] : none;
  }
  [[nodiscard]] Generators generators_of(Engine& engine) const;
  /// Nothing when it is no cycle.
  [[nodiscard]] std::optional<Vector> class_in(Engine& engine, std::size_t p, const Chain& chain) const;

  R ring_;
  std::unique_ptr<Engine> before_, after_;
  std::optional<ops::Operation> last_;  ///< that `after_` has done, and `before_` has not
  HistoryMap map_{};
  Generators generators_before_, generators_after_;
};

}  // namespace sesame::engine
