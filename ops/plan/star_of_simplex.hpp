/// \file
/// The open star of a simplex in any complex of simplices, and the cells that may take its place.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The cells t that have a simplex A as a face, each of them once: t = A * L, with the vertices of A and L numbered as
/// the name of t has them. Cells may be glued to themselves and to one another elsewhere, as in a triangulation with
/// one vertex: what is replaced are open cells.
///
/// Cost: for each cell of the star the number of its faces, times its dimension.
///
/// Threads: one at a time, for queries too.
class StarOfSimplex {
 public:
  /// `star`: the open star, A first. Errors: refused, when a cell is no simplex, or has A as a face more than once.
  static Result<StarOfSimplex> of(CellId simplex, std::span<const CellId> star, const Structure& structure,
                                  const Limits& limits);

  /// Whether L runs through the proper faces of one simplex B, each once. With A alone B is a vertex.
  [[nodiscard]] bool can_be_flipped() const;
  /// How many cells have one vertex more than A.
  [[nodiscard]] std::size_t vertices_around() const { return neighbours_.size(); }

  /// Lays out the cells A' * B for the proper faces A' of A, the empty one too; and A * B when that is asked for. They
  /// are B itself, which is called `name`, and `name`.i-j-... with the numbers of their vertices in A * B.
  /// Requires: can_be_flipped(). Errors: bad_input, for a name in use; refused, when there is no room.
  Status write_flip(const std::string& name, bool fills, const Limits& limits, Plan& plan) const;

  /// Lays out the cells v * A' * L for all t = A * L and all proper faces A' of A, or all faces: v itself, and
  /// v*t.i-j-... with the numbers of the vertices of A' * L in t. Errors: likewise.
  Status write_subdivision(const std::string& vertex, bool fills, const Limits& limits, Plan& plan) const;

 private:
  using Mask = std::uint32_t;  ///< some vertices of a cell
  struct Member {
    CellId cell;
    Mask vertices;             ///< all of them
    Mask of_simplex;           ///< those of A
    std::vector<Value> faces;  ///< by the vertices that they have; of the empty set there is none
    VertexMap in_simplex;      ///< of the vertices of A, in their order: which ones of A they are
  };

  StarOfSimplex(const Structure& structure, CellId simplex) : structure_{structure}, simplex_{simplex} {}

  Status add(CellId cell, const Limits& limits);
  [[nodiscard]] VertexMap named_vertices(const Value& v) const;
  [[nodiscard]] std::size_t neighbour(const Member& member, unsigned vertex) const;
  [[nodiscard]] std::vector<Mask> opposite_simplices() const;
  [[nodiscard]] Value face_in_order(const Member& member, Mask of_simplex) const;
  struct InFace {
    std::size_t member;
    Mask vertices;
    std::vector<std::uint8_t> order;
  };
  [[nodiscard]] InFace in_face(const Member& member, unsigned left_out, Mask vertices) const;

  const Structure& structure_;
  CellId simplex_;
  std::vector<Member> members_;
  std::vector<CellId> neighbours_;  ///< with one vertex more than A, for which they stand
  std::unordered_map<CellId, std::size_t> number_;
};

}  // namespace sesame::ops
