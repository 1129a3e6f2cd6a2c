#include "ops/plan/star_of_simplex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "ops/plan/new_cells.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

using Mask = std::uint32_t;

/// The numbers of the bits of a mask, ascending.
std::vector<std::uint8_t> bits_of(Mask mask) {
  std::vector<std::uint8_t> bits;
  for (; mask != 0; mask &= mask - 1) {
    bits.push_back(static_cast<std::uint8_t>(std::countr_zero(mask)));
  }
  return bits;
}

/// How many smaller bits a mask has.
std::size_t rank_in(Mask mask, unsigned bit) {
  return static_cast<std::size_t>(std::popcount(mask & ((Mask{1} << bit) - 1)));
}

std::string with_vertices(const std::string& name, std::span<const std::uint8_t> vertices) {
  return vertices.empty() ? name : fmt::format("{}.{}", name, fmt::join(vertices, "-"));
}

/// Calls visit(mask) for the subsets of a set, the empty one too, itself or not, the smaller ones first.
template <class Visit>
void for_each_subset(Mask set, bool itself, Visit visit) {
  std::vector<Mask> subsets;
  if (itself) {
    subsets.push_back(set);
  }
  for (Mask subset = set; subset != 0;) {
    subset = (subset - 1) & set;
    subsets.push_back(subset);
  }
  std::ranges::sort(subsets, {}, [](Mask m) { return std::pair{std::popcount(m), m}; });
  std::ranges::for_each(subsets, visit);
}

/// Cells to be written into a plan, each after its faces.
class NewSimplices {
 public:
  NewSimplices(const Structure& structure, const Limits& limits) : structure_{structure}, limits_{limits} {}

  std::size_t add(std::size_t vertices, std::string name) {
    cells_.push_back({structure_.types().simplex(static_cast<int>(vertices) - 1), std::move(name), {}});
    return cells_.size() - 1;
  }
  /// The next face of the last cell, a new one or one that is there.
  void add_new_face(std::size_t number, std::span<const std::uint8_t> order) {
    cells_.back().faces.push_back({{none, structure_.maps().order(order)}, number});
  }
  void add_old_face(const Value& face) { cells_.back().faces.push_back({structure_.values().incidence_of(face), 0}); }

  /// Errors: bad_input, for a name in use.
  Status write(BodyId body, Plan& plan) const {
    for (const NewSimplex& cell : cells_) {
      if (structure_.is_name_taken(cell.name)) {
        return Error{
            Errc::bad_input,
            fmt::format("the name \"{}\", which a new cell would have, is in use: choose another \"by\"", cell.name)};
      }
    }
    plan.first = structure_.cells().size();  // from here on nothing asks for nodes
    plan.into_body = body;
    for (const auto& [type, name, faces] : cells_) {
      const std::size_t first_face = plan.faces.size();
      for (const auto& [face, number] : faces) {
        add_face({face.node == none ? CellId{plan.first + number} : face.node, face.order}, plan);
      }
      plan.names += name;
      add_cell(type, first_face, plan);
    }
    return Done{};
  }
  [[nodiscard]] Status check_room(std::size_t cells) const {
    return ops::check_room(static_cast<std::int64_t>(cells), structure_, limits_);
  }

 private:
  struct Face {
    Incidence there;  ///< or no node, and a number
    std::size_t number;
  };
  struct NewSimplex {
    TypeId type;
    std::string name;
    std::vector<Face> faces;
  };
  const Structure& structure_;
  const Limits& limits_;
  std::vector<NewSimplex> cells_;
};

}  // namespace

Result<StarOfSimplex> StarOfSimplex::of(CellId simplex, std::span<const CellId> star, const Structure& structure,
                                        const Limits& limits) {
  StarOfSimplex made(structure, simplex);
  for (const CellId cell : star) {
    if (Status s = made.add(cell, limits); !s) {
      return s.error();
    }
  }
  return made;
}

