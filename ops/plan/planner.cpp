#include "ops/plan/planner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_set>

namespace sesame::ops {
namespace {

Error bad_input(std::string what) { return {Errc::bad_input, std::move(what)}; }

/// A name that may have any length, for a sentence: the beginning of a long one.
std::string shortened(std::string_view name) {
  constexpr std::size_t most = 200;
  std::size_t length = std::min(name.size(), most);
  while (length < name.size() && (static_cast<unsigned char>(name[length]) & 0xc0U) == 0x80U) {
    --length;  // not within a character
  }
  return length == name.size() ? std::string{name}
                               : fmt::format("{}... ({} bytes)", name.substr(0, length), name.size());
}

/// Ends the name begun at the end of plan.names and adds the cell that bears it.
void add_cell(Plan& plan, TypeId type, std::size_t first_face) {
  plan.cells.push_back({type, static_cast<std::uint32_t>(first_face), plan.names.size()});
}

void add_faces(Plan& plan, const std::vector<Incidence>& faces) {
  for (const auto& [node, order] : faces) {
    if (order != same_order) {
      plan.face_orders.emplace_back(static_cast<std::uint32_t>(plan.faces.size()), order);
    }
    plan.faces.push_back(node);
  }
}

/// The text form cannot say such a type, but a program can.
bool has_bad_entry(const CellType& type) {
  return std::any_of(type.begin(), type.end(), [](int a) { return a < 1; });
}

/// More cells than this are not counted; far below what 64 bits can say, so that sums of two are safe.
constexpr std::uint64_t largest_count = std::uint64_t{1} << 60;

/// Exact for n up to 62.
std::uint64_t binomial(std::size_t n, std::size_t k) {
  std::uint64_t result = 1;
  k = std::min(k, n - k);
  for (std::size_t j = 1; j <= k; ++j) {
    const std::uint64_t common = std::gcd(result, j);  // divided first: the product need not fit
    result = result / common * ((n - k + j) / (j / common));
  }
  return result;
}

/// Lays out the cells of a `complex` operation so that faces come before what they are faces of.
class ComplexPlanner {
 public:
  ComplexPlanner(const MakeComplex& operation, const Structure& structure, const Limits& limits, Plan& plan)
      : operation_{operation}, types_{structure.types()}, base_{structure.created()}, limits_{limits}, plan_{plan} {
    plan_.first = base_;
  }

  Status run() {
    for (std::uint32_t k = 0; k < operation_.cells.size(); ++k) {
      if (!is_name(operation_.cells[k].id)) {
        return bad_input(fmt::format("cell {} of complex \"{}\" needs an id without white space or control characters",
                                     k + 1, operation_.name));
      }
      if (!index_.emplace(operation_.cells[k].id, k).second) {
        return bad_input(fmt::format("complex \"{}\" lists cell \"{}\" twice: ids must differ", operation_.name,
                                     operation_.cells[k].id));
      }
    }
    placed_.assign(operation_.cells.size(), none);
    declared_.assign(operation_.cells.size(), none);
    for (std::uint32_t k = 0; k < operation_.cells.size(); ++k) {
      if (const Status s = place(k); !s) {
        return s;
      }
    }
    return Done{};
  }

 private:
  /// Places cell k after its faces. A face's type is checked before the face is placed: types lose a dimension with
  /// each face, so the recursion is never deeper than a dimension, and no cell can be met below itself.
  Status place(std::uint32_t k) {
    if (placed_[k] != none) {
      return Done{};
    }
    const MakeComplex::Cell& cell = operation_.cells[k];
    const Result<TypeId> type = type_of(k);
    if (!type) {
      return type.error();
    }
    std::vector<CellId> faces;
    faces.reserve(cell.faces.size());
    for (std::size_t f = 0; f < cell.faces.size(); ++f) {
      const auto at = index_.find(cell.faces[f]);
      if (at == index_.end()) {
        return Error{Errc::unknown_name,
                     fmt::format("cell \"{}\" of complex \"{}\" names a face \"{}\" that is not listed there", cell.id,
                                 operation_.name, cell.faces[f])};
      }
      if (const Status s = check_face_type(k, f, at->second); !s) {
        return s;
      }
      if (const Status s = place(at->second); !s) {
        return s;
      }
      faces.push_back(placed_[at->second]);
    }
    if (const Status s = check_laws(cell, *type, faces); !s) {
      return s;
    }
    placed_[k] = base_ + static_cast<CellId>(plan_.cells.size());
    plan_.names.append(operation_.name).append(1, '.').append(cell.id);
    add_cell(plan_, *type, plan_.faces.size());
    plan_.faces.insert(plan_.faces.end(), faces.begin(), faces.end());
    return Done{};
  }

  /// The type of cell k as listed. Errors: a number of faces that no such cell has; a type out of all proportion.
  Result<TypeId> type_of(std::uint32_t k) {
    if (declared_[k] != none) {
      return declared_[k];
    }
    const MakeComplex::Cell& cell = operation_.cells[k];
    CellType type;
    if (cell.type) {
      type = *cell.type;
    } else if (cell.faces.size() == 1) {
      return bad_input(fmt::format("cell \"{}\" of complex \"{}\" has 1 face: a vertex has none, an edge 2", cell.id,
                                   operation_.name));
    } else if (!cell.faces.empty()) {
      type = {static_cast<int>(cell.faces.size()) - 1};
    }
    if (has_bad_entry(type)) {
      return bad_input(fmt::format("cell \"{}\" of complex \"{}\" has the type [{}]: the entries of a type are >= 1",
                                   cell.id, operation_.name, fmt::join(type, ",")));
    }
    if (standard_cell_count(type) > limits_.cells_of_standard) {
      return Error{Errc::refused,
                   fmt::format("cell \"{}\" of complex \"{}\" is a {}: cells may have at most {} faces of "
                               "all dimensions",
                               cell.id, operation_.name, describe(type), limits_.cells_of_standard)};
    }
    declared_[k] = types_.intern(type);
    const std::size_t arity = types_.info(declared_[k]).faces.size();
    if (arity != cell.faces.size()) {
      return bad_input(fmt::format("cell \"{}\" of complex \"{}\" is a {} and needs {} faces, but {} are listed",
                                   cell.id, operation_.name, describe(type), arity, cell.faces.size()));
    }
    return declared_[k];
  }

