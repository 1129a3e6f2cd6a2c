// Cones and suspensions: written out, or over many cells as a lazy family.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "ops/cells/cell_order.hpp"
#include "ops/cells/cone_parts.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

// -------------------------------------------------------------------------------------------------- what is coned over

/// The bodies that a cone is taken over wholly, or nothing when it is taken over listed cells.
Result<std::optional<std::vector<BodyId>>> coned_bodies(const ConeBase& over, const Structure& structure) {
  std::optional<std::vector<BodyId>> bodies;
  if (const auto* name = std::get_if<std::string>(&over)) {
    const auto body = resolve_body(*name, structure);
    if (!body) {
      return structure.lookup(*name) && !structure.lookup_body(*name)
                 ? Error{Errc::unknown_name,
                         fmt::format("there is no body \"{0}\": this is a cell; to cone over it give a list, [\"{0}\"]",
                                     *name)}
                 : body.error();
    }
    bodies = std::vector<BodyId>{*body};
  } else if (std::holds_alternative<std::monostate>(over)) {
    bodies = structure.bodies().current();
    std::erase_if(*bodies, [&](BodyId body) {  // all cells of which were removed
      const auto counts = structure.bodies().counts(body);
      return std::all_of(counts.begin(), counts.end(), [](std::uint64_t count) { return count == 0; });
    });
  }
  return bodies;
}

std::uint64_t cells_in(const std::vector<BodyId>& bodies, const Structure& structure) {
  std::uint64_t cells = 0;
  for (const BodyId body : bodies) {
    const auto counts = structure.bodies().counts(body);
    cells = std::accumulate(counts.begin(), counts.end(), cells);
  }
  return cells;
}

/// The cells listed, with all their faces and their parts.
Result<std::vector<CellId>> closure(const std::vector<std::string>& names, const Structure& structure) {
  std::vector<CellId> cells;
  std::unordered_set<CellId> seen;
  std::vector<CellId> pending;
  for (const std::string& name : names) {
    const Result<Value> named = resolve_cell(name, structure);
    if (!named) {
      return named.error();
    }
    pending.push_back(named->cell);
  }
  while (!pending.empty()) {
    const CellId c = pending.back();
    pending.pop_back();
    if (seen.insert(c).second) {
      cells.push_back(c);
      if (is_cone_part(structure.cells().type(c).type)) {
        pending.push_back(whole_of_part(structure, c));
      }
      for (const CellId face : structure.faces().of(c)) {
        pending.push_back(structure.values().of(face).cell);
      }
      for (const CellId part : cone_parts(structure, c)) {
        pending.push_back(part);
      }
    }
  }
  return cells;
}

/// The cells of the bodies; or, when there are none, the closure of the cells listed. By dimension, then by age.
Result<std::vector<CellId>> coned_cells(const std::optional<std::vector<BodyId>>& bodies, const ConeBase& over,
                                        const Structure& structure) {
  std::vector<CellId> coned;
  if (bodies) {
    for (const BodyId body : *bodies) {
      const std::vector<CellId> of_body = structure.lazy().cells_of(body);
      coned.insert(coned.end(), of_body.begin(), of_body.end());
    }
  } else {
    Result<std::vector<CellId>> listed = closure(std::get<std::vector<std::string>>(over), structure);
    if (!listed) {
      return listed;
    }
    coned = std::move(*listed);
  }
  sort_by_dimension_and_age(structure, coned);
  return with_parts(structure, coned);
}

// --------------------------------------------------------------------------------------------- cones that are written

/// Lays out the cells of a cone after those of the plan: the apex, then v*c for each coned cell, faces first.
class ConePlanner {
 public:
  ConePlanner(const std::string& apex, const Structure& structure, bool by_edges, Plan& plan)
      : structure_{structure}, by_edges_{by_edges}, plan_{plan}, apex_{next()} {
    const auto position = static_cast<std::uint32_t>(plan_.cells.size());
    plan_.names += apex;
    add_cell(structure_.types().vertex(), plan_.faces.size(), plan_);
    plan_.cones.push_back({position, position + 1, by_edges});
  }

  /// `name` is that of v*c, where c has its vertices in the order of its canonical name. Requires: the faces of c have
  /// been added.
  void add(CellId c, const std::string& name) {
    if (!is_simploid(structure_.cells().type(c).type)) {
      add_by_boundary(c, name);
      return;
    }
    std::vector<Incidence> faces;
    const TypeId type = structure_.cells().type_id(c);
    const int p = structure_.dimension(c);
    const auto arity = static_cast<std::uint32_t>(structure_.faces().of(c).size());
    const Value named = structure_.directory().named_value(c);
    for (std::uint32_t k = 0; k < arity; ++k) {
      faces.push_back(coned_value(structure_.values().face(named, k)));
    }
    if (p == 0) {
      faces.push_back({apex_});
    } else if (by_edges_) {  // the far end, squashed to the apex
      faces.push_back(degenerate({apex_, type, (Degeneracy{1} << p) - 1}));
    }
    faces.push_back({c, named.order});
    cone_of_.emplace(c, Value{next(), type, 0, structure_.maps().inverse(named.order)});
    const std::size_t first_face = plan_.faces.size();
    for (const Incidence& face : faces) {
      add_face(face, plan_);
    }
    plan_.names += name;
    add_cell(structure_.types().coned(type, by_edges_), first_face, plan_);
    plan_.cones.back().end = static_cast<std::uint32_t>(plan_.cells.size());
  }

