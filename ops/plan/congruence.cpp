#include "ops/plan/congruence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace sesame::ops {
namespace {

/// The vertices of a type by where a map sends them, each component on its own.
struct Fibres {
  std::vector<std::size_t> rank;  ///< per vertex: how many before it go to the same vertex
  std::vector<std::size_t> left;  ///< and how many after it
  std::size_t most = 0;           ///< of the ranks
};

Fibres fibres_of(const VertexMap& map, const CellType& type) {
  Fibres fibres;
  std::size_t begin = 0;
  for (const int a : type) {
    const std::size_t end = begin + static_cast<std::size_t>(a) + 1;
    for (std::size_t k = begin; k < end; ++k) {
      const auto like_k = [&](std::size_t from, std::size_t to) {
        return static_cast<std::size_t>(std::count(map.begin() + static_cast<std::ptrdiff_t>(from),
                                                   map.begin() + static_cast<std::ptrdiff_t>(to), map[k]));
      };
      fibres.rank.push_back(like_k(begin, k));
      fibres.left.push_back(like_k(k + 1, end));
      fibres.most = std::max(fibres.most, fibres.rank.back());
    }
    begin = end;
  }
  return fibres;
}

}  // namespace

Result<std::vector<Merge>> Congruence::close(const std::vector<Equation>& equations) {
  forget_entries();
  foldings_.clear();
  pending_ = equations;
  while (!pending_.empty()) {
    const Value one = value(pending_.back().first);
    const Value other = value(pending_.back().second);
    pending_.pop_back();
    equate(one, other);
    if (pending_.empty()) {
      if (Status s = settle_foldings(); !s) {
        return s.error();
      }
    }
  }
  return merges();
}

void Congruence::equate(Value one, Value other) {
  if (one == other) {
    return;
  }
  if (one.is_degenerate() && other.is_degenerate()) {
    add_restrictions(one, other);
    add_restrictions(other, one);
    return;
  }
  if (one.is_degenerate() ||
      (!other.is_degenerate() && one.cell != other.cell && structure_.lazy().is_older(one.cell, other.cell))) {
    std::swap(one, other);
  }
  if (one.order != same_order) {  // written in the order of the cell
    other = structure_.maps().reordered(structure_.maps().inverse(one.order), other);
    one = structure_.values().plain(one.cell);
  }
  if (!send(one.cell, other)) {
    return;
  }
  const auto arity = static_cast<std::uint32_t>(structure_.cells().type(one.cell).faces.size());
  for (std::uint32_t k = 0; k < arity; ++k) {
    pending_.emplace_back(structure_.values().face(one, k), structure_.values().face(other, k));
  }
}

bool Congruence::send(CellId cell, const Value& becomes) {
  if (becomes.cell == cell && !becomes.is_degenerate()) {
    return foldings_.emplace(cell, becomes.order).second;
  }
  const std::uint32_t entry = touch(cell);
  if (!becomes.is_degenerate()) {
    touch(becomes.cell);
  }
  entries_[entry] = {cell, becomes.is_degenerate() ? none : becomes.cell, becomes};
  return true;
}

std::uint32_t Congruence::touch(CellId c) {
  const std::uint32_t known = entry_of(c);
  if (known != none) {
    return known;
  }
  const auto entry = static_cast<std::uint32_t>(entries_.size());
  if (entries_.size() == entries_.capacity()) {  // first what may fail: the index has no entry that there is not
    entries_.reserve(2 * entries_.size() + 16);
  }
  index_.insert(hash_of(c), entry);
  entries_.push_back({c, c, {}});
  return entry;
}

/// One by one: the index may be much larger than they are many.
void Congruence::forget_entries() {
  while (!entries_.empty()) {
    index_.erase(hash_of(entries_.back().cell), static_cast<std::uint32_t>(entries_.size()) - 1);
    entries_.pop_back();
  }
}

Value Congruence::root(CellId c) {
  const auto above = [this](CellId cell) -> Entry* {
    const std::uint32_t k = entry_of(cell);
    return k == none || entries_[k].parent == cell || entries_[k].parent == none ? nullptr : &entries_[k];
  };
  Value v = structure_.values().plain(c);
  while (Entry* at = above(v.cell)) {
    if (const Entry* next = above(at->parent)) {  // paths are halved as they are gone
      *at = {at->cell, next->parent, structure_.maps().compose(at->becomes, next->becomes)};
    }
    v = structure_.maps().compose(v, at->becomes);
  }
  return v;
}

