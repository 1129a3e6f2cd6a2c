/// \file
/// What surfaces are that are put together from triangles or squares, by counting: no chain is looked at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Follows steps that make tiles, all of one type, and glue sides or corners of them. As long as no more than two sides
/// are one, each piece of tiles that hang together by sides is a surface: it adds to H_2 when it is closed and
/// orientable, torsion to H_1 when it is closed and not orientable. Pieces have corners in common, which adds loops:
/// with the Euler characteristic, H_1 is known.
class SurfaceCount {
 public:
  /// Takes a step. An undo is followed, too, but nothing that comes after it, other than a further one.
  void take(const ops::Operation& operation);
  /// Nothing, when something has happened that cannot be followed.
  [[nodiscard]] std::optional<Answer> answer() const;

 private:
  using Number = std::uint32_t;
  /// Union-find.
  struct Classes {
    std::vector<Number> parent;
    Number count = 0;
    void add();
    Number root(Number x);
    /// False when they were one already.
    bool unite(Number a, Number b);
  };
  /// Pieces of tiles that hang together by sides; each tile is oriented as its root is, or the other way.
  struct Piece {
    std::int64_t free_sides = 0;
    bool is_orientable = true;
  };
  /// A cell of the standard tile.
  struct Part {
    int dimension = 0;
    Number number = 0;                ///< among the corners or the sides
    std::array<Number, 2> corners{};  ///< of a side: its end and its beginning
    int sign = 0;                     ///< of a side: in the boundary of the tile
  };

  void begin(const ops::CellType& type);
  bool make(const std::string& name, const ops::CellType& type);
  bool glue(const ops::Identify& identify);
  bool glue(const std::string& one, const std::string& other);
  void join(Number a, Number b, int sign);
  std::pair<Number, int> root_of(Number tile);
  [[nodiscard]] std::optional<std::pair<Number, Part>> find(const std::string& name) const;
  [[nodiscard]] Answer count() const;

  ops::CellType type_;
  std::unordered_map<std::string, Part> parts_;  ///< by what is behind the name of the tile
  Number corners_of_a_tile_ = 0, sides_of_a_tile_ = 0;
  std::unordered_map<std::string, Number> tiles_;
  Classes corners_, sides_, components_;
  std::vector<Number> glued_;                        ///< per root of a class of sides: how many they are
  std::vector<std::pair<Number, int>> tile_parent_;  ///< and whether it is oriented alike
  std::vector<Piece> pieces_;                        ///< per root
  std::int64_t closed_ = 0, closed_one_sided_ = 0;   ///< pieces: orientable, and not
  std::vector<Answer> answers_;                      ///< after each step that is not taken back
  bool is_known_ = true, has_undone_ = false;
};

/// What it says after each of some steps.
[[nodiscard]] AnswerAfter counted(std::vector<ops::Operation> operations);

}  // namespace sesame::tools
