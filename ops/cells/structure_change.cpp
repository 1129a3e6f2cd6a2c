// How plans are carried out, event by event.
#include "ops/cells/structure.hpp"

#include <algorithm>
#include <utility>

#include "ops/cells/product_darts.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {

using sparse::expects;

void Structure::apply(const Plan& plan) {
  const CellId first = cells_.size();
  expects(plan.cells.empty() || plan.first == first, "a plan is carried out in the state that it was made for");
  BodyId new_body = none;
  if (plan.new_body || plan.family) {
    note(EventKind::body, bodies_.size());
    const bool has_others = plan.map      ? !plan.map->is_by_simplices
                            : plan.family ? plan.family->kind == FamilyKind::map_product
                                          : std::ranges::any_of(plan.cells, [this](const auto& c) {
                                              return !is_simploid(types().info(c.type).type);
                                            });
    new_body = bodies_.add({plan.abstract.has_value(), true, has_others});
  }
  const Instant made = instant_of(forest_.links(), lazy_.families());
  for (const Plan::WrittenCone& cone : plan.cones) {
    note(EventKind::cone, cones_.size());
    cones_.add({first + cone.apex, first + cone.end, made, forest_.links(), none, cone.by_edges});
  }
  add_cells(plan, new_body);
  if (plan.family) {
    add_family(*plan.family, new_body);
  }
  if (cells_.size() > first && plan.sources.empty()) {
    bodies_.add_cells(new_body != none ? new_body : plan.into_body.value(), {first, cells_.size()});
  }
  for (const BodyId joined : plan.joined_bodies) {
    join_bodies(plan.into_body.value(), joined);
  }
  for (const Move& move : plan.moves) {
    make_move(move);
  }
  if (!plan.merges.empty() || !plan.deletions.empty()) {
    forest_.begin_step();
  }
  for (const CellId cell : plan.deletions) {
    take_away(cell);
  }
  for (const Merge& merge : plan.merges) {
    link(merge);
    if (merge.survivor != none) {
      join_bodies(body_of(merge.survivor), body_of(merge.removed));
    } else {
      join_bodies(body_of(merge.becomes.cell), body_of(merge.removed));
    }
  }
  if (plan.abstract) {
    change_abstract(plan, first);
  } else if (!abstract_.empty()) {
    leave_abstract(plan);
  }
  if (plan.map || !plan.sewings.empty() || !plan.extended.empty()) {
    change_darts(plan, first);
  }
  if (maps().has_orders()) {
    note_orders(plan, first);
  }
  coface_index_.on_end_of_step();
}

void Structure::change_darts(const Plan& plan, CellId first) {
  if (plan.map) {
    const std::uint32_t name = directory_.names().number_of(plan.new_body.value());  // that of the body may be older
    const bool has_levels = plan.map->map.size() == 0;
    std::shared_ptr<const DartCells> cells = plan.map->cells;
    CellId node = first;
    if (const auto& factors = plan.map->factors) {
      const FamilyId family = lazy_.families() - 1;
      cells = std::make_shared<const DartCells>(
          cells_of_product_darts(factors->first, factors->second, has_levels, family, lazy_, maps()));
      node = 0;  // they are nodes
    }
    note(EventKind::darts, darts_.events());
    if (has_levels) {
      darts_.add_chain(name, node, std::move(cells));
    } else {
      darts_.add(name, plan.map->map, node, std::move(cells), plan.map->is_by_simplices, plan.map->halves);
    }
  }
  if (!plan.extended.empty()) {
    std::vector<DartStore::Extension> extensions;
    for (const auto& [map, cells] : plan.extended) {
      extensions.push_back({map, cells});
    }
    for (std::size_t k = 0; k < extensions.size(); ++k) {
      note(EventKind::darts, darts_.events() + k);
    }
    darts_.extend(extensions);
  }
  for (const auto& [dimension, index, a, b, is_unsewn] : plan.sewings) {
    note(EventKind::darts, darts_.events());
    if (is_unsewn) {
      darts_.unsew(dimension, index, a, b);
    } else {
      darts_.sew(dimension, index, a, b);
    }
  }
  for (const auto& [dimension, of, dart, node] : plan.newly_seen) {
    note(EventKind::darts, darts_.events());
    darts_.see(dimension, of, dart, node);
  }
  for (const auto& [dimension, with, dart] : plan.darts_taken_out) {
    note(EventKind::darts, darts_.events());
    darts_.take_out(dimension, with, dart);
  }
}

