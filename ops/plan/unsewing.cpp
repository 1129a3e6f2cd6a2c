// Taking the sewing of maps back: what was glued by it is split.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ops/plan/cone_cells.hpp"
#include "ops/plan/naming_darts.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/unsewn_simplices.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// Works out which orbits fall apart. Of the parts of a cell that which has the dart that the cell is called by keeps
/// it; each other one gets a copy, and the incidences that its darts see go to that.
class UnsewingPlanner {
 public:
  UnsewingPlanner(const Structure& structure, Plan& plan)
      : structure_{structure}, store_{structure.darts()}, naming_{structure}, plan_{plan} {}

  Status run(const Unsew& operation) {
    for (const std::string& name : operation.darts) {
      if (Status s = add_dart(name, operation.dimension); !s) {
        return s;
      }
    }
    if (unsewn_.empty()) {
      return Error{Errc::bad_input, "there is no dart to unsew: list one at least"};
    }
    plan_.first = structure_.cells().size();
    for (int i = 0; i < dimension_; ++i) {
      for (const Dart d : unsewn_) {
        if (Status s = split_cell_of(i, d); !s) {
          return s;
        }
      }
      if (Status s = add_moves(i); !s) {
        return s;
      }
      copies_below_ = std::move(copies_of_darts_);
      copies_of_darts_.clear();
    }
    return add_moves(dimension_);
  }

 private:
  /// A part of a cell that becomes a copy, by its position among the new cells.
  using Copies = std::map<Dart, std::uint32_t>;

  Status add_dart(const std::string& name, int index) {
    const Result<NamedDart> named = dart_named(name, structure_);
    if (!named) {
      return named.error();
    }
    if (!plan_.sewings.empty() && named->dimension != dimension_) {
      return Error{Errc::refused, fmt::format("\"{}\" is a dart of a map of dimension {}, those before it of dimension "
                                              "{}: unsew maps of one dimension in a step",
                                              name, named->dimension, dimension_)};
    }
    dimension_ = named->dimension;
    if (store_.map_of(dimension_, named->dart).is_by_simplices) {
      return Error{Errc::refused, fmt::format("\"{}\" is a dart of a map by simplices, those before it are of maps by "
                                              "cells: unsew them one after the other",
                                              name)};
    }
    if (index != dimension_) {
      return Error{Errc::refused, fmt::format("to unsew \"{}\" in dimension {} would open cells of its map, which has "
                                              "dimension {}: only that is possible",
                                              name, index, dimension_)};
    }
    if (unsewn_.contains(named->dart)) {
      return Done{};  // with an earlier one
    }
    if (alpha(dimension_, named->dart) == named->dart) {
      return Error{Errc::refused, fmt::format("\"{}\" is {}-free: there is nothing to unsew", name, dimension_)};
    }
    std::vector<Dart> orbit{named->dart};
    for (std::size_t at = 0; at < orbit.size(); ++at) {
      const Dart d = orbit[at], other = alpha(dimension_, d);
      unsewn_.insert({d, other});
      plan_.sewings.push_back({dimension_, dimension_, d, other, true});
      for (int j = 0; j + 2 <= dimension_; ++j) {
        if (const Dart next = alpha(j, d); !unsewn_.contains(next)) {
          orbit.push_back(next);
          unsewn_.insert(next);
        }
      }
    }
    return Done{};
  }

  [[nodiscard]] Dart alpha(int i, Dart d) const { return store_.alpha(dimension_, i, d); }
  /// As it will be.
  [[nodiscard]] Dart next(int i, Dart d) const { return i == dimension_ && unsewn_.contains(d) ? d : alpha(i, d); }

