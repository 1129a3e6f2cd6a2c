// Insertions into abstract simplicial complexes.
#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <compare>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::ops {
namespace {

bool comes_before(std::string_view a, std::string_view b) { return std::is_lt(compare_labels(a, b)); }

/// What there is one of for each vertex of a simplex: of small simplices without an allocation.
template <class T>
using PerVertex = boost::container::small_vector<T, 6>;
/// A simplex: the positions of its vertices among the labels of an insertion, ascending.
using Positions = PerVertex<std::uint32_t>;

template <class T>
PerVertex<T> without(const PerVertex<T>& simplex, std::size_t k) {
  PerVertex<T> face = simplex;
  face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
  return face;
}

std::span<const VertexId> as_span(const PerVertex<VertexId>& vertices) { return {vertices.data(), vertices.size()}; }

/// A label of the simplices to insert, with what it denotes.
struct Label {
  std::string_view text;
  VertexId vertex;  ///< or the number that it will have
};

/// Works out which of some simplices and of their faces are missing, and lays them out.
class InsertPlanner {
 public:
  /// `labels` are those of all simplices, sorted, none twice.
  InsertPlanner(const Structure& structure, std::vector<Label> labels)
      : structure_{structure}, labels_{std::move(labels)} {}

  [[nodiscard]] Positions positions(const std::vector<std::string>& simplex) const {
    Positions positions;
    for (const std::string& label : simplex) {
      const auto at = std::lower_bound(labels_.begin(), labels_.end(), label,
                                       [](const Label& a, std::string_view b) { return comes_before(a.text, b); });
      positions.push_back(static_cast<std::uint32_t>(at - labels_.begin()));
    }
    std::sort(positions.begin(), positions.end());
    return positions;
  }

  /// False when it is there already, or was added before. To be called for all before `add_faces`.
  bool add(const Positions& simplex) {
    if (!is_missing(simplex)) {
      return false;
    }
    missing_.resize(std::max(missing_.size(), simplex.size()));
    const bool is_new = missing_[simplex.size() - 1].emplace(simplex, none).second;
    count_ += is_new ? 1 : 0;
    return is_new;
  }

  /// Adds the faces that are missing. False when there are more than `most` cells then; some are left out in that case.
  /// Goes down by dimension: the faces of a simplex that is there are there.
  bool add_faces(std::int64_t most) {
    for (std::size_t p = missing_.size(); p-- > 1;) {
      for (const auto& [simplex, cell] : missing_[p]) {
        for (std::size_t k = 0; k <= p; ++k) {
          add(without(simplex, k));
        }
        if (count_ > most) {
          return false;
        }
      }
    }
    return count_ <= most;
  }

  [[nodiscard]] bool has_nothing_to_do() const { return count_ == 0; }
  [[nodiscard]] std::string name(const Positions& simplex) const {
    std::string text;
    write_name(simplex, text);
    return text;
  }
  /// The name of a missing cell that is in use; empty when there is none.
  [[nodiscard]] std::string taken_name() const {
    for (const auto& simplices : missing_) {
      for (const auto& [simplex, cell] : simplices) {
        if (std::string own = name(simplex); structure_.is_name_taken(own)) {
          return own;
        }
      }
    }
    return "";
  }

  /// Requires: some cells are missing.
  void write(Plan& plan) {
    AbstractChange& change = plan.abstract.emplace();
    plan.first = structure_.cells().size();
    CellId next = plan.first;
    for (auto& simplices : missing_) {
      for (auto& [simplex, cell] : simplices) {
        cell = next++;
        const PerVertex<VertexId> vertices = vertices_of(simplex);
        const std::size_t first_face = plan.faces.size();
        if (simplex.size() > 1) {
          write_faces(simplex, vertices, plan);
        }
        change.vertices.insert(change.vertices.end(), vertices.begin(), vertices.end());
        write_name(simplex, plan.names);
        add_cell(structure_.types().simplex(static_cast<int>(simplex.size()) - 1), first_face, plan);
      }
    }
    for (const auto& [vertex, cell] : missing_[0]) {
      change.labels.emplace_back(labels_[vertex[0]].text);
    }
    write_bodies(plan);
  }

 private:
  [[nodiscard]] PerVertex<VertexId> vertices_of(const Positions& simplex) const {
    PerVertex<VertexId> vertices;
    for (const std::uint32_t position : simplex) {
      vertices.push_back(labels_[position].vertex);
    }
    return vertices;
  }
  /// {a,b,...}
  void write_name(const Positions& simplex, std::string& out) const {
    char before = '{';
    for (const std::uint32_t position : simplex) {
      out.append(1, std::exchange(before, ',')).append(labels_[position].text);
    }
    out += '}';
  }
  [[nodiscard]] bool is_new(VertexId vertex) const { return vertex >= structure_.abstract().labels(); }
  [[nodiscard]] bool is_missing(const Positions& simplex) const {
    const PerVertex<VertexId> vertices = vertices_of(simplex);
    return std::any_of(vertices.begin(), vertices.end(), [this](VertexId v) { return is_new(v); }) ||
           structure_.abstract().find(as_span(vertices)) == none;
  }

