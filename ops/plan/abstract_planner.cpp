// Insertions into abstract simplicial complexes, and collapses of their vertices.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "ops/plan/planner.hpp"

namespace sesame::ops {
namespace {

Error bad_input(std::string what) { return {Errc::bad_input, std::move(what)}; }

bool comes_before(const std::string& a, const std::string& b) { return compare_labels(a, b) < 0; }

/// A simplex: the positions of its vertices among the labels of an insertion, ascending.
using Positions = std::vector<std::uint32_t>;

Positions without(const Positions& simplex, std::size_t k) {
  Positions face = simplex;
  face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
  return face;
}

template <class T>
std::vector<T> chosen(const std::vector<T>& all, const Positions& positions) {
  std::vector<T> some;
  some.reserve(positions.size());
  for (const std::uint32_t position : positions) {
    some.push_back(all[position]);
  }
  return some;
}

/// Works out which of some simplices and of their faces are missing, and lays them out.
class InsertPlanner {
 public:
  /// `labels` are those of all simplices, sorted, none twice.
  InsertPlanner(const Structure& structure, std::vector<std::string> labels)
      : structure_{structure}, labels_{std::move(labels)} {
    vertices_.reserve(labels_.size());
    for (VertexId next = structure_.abstract().labels(); const std::string& label : labels_) {
      const LabelId known = structure_.abstract().label(label);
      vertices_.push_back(known == none ? next++ : structure_.abstract().vertex(known));
    }
  }

  [[nodiscard]] Positions positions(const std::vector<std::string>& simplex) const {
    Positions positions;
    for (const std::string& label : simplex) {
      const auto at = std::lower_bound(labels_.begin(), labels_.end(), label, comes_before);
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
    return fmt::format("{{{}}}", fmt::join(chosen(labels_, simplex), ","));
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
    plan.first = structure_.created();
    CellId next = plan.first;
    for (auto& simplices : missing_) {
      for (auto& [simplex, cell] : simplices) {
        cell = next++;
        const std::vector<VertexId> vertices = chosen(vertices_, simplex);
        const auto first_face = static_cast<std::uint32_t>(plan.faces.size());
        if (simplex.size() > 1) {
          write_faces(simplex, vertices, plan);
        }
        change.vertices.insert(change.vertices.end(), vertices.begin(), vertices.end());
        plan.names += name(simplex);
        plan.cells.push_back(
            {structure_.types().simplex(static_cast<int>(simplex.size()) - 1), first_face, plan.names.size()});
      }
    }
    for (const auto& [vertex, cell] : missing_[0]) {
      change.labels.push_back(labels_[vertex[0]]);
    }
    write_bodies(plan);
  }

 private:
  [[nodiscard]] bool is_new(VertexId vertex) const { return vertex >= structure_.abstract().labels(); }
  [[nodiscard]] bool is_missing(const Positions& simplex) const {
    const std::vector<VertexId> vertices = chosen(vertices_, simplex);
    return std::any_of(vertices.begin(), vertices.end(), [this](VertexId v) { return is_new(v); }) ||
           structure_.abstract().find(vertices) == none;
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
      plan.into_body = *bodies.begin();
      plan.joined_bodies.assign(std::next(bodies.begin()), bodies.end());
    }
  }

  void write_faces(const Positions& simplex, const std::vector<VertexId>& vertices, Plan& plan) const {
    const auto& missing = missing_[simplex.size() - 2];
    for (std::size_t k = 0; k < simplex.size(); ++k) {
      if (const auto face = missing.find(without(simplex, k)); face != missing.end()) {
        plan.faces.push_back(face->second);
        continue;
      }
      std::vector<VertexId> order = vertices;
      order.erase(order.begin() + static_cast<std::ptrdiff_t>(k));
      const CellId cell = structure_.abstract().find(order);
      if (const OrderId of_cell = structure_.maps().order(places_in(structure_.abstract().vertices(cell), order));
          of_cell != same_order) {
        plan.face_orders.emplace_back(static_cast<std::uint32_t>(plan.faces.size()), of_cell);
      }
      plan.faces.push_back(cell);
    }
  }

