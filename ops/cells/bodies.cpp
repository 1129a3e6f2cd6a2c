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
  above.kind = {above.kind.is_abstract && child.kind.is_abstract, above.kind.keeps_orders && child.kind.keeps_orders};
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

void add_counts(std::span<const std::uint64_t> from, std::vector<std::uint64_t>& to, bool subtract) {
  if (to.size() < from.size()) {
    to.resize(from.size(), 0);
  }
  for (std::size_t p = 0; p < from.size(); ++p) {
    to[p] = subtract ? to[p] - from[p] : to[p] + from[p];
  }
}

}  // namespace sesame::ops
