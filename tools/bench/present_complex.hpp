/// \file
/// The chain complex of the object as it is now, written out from scratch as often as it is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/cells/per_node.hpp"
#include "ops/cells/structure.hpp"
#include "reductions/chain_complex.hpp"

namespace sesame::tools {

/// Knows the current cells of a structure, so that writing them out costs the size of the object, whatever there was
/// before it.
class PresentComplex {
 public:
  explicit PresentComplex(const ops::Structure& structure) : structure_{structure} {}

  /// Has to be called when steps were taken back: then all cells ever created are looked at once more.
  void begin_again();

  /// The boundary matrices of the object, cells by degree and age. Cost: the object, lazy cells made, and what is new.
  template <sparse::Ring R>
  [[nodiscard]] reductions::ChainComplex<R> matrices(const R& ring);
  /// The cells that were looked at so far.
  [[nodiscard]] std::uint64_t cells_read() const { return cells_read_; }

 private:
  void catch_up();

  const ops::Structure& structure_;
  std::vector<std::vector<ops::CellId>> cells_;  ///< by degree
  std::uint64_t cells_read_ = 0;
  ops::PerNode<sparse::Index> position_;  ///< of each current cell in its degree; nodes that it knows have been seen
};

}  // namespace sesame::tools