Value Congruence::value(Value v) {
  v = structure_.values().normal_form(v);
  while (true) {
    v = structure_.maps().compose(v, root(v.cell));
    const std::uint32_t k = entry_of(v.cell);
    if (k == none || entries_[k].parent != none) {
      return v;
    }
    v = structure_.maps().compose(v, entries_[k].becomes);
  }
}

/// Sections: choices of a vertex for each vertex of the cell underneath. Number r takes the r-th of those that go to
/// it, or the last; so between them they take every vertex.
void Congruence::add_restrictions(const Value& one, const Value& other) {
  const auto [rank, left, most] = fibres_of(structure_.maps().map_of(one), structure_.types().info(one.type).type);
  for (std::size_t r = 0; r <= most; ++r) {
    Value a = one;
    Value b = other;
    for (std::size_t k = rank.size(); k-- > 0;) {  // the numbers of those before are not changed
      if (rank[k] != r && (rank[k] > r || left[k] > 0)) {
        a = structure_.values().face(a, static_cast<std::uint32_t>(k));
        b = structure_.values().face(b, static_cast<std::uint32_t>(k));
      }
    }
    pending_.emplace_back(a, b);
  }
}

Status Congruence::settle_foldings() {
  for (auto at = foldings_.begin(); at != foldings_.end();) {
    const Value cell = structure_.values().plain(at->first);
    const Value one = value(cell);
    const Value other = value(structure_.maps().reordered(at->second, cell));
    if (one.is_degenerate() && !(one == other)) {
      pending_.emplace_back(one, other);
    }
    at = one.is_degenerate() ? foldings_.erase(at) : std::next(at);
  }
  if (!pending_.empty() || foldings_.empty()) {
    return Done{};
  }
  const auto& [cell, order] = *foldings_.rbegin();
  if (is_of_map(structure_.cells().type(cell).type)) {
    return Error{Errc::refused, fmt::format("this would glue \"{}\" to itself as it is seen from another dart, and so "
                                            "fold it: subdivide it first, or make the maps \"as\":\"simplices\"",
                                            structure_.name(cell))};
  }
  return Error{Errc::refused,
               fmt::format("this would glue \"{}\" to itself with its vertices in the order {}, and so fold it: "
                           "subdivide the cells that are to be glued first, so that no cell meets itself",
                           structure_.name(cell), fmt::join(structure_.maps().permutation(order), "-"))};
}

/// By dimension, and there in the order in which the roots of the classes came.
std::vector<Merge> Congruence::merges() {
  members_.clear();
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    members_.push_back({structure_.dimension(entries_[k].cell), entry_of(root(entries_[k].cell).cell), k});
  }
  std::sort(members_.begin(), members_.end());
  std::vector<Merge> all;
  all.reserve(members_.size());
  for (std::span<const Member> rest{members_}; !rest.empty();) {
    const auto other = std::find_if(rest.begin(), rest.end(), [&](const Member& m) { return m.root != rest[0].root; });
    const auto size = static_cast<std::size_t>(other - rest.begin());
    add_merges(rest.first(size), all);
    rest = rest.subspan(size);
  }
  return all;
}

/// The survivor of a class is the cell that stands for the most cells (the oldest of those): with it every path of the
/// union-find forest stays logarithmic without compression, which undo could not take back.
void Congruence::add_merges(std::span<const Member> of_class, std::vector<Merge>& out) {
  of_class_.clear();
  for (const Member& member : of_class) {
    of_class_.push_back(entries_[member.entry].cell);
  }
  std::sort(of_class_.begin(), of_class_.end(), [this](CellId a, CellId b) {
    const std::uint32_t m = structure_.forest().members(a);
    const std::uint32_t n = structure_.forest().members(b);
    return m != n ? m > n : structure_.lazy().is_older(structure_.forest().oldest(a), structure_.forest().oldest(b));
  });
  VertexMaps& maps = structure_.maps();
  const CellId survivor = of_class_[0];
  const Value seen_from_survivor = root(survivor);
  const OrderId back = maps.inverse(seen_from_survivor.order);
  for (std::size_t k = 1; k < of_class_.size(); ++k) {
    out.push_back({of_class_[k], survivor, {}, maps.compose(root(of_class_[k]).order, back)});
  }
  if (const Entry& entry = entries_[of_class[0].root]; entry.parent == none) {
    out.push_back({survivor, none, maps.compose(seen_from_survivor, entry.becomes)});
  }
}

}  // namespace sesame::ops
