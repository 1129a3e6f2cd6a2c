#include "ops/simplicial/tower_rules.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

namespace sesame::ops {
namespace {

constexpr std::uint32_t nothing = SimplexIndex::nothing;

std::string in_braces(std::span<const Label> labels, std::size_t without = SIZE_MAX) {
  std::string text;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (k != without) {
      text += (text.empty() ? "{" : " ") + std::to_string(labels[k]);
    }
  }
  return text + "}";
}

Error bad(std::string what) { return {Errc::bad_input, std::move(what)}; }
Error not_there(std::string what) {
  return {Errc::unknown_name, std::move(what) + " is not there; include the faces of a simplex first"};
}
Error repeated(Label label, std::span<const Label> labels) {
  return bad("vertex " + std::to_string(label) + " is repeated in " + in_braces(labels));
}

}  // namespace

bool TowerRules::contains(std::span<const Label> labels) const {
  if (labels.empty() || labels.size() > most_vertices) {
    return false;
  }
  std::array<Vertex, most_vertices> vertices;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    vertices[k] = vertex_of_(labels[k]);
    if (vertices[k] == nothing) {
      return false;
    }
  }
  const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(labels.size());
  std::sort(vertices.begin(), end);  // as they are in the index of a tower, which makes the comparison quick
  return labels.size() == 1 || simplices_.find(SimplexIndex::key({vertices.begin(), end})) != nothing;
}

Result<std::vector<std::vector<Label>>> TowerRules::missing_faces(std::span<const Label> labels) const {
  std::vector<Label> simplex(labels.begin(), labels.end());
  std::sort(simplex.begin(), simplex.end());
  if (const auto twice = std::adjacent_find(simplex.begin(), simplex.end()); twice != simplex.end()) {
    return repeated(*twice, labels);
  }
  // Down from the simplex: the faces of a face that is there are there.
  std::vector<std::set<std::vector<Label>>> levels{{simplex}};
  std::size_t count = 0;
  while (!levels.back().empty() && levels.back().begin()->size() > 1) {
    std::set<std::vector<Label>> below;
    for (const std::vector<Label>& above : levels.back()) {
      for (std::size_t k = 0; k < above.size(); ++k) {
        std::vector<Label> face = above;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
        if (!contains(face)) {
          below.insert(std::move(face));
        }
      }
      if (count + below.size() > most_missing) {
        return bad("the simplex " + in_braces(labels) + " lacks more than " + std::to_string(most_missing) + " faces");
      }
    }
    count += below.size();
    levels.push_back(std::move(below));
  }
  std::vector<std::vector<Label>> faces;
  for (std::size_t k = levels.size(); k-- > 1;) {
    faces.insert(faces.end(), levels[k].begin(), levels[k].end());
  }
  return faces;
}

Status TowerRules::check_inclusion(std::span<const Label> labels) const {
  if (labels.size() == 1) {
    return vertex_of_(labels[0]) == nothing
               ? Status{Done{}}
               : bad("vertex " + std::to_string(labels[0]) + " is there already; a simplex is included once");
  }
  if (labels.empty() || labels.size() > most_vertices) {
    return bad("a simplex has from 1 to " + std::to_string(most_vertices) + " vertices, not " +
               std::to_string(labels.size()));
  }
  std::vector<Vertex> vertices;
  for (const Label label : labels) {
    const Vertex v = vertex_of_(label);
    if (v == nothing) {
      return not_there("vertex " + std::to_string(label));
    }
    const auto at = std::ranges::lower_bound(vertices, v);
    if (at != vertices.end() && *at == v) {
      return repeated(label, labels);
    }
    vertices.insert(at, v);
  }
  const SimplexIndex::Key key = SimplexIndex::key(vertices);
  for (std::size_t k = 0; labels.size() > 2 && k < labels.size(); ++k) {
    if (simplices_.find_facet(key, k) == nothing) {
      const auto absent = std::ranges::find(labels, vertices[k], vertex_of_) - labels.begin();
      return not_there("the face " + in_braces(labels, static_cast<std::size_t>(absent)) + " of " + in_braces(labels));
    }
  }
  return simplices_.find(key) == nothing
             ? Status{Done{}}
             : bad("simplex " + in_braces(labels) + " is there already; a simplex is included once");
}

Status TowerRules::check_contraction(Label u, Label v) const {
  const Vertex from = vertex_of_(u);
  const Vertex to = vertex_of_(v);
  if (from == nothing || to == nothing) {
    return bad("vertex " + std::to_string(from == nothing ? u : v) +
               " is not there; only two vertices of the complex can be contracted");
  }
  return from != to ? Status{Done{}} : bad("vertex " + std::to_string(u) + " cannot be contracted into itself");
}

}  // namespace sesame::ops