  /// The new cells join the bodies of the vertices that they have and make these one, or make a body.
  void write_bodies(Plan& plan) const {
    std::vector<VertexId> vertices = plan.abstract->vertices;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::set<BodyId> bodies;
    for (const VertexId vertex : vertices) {
      if (!is_new(vertex)) {
        bodies.insert(structure_.body_of(structure_.abstract().find({&vertex, 1})));
      }
    }
    if (bodies.empty()) {
      plan.new_body = name(missing_[0].begin()->first);
    } else {
      join_bodies(bodies, plan);
    }
  }

  void write_faces(const Positions& simplex, const PerVertex<VertexId>& vertices, Plan& plan) const {
    const auto& missing = missing_[simplex.size() - 2];
    for (std::size_t k = 0; k < simplex.size(); ++k) {
      if (const auto face = missing.find(without(simplex, k)); face != missing.end()) {
        add_face({face->second}, plan);
        continue;
      }
      const PerVertex<VertexId> order = without(vertices, k);
      const CellId cell = structure_.abstract().find(as_span(order));
      add_face({cell, structure_.maps().order(places_in(structure_.abstract().vertices(cell), as_span(order)))}, plan);
    }
  }

  const Structure& structure_;
  std::vector<Label> labels_;
  std::vector<std::map<Positions, CellId>> missing_;  ///< by dimension; with the cells that they will be
  std::int64_t count_ = 0;                            ///< of all of them
};

Status check_simplex(const std::vector<std::string>& simplex, const Limits& limits) {
  if (simplex.empty()) {
    return Error{Errc::bad_input,
                 "a simplex has at least one vertex: it should be a list of labels, such as [\"a\",\"b\"]"};
  }
  for (const std::string& label : simplex) {
    if (!is_label(label)) {
      return Error{Errc::bad_input,
                   fmt::format("\"{}\" is not a label: a label is not empty, and has no white space, no control "
                               "characters, and none of {{ }} and comma",
                               label)};
    }
  }
  if (Status s = check_size({std::max(1, static_cast<int>(simplex.size()) - 1)}, limits); !s) {
    return s;
  }
  PerVertex<std::string_view> labels(simplex.begin(), simplex.end());
  std::sort(labels.begin(), labels.end());
  if (const auto twice = std::adjacent_find(labels.begin(), labels.end()); twice != labels.end()) {
    return Error{Errc::bad_input,
                 fmt::format("the label \"{}\" stands twice in the simplex: labels must differ", *twice)};
  }
  return Done{};
}

/// The labels of all simplices, sorted, none twice, as views of the operation. Errors: for a list that is no simplex,
/// and for a label of a vertex that no insertion may touch.
Result<std::vector<Label>> labels_of(const Insert& operation, const Structure& structure, const Limits& limits) {
  std::vector<Label> labels;
  sparse::HashIndex met;  // of them, by text: many simplices have few
  const auto is_new = [&](std::string_view label) {
    const std::uint64_t hash = std::hash<std::string_view>{}(label);
    const bool is_there = met.find(hash, [&](std::uint32_t k) { return labels[k].text == label; }) != none;
    if (!is_there) {
      met.insert(hash, static_cast<std::uint32_t>(labels.size()));
    }
    return !is_there;
  };
  const bool is_one = operation.simplices.size() == 1;  // whose labels differ
  for (const std::vector<std::string>& simplex : operation.simplices) {
    if (Status s = check_simplex(simplex, limits); !s) {
      return s.error();
    }
    for (const std::string& label : simplex) {
      if (is_one || is_new(label)) {
        labels.push_back({label, none});
      }
    }
  }
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return comes_before(a.text, b.text); });
  VertexId next{structure.abstract().labels()};
  for (Label& label : labels) {
    const LabelId known = structure.abstract().label(label.text);
    if (const auto body = known == none ? Result<BodyId>{none} : abstract_body(known, structure); !body) {
      return body.error();
    }
    label.vertex = known == none ? next++ : structure.abstract().vertex(known);
  }
  return labels;
}

}  // namespace

Status plan_insertion(const Insert& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  Result<std::vector<Label>> labels = labels_of(operation, structure, limits);
  if (!labels) {
    return labels.error();
  }
  InsertPlanner planner(structure, std::move(*labels));
  for (const std::vector<std::string>& simplex : operation.simplices) {
    const Positions positions = planner.positions(simplex);
    if (planner.add(positions)) {
      continue;
    }
    if (!operation.exist_ok) {
      return Error{Errc::refused, fmt::format("the simplex {} is there already, which \"exist_ok\":true would allow",
                                              planner.name(positions))};
    }
    ++plan.already;
  }
  if (planner.has_nothing_to_do()) {
    return Done{};
  }
  const std::int64_t room = std::min(limits.cells_per_step, limits.cells - std::int64_t{structure.cells().size()});
  if (!planner.add_faces(room)) {
    return Error{Errc::refused,
                 fmt::format("this step would make more than {} cells, as many as there is room for", room)};
  }
  if (const std::string name = planner.taken_name(); !name.empty()) {
    return Error{Errc::bad_input,
                 fmt::format("the name \"{}\", which a new cell would have, is in use: choose other labels", name)};
  }
  planner.write(plan);
  return Done{};
}

}  // namespace sesame::ops
