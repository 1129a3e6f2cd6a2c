// Collapses of vertices of abstract simplicial complexes.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

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
      const auto [fate, gone_at, survivor] = complex_.fate_of(cell, change_.collapse->gone, change_.collapse->kept);
      switch (fate) {
        case SimplexIndex::Fate::renamed:
          change_.renamed.push_back(cell);
          break;
        case SimplexIndex::Fate::merged:
          merge(cell, gone_at, survivor);
          break;
        case SimplexIndex::Fate::squashed:
          squash(cell, gone_at);
          break;
      }
    }
  }

 private:
  /// Onto the face without the vertex that goes, which itself goes where the other one is.
  void squash(CellId cell, std::size_t gone) {
    const auto vertices = complex_.vertices(cell);
    const auto kept = static_cast<std::size_t>(std::ranges::find(vertices, change_.collapse->kept) - vertices.begin());
    VertexMap map;  // onto the vertices of the face
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::size_t at = k == gone ? kept : k;
      map.push_back(static_cast<std::uint8_t>(at - (at > gone ? 1 : 0)));
    }
    VertexMaps& maps = structure_.maps();
    const Value squashed = maps.value_of(none, structure_.cells().type_id(cell), map);
    const Value face = structure_.values().face_of_cell(cell, static_cast<std::uint32_t>(gone));
    merges_.push_back({cell, none, maps.compose(squashed, face)});
  }

  void merge(CellId cell, std::size_t gone, CellId other) {
    const auto own = complex_.vertices(cell);
    std::vector<VertexId> vertices(own.begin(), own.end());
    vertices[gone] = change_.collapse->kept;
    VertexMaps& maps = structure_.maps();
    const OrderId order = maps.order(places_in(complex_.vertices(other), vertices));
    // The cell that stands for the most stays, as ever: so paths of the union-find forest are short.
    const std::uint32_t m = structure_.forest().members(cell);
    const std::uint32_t n = structure_.forest().members(other);
    if (m != n ? m < n
               : structure_.lazy().is_older(structure_.forest().oldest(other), structure_.forest().oldest(cell))) {
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

Result<LabelId> resolve_label(const std::string& text, const Structure& structure) {
  const LabelId label = structure.abstract().label(text);
  if (label == none) {
    return Error{Errc::unknown_name, fmt::format("there is no vertex {}: {} makes one", sparse::quoted(text),
                                                 sparse::printable(to_text(Insert{{{text}}, false})))};
  }
  return label;
}

}  // namespace

Status plan_collapse(const Collapse& operation, const Structure& structure, Plan& plan) {
  const Result<LabelId> from = resolve_label(operation.from, structure);
  const Result<LabelId> to = resolve_label(operation.to, structure);
  if (!from || !to) {
    return from ? to.error() : from.error();
  }
  for (const LabelId label : {*from, *to}) {
    if (const Result<BodyId> body = abstract_body(label, structure); !body) {
      return body.error();
    }
  }
  if (*from == *to) {
    return Error{Errc::bad_input, fmt::format("the vertex \"{}\" cannot be collapsed into itself", operation.from)};
  }
  const AbstractComplex& complex = structure.abstract();
  VertexId gone = complex.vertex(*from);
  VertexId kept = complex.vertex(*to);
  for (const auto& [vertex, text] : {std::pair{gone, operation.from}, std::pair{kept, operation.to}}) {
    if (complex.star_size(vertex) == 0) {
      return Error{Errc::refused, fmt::format("the vertex {} was removed", sparse::quoted(text))};
    }
  }
  if (complex.star_size(gone) > complex.star_size(kept)) {
    std::swap(gone, kept);
  }
  AbstractChange& change = plan.abstract.emplace();
  change.collapse = AbstractChange::Collapse{*from, *to, gone, kept};
  CollapsePlanner(structure, change, plan.merges).run();
  return Done{};
}

}  // namespace sesame::ops
