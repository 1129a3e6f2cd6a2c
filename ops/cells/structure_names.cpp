// What names denote, and what cells are called.
#include "ops/cells/structure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ops/cells/name_reader.hpp"
#include "ops/cells/name_text.hpp"

namespace sesame::ops {

std::string_view Structure::own_name(CellId c) const {
  if (nodes_->name[c] != none) {
    return names_[nodes_->name[c]].text;
  }
  if (families_.empty() || nodes_->lazy[c] == none) {
    return "(degenerate)";  // a node that no name can denote
  }
  LazyCell& lazy = nodes_->lazy_cells[nodes_->lazy[c]];
  if (lazy.name.empty()) {
    lazy.name = lazy_name(lazy.key);
  }
  return lazy.name;
}

std::string Structure::lazy_name(const LazyKey& key) const {
  const LazyFamily& family = families_[key.family];
  const auto written = [this](const Value& v) {
    std::string text{name(v.cell)};
    const char* separator = "^";
    for (int d = 0; d <= largest_dimension; ++d) {
      if ((v.collapsed >> d & 1) != 0) {
        text += separator + std::to_string(d);
        separator = ",";
      }
    }
    return text;
  };
  switch (key.part) {
    case LazyPart::base:
      return written(key.left);
    case LazyPart::coned:
      return fmt::format("{}*{}", family.name, written(key.left));
    case LazyPart::pair:
      break;
  }
  return fmt::format("{}.({}|{})", family.name, written(key.left), written(key.right));
}

namespace {

/// Calls visit(prefix, hash) for the parts of a name before which that of a lazy family may end.
template <class Visit>
void for_each_prefix(std::string_view name, Visit visit) {
  TextHash hash;
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (ends_prefix(name, k)) {
      visit(name.substr(0, k), hash);
    }
    hash.add(name[k]);
  }
}

}  // namespace

std::optional<Incidence> Structure::lookup_in_order(std::string_view name) const {
  const auto named = NameReader(*this, name).read();
  if (!named) {
    return std::nullopt;
  }
  Incidence found = named->is_degenerate() ? incidence_of(normal_form(*named)) : Incidence{named->cell, named->order};
  while (is_consumed(found.node)) {
    const FamilyId family = bodies_.consumed_by(nodes_->body[found.node]);
    if (families_[family].kind != FamilyKind::cone) {
      break;
    }
    found = lazy_face(family, LazyPart::base, maps_->reordered(found.order, value(found.node)));
  }
  return found;
}

bool Structure::is_name_taken(std::string_view name) const {
  return names_.find(name) != nullptr || NameReader(*this, name).read().has_value();
}

OrderId Structure::order_of_name(std::string_view name) const {
  const auto found = lookup_in_order(name);
  return found ? found->order : same_order;
}

Value Structure::named_value(CellId current) const {
  const CellId node = oldest(current);
  return maps_->reordered(order_of_own_name(node), value(node));
}

/// The name of a lazy cell has the names of others in it.
OrderId Structure::order_of_own_name(CellId node) const {
  const LazyCell* lazy = lazy_of(node);
  if (lazy == nullptr) {
    const auto at = name_orders_.empty() ? name_orders_.end() : name_orders_.find(node);
    return at == name_orders_.end() ? same_order : at->second;
  }
  const Value left = named_value(lazy->key.left.cell);
  switch (lazy->key.part) {
    case LazyPart::base:
      return left.order;
    case LazyPart::coned:
      return maps_->coned(none, left, families_[lazy->key.family].by_edges).order;
    case LazyPart::pair:
      break;
  }
  return families_[lazy->key.family].kind == FamilyKind::product
             ? maps_->product(none, left, named_value(lazy->key.right.cell)).order
             : same_order;
}

bool Structure::is_prefix_taken(std::string_view prefix) const {
  TextHash hash;
  hash.add(prefix);
  if (!prefixes_.contains(hash.word())) {
    return false;
  }
  for (std::uint32_t k = 0; k < names_.size(); ++k) {  // hardly ever in vain: hashes have 64 bits
    if (extends_name(names_[k].text, prefix)) {
      return true;
    }
  }
  return false;
}

bool Structure::is_ambiguous_prefix(std::string_view name) const {
  bool is_ambiguous = false;
  for_each_prefix(name, [&](std::string_view prefix, const TextHash& hash) {
    const NameTable::Name* known = names_.find(prefix, hash.value());
    is_ambiguous = is_ambiguous || (known != nullptr && (product_named(*known) != none ||
                                                         (known->cell != none && cone_from(known->cell) != nullptr)));
  });
  const auto extends = [&](std::string_view other) { return extends_name(other, name); };
  return is_ambiguous ||
         (is_prefix_taken(name) &&
          (std::any_of(cones_.begin(), cones_.end(), [&](const Cone& cone) { return extends(own_name(cone.apex)); }) ||
           std::any_of(families_.begin(), families_.end(),
                       [&](const LazyFamily& family) { return extends(family.name); })));
}

void Structure::add_name(std::string_view text, CellId cell, BodyId body) {
  if (!is_well_bracketed(text)) {
    odd_names_.push_back(names_.size());
  }
  names_.add(text, cell, body);
  for_each_prefix(text, [this](std::string_view, const TextHash& hash) { ++prefixes_[hash.word()]; });
}

void Structure::drop_last_name() {
  const std::uint32_t last = names_.size() - 1;
  for_each_prefix(names_[last].text, [this](std::string_view, const TextHash& hash) {
    if (const auto at = prefixes_.find(hash.word()); --at->second == 0) {
      prefixes_.erase(at);
    }
  });
  if (!odd_names_.empty() && odd_names_.back() == last) {
    odd_names_.pop_back();
  }
  names_.pop_back();
}

FamilyId Structure::product_named(const NameTable::Name& name) const {
  const FamilyId family = name.cell == none && name.body != none ? bodies_.made(name.body).family : none;
  return family != none && families_[family].kind != FamilyKind::cone ? family : none;
}

}  // namespace sesame::ops
