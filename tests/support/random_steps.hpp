/// \file
/// Random construction operations that suit the present state of a structure. Same seed, same operations.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/cells/structure.hpp"
#include "ops/maps/chain_operations.hpp"
#include "ops/plan/planner.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tests/support/boundary_complexes.hpp"
#include "tests/support/polytopes.hpp"
#include "tests/support/random_complexes.hpp"
#include "tests/support/solids.hpp"

namespace sesame::tests {

/// What a stream of random operations should look like.
struct StreamShape {
  std::size_t most_cells = 60;  ///< from there on cells are only identified
  bool simploids = true;
  bool cones = true;
  bool degeneracies = false;  ///< cells become degenerate, and others are glued to degenerate ones
  bool splits = false;
  bool products = false;
  bool pyramids = false;      ///< cones over cells that are no simplices, and over whole bodies
  bool removals = false;      ///< of cells without cofaces, and of open stars
  bool replacements = false;  ///< flips and subdivisions, with removals
  bool maps = false;          ///< made, sewn, unsewn and extended; and cells that are known by their boundaries
};

/// A stream of all operations.
inline StreamShape everything(std::size_t most_cells) {
  return {.most_cells = most_cells,
          .simploids = true,
          .cones = true,
          .degeneracies = true,
          .splits = true,
          .products = true,
          .pyramids = true,
          .removals = true,
          .replacements = true};
}
/// The same, with maps.
inline StreamShape everything_and_maps(std::size_t most_cells) {
  StreamShape shape = everything(most_cells);
  shape.maps = true;
  return shape;
}

/// The current cells of the object, all lazy ones too, oldest first: without lazy families by increasing id.
inline std::vector<ops::CellId> current_cells(const ops::Structure& structure) {
  structure.lazy().make_all();
  std::vector<ops::CellId> cells;
  structure.cells().for_each_node([&](ops::CellId c) {
    if (structure.is_current(c) && !structure.lazy().is_consumed(c)) {
      cells.push_back(c);
    }
  });
  std::sort(cells.begin(), cells.end(), [&](ops::CellId a, ops::CellId b) { return structure.lazy().is_older(a, b); });
  return cells;
}

/// One vertex, one loop "e1", and triangles that say e_k = k e1; with `closed`, a disc that says e_n = 0, so that
/// H_1 = Z/n: a Moore space. Over Z the torsion hides behind units until the last cell.
inline ops::MakeComplex multiples_of_a_loop(const std::string& name, int n, bool closed) {
  ops::MakeComplex complex{name, {{"v", {}, {}, {}}, {"e1", {}, {"v", "v"}, {}}}};
  for (int k = 2; k <= n; ++k) {
    const std::string before = "e" + std::to_string(k - 1);
    const std::string loop = "e" + std::to_string(k);
    complex.cells.push_back({loop, {}, {"v", "v"}, {}});
    complex.cells.push_back({"t" + std::to_string(k), {}, {"e1", loop, before}, {}});
  }
  if (closed) {
    complex.cells.push_back({"c", {}, {"v", "v"}, {}});
    complex.cells.push_back({"d", {}, {"c", "c", "c"}, {}});
    complex.cells.push_back({"w", {}, {"c", "e" + std::to_string(n), "c"}, {}});
  }
  return complex;
}

/// One vertex, loops, and triangles on loops drawn at random: d_0 - d_1 + d_2 = 0 for any three, so H_1 is a random
/// group, and its torsion does not lie on the surface.
template <class Draws>
ops::MakeComplex random_relations(const std::string& name, Draws& random) {
  ops::MakeComplex complex{name, {{"v", {}, {}, {}}}};
  const int loops = random.in(1, 4);
  for (int k = 1; k <= loops; ++k) {
    complex.cells.push_back({"e" + std::to_string(k), {}, {"v", "v"}, {}});
  }
  const auto loop = [&] { return "e" + std::to_string(random.in(1, loops)); };
  for (int k = random.in(1, 6); k > 0; --k) {
    complex.cells.push_back({"t" + std::to_string(k), {}, {loop(), loop(), loop()}, {}});
  }
  return complex;
}

/// Draws operations one after the other. Each is legal in the state for which it was drawn. `Draws` is a Random, or
/// draws numbers from somewhere else as that does.
template <class Draws>
class DrawnSteps {
 public:
  explicit DrawnSteps(Draws random, StreamShape shape = {}) : random_{std::move(random)}, shape_{shape} {}

  Draws& random() { return random_; }