/// Bodies where a cell and its faces do not have their vertices in the same order any more.
void Structure::note_orders(const Plan& plan, CellId first) {
  const auto lower = [this](BodyId body) {
    BodyKind kind = bodies_.kind(body);
    kind.keeps_orders = false;
    lower_kind(body, kind);
  };
  if (!plan.face_orders.empty()) {
    lower(body_of(first));
  }
  for (const Merge& merge : plan.merges) {
    if (merge.order != same_order || (merge.survivor == none && merge.becomes.order != same_order)) {
      lower(body_of(merge.removed));
    }
  }
  if (plan.family) {
    for (const BodyId body : plan.family->bodies) {
      if (!bodies_.kind(body).keeps_orders || plan.family->kind == FamilyKind::map_product) {
        lower(bodies_.size() - 1);
      }
    }
  }
}

void Structure::change_abstract(const Plan& plan, CellId first) {
  const AbstractChange& change = *plan.abstract;
  const std::uint32_t changes_before = abstract_.mark();
  for (const std::string& label : change.labels) {
    abstract_.add_label(label);
  }
  std::span<const VertexId> vertices = change.vertices;
  for (CellId c = first; c < cells_.size(); ++c) {
    const auto size = static_cast<std::size_t>(dimension(c)) + 1;
    abstract_.include(c, vertices.first(size));
    vertices = vertices.subspan(size);
  }
  for (const CellId cell : change.excluded) {
    abstract_.exclude(cell);
  }
  if (const auto& collapse = change.collapse) {
    for (const Merge& merge : plan.merges) {
      abstract_.exclude(merge.removed);
    }
    for (const CellId c : change.renamed) {
      abstract_.rename(c, collapse->gone, collapse->kept);
    }
    abstract_.contract_labels(collapse->from, collapse->to, collapse->kept);
  }
  for (std::uint32_t k = changes_before; k < abstract_.mark(); ++k) {
    note(EventKind::simplicial, k);
  }
}

/// The bodies that another operation changes are no abstract complexes any more.
void Structure::leave_abstract(const Plan& plan) {
  const auto leave = [this](BodyId body) {
    BodyKind kind = bodies_.kind(body);
    kind.is_abstract = false;
    lower_kind(body, kind);
  };
  for (const Merge& merge : plan.merges) {
    leave(body_of(merge.removed));
  }
  for (const CellId source : plan.sources) {
    leave(body_of(source));
  }
  for (const Move& move : plan.moves) {
    leave(body_of(move.cell));
  }
  if (plan.into_body) {
    leave(*plan.into_body);
  }
  if (plan.family) {
    for (const BodyId body : plan.family->bodies) {
      leave(body);
    }
  }
}

void Structure::lower_kind(BodyId body, BodyKind kind) {
  if (bodies_.lower_kind(body, kind)) {
    note(EventKind::body_kind, bodies_.kind_changes() - 1);
  }
}

