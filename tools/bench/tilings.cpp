#include "tools/bench/tilings.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "tools/bench/draws.hpp"

namespace sesame::tools {
namespace {

using Key = Tiling::Key;
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The tiles breadth first: from the first one, and again from the first that is left.
std::vector<std::size_t> breadth_first(const Tiling& tiling) {
  std::unordered_map<Key, std::vector<std::size_t>> tiles_at;
  for (std::size_t tile = 0; tile < tiling.sides.size(); ++tile) {
    for (const Key key : tiling.sides[tile]) {
      tiles_at[key].push_back(tile);
    }
  }
  std::vector<std::size_t> order;
  std::vector<bool> is_listed(tiling.sides.size());
  std::size_t next = 0;  // in `order`
  for (std::size_t start = 0; start < tiling.sides.size(); ++start) {
    if (!is_listed[start]) {
      is_listed[start] = true;
      order.push_back(start);
    }
    for (; next < order.size(); ++next) {
      for (const Key key : tiling.sides[order[next]]) {
        for (const std::size_t neighbour : tiles_at.at(key)) {
          if (!is_listed[neighbour]) {
            is_listed[neighbour] = true;
            order.push_back(neighbour);
          }
        }
      }
    }
  }
  return order;
}

std::vector<std::size_t> order_of_tiles(const Tiling& tiling, const Assembly& assembly, Draws& draws) {
  if (assembly.order == Order::inside_out) {
    return breadth_first(tiling);
  }
  std::vector<std::size_t> order(tiling.sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  draws.shuffle_to_front(order, order.size());
  return order;
}

/// What the sides of a standard cell are called: ".1-2", ...
std::vector<std::string> suffixes_of_sides(const ops::CellType& type) {
  ops::TypeTable types;
  const ops::StandardCell& standard = types.standard(types.intern(type));
  std::vector<std::string> suffixes;
  for (const std::uint32_t face : standard.cells.back().faces) {
    suffixes.push_back("." + standard.cells[face].suffix);
  }
  return suffixes;
}

/// Makes the tiles under their names, and remembers the first side of each key.
class Assembler {
 public:
  explicit Assembler(const Tiling& tiling) : tiling_{tiling}, suffixes_{suffixes_of_sides(tiling.type)} {}

  [[nodiscard]] ops::Operation make(std::size_t number) const {
    const std::string name = "t" + std::to_string(number);
    if (tiling_.type.size() == 1) {
      return ops::MakeSimplex{name, tiling_.type.front(), {}};
    }
    return ops::MakeSimploid{name, tiling_.type, {}};
  }

  /// The gluings of a tile, the `number`-th to be made, to those before it and to itself.
  [[nodiscard]] Pairs gluings(std::size_t number, std::size_t tile) {
    Pairs pairs;
    const std::vector<Key>& sides = tiling_.sides[tile];
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto [first, is_new] = first_side_.try_emplace(sides[k], number, k);
      if (!is_new) {
        pairs.emplace_back(name_of(first->second), name_of({number, k}));
      }
    }
    return pairs;
  }

 private:
  using Side = std::pair<std::size_t, std::size_t>;  // the number of the tile, and of the side

  [[nodiscard]] std::string name_of(const Side& side) const {
    return "t" + std::to_string(side.first) + suffixes_[side.second];
  }

  const Tiling& tiling_;
  std::vector<std::string> suffixes_;
  std::unordered_map<Key, Side> first_side_;
};

}  // namespace

Tiling tiling_of_facets(std::vector<std::vector<std::uint32_t>> facets) {
  Tiling tiling{{static_cast<int>(facets.front().size()) - 1}, {}};
  std::map<std::vector<std::uint32_t>, Key> keys;
  for (std::vector<std::uint32_t>& facet : facets) {
    std::sort(facet.begin(), facet.end());
    std::vector<Key>& sides = tiling.sides.emplace_back();
    for (std::size_t k = 0; k < facet.size(); ++k) {
      std::vector<std::uint32_t> side = facet;
      side.erase(side.begin() + static_cast<std::ptrdiff_t>(k));
      sides.push_back(keys.emplace(std::move(side), keys.size()).first->second);
    }
  }
  return tiling;
}

Operations assembled(const Tiling& tiling, const Assembly& assembly) {
  Draws draws(assembly.seed);
  const std::vector<std::size_t> order = order_of_tiles(tiling, assembly, draws);
  Assembler assembler(tiling);
  Operations operations;
  Pairs later;
  for (std::size_t number = 0; number < order.size(); ++number) {
    operations.push_back(assembler.make(number));
    Pairs pairs = assembler.gluings(number, order[number]);
    if (assembly.order == Order::tiles_first) {
      std::move(pairs.begin(), pairs.end(), std::back_inserter(later));
    } else if (!pairs.empty()) {
      operations.emplace_back(ops::Identify{std::move(pairs)});
    }
  }
  draws.shuffle_to_front(later, later.size());
  for (auto& pair : later) {
    operations.emplace_back(ops::Identify{{std::move(pair)}});
  }
  return operations;
}

}  // namespace sesame::tools
