#include "ops/cells/lazy_cells.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

namespace sesame::ops {

Incidence LazyCells::face(FamilyId family, LazyPart part, const Value& left, const Value& right) const {
  const LazyFamily& f = families_[family];
  if (f.kind == FamilyKind::map_product) {
    return pair_seen(family, left, right, 0);
  }
  LazyKey key{family, part, left, right};
  Value made;   // the value that the cell has: collapsed directions of its own
  TypeId type;  // of the cell
  if (part == LazyPart::pair && f.kind == FamilyKind::simplicial_product) {
    made.type = left.type;
    made.collapsed = left.collapsed & right.collapsed;
    const Degeneracy common = made.collapsed;
    type = types_.simplex(types_.info(left.type).dimension - std::popcount(common));
    key.left = {left.cell, type, without(left.collapsed, common)};
    key.right = {right.cell, type, without(right.collapsed, common)};
  } else {
    key.left = values_.plain(left.cell);
    type = key.left.type;
    made = left;
    if (part == LazyPart::pair) {
      key.right = values_.plain(right.cell);
      type = types_.product(key.left.type, key.right.type);
      made = maps_.product(none, left, right);
    } else if (part == LazyPart::coned) {
      type = types_.coned(key.left.type, f.by_edges);
      made = maps_.coned(none, left, f.by_edges);
    }
  }
  made.cell = node_of(key, type);
  return made.is_degenerate() ? values_.incidence_of(values_.normal_form(made)) : Incidence{made.cell, made.order};
}

CellId LazyCells::node_of(const LazyKey& key, TypeId type) const {
  if (const auto known = index_.find(key); known != index_.end()) {
    return known->second;
  }
  const CellId node =
      cells_.add_asked(type, static_cast<std::uint32_t>(lazy_cells_.size()), families_[key.family].body);
  forest_.add(node);
  lazy_cells_.push_back({key});
  index_.emplace(key, node);
  made_[key.family].push_back(node);
  journal_.append(EventKind::lazy, node);
  return node;
}

Incidence LazyCells::pair_seen(FamilyId family, const Value& left, const Value& right, std::uint32_t word) const {
  const LazyKey key{family, LazyPart::pair, values_.plain(left.cell), values_.plain(right.cell)};
  const ProductShape& shape = products_.of(key.left.type, key.right.type);
  const Dart dart = shape.places[shape.darts.dart({maps_.dart_of(left.order), maps_.dart_of(right.order), word})];
  return {node_of(key, shape.type), maps_.order_at(shape.type, dart)};
}

const LazyCell& LazyCells::expanded(CellId lazy) const {
  LazyCell& cell = lazy_cells_[cells_.lazy(lazy)];
  if (!cell.is_expanded) {
    for (const Incidence& face : faces_of(cell.key)) {
      cell.faces.push_back(face.node);
      cell.orders.push_back(face.order);
    }
    cell.is_expanded = true;
    journal_.append(EventKind::expansion, static_cast<std::uint32_t>(expanded_.size()));
    expanded_.push_back(lazy);
  }
  return cell;
}

std::vector<Incidence> LazyCells::faces_of(const LazyKey& key) const {
  const LazyFamily& family = families_[key.family];
  const auto arity = [this](const Value& v) { return static_cast<std::uint32_t>(types_.info(v.type).faces.size()); };
  std::vector<Incidence> faces;
  switch (key.part) {
    case LazyPart::pair:
      if (family.kind == FamilyKind::map_product) {
        return faces_of_pair_of_maps(key);
      }
      if (family.kind == FamilyKind::simplicial_product) {
        for (std::uint32_t k = 0; k < arity(key.left); ++k) {
          faces.push_back(face(key.family, key.part, values_.face(key.left, k), values_.face(key.right, k)));
        }
        break;
      }
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(face(key.family, key.part, values_.face(key.left, k), key.right));
      }
      for (std::uint32_t k = 0; k < arity(key.right); ++k) {
        faces.push_back(face(key.family, key.part, key.left, values_.face(key.right, k)));
      }
      break;
    case LazyPart::base:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(face(key.family, key.part, values_.face(key.left, k)));
      }
      break;
    case LazyPart::coned:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(face(key.family, key.part, values_.face(key.left, k)));
      }
      if (const int p = cells_.dimension(key.left.cell); p == 0) {
        faces.push_back({family.apex});
      } else if (family.by_edges) {
        faces.push_back(
            values_.incidence_of(values_.normal_form({family.apex, key.left.type, (Degeneracy{1} << p) - 1})));
      }
      faces.push_back(face(key.family, LazyPart::base, key.left));
      break;
  }
  return faces;
}

