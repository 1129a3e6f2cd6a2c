// Replacements of cells by others that fill the same place: bistellar flips, stellar subdivisions; and contractions.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ops/cells/cell_order.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/star_of_simplex.hpp"
#include "ops/plan/step_names.hpp"
#include "ops/plan/taken_cells.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

using sparse::quoted;

/// A simplex of the object, by name. Errors: unknown_name; refused.
Result<CellId> resolve_simplex(const std::string& name, const Structure& structure) {
  const Result<Value> named = resolve_cell(name, structure);
  if (!named) {
    return named.error();
  }
  if (named->is_degenerate()) {
    return Error{Errc::refused, fmt::format("{} is degenerate, over \"{}\": only a cell of its own can be replaced",
                                            quoted(name), structure.name(named->cell))};
  }
  return named->cell;
}

Result<std::vector<CellId>> star_of(CellId cell, const Structure& structure, const Limits& limits) {
  auto star = open_star(structure, {cell}, static_cast<std::size_t>(limits.cells_per_step));
  if (!star) {
    return Error{Errc::refused, fmt::format("the star of \"{}\" has more than {} cells, the limit for one step",
                                            structure.name(cell), limits.cells_per_step)};
  }
  sort_by_dimension_and_age(structure, *star);
  return *std::move(star);
}

Error no_sphere(const std::string& name, std::size_t cells, std::size_t vertices) {
  return Error{Errc::refused,
               fmt::format("{} can't be flipped: its link should be the boundary of a simplex, but it has {} cells "
                           "with {} vertices",
                           quoted(name), cells - 1, vertices)};
}

Error needs_name(const std::string& name) {
  return Error{Errc::bad_input,
               fmt::format("the flip of {} makes a new cell that needs a name: say \"by\":\"...\"", quoted(name))};
}

// ------------------------------------------------------------------------------------- abstract simplicial complexes

bool is_abstract(CellId cell, const Structure& structure) {
  return structure.bodies().kind(structure.body_of(cell)).is_abstract;
}

using Vertices = std::vector<VertexId>;

Vertices vertices_of(CellId cell, const AbstractComplex& complex) {
  const auto own = complex.vertices(cell);
  return {own.begin(), own.end()};
}

Vertices without(Vertices vertices, std::span<const VertexId> others) {
  std::erase_if(vertices, [&](VertexId v) { return std::ranges::find(others, v) != others.end(); });
  return vertices;
}

std::vector<std::string> labels_of(std::span<const VertexId> vertices, const AbstractComplex& complex) {
  std::vector<std::string> labels;
  for (const VertexId v : vertices) {
    labels.emplace_back(complex.text(complex.label_of(v)));
  }
  return labels;
}

std::string name_of(std::span<const VertexId> vertices, const AbstractComplex& complex) {
  return fmt::format("{{{}}}", fmt::join(labels_of(vertices, complex), ","));
}

/// The new simplices of an abstract complex: those that an insertion of joins makes.
class AbstractReplacement {
 public:
  /// `star`: the open star of the simplex that is replaced.
  AbstractReplacement(CellId simplex, std::span<const CellId> star, bool fills, const Structure& structure,
                      const Limits& limits, Plan& plan)
      : star_{star},
        fills_{fills},
        structure_{structure},
        complex_{structure.abstract()},
        limits_{limits},
        plan_{plan},
        own_{vertices_of(simplex, complex_)} {}