  ops::Operation next(const ops::Structure& structure) {
    const std::vector<ops::CellId> cells = current_cells(structure);
    if (!cells.empty() && has_more_than_gluings() && random_.one_in(shape_.maps ? 2 : 3)) {
      if (auto op = other_step(structure, cells)) {
        return *std::move(op);
      }
    }
    const bool is_large = cells.size() >= shape_.most_cells;
    if (cells.empty() || (!is_large && !random_.one_in(cells.size() < shape_.most_cells / 2 ? 4 : 2))) {
      return growth(structure, cells);
    }
    ops::Operation gluing = identification(structure, cells);
    if ((shape_.replacements || shape_.maps) && !is_legal(structure, gluing)) {  // it would fold a cell
      return ops::MakeSimplex{fresh_name(), 0, {}};
    }
    return gluing;
  }

  /// Pairs of current cells of equal types, at random.
  ops::Operation identification(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    ops::Identify identify;
    for (int pairs = random_.one_in(3) ? random_.in(2, 3) : 1; pairs > 0; --pairs) {
      const ops::CellId a = pick(cells);
      std::vector<ops::CellId> like_a;
      for (const ops::CellId b : cells) {
        if (structure.cells().type_id(b) == structure.cells().type_id(a) && (b != a || random_.one_in(6))) {
          like_a.push_back(b);
        }
      }
      if (!like_a.empty()) {
        identify.pairs.emplace_back(structure.name(a), structure.name(pick(like_a)));
      }
    }
    return identify;
  }

 private:
  ops::CellId pick(const std::vector<ops::CellId>& cells) {
    return cells[static_cast<std::size_t>(random_.in(0, static_cast<int>(cells.size()) - 1))];
  }

  std::string fresh_name() { return "n" + std::to_string(++names_); }

  ops::Operation growth(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    if (shape_.maps && random_.one_in(3)) {
      return new_map();
    }
    const int kind = random_.in(1, 10);
    if (kind <= 2 && shape_.simploids) {
      const std::vector<ops::CellType> types{{1, 1}, {2, 1}, {1, 2}, {1, 1, 1}, {1}, {}};
      return ops::MakeSimploid{fresh_name(), types[static_cast<std::size_t>(random_.in(0, 5))], {}};
    }
    if (kind == 3) {
      return random_relations(fresh_name(), random_);
    }
    if (kind <= 5) {
      return multiples_of_a_loop(fresh_name(), random_.in(1, 6), random_.one_in(2));
    }
    if (kind <= 7 && shape_.cones) {
      return cone(structure, cells);
    }
    return ops::MakeSimplex{fresh_name(), random_.in(0, 3), {}};
  }

  ops::Operation cone(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    std::vector<std::string> over;
    for (int wanted = cells.empty() ? 0 : random_.in(0, 3); wanted > 0; --wanted) {
      if (const ops::CellId c = pick(cells);
          ops::is_simplex(structure.cells().type(c).type) && structure.dimension(c) <= 2) {
        over.emplace_back(structure.name(c));
      }
    }
    return ops::MakeCone{fresh_name(), over, {}};
  }

  [[nodiscard]] bool has_more_than_gluings() const {
    return shape_.degeneracies || shape_.splits || shape_.products || shape_.pyramids || shape_.removals ||
           shape_.replacements || shape_.maps;
  }

