#include "ops/planner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <map>
#include <set>
#include <unordered_set>

namespace sesame::ops {
namespace {

Error bad_input(std::string what) { return {Errc::bad_input, std::move(what)}; }

/// Ends the name begun at the end of plan.names and adds the cell that bears it.
void add_cell(Plan& plan, TypeId type, std::size_t first_face) {
  plan.cells.push_back({type, static_cast<std::uint32_t>(first_face), plan.names.size()});
}

/// The Unicode characters of categories Z (separators) and Cc (control), and the byte order mark.
bool is_space_or_control(std::uint32_t c) {
  return c <= 0x20 || (c >= 0x7f && c <= 0xa0) || c == 0x1680 || (c >= 0x2000 && c <= 0x200a) || c == 0x2028 ||
         c == 0x2029 || c == 0x202f || c == 0x205f || c == 0x3000 || c == 0xfeff;
}

/// Not empty, UTF-8, without white space or control characters.
bool is_name(std::string_view name) {
  namespace utf = boost::locale::utf;
  const char* at = name.data();
  const char* const end = at + name.size();
  while (at != end) {
    const utf::code_point c = utf::utf_traits<char>::decode(at, end);
    if (c == utf::illegal || c == utf::incomplete || is_space_or_control(c)) {
      return false;
    }
  }
  return !name.empty();
}

/// The text form cannot say such a type, but a program can.
bool has_bad_entry(const CellType& type) {
  return std::any_of(type.begin(), type.end(), [](int a) { return a < 1; });
}

/// Lays out the cells of a `complex` operation so that faces come before what they are faces of.
class ComplexPlanner {
 public:
  ComplexPlanner(const MakeComplex& operation, const Structure& structure, const Limits& limits, Plan& plan)
      : operation_{operation}, types_{structure.types()}, base_{structure.created()}, limits_{limits}, plan_{plan} {}

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

Result<CellId> Planner::resolve(const std::string& name) const {
  if (const auto cell = structure_.lookup(name)) {
    return structure_.find(*cell);
  }
  return Error{Errc::unknown_name,
               fmt::format("there is no cell \"{}\"{}", name,
                           structure_.lookup_body(name) ? ": this is the name of a body; name a cell of it" : "")};
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

Status Planner::check_standard(const CellType& type) const {
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
  return check_room(cells);
}

Status Planner::plan(const MakeSimplex& operation, Plan& plan) {
  plan.clear();
  const CellType type = operation.dimension == 0 ? CellType{} : CellType{operation.dimension};
  if (const Status s = check_standard(type); !s) {
    return s;
  }
  const Status s = plan_standard(operation.name, structure_.types().intern(type), plan);
  if (s && operation.dimension == 0) {  // the one vertex is vertex 0 as well
    const std::string alias = operation.name + ".0";
    if (const Status free = check_new_name(alias); !free) {
      return free;
    }
    plan.aliases.emplace_back(alias, structure_.created());
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
  const CellId base = structure_.created();
  const StandardCell& standard = structure_.types().standard(type);
  for (std::size_t k = 0; k < standard.cells.size(); ++k) {
    const StandardFace& cell = standard.cells[k];
    const std::size_t begin = plan.names.size();
    plan.names.append(name);
    if (k + 1 < standard.cells.size()) {
      plan.names.append(1, '.').append(cell.suffix);
      const std::string_view full = std::string_view{plan.names}.substr(begin);
      if (structure_.is_name_taken(full)) {
        return bad_input(fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new {}: choose another", full,
                                     name, describe(structure_.types().info(type).type)));
      }
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

Result<std::vector<CellId>> Planner::coned_cells(const MakeCone& operation) const {
  std::vector<CellId> coned;
  if (const auto* body_name = std::get_if<std::string>(&operation.over)) {
    const auto body = structure_.lookup_body(*body_name);
    if (!body) {
      return Error{Errc::unknown_name,
                   fmt::format("there is no body \"{0}\"{1}", *body_name,
                               structure_.lookup(*body_name)
                                   ? fmt::format(": this is a cell; to cone over it give a list, [\"{}\"]", *body_name)
                                   : "")};
    }
    coned = structure_.cells_of(*body);
  } else if (const auto* names = std::get_if<std::vector<std::string>>(&operation.over)) {
    std::unordered_set<CellId> seen;
    std::vector<CellId> pending;
    for (const std::string& name : *names) {
      const Result<CellId> cell = resolve(name);
      if (!cell) {
        return cell.error();
      }
      pending.push_back(*cell);
    }
    while (!pending.empty()) {
      const CellId c = pending.back();
      pending.pop_back();
      if (seen.insert(c).second) {
        coned.push_back(c);
        for (const CellId face : structure_.faces_as_created(c)) {
          pending.push_back(structure_.find(face));
        }
      }
    }
  } else {
    for (const BodyId body : structure_.current_bodies()) {
      const std::vector<CellId> cells = structure_.cells_of(body);
      coned.insert(coned.end(), cells.begin(), cells.end());
    }
  }
  std::sort(coned.begin(), coned.end(), [this](CellId a, CellId b) {
    const int p = structure_.dimension(a);
    const int q = structure_.dimension(b);
    return p != q ? p < q : structure_.oldest(a) < structure_.oldest(b);
  });
  return coned;
}

Status Planner::plan(const MakeCone& operation, Plan& plan) {
  plan.clear();
  if (const Status s = check_new_name(operation.apex); !s) {
    return s;
  }
  const Result<std::vector<CellId>> coned = coned_cells(operation);
  if (!coned) {
    return coned.error();
  }
  if (const Status s = check_room(static_cast<std::int64_t>(coned->size()) + 1); !s) {
    return s;
  }
  TypeTable& types = structure_.types();
  const CellId apex = structure_.created();
  plan.names = operation.apex;
  add_cell(plan, types.vertex(), 0);
  std::unordered_map<CellId, CellId> cone_of;
  for (const CellId a : *coned) {
    const TypeInfo& info = structure_.type(a);
    if (!is_simplex(info.type)) {
      return Error{Errc::refused, fmt::format("a cone is taken over simplices only, but \"{}\" is a {}",
                                              structure_.name(a), describe(info.type))};
    }
    if (const Status s = check_standard({info.dimension + 1}); !s) {
      return s;
    }
    const std::string name = fmt::format("{}*{}", operation.apex, structure_.name(a));
    if (structure_.is_name_taken(name)) {
      return bad_input(fmt::format("the name \"{}\" is in use: choose another apex", name));
    }
    // The cone over a p-cell a: d_i is the cone over d_i a for i <= p, and d_{p+1} is a; over a vertex d_0 is the apex
    // and d_1 the vertex, so that its boundary is v - a.
    const std::size_t first_face = plan.faces.size();
    if (info.dimension == 0) {
      plan.faces.push_back(apex);
    }
    for (const CellId face : structure_.faces_as_created(a)) {
      plan.faces.push_back(cone_of.at(structure_.find(face)));
    }
    plan.faces.push_back(a);
    cone_of.emplace(a, apex + static_cast<CellId>(plan.cells.size()));
    plan.names += name;
    add_cell(plan, types.simplex(info.dimension + 1), first_face);
  }
  place_in_bodies(operation, *coned, plan);
  return Done{};
}

/// The new cells belong to the body that they are built over; a cone over several bodies makes them one.
void Planner::place_in_bodies(const MakeCone& operation, const std::vector<CellId>& coned, Plan& plan) const {
  std::set<BodyId> bodies;
  for (const CellId a : coned) {
    bodies.insert(structure_.body_of(a));
  }
  if (bodies.empty()) {
    plan.new_body = operation.apex;
    return;
  }
  plan.into_body = *bodies.begin();
  plan.joined_bodies.assign(std::next(bodies.begin()), bodies.end());
}

CellId Planner::overlay_find(CellId c) {
  const auto [at, is_new] = overlay_.emplace(c, c);
  if (is_new) {
    touched_.push_back(c);
    return c;
  }
  CellId root = at->second;
  while (true) {
    const CellId next = overlay_.find(root)->second;
    if (next == root) {
      break;
    }
    root = next;
  }
  while (c != root) {
    c = std::exchange(overlay_.find(c)->second, root);
  }
  return root;
}

Status Planner::plan(const Identify& operation, Plan& plan) {
  plan.clear();
  overlay_.clear();
  touched_.clear();
  std::vector<std::pair<CellId, CellId>> pending;
  for (const auto& [one, other] : operation.pairs) {
    const Result<CellId> a = resolve(one);
    const Result<CellId> b = resolve(other);
    if (!a || !b) {
      return a ? b.error() : a.error();
    }
    if (structure_.type_id(*a) != structure_.type_id(*b)) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a {} and \"{}\" a {}: only cells of the same type can be identified", one,
                               describe(structure_.type(*a).type), other, describe(structure_.type(*b).type))};
    }
    pending.emplace_back(*a, *b);
  }
  // Closing under faces needs no look at cofaces, so its cost does not depend on the object. Cells of one type have
  // faces of the same types in the same order: nothing below can be refused.
  while (!pending.empty()) {
    const auto [one, other] = pending.back();
    pending.pop_back();
    const CellId a = overlay_find(one);
    const CellId b = overlay_find(other);
    if (a == b) {
      continue;
    }
    overlay_[std::max(a, b)] = std::min(a, b);
    const auto faces_a = structure_.faces_as_created(a);
    const auto faces_b = structure_.faces_as_created(b);
    for (std::size_t k = 0; k < faces_a.size(); ++k) {
      pending.emplace_back(structure_.find(faces_a[k]), structure_.find(faces_b[k]));
    }
  }
  plan.merges = merges_of_overlay();
  return Done{};
}

std::vector<Merge> Planner::merges_of_overlay() {
  // The survivor of a class is the cell that stands for the most cells (the oldest of those): with it every path of the
  // union-find forest stays logarithmic without compression, which undo could not take back.
  std::map<CellId, std::vector<CellId>> classes;
  for (const CellId c : touched_) {
    classes[overlay_find(c)].push_back(c);
  }
  std::vector<Merge> merges;
  for (auto& [root, cells] : classes) {
    const auto before = [this](CellId a, CellId b) {
      const std::uint32_t m = structure_.members(a);
      const std::uint32_t n = structure_.members(b);
      return m != n ? m > n : structure_.oldest(a) < structure_.oldest(b);
    };
    std::sort(cells.begin(), cells.end(), before);
    for (std::size_t k = 1; k < cells.size(); ++k) {
      merges.push_back({cells[k], cells[0]});
    }
  }
  std::stable_sort(merges.begin(), merges.end(), [this](const Merge& x, const Merge& y) {
    return structure_.dimension(x.removed) < structure_.dimension(y.removed);
  });
  return merges;
}

}  // namespace sesame::ops