  /// Face f of cell k is listed as cell `face`: are the types right?
  Status check_face_type(std::uint32_t k, std::size_t f, std::uint32_t face) {
    const Result<TypeId> type = type_of(face);
    if (!type) {
      return type.error();
    }
    const TypeId wanted = types_.info(declared_[k]).faces[f].type;
    if (*type != wanted) {
      return bad_input(fmt::format("face {} of cell \"{}\" of complex \"{}\" should be a {}, but \"{}\" is a {}", f,
                                   operation_.cells[k].id, operation_.name, describe(types_.info(wanted).type),
                                   operation_.cells[face].id, describe(types_.info(*type).type)));
    }
    return Done{};
  }

  [[nodiscard]] const Plan::NewCell& planned(CellId c) const { return plan_.cells[c - base_]; }
  [[nodiscard]] CellId planned_face(CellId c, std::uint32_t k) const { return plan_.faces[planned(c).first_face + k]; }
  [[nodiscard]] std::string_view planned_name(CellId c) const {
    const std::uint64_t begin = c == base_ ? 0 : planned(c - 1).name_end;
    return std::string_view{plan_.names}.substr(begin, planned(c).name_end - begin);
  }

  Status check_laws(const MakeComplex::Cell& cell, TypeId type, const std::vector<CellId>& faces) const {
    const TypeInfo& info = types_.info(type);
    for (const FaceLaw& law : info.laws) {
      const CellId one = planned_face(faces[law.first], law.second);
      const CellId other = planned_face(faces[law.other_first], law.other_second);
      if (one != other) {
        return bad_input(fmt::format(
            "cell \"{}\" of complex \"{}\" breaks a face law: face {} of its face {} is \"{}\", and face {} of its "
            "face {} is \"{}\", but they must be one cell",
            cell.id, operation_.name, law.second, law.first, planned_name(one), law.other_second, law.other_first,
            planned_name(other)));
      }
    }
    return Done{};
  }

  const MakeComplex& operation_;
  TypeTable& types_;
  CellId base_;
  const Limits& limits_;
  Plan& plan_;
  std::unordered_map<std::string_view, std::uint32_t> index_;
  std::vector<CellId> placed_;    // per listed cell: its id in the plan
  std::vector<TypeId> declared_;  // per listed cell: its type
};

}  // namespace

Result<Value> Planner::resolve(const std::string& name) const {
  NameReader reader(structure_, name);
  auto named = reader.read();
  if (!named) {
    return Error{Errc::unknown_name, why_unreadable(name, reader.failure())};
  }
  Lineage(structure_).advance_to_now(*named);
  if (structure_.is_consumed(named->cell)) {
    const LazyFamily& product = structure_.family(structure_.consumed_by(structure_.body_of(named->cell)));
    return Error{
        Errc::unknown_name,
        fmt::format("the cell \"{}\" went into the product \"{}\", whose cells have names such as \"{}.(a|b)\"", name,
                    product.name, product.name)};
  }
  return *named;
}

std::string Planner::why_unreadable(const std::string& name, NameReader::Failure failure) const {
  switch (failure) {
    case NameReader::Failure::nested:
      return fmt::format("the name \"{}\" has more than {} products and cones within one another, the limit",
                         shortened(name), NameReader::most_nested);
    case NameReader::Failure::ambiguous:
      return fmt::format(
          "the name \"{}\" can be taken apart in too many ways, since there are names with brackets that "
          "do not match or with bars outside of brackets",
          shortened(name));
    case NameReader::Failure::unknown:
      break;
  }
  return fmt::format("there is no cell \"{}\"{}", shortened(name),
                     structure_.lookup_body(name) ? ": this is the name of a body; name a cell of it" : "");
}

Status Planner::check_orders(BodyId body) const {
  if (!structure_.kind_of(body).keeps_orders) {
    return Error{Errc::refused,
                 fmt::format("cells of the body \"{}\" have their vertices in another order than their faces, which "
                             "comes of collapses and of gluing by vertex maps: a simplicial product goes by the order "
                             "of the vertices; a simploidal one takes all",
                             structure_.body_name(body))};
  }
  return Done{};
}

Result<BodyId> Planner::resolve_body(const std::string& name) const {
  const auto body = structure_.lookup_body(name);
  if (!body) {
    return Error{Errc::unknown_name,
                 fmt::format("there is no body \"{}\"{}", name,
                             structure_.lookup(name) ? ": this is a cell; name the body that it belongs to" : "")};
  }
  if (const FamilyId family = structure_.consumed_by(*body); family != none) {
    return Error{Errc::unknown_name, fmt::format("the body \"{}\" went into the product \"{}\": it can be used no more",
                                                 name, structure_.family(family).name)};
  }
  return *body;
}

Status Planner::check_new_name(const std::string& name) const {
  if (!is_name(name)) {
    return bad_input(fmt::format(
        "\"{}\" is not a name: a name is UTF-8, not empty, and has no white space or control characters", name));
  }
  if (structure_.is_name_taken(name)) {
    return bad_input(fmt::format("the name \"{}\" is in use: names are unique, choose another", name));
  }
  return Done{};
}

Status Planner::check_new_apex(const std::string& name) const {
  if (Status s = check_new_name(name); !s) {
    return s;
  }
  if (structure_.is_ambiguous_prefix(name)) {
    return bad_input(fmt::format(
        "the name \"{}\", or that of an apex or a product, goes on after the other with \"*\" or \".(\", so that names "
        "of their cells could be mistaken for one another: choose another",
        name));
  }
  return Done{};
}

Status Planner::check_new_prefix(const std::string& name) const {
  if (Status s = check_new_apex(name); !s) {
    return s;
  }
  if (structure_.is_prefix_taken(name)) {
    return bad_input(fmt::format(
        "names that begin with \"{0}*\" or \"{0}.(\", as those of the new cells would, can be those of other cells: "
        "choose another",
        name));
  }
  return Done{};
}

Status Planner::check_room(std::int64_t new_cells) const {
  if (new_cells > limits_.cells_per_step) {
    return Error{Errc::refused, fmt::format("this step would make {} cells; the limit for one step is {}", new_cells,
                                            limits_.cells_per_step)};
  }
  if (new_cells + structure_.created() > limits_.cells) {
    return Error{Errc::refused, fmt::format("this step would bring the workspace to {} cells; the limit is {}",
                                            new_cells + structure_.created(), limits_.cells)};
  }
  return Done{};
}

Status Planner::check_size(const CellType& type) const {
  if (has_bad_entry(type)) {
    return bad_input(
        fmt::format("there is no simploid of type [{}]: dimensions are >= 0, and the entries of a type >= 1",
                    fmt::join(type, ",")));
  }
  const std::int64_t cells = standard_cell_count(type);
  if (cells > limits_.cells_of_standard) {
    return Error{Errc::refused,
                 fmt::format("a {} has {} cells; the limit is {}", describe(type), cells, limits_.cells_of_standard)};
  }
  return Done{};
}

Status Planner::check_standard(const CellType& type) const {
  const Status s = check_size(type);
  return s ? check_room(standard_cell_count(type)) : s;
}

Status Planner::plan(const MakeSimplex& operation, Plan& plan) {
  plan.clear();
  const CellType type = operation.dimension == 0 ? CellType{} : CellType{operation.dimension};
  if (const Status s = check_standard(type); !s) {
    return s;
  }
  const std::string alias = operation.name + ".0";  // of the one vertex, when the simplex is that
  if (operation.dimension == 0) {
    if (Status s = check_new_name(operation.name); !s) {
      return s;
    }
    if (Status s = check_new_name(alias); !s) {
      return s;
    }
  }
  Status s = plan_standard(operation.name, structure_.types().intern(type), plan);
  if (s && operation.dimension == 0) {
    plan.aliases.emplace_back(alias, plan.first);
  }
  return s;
}

Status Planner::plan(const MakeSimploid& operation, Plan& plan) {
  plan.clear();
  if (const Status s = check_standard(operation.type); !s) {
    return s;
  }
  return plan_standard(operation.name, structure_.types().intern(operation.type), plan);
}

Status Planner::plan_standard(const std::string& name, TypeId type, Plan& plan) {
  if (const Status s = check_new_name(name); !s) {
    return s;
  }
  const StandardCell& standard = structure_.types().standard(type);
  for (std::size_t k = 0; k + 1 < standard.cells.size(); ++k) {
    const std::string full = name + "." + standard.cells[k].suffix;
    if (structure_.is_name_taken(full)) {
      return bad_input(fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new {}: choose another", full,
                                   name, describe(structure_.types().info(type).type)));
    }
  }
  const CellId base = plan.first = structure_.created();  // after the last look at a name, which may make lazy cells
  for (std::size_t k = 0; k < standard.cells.size(); ++k) {
    const StandardFace& cell = standard.cells[k];
    plan.names.append(name);
    if (k + 1 < standard.cells.size()) {
      plan.names.append(1, '.').append(cell.suffix);
    }
    const std::size_t first_face = plan.faces.size();
    for (const std::uint32_t face : cell.faces) {
      plan.faces.push_back(base + face);
    }
    add_cell(plan, cell.type, first_face);
  }
  plan.new_body = name;
  return Done{};
}