 private:
  [[nodiscard]] CellId next() const { return plan_.first + plan_.cells.size(); }

  /// Of a cell that is no simploid, v*c is known by its boundary: the cones over the faces, and c.
  void add_by_boundary(CellId c, const std::string& name) {
    TypeTable& types = structure_.types();
    const int p = structure_.dimension(c);
    const auto arity = static_cast<std::uint32_t>(structure_.faces().of(c).size());
    const Value named = structure_.directory().named_value(c);
    std::vector<TypeTable::BoundaryFace> faces;
    const std::size_t first_face = plan_.faces.size();
    for (std::uint32_t k = 0; k < arity; ++k) {
      const Value face = structure_.values().face(named, k);
      if (face.is_degenerate()) {
        continue;  // as is the cone over it
      }
      const int sign = types.info(named.type).faces[k].sign;
      if (is_simploid(structure_.cells().type(face.cell).type)) {
        add_face(coned_value(face), plan_);
        faces.push_back({sign, types.coned(face.type, by_edges_)});
      } else {
        const auto& [node, type, collapsed, order] = cone_of_.at(face.cell);
        const int turned = structure_.maps().sign(face.order) * structure_.directory().sign_of_name(face.cell);
        add_face({node}, plan_);
        faces.push_back({sign * turned, type});
      }
    }
    add_face({c, named.order}, plan_);
    faces.push_back({p % 2 == 0 ? -1 : 1, named.type});
    const CellType& of = structure_.cells().type(c).type;
    const KnownBy known_by = is_by_boundary(of) ? KnownBy{of[0]} : KnownBy::listing;
    const TypeId type = types.by_boundary(p + 1, faces, known_by);
    cone_of_.emplace(c, Value{next(), type, 0, same_order});
    plan_.names += name;
    add_cell(type, first_face, plan_);
    plan_.cones.back().end = static_cast<std::uint32_t>(plan_.cells.size());
  }

  /// v*c for a value c: degenerate in the same directions; the new one comes last.
  Incidence coned_value(const Value& v) {
    const Value base = structure_.maps().compose(v, cone_of_.at(v.cell));
    const Value cone = structure_.maps().coned(base.cell, base, by_edges_);
    return v.is_degenerate() ? degenerate(cone) : Incidence{cone.cell, cone.order};
  }
  Incidence degenerate(const Value& v) {
    const auto [at, is_new] = degenerate_.emplace(v, structure_.cells().asked() + plan_.degenerate.size());
    if (is_new) {
      plan_.degenerate.emplace_back(static_cast<std::uint32_t>(plan_.cells.size()), v);
    }
    return {at->second};
  }

  const Structure& structure_;
  bool by_edges_;
  Plan& plan_;
  CellId apex_;
  std::unordered_map<CellId, Value> cone_of_;  // v*c, with the order in which what is coned has the vertices of c
  std::unordered_map<Value, CellId, ValueHash> degenerate_;
};

/// The type of the cone over a cell of a type.
CellType coned_type(CellType type, bool by_edges) {
  if (by_edges || type.empty()) {
    type.push_back(1);
  } else {
    ++type[0];
  }
  return type;
}

/// The names of the cones, apex by apex. Errors: bad_input when one is in use.
Result<std::vector<std::string>> names_of_cones(std::span<const std::string> apexes, const std::vector<CellId>& coned,
                                                const Structure& structure) {
  std::vector<std::string> names;
  names.reserve(apexes.size() * coned.size());
  for (const std::string& apex : apexes) {
    for (const CellId c : coned) {
      const std::string& name = names.emplace_back(fmt::format("{}*{}", apex, structure.name(c)));
      if (structure.is_name_taken(name)) {
        return Error{Errc::bad_input, fmt::format("the name \"{}\" is in use: choose another apex", name)};
      }
    }
  }
  return names;
}

/// The new cells belong to the body that they are built over, which several bodies become; to a new one over nothing.
void place_in_bodies(const std::string& name, const std::vector<CellId>& coned, const Structure& structure,
                     Plan& plan) {
  std::set<BodyId> bodies;
  for (const CellId c : coned) {
    bodies.insert(structure.body_of(c));
  }
  if (bodies.empty()) {
    plan.new_body = name;
  } else {
    join_bodies(bodies, plan);
  }
}

