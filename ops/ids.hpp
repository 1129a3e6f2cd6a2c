/// \file
/// The numbers by which the parts of a cell structure are known, and how far they go.
#pragma once

#include <cstdint>

namespace sesame::ops {

/// A cell as it was created; ids count creations from 0. The *current* cell that it is now is `Forest::find(id)`.
using CellId = std::uint32_t;
/// A removal of a cell in favour of another, counted from 0 in the order in which they happened.
using LinkId = std::uint32_t;
using BodyId = std::uint32_t;
using FamilyId = std::uint32_t;
/// A type of cells: a product of simplices. See TypeTable.
using TypeId = std::uint32_t;
/// An order of the vertices of a cell: a permutation of them, by its number. See VertexMaps.
using OrderId = std::uint32_t;
using LabelId = std::uint32_t;
using VertexId = std::uint32_t;

inline constexpr std::uint32_t none = UINT32_MAX;
inline constexpr OrderId same_order = 0;

/// More directions than a Degeneracy (see there) can tell apart make no cell.
inline constexpr int largest_dimension = 62;

}  // namespace sesame::ops