Status Planner::plan(const MakeComplex& operation, Plan& plan) {
  plan.clear();
  if (const Status s = check_new_name(operation.name); !s) {
    return s;
  }
  if (const Status s = check_room(static_cast<std::int64_t>(operation.cells.size())); !s) {
    return s;
  }
  for (const MakeComplex::Cell& cell : operation.cells) {
    if (const std::string full = operation.name + "." + cell.id; structure_.is_name_taken(full)) {
      return bad_input(fmt::format("the name \"{}\" is in use: choose another name for the complex or the cell", full));
    }
  }
  if (const Status s = ComplexPlanner(operation, structure_, limits_, plan).run(); !s) {
    return s;
  }
  plan.new_body = operation.name;
  return Done{};
}

// -------------------------------------------------------------------------------------------------------------- cones

Result<std::optional<std::vector<BodyId>>> Planner::coned_bodies(const ConeBase& over) const {
  std::optional<std::vector<BodyId>> bodies;
  if (const auto* name = std::get_if<std::string>(&over)) {
    const auto body = resolve_body(*name);
    if (!body) {
      return structure_.lookup(*name) && !structure_.lookup_body(*name)
                 ? Error{Errc::unknown_name,
                         fmt::format("there is no body \"{0}\": this is a cell; to cone over it give a list, [\"{0}\"]",
                                     *name)}
                 : body.error();
    }
    bodies = std::vector<BodyId>{*body};
  } else if (std::holds_alternative<std::monostate>(over)) {
    bodies = structure_.current_bodies();
  }
  return bodies;
}

std::uint64_t Planner::cells_in(const std::vector<BodyId>& bodies) const {
  std::uint64_t cells = 0;
  for (const BodyId body : bodies) {
    const auto counts = structure_.counts_of(body);
    cells = std::accumulate(counts.begin(), counts.end(), cells);
  }
  return cells;
}

Result<std::vector<CellId>> Planner::coned_cells(const std::optional<std::vector<BodyId>>& bodies,
                                                 const ConeBase& over) const {
  if (!bodies) {
    return closure(std::get<std::vector<std::string>>(over));
  }
  std::vector<CellId> coned;
  for (const BodyId body : *bodies) {
    const std::vector<CellId> of_body = structure_.cells_of(body);
    coned.insert(coned.end(), of_body.begin(), of_body.end());
  }
  return coned;
}

Result<std::vector<CellId>> Planner::closure(const std::vector<std::string>& names) const {
  std::vector<CellId> cells;
  std::unordered_set<CellId> seen;
  std::vector<CellId> pending;
  for (const std::string& name : names) {
    const Result<Value> named = resolve(name);
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
      for (const CellId face : structure_.faces(c)) {
        pending.push_back(structure_.value(face).cell);
      }
    }
  }
  return cells;
}

Status Planner::plan(const MakeCone& operation, Plan& plan) {
  plan.clear();
  if (Status s = check_new_apex(operation.apex); !s) {
    return s;
  }
  const auto bodies = coned_bodies(operation.over);
  if (!bodies) {
    return bodies.error();
  }
  if (*bodies && cells_in(**bodies) > static_cast<std::uint64_t>(limits_.cells_of_explicit_cone)) {
    return plan_lazy_cone(operation, **bodies, plan);
  }
  auto coned = coned_cells(*bodies, operation.over);
  return coned ? plan_explicit_cones({&operation.apex, 1}, std::move(*coned), plan) : coned.error();
}