/// All faces, from the largest down: each is one of the face with its smallest missing vertex, too.
Status StarOfSimplex::add(CellId cell, const Limits& limits) {
  const CellType& type = structure_.cells().type(cell).type;
  if (!is_simplex(type)) {
    return Error{Errc::refused,
                 fmt::format("\"{}\", which has \"{}\" as a face, is no simplex: only simplices are replaced",
                             structure_.name(cell), structure_.name(simplex_))};
  }
  if (Status s = check_size(type, limits); !s) {
    return s;
  }
  const auto dimension = static_cast<unsigned>(structure_.dimension(cell));
  Member member{cell, (Mask{2} << dimension) - 1, 0, {}, {}};
  member.faces.resize(std::size_t{member.vertices} + 1);
  member.faces[member.vertices] = structure_.directory().named_value(cell);
  std::size_t times = 0;
  for (Mask mask = member.vertices; mask > 0; --mask) {
    if (mask != member.vertices) {
      const auto missing = static_cast<unsigned>(std::countr_one(mask));
      const Value& larger = member.faces[mask | Mask{1} << missing];
      member.faces[mask] = structure_.values().face(larger, missing);  // all smaller vertices are there
    }
    if (member.faces[mask].cell == simplex_) {
      member.of_simplex = mask;
      ++times;
    }
  }
  if (times != 1) {
    return Error{
        Errc::refused,
        fmt::format("\"{}\" has \"{}\" as a face more than once: what is replaced is once in each cell around it",
                    structure_.name(cell), structure_.name(simplex_))};
  }
  member.in_simplex = named_vertices(member.faces[member.of_simplex]);
  if (std::popcount(member.vertices & ~member.of_simplex) == 1) {
    neighbours_.push_back(cell);
  }
  number_.emplace(cell, members_.size());
  members_.push_back(std::move(member));
  return Done{};
}

/// Of a value that is not degenerate: the vertices of its cell that its own are, numbered as the name of that has them.
VertexMap StarOfSimplex::named_vertices(const Value& v) const {
  VertexMap own = structure_.maps().map_of(v);
  if (own.empty()) {
    return {0};
  }
  const VertexMap named = structure_.maps().map_of(structure_.directory().named_value(v.cell));
  VertexMap number_of(named.size());
  for (std::size_t k = 0; k < named.size(); ++k) {
    number_of[named[k]] = static_cast<std::uint8_t>(k);
  }
  std::ranges::transform(own, own.begin(), [&](std::uint8_t at) { return number_of[at]; });
  return own;
}

/// In which neighbour a vertex of L is.
std::size_t StarOfSimplex::neighbour(const Member& member, unsigned vertex) const {
  const CellId cell = member.faces[member.of_simplex | Mask{1} << vertex].cell;
  return static_cast<std::size_t>(std::ranges::find(neighbours_, cell) - neighbours_.begin());
}

/// Per member t = A * L which of the neighbours are the vertices of L; none for one that has the same twice.
std::vector<StarOfSimplex::Mask> StarOfSimplex::opposite_simplices() const {
  std::vector<Mask> opposite;
  for (const Member& member : members_) {
    Mask found = 0;
    bool is_once = true;
    for (const std::uint8_t vertex : bits_of(member.vertices & ~member.of_simplex)) {
      const Mask bit = Mask{1} << neighbour(member, vertex);
      is_once = is_once && (found & bit) == 0;
      found |= bit;
    }
    opposite.push_back(is_once ? found : 0);
  }
  return opposite;
}

bool StarOfSimplex::can_be_flipped() const {
  const std::size_t around = neighbours_.size();
  if (around == 0) {
    return true;
  }
  if (around == 1 || around >= 32 || members_.size() != (std::size_t{1} << around) - 1) {
    return false;
  }
  std::vector<Mask> opposite = opposite_simplices();
  std::ranges::sort(opposite);
  return std::ranges::adjacent_find(opposite) == opposite.end() && opposite.back() != (Mask{1} << around) - 1;
}

Status StarOfSimplex::write_flip(const std::string& name, bool fills, const Limits& limits, Plan& plan) const {
  if (Status s = check_new_apex(name, structure_); !s) {
    return s;
  }
  const Member& simplex = members_.front();
  const auto size = static_cast<std::size_t>(std::popcount(simplex.vertices));
  const std::size_t around = std::max<std::size_t>(neighbours_.size(), 1);
  const Mask others = (Mask{1} << around) - 1;
  const std::vector<Mask> opposite = opposite_simplices();
  NewSimplices cells(structure_, limits);
  if (Status s = cells.check_room(std::size_t{1} << size); !s) {
    return s;
  }
  std::unordered_map<Mask, std::size_t> number;
  for_each_subset(simplex.vertices, fills, [&](Mask kept) {
    std::vector<std::uint8_t> vertices = bits_of(kept);  // in A * B
    const std::size_t of_simplex = vertices.size();
    for (std::size_t k = 0; k < around; ++k) {
      vertices.push_back(static_cast<std::uint8_t>(size + k));
    }
    number[kept] = cells.add(vertices.size(), kept == 0 ? name : with_vertices(name, vertices));
    if (vertices.size() == 1) {
      return;
    }
    for (std::size_t k = 0; k < of_simplex; ++k) {
      cells.add_new_face(number.at(kept & ~(Mask{1} << vertices[k])), {});
    }
    for (std::size_t k = 0; k < around; ++k) {
      const auto at = std::ranges::find(opposite, others & ~(Mask{1} << k)) - opposite.begin();
      cells.add_old_face(face_in_order(members_[static_cast<std::size_t>(at)], kept));
    }
  });
  return cells.write(structure_.body_of(simplex_), plan);
}