void Structure::add_cells(const Plan& plan, BodyId new_body) {
  std::size_t name_begin = 0;
  auto next_degenerate = plan.degenerate.begin();
  auto next_order = plan.face_orders.begin();
  auto next_name = plan.name_orders.begin();
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    const Plan::NewCell& cell = plan.cells[k];
    for (; next_degenerate != plan.degenerate.end() && next_degenerate->first == k; ++next_degenerate) {
      (void)values_.incidence_of(next_degenerate->second);
    }
    const TypeInfo& type = types().info(cell.type);
    const CellId source = plan.sources.empty() ? none : plan.sources[k];
    const BodyId body = source != none ? body_of(source) : new_body != none ? new_body : plan.into_body.value();
    const CellId id = cells_.add(cell.type, directory_.names().size(), body);
    forest_.add(id);
    for (std::size_t f = cell.first_face; f < cell.first_face + type.faces.size(); ++f) {
      const bool has_order = next_order != plan.face_orders.end() && next_order->first == f;
      cells_.add_face(plan.faces[f], has_order ? next_order->second : same_order);
      next_order += has_order ? 1 : 0;
    }
    coface_index_.on_new_cell(id);
    if (plan.standard == none) {
      const std::string_view name = std::string_view{plan.names}.substr(name_begin, cell.name_end - name_begin);
      const bool is_of_body = plan.new_body && name == *plan.new_body;  // of the first vertex, say
      if (is_of_body) {
        bodies_.set_name(new_body, directory_.names().size());
      }
      directory_.add(name, id, is_of_body ? new_body : none);
      name_begin = cell.name_end;
    }
    count(id, 1);
    if (next_name != plan.name_orders.end() && next_name->first == k) {
      directory_.set_order(id, next_name->second);
      ++next_name;
    }
    if (source != none) {
      bodies_.add_cells(body, {id, id + 1});
      const Moment before = now();
      const auto earlier = static_cast<std::uint32_t>(k);  // copies of this step
      splits_.add_copy(
          {id,
           source,
           {id - earlier, before.links, before.moves, before.families, before.copies - earlier, before.asked}});
    }
    note(source == none ? EventKind::cell : EventKind::copy, id);
  }
  if (plan.standard != none) {
    bodies_.set_name(new_body, directory_.names().size());
    directory_.add_standard(*plan.new_body, plan.standard, cells_.size() - 1, new_body);
  }
  if (plan.new_body && !bodies_.is_named(new_body)) {
    note(EventKind::name, directory_.names().size());
    bodies_.set_name(new_body, directory_.names().size());
    directory_.add(*plan.new_body, none, new_body);
  }
}

void Structure::add_family(const NewFamily& family, BodyId body) {
  const FamilyId id = lazy_.families();
  const bool is_cone = family.kind == FamilyKind::cone;
  const CellId apex = is_cone ? cells_.size() - 1 : none;
  lazy_.add_family({family.kind, family.name, family.bodies, family.by_edges, apex, cells_.size(), forest_.links(),
                    body, family.counts});
  note(EventKind::family, id);
  if (is_cone) {
    cones_.add({apex, cells_.size(), instant_of(forest_.links(), id), forest_.links(), id, family.by_edges});
  }
  bodies_.become_family(body, id, family.bodies, family.counts, family.simploids, is_cone,
                        [this](std::span<const std::uint64_t> counts) { add_counts(counts, counts_, true); });
  add_counts(family.counts, counts_, false);
}

void Structure::link(const Merge& merge) {
  const auto& [removed, survivor, becomes, order] = merge;
  expects(is_current(removed) && removed != survivor && (survivor == none || is_current(survivor)),
          "a merge joins two current cells");
  note(EventKind::removal, forest_.links());
  count(removed, -1);
  coface_index_.before_removal(removed, survivor != none ? survivor : values_.normal_form(becomes).cell);
  if (survivor == none) {
    forest_.link_squashed(removed, becomes);
    return;
  }
  const CellId theirs = forest_.oldest(removed);
  const CellId ours = forest_.oldest(survivor);
  forest_.link(removed, survivor, order, maps().sign(order), lazy_.is_older(theirs, ours) ? theirs : ours);
}

void Structure::take_away(CellId cell) {
  expects(is_current(cell), "only a current cell can be taken away");
  note(EventKind::deletion, forest_.links());
  count(cell, -1);
  coface_index_.before_deletion();
  forest_.link_squashed(cell, {});
}

void Structure::make_move(const Move& move) {
  splits_.add_move(move, forest_.links(), cells_.faces(move.cell),
                   [&](std::uint32_t k) { return cells_.order(move.cell, k); });
  coface_index_.on_new_face(move.cell, move.to);
  note(EventKind::move, splits_.moves() - 1);
}

void Structure::join_bodies(BodyId a, BodyId b) {
  if (bodies_.join(a, b)) {
    note(EventKind::union_of_bodies, bodies_.unions() - 1);
  }
}

void Structure::count(CellId c, int change) {
  const auto p = static_cast<std::size_t>(dimension(c));
  if (is_cone_part(cells_.type(c).type)) {
    bodies_.count_part(p, change);
    return;
  }
  if (p >= counts_.size()) {
    counts_.resize(p + 1, 0);
  }
  counts_[p] += static_cast<std::uint64_t>(std::int64_t{change});
  bodies_.count(body_of(c), p, is_simplex(cells_.type(c).type), change);
}

}  // namespace sesame::ops