Status Planner::plan(const MakeSuspension& operation, Plan& plan) {
  plan.clear();
  for (const std::string& apex : operation.apexes) {
    if (Status s = check_new_apex(apex); !s) {
      return s;
    }
  }
  const auto& [one, other] = operation.apexes;
  if (one == other) {
    return bad_input(fmt::format("both apexes are called \"{}\": names are unique", one));
  }
  if (extends_name(one, other) || extends_name(other, one)) {
    return bad_input(
        fmt::format("of the apexes \"{}\" and \"{}\" one goes on after the other with \"*\" or \".(\", so "
                    "that names of their cells could be mistaken for one another: choose others",
                    one, other));
  }
  const auto bodies = coned_bodies(operation.over);
  if (!bodies) {
    return bodies.error();
  }
  // Before cells are listed: of a product there may be more than anybody can list.
  if (*bodies && cells_in(**bodies) > static_cast<std::uint64_t>(limits_.cells_per_step)) {
    return Error{Errc::refused, fmt::format("a suspension is written out, and this one would be taken over {} cells; "
                                            "the limit is {} cells a step",
                                            cells_in(**bodies), limits_.cells_per_step)};
  }
  auto coned = coned_cells(*bodies, operation.over);
  return coned ? plan_explicit_cones(operation.apexes, std::move(*coned), plan) : coned.error();
}

namespace {

/// Lays out the cells of a cone after those of the plan: the apex, then v*c for each coned cell, faces first.
class ConePlanner {
 public:
  ConePlanner(const std::string& apex, const Structure& structure, bool by_edges, Plan& plan)
      : structure_{structure}, by_edges_{by_edges}, plan_{plan}, apex_{next()} {
    const auto position = static_cast<std::uint32_t>(plan_.cells.size());
    plan_.names += apex;
    add_cell(plan_, structure_.types().vertex(), plan_.faces.size());
    plan_.cones.push_back({position, position + 1, by_edges});
  }

  /// `name` is that of v*c, where c has its vertices in the order of its canonical name. Requires: the faces of c have
  /// been added.
  void add(CellId c, const std::string& name) {
    std::vector<Incidence> faces;
    const TypeId type = structure_.type_id(c);
    const int p = structure_.dimension(c);
    const auto arity = static_cast<std::uint32_t>(structure_.faces(c).size());
    const Value named = structure_.named_value(c);
    for (std::uint32_t k = 0; k < arity; ++k) {
      faces.push_back(coned_value(structure_.face(named, k)));
    }
    if (p == 0) {
      faces.push_back({apex_});
    } else if (by_edges_) {  // the far end, squashed to the apex
      faces.push_back(degenerate({apex_, type, (Degeneracy{1} << p) - 1}));
    }
    faces.push_back({c, named.order});
    cone_of_.emplace(c, Value{next(), type, 0, structure_.maps().inverse(named.order)});
    const std::size_t first_face = plan_.faces.size();
    add_faces(plan_, faces);
    plan_.names += name;
    add_cell(plan_, structure_.types().coned(type, by_edges_), first_face);
    plan_.cones.back().end = static_cast<std::uint32_t>(plan_.cells.size());
  }

