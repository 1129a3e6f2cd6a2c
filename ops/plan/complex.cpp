// Explicit complexes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "ops/plan/double_boundary.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/hash_index.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// Lays out the cells of a `complex` operation so that faces come before what they are faces of.
class ComplexPlanner {
 public:
  ComplexPlanner(const MakeComplex& operation, const Structure& structure, const Limits& limits, Plan& plan)
      : operation_{operation},
        types_{structure.types()},
        maps_{structure.maps()},
        base_{structure.cells().size()},
        limits_{limits},
        plan_{plan} {
    plan_.first = base_;
  }

  Status run() {
    if (Status s = index_cells(); !s) {
      return s;
    }
    placed_.assign(operation_.cells.size(), none);
    declared_.assign(operation_.cells.size(), none);
    for (std::uint32_t k = 0; k < operation_.cells.size(); ++k) {
      if (Status s = place(k); !s) {
        return s;
      }
    }
    return Done{};
  }

 private:
  using Faces = boost::container::small_vector<CellId, 6>;

  [[nodiscard]] std::string title(std::uint32_t k) const {
    return fmt::format("cell {} of complex {}", sparse::quoted(operation_.cells.id(k)),
                       sparse::quoted(operation_.name));
  }

  Status index_cells() {
    for (std::uint32_t k = 0; k < operation_.cells.size(); ++k) {
      const std::string_view id = operation_.cells.id(k);
      if (!is_name(id)) {
        return Error{Errc::bad_input,
                     fmt::format("cell {} of complex {} needs an id without white space or control characters", k + 1,
                                 sparse::quoted(operation_.name))};
      }
      const std::uint64_t hash = hash_of(id);
      if (find(id, hash) != none) {
        return Error{Errc::bad_input, fmt::format("complex {} lists cell {} twice: ids must differ",
                                                  sparse::quoted(operation_.name), sparse::quoted(id))};
      }
      index_.insert(hash, k);
    }
    return Done{};
  }

  static std::uint64_t hash_of(std::string_view id) { return std::hash<std::string_view>{}(id); }
  /// The number of the cell with an id, or none.
  [[nodiscard]] std::uint32_t find(std::string_view id, std::uint64_t hash) const {
    return index_.find(hash, [&](std::uint32_t k) { return operation_.cells.id(k) == id; });
  }

  /// Places cell k after its faces. A face's type is checked before the face is placed: types lose a dimension with
  /// each face, so the recursion is never deeper than a dimension, and no cell can be met below itself.
  Status place(std::uint32_t k) {
    if (placed_[k] != none) {
      return Done{};
    }
    const Result<TypeId> type = type_of(k);
    if (!type) {
      return type.error();
    }
    Faces faces;
    for (const std::string_view id : operation_.cells.faces(k)) {
      const Result<CellId> face = place_face(k, faces.size(), id);
      if (!face) {
        return face.error();
      }
      faces.push_back(*face);
    }
    if (const ListedBoundary* boundary = operation_.cells.boundary(k);
        boundary != nullptr && boundary->dimension == 1 && !faces.empty() && boundary->coefficients[0] < 0) {
      std::swap(faces[0], faces[1]);  // the end of an edge, then its beginning
    }
    if (Status s = check_laws(k, *type, faces); !s) {
      return s;
    }
    placed_[k] = base_ + plan_.cells.size();
    plan_.names.append(operation_.name).append(1, '.').append(operation_.cells.id(k));
    const std::size_t first_face = plan_.faces.size();
    plan_.faces.insert(plan_.faces.end(), faces.begin(), faces.end());
    add_cell(*type, first_face, plan_);
    return Done{};
  }

  /// Face f of cell k, by its id, placed.
  Result<CellId> place_face(std::uint32_t k, std::size_t f, std::string_view id) {
    const Result<std::uint32_t> face = listed_face(k, id);
    if (!face) {
      return face.error();
    }
    if (Status s = check_face_type(k, f, *face); !s) {
      return s.error();
    }
    if (Status s = place(*face); !s) {
      return s.error();
    }
    return placed_[*face];
  }

  /// Which one is listed by the id of a face of cell k.
  Result<std::uint32_t> listed_face(std::uint32_t k, std::string_view id) const {
    const std::uint32_t face = find(id, hash_of(id));
    if (face == none) {
      return Error{Errc::unknown_name,
                   fmt::format("{} names a face {} that is not listed there", title(k), sparse::quoted(id))};
    }
    return face;
  }

