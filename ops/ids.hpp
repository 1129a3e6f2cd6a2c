/// \file
/// The numbers by which the parts of a cell structure are known, and how far they go.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace sesame::ops {

/// No number: what an id of any kind may be instead of one, and what lists of plain numbers have in its place.
struct None {
  // NOLINTNEXTLINE(google-explicit-constructor): to be written wherever a number may stand
  constexpr operator std::uint32_t() const { return UINT32_MAX; }
};
inline constexpr None none;

/// A number of one kind of thing, counted from 0. It is a number wherever one is asked for; numbers become ids only
/// where this is written, but for literals; ids of two kinds are not compared, and do not become one another.
template <class Kind>
class Id {
 public:
  constexpr Id() = default;
  // NOLINTBEGIN(google-explicit-constructor)
  constexpr Id(None no) : number_{no} {}
  consteval Id(int literal) : number_{static_cast<std::uint32_t>(literal)} {}
  constexpr operator std::uint32_t() const { return number_; }
  // NOLINTEND(google-explicit-constructor)
  template <std::integral Number>
  requires(!std::same_as<Number, int>) constexpr explicit Id(Number number)
      : number_{static_cast<std::uint32_t>(number)} {}

  constexpr Id& operator++() {
    ++number_;
    return *this;
  }
  constexpr Id operator++(int) {
    const Id before = *this;
    ++number_;
    return before;
  }
  template <std::integral Number>
  constexpr Id& operator+=(Number more) {
    number_ += static_cast<std::uint32_t>(more);
    return *this;
  }
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;
  template <std::integral Number>
  friend constexpr bool operator==(Id id, Number number) {
    return std::cmp_equal(id.number_, number);
  }
  template <std::integral Number>
  friend constexpr std::strong_ordering operator<=>(Id id, Number number) {
    return std::cmp_less(id.number_, number)    ? std::strong_ordering::less
           : std::cmp_equal(id.number_, number) ? std::strong_ordering::equal
                                                : std::strong_ordering::greater;
  }
  /// Ids that come so much later or earlier, and how much later one comes.
  template <std::integral Number>
  friend constexpr Id operator+(Id id, Number number) {
    return Id{static_cast<std::uint32_t>(id.number_ + static_cast<std::uint32_t>(number))};
  }
  template <std::integral Number>
  friend constexpr Id operator-(Id id, Number number) {
    return Id{static_cast<std::uint32_t>(id.number_ - static_cast<std::uint32_t>(number))};
  }
  friend constexpr std::uint32_t operator-(Id later, Id earlier) { return later.number_ - earlier.number_; }

 private:
  std::uint32_t number_ = 0;
};
template <class A, class B>
requires(!std::same_as<A, B>) bool operator==(Id<A>, Id<B>) = delete;
template <class A, class B>
requires(!std::same_as<A, B>) std::strong_ordering operator<=>(Id<A>, Id<B>) = delete;

/// A *node*: a cell as it was created. The *current cell* that it is now is `Forest::find(id)`. Ids of nodes that steps
/// make count from 0, in their order. Nodes that are only asked for, cells of lazy families and degenerate cells, count
/// from 0 too, with a mark: so a query changes no number of what steps make.
using CellId = Id<struct CellKind>;
inline constexpr std::uint32_t mark_of_asked = 0x8000'0000U;
[[nodiscard]] constexpr CellId asked_node(std::uint32_t number) { return CellId{number | mark_of_asked}; }
/// Requires of both: there is such a node.
[[nodiscard]] constexpr bool is_asked_for(CellId node) { return (node & mark_of_asked) != 0; }
[[nodiscard]] constexpr std::uint32_t number_of(CellId node) { return node & ~mark_of_asked; }
/// A removal of a cell in favour of another, counted from 0 in the order in which they happened.
using LinkId = Id<struct LinkKind>;
using BodyId = Id<struct BodyOfCells>;
using FamilyId = Id<struct FamilyOfCells>;
/// A type of cells: a product of simplices. See TypeTable.
using TypeId = Id<struct TypeOfCells>;
/// An order of the vertices of a cell: a permutation of them, by its number. See VertexMaps.
using OrderId = Id<struct OrderOfVertices>;
using LabelId = Id<struct LabelOfVertex>;
using VertexId = Id<struct VertexOfComplex>;

inline constexpr OrderId same_order = 0;

/// More directions than a Degeneracy (see there) can tell apart make no cell.
inline constexpr int largest_dimension = 62;

}  // namespace sesame::ops

template <class Kind>
struct std::hash<sesame::ops::Id<Kind>> {
  std::size_t operator()(sesame::ops::Id<Kind> id) const noexcept { return std::hash<std::uint32_t>{}(id); }
};