  /// The orbit of a dart under all involutions but one, as they are or will be.
  template <class Next>
  [[nodiscard]] std::vector<Dart> orbit(int without, Dart start, Next next) const {
    std::vector<Dart> found{start};
    std::unordered_set<Dart> met{start};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (int j = 0; j <= dimension_; ++j) {
        if (const Dart reached = next(j, found[at]); j != without && met.insert(reached).second) {
          found.push_back(reached);
        }
      }
    }
    return found;
  }

  [[nodiscard]] std::string name(Dart d) const { return name_of_dart(dimension_, d, structure_); }
  [[nodiscard]] Result<Value> seen(int i, Dart d) const { return seen_now(dimension_, i, d, structure_); }

  Status split_cell_of(int i, Dart start) {
    if (copies_of_darts_.contains(start) || kept_.contains({i, start})) {
      return Done{};
    }
    std::vector<Dart> darts = orbit(i, start, [&](int j, Dart d) { return alpha(j, d); });
    std::ranges::sort(darts);
    const Result<Value> whole = seen(i, start);
    if (!whole) {
      return whole.error();
    }
    if (Status s = check_seen(i, *whole, darts); !s) {
      return s;
    }
    if (Status s = check_alone(i, *whole, darts); !s) {
      return s;
    }
    const Dart naming = naming_dart(i, whole->cell, darts);
    std::unordered_set<Dart> done;
    for (const Dart d : darts) {
      if (done.contains(d)) {
        continue;
      }
      const std::vector<Dart> part = orbit(i, d, [&](int j, Dart of) { return next(j, of); });
      done.insert(part.begin(), part.end());
      const bool keeps = std::ranges::find(part, naming) != part.end();
      if (keeps) {
        for (const Dart of : part) {
          kept_.insert({i, of});
        }
      } else if (Status s = add_copy(i, whole->cell, part); !s) {
        return s;
      }
    }
    return Done{};
  }

  /// Do all these darts see the cell, and have what they see above it, and nothing else, as a coface? It may have been
  /// split otherwise, or be degenerate.
  Status check_seen(int i, const Value& whole, const std::vector<Dart>& darts) const {
    std::unordered_set<CellId> cells_above;
    for (const Dart d : darts) {
      const Result<Value> here = seen(i, d);
      const Result<Value> above = here ? seen(i + 1, d) : here;
      if (!above) {
        return above.error();
      }
      cells_above.insert(above->cell);
      bool is_whole = !here->is_degenerate() && here->cell == whole.cell && !above->is_degenerate();
      if (is_whole && !is_cone(structure_.cells().type(above->cell).type)) {
        const Dart place = structure_.maps().dart_of(above->order);
        const CellShape::Place of_face =
            structure_.types().place_in_face(structure_.cells().type_id(above->cell), place);
        const Value face = structure_.values().face_of_cell(above->cell, of_face.face);
        is_whole = !face.is_degenerate() && face.cell == whole.cell;
      }
      if (!is_whole) {
        return Error{Errc::refused, fmt::format("\"{}\" cannot be unsewn: its {}-cell has been split, and not by "
                                                "unsewing, or became degenerate: undo that first",
                                                name(d), i)};
      }
    }
    return check_cofaces(whole.cell, cells_above, "unsewing", structure_);
  }

  /// Are all nodes that the cell stands for cells of these darts, or were they of darts that have been unsewn? Others
  /// have been glued to it in another way.
  Status check_alone(int i, const Value& whole, const std::vector<Dart>& darts) const {
    std::unordered_set<CellId> nodes;
    for (const Dart d : darts) {
      const auto value = seen_from_dart(structure_, store_.map_of(dimension_, d), i, d);
      if (value) {
        nodes.insert(value->cell);
      }
    }
    bool are_all = true;
    structure_.forest().for_each_member(
        whole.cell, [&](CellId node) { are_all = are_all && (nodes.contains(node) || is_left_behind(i, node)); });
    return are_all ? Status{Done{}}
                   : Error{Errc::refused,
                           fmt::format("\"{}\" cannot be unsewn: its {}-cell \"{}\" is glued to other cells, and not "
                                       "only by sewing",
                                       name(darts[0]), i, structure_.name(whole.cell))};
  }

  /// Whether a node was made for a dart that sees another one by now, or is there no more.
  [[nodiscard]] bool is_left_behind(int i, CellId node) const {
    const Dart dart = naming_.of(node, i, dimension_);
    if (dart == no_dart) {
      return false;
    }
    const auto sees = seen_from_dart(structure_, store_.map_of(dimension_, dart), i, dart);
    return (sees && sees->cell != node) || store_.taken_out_with(dimension_, dart);
  }

  /// The dart that the cell is called by, or any of these.
  [[nodiscard]] Dart naming_dart(int i, CellId cell, const std::vector<Dart>& darts) const {
    const Dart naming = naming_.of(structure_.forest().oldest(cell), i, dimension_);
    return std::ranges::binary_search(darts, naming) ? naming : darts[0];
  }
  [[nodiscard]] std::string cell_name(int i, Dart d) const {
    const DartStore::Made& map = store_.map_of(dimension_, d);
    return fmt::format("{}.{}:{}", structure_.directory().names()[map.name].text, i, dart_text(map, d - map.first));
  }

  /// A part of a cell becomes a copy: its faces are those that its darts will see.
  Status add_copy(int i, CellId source, const std::vector<Dart>& part) {
    TypeTable& types = structure_.types();
    const TypeId type = structure_.cells().type_id(source);
    const auto position = static_cast<std::uint32_t>(plan_.cells.size());
    const auto arity = static_cast<std::uint32_t>(types.info(type).faces.size());
    std::vector<Value> faces;
    for (std::uint32_t k = 0; k < arity; ++k) {
      faces.push_back(structure_.values().face_of_cell(source, k));
    }
    Dart named = no_dart;
    for (const Dart d : part) {
      const Result<Value> sees = seen(i, d);
      if (!sees) {
        return sees.error();
      }
      const Dart place = structure_.maps().dart_of(sees->order);
      copies_of_darts_.emplace(d, position);
      plan_.newly_seen.push_back({dimension_, i, d, {plan_.first + position, place}});
      named = place == 0 ? std::min(named, d) : named;
      if (i > 0) {
        const CellShape::Place of_face = types.place_in_face(type, place);
        if (const auto copy = copies_below_.find(d); copy != copies_below_.end()) {
          faces[of_face.face].cell = plan_.first + copy->second;
        }
      }
    }
    const std::size_t first_face = plan_.faces.size();
    for (const Value& face : faces) {
      add_face(face.cell >= plan_.first && !is_asked_for(face.cell) ? Incidence{face.cell, face.order}
                                                                    : structure_.values().incidence_of(face),
               plan_);
    }
    plan_.names += cell_name(i, named);
    plan_.sources.push_back(source);
    add_cell(type, first_face, plan_);
    return Done{};
  }

  /// Incidences of cells that stay, of dimension i, with cells that got copies.
  Status add_moves(int i) {
    TypeTable& types = structure_.types();
    for (const auto& [d, copy] : copies_below_) {
      if (Status s = add_moves_of_cone(i, d, copy); !s) {
        return s;
      }
      if (copies_of_darts_.contains(d)) {
        continue;
      }
      const Result<Value> cell = seen(i, d);
      if (!cell) {
        return cell.error();
      }
      if (is_cone(structure_.cells().type(cell->cell).type)) {
        continue;
      }
      const Dart place = structure_.maps().dart_of(cell->order);
      const CellShape::Place of_face = types.place_in_face(structure_.cells().type_id(cell->cell), place);
      if (Status s = add_move(cell->cell, of_face.face, copy); !s) {
        return s;
      }
    }
    return Done{};
  }

  Status add_move(CellId cell, std::uint32_t face, std::uint32_t copy) {
    if (!moved_.insert({cell, face}).second) {
      return Done{};
    }
    if (face > UINT8_MAX) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" has more than {} faces, so they cannot be unsewn: undo the sewing "
                               "instead",
                               structure_.name(cell), UINT8_MAX + 1)};
    }
    const OrderId order = structure_.values().face_of_cell(cell, face).order;
    plan_.moves.push_back({cell, face, plan_.first + copy, order});
    return Done{};
  }

  /// The same of the generators of the largest cell of a dart, where that is no ball: of those of dimension i, whose
  /// boundary meets the copy where the dart is.
  Status add_moves_of_cone(int i, Dart d, std::uint32_t copy) {
    const Result<Value> cell = seen(dimension_, d);
    if (!cell || !is_cone(structure_.cells().type(cell->cell).type)) {
      return cell ? Status{Done{}} : cell.error();
    }
    const auto [at, is_new] = cones_.try_emplace(cell->cell);
    if (is_new) {
      at->second = {structure_.types().cone_over(boundary_around(d)), cone_parts(structure_, cell->cell)};
      at->second.nodes.push_back(cell->cell);
      sparse::expects(at->second.shape != nullptr && at->second.nodes.size() == at->second.shape->generators.size(),
                      "a cell has all its parts");
    }
    const Dart place = place_in_largest(d);
    for (std::size_t g = 0; g < at->second.nodes.size(); ++g) {
      const ConeShape::Generator& generator = at->second.shape->generators[g];
      for (std::uint32_t k = 0; k < generator.terms.size() && generator.degree == i; ++k) {
        if (generator.terms[k].dart == place) {
          if (Status s = add_move(at->second.nodes[g], k, copy); !s) {
            return s;
          }
        }
      }
    }
    return Done{};
  }

  [[nodiscard]] Dart place_in_largest(Dart d) const {
    return store_.seen(store_.map_of(dimension_, d), dimension_, d).dart;
  }

  /// The canonical boundary of the largest cell of a dart, its darts as the cell has them.
  [[nodiscard]] GMap boundary_around(Dart start) const {
    const std::vector<Dart> darts = orbit(dimension_, start, [&](int j, Dart d) { return alpha(j, d); });
    std::vector<std::vector<Dart>> images(static_cast<std::size_t>(dimension_), std::vector<Dart>(darts.size()));
    for (const Dart d : darts) {
      for (int j = 0; j < dimension_; ++j) {
        images[static_cast<std::size_t>(j)][place_in_largest(d)] = place_in_largest(alpha(j, d));
      }
    }
    Result<GMap> boundary = GMap::make(std::move(images));
    sparse::expects(boundary.has_value(), "the boundary of a cell is a map");
    return std::move(*boundary);
  }

  /// The generators of a cell that is no ball.
  struct Cone {
    const ConeShape* shape = nullptr;
    std::vector<CellId> nodes;
  };

  struct PairHash {
    template <class A, class B>
    std::size_t operator()(const std::pair<A, B>& pair) const {
      return mix(static_cast<std::uint32_t>(pair.first), static_cast<std::uint32_t>(pair.second));
    }
  };

  const Structure& structure_;
  const DartStore& store_;
  NamingDarts naming_;
  Plan& plan_;
  int dimension_ = 0;
  std::set<Dart> unsewn_;
  Copies copies_below_, copies_of_darts_;                    // of the dimension below, and of this one
  std::unordered_set<std::pair<int, Dart>, PairHash> kept_;  // darts whose cell in a dimension stays
  std::unordered_set<std::pair<CellId, std::uint32_t>, PairHash> moved_;
  std::map<CellId, Cone> cones_;
};

}  // namespace

Status plan_unsewing(const Unsew& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (unsews_simplices(operation, structure)) {
    return plan_unsewn_simplices(operation, structure, limits, plan);
  }
  if (Status s = UnsewingPlanner(structure, plan).run(operation); !s) {
    return s;
  }
  return check_room(static_cast<std::int64_t>(plan.cells.size()), structure, limits);
}

}  // namespace sesame::ops