  ops::Operation new_map() {
    if (random_.one_in(4)) {
      return random_boundary_complex(fresh_name(), random_.in(1, 4), random_);
    }
    const std::vector<Polygons> solids{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
    const int kind = random_.in(1, 16);
    if (kind > 14) {
      const ops::Order square = polygon_order(static_cast<ops::OrderCell>(random_.in(2, 5)));
      const int more = random_.in(1, 3);
      return make_order(fresh_name(),
                        more == 1   ? square
                        : more == 2 ? pyramid_over(square)
                                    : product_of(square, edge_order()),
                        random_.one_in(4));
    }
    if (kind > 12) {
      const GMap map = kind == 13 ? ops::polygon(static_cast<Dart>(random_.in(1, 5)))
                                  : solid_of(solids[static_cast<std::size_t>(random_.in(0, 3))]);
      return make_chain(fresh_name(), *ops::chain_of_gmap(map), random_.one_in(4));
    }
    if (kind == 1) {
      const bool is_cone = random_.one_in(2);
      return make_map(fresh_name(), is_cone ? torus_of_a_square().extended() : torus_of_a_square(), random_.one_in(3));
    }
    if (kind == 2) {
      return make_map(fresh_name(), map_of_faces(solids[static_cast<std::size_t>(random_.in(0, 3))]));
    }
    if (kind <= 4) {
      return make_map(fresh_name(), solid_of(solids[static_cast<std::size_t>(random_.in(0, 3))]));
    }
    return ops::MakePolygon{fresh_name(), random_.in(1, 5), false};
  }

  /// Two random darts of maps of one dimension, or one of these comes away; or all that is closed bounds a cell. Of a
  /// chain of maps the cells of two darts become one.
  std::optional<ops::Operation> sewing(const ops::Structure& structure) {
    const ops::DartStore& darts = structure.darts();
    const auto any_map = [&] {
      return darts.map(static_cast<std::uint32_t>(random_.in(0, static_cast<int>(darts.maps()) - 1)));
    };
    const auto any_dart = [&](const ops::DartStore::Made& map) {
      return structure.directory().names()[map.name].text + ":" +
             ops::dart_text(map, static_cast<ops::Dart>(random_.in(0, static_cast<int>(map.count) - 1)));
    };
    if (darts.maps() == 0) {
      return std::nullopt;
    }
    const auto one = any_map();
    if (one.has_levels()) {
      const int level = random_.in(0, one.dimension);
      const auto cell = [&] {
        const auto of_level = static_cast<int>(one.cells->of[static_cast<std::size_t>(level)].size());
        return seen_cell(structure.directory().names()[one.name].text, level,
                         static_cast<ops::Dart>(random_.in(0, of_level - 1)));
      };
      return ops::Identify{{{cell(), cell()}}};
    }
    if (random_.one_in(4)) {
      return ops::Unsew{one.dimension, {any_dart(one)}};
    }
    if (random_.one_in(8)) {
      return ops::Extend{{structure.directory().names()[one.name].text}};
    }
    for (int tries = 0; tries < 12; ++tries) {
      const auto other = any_map();
      if (other.has_levels()) {
        continue;
      }
      ops::Sew op{one.dimension, {{any_dart(one), any_dart(other)}}};
      if (is_legal(structure, op)) {
        return op;
      }
    }
    return std::nullopt;
  }

  static bool is_legal(const ops::Structure& structure, const ops::Operation& op) {
    ops::Planner planner(structure);
    ops::Plan plan;
    return std::visit(
        [&]<class Op>(const Op& construction) {
          if constexpr (requires { planner.plan(construction, plan); }) {
            return planner.plan(construction, plan).has_value();
          } else {
            return false;
          }
        },
        op);
  }

  /// One of the steps that only some streams have, or nothing when the one drawn is not legal.
  std::optional<ops::Operation> other_step(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    std::optional<ops::Operation> op;
    if (shape_.maps && random_.one_in(2)) {
      op = sewing(structure);
      return op && is_legal(structure, *op) ? op : std::nullopt;
    }
    const int kind = random_.in(1, shape_.replacements ? 15 : shape_.removals ? 13 : 10);
    if (kind > 13) {
      op = replacement(structure, cells);
    } else if (kind > 10) {
      op = removal(structure, cells);
    } else if (kind <= 2 && shape_.degeneracies) {
      op = degeneration(structure, cells);
    } else if (kind <= 4 && shape_.degeneracies) {
      op = gluing_to_degenerate(structure, cells);
    } else if (kind <= 6 && shape_.splits) {
      op = splitting(structure, cells);
    } else if (kind == 7 && shape_.splits) {
      op = tearing(structure, cells);
    } else if (kind <= 9 && shape_.products) {
      op = product(structure, cells.size());
    } else if (kind == 10 && shape_.pyramids && cells.size() < shape_.most_cells) {
      op = pyramid(structure, cells);
    }
    return op && is_legal(structure, *op) ? op : std::nullopt;
  }

  std::optional<ops::Operation> degeneration(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    const ops::CellId c = pick(cells);
    const ops::CellType& type = structure.cells().type(c).type;
    if (type.empty() || !ops::is_simploid(type)) {
      return std::nullopt;
    }
    const int component = random_.in(1, static_cast<int>(type.size()));
    const int index = random_.in(0, type[static_cast<std::size_t>(component - 1)] - 1);
    const bool is_short = type.size() == 1 && random_.one_in(2);
    return ops::Degenerate{std::string{structure.name(c)}, is_short ? std::nullopt : std::optional{component}, index};
  }

  std::optional<ops::Operation> gluing_to_degenerate(const ops::Structure& structure,
                                                     const std::vector<ops::CellId>& cells) {
    std::vector<ops::CellId> degenerate;
    structure.cells().for_each_node([&](ops::CellId c) {
      if (structure.find(c) == ops::none && structure.forest().link_of(c) != ops::none &&
          !structure.lazy().is_consumed(c)) {
        degenerate.push_back(c);
      }
    });
    if (degenerate.empty()) {
      return std::nullopt;
    }
    std::sort(degenerate.begin(), degenerate.end(),
              [&](ops::CellId a, ops::CellId b) { return structure.lazy().is_older(a, b); });
    const ops::CellId a = pick(degenerate);
    std::vector<ops::CellId> like_a;
    for (const auto* some : {&cells, &std::as_const(degenerate)}) {
      std::copy_if(some->begin(), some->end(), std::back_inserter(like_a),
                   [&](ops::CellId b) { return structure.cells().type_id(b) == structure.cells().type_id(a); });
    }
    return ops::Identify{
        {{std::string{structure.directory().own_name(a)}, std::string{structure.directory().own_name(pick(like_a))}}}};
  }

  /// A cell of which some incidences go to a copy: those that the face laws tie to one of them.
  std::optional<ops::Operation> splitting(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    const ops::CellId x = pick(cells);
    using Incidence = std::pair<ops::CellId, std::uint32_t>;
    std::vector<Incidence> incidences;
    const auto is_x = [&](const ops::Value& v) { return v.cell == x && !v.is_degenerate(); };
    for (const ops::CellId t : cofaces(structure, x)) {
      for (std::uint32_t k = 0; k < structure.faces().of(t).size(); ++k) {
        if (is_x(structure.values().of(structure.faces().of(t)[k]))) {
          incidences.emplace_back(t, k);
        }
      }
    }
    ops::Deidentify::Split split{std::string{structure.name(x)}, fresh_name(), {}};
    if (!incidences.empty() && !random_.one_in(8)) {
      std::vector<Incidence> moved{
          incidences[static_cast<std::size_t>(random_.in(0, static_cast<int>(incidences.size()) - 1))]};
      for (std::size_t done = 0; done < moved.size(); ++done) {
        for (const Incidence& tied : tied_to(structure, moved[done])) {
          if (std::find(moved.begin(), moved.end(), tied) == moved.end()) {
            moved.push_back(tied);
          }
        }
      }
      for (const auto& [t, k] : moved) {
        split.moves.emplace_back(structure.name(t), k);
      }
    }
    return ops::Deidentify{{std::move(split)}};
  }

  /// The incidences of the same cell that some face law says are the same one seen from above.
  static std::vector<std::pair<ops::CellId, std::uint32_t>> tied_to(
      const ops::Structure& structure, const std::pair<ops::CellId, std::uint32_t>& incidence) {
    std::vector<std::pair<ops::CellId, std::uint32_t>> tied;
    for (const ops::CellId u : cofaces(structure, incidence.first)) {
      for (const ops::FaceLaw& law : structure.cells().type(u).laws) {
        const ops::Value one = structure.values().of(structure.faces().of(u)[law.first]);
        const ops::Value other = structure.values().of(structure.faces().of(u)[law.other_first]);
        const std::pair first{one.cell, law.second};
        const std::pair second{other.cell, law.other_second};
        if (!one.is_degenerate() && !other.is_degenerate() && (first == incidence || second == incidence)) {
          tied.push_back(first == incidence ? second : first);
        }
      }
    }
    return tied;
  }

  /// A cell that is nobody's face comes away from the rest: every cell of its closure gets a copy, and all incidences
  /// within the closure go to these.
  std::optional<ops::Operation> tearing(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    const ops::CellId top = pick(cells);
    std::vector<ops::CellId> closure{top};
    for (std::size_t done = 0; done < closure.size(); ++done) {
      for (const ops::CellId face : structure.faces().of(closure[done])) {
        if (const ops::Value v = structure.values().of(face);
            std::find(closure.begin(), closure.end(), v.cell) == closure.end()) {
          closure.push_back(v.cell);
        }
      }
    }
    ops::Deidentify op;
    std::vector<std::string> names{std::string{structure.name(top)}};
    for (std::size_t k = 1; k < closure.size(); ++k) {
      names.push_back(fresh_name());
      op.splits.push_back({std::string{structure.name(closure[k])}, names.back(), {}});
    }
    for (std::size_t k = 0; k < closure.size(); ++k) {
      for (std::uint32_t slot = 0; slot < structure.faces().of(closure[k]).size(); ++slot) {
        const ops::Value v = structure.values().of(structure.faces().of(closure[k])[slot]);
        const auto at = std::find(closure.begin(), closure.end(), v.cell) - closure.begin();
        if (v.is_degenerate()) {
          return std::nullopt;
        }
        op.splits[static_cast<std::size_t>(at) - 1].moves.emplace_back(names[k], slot);
      }
    }
    return op;
  }

  /// Of an open star, or of cells that are nobody's face, or of some and all their cofaces by name.
  ops::Operation removal(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    ops::Remove op{{}, random_.one_in(3)};
    for (int wanted = random_.one_in(3) ? random_.in(2, 3) : 1; wanted > 0; --wanted) {
      const ops::CellId c = pick(cells);
      op.cells.push_back(structure.name(c));
      if (!op.cofaces) {
        std::vector<ops::CellId> above = cofaces(structure, c);
        for (std::size_t k = 0; k < above.size(); ++k) {
          op.cells.push_back(structure.name(above[k]));
          for (const ops::CellId coface : cofaces(structure, above[k])) {
            if (std::find(above.begin(), above.end(), coface) == above.end()) {
              above.push_back(coface);
            }
          }
        }
      }
    }
    return op;
  }

  /// The flip or the subdivision of a cell that can be replaced so, looked for at random.
  std::optional<ops::Operation> replacement(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    for (int tries = 0; tries < 8; ++tries) {
      const std::string cell = structure.name(pick(cells));
      ops::Operation op = ops::Replace{ops::Replace::Flip{cell, fresh_name(), {}}};
      if (cells.size() < shape_.most_cells && random_.one_in(3)) {
        op = ops::Replace{ops::Replace::Subdivision{cell, fresh_name(), {}}};
      }
      if (is_legal(structure, op)) {
        return op;
      }
    }
    return std::nullopt;
  }

  std::optional<ops::Operation> product(const ops::Structure& structure, std::size_t cells) {
    const auto bodies = structure.bodies().current();
    if (bodies.empty()) {
      return std::nullopt;
    }
    const auto any = [&] {
      return bodies[static_cast<std::size_t>(random_.in(0, static_cast<int>(bodies.size()) - 1))];
    };
    const auto left = any();
    const auto right = any();
    const bool is_simplicial = random_.one_in(2);
    const std::size_t pairs = structure.lazy().cells_of(left).size() * structure.lazy().cells_of(right).size();
    const auto dimensions = structure.bodies().counts(left).size() + structure.bodies().counts(right).size();
    if (pairs * (is_simplicial ? 3 : 1) + cells > 2 * shape_.most_cells || dimensions > 6) {
      return std::nullopt;
    }
    return ops::MakeProduct{fresh_name(), std::string{structure.directory().name_of_body(left)},
                            std::string{structure.directory().name_of_body(right)}, is_simplicial};
  }

  /// The cone, or the suspension over the same cells.
  ops::Operation cone_or_suspension(ops::MakeCone cone) {
    if (random_.one_in(4)) {
      return ops::MakeSuspension{{cone.apex, fresh_name()}, std::move(cone.over), {}};
    }
    return cone;
  }

  std::optional<ops::Operation> pyramid(const ops::Structure& structure, const std::vector<ops::CellId>& cells) {
    ops::MakeCone op{fresh_name(), std::vector<std::string>{}, {}};
    if (random_.one_in(3)) {
      auto& over = std::get<std::vector<std::string>>(op.over);
      for (int wanted = random_.in(1, 3); wanted > 0; --wanted) {
        if (const ops::CellId c = pick(cells); structure.dimension(c) <= 3) {
          over.emplace_back(structure.name(c));
        }
      }
      return cone_or_suspension(std::move(op));
    }
    const auto bodies = structure.bodies().current();
    const auto body = bodies[static_cast<std::size_t>(random_.in(0, static_cast<int>(bodies.size()) - 1))];
    if (structure.bodies().counts(body).size() > 4 ||
        structure.lazy().cells_of(body).size() + cells.size() > 2 * shape_.most_cells) {
      return std::nullopt;
    }
    if (bodies.size() == 1 || random_.one_in(6)) {
      op.over = std::monostate{};
    } else {
      op.over = std::string{structure.directory().name_of_body(body)};
    }
    return cone_or_suspension(std::move(op));
  }

  Draws random_;
  StreamShape shape_;
  int names_ = 0;
};

class RandomSteps : public DrawnSteps<Random> {
 public:
  explicit RandomSteps(unsigned seed, StreamShape shape = {}) : DrawnSteps{Random{seed}, shape} {}
};

}  // namespace sesame::tests
