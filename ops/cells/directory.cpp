#include "ops/cells/directory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ops/cells/name_text.hpp"

namespace sesame::ops {

std::string_view Directory::own_name(CellId c) const {
  if (cells_.name(c) != none) {
    return names_[cells_.name(c)].text;
  }
  const LazyCell* lazy = lazy_.of(c);
  if (lazy == nullptr) {
    return "(degenerate)";  // a node that no name can denote
  }
  if (lazy->name.empty()) {
    lazy->name = name_of_lazy(lazy->key);
  }
  return lazy->name;
}

std::string Directory::name_of_lazy(const LazyKey& key) const {
  const LazyFamily& family = lazy_.family(key.family);
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

Value Directory::named_value(CellId current) const {
  const CellId node = forest_.oldest(current);
  return maps_.reordered(order_of_own_name(node), values_.of(node));
}

/// The name of a lazy cell has the names of others in it.
OrderId Directory::order_of_own_name(CellId node) const {
  const LazyCell* lazy = lazy_.of(node);
  if (lazy == nullptr) {
    const auto at = orders_.empty() ? orders_.end() : orders_.find(node);
    return at == orders_.end() ? same_order : at->second;
  }
  const Value left = named_value(lazy->key.left.cell);
  switch (lazy->key.part) {
    case LazyPart::base:
      return left.order;
    case LazyPart::coned:
      return maps_.coned(none, left, lazy_.family(lazy->key.family).by_edges).order;
    case LazyPart::pair:
      break;
  }
  return lazy_.family(lazy->key.family).kind == FamilyKind::product
             ? maps_.product(none, left, named_value(lazy->key.right.cell)).order
             : same_order;
}

bool Directory::is_prefix_taken(std::string_view prefix) const {
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

bool Directory::is_ambiguous_prefix(std::string_view name) const {
  bool is_ambiguous = false;
  for_each_prefix(name, [&](std::string_view prefix, const TextHash& hash) {
    const NameTable::Name* known = names_.find(prefix, hash.value());
    is_ambiguous = is_ambiguous || (known != nullptr && (product_named(*known) != none ||
                                                         (known->cell != none && cones_.from(known->cell) != nullptr)));
  });
  const auto extends = [&](std::string_view other) { return extends_name(other, name); };
  return is_ambiguous ||
         (is_prefix_taken(name) &&
          (std::any_of(cones_.begin(), cones_.end(), [&](const Cone& cone) { return extends(own_name(cone.apex)); }) ||
           lazy_.any_family([&](const LazyFamily& family) { return extends(family.name); })));
}

void Directory::add(std::string_view text, CellId cell, BodyId body) {
  if (!is_well_bracketed(text)) {
    odd_.push_back(names_.size());
  }
  names_.add(text, cell, body);
  for_each_prefix(text, [this](std::string_view, const TextHash& hash) { ++prefixes_[hash.word()]; });
}

void Directory::pop_back() {
  const std::uint32_t last = names_.size() - 1;
  for_each_prefix(names_[last].text, [this](std::string_view, const TextHash& hash) {
    if (const auto at = prefixes_.find(hash.word()); --at->second == 0) {
      prefixes_.erase(at);
    }
  });
  if (!odd_.empty() && odd_.back() == last) {
    odd_.pop_back();
  }
  names_.pop_back();
}

FamilyId Directory::product_named(const NameTable::Name& name) const {
  const FamilyId family = name.cell == none && name.body != none ? bodies_.made(name.body).family : none;
  return family != none && lazy_.family(family).kind != FamilyKind::cone ? family : none;
}

}  // namespace sesame::ops