/// The cones over the same cells from each apex, one after the other.
Status plan_written_cones(std::span<const std::string> apexes, const std::vector<CellId>& coned,
                          const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_room(static_cast<std::int64_t>(apexes.size() * (coned.size() + 1)), structure, limits); !s) {
    return s;
  }
  const bool by_edges =
      std::any_of(coned.begin(), coned.end(), [&](CellId c) { return !is_simplex(structure.cells().type(c).type); });
  // All that may ask for nodes comes first, faces and names: the plan counts on ids.
  for (const CellId c : coned) {
    (void)structure.faces().of(c);
    if (!is_simploid(structure.cells().type(c).type)) {
      continue;
    }
    if (Status s = check_standard(coned_type(structure.cells().type(c).type, by_edges), structure, limits); !s) {
      return s;
    }
  }
  const Result<std::vector<std::string>> names = names_of_cones(apexes, coned, structure);
  if (!names) {
    return names.error();
  }
  plan.first = structure.cells().size();
  auto name = names->cbegin();
  for (const std::string& apex : apexes) {
    ConePlanner cone(apex, structure, by_edges, plan);
    for (const CellId c : coned) {
      cone.add(c, *name++);
    }
  }
  place_in_bodies(apexes.front(), coned, structure, plan);
  return Done{};
}

// ------------------------------------------------------------------------------------------------ cones that are lazy

Status plan_lazy_cone(const std::string& apex, const std::vector<BodyId>& bodies, const Structure& structure,
                      Plan& plan) {
  if (Status s = check_new_prefix(apex, structure); !s) {
    return s;
  }
  NewFamily cone{FamilyKind::cone, apex, bodies, false, {}, 0};
  std::uint64_t over_edges = 0;  // and larger cells: v*c has a type longer than one when it is a product with an edge
  for (const BodyId body : bodies) {
    const auto counts = structure.bodies().counts(body);
    cone.by_edges = cone.by_edges || !structure.bodies().has_only_simplices(body);
    cone.counts.resize(std::max(cone.counts.size(), counts.size() + 1), 0);
    for (std::size_t p = 0; p < counts.size(); ++p) {
      cone.counts[p] += counts[p];
      cone.counts[p + 1] += counts[p];
      over_edges += p > 0 ? counts[p] : 0;
    }
    cone.simploids += structure.bodies().simploids(body);
  }
  cone.simploids += cone.by_edges ? over_edges : 0;
  if (Status s = check_family(cone, structure); !s) {
    return s;
  }
  plan.first = structure.cells().size();
  plan.names = apex;
  add_cell(structure.types().vertex(), 0, plan);
  plan.family = std::move(cone);
  return Done{};
}

/// Lazy cones are made of simploids only.
bool has_others(const std::vector<BodyId>& bodies, const Structure& structure) {
  return std::ranges::any_of(bodies, [&](BodyId body) { return structure.bodies().kind(body).has_others; });
}

/// Before cells are listed: of a product there may be more than anybody can list.
Status check_written(const std::vector<BodyId>& bodies, std::string_view what, const Structure& structure,
                     const Limits& limits) {
  const std::uint64_t cells = cells_in(bodies, structure);
  return cells > static_cast<std::uint64_t>(limits.cells_per_step)
             ? Error{Errc::refused, fmt::format("{} is written out, and this one would be taken over {} cells; the "
                                                "limit is {} cells a step",
                                                what, cells, limits.cells_per_step)}
             : Status{Done{}};
}

Status check_apexes(const MakeSuspension& operation, const Structure& structure) {
  for (const std::string& apex : operation.apexes) {
    if (Status s = check_new_apex(apex, structure); !s) {
      return s;
    }
  }
  const auto& [one, other] = operation.apexes;
  if (one == other) {
    return Error{Errc::bad_input, fmt::format("both apexes are called {}: names are unique", sparse::quoted(one))};
  }
  if (extends_name(one, other) || extends_name(other, one)) {
    return Error{Errc::bad_input,
                 fmt::format("of the apexes \"{}\" and \"{}\" one goes on after the other with \"*\" or \".(\", so "
                             "that names of their cells could be mistaken for one another: choose others",
                             one, other)};
  }
  return Done{};
}

}  // namespace

Status plan_cone(const MakeCone& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_new_apex(operation.apex, structure); !s) {
    return s;
  }
  const auto bodies = coned_bodies(operation.over, structure);
  if (!bodies) {
    return bodies.error();
  }
  if (*bodies && !has_others(**bodies, structure) &&
      cells_in(**bodies, structure) > static_cast<std::uint64_t>(limits.cells_of_explicit_cone)) {
    return plan_lazy_cone(operation.apex, **bodies, structure, plan);
  }
  if (Status s = *bodies ? check_written(**bodies, "a cone over cells that are no simploids", structure, limits)
                         : Status{Done{}};
      !s) {
    return s;
  }
  const auto coned = coned_cells(*bodies, operation.over, structure);
  return coned ? plan_written_cones({&operation.apex, 1}, *coned, structure, limits, plan) : coned.error();
}

Status plan_suspension(const MakeSuspension& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_apexes(operation, structure); !s) {
    return s;
  }
  const auto bodies = coned_bodies(operation.over, structure);
  if (!bodies) {
    return bodies.error();
  }
  if (Status s = *bodies ? check_written(**bodies, "a suspension", structure, limits) : Status{Done{}}; !s) {
    return s;
  }
  const auto coned = coned_cells(*bodies, operation.over, structure);
  return coned ? plan_written_cones(operation.apexes, *coned, structure, limits, plan) : coned.error();
}

}  // namespace sesame::ops
