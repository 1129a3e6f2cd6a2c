/// \file
/// Where the vertices of a page are, each for all its time.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "replay/page/graph_layout.hpp"
#include "replay/page/page_cells.hpp"

namespace sesame::replay {

/// How a vertex came by its place.
enum class PlaceKind : std::uint8_t {
  given,     ///< by "at"
  sum,       ///< of a product: the sum of the places of its factors
  beside,    ///< a copy, beside the one that it was split from
  computed,  ///< from the graph of the vertices, with what is glued at some time near to one another
};

struct VertexPlace {
  std::uint32_t cell;
  PlaceKind kind;
  ops::Point point;
};

/// Gathers what is known of the places of vertices, and works out the rest. Cells are numbers of a page. What was glued
/// has one place, which is that of the oldest: to see to that is left to who draws.
class VertexPlaces {
 public:
  /// The next vertex, in the order of their numbers.
  void add_vertex(std::uint32_t cell);
  /// What is known of one: it is another one, it is the product of two in a family, it was split from another one. A
  /// number may be none; then nothing is known.
  void put_at(std::uint32_t cell, std::uint32_t other) { known(cell).from = {other, ops::none}; }
  void put_at_sum(std::uint32_t cell, std::uint32_t left, std::uint32_t right, std::uint32_t family);
  void put_beside(std::uint32_t cell, std::uint32_t source);
  /// Two vertices became one at some time; two are joined by an edge that neither was made with.
  void glue(std::uint32_t a, std::uint32_t b) { glued_.emplace_back(a, b); }
  void join(std::uint32_t a, std::uint32_t b) { joined_.emplace_back(a, b); }
  /// What a step gives. To be called after it; `number_of` gives the number of a node, or none.
  void take(const ops::Operation& operation, const engine::StepReport& report, const ops::Structure& structure,
            const std::function<std::uint32_t(ops::CellId)>& number_of);

  /// The places of all vertices, by number. Cost: that of `lay_out`.
  [[nodiscard]] std::vector<VertexPlace> places(const PageCells& cells) const;

 private:
  struct Known {
    std::uint32_t cell;
    std::optional<ops::Point> given;
    std::array<std::uint32_t, 2> from{ops::none, ops::none};  ///< it is at the place, or at the sum of the places
    std::uint32_t family = 0;
    std::uint32_t source = ops::none;  ///< it is a copy of that
    std::uint32_t group = 0;           ///< of a standard cell
    ops::Point shape{};
  };
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  [[nodiscard]] Known& known(std::uint32_t cell) { return known_[index_.at(cell)]; }
  [[nodiscard]] std::uint32_t index(std::uint32_t cell) const;
  void shape(const std::vector<ops::Point>& corners, const engine::StepReport& report,
             const std::function<std::uint32_t(ops::CellId)>& number_of);
  [[nodiscard]] std::vector<std::optional<ops::Point>> sums() const;
  [[nodiscard]] std::uint32_t in_layout(std::uint32_t cell) const;
  [[nodiscard]] std::vector<LayoutEdge> edges(const PageCells& cells) const;
  [[nodiscard]] Pairs all_edges(const PageCells& cells) const;
  void put_copies_beside(const PageCells& cells, std::vector<VertexPlace>& places) const;

  std::vector<Known> known_;  ///< by number
  std::unordered_map<std::uint32_t, std::uint32_t> index_;
  Pairs glued_, joined_;
  std::uint32_t groups_ = 0;
};

}  // namespace sesame::replay
