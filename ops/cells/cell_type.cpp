#include "ops/cells/cell_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using sparse::expects;

/// The type of a face: a component of size 1 vanishes with its face.
CellType face_type(const CellType& type, std::size_t component) {
  CellType face = type;
  if (--face[component] == 0) {
    face.erase(face.begin() + static_cast<std::ptrdiff_t>(component));
  }
  return face;
}

std::uint32_t flat_index(const CellType& type, std::size_t component, int vertex) {
  int index = vertex;
  for (std::size_t i = 0; i < component; ++i) {
    index += type[i] + 1;
  }
  return static_cast<std::uint32_t>(index);
}

/// The laws of S. Peltier's habilitation (2023), definition 4, with operators acting on the left.
std::vector<FaceLaw> face_laws(const CellType& type) {
  std::vector<FaceLaw> laws;
  for (std::size_t i = 0; i < type.size(); ++i) {
    for (int j = 0; j <= type[i]; ++j) {
      const CellType after_ij = face_type(type, i);
      const std::uint32_t ij = flat_index(type, i, j);
      if (type[i] > 1) {  // d^i_l d^i_j = d^i_{j-1} d^i_l for l < j
        for (int l = 0; l < j; ++l) {
          laws.push_back({ij, flat_index(after_ij, i, l), flat_index(type, i, l), flat_index(after_ij, i, j - 1)});
        }
      }
      for (std::size_t k = 0; k < i; ++k) {  // d^k_l d^i_j = d^{i'}_j d^k_l
        const CellType after_k = face_type(type, k);
        const std::size_t shifted = type[k] > 1 ? i : i - 1;
        for (int l = 0; l <= type[k]; ++l) {
          laws.push_back({ij, flat_index(after_ij, k, l), flat_index(type, k, l), flat_index(after_k, shifted, j)});
        }
      }
    }
  }
  return laws;
}

/// A face of a standard simploid: its vertex subsets as bit masks, one after the other from the lowest bits on.
/// Types are so small (standard_cell_count) that 64 bits always suffice.
using Mask = std::uint64_t;

/// The non-empty subsets of {0..a}, lexicographically as lists of vertices.
std::vector<Mask> subsets(int a) {
  std::vector<Mask> all;
  for (int first = 0; first <= a; ++first) {
    all.push_back(Mask{1} << first);
    if (first < a) {
      for (const Mask rest : subsets(a - first - 1)) {
        all.push_back(Mask{1} << first | rest << (first + 1));
      }
    }
  }
  return all;
}

/// All faces by dimension, then lexicographically in the subsets.
std::vector<Mask> all_faces(const CellType& type) {
  std::vector<Mask> faces{0};
  int offset = 0;
  for (const int a : type) {
    std::vector<Mask> longer;
    const std::vector<Mask> choices = subsets(a);
    for (const Mask face : faces) {
      for (const Mask choice : choices) {
        longer.push_back(face | choice << offset);
      }
    }
    faces = std::move(longer);
    offset += a + 1;
  }
  std::stable_sort(faces.begin(), faces.end(), [](Mask x, Mask y) { return std::popcount(x) < std::popcount(y); });
  return faces;
}

}  // namespace

TypeTable::TypeTable() { intern({}); }

TypeId TypeTable::intern(const CellType& type) {
  if (const auto known = ids_.find(type); known != ids_.end()) {
    return known->second;
  }
  expects(std::all_of(type.begin(), type.end(), [](int a) { return a >= 1; }), "a simploid's type has entries >= 1");
  TypeInfo info;
  info.type = type;
  info.dimension = std::accumulate(type.begin(), type.end(), 0);
  int before = 0;
  for (std::size_t i = 0; i < type.size(); ++i) {
    const TypeId face = intern(face_type(type, i));
    for (int j = 0; j <= type[i]; ++j) {
      info.faces.push_back({static_cast<int>(i), j, (j + before) % 2 == 0 ? 1 : -1, face});
    }
    before += type[i];
  }
  info.laws = face_laws(type);
  return add(type, std::move(info));
}

TypeId TypeTable::add(CellType type, TypeInfo info) {
  const auto id = static_cast<TypeId>(infos_.size());
  infos_.push_back(std::move(info));
  ids_.emplace(std::move(type), id);
  return id;
}

TypeId TypeTable::product(TypeId left, TypeId right) {
  if (left == vertex() || right == vertex()) {
    return left == vertex() ? right : left;
  }
  CellType type = infos_[left].type;
  const CellType& more = infos_[right].type;
  type.insert(type.end(), more.begin(), more.end());
  return intern(type);
}

TypeId TypeTable::coned(TypeId base, bool by_edge) {
  return by_edge ? product(base, simplex(1)) : simplex(infos_[base].dimension + 1);
}

TypeId TypeTable::simplex(int dimension) {
  const auto at = static_cast<std::size_t>(dimension);
  if (at >= simplices_.size()) {
    simplices_.resize(at + 1, none);
  }
  if (simplices_[at] == none) {
    simplices_[at] = dimension == 0 ? vertex() : intern({dimension});
  }
  return simplices_[at];
}

