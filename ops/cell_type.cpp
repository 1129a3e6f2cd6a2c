#include "ops/cell_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>

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

using Subset = std::vector<int>;

/// The non-empty subsets of {0..a}, lexicographically.
std::vector<Subset> subsets(int a) {
  std::vector<Subset> all;
  const std::uint32_t end = std::uint32_t{1} << (a + 1);
  for (std::uint32_t mask = 1; mask < end; ++mask) {
    Subset s;
    for (int v = 0; v <= a; ++v) {
      if ((mask >> v & 1) != 0) {
        s.push_back(v);
      }
    }
    all.push_back(std::move(s));
  }
  std::sort(all.begin(), all.end());
  return all;
}

using Tuple = std::vector<Subset>;

int dimension_of(const Tuple& tuple) {
  return std::accumulate(tuple.begin(), tuple.end(), 0,
                         [](int sum, const Subset& s) { return sum + static_cast<int>(s.size()) - 1; });
}

std::vector<Tuple> all_tuples(const CellType& type) {
  std::vector<Tuple> tuples{{}};
  for (const int a : type) {
    std::vector<Tuple> longer;
    for (const Tuple& t : tuples) {
      for (const Subset& s : subsets(a)) {
        longer.push_back(t);
        longer.back().push_back(s);
      }
    }
    tuples = std::move(longer);
  }
  std::stable_sort(tuples.begin(), tuples.end(),
                   [](const Tuple& x, const Tuple& y) { return dimension_of(x) < dimension_of(y); });
  return tuples;
}

std::string suffix_of(const Tuple& tuple) {
  std::string text;
  for (const Subset& s : tuple) {
    text += fmt::format("{}{}", text.empty() ? "" : "x", fmt::join(s, "-"));
  }
  return text;
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
  const auto id = static_cast<TypeId>(infos_.size());
  infos_.push_back(std::move(info));
  ids_.emplace(type, id);
  return id;
}

const StandardCell& TypeTable::standard(TypeId id) {
  if (const auto known = standards_.find(id); known != standards_.end()) {
    return known->second;
  }
  StandardCell standard;
  std::map<Tuple, std::uint32_t> position;
  for (const Tuple& tuple : all_tuples(infos_[id].type)) {
    StandardFace cell;
    CellType type;
    for (std::size_t i = 0; i < tuple.size(); ++i) {
      if (tuple[i].size() == 1) {
        continue;
      }
      type.push_back(static_cast<int>(tuple[i].size()) - 1);
      for (std::size_t j = 0; j < tuple[i].size(); ++j) {
        Tuple face = tuple;
        face[i].erase(face[i].begin() + static_cast<std::ptrdiff_t>(j));
        cell.faces.push_back(position.at(face));
      }
    }
    cell.type = intern(type);
    cell.suffix = suffix_of(tuple);
    position.emplace(tuple, static_cast<std::uint32_t>(standard.cells.size()));
    standard.cells.push_back(std::move(cell));
  }
  return standards_.emplace(id, std::move(standard)).first->second;
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
