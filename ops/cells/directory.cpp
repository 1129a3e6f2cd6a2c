#include "ops/cells/directory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ops/cells/name_text.hpp"

namespace sesame::ops {
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

/// The hash of "t" for a text that looks like "t.0-1".
std::optional<std::uint64_t> hash_of_base(std::string_view text) {
  const auto split = split_vertices(text);
  if (!split) {
    return std::nullopt;
  }
  TextHash hash;
  hash.add(text.substr(0, split->length));
  return hash.word();
}

void take_one(std::uint64_t hash, std::unordered_map<std::uint64_t, std::uint32_t>& counts) {
  if (const auto at = counts.find(hash); --at->second == 0) {
    counts.erase(at);
  }
}

/// Faces come right before the whole.
CellId first_of(const NameTable::Name& whole, const StandardCell& standard) {
  return whole.cell - (standard.cells.size() - 1);
}

/// The face of a standard simploid that has some vertices, or none: not the whole, but for "t.0" of a vertex.
CellId face_named(const NameTable::Name& whole, std::string_view vertices, TypeTable& types) {
  if (whole.standard == none) {
    return none;
  }
  if (whole.standard == types.vertex()) {
    return vertices == "0" ? whole.cell : CellId{none};
  }
  const StandardCell& standard = types.standard(whole.standard);
  const std::uint32_t position = standard.find(vertices);
  return position < standard.cells.size() - 1 ? first_of(whole, standard) + position : CellId{none};
}

}  // namespace