 private:
  [[nodiscard]] CellId next() const { return plan_.first + static_cast<CellId>(plan_.cells.size()); }
  /// v*c for a value c: degenerate in the same directions; the new one comes last.
  Incidence coned_value(const Value& v) {
    const Value base = structure_.maps().compose(v, cone_of_.at(v.cell));
    const Value cone = structure_.maps().coned(base.cell, base, by_edges_);
    return v.is_degenerate() ? degenerate(cone) : Incidence{cone.cell, cone.order};
  }
  Incidence degenerate(const Value& v) {
    const auto [at, is_new] = degenerate_.emplace(v, next());
    if (is_new) {
      plan_.degenerate.emplace_back(static_cast<std::uint32_t>(plan_.cells.size()), v);
      add_cell(plan_, v.type, plan_.faces.size());
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

}  // namespace

Status Planner::plan_explicit_cones(std::span<const std::string> apexes, std::vector<CellId> coned, Plan& plan) {
  std::sort(coned.begin(), coned.end(), [this](CellId a, CellId b) {
    const int p = structure_.dimension(a);
    const int q = structure_.dimension(b);
    return p != q ? p < q : structure_.is_older(structure_.oldest(a), structure_.oldest(b));
  });
  if (Status s = check_room(static_cast<std::int64_t>(apexes.size() * (coned.size() + 1))); !s) {
    return s;
  }
  const bool by_edges =
      std::any_of(coned.begin(), coned.end(), [this](CellId c) { return !is_simplex(structure_.type(c).type); });
  // All that may make lazy cells comes first: the plan counts on ids.
  for (const CellId c : coned) {
    (void)structure_.faces(c);
    CellType type = structure_.type(c).type;
    if (by_edges || type.empty()) {
      type.push_back(1);
    } else {
      ++type[0];
    }
    if (Status s = check_standard(type); !s) {
      return s;
    }
  }
  std::vector<std::string> names;  // of the cones, apex by apex
  names.reserve(apexes.size() * coned.size());
  for (const std::string& apex : apexes) {
    for (const CellId c : coned) {
      const std::string& name = names.emplace_back(fmt::format("{}*{}", apex, structure_.name(c)));
      if (structure_.is_name_taken(name)) {
        return bad_input(fmt::format("the name \"{}\" is in use: choose another apex", name));
      }
    }
  }
  plan.first = structure_.created();
  auto name = names.cbegin();
  for (const std::string& apex : apexes) {
    ConePlanner cone(apex, structure_, by_edges, plan);
    for (const CellId c : coned) {
      cone.add(c, *name++);
    }
  }
  place_in_bodies(apexes.front(), coned, plan);
  return Done{};
}

void Planner::place_in_bodies(const std::string& name, const std::vector<CellId>& coned, Plan& plan) const {
  std::set<BodyId> bodies;
  for (const CellId a : coned) {
    bodies.insert(structure_.body_of(a));
  }
  if (bodies.empty()) {
    plan.new_body = name;
    return;
  }
  plan.into_body = *bodies.begin();
  plan.joined_bodies.assign(std::next(bodies.begin()), bodies.end());
}

Status Planner::plan_lazy_cone(const MakeCone& operation, const std::vector<BodyId>& bodies, Plan& plan) {
  if (Status s = check_new_prefix(operation.apex); !s) {
    return s;
  }
  NewFamily cone{FamilyKind::cone, operation.apex, bodies, false, {}, 0};
  std::uint64_t over_edges = 0;  // and larger cells: v*c has a type longer than one when it is a product with an edge
  for (const BodyId body : bodies) {
    const auto counts = structure_.counts_of(body);
    cone.by_edges = cone.by_edges || !structure_.has_only_simplices(body);
    cone.counts.resize(std::max(cone.counts.size(), counts.size() + 1), 0);
    for (std::size_t p = 0; p < counts.size(); ++p) {
      cone.counts[p] += counts[p];
      cone.counts[p + 1] += counts[p];
      over_edges += p > 0 ? counts[p] : 0;
    }
    cone.simploids += structure_.simploids_of(body);
  }
  cone.simploids += cone.by_edges ? over_edges : 0;
  if (Status s = check_family(cone); !s) {
    return s;
  }
  plan.first = structure_.created();
  plan.names = operation.apex;
  add_cell(plan, structure_.types().vertex(), 0);
  plan.family = std::move(cone);
  return Done{};
}

// ----------------------------------------------------------------------------------------------------------- products

Status Planner::check_family(const NewFamily& family) const {
  if (static_cast<int>(family.counts.size()) - 1 > largest_dimension) {
    return Error{Errc::refused, fmt::format("\"{}\" would have cells of dimension {}; the limit is {}", family.name,
                                            family.counts.size() - 1, largest_dimension)};
  }
  constexpr int most_nested = NameReader::most_nested - largest_dimension;  // cones that are written out come to that
  for (const BodyId body : family.bodies) {
    if (structure_.nesting_of(body) >= most_nested) {
      return Error{Errc::refused, fmt::format("\"{}\" would be made of {} products and cones that are made of one "
                                              "another, the limit",
                                              family.name, most_nested)};
    }
  }
  const auto others = structure_.counts();
  std::uint64_t sum = std::accumulate(others.begin(), others.end(), std::uint64_t{0});
  for (const std::uint64_t count : family.counts) {
    if (count > largest_count || (sum += count) > largest_count) {
      return Error{Errc::refused,
                   fmt::format("with \"{}\" there would be more than {} cells, the limit", family.name, largest_count)};
    }
  }
  return Done{};
}

Status Planner::plan(const MakeProduct& operation, Plan& plan) {
  plan.clear();
  if (Status s = check_new_prefix(operation.name); !s) {
    return s;
  }
  const auto left = resolve_body(operation.left);
  const auto right = resolve_body(operation.right);
  if (!left || !right) {
    return left ? right.error() : left.error();
  }
  for (const auto& [body, name] : {std::pair{*left, operation.left}, std::pair{*right, operation.right}}) {
    if (operation.simplicial && !structure_.has_only_simplices(body)) {
      return Error{Errc::refused, fmt::format("the body \"{}\" has cells that are no simplices: a simplicial product "
                                              "needs simplices, a simploidal one takes all",
                                              name)};
    }
    if (Status s = operation.simplicial ? check_orders(body) : Done{}; !s) {
      return s;
    }
  }
  NewFamily product{operation.simplicial ? FamilyKind::simplicial_product : FamilyKind::product,
                    operation.name,
                    {*left, *right},
                    false,
                    {},
                    0};
  const auto lefts = structure_.counts_of(*left);
  const auto rights = structure_.counts_of(*right);
  product.counts.assign(std::max<std::size_t>(lefts.size() + rights.size(), 1) - 1, 0);
  if (Status s = check_family(product); !s) {  // the dimension, before anything is multiplied
    return s;
  }
  for (std::size_t p = 0; p < lefts.size(); ++p) {
    for (std::size_t q = 0; q < rights.size(); ++q) {
      const auto add = [&](std::size_t n, std::uint64_t places, std::uint64_t choices) {
        std::uint64_t cells = 0;
        if (__builtin_mul_overflow(lefts[p], rights[q], &cells) || __builtin_mul_overflow(cells, places, &cells) ||
            __builtin_mul_overflow(cells, choices, &cells) ||
            __builtin_add_overflow(product.counts[n], cells, &product.counts[n])) {
          product.counts[n] = largest_count + 1;
        }
      };
      if (!operation.simplicial) {
        add(p + q, 1, 1);
        continue;
      }
      for (std::size_t n = std::max(p, q); n <= p + q; ++n) {  // n! / ((n - p)! (n - q)! (p + q - n)!) pairs
        add(n, binomial(n, p), binomial(p, p + q - n));
      }
    }
  }
  while (!product.counts.empty() && product.counts.back() == 0) {
    product.counts.pop_back();
  }
  if (Status s = check_family(product); !s) {
    return s;
  }
  if (!operation.simplicial) {  // a simplex is a pair of a simplex and a vertex
    const auto total = [](std::span<const std::uint64_t> counts) {
      return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    };
    const auto vertices = [](std::span<const std::uint64_t> counts) { return counts.empty() ? 0 : counts[0]; };
    const std::uint64_t left_simplices = total(lefts) - structure_.simploids_of(*left);
    const std::uint64_t right_simplices = total(rights) - structure_.simploids_of(*right);
    const std::uint64_t simplices =
        left_simplices * vertices(rights) + vertices(lefts) * right_simplices - vertices(lefts) * vertices(rights);
    product.simploids = total(product.counts) - simplices;
  }
  plan.new_body = operation.name;
  plan.family = std::move(product);
  return Done{};
}

// -------------------------------------------------------------------------------------- identification and degeneracy

void Planner::touch(CellId c) {
  if (overlay_.emplace(c, Overlay{c, {}}).second) {
    touched_.push_back(c);
  }
}

Value Planner::overlay_root(CellId c) {
  const auto above = [this](CellId cell) {
    const auto at = overlay_.find(cell);
    return at == overlay_.end() || at->second.parent == cell || at->second.parent == none ? nullptr : &at->second;
  };
  Value root{c, structure_.type_id(c), 0};
  while (Overlay* at = above(root.cell)) {
    if (const Overlay* next = above(at->parent)) {  // paths are halved as they are gone
      *at = {next->parent, structure_.maps().compose(at->becomes, next->becomes)};
    }
    root = structure_.maps().compose(root, at->becomes);
  }
  return root;
}

Value Planner::overlay_value(Value v) {
  v = structure_.normal_form(v);
  while (true) {
    v = structure_.maps().compose(v, overlay_root(v.cell));
    const auto at = overlay_.find(v.cell);
    if (at == overlay_.end() || at->second.parent != none) {
      return v;
    }
    v = structure_.maps().compose(v, at->second.becomes);
  }
}

/// Sections: choices of a vertex for each vertex of the cell underneath. Number r takes the r-th of those that go to
/// it, or the last; so between them they take every vertex.
void Planner::add_restrictions(const Value& one, const Value& other, std::vector<std::pair<Value, Value>>& out) const {
  const CellType type = structure_.types().info(one.type).type;
  const VertexMap map = structure_.maps().map_of(one);
  std::vector<std::size_t> rank(map.size());  // among those that go to the same vertex; then from the last one
  std::vector<std::size_t> left(map.size());
  std::size_t most = 0;
  std::size_t begin = 0;
  for (const int a : type) {
    const std::size_t end = begin + static_cast<std::size_t>(a) + 1;
    for (std::size_t k = begin; k < end; ++k) {
      const auto of_k = [&](std::size_t from, std::size_t to) {
        return static_cast<std::size_t>(std::count(map.begin() + static_cast<std::ptrdiff_t>(from),
                                                   map.begin() + static_cast<std::ptrdiff_t>(to), map[k]));
      };
      rank[k] = of_k(begin, k);
      left[k] = of_k(k + 1, end);
      most = std::max(most, rank[k]);
    }
    begin = end;
  }
  for (std::size_t r = 0; r <= most; ++r) {
    Value a = one;
    Value b = other;
    for (std::size_t k = map.size(); k-- > 0;) {  // the numbers of those before are not changed
      if (rank[k] != r && (rank[k] > r || left[k] > 0)) {
        a = structure_.face(a, static_cast<std::uint32_t>(k));
        b = structure_.face(b, static_cast<std::uint32_t>(k));
      }
    }
    out.emplace_back(a, b);
  }
}

void Planner::equate(const Value& cell, const Value& becomes) {
  touch(cell.cell);
  if (!becomes.is_degenerate()) {
    touch(becomes.cell);
  }
  overlay_[cell.cell] = {becomes.is_degenerate() ? none : becomes.cell, becomes};
}

/// Congruence closure, of values as symmetric simplicial sets have them: under faces and under orders of vertices.
/// Closing under faces needs no look at cofaces, so its cost does not depend on the object. Cells of one type have
/// faces of the same types in the same order, so the only thing that can be refused is a cell that is itself in another
/// order. That two degenerate values are equal says, by the Eilenberg-Zilber lemma, no more and no less than what it
/// says along sections of each that take every vertex between them.
Status Planner::plan_equation(std::vector<std::pair<Value, Value>> pending, Plan& plan) {
  overlay_.clear();
  touched_.clear();
  foldings_.clear();
  VertexMaps& maps = structure_.maps();
  while (!pending.empty()) {
    Value a = overlay_value(pending.back().first);
    Value b = overlay_value(pending.back().second);
    pending.pop_back();
    if (!(a == b) && a.is_degenerate() && b.is_degenerate()) {
      add_restrictions(a, b, pending);
      add_restrictions(b, a, pending);
    } else if (!(a == b)) {
      if (a.is_degenerate() || (!b.is_degenerate() && a.cell != b.cell && structure_.is_older(a.cell, b.cell))) {
        std::swap(a, b);
      }
      if (a.order != same_order) {  // written in the order of the cell
        b = maps.reordered(maps.inverse(a.order), b);
        a.order = same_order;
      }
      bool is_new = true;
      if (a.cell == b.cell && !b.is_degenerate()) {
        is_new = foldings_.emplace(a.cell, b.order).second;
      } else {
        equate(a, b);
      }
      const auto arity = is_new ? static_cast<std::uint32_t>(structure_.type(a.cell).faces.size()) : 0;
      for (std::uint32_t k = 0; k < arity; ++k) {
        pending.emplace_back(structure_.face(a, k), structure_.face(b, k));
      }
    }
    if (pending.empty()) {
      if (Status s = settle_foldings(pending); !s) {
        return s;
      }
    }
  }
  plan.merges = merges_of_overlay();
  return Done{};
}

Status Planner::settle_foldings(std::vector<std::pair<Value, Value>>& pending) {
  const std::pair<CellId, OrderId>* folded = nullptr;
  for (auto at = foldings_.begin(); at != foldings_.end();) {
    const Value cell{at->first, structure_.type_id(at->first), 0};
    const Value one = overlay_value(cell);
    const Value other = overlay_value(structure_.maps().reordered(at->second, cell));
    if (one.is_degenerate() && !(one == other)) {
      pending.emplace_back(one, other);
    }
    folded = one.is_degenerate() ? folded : &*at;
    at = one.is_degenerate() ? foldings_.erase(at) : std::next(at);
  }
  if (!pending.empty() || folded == nullptr) {
    return Done{};
  }
  return Error{
      Errc::refused,
      fmt::format("this would glue \"{}\" to itself with its vertices in the order {}, and so fold it: "
                  "subdivide the cells that are to be glued first, so that no cell meets itself",
                  structure_.name(folded->first), fmt::join(structure_.maps().permutation(folded->second), "-"))};
}

std::vector<Merge> Planner::merges_of_overlay() {
  // The survivor of a class is the cell that stands for the most cells (the oldest of those): with it every path of the
  // union-find forest stays logarithmic without compression, which undo could not take back.
  std::unordered_map<CellId, std::vector<CellId>> classes;
  for (const CellId c : touched_) {
    classes[overlay_root(c).cell].push_back(c);
  }
  std::vector<Merge> merges;
  VertexMaps& maps = structure_.maps();
  for (const CellId root : touched_) {
    if (overlay_root(root).cell != root) {
      continue;
    }
    std::vector<CellId>& cells = classes[root];
    const auto before = [this](CellId a, CellId b) {
      const std::uint32_t m = structure_.members(a);
      const std::uint32_t n = structure_.members(b);
      return m != n ? m > n : structure_.is_older(structure_.oldest(a), structure_.oldest(b));
    };
    std::sort(cells.begin(), cells.end(), before);
    const Value survivor = overlay_root(cells[0]);
    const OrderId back = maps.inverse(survivor.order);
    for (std::size_t k = 1; k < cells.size(); ++k) {
      merges.push_back({cells[k], cells[0], {}, maps.compose(overlay_root(cells[k]).order, back)});
    }
    if (const Overlay& entry = overlay_.at(root); entry.parent == none) {
      merges.push_back({cells[0], none, maps.compose(survivor, entry.becomes)});
    }
  }
  std::stable_sort(merges.begin(), merges.end(), [this](const Merge& x, const Merge& y) {
    return structure_.dimension(x.removed) < structure_.dimension(y.removed);
  });
  return merges;
}

Result<OrderId> Planner::order_of(const Identify::Map& map, TypeId type) const {
  const CellType& components = structure_.types().info(type).type;
  const bool is_vertex = components.empty() && map == Identify::Map{{0}};
  bool is_map = is_vertex || map.size() == components.size();
  std::vector<std::uint8_t> permutation;
  for (std::size_t i = 0; i < map.size() && is_map && !is_vertex; ++i) {
    std::vector<int> sorted = map[i];
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> vertices(static_cast<std::size_t>(components[i]) + 1);
    std::iota(vertices.begin(), vertices.end(), 0);
    is_map = sorted == vertices;
    const std::size_t before = permutation.size();
    for (const int k : map[i]) {
      permutation.push_back(static_cast<std::uint8_t>(before + static_cast<std::size_t>(k)));
    }
  }
  if (!is_map) {
    return bad_input(fmt::format("a vertex map of a {} {}", describe(components),
                                 components.size() > 1 ? "has a list for each component, each a permutation of its "
                                                         "vertices, which are counted from 0"
                                                       : "is a permutation of its vertices, which are counted from 0"));
  }
  return structure_.maps().order(permutation);
}

Status Planner::plan(const Identify& operation, Plan& plan) {
  plan.clear();
  std::vector<std::pair<Value, Value>> equations;
  for (std::size_t k = 0; k < operation.pairs.size(); ++k) {
    const auto& [one, other] = operation.pairs[k];
    const Result<Value> a = resolve(one);
    Result<Value> b = resolve(other);
    if (!a || !b) {
      return a ? b.error() : a.error();
    }
    if (a->type != b->type) {
      const TypeTable& types = structure_.types();
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a {} and \"{}\" a {}: only cells of the same type can be identified", one,
                               describe(types.info(a->type).type), other, describe(types.info(b->type).type))};
    }
    if (const auto map = operation.maps.find(k); map != operation.maps.end()) {
      const Result<OrderId> order = order_of(map->second, a->type);
      if (!order) {
        return order.error();
      }
      b = structure_.maps().reordered(*order, *b);
    }
    equations.emplace_back(*a, *b);
  }
  return plan_equation(std::move(equations), plan);
}

Status Planner::plan(const Degenerate& operation, Plan& plan) {
  plan.clear();
  const Result<Value> cell = resolve(operation.cell);
  if (!cell) {
    return cell.error();
  }
  const CellType& type = structure_.types().info(cell->type).type;
  if (type.empty()) {
    return bad_input(fmt::format("\"{}\" is a vertex, which has no face to be squashed onto", operation.cell));
  }
  if (!operation.component && type.size() > 1) {
    return bad_input(fmt::format("\"{}\" is a {}: \"along\" should be [i,j], the component i counted from 1",
                                 operation.cell, describe(type)));
  }
  const int component = operation.component.value_or(1) - 1;
  if (component < 0 || component >= static_cast<int>(type.size())) {
    return bad_input(
        fmt::format("\"{}\" is a {}: its components are 1 to {}", operation.cell, describe(type), type.size()));
  }
  const int size = type[static_cast<std::size_t>(component)];
  if (operation.index < 0 || operation.index >= size) {
    return bad_input(fmt::format("\"{}\" is a {}: the index \"along\" which it is squashed should be from 0 to {}",
                                 operation.cell, describe(type), size - 1));
  }
  const Value face = structure_.face(*cell, face_number(type, component, operation.index));
  const Value squashed{none, cell->type, Degeneracy{1} << direction_number(type, component, operation.index)};
  return plan_equation({{*cell, structure_.maps().compose(squashed, face)}}, plan);
}

// -------------------------------------------------------------------------------------------------- de-identification

namespace {

/// Works out a de-identification: copies under ids of their own, faces as they would be, and the laws between them.
class SplitPlanner {
 public:
  SplitPlanner(const Deidentify& operation, const Planner& planner, const Structure& structure)
      : operation_{operation}, planner_{planner}, structure_{structure} {}