/// Of a cell t = A * L the face on some vertices of A and all of L: first those, as the name of A has them, then these
/// by the neighbours that they are in.
Value StarOfSimplex::face_in_order(const Member& member, Mask of_simplex) const {
  std::vector<std::pair<std::size_t, std::uint8_t>> places;  // in A * B, of vertices
  Mask face = 0;
  for (const std::uint8_t vertex : bits_of(member.vertices)) {
    const Mask bit = Mask{1} << vertex;
    std::size_t place = 0;
    if ((member.of_simplex & bit) != 0) {
      place = member.in_simplex[rank_in(member.of_simplex, vertex)];
      if ((of_simplex >> place & 1) == 0) {
        continue;
      }
    } else {
      place = std::size_t{32} + neighbour(member, vertex);
    }
    face |= bit;
    places.emplace_back(place, vertex);
  }
  std::ranges::sort(places);
  std::vector<std::uint8_t> order;
  for (const auto& [place, vertex] : places) {
    order.push_back(static_cast<std::uint8_t>(rank_in(face, vertex)));
  }
  return structure_.maps().reordered(structure_.maps().order(order), member.faces[face]);
}

Status StarOfSimplex::write_subdivision(const std::string& vertex, bool fills, const Limits& limits, Plan& plan) const {
  if (Status s = check_new_apex(vertex, structure_); !s) {
    return s;
  }
  struct Key {
    std::size_t member;
    Mask kept;  ///< the vertices of A' * L
  };
  std::vector<Key> keys;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Member& member = members_[k];
    for_each_subset(member.of_simplex, fills, [&](Mask of_simplex) {
      keys.push_back({k, of_simplex | (member.vertices & ~member.of_simplex)});
    });
  }
  std::ranges::stable_sort(keys, {}, [](const Key& key) { return std::popcount(key.kept); });
  NewSimplices cells(structure_, limits);
  if (Status s = cells.check_room(keys.size()); !s) {
    return s;
  }
  const auto packed = [](std::size_t member, Mask kept) { return std::uint64_t{member} << 32U | kept; };
  std::unordered_map<std::uint64_t, std::size_t> number;
  for (const auto& [k, kept] : keys) {
    const Member& member = members_[k];
    const std::vector<std::uint8_t> vertices = bits_of(kept);
    number[packed(k, kept)] = cells.add(
        vertices.size() + 1,
        kept == 0 ? vertex : with_vertices(fmt::format("{}*{}", vertex, structure_.name(member.cell)), vertices));
    if (kept == 0) {
      continue;
    }
    for (const std::uint8_t left_out : vertices) {
      const Mask rest = kept & ~(Mask{1} << left_out);
      if ((member.of_simplex >> left_out & 1) != 0) {
        cells.add_new_face(number.at(packed(k, rest)), {});
        continue;
      }
      const auto [smaller, image, order] = in_face(member, left_out, rest);
      cells.add_new_face(number.at(packed(smaller, image)), order);
    }
    cells.add_old_face(member.faces[kept]);
  }
  return cells.write(structure_.body_of(simplex_), plan);
}

/// The face of t opposite to a vertex of L is a cell of the star: its number, which of its vertices some of t are, and
/// the order in which they are that, with one more vertex at the end.
StarOfSimplex::InFace StarOfSimplex::in_face(const Member& member, unsigned left_out, Mask vertices) const {
  const Mask all = member.vertices & ~(Mask{1} << left_out);
  const Value& face = member.faces[all];
  const VertexMap named = named_vertices(face);
  InFace found{number_.at(face.cell), 0, {}};
  std::vector<std::uint8_t> images;
  for (const std::uint8_t vertex : bits_of(vertices)) {
    images.push_back(named[rank_in(all, vertex)]);
    found.vertices |= Mask{1} << images.back();
  }
  for (const std::uint8_t image : images) {
    found.order.push_back(static_cast<std::uint8_t>(rank_in(found.vertices, image)));
  }
  found.order.push_back(static_cast<std::uint8_t>(images.size()));
  return found;
}

}  // namespace sesame::ops
