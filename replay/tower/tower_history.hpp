/// \file
/// What the simplices of a tower were called, and what each has become at any operation.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/towers/bar_cycles.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "replay/tower/named_chains.hpp"

namespace sesame::replay {

/// Grows with the tower: for cycles, which may be asked for at any time.
class TowerHistory {
 public:
  using Label = ops::Label;
  using Name = std::vector<Label>;
  using NamedChain = replay::NamedChain;

  /// A simplex is included, oriented by the order of its labels here.
  void include(std::span<const Label> labels);
  /// A cell of a boundary matrix, which is called by its number, counted from 0.
  void include_cell();
  void contract(Label u, Label v);

  /// The image of a chain of inclusions in the complex after the operation with a number, from 0:
  /// simplices that are squashed count as 0, those that are merged are added up modulo p (0: over Q); simplices in
  /// lexicographic order. Cost: the chain, times the logarithm of the number of contractions.
  [[nodiscard]] NamedChain image(const engine::InclusionChain& chain, std::uint64_t operation, std::uint32_t p) const;

 private:
  using Vertex = std::uint32_t;  ///< a label from its inclusion on
  static constexpr Vertex none = UINT32_MAX;
  /// Vertices that have become one are a tree, the smaller hung under the larger: a union-find with the times of its
  /// links, at most log2 deep. The root says how all of them were called, and since which operation.
  struct Node {
    Vertex parent = none;
    std::uint64_t linked_by = 0;
    std::uint32_t size = 1;
    std::vector<std::pair<std::uint64_t, Label>> names;
  };

  [[nodiscard]] Label label_at(Vertex v, std::uint64_t operation) const;

  std::vector<Node> vertices_;
  std::unordered_map<Label, Vertex> current_;  ///< the root that is called so
  std::vector<Vertex> simplices_;              ///< the vertices of all simplices
  std::vector<std::uint64_t> first_{0};        ///< per inclusion: where its vertices begin; one more at the end
  std::uint64_t operations_ = 0;
  bool has_cells_ = false;
};

}  // namespace sesame::replay
