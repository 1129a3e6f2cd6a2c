// Insertions into abstract simplicial complexes, and collapses of their vertices.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <set>

#include "ops/planner.hpp"

namespace sesame::ops {
namespace {

Error bad_input(std::string what) { return {Errc::bad_input, std::move(what)}; }

/// A face of the simplex to be inserted: the positions of its vertices among all, as bits.
using Subset = std::uint64_t;

/// By dimension, then lexicographically in the positions.
bool comes_before(Subset a, Subset b) {
  if (std::popcount(a) != std::popcount(b)) {
    return std::popcount(a) < std::popcount(b);
  }
  const Subset differ = a ^ b;
  return differ != 0 && (a & differ & (~differ + 1)) != 0;
}

template <class T>
std::vector<T> chosen(const std::vector<T>& all, Subset subset) {
  std::vector<T> some;
  for (; subset != 0; subset &= subset - 1) {
    some.push_back(all[static_cast<std::size_t>(std::countr_zero(subset))]);
  }
  return some;
}

/// Works out which faces of a simplex are missing, and lays them out.
class InsertPlanner {
 public:
  /// The labels are sorted. Vertices are those that they denote, or numbers to come.
  InsertPlanner(const Structure& structure, std::vector<std::string> labels, std::vector<VertexId> vertices)
      : structure_{structure}, labels_{std::move(labels)}, vertices_{std::move(vertices)} {
    find_missing();
  }

  [[nodiscard]] const std::vector<Subset>& missing() const { return missing_; }
  [[nodiscard]] Subset whole() const { return (Subset{1} << vertices_.size()) - 1; }
  [[nodiscard]] std::string name(Subset subset) const {
    return fmt::format("{{{}}}", fmt::join(chosen(labels_, subset), ","));
  }

  void write(Plan& plan) {
    AbstractChange& change = plan.abstract.emplace();
    plan.first = structure_.created();
    for (const Subset subset : missing_) {
      const std::vector<VertexId> vertices = chosen(vertices_, subset);
      if (std::popcount(subset) > 1) {
        add_faces(subset, vertices, plan);
      }
      change.vertices.insert(change.vertices.end(), vertices.begin(), vertices.end());
      plan.names += name(subset);
      const auto arity = std::popcount(subset) > 1 ? vertices.size() : 0;
      plan.cells.push_back({structure_.types().simplex(static_cast<int>(vertices.size()) - 1),
                            static_cast<std::uint32_t>(plan.faces.size() - arity), plan.names.size()});
    }
    for (std::size_t k = 0; k < labels_.size(); ++k) {
      if (is_new(Subset{1} << k)) {
        change.labels.push_back(labels_[k]);
      }
    }
  }

 private:
  [[nodiscard]] CellId find(Subset subset) const { return structure_.abstract().find(chosen(vertices_, subset)); }
  [[nodiscard]] bool is_new(Subset subset) const { return (subset & new_vertices_) != 0; }

  /// Goes down from the whole: the faces of a simplex that is there are there.
  void find_missing() {
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      new_vertices_ |= vertices_[k] >= structure_.abstract().labels() ? Subset{1} << k : 0;
    }
    std::set<Subset> seen;
    const auto look_at = [&](Subset subset) {
      if (subset != 0 && seen.insert(subset).second && (is_new(subset) || find(subset) == none)) {
        missing_.push_back(subset);
      }
    };
    look_at(whole());
    for (std::size_t k = 0; k < missing_.size(); ++k) {
      const Subset simplex = missing_[k];
      for (Subset rest = simplex; rest != 0; rest &= rest - 1) {
        look_at(simplex & ~(rest & (~rest + 1)));
      }
    }
    std::sort(missing_.begin(), missing_.end(), comes_before);
  }

  void add_faces(Subset subset, const std::vector<VertexId>& vertices, Plan& plan) const {
    std::size_t k = 0;
    for (Subset rest = subset; rest != 0; rest &= rest - 1, ++k) {
      const Subset face = subset & ~(rest & (~rest + 1));
      const auto at = std::lower_bound(missing_.begin(), missing_.end(), face, comes_before);
      if (at != missing_.end() && *at == face) {
        plan.faces.push_back(plan.first + static_cast<CellId>(at - missing_.begin()));
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
  std::vector<VertexId> vertices_;
  Subset new_vertices_ = 0;
  std::vector<Subset> missing_;
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
                 fmt::format("there is no vertex \"{}\": {} makes one", text, to_text(Insert{{text}}))};
  }
  return label;
}

Status Planner::plan(const Insert& operation, Plan& plan) {
  plan.clear();
  std::vector<std::string> labels = operation.simplex;
  if (labels.empty()) {
    return bad_input(
        "a simplex has at least one vertex: \"simplex\" should be a list of labels, such as [\"a\",\"b\"]");
  }
  for (const std::string& label : labels) {
    if (!is_label(label)) {
      return bad_input(
          fmt::format("\"{}\" is not a label: a label is not empty, and has no white space, no control "
                      "characters, and none of {{ }} and comma",
                      label));
    }
  }
  const CellType type{std::max(1, static_cast<int>(labels.size()) - 1)};
  if (Status s = check_size(type); !s) {
    return s;
  }
  std::sort(labels.begin(), labels.end(), [](const auto& a, const auto& b) { return compare_labels(a, b) < 0; });
  if (const auto twice = std::adjacent_find(labels.begin(), labels.end()); twice != labels.end()) {
    return bad_input(fmt::format("the label \"{}\" stands twice in the simplex: labels must differ", *twice));
  }
  const AbstractComplex& complex = structure_.abstract();
  std::vector<VertexId> vertices;
  std::set<BodyId> bodies;
  for (VertexId next = complex.labels(); const std::string& label : labels) {
    const LabelId known = complex.label(label);
    vertices.push_back(known == none ? next++ : complex.vertex(known));
    if (known != none) {
      const Result<BodyId> body = abstract_body(known);
      if (!body) {
        return body.error();
      }
      bodies.insert(*body);
    }
  }
  return plan_insert(std::move(labels), std::move(vertices), bodies, plan);
}

Status Planner::plan_insert(std::vector<std::string> labels, std::vector<VertexId> vertices,
                            const std::set<BodyId>& bodies, Plan& plan) {
  InsertPlanner simplex(structure_, std::move(labels), std::move(vertices));
  if (simplex.missing().empty()) {
    return Error{Errc::refused, fmt::format("the simplex {} is there already", simplex.name(simplex.whole()))};
  }
  if (Status s = check_room(static_cast<std::int64_t>(simplex.missing().size())); !s) {
    return s;
  }
  for (const Subset subset : simplex.missing()) {
    if (const std::string name = simplex.name(subset); structure_.is_name_taken(name)) {
      return bad_input(
          fmt::format("the name \"{}\", which a new cell would have, is in use: choose other labels", name));
    }
  }
  simplex.write(plan);
  if (bodies.empty()) {
    plan.new_body = simplex.name(1);
  } else {
    plan.into_body = *bodies.begin();
    plan.joined_bodies.assign(std::next(bodies.begin()), bodies.end());
  }
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