  /// The type of cell k as listed. Errors: a number of faces that no such cell has; a type out of all proportion.
  Result<TypeId> type_of(std::uint32_t k) {
    if (declared_[k] != none) {
      return declared_[k];
    }
    if (const ListedBoundary* boundary = operation_.cells.boundary(k)) {
      const Result<TypeId> type = type_by_boundary(k, *boundary);
      return type ? declared_[k] = *type : type;
    }
    const std::size_t faces = operation_.cells.faces(k).size();
    const CellType* given = operation_.cells.type(k);
    if (given == nullptr && faces < simplices_.size() && simplices_[faces] != none) {
      return declared_[k] = simplices_[faces];
    }
    CellType type;
    if (given != nullptr) {
      type = *given;
    } else if (faces == 1) {
      return Error{Errc::bad_input, fmt::format("{} has 1 face: a vertex has none, an edge 2", title(k))};
    } else if (faces > 0) {
      type = {static_cast<int>(faces) - 1};
    }
    if (has_bad_entry(type)) {
      return Error{Errc::bad_input,
                   fmt::format("{} has the type [{}]: the entries of a type are >= 1", title(k), fmt::join(type, ","))};
    }
    if (standard_cell_count(type) > limits_.cells_of_standard) {
      return Error{Errc::refused, fmt::format("{} is a {}: cells may have at most {} faces of all dimensions", title(k),
                                              describe(type), limits_.cells_of_standard)};
    }
    declared_[k] = types_.intern(type);
    const std::size_t arity = types_.info(declared_[k]).faces.size();
    if (arity != faces) {
      return Error{Errc::bad_input, fmt::format("{} is a {} and needs {} faces, but {} are listed", title(k),
                                                describe(type), arity, faces)};
    }
    if (given == nullptr) {
      simplices_.resize(std::max(simplices_.size(), faces + 1), none);
      simplices_[faces] = declared_[k];
    }
    return declared_[k];
  }

  /// The dimension of a cell as listed, be its type right or not.
  [[nodiscard]] int dimension_of(std::uint32_t k) const {
    if (const ListedBoundary* boundary = operation_.cells.boundary(k)) {
      return boundary->dimension;
    }
    const CellType* type = operation_.cells.type(k);
    const std::size_t faces = operation_.cells.faces(k).size();
    return type != nullptr ? std::accumulate(type->begin(), type->end(), 0) : std::max(static_cast<int>(faces) - 1, 0);
  }

  /// Of a cell known by its boundary. Dimensions fall with each face, so no cell is met below itself.
  Result<TypeId> type_by_boundary(std::uint32_t k, const ListedBoundary& boundary) {
    const int p = boundary.dimension;
    const std::size_t count = boundary.coefficients.size();
    if (p > largest_dimension) {
      return Error{Errc::refused,
                   fmt::format("{} has the dimension {}: {} is the largest", title(k), p, largest_dimension)};
    }
    if (p == 0 && count > 0) {
      return Error{Errc::bad_input, fmt::format("{} has the dimension 0 and a boundary: a vertex has none", title(k))};
    }
    if (p == 1 && (count != 2 || std::abs(boundary.coefficients[0]) != 1 ||
                   boundary.coefficients[0] != -boundary.coefficients[1])) {
      return Error{Errc::bad_input,
                   fmt::format("{} has the dimension 1: its boundary should be its end less its beginning, as "
                               "[[1,\"w\"],[-1,\"v\"]], where both may be one vertex",
                               title(k))};
    }
    constexpr std::int64_t largest = 1'000'000'000;
    const auto add_absolute = [](std::int64_t sum, int n) { return sum + std::abs(std::int64_t{n}); };
    if (std::accumulate(boundary.coefficients.begin(), boundary.coefficients.end(), std::int64_t{0}, add_absolute) >
        largest) {
      return Error{Errc::refused,
                   fmt::format("the coefficients in the boundary of {} come to more than {}", title(k), largest)};
    }
    std::vector<TypeTable::BoundaryFace> faces;
    for (const std::string_view id : operation_.cells.faces(k)) {
      const Result<std::uint32_t> face = listed_face(k, id);
      if (!face) {
        return face.error();
      }
      if (const int q = dimension_of(*face); q != p - 1) {
        return Error{Errc::bad_input,
                     fmt::format("{} has the dimension {}, but {} in its boundary the dimension {}: it should be {}",
                                 title(k), p, sparse::quoted(id), q, p - 1)};
      }
      const Result<TypeId> type = type_of(*face);
      if (!type) {
        return type;
      }
      faces.push_back({boundary.coefficients[faces.size()], *type});
    }
    if (p <= 1) {
      return types_.simplex(p);
    }
    constexpr std::size_t most = 1'000'000;
    if (types_.length_by_boundary(faces) > most) {
      return Error{Errc::refused,
                   fmt::format("the boundary of {} has more terms, with those of its faces, than a cell may "
                               "have: cut it up",
                               title(k))};
    }
    return types_.by_boundary(p, faces);
  }