  Status flip(const Replace::Flip& flip) {
    const Vertices link = vertices_around();
    if (link.empty()) {
      return flip.by.empty() ? needs_name(flip.cell) : subdivide(flip.by);
    }
    if (!flip.by.empty() || flip.at) {
      return Error{Errc::bad_input, fmt::format("the flip of {} makes no new vertex, and simplices are named after "
                                                "their labels: leave \"by\" and \"at\" out",
                                                quoted(flip.cell))};
    }
    const bool has_all_proper_faces = link.size() < 32 && star_.size() == (std::size_t{1} << link.size()) - 1;
    const bool has_itself =
        std::ranges::any_of(star_, [&](CellId c) { return complex_.vertices(c).size() == own_.size() + link.size(); });
    if (link.size() == 1 || !has_all_proper_faces || has_itself) {
      return no_sphere(flip.cell, star_.size(), link.size());
    }
    if (const CellId there = complex_.find(link); there != none) {
      return Error{Errc::refused,
                   fmt::format("{} can't be flipped: \"{}\", which would take its place, is there already",
                               quoted(flip.cell), structure_.name(there))};
    }
    const CellId simplex = star_.front();
    return insert_joins(labels_of(link, complex_), {&simplex, 1});
  }

  /// Errors: bad_input when the label is one of a vertex that is there.
  Status subdivide(const std::string& label) {
    if (const LabelId known = complex_.label(label); known != none) {
      const VertexId vertex = complex_.vertex(known);
      if (complex_.find({&vertex, 1}) != none) {
        return Error{Errc::bad_input,
                     fmt::format("there is a vertex {} already: the new one needs another label", quoted(label))};
      }
    }
    return insert_joins({label}, star_);
  }

 private:
  /// Those of the link.
  [[nodiscard]] Vertices vertices_around() const {
    Vertices link;
    for (const CellId coface : star_) {
      if (const Vertices rest = without(vertices_of(coface, complex_), own_); rest.size() == 1) {
        link.push_back(rest.front());
      }
    }
    return link;
  }

  /// The joins of a simplex, some labels, with the faces of some cells opposite to one vertex of the simplex that is
  /// replaced; or with these cells.
  Status insert_joins(const std::vector<std::string>& simplex, std::span<const CellId> cells) {
    Insert insert;
    insert.exist_ok = true;
    const auto add = [&](const Vertices& face) {
      std::vector<std::string> labels = labels_of(face, complex_);
      labels.insert(labels.end(), simplex.begin(), simplex.end());
      insert.simplices.push_back(labels);
    };
    for (const CellId cell : cells) {
      const Vertices vertices = vertices_of(cell, complex_);
      if (fills_) {
        add(vertices);
        continue;
      }
      for (const VertexId left_out : own_) {
        add(without(vertices, {&left_out, 1}));
      }
    }
    return plan_insertion(insert, structure_, limits_, plan_);
  }

  std::span<const CellId> star_;
  bool fills_;
  const Structure& structure_;
  const AbstractComplex& complex_;
  const Limits& limits_;
  Plan& plan_;
  Vertices own_;  ///< of the simplex that is replaced
};

// ------------------------------------------------------------------------------------------------------ contractions

/// The simplex that breaks the link condition lk(u) n lk(v) = lk(uv): its vertices, or nothing.
std::optional<Vertices> outside_of_link(VertexId u, VertexId v, const AbstractComplex& complex) {
  if (complex.star_size(u) > complex.star_size(v)) {
    std::swap(u, v);
  }
  for (const CellId cell : complex.star(u)) {
    Vertices vertices = vertices_of(cell, complex);
    if (vertices.size() == 1 || std::ranges::find(vertices, v) != vertices.end()) {
      continue;
    }
    const Vertices rest = without(vertices, {&u, 1});
    Vertices other = rest;
    other.push_back(v);
    vertices.push_back(v);
    if (complex.find(other) != none && complex.find(vertices) == none) {
      return rest;
    }
  }
  return std::nullopt;
}

