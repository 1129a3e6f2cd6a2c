#include "ops/cells/bodies.hpp"

#include <utility>

namespace sesame::ops {

std::vector<BodyId> Bodies::current() const {
  std::vector<BodyId> current;
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].parent == b && bodies_[b].consumed_by == none) {
      current.push_back(b);
    }
  }
  std::sort(current.begin(), current.end(),
            [this](BodyId a, BodyId b) { return bodies_[a].oldest < bodies_[b].oldest; });
  return current;
}

BodyId Bodies::add(BodyKind kind) {
  const BodyId b = size();
  Body& body = bodies_.emplace_back();
  body.parent = body.oldest = b;
  body.kind = kind;
  return b;
}

void Bodies::drop_cell(BodyId b, CellId cell) {
  std::vector<Range>& cells = bodies_[b].made.cells;
  if (!cells.empty() && cells.back().last == cell + 1) {
    cells.back().last = cell;
    if (cells.back().first == cell) {
      cells.pop_back();
    }
  }
}

void Bodies::count(BodyId b, std::size_t dimension, bool is_simplex, int change) {
  Body& body = bodies_[find(b)];
  const auto difference = static_cast<std::uint64_t>(std::int64_t{change});
  if (dimension >= body.counts.size()) {
    body.counts.resize(dimension + 1, 0);
  }
  body.counts[dimension] += difference;
  body.simploids += is_simplex ? 0 : difference;
}

void Bodies::count_part(std::size_t dimension, int change) {
  if (dimension >= parts_.size()) {
    parts_.resize(dimension + 1, 0);
  }
  parts_[dimension] += static_cast<std::uint64_t>(std::int64_t{change});
}

bool Bodies::join(BodyId a, BodyId b) {
  a = find(a);
  b = find(b);
  if (a == b) {
    return false;
  }
  if (bodies_[a].size < bodies_[b].size) {
    std::swap(a, b);
  }
  Body& above = bodies_[a];
  Body& child = bodies_[b];
  unions_.push_back({b, above.oldest, above.kind, above.nesting});
  above.kind = {above.kind.is_abstract && child.kind.is_abstract, above.kind.keeps_orders && child.kind.keeps_orders,
                above.kind.has_others || child.kind.has_others};
  above.nesting = std::max(above.nesting, child.nesting);
  child.parent = a;
  above.made.children.push_back(b);
  above.size += child.size;
  above.oldest = std::min(above.oldest, child.oldest);
  above.simploids += child.simploids;
  add_counts(child.counts, above.counts, false);
  return true;
}

void Bodies::undo_last_union() {
  const Union last = unions_.back();
  unions_.pop_back();
  Body& child = bodies_[last.child];
  Body& above = bodies_[child.parent];
  above.simploids -= child.simploids;
  add_counts(child.counts, above.counts, true);
  above.made.children.pop_back();
  above.size -= child.size;
  above.oldest = last.oldest_before;
  above.kind = last.kind_before;
  above.nesting = last.nesting_before;
  child.parent = last.child;
}

bool Bodies::lower_kind(BodyId b, BodyKind kind) {
  b = find(b);
  if (bodies_[b].kind == kind) {
    return false;
  }
  kind_changes_.push_back({b, bodies_[b].kind});
  bodies_[b].kind = kind;
  return true;
}

void Bodies::undo_last_kind_change() {
  bodies_[kind_changes_.back().body].kind = kind_changes_.back().before;
  kind_changes_.pop_back();
}

// --------------------------------------------------------------------------------------------------------- archives

/// What is said of current bodies is written for these only; the bodies below one follow from what they are part of.
void Bodies::save(sparse::ArchiveWriter& to) const {
  const auto put = [&](auto&& field) {
    std::vector<std::uint32_t> column;
    column.reserve(bodies_.size());
    for (const Body& body : bodies_) {
      column.push_back(field(body));
    }
    to.put_list(column);
  };
  put([](const Body& body) { return body.name; });
  put([](const Body& body) { return body.parent; });
  put([](const Body& body) { return body.size; });
  put([](const Body& body) { return body.made.family; });
  put([](const Body& body) { return static_cast<std::uint32_t>(body.made.cells.size()); });
  std::vector<Range> ranges;
  for (const Body& body : bodies_) {
    ranges.insert(ranges.end(), body.made.cells.begin(), body.made.cells.end());
  }
  to.put_list(ranges);
  for (BodyId b = 0; b < size(); ++b) {
    if (const Body& body = bodies_[b]; body.parent == b) {
      to.put(body.oldest);
      to.put(body.consumed_by);
      to.put(body.nesting);
      to.put(body.kind.is_abstract);
      to.put(body.kind.keeps_orders);
      to.put(body.kind.has_others);
      to.put(body.simploids);
      to.put_list(body.counts);
    }
  }
}

void Bodies::load(sparse::ArchiveReader& from) {
  using Column = std::vector<std::uint32_t>;
  const auto names = from.get_list<Column>(), parents = from.get_list<Column>(), sizes = from.get_list<Column>(),
             families = from.get_list<Column>(), lengths = from.get_list<Column>();
  const auto ranges = from.get_list<std::vector<Range>>();
  const std::size_t count = names.size();
  if (!from.check(count < none && parents.size() == count && sizes.size() == count && families.size() == count &&
                      lengths.size() == count,
                  "each body has a name and parts")) {
    return;
  }
  bodies_.resize(count);
  auto next = ranges.begin();
  bool is_sound = true;
  for (BodyId b = 0; b < count && is_sound; ++b) {
    Body& body = bodies_[b];
    body.name = names[b];
    body.parent = BodyId{parents[b]};
    body.size = sizes[b];
    body.made.family = FamilyId{families[b]};
    // Parents have at least twice as many bodies below them: so one comes to an end, and soon.
    is_sound = parents[b] < count && body.size > 0 && (parents[b] == b || sizes[parents[b]] / 2 >= body.size) &&
               lengths[b] <= static_cast<std::size_t>(ranges.end() - next);
    if (is_sound) {
      body.made.cells.assign(next, next + static_cast<std::ptrdiff_t>(lengths[b]));
      next += static_cast<std::ptrdiff_t>(lengths[b]);
      if (parents[b] != b) {
        bodies_[parents[b]].made.children.push_back(b);
      }
    }
  }
  from.check(is_sound && next == ranges.end(), "bodies are parts of larger ones");
  for (BodyId b = 0; b < count && from.is_good(); ++b) {
    if (Body& body = bodies_[b]; body.parent == b) {
      body.oldest = from.get<BodyId>();
      body.consumed_by = from.get<FamilyId>();
      body.nesting = from.get<std::uint32_t>();
      body.kind.is_abstract = from.get_bool();
      body.kind.keeps_orders = from.get_bool();
      body.kind.has_others = from.get_bool();
      body.simploids = from.get<std::uint64_t>();
      body.counts = from.get_list<std::vector<std::uint64_t>>();
      from.check(body.oldest < count && body.counts.size() <= largest_dimension + 1, "bodies have cells");
    }
  }
}

void add_counts(std::span<const std::uint64_t> from, std::vector<std::uint64_t>& to, bool subtract) {
  if (to.size() < from.size()) {
    to.resize(from.size(), 0);
  }
  for (std::size_t p = 0; p < from.size(); ++p) {
    to[p] = subtract ? to[p] - from[p] : to[p] + from[p];
  }
}

}  // namespace sesame::ops