/// The dart from which a face is seen is one of a face of a factor, with the same dart of the other one.
std::vector<Incidence> LazyCells::faces_of_pair_of_maps(const LazyKey& key) const {
  const ProductShape& shape = products_.of(key.left.type, key.right.type);
  const int last = shape.darts.dimension() - 1;
  const auto face_of = [this](const Value& v, Dart dart) {
    const CellShape::Place place = types_.place_in_face(v.type, dart);
    return maps_.seen_from(place.dart, values_.face(v, place.face));
  };
  std::vector<Incidence> faces;
  for (const Dart dart : shape.of_face) {
    const auto [left, right, word] = shape.darts.place(dart);
    const bool is_left = shape.darts.is_left(word, last);
    faces.push_back(pair_seen(key.family, is_left ? face_of(key.left, left) : maps_.seen_from(left, key.left),
                              is_left ? maps_.seen_from(right, key.right) : face_of(key.right, right),
                              shape.darts.beginning(word, last)));
  }
  return faces;
}

/// Cost: O(1) when they are all there, as they are after the first time.
void LazyCells::make_all_of(FamilyId id) const {
  const LazyFamily& family = families_[id];
  if (made_[id].size() == std::accumulate(family.counts.begin(), family.counts.end(), std::uint64_t{0})) {
    return;
  }
  if (family.kind == FamilyKind::cone) {
    for (const BodyId body : family.bodies) {
      for (const CellId c : cells_of(body)) {
        (void)cell(id, LazyPart::base, values_.plain(c));
        (void)cell(id, LazyPart::coned, values_.plain(c));
      }
    }
    return;
  }
  const std::vector<CellId> lefts = cells_of(family.bodies[0]);
  const std::vector<CellId> rights = cells_of(family.bodies[1]);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {
      if (family.kind != FamilyKind::simplicial_product) {
        (void)cell(id, LazyPart::pair, values_.plain(left), values_.plain(right));
        continue;
      }
      const int p = cells_.dimension(left);
      const int q = cells_.dimension(right);
      for (int n = std::max(p, q); n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = types_.simplex(n);
          (void)cell(id, LazyPart::pair, {left, type, l}, {right, type, r});
        });
      }
    }
  }
}

void LazyCells::make_all() const {
  for (FamilyId f = 0; f < families(); ++f) {
    make_all_of(f);
  }
}

std::vector<CellId> LazyCells::cells_of(BodyId body) const {
  std::vector<CellId> cells;
  const auto add = [&](CellId c) {
    if (forest_.is_current(c)) {
      cells.push_back(c);
    }
  };
  std::vector<BodyId> pending{bodies_.find(body)};
  while (!pending.empty()) {
    const Bodies::Made& b = bodies_.made(pending.back());
    pending.pop_back();
    pending.insert(pending.end(), b.children.begin(), b.children.end());
    for (const Bodies::Range& range : b.cells) {
      for (CellId c = range.first; c < range.last; ++c) {
        add(c);
      }
    }
    if (b.family != none) {
      make_all_of(b.family);
      std::for_each(made_[b.family].begin(), made_[b.family].end(), add);
    }
  }
  std::sort(cells.begin(), cells.end(),
            [this](CellId a, CellId b) { return is_older(forest_.oldest(a), forest_.oldest(b)); });
  return cells;
}

/// Negative when a is older, positive when b is.
int LazyCells::compare_age(CellId a, CellId b) const {
  const LazyCell* x = of(a);
  const LazyCell* y = of(b);
  while (x != nullptr && x->key.part == LazyPart::base) {
    a = forest_.oldest(x->key.left.cell);
    x = of(a);
  }
  while (y != nullptr && y->key.part == LazyPart::base) {
    b = forest_.oldest(y->key.left.cell);
    y = of(b);
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
    if (const int order = compare(cells_.dimension(a), cells_.dimension(b)); order != 0) {
      return order;
    }
  }
  if (x->key.left.cell != y->key.left.cell) {
    return compare_age(forest_.oldest(x->key.left.cell), forest_.oldest(y->key.left.cell));
  }
  if (x->key.right.cell != y->key.right.cell) {
    return compare_age(forest_.oldest(x->key.right.cell), forest_.oldest(y->key.right.cell));
  }
  const int order = compare(x->key.left.collapsed, y->key.left.collapsed);
  return order != 0 ? order : compare(x->key.right.collapsed, y->key.right.collapsed);
}

void LazyCells::add_family(const LazyFamily& family) {
  families_.push_back(family);
  made_.emplace_back();
}

void LazyCells::pop_family() {
  made_.pop_back();
  families_.pop_back();
}

void LazyCells::undo_last_cell() {
  const LazyKey& key = lazy_cells_.back().key;
  index_.erase(key);
  made_[key.family].pop_back();
  lazy_cells_.pop_back();
}

void LazyCells::undo_last_expansion() {
  LazyCell& lazy = lazy_cells_[cells_.lazy(expanded_.back())];
  lazy.faces.clear();
  lazy.orders.clear();
  lazy.is_expanded = false;
  expanded_.pop_back();
}

}  // namespace sesame::ops