  Status run(Plan& plan) {
    for (const Deidentify::Split& split : operation_.splits) {
      if (Status s = add_copy(split); !s) {
        return s;
      }
    }
    for (std::size_t k = 0; k < operation_.splits.size(); ++k) {
      for (const auto& [cell, face] : operation_.splits[k].moves) {
        if (Status s = add_move(k, cell, face); !s) {
          return s;
        }
      }
    }
    if (Status s = check_laws(); !s) {
      return s;
    }
    write(plan);
    return Done{};
  }

 private:
  /// Ids of copies until the plan is written: laws are checked, which may make lazy cells, before ids are known.
  static constexpr CellId first_copy = 0x8000'0000U;
  struct NewCopy {
    CellId source;
    const std::string& name;
    OrderId order;  // in which the name of the cell that is split has its vertices; that of the copy has them so too
  };

  [[nodiscard]] static bool is_copy(CellId c) { return c >= first_copy; }
  [[nodiscard]] CellId source_of(CellId c) const { return is_copy(c) ? copies_[c - first_copy].source : c; }
  [[nodiscard]] std::string_view name_of(CellId c) const {
    return is_copy(c) ? std::string_view{copies_[c - first_copy].name} : structure_.name(c);
  }

  Status add_copy(const Deidentify::Split& split) {
    const Result<Value> named = planner_.resolve(split.cell);
    if (!named) {
      return named.error();
    }
    if (named->is_degenerate()) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is degenerate: only a cell that is not can be split", split.cell)};
    }
    const auto id = first_copy + static_cast<CellId>(copies_.size());
    if (!copy_names_.emplace(split.copy, id).second) {
      return bad_input(fmt::format("the name \"{}\" is given to two copies: names are unique", split.copy));
    }
    copies_.push_back({named->cell, split.copy, named->order});
    faces_of(id);
    return Done{};
  }

