#include "ops/cells/cofaces.hpp"

#include <algorithm>
#include <iterator>

namespace sesame::ops {
namespace {

/// One search for cofaces.
class Cofaces {
 public:
  explicit Cofaces(const Structure& structure) : structure_{structure}, lazy_{structure.lazy()} {}

  [[nodiscard]] std::vector<CellId> of(CellId current) const;

 private:
  using Candidates = std::vector<CellId>;  ///< nodes; some may have become one
  void add_of_origin(CellId node, Candidates& out) const;
  void add_of_apex(FamilyId id, Candidates& out) const;
  void add_of_lazy(const LazyKey& key, CellId cell, Candidates& out) const;

  const Structure& structure_;
  const LazyCells& lazy_;
};

std::vector<CellId> Cofaces::of(CellId current) const {
  std::vector<CellId> cells;
  Candidates lazy;
  add_of_origin(current, lazy);
  for (const CellId entry : structure_.coface_index().entries(current)) {
    if (structure_.values().of(entry).cell == current) {
      add_of_origin(entry, lazy);
    } else {
      cells.push_back(entry);
    }
  }
  std::transform(lazy.begin(), lazy.end(), lazy.begin(), [this](CellId c) { return structure_.find(c); });
  std::sort(lazy.begin(), lazy.end());
  lazy.erase(std::unique(lazy.begin(), lazy.end()), lazy.end());
  std::copy_if(lazy.begin(), lazy.end(), std::back_inserter(cells),
               [&](CellId c) { return c != none && structure_.coface_index().is_coface(c, current); });
  std::sort(cells.begin(), cells.end(), [this](CellId a, CellId b) {
    return lazy_.is_older(structure_.forest().oldest(a), structure_.forest().oldest(b));
  });
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

void Cofaces::add_of_origin(CellId node, Candidates& out) const {
  if (const LazyCell* lazy = lazy_.of(node)) {
    add_of_lazy(lazy->key, node, out);
  } else if (const Cone* cone = structure_.cones().from(node); cone != nullptr && cone->family != none) {
    add_of_apex(cone->family, out);
  }
}

/// The cells of a lazy cone that have the apex as a face: over vertices, and over all when the far end is squashed.
void Cofaces::add_of_apex(FamilyId id, Candidates& out) const {
  const LazyFamily& family = lazy_.family(id);
  for (const BodyId body : family.bodies) {
    for (const CellId c : lazy_.cells_of(body)) {
      if (family.by_edges || structure_.dimension(c) == 0) {
        out.push_back(lazy_.cell(id, LazyPart::coned, structure_.values().plain(c)));
      }
    }
  }
}

/// Candidates for the cofaces, within its family, of a lazy cell.
void Cofaces::add_of_lazy(const LazyKey& key, CellId cell, Candidates& out) const {
  const LazyFamily& family = lazy_.family(key.family);
  if (family.kind == FamilyKind::cone) {
    for (const CellId coface : of(key.left.cell)) {
      out.push_back(lazy_.cell(key.family, key.part, structure_.values().plain(coface)));
    }
    if (key.part == LazyPart::base) {
      out.push_back(lazy_.cell(key.family, LazyPart::coned, key.left));
    }
    return;
  }
  if (family.kind != FamilyKind::simplicial_product) {
    for (const CellId coface : of(key.left.cell)) {
      out.push_back(lazy_.cell(key.family, LazyPart::pair, structure_.values().plain(coface), key.right));
    }
    for (const CellId coface : of(key.right.cell)) {
      out.push_back(lazy_.cell(key.family, LazyPart::pair, key.left, structure_.values().plain(coface)));
    }
    return;
  }
  std::vector<CellId> lefts = of(key.left.cell);
  std::vector<CellId> rights = of(key.right.cell);
  lefts.push_back(key.left.cell);
  rights.push_back(key.right.cell);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {  // a face may be degenerate over the cell: any larger dimension
      const int p = structure_.dimension(left);
      const int q = structure_.dimension(right);
      for (int n = structure_.dimension(cell) + 1; n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = structure_.types().simplex(n);
          out.push_back(lazy_.cell(key.family, LazyPart::pair, {left, type, l}, {right, type, r}));
        });
      }
    }
  }
}

}  // namespace

std::vector<CellId> cofaces(const Structure& structure, CellId current) { return Cofaces{structure}.of(current); }

}  // namespace sesame::ops
