#include "ops/structure.hpp"

#include <algorithm>

#include "sparse/contract.hpp"

namespace sesame::ops {

using sparse::expects;

void Plan::clear() {
  cells.clear();
  faces.clear();
  names.clear();
  aliases.clear();
  merges.clear();
  new_body.reset();
  into_body.reset();
  joined_bodies.clear();
}

Structure::Structure() : types_{std::make_unique<TypeTable>()} {}

std::span<const std::uint32_t> Structure::counts() const {
  std::size_t used = counts_.size();
  while (used > 0 && counts_[used - 1] == 0) {
    --used;
  }
  return {counts_.data(), used};
}

std::optional<CellId> Structure::lookup(std::string_view name) const {
  const auto at = cell_by_name_.find(name);
  return at == cell_by_name_.end() ? std::nullopt : std::optional{at->second};
}

bool Structure::is_name_taken(std::string_view name) const {
  return cell_by_name_.contains(name) || body_by_name_.contains(name);
}

std::optional<BodyId> Structure::lookup_body(std::string_view name) const {
  const auto at = body_by_name_.find(name);
  return at == body_by_name_.end() ? std::nullopt : std::optional{find_body(at->second)};
}

BodyId Structure::find_body(BodyId b) const {
  while (bodies_[b].parent != b) {
    b = bodies_[b].parent;
  }
  return b;
}

std::vector<BodyId> Structure::current_bodies() const {
  std::vector<BodyId> current;
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].parent == b) {
      current.push_back(b);
    }
  }
  std::sort(current.begin(), current.end(),
            [this](BodyId a, BodyId b) { return bodies_[a].oldest < bodies_[b].oldest; });
  return current;
}

std::vector<CellId> Structure::cells_of(BodyId body) const {
  std::vector<CellId> cells;
  std::vector<BodyId> pending{find_body(body)};
  while (!pending.empty()) {
    const Body& b = bodies_[pending.back()];
    pending.pop_back();
    pending.insert(pending.end(), b.children.begin(), b.children.end());
    for (const Range& range : b.made) {
      for (CellId c = range.first; c < range.last; ++c) {
        if (is_current(c)) {
          cells.push_back(c);
        }
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

StructureMark Structure::mark() const {
  return {created(), links(), static_cast<std::uint32_t>(names_.size()), static_cast<std::uint32_t>(bodies_.size()),
          static_cast<std::uint32_t>(body_links_.size())};
}

void Structure::apply(const Plan& plan) {
  const CellId first = created();
  if (plan.new_body) {
    const auto id = static_cast<BodyId>(bodies_.size());
    bodies_.push_back({*plan.new_body, id, id, {}, {}, 1});
    body_by_name_.emplace(bodies_.back().name, id);
  }
  add_cells(plan);
  if (!plan.cells.empty()) {
    const BodyId body = plan.new_body ? static_cast<BodyId>(bodies_.size() - 1) : plan.into_body.value();
    body_.resize(type_.size(), body);
    bodies_[body].made.push_back({first, created()});
  }
  for (const BodyId joined : plan.joined_bodies) {
    join_bodies(plan.into_body.value(), joined);
  }
  for (const Merge& merge : plan.merges) {
    link(merge);
    join_bodies(body_of(merge.survivor), body_of(merge.removed));
  }
}

void Structure::add_cells(const Plan& plan) {
  std::uint64_t name_begin = 0;
  for (const Plan::NewCell& cell : plan.cells) {
    const CellId id = created();
    const std::size_t arity = types_->info(cell.type).faces.size();
    type_.push_back(cell.type);
    first_face_.push_back(faces_.size());
    const auto face = plan.faces.begin() + cell.first_face;
    faces_.insert(faces_.end(), face, face + static_cast<std::ptrdiff_t>(arity));
    parent_.push_back(id);
    oldest_.push_back(id);
    size_.push_back(1);
    link_of_.push_back(none);
    name_of_.push_back(static_cast<std::uint32_t>(names_.size()));
    add_name(std::string_view{plan.names}.substr(name_begin, cell.name_end - name_begin), id);
    name_begin = cell.name_end;
    count(id, 1);
  }
  for (const auto& [name, cell] : plan.aliases) {
    add_name(name, cell);
  }
}

void Structure::add_name(std::string_view text, CellId cell) {
  names_.push_back({std::string{text}, cell});
  const bool is_new = cell_by_name_.emplace(names_.back().text, cell).second;
  expects(is_new, "a plan's new names are free");
}

void Structure::link(const Merge& merge) {
  const auto [removed, survivor] = merge;
  expects(is_current(removed) && is_current(survivor) && removed != survivor, "a merge joins two current cells");
  link_of_[removed] = links();
  removed_.push_back(removed);
  oldest_before_.push_back(oldest_[survivor]);
  parent_[removed] = survivor;
  size_[survivor] += size_[removed];
  oldest_[survivor] = std::min(oldest_[survivor], oldest_[removed]);
  count(removed, -1);
}

void Structure::join_bodies(BodyId a, BodyId b) {
  a = find_body(a);
  b = find_body(b);
  if (a == b) {
    return;
  }
  if (bodies_[a].size < bodies_[b].size) {
    std::swap(a, b);
  }
  body_links_.push_back({b, bodies_[a].oldest});
  bodies_[b].parent = a;
  bodies_[a].children.push_back(b);
  bodies_[a].size += bodies_[b].size;
  bodies_[a].oldest = std::min(bodies_[a].oldest, bodies_[b].oldest);
}

void Structure::count(CellId c, int change) {
  const auto p = static_cast<std::size_t>(dimension(c));
  if (p >= counts_.size()) {
    counts_.resize(p + 1, 0);
  }
  counts_[p] += static_cast<std::uint32_t>(change);
}

void Structure::truncate(const StructureMark& mark) {
  while (body_links_.size() > mark.body_links) {
    const auto [child, oldest_before] = body_links_.back();
    body_links_.pop_back();
    Body& above = bodies_[bodies_[child].parent];
    above.children.pop_back();
    above.size -= bodies_[child].size;
    above.oldest = oldest_before;
    bodies_[child].parent = child;
  }
  while (links() > mark.links) {
    const CellId removed = removed_.back();
    const CellId survivor = parent_[removed];
    size_[survivor] -= size_[removed];
    oldest_[survivor] = oldest_before_.back();
    parent_[removed] = removed;
    link_of_[removed] = none;
    count(removed, 1);
    removed_.pop_back();
    oldest_before_.pop_back();
  }
  while (names_.size() > mark.names) {
    cell_by_name_.erase(names_.back().text);
    names_.pop_back();
  }
  if (created() > mark.cells) {
    for (CellId c = mark.cells; c < created(); ++c) {
      count(c, -1);
      std::vector<Range>& made = bodies_[body_[c]].made;
      if (!made.empty() && made.back().first >= mark.cells) {
        made.pop_back();
      }
    }
    faces_.resize(first_face_[mark.cells]);
    for (auto* column : {&type_, &parent_, &oldest_, &size_, &link_of_, &name_of_, &body_}) {
      column->resize(mark.cells);
    }
    first_face_.resize(mark.cells);
  }
  while (bodies_.size() > mark.bodies) {
    body_by_name_.erase(bodies_.back().name);
    bodies_.pop_back();
  }
}

}  // namespace sesame::ops