  Status add_move(std::size_t split, const std::string& name, std::int64_t face) {
    Value named;  // its faces are counted in the order in which the name stands for its vertices
    if (const auto copy = copy_names_.find(name); copy != copy_names_.end()) {
      named.cell = copy->second;
      named.order = copies_[copy->second - first_copy].order;
    } else {
      const Result<Value> found = planner_.resolve(name);
      if (!found) {
        return found.error();
      }
      named = *found;
      if (named.is_degenerate()) {
        return Error{Errc::refused, fmt::format("\"{}\" is degenerate: its faces cannot move", name)};
      }
    }
    const CellId cell = named.cell;
    const CellId source = copies_[split].source;
    std::vector<Value>& faces = faces_of(cell);
    if (face < 0 || face >= static_cast<std::int64_t>(faces.size())) {
      return bad_input(
          fmt::format("\"{}\" has {} faces, counted from 0: there is no face {}", name, faces.size(), face));
    }
    const auto slot = named.order == same_order
                          ? static_cast<std::size_t>(face)
                          : structure_.maps().permutation(named.order)[static_cast<std::size_t>(face)];
    Value& value = faces[slot];
    if (is_copy(value.cell)) {
      return bad_input(fmt::format("face {} of \"{}\" is moved twice in this step: it can go to one copy", face, name));
    }
    if (value.is_degenerate() || value.cell != source) {
      return bad_input(fmt::format("face {} of \"{}\" is {}\"{}\", not \"{}\": it cannot go to the copy \"{}\"", face,
                                   name, value.is_degenerate() ? "degenerate over " : "", name_of(value.cell),
                                   operation_.splits[split].cell, operation_.splits[split].copy));
    }
    value.cell = first_copy + static_cast<CellId>(split);
    if (!is_copy(cell)) {
      moves_.push_back({cell, static_cast<std::uint32_t>(slot), value.cell, value.order});
    }
    return Done{};
  }