Status check_contraction(const Replace::Contraction& contraction, const Structure& structure) {
  const AbstractComplex& complex = structure.abstract();
  const LabelId from = complex.label(contraction.from), to = complex.label(contraction.to);
  const Vertices ends{complex.vertex(from), complex.vertex(to)};
  if (complex.find(ends) == none) {
    return Error{Errc::refused,
                 fmt::format("there is no edge between {} and {}: only an edge is contracted; \"collapse\" takes any "
                             "vertex to any other",
                             quoted(contraction.from), quoted(contraction.to))};
  }
  if (!contraction.link_condition) {
    return Done{};
  }
  if (const auto outside = outside_of_link(ends[0], ends[1], complex)) {
    return Error{
        Errc::refused,
        fmt::format("the link condition does not hold: \"{}\" is in the links of {} and of {}, but not in that "
                    "of their edge, so the contraction could change the homology; say "
                    "\"link_condition\":false to contract it all the same",
                    name_of(*outside, complex), quoted(contraction.from), quoted(contraction.to))};
  }
  return Done{};
}

// ---------------------------------------------------------------------------------------------------------- dispatch

class ReplacementPlanner {
 public:
  ReplacementPlanner(const Replace& operation, const Structure& structure, const Limits& limits, Plan& plan)
      : operation_{operation}, structure_{structure}, limits_{limits}, plan_{plan} {}

  Status operator()(const Replace::Flip& flip) {
    return replace(flip.cell, [&](CellId cell, std::span<const CellId> star) {
      return is_abstract(cell, structure_) ? abstract(cell, star).flip(flip) : plan_flip(flip, cell, star);
    });
  }
  Status operator()(const Replace::Subdivision& subdivision) {
    return replace(subdivision.cell, [&](CellId cell, std::span<const CellId> star) -> Status {
      if (structure_.dimension(cell) == 0) {
        return Error{Errc::refused, fmt::format("{} is a vertex: what is subdivided has a dimension of 1 at least",
                                                quoted(subdivision.cell))};
      }
      if (is_abstract(cell, structure_)) {
        return abstract(cell, star).subdivide(subdivision.by);
      }
      const Result<StarOfSimplex> cells = StarOfSimplex::of(cell, star, structure_, limits_);
      return cells ? cells->write_subdivision(subdivision.by, operation_.fills, limits_, plan_) : cells.error();
    });
  }
  Status operator()(const Replace::Contraction& contraction) {
    if (Status s = plan_collapse({contraction.from, contraction.to}, structure_, plan_); !s) {
      return s;
    }
    return check_contraction(contraction, structure_);
  }

 private:
  /// The new cells by `plan_new(cell, star)`, then those that go.
  template <class PlanNew>
  Status replace(const std::string& name, PlanNew plan_new) {
    const Result<CellId> cell = resolve_simplex(name, structure_);
    if (!cell) {
      return cell.error();
    }
    Result<std::vector<CellId>> star = star_of(*cell, structure_, limits_);
    if (!star) {
      return star.error();
    }
    if (Status s = plan_new(*cell, std::span<const CellId>{*star}); !s) {
      return s;
    }
    if (!operation_.fills) {
      add_deletions(*std::move(star), structure_, plan_);
    }
    return Done{};
  }

  [[nodiscard]] AbstractReplacement abstract(CellId cell, std::span<const CellId> star) const {
    return {cell, star, operation_.fills, structure_, limits_, plan_};
  }
  Status plan_flip(const Replace::Flip& flip, CellId cell, std::span<const CellId> star) {
    const Result<StarOfSimplex> cells = StarOfSimplex::of(cell, star, structure_, limits_);
    if (!cells) {
      return cells.error();
    }
    if (!cells->can_be_flipped()) {
      return no_sphere(flip.cell, star.size(), cells->vertices_around());
    }
    if (flip.at && cells->vertices_around() > 0) {
      return Error{Errc::bad_input,
                   fmt::format("the flip of {} makes no new vertex: leave \"at\" out", quoted(flip.cell))};
    }
    return flip.by.empty() ? needs_name(flip.cell) : cells->write_flip(flip.by, operation_.fills, limits_, plan_);
  }

  const Replace& operation_;
  const Structure& structure_;
  const Limits& limits_;
  Plan& plan_;
};

}  // namespace

Status plan_replacement(const Replace& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return std::visit(ReplacementPlanner(operation, structure, limits, plan), operation.move);
}

}  // namespace sesame::ops
