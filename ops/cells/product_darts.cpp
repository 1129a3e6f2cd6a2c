#include "ops/cells/product_darts.hpp"

#include "ops/maps/map_product.hpp"

namespace sesame::ops {
namespace {

/// The first steps of the words of a product, looked up once for all its darts.
struct Beginning {
  int left;            ///< how many of them go to the left
  std::uint32_t word;  ///< their number
};

class Cells {
 public:
  Cells(const FactorDarts& left, const FactorDarts& right, FamilyId family, const LazyCells& lazy,
        const VertexMaps& maps)
      : left_{left}, right_{right}, family_{family}, lazy_{lazy}, maps_{maps} {}

  DartCells of_map() const {
    const int k = static_cast<int>(left_.seen.size()) - 1, l = static_cast<int>(right_.seen.size()) - 1;
    const auto lefts = static_cast<Dart>(left_.seen[0].size()), rights = static_cast<Dart>(right_.seen[0].size());
    const ProductDarts darts(lefts, k, rights, l);
    DartCells cells;
    cells.of.resize(static_cast<std::size_t>(darts.dimension()) + 1);
    for (int i = 0; i <= darts.dimension(); ++i) {
      std::vector<Beginning> beginnings;
      for (std::uint32_t word = 0; word < darts.words(); ++word) {
        beginnings.push_back({darts.left_steps(word, i), darts.beginning(word, i)});
      }
      std::vector<DartCells::Seen>& seen = cells.of[static_cast<std::size_t>(i)];
      seen.reserve(darts.size());
      for (Dart d = 0; d < lefts; ++d) {
        for (Dart e = 0; e < rights; ++e) {
          for (const auto& [a, word] : beginnings) {
            seen.push_back(at(a, d, i - a, e, word));
          }
        }
      }
    }
    return cells;
  }

  DartCells of_levels() const {
    const int k = static_cast<int>(left_.seen.size()) - 1, l = static_cast<int>(right_.seen.size()) - 1;
    DartCells cells;
    for (int n = 0; n <= k + l; ++n) {
      std::vector<DartCells::Seen>& seen = cells.of.emplace_back();
      for (int a = std::max(0, n - l); a <= std::min(n, k); ++a) {
        const auto lefts = static_cast<Dart>(left_.seen[static_cast<std::size_t>(a)].size());
        const auto rights = static_cast<Dart>(right_.seen[static_cast<std::size_t>(n - a)].size());
        const ProductDarts darts(lefts, a, rights, n - a);
        for (Dart d = 0; d < darts.size(); ++d) {
          const auto [e, f, word] = darts.place(d);
          seen.push_back(at(a, e, n - a, f, word));
        }
      }
    }
    return cells;
  }

 private:
  [[nodiscard]] DartCells::Seen at(int a, Dart d, int b, Dart e, std::uint32_t word) const {
    const Value& left = left_.seen[static_cast<std::size_t>(a)][d];
    const Value& right = right_.seen[static_cast<std::size_t>(b)][e];
    if (left.cell == none || right.cell == none) {
      return {UINT32_MAX, 0};
    }
    const Incidence seen = lazy_.pair_seen(family_, left, right, word);
    return {seen.node, maps_.dart_of(seen.order)};
  }

  const FactorDarts& left_;
  const FactorDarts& right_;
  FamilyId family_;
  const LazyCells& lazy_;
  const VertexMaps& maps_;
};

}  // namespace

DartCells cells_of_product_darts(const FactorDarts& left, const FactorDarts& right, bool has_levels, FamilyId family,
                                 const LazyCells& lazy, const VertexMaps& maps) {
  const Cells cells(left, right, family, lazy, maps);
  return has_levels ? cells.of_levels() : cells.of_map();
}

}  // namespace sesame::ops