  /// The faces of a cell that is split or whose incidences move; kept, in the order in which they were asked for.
  std::vector<Value>& faces_of(CellId c) {
    const auto [at, is_new] = faces_.try_emplace(c);
    if (is_new) {
      changed_.push_back(c);
      const auto arity = static_cast<std::uint32_t>(structure_.faces(source_of(c)).size());
      for (std::uint32_t k = 0; k < arity; ++k) {
        at->second.push_back(structure_.face_of_cell(source_of(c), k));
      }
    }
    return at->second;
  }

  [[nodiscard]] Value face(const Value& v, std::uint32_t k) const {
    return structure_.maps().face(v, k, [this](CellId c, std::uint32_t number) {
      const auto changed = faces_.find(c);
      return changed != faces_.end() ? changed->second[number] : structure_.face_of_cell(c, number);
    });
  }

  Status check_laws() const {
    std::vector<CellId> cells = changed_;
    std::unordered_set<CellId> seen(cells.begin(), cells.end());
    for (const CellId c : changed_) {
      if (is_copy(c)) {
        continue;  // what has a copy as a face is among the changed cells
      }
      for (const CellId coface : structure_.cofaces(c)) {
        if (seen.insert(coface).second) {
          cells.push_back(coface);
        }
      }
    }
    for (const CellId c : cells) {
      const TypeId type = structure_.type_id(source_of(c));
      const Value cell{c, type, 0};
      for (const FaceLaw& law : structure_.types().info(type).laws) {
        const Value one = face(face(cell, law.first), law.second);
        const Value other = face(face(cell, law.other_first), law.other_second);
        if (!(one == other)) {
          return Error{
              Errc::refused,
              fmt::format("after this split \"{}\" would break a face law: face {} of its face {} would be \"{}\", and "
                          "face {} of its face {} \"{}\", but they must be one cell: split more, or move more",
                          name_of(c), law.second, law.first, name_of(one.cell), law.other_second, law.other_first,
                          name_of(other.cell))};
        }
      }
    }
    return Done{};
  }

  /// Copies by dimension, so that faces come before what they are faces of.
  void write(Plan& plan) const {
    std::vector<std::size_t> order(copies_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return structure_.dimension(copies_[a].source) < structure_.dimension(copies_[b].source);
    });
    std::vector<std::vector<Incidence>> faces;
    for (const std::size_t k : order) {
      faces.emplace_back();
      for (const Value& v : faces_.at(first_copy + static_cast<CellId>(k))) {  // this may make nodes: so ids come later
        faces.back().push_back(is_copy(v.cell) ? Incidence{v.cell, v.order} : structure_.incidence_of(v));
      }
    }
    plan.first = structure_.created();
    std::vector<CellId> id(copies_.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      id[order[k]] = structure_.created() + static_cast<CellId>(k);
    }
    const auto final_id = [&](CellId c) { return is_copy(c) ? id[c - first_copy] : c; };
    for (std::size_t k = 0; k < order.size(); ++k) {
      const NewCopy& copy = copies_[order[k]];
      const std::size_t first_face = plan.faces.size();
      for (Incidence& face : faces[k]) {
        face.node = final_id(face.node);
      }
      add_faces(plan, faces[k]);
      plan.names += copy.name;
      plan.sources.push_back(copy.source);
      if (copy.order != same_order) {
        plan.name_orders.emplace_back(static_cast<std::uint32_t>(k), copy.order);
      }
      add_cell(plan, structure_.type_id(copy.source), first_face);
    }
    for (const Move& move : moves_) {
      plan.moves.push_back({move.cell, move.slot, final_id(move.to), move.order});
    }
  }

  const Deidentify& operation_;
  const Planner& planner_;
  const Structure& structure_;
  std::vector<NewCopy> copies_;
  std::unordered_map<std::string_view, CellId> copy_names_;
  std::unordered_map<CellId, std::vector<Value>> faces_;  // references into it stay valid
  std::vector<CellId> changed_;                           // its keys
  std::vector<Move> moves_;
};

}  // namespace

Status Planner::plan(const Deidentify& operation, Plan& plan) {
  plan.clear();
  for (const Deidentify::Split& split : operation.splits) {
    if (Status s = check_new_name(split.copy); !s) {
      return s;
    }
  }
  if (Status s = check_room(static_cast<std::int64_t>(operation.splits.size())); !s) {
    return s;
  }
  return SplitPlanner(operation, *this, structure_).run(plan);
}

}  // namespace sesame::ops
