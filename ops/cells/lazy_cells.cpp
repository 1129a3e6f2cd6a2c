// The cells of lazy families: what they are made of, who has them as faces, how old they are.
#include "ops/cells/structure.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace sesame::ops {

/// The cells of a lazy cone that have the apex as a face: over vertices, and over all when the far end is squashed.
void Structure::add_cofaces_of_apex(FamilyId id, std::vector<CellId>& out) const {
  const LazyFamily& family = families_[id];
  for (const BodyId body : family.bodies) {
    for (const CellId c : cells_of(body)) {
      if (family.by_edges || dimension(c) == 0) {
        out.push_back(lazy_cell(id, LazyPart::coned, {c, nodes_->type[c], 0}));
      }
    }
  }
}

/// Candidates for the cofaces, within its family, of a lazy cell.
void Structure::add_lazy_cofaces(const LazyKey& key, CellId cell, std::vector<CellId>& out) const {
  const LazyFamily& family = families_[key.family];
  const auto as_value = [this](CellId c) { return Value{c, nodes_->type[c], 0}; };
  if (family.kind == FamilyKind::cone) {
    for (const CellId coface : cofaces(key.left.cell)) {
      out.push_back(lazy_cell(key.family, key.part, as_value(coface)));
    }
    if (key.part == LazyPart::base) {
      out.push_back(lazy_cell(key.family, LazyPart::coned, key.left));
    }
    return;
  }
  if (family.kind == FamilyKind::product) {
    for (const CellId coface : cofaces(key.left.cell)) {
      out.push_back(lazy_cell(key.family, LazyPart::pair, as_value(coface), key.right));
    }
    for (const CellId coface : cofaces(key.right.cell)) {
      out.push_back(lazy_cell(key.family, LazyPart::pair, key.left, as_value(coface)));
    }
    return;
  }
  std::vector<CellId> lefts = cofaces(key.left.cell);
  std::vector<CellId> rights = cofaces(key.right.cell);
  lefts.push_back(key.left.cell);
  rights.push_back(key.right.cell);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {  // a face may be degenerate over the cell: any larger dimension
      const int p = dimension(left);
      const int q = dimension(right);
      for (int n = dimension(cell) + 1; n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = types_->simplex(n);
          out.push_back(lazy_cell(key.family, LazyPart::pair, {left, type, l}, {right, type, r}));
        });
      }
    }
  }
}

Incidence Structure::lazy_face(FamilyId family, LazyPart part, const Value& left, const Value& right) const {
  const LazyFamily& f = families_[family];
  LazyKey key{family, part, left, right};
  Value made;  // the value that the cell has: collapsed directions of its own
  if (part == LazyPart::pair && f.kind == FamilyKind::simplicial_product) {
    made.type = left.type;
    made.collapsed = left.collapsed & right.collapsed;
    const Degeneracy common = made.collapsed;
    const TypeId type = types_->simplex(types_->info(left.type).dimension - std::popcount(common));
    key.left = {left.cell, type, without(left.collapsed, common)};
    key.right = {right.cell, type, without(right.collapsed, common)};
    made.cell = type;  // for now: the type of the cell underneath
  } else {
    key.left = {left.cell, nodes_->type[left.cell], 0};
    made = left;
    made.cell = key.left.type;
    if (part == LazyPart::pair) {
      key.right = {right.cell, nodes_->type[right.cell], 0};
      made = maps_->product(types_->product(key.left.type, key.right.type), left, right);
    } else if (part == LazyPart::coned) {
      made = maps_->coned(types_->coned(key.left.type, f.by_edges), left, f.by_edges);
    }
  }
  const TypeId type = std::exchange(made.cell, none);
  if (const auto known = nodes_->lazy_index.find(key); known != nodes_->lazy_index.end()) {
    made.cell = known->second;
  } else {
    made.cell = add_node(type, none, static_cast<std::uint32_t>(nodes_->lazy_cells.size()), f.body);
    nodes_->lazy_cells.push_back({key});
    nodes_->lazy_index.emplace(key, made.cell);
    nodes_->lazy_made[family].push_back(made.cell);
    note(EventKind::lazy, made.cell);
  }
  return made.is_degenerate() ? incidence_of(normal_form(made)) : Incidence{made.cell, made.order};
}

