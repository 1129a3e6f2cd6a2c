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
  const NameTable::Name* found = names_.find(name);
  return found == nullptr || found->cell == none ? std::nullopt : std::optional{found->cell};
}

std::optional<BodyId> Structure::lookup_body(std::string_view name) const {
  const NameTable::Name* found = names_.find(name);
  return found == nullptr || found->body == none ? std::nullopt : std::optional{find_body(found->body)};
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
  return {created(), links(), names_.size(), static_cast<std::uint32_t>(bodies_.size()),
          static_cast<std::uint32_t>(body_links_.size())};
}

void Structure::apply(const Plan& plan) {
  const CellId first = created();
  const auto new_body = plan.new_body ? static_cast<BodyId>(bodies_.size()) : none;
  if (plan.new_body) {
    bodies_.push_back({none, new_body, new_body, {}, {}, 1});
  }
  add_cells(plan, new_body);
  if (!plan.cells.empty()) {
    const BodyId body = plan.new_body ? new_body : plan.into_body.value();
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

void Structure::add_cells(const Plan& plan, BodyId new_body) {
  std::size_t name_begin = 0;
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
    name_of_.push_back(names_.size());
    const std::string_view name = std::string_view{plan.names}.substr(name_begin, cell.name_end - name_begin);
    if (plan.new_body && name == *plan.new_body) {  // the name of the whole, or of the first vertex, is the body's too
      bodies_[new_body].name = names_.size();
      names_.add(name, id, new_body);
    } else {
      names_.add(name, id, none);
    }
    name_begin = cell.name_end;
    count(id, 1);
  }
  for (const auto& [name, cell] : plan.aliases) {
    names_.add(name, cell, none);
  }
  if (plan.new_body && bodies_[new_body].name == none) {
    bodies_[new_body].name = names_.size();
    names_.add(*plan.new_body, none, new_body);
  }
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
  bodies_.erase(bodies_.begin() + mark.bodies, bodies_.end());
}

}  // namespace sesame::ops