  const Structure& structure_;
  std::vector<std::string> labels_;
  std::vector<VertexId> vertices_;                    ///< that the labels denote, or numbers to come
  std::vector<std::map<Positions, CellId>> missing_;  ///< by dimension; with the cells that they will be
  std::int64_t count_ = 0;                            ///< of all of them
};

/// Works out what becomes of the star of the vertex that goes.
class CollapsePlanner {
 public:
  CollapsePlanner(const Structure& structure, AbstractChange& change, std::vector<Merge>& merges)
      : structure_{structure}, complex_{structure.abstract()}, change_{change}, merges_{merges} {}

  void run() {
    std::vector<CellId> star = complex_.star(change_.collapse->gone);
    std::sort(star.begin(), star.end(), [this](CellId a, CellId b) {
      const int p = structure_.dimension(a);
      const int q = structure_.dimension(b);
      return p != q ? p < q : a < b;
    });
    for (const CellId cell : star) {
      const auto own = complex_.vertices(cell);
      const std::vector<VertexId> vertices(own.begin(), own.end());
      if (std::find(vertices.begin(), vertices.end(), change_.collapse->kept) != vertices.end()) {
        squash(cell, vertices);
      } else {
        send(cell, vertices);
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t place(const std::vector<VertexId>& vertices, VertexId v) {
    return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
  }

  /// Onto the face without the vertex that goes, which itself goes where the other one is.
  void squash(CellId cell, const std::vector<VertexId>& vertices) {
    const std::size_t gone = place(vertices, change_.collapse->gone);
    VertexMap map;  // onto the vertices of the face
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::size_t at = k == gone ? place(vertices, change_.collapse->kept) : k;
      map.push_back(static_cast<std::uint8_t>(at - (at > gone ? 1 : 0)));
    }
    VertexMaps& maps = structure_.maps();
    const Value squashed = maps.value_of(none, structure_.type_id(cell), map);
    const Value face = structure_.face_of_cell(cell, static_cast<std::uint32_t>(gone));
    merges_.push_back({cell, none, maps.compose(squashed, face)});
  }

  void send(CellId cell, std::vector<VertexId> vertices) {
    std::replace(vertices.begin(), vertices.end(), change_.collapse->gone, change_.collapse->kept);
    const CellId other = complex_.find(vertices);
    if (other == none) {
      change_.renamed.push_back(cell);
      return;
    }
    VertexMaps& maps = structure_.maps();
    const OrderId order = maps.order(places_in(complex_.vertices(other), vertices));
    // The cell that stands for the most stays, as ever: so paths of the union-find forest are short.
    const std::uint32_t m = structure_.members(cell);
    const std::uint32_t n = structure_.members(other);
    if (m != n ? m < n : structure_.is_older(structure_.oldest(other), structure_.oldest(cell))) {
      merges_.push_back({cell, other, {}, order});
    } else {
      merges_.push_back({other, cell, {}, maps.inverse(order)});
      change_.renamed.push_back(cell);
    }
  }

  const Structure& structure_;
  const AbstractComplex& complex_;
  AbstractChange& change_;
  std::vector<Merge>& merges_;
};

}  // namespace

/// The body that a vertex belongs to, when it may be changed.
Result<BodyId> Planner::abstract_body(LabelId label) const {
  const AbstractComplex& complex = structure_.abstract();
  const VertexId vertex = complex.vertex(label);
  if (complex.is_collapsed(label)) {
    return Error{Errc::refused, fmt::format("\"{}\" was collapsed into another vertex: write \"{}\"",
                                            complex.text(label), complex.text(complex.label_of(vertex)))};
  }
  const BodyId body = structure_.body_of(complex.find({&vertex, 1}));
  if (!structure_.kind_of(body).is_abstract) {
    return Error{Errc::refused,
                 fmt::format("the body \"{}\" of the vertex \"{}\" was changed by another operation: insert and "
                             "collapse work on bodies that only they have made; undo that, or use new labels",
                             structure_.body_name(body), complex.text(label))};
  }
  return body;
}

Result<LabelId> Planner::resolve_label(const std::string& text) const {
  const LabelId label = structure_.abstract().label(text);
  if (label == none) {
    return Error{Errc::unknown_name,
                 fmt::format("there is no vertex \"{}\": {} makes one", text, to_text(Insert{{{text}}, false}))};
  }
  return label;
}

Status Planner::check_simplex(std::vector<std::string> simplex) const {
  if (simplex.empty()) {
    return bad_input("a simplex has at least one vertex: it should be a list of labels, such as [\"a\",\"b\"]");
  }
  for (const std::string& label : simplex) {
    if (!is_label(label)) {
      return bad_input(
          fmt::format("\"{}\" is not a label: a label is not empty, and has no white space, no control "
                      "characters, and none of {{ }} and comma",
                      label));
    }
  }
  if (Status s = check_size({std::max(1, static_cast<int>(simplex.size()) - 1)}); !s) {
    return s;
  }
  std::sort(simplex.begin(), simplex.end());
  if (const auto twice = std::adjacent_find(simplex.begin(), simplex.end()); twice != simplex.end()) {
    return bad_input(fmt::format("the label \"{}\" stands twice in the simplex: labels must differ", *twice));
  }
  return Done{};
}

Status Planner::plan(const Insert& operation, Plan& plan) {
  plan.clear();
  std::vector<std::string> labels;
  for (const std::vector<std::string>& simplex : operation.simplices) {
    if (Status s = check_simplex(simplex); !s) {
      return s;
    }
    labels.insert(labels.end(), simplex.begin(), simplex.end());
  }
  std::sort(labels.begin(), labels.end(), comes_before);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  for (const std::string& label : labels) {
    const LabelId known = structure_.abstract().label(label);
    if (const auto body = known == none ? Result<BodyId>{none} : abstract_body(known); !body) {
      return body.error();
    }
  }
  InsertPlanner planner(structure_, std::move(labels));
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
  const std::int64_t room = std::min(limits_.cells_per_step, limits_.cells - std::int64_t{structure_.created()});
  if (!planner.add_faces(room)) {
    return Error{Errc::refused,
                 fmt::format("this step would make more than {} cells, as many as there is room for", room)};
  }
  if (const std::string name = planner.taken_name(); !name.empty()) {
    return bad_input(fmt::format("the name \"{}\", which a new cell would have, is in use: choose other labels", name));
  }
  planner.write(plan);
  return Done{};
}

Status Planner::plan(const Collapse& operation, Plan& plan) {
  plan.clear();
  const Result<LabelId> from = resolve_label(operation.from);
  const Result<LabelId> to = resolve_label(operation.to);
  if (!from || !to) {
    return from ? to.error() : from.error();
  }
  for (const LabelId label : {*from, *to}) {
    if (const Result<BodyId> body = abstract_body(label); !body) {
      return body.error();
    }
  }
  if (*from == *to) {
    return bad_input(fmt::format("the vertex \"{}\" cannot be collapsed into itself", operation.from));
  }
  const AbstractComplex& complex = structure_.abstract();
  AbstractChange& change = plan.abstract.emplace();
  VertexId gone = complex.vertex(*from);
  VertexId kept = complex.vertex(*to);
  if (complex.star_size(gone) > complex.star_size(kept)) {
    std::swap(gone, kept);
  }
  change.collapse = AbstractChange::Collapse{*from, *to, gone, kept};
  CollapsePlanner(structure_, change, plan.merges).run();
  return Done{};
}

}  // namespace sesame::ops