const StandardCell& TypeTable::standard(TypeId id) {
  if (id < standards_.size() && standards_[id] != nullptr) {
    return *standards_[id];
  }
  StandardCell standard = is_of_map(infos_[id].type) ? standard_of_map(id) : standard_simploid(infos_[id].type);
  standard.by_suffix.resize(standard.cells.size());
  std::iota(standard.by_suffix.begin(), standard.by_suffix.end(), 0U);
  std::sort(standard.by_suffix.begin(), standard.by_suffix.end(),
            [&](std::uint32_t a, std::uint32_t b) { return standard.cells[a].suffix < standard.cells[b].suffix; });
  if (id >= standards_.size()) {
    standards_.resize(id + 1);
  }
  standards_[id] = std::make_unique<StandardCell>(std::move(standard));
  return *standards_[id];
}

StandardCell TypeTable::standard_simploid(const CellType& whole) {
  StandardCell standard;
  std::unordered_map<Mask, std::uint32_t> position;
  for (const Mask mask : all_faces(whole)) {
    StandardFace cell;
    CellType type;
    int offset = 0;
    for (const int a : whole) {
      const Mask subset = mask >> offset & ((Mask{1} << (a + 1)) - 1);
      const int size = std::popcount(subset);
      if (size > 1) {
        type.push_back(size - 1);
      }
      cell.suffix += cell.suffix.empty() ? "" : "x";
      const char* separator = "";
      for (int v = 0; v <= a; ++v) {
        if ((subset >> v & 1) == 0) {
          continue;
        }
        cell.suffix += separator + std::to_string(v);
        separator = "-";
        if (size > 1) {
          cell.faces.push_back(position.at(mask & ~(Mask{1} << (offset + v))));
        }
      }
      offset += a + 1;
    }
    cell.type = intern(type);
    position.emplace(mask, static_cast<std::uint32_t>(standard.cells.size()));
    standard.cells.push_back(std::move(cell));
  }
  return standard;
}

void TypeTable::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(infos_.size()));
  for (const TypeInfo& info : infos_) {
    to.put_list(info.type);
  }
}

/// A type comes after those of its faces.
void TypeTable::load(sparse::ArchiveReader& from) {
  for (std::size_t left = from.get_count(sizeof(std::uint64_t)); left > 0 && from.is_good(); --left) {
    const auto type = from.get_list<CellType>();
    if (is_of_map(type)) {
      if (!load_shape(type, from)) {
        return;
      }
      continue;
    }
    if (is_by_boundary(type)) {
      if (!load_by_boundary(type, from)) {
        return;
      }
      continue;
    }
    const auto is_entry = [](int a) { return a >= 1 && a <= largest_dimension; };
    if (!from.check(type.size() <= largest_dimension && std::all_of(type.begin(), type.end(), is_entry) &&
                        std::accumulate(type.begin(), type.end(), 0) <= largest_dimension,
                    "the type of a cell has entries >= 1, and no dimension above 62")) {
      return;
    }
    bool has_faces = true;
    for (std::size_t component = 0; component < type.size(); ++component) {
      has_faces = has_faces && ids_.contains(face_type(type, component));
    }
    const bool is_vertex = type.empty() && infos_.size() == 1;  // which is there from the start
    if (from.check(has_faces && (is_vertex || !ids_.contains(type)), "each type follows those of its faces")) {
      intern(type);
    }
  }
}

std::uint32_t StandardCell::find(std::string_view suffix) const {
  const auto at = std::lower_bound(by_suffix.begin(), by_suffix.end(), suffix,
                                   [this](std::uint32_t k, std::string_view text) { return cells[k].suffix < text; });
  return at != by_suffix.end() && cells[*at].suffix == suffix ? *at : std::uint32_t{none};
}

std::int64_t standard_cell_count(const CellType& type) {
  std::int64_t count = 1;
  for (const int a : type) {
    if (a >= 62 || __builtin_mul_overflow(count, (std::int64_t{1} << (a + 1)) - 1, &count)) {
      return std::numeric_limits<std::int64_t>::max();
    }
  }
  return count;
}

std::string describe(const CellType& type) {
  if (type.empty()) {
    return "vertex";
  }
  if (is_of_map(type)) {
    const std::size_t darts = (type.size() - 2) / static_cast<std::size_t>(type[1]);
    return type[1] == 2 ? fmt::format("polygon with {} side{}", darts / 2, darts == 2 ? "" : "s")
                        : fmt::format("cell of dimension {} with {} darts", type[1], darts);
  }
  if (is_by_boundary(type)) {
    std::size_t faces = 0;
    for (std::size_t at = 2; at < type.size(); at += 2 + static_cast<std::size_t>(type[at + 1])) {
      ++faces;
    }
    return fmt::format("{} of dimension {} with a boundary of {} term{}",
                       is_cone(type)        ? "cell that is no ball,"
                       : is_cone_part(type) ? "part of a cell,"
                                            : "cell",
                       type[1], faces, faces == 1 ? "" : "s");
  }
  if (type.size() == 1) {
    return fmt::format("simplex of dimension {}", type[0]);
  }
  if (std::all_of(type.begin(), type.end(), [](int a) { return a == 1; })) {
    return fmt::format("cube of dimension {}", type.size());
  }
  return fmt::format("simploid [{}]", fmt::join(type, ","));
}

bool is_simplex(const CellType& type) { return type.size() <= 1; }

}  // namespace sesame::ops