std::vector<Incidence> Structure::faces_of_lazy(const LazyKey& key) const {
  const LazyFamily& family = families_[key.family];
  const auto arity = [this](const Value& v) { return static_cast<std::uint32_t>(types_->info(v.type).faces.size()); };
  std::vector<Incidence> faces;
  switch (key.part) {
    case LazyPart::pair:
      if (family.kind == FamilyKind::simplicial_product) {
        for (std::uint32_t k = 0; k < arity(key.left); ++k) {
          faces.push_back(lazy_face(key.family, key.part, face(key.left, k), face(key.right, k)));
        }
        break;
      }
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k), key.right));
      }
      for (std::uint32_t k = 0; k < arity(key.right); ++k) {
        faces.push_back(lazy_face(key.family, key.part, key.left, face(key.right, k)));
      }
      break;
    case LazyPart::base:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k)));
      }
      break;
    case LazyPart::coned:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k)));
      }
      if (const int p = dimension(key.left.cell); p == 0) {
        faces.push_back({family.apex});
      } else if (family.by_edges) {
        faces.push_back(incidence_of(normal_form({family.apex, key.left.type, (Degeneracy{1} << p) - 1})));
      }
      faces.push_back(lazy_face(key.family, LazyPart::base, key.left));
      break;
  }
  return faces;
}

void Structure::make_all_cells_of(FamilyId id) const {
  const LazyFamily& family = families_[id];
  const auto as_value = [this](CellId c) { return Value{c, nodes_->type[c], 0}; };
  if (family.kind == FamilyKind::cone) {
    for (const BodyId body : family.bodies) {
      for (const CellId c : cells_of(body)) {
        (void)lazy_cell(id, LazyPart::base, as_value(c));
        (void)lazy_cell(id, LazyPart::coned, as_value(c));
      }
    }
    return;
  }
  const std::vector<CellId> lefts = cells_of(family.bodies[0]);
  const std::vector<CellId> rights = cells_of(family.bodies[1]);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {
      if (family.kind == FamilyKind::product) {
        (void)lazy_cell(id, LazyPart::pair, as_value(left), as_value(right));
        continue;
      }
      const int p = dimension(left);
      const int q = dimension(right);
      for (int n = std::max(p, q); n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = types_->simplex(n);
          (void)lazy_cell(id, LazyPart::pair, {left, type, l}, {right, type, r});
        });
      }
    }
  }
}

void Structure::make_all_lazy_cells() const {
  for (FamilyId f = 0; f < families(); ++f) {
    make_all_cells_of(f);
  }
}

/// Negative when a is older, positive when b is.
int Structure::compare_age(CellId a, CellId b) const {
  const LazyCell* x = lazy_of(a);
  const LazyCell* y = lazy_of(b);
  while (x != nullptr && x->key.part == LazyPart::base) {
    a = oldest(x->key.left.cell);
    x = lazy_of(a);
  }
  while (y != nullptr && y->key.part == LazyPart::base) {
    b = oldest(y->key.left.cell);
    y = lazy_of(b);
  }
  const auto compare = [](auto m, auto n) { return m < n ? -1 : m > n ? 1 : 0; };
  const auto created = [this](CellId c, const LazyCell* lazy) {
    return lazy == nullptr ? 2 * std::uint64_t{c} + 1 : 2 * std::uint64_t{families_[lazy->key.family].first};
  };
  if (const int order = compare(created(a, x), created(b, y)); order != 0 || x == nullptr || y == nullptr) {
    return order;
  }
  if (const int order = compare(x->key.family, y->key.family); order != 0) {
    return order;
  }
  if (x->key.part == LazyPart::coned) {
    if (const int order = compare(dimension(a), dimension(b)); order != 0) {
      return order;
    }
  }
  if (x->key.left.cell != y->key.left.cell) {
    return compare_age(oldest(x->key.left.cell), oldest(y->key.left.cell));
  }
  if (x->key.right.cell != y->key.right.cell) {
    return compare_age(oldest(x->key.right.cell), oldest(y->key.right.cell));
  }
  const int order = compare(x->key.left.collapsed, y->key.left.collapsed);
  return order != 0 ? order : compare(x->key.right.collapsed, y->key.right.collapsed);
}

}  // namespace sesame::ops