std::string Directory::own_name(CellId c) const {
  if (cells_.name(c) != none) {
    const NameTable::Name& name = names_[cells_.name(c)];
    if (c == name.cell) {
      return name.text;
    }
    const StandardCell& standard = maps_.types().standard(name.standard);
    const std::string& suffix = standard.cells[c - first_of(name, standard)].suffix;
    std::string text;
    text.reserve(name.text.size() + 1 + suffix.size());
    return text.append(name.text).append(1, '.').append(suffix);
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

/// `hash_of(length)` is the hash of the beginning of the text; it is asked with lengths that increase.
template <class HashOf>
std::optional<Directory::Named> Directory::find_by(std::string_view text, HashOf&& hash_of) const {
  if (const auto split = split_vertices(text)) {
    const NameTable::Name* whole = names_.find(text.substr(0, split->length), hash_of(split->length));
    if (const CellId cell = whole == nullptr ? CellId{none} : face_named(*whole, split->vertices, maps_.types());
        cell != none) {
      return Named{cell, none};
    }
    ++further_looks_;
  }
  const NameTable::Name* name = names_.find(text, hash_of(text.size()));
  return name == nullptr ? std::nullopt : std::optional{Named{name->cell, name->body}};
}

std::optional<Directory::Named> Directory::find(std::string_view text) const {
  TextHash hash;
  std::size_t hashed = 0;
  return find_by(text, [&](std::size_t length) {
    hash.add(text.substr(hashed, length - hashed));
    hashed = length;
    return hash.value();
  });
}

std::optional<Directory::Named> Directory::find(std::string_view text, const PartHashes& hashes,
                                                std::size_t begin) const {
  return find_by(text, [&](std::size_t length) { return hashes.value(begin, begin + length); });
}

bool Directory::may_have_faces_named(std::string_view name) const {
  TextHash hash;
  hash.add(name);
  if (like_faces_.contains(hash.word())) {
    return true;
  }
  bool may_be_derived = false;  // from "c.0", with a name that "v*c" has not
  for_each_prefix(name, [&](std::string_view, const TextHash&) { may_be_derived = true; });
  return may_be_derived;
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
  switch (lazy_.family(lazy->key.family).kind) {
    case FamilyKind::product:
      return maps_.product(none, left, named_value(lazy->key.right.cell)).order;
    case FamilyKind::map_product:
      return lazy_.face(lazy->key.family, LazyPart::pair, left, named_value(lazy->key.right.cell)).order;
    default:
      return same_order;
  }
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

/// Names of faces have no more prefixes than that of the whole, and no more brackets.
void Directory::add(std::string_view text, CellId cell, BodyId body, TypeId standard) {
  names_.add(text, cell, body, standard);
  add_to_indexes(names_.size() - 1);
}

void Directory::add_to_indexes(std::uint32_t number) {
  const std::string_view text = names_[number].text;
  if (!is_well_bracketed(text)) {
    odd_.push_back(number);
    count_of_odd_ += weight(number);
  }
  for_each_prefix(text, [this](std::string_view, const TextHash& hash) { ++prefixes_[hash.word()]; });
  if (const auto base = hash_of_base(text)) {
    ++like_faces_[*base];
  }
}

void Directory::pop_back() {
  const std::uint32_t last = names_.size() - 1;
  const std::string& text = names_[last].text;
  for_each_prefix(text, [this](std::string_view, const TextHash& hash) { take_one(hash.word(), prefixes_); });
  if (const auto base = hash_of_base(text)) {
    take_one(*base, like_faces_);
  }
  if (!odd_.empty() && odd_.back() == last) {
    odd_.pop_back();
    count_of_odd_ -= weight(last);
  }
  names_.pop_back();
}

std::uint64_t Directory::weight(std::uint32_t number) const {
  const TypeId standard = names_[number].standard;
  return standard == none ? 1 : std::max(maps_.types().standard(standard).cells.size(), std::size_t{2});
}

FamilyId Directory::product_named(const NameTable::Name& name) const {
  const FamilyId family = name.cell == none && name.body != none ? bodies_.made(name.body).family : none;
  return family != none && lazy_.family(family).kind != FamilyKind::cone ? family : none;
}

// --------------------------------------------------------------------------------------------------------- archives

void Directory::save(sparse::ArchiveWriter& to) const {
  names_.save(to);
  to.put_map(orders_);
}

void Directory::load(sparse::ArchiveReader& from) {
  names_.load(from);
  std::uint64_t named = 0;  // cells: each has the number of one name
  for (std::uint32_t number = 0; number < names_.size() && from.is_good(); ++number) {
    if (from.check(is_sound(number), "a name denotes a cell or a body, or both")) {
      add_to_indexes(number);
      const NameTable::Name& name = names_[number];
      named += name.standard != none ? maps_.types().standard(name.standard).cells.size() : name.cell != none ? 1 : 0;
    }
  }
  from.check(named == cells_.size(), "each cell has a name");
  for (BodyId b = 0; b < bodies_.size() && from.is_good(); ++b) {
    from.check(bodies_.name(b) < names_.size(), "each body has a name");
  }
  from.get_map<CellId, OrderId>([&](CellId node, OrderId order) {
    if (from.check(node < cells_.size() && maps_.is_order_of(order, cells_.type_id(node)),
                   "a name has the vertices of its cell in an order")) {
      orders_.emplace(node, order);
    }
  });
}

bool Directory::is_sound(std::uint32_t number) const {
  const auto& [text, cell, body, standard] = names_[number];
  if ((cell != none && (cell >= cells_.size() || cells_.name(cell) != number)) ||
      (body != none && (body >= bodies_.size() || !bodies_.is_named(body)))) {
    return false;
  }
  if (standard == none) {
    return true;
  }
  if (cell == none || standard != cells_.type_id(cell)) {
    return false;
  }
  const CellType& type = maps_.types().info(standard).type;
  if (!is_of_map(type) && standard_cell_count(type) - 1 > std::int64_t{std::uint32_t{cell}}) {
    return false;
  }
  const std::vector<StandardFace>& faces = maps_.types().standard(standard).cells;
  if (faces.size() - 1 > cell) {
    return false;
  }
  const CellId first = cell - (faces.size() - 1);  // they are right before the whole
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (cells_.name(first + k) != number || cells_.type_id(first + k) != faces[k].type) {
      return false;
    }
  }
  return true;
}

}  // namespace sesame::ops
