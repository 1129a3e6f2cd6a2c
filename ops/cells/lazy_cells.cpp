#include "ops/cells/lazy_cells.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

namespace sesame::ops {

Incidence LazyCells::face(FamilyId family, LazyPart part, const Value& left, const Value& right) const {
  const LazyFamily& f = families_[family];
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
  if (const auto known = index_.find(key); known != index_.end()) {
    made.cell = known->second;
  } else {
    made.cell = cells_.add_asked(type, static_cast<std::uint32_t>(lazy_cells_.size()), f.body);
    forest_.add(made.cell);
    lazy_cells_.push_back({key});
    index_.emplace(key, made.cell);
    made_[family].push_back(made.cell);
    journal_.append(EventKind::lazy, made.cell);
  }
  return made.is_degenerate() ? values_.incidence_of(values_.normal_form(made)) : Incidence{made.cell, made.order};
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
      if (family.kind == FamilyKind::product) {
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

// --------------------------------------------------------------------------------------------------------- archives

void LazyCells::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(families_.size()));
  for (const LazyFamily& family : families_) {
    to.put(family.kind);
    to.put(std::string_view{family.name});
    to.put_list(family.bodies);
    to.put(family.by_edges);
    to.put(family.apex);
    to.put(family.first);
    to.put(family.links);
    to.put(family.body);
    to.put_list(family.counts);
  }
  for (const LazyCell& cell : lazy_cells_) {  // their faces follow
    to.put(cell.key.family);
    to.put(cell.key.part);
    for (const Value& v : {cell.key.left, cell.key.right}) {
      to.put(v.cell);
      to.put(v.type);
      to.put(v.collapsed);
      to.put(v.order);
    }
  }
}

void LazyCells::load(sparse::ArchiveReader& from, std::uint32_t most_nested) {
  constexpr std::size_t least_bytes_of_family = 42;
  for (std::size_t left = from.get_count(least_bytes_of_family); left > 0 && from.is_good(); --left) {
    load_family(from, most_nested);
  }
  for (CellId node = asked_node(0); node < cells_.asked() && from.is_good(); ++node) {
    if (cells_.lazy(node) != none) {
      load_cell(from, node);
    }
  }
}

void LazyCells::load_family(sparse::ArchiveReader& from, std::uint32_t most_nested) {
  LazyFamily family;
  family.kind = from.get<FamilyKind>();
  family.name = from.get_text();
  family.bodies = from.get_list<std::vector<BodyId>>();
  family.by_edges = from.get_bool();
  family.apex = from.get<CellId>();
  family.first = from.get<CellId>();
  family.links = from.get<LinkId>();
  family.body = from.get<BodyId>();
  family.counts = from.get_list<std::vector<std::uint64_t>>();
  const auto is_inside = [&](BodyId body) {
    return body < bodies_.size() && bodies_.nesting(body) < bodies_.nesting(family.body);
  };
  const bool is_cone = family.kind == FamilyKind::cone;
  from.check(family.kind <= FamilyKind::cone && family.body < bodies_.size() &&
                 bodies_.nesting(family.body) <= most_nested && bodies_.made(family.body).family == families() &&
                 std::all_of(family.bodies.begin(), family.bodies.end(), is_inside) &&
                 (is_cone ? family.apex < cells_.size() && cells_.dimension(family.apex) == 0
                          : family.bodies.size() == 2 && family.apex == none) &&
                 family.first <= cells_.size() && family.links <= forest_.links() &&
                 family.counts.size() <= largest_dimension + 1,
             "a family is one of bodies that were there before it");
  if (from.is_good()) {
    add_family(family);
  }
}

/// Whether a value is one of a current cell of a body that a family is made of.
bool LazyCells::is_part(const Value& v, FamilyId of) const {
  const LazyFamily& family = families_[of];
  if (!cells_.contains(v.cell) || !forest_.is_current(v.cell) || !maps_.is_value_of(v, cells_.type_id(v.cell))) {
    return false;
  }
  if (is_asked_for(v.cell)) {
    const std::uint32_t number = cells_.lazy(v.cell);
    if (number == none || number >= lazy_cells_.size() || lazy_cells_[number].key.family >= of) {
      return false;
    }
  } else if (v.cell >= family.first) {
    return false;
  }
  const BodyId body = bodies_.find(cells_.body(v.cell));
  return std::any_of(family.bodies.begin(), family.bodies.end(),
                     [&](BodyId each) { return bodies_.find(each) == body; });
}

/// Whether a cell of a type can be the one that a key describes.
bool LazyCells::is_sound(const LazyKey& key, TypeId type) const {
  if (key.family >= families_.size() || !is_part(key.left, key.family)) {
    return false;
  }
  const LazyFamily& family = families_[key.family];
  CellType expected = types_.info(key.left.type).type;
  switch (key.part) {
    case LazyPart::coned:
      if (family.by_edges) {
        expected.push_back(1);
      } else if (!is_simplex(expected)) {
        return false;
      } else {
        expected = {types_.info(key.left.type).dimension + 1};
      }
      [[fallthrough]];
    case LazyPart::base:
      return family.kind == FamilyKind::cone && key.left.is_plain() && key.right == Value{} &&
             types_.info(type).type == expected;
    case LazyPart::pair:
      break;
  }
  if (key.part != LazyPart::pair || family.kind == FamilyKind::cone || !is_part(key.right, key.family)) {
    return false;
  }
  if (family.kind == FamilyKind::simplicial_product) {
    return type == key.left.type && type == key.right.type && is_simplex(expected) && key.left.order == same_order &&
           key.right.order == same_order && (key.left.collapsed & key.right.collapsed) == 0;
  }
  const CellType& right = types_.info(key.right.type).type;
  expected.insert(expected.end(), right.begin(), right.end());
  return key.left.is_plain() && key.right.is_plain() && types_.info(type).type == expected;
}

void LazyCells::load_cell(sparse::ArchiveReader& from, CellId node) {
  LazyKey key{};
  key.family = from.get<FamilyId>();
  key.part = from.get<LazyPart>();
  for (Value* v : {&key.left, &key.right}) {
    v->cell = from.get<CellId>();
    v->type = from.get<TypeId>();
    v->collapsed = from.get<Degeneracy>();
    v->order = from.get<OrderId>();
  }
  if (from.check(cells_.lazy(node) == lazy_cells_.size() && is_sound(key, cells_.type_id(node)) &&
                     cells_.body(node) == families_[key.family].body && index_.emplace(key, node).second,
                 "a cell of a family is made of cells that were there before it")) {
    lazy_cells_.push_back({key});
    made_[key.family].push_back(node);
  }
}

}  // namespace sesame::ops