  /// Face f of cell k is listed as cell `face`: are the types right?
  Status check_face_type(std::uint32_t k, std::size_t f, std::uint32_t face) {
    const Result<TypeId> type = type_of(face);
    if (!type) {
      return type.error();
    }
    const TypeId wanted = types_.info(declared_[k]).faces[f].type;
    if (*type != wanted) {
      return Error{Errc::bad_input, fmt::format("face {} of {} should be a {}, but \"{}\" is a {}", f, title(k),
                                                describe(types_.info(wanted).type), operation_.cells.id(face),
                                                describe(types_.info(*type).type))};
    }
    return Done{};
  }

  [[nodiscard]] const Plan::NewCell& planned(CellId c) const { return plan_.cells[c - base_]; }
  [[nodiscard]] CellId planned_face(CellId c, std::uint32_t k) const { return plan_.faces[planned(c).first_face + k]; }
  [[nodiscard]] std::string_view planned_name(CellId c) const {
    const std::uint64_t begin = c == base_ ? 0 : planned(c - 1).name_end;
    return std::string_view{plan_.names}.substr(begin, planned(c).name_end - begin);
  }

  /// The boundary of cell k, which is not planned yet, is a cycle.
  Status check_cycle(std::uint32_t k, TypeId type, const Faces& faces) const {
    const CellId left = left_of_double_boundary(
        none, maps_, [&](CellId c) -> const TypeInfo& { return types_.info(c == none ? type : planned(c).type); },
        [&](CellId c, std::uint32_t f) { return Value{c == none ? faces[f] : planned_face(c, f)}; });
    return left == none ? Status{Done{}}
                        : Error{Errc::bad_input,
                                fmt::format("the boundary of {} is no cycle: \"{}\" is left in the boundary of it",
                                            title(k), planned_name(left))};
  }

  Status check_laws(std::uint32_t k, TypeId type, const Faces& faces) const {
    if (is_by_boundary(types_.info(type).type)) {
      return check_cycle(k, type, faces);
    }
    for (const FaceLaw& law : types_.info(type).laws) {
      const CellId one = planned_face(faces[law.first], law.second);
      const CellId other = planned_face(faces[law.other_first], law.other_second);
      if (one != other) {
        return Error{Errc::bad_input,
                     fmt::format("{} breaks a face law: face {} of its face {} is \"{}\", and face {} of its face {} "
                                 "is \"{}\", but they must be one cell",
                                 title(k), law.second, law.first, planned_name(one), law.other_second, law.other_first,
                                 planned_name(other))};
      }
    }
    return Done{};
  }

  const MakeComplex& operation_;
  TypeTable& types_;
  const VertexMaps& maps_;
  CellId base_;
  const Limits& limits_;
  Plan& plan_;
  sparse::HashIndex index_;        // of the listed cells, by id
  std::vector<CellId> placed_;     // per listed cell: its id in the plan
  std::vector<TypeId> declared_;   // per listed cell: its type
  std::vector<TypeId> simplices_;  // by number of faces, of cells without a type, or none
};

}  // namespace

Status plan_complex(const MakeComplex& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_new_name(operation.name, structure); !s) {
    return s;
  }
  if (Status s = check_room(static_cast<std::int64_t>(operation.cells.size()), structure, limits); !s) {
    return s;
  }
  std::string full = operation.name + ".";
  const std::size_t base = full.size();
  const bool are_free = is_free_beginning(full, structure, operation.cells.size());
  for (std::uint32_t k = 0; !are_free && k < operation.cells.size(); ++k) {
    full.replace(base, std::string::npos, operation.cells.id(k));
    if (structure.is_name_taken(full)) {
      return Error{Errc::bad_input,
                   fmt::format("the name \"{}\" is in use: choose another name for the complex or the cell", full)};
    }
  }
  if (Status s = ComplexPlanner(operation, structure, limits, plan).run(); !s) {
    return s;
  }
  plan.new_body = operation.name;
  return Done{};
}

}  // namespace sesame::ops
