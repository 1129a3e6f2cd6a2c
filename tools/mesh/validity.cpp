#include "tools/mesh/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/mesh/graph.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

class Examination {
 public:
  explicit Examination(const Mesh& raw) : mesh_{raw} {
    validity_.points_in_file = raw.points.size();
    validity_.faces_in_file = raw.faces.size();
    validity_.cleaning = normalise(mesh_);
    validity_.remarks = mesh_.remarks;
    incidence_ = incidence_of(mesh_);
    part_ = connected_parts(mesh_.points.size(), incidence_.edges);
    validity_.components.resize(part_.count);
  }

  Validity run() {
    count_cells();
    examine_edges();
    examine_vertices();
    count_boundary_loops();
    examine_orientability();
    for (auto& component : validity_.components) {
      if (component.faces == 0 || component.lines > 0) {
        component.is_manifold = false;
      }
    }
    return std::move(validity_);
  }

 private:
  Component& component_of(std::uint32_t point) { return validity_.components[part_.of[point]]; }

  void count_cells() {
    validity_.vertices = mesh_.points.size();
    validity_.edges = incidence_.edges.size();
    validity_.faces = mesh_.faces.size();
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      ++component_of(v).vertices;
    }
    for (const auto& edge : incidence_.edges) {
      ++component_of(edge[0]).edges;
    }
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      ++component_of(mesh_.faces[f][0]).faces;
      if (mesh_.faces[f].size() > 3) {
        ++validity_.polygons;
      }
    }
  }

  void examine_edges() {
    for (std::size_t e = 0; e < incidence_.edges.size(); ++e) {
      const auto sides = incidence_.sides_of(e);
      const auto [from, to] = incidence_.edges[e];
      auto& component = component_of(from);
      if (sides.empty()) {
        ++component.lines;
        ++validity_.lines;
        validity_.places.lines.push_back(incidence_.edges[e]);
      } else if (sides.size() == 1) {
        ++component.boundary_edges;
        ++validity_.boundary_edges;
      } else if (sides.size() == 2) {
        if (runs_upwards(mesh_, incidence_, sides[0]) == runs_upwards(mesh_, incidence_, sides[1])) {
          ++validity_.reversed_edges;
          validity_.places.reversed_edges.push_back(incidence_.edges[e]);
        }
      } else {
        component.is_manifold = false;
        validity_.places.non_manifold_edges.push_back(incidence_.edges[e]);
        if (validity_.non_manifold_edges++ == 0) {
          validity_.first_non_manifold_edge.emplace(mesh_.points[from], mesh_.points[to]);
        }
      }
    }
  }

  /// The links of all vertices are one graph: its nodes are the ends of edges, 2e + 0 or 1, and each corner of a face
  /// joins the two ends that meet there. A link is a path or a circle when it is connected and no edge has three faces.
  void examine_vertices() {
    std::vector<Edge> arcs;
    arcs.reserve(mesh_.faces.corners().size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      auto before = mesh_.faces.start(f + 1) - 1;
      for (auto c = mesh_.faces.start(f); c < mesh_.faces.start(f + 1); before = c++) {
        const auto point = mesh_.faces.corners()[c];
        arcs.push_back({end_at(incidence_.edge_of_corner[before], point), end_at(incidence_.edge_of_corner[c], point)});
      }
    }
    const auto links = connected_parts(2 * incidence_.edges.size(), arcs);

    constexpr auto unseen = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> link_of(mesh_.points.size(), unseen);
    std::vector<bool> has_face(mesh_.points.size(), false);
    std::vector<bool> is_singular(mesh_.points.size(), false);
    for (const auto corner : mesh_.faces.corners()) {
      has_face[corner] = true;
    }
    for (std::uint32_t e = 0; e < incidence_.edges.size(); ++e) {
      for (std::uint32_t end = 0; end < 2; ++end) {
        const auto point = incidence_.edges[e][end];
        const auto link = links.of[2 * e + end];
        if (link_of[point] == unseen) {
          link_of[point] = link;
        }
        if (link_of[point] != link || incidence_.sides_of(e).size() > 2) {
          is_singular[point] = true;
        }
      }
    }
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (!is_singular[v] || !has_face[v]) {
        continue;
      }
      component_of(v).is_manifold = false;
      validity_.places.non_manifold_vertices.push_back(v);
      if (validity_.non_manifold_vertices++ == 0) {
        validity_.first_non_manifold_vertex = mesh_.points[v];
      }
    }
  }

  [[nodiscard]] std::uint32_t end_at(std::uint32_t edge, std::uint32_t point) const {
    return 2 * edge + (incidence_.edges[edge][0] == point ? 0 : 1);
  }

  void count_boundary_loops() {
    std::vector<Edge>& boundary = validity_.places.boundary;
    std::vector<bool> on_boundary(mesh_.points.size(), false);
    for (std::size_t e = 0; e < incidence_.edges.size(); ++e) {
      if (incidence_.sides_of(e).size() != 1) {
        continue;
      }
      boundary.push_back(incidence_.edges[e]);
      for (const auto point : incidence_.edges[e]) {
        on_boundary[point] = true;
      }
    }
    const auto loops = connected_parts(mesh_.points.size(), boundary);
    constexpr auto uncounted = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> number(loops.count, uncounted);
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (!on_boundary[v] || number[loops.of[v]] != uncounted) {
        continue;
      }
      ++component_of(v).boundary_loops;
      number[loops.of[v]] = static_cast<std::uint32_t>(validity_.boundary_loops++);
    }
    for (const Edge& edge : boundary) {
      validity_.places.boundary_loop.push_back(number[loops.of[edge[0]]]);
    }
  }

  /// On the two-fold cover, nodes 2f (as given) and 2f + 1 (reversed): a surface is orientable if and only if no face
  /// is connected with its own reverse.
  void examine_orientability() {
    std::vector<Edge> links;
    for (std::size_t e = 0; e < incidence_.edges.size(); ++e) {
      const auto sides = incidence_.sides_of(e);
      if (sides.size() != 2) {
        continue;
      }
      const auto a = incidence_.face_of_corner[sides[0]];
      const auto b = incidence_.face_of_corner[sides[1]];
      const bool agree = runs_upwards(mesh_, incidence_, sides[0]) != runs_upwards(mesh_, incidence_, sides[1]);
      const std::uint32_t turn = agree ? 0 : 1;
      links.push_back({2 * a, 2 * b + turn});
      links.push_back({2 * a + 1, 2 * b + 1 - turn});
    }
    const auto cover = connected_parts(2 * mesh_.faces.size(), links);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (cover.of[2 * f] == cover.of[2 * f + 1]) {
        component_of(mesh_.faces[f][0]).is_orientable = false;
      }
    }
  }

  Mesh mesh_;
  Incidence incidence_;
  Parts part_;
  Validity validity_;
};

std::string shown_point(const Point& point) { return fmt::format("({}, {}, {})", point[0], point[1], point[2]); }

std::string describe(const Component& component) {
  auto text = fmt::format("{}, {}, {}, Euler characteristic {}", counted(component.vertices, "vertex", "vertices"),
                          counted(component.edges, "edge", "edges"), counted(component.faces, "face", "faces"),
                          component.euler());
  const auto out = std::back_inserter(text);
  if (component.faces == 0) {
    return text + (component.edges == 0 ? ", a point" : ", lines only");
  }
  fmt::format_to(out, ", {}",
                 component.is_closed() ? std::string{"closed"}
                                       : counted(component.boundary_loops, "boundary loop", "boundary loops"));
  if (!component.is_orientable) {
    fmt::format_to(out, ", not orientable");
  }
  if (!component.is_manifold) {
    fmt::format_to(out, ", not a surface");
  }
  if (const auto genus = component.genus()) {
    fmt::format_to(out, ", genus {}", *genus);
  }
  return text;
}

std::string describe_edges(const Validity& validity) {
  std::string text;
  const auto out = std::back_inserter(text);
  if (validity.boundary_edges > 0) {
    fmt::format_to(out, "{} in {}", counted(validity.boundary_edges, "boundary edge", "boundary edges"),
                   counted(validity.boundary_loops, "loop", "loops"));
  } else {
    fmt::format_to(out, "no boundary edges");
  }
  if (validity.lines > 0) {
    fmt::format_to(out, ", {} on no face", counted(validity.lines, "line", "lines"));
  }
  return text;
}

std::string describe_singularities(const Validity& validity) {
  std::string text;
  const auto out = std::back_inserter(text);
  if (const auto& edge = validity.first_non_manifold_edge) {
    fmt::format_to(out, "non-manifold edges    {} on more than two faces, the first from {} to {}\n",
                   validity.non_manifold_edges, shown_point(edge->first), shown_point(edge->second));
  }
  if (const auto& vertex = validity.first_non_manifold_vertex) {
    fmt::format_to(out, "non-manifold vertices {} where sheets touch, the first at {}\n",
                   validity.non_manifold_vertices, shown_point(*vertex));
  }
  return text;
}

std::string describe_remarks(const Validity& validity) {
  std::string text;
  for (const auto& remark : validity.remarks) {
    text += fmt::format("remark                {}\n", remark);
  }
  return text;
}

std::string describe_orientation(const Validity& validity) {
  if (!validity.is_orientable()) {
    return "not orientable";
  }
  if (validity.is_consistently_oriented()) {
    return "orientable, and the faces agree";
  }
  return fmt::format("orientable, but the faces disagree across {}", counted(validity.reversed_edges, "edge", "edges"));
}

}  // namespace

std::optional<long long> Component::genus() const {
  if (!is_manifold || !is_orientable) {
    return std::nullopt;
  }
  return (2 - euler() - static_cast<long long>(boundary_loops)) / 2;
}

long long Validity::euler() const {
  return static_cast<long long>(vertices) - static_cast<long long>(edges) + static_cast<long long>(faces);
}

bool Validity::is_manifold() const {
  return !components.empty() && std::all_of(components.begin(), components.end(),
                                            [](const Component& component) { return component.is_manifold; });
}

bool Validity::is_closed() const {
  return !components.empty() && std::all_of(components.begin(), components.end(),
                                            [](const Component& component) { return component.is_closed(); });
}

bool Validity::is_orientable() const {
  return std::all_of(components.begin(), components.end(),
                     [](const Component& component) { return component.is_orientable; });
}

std::string Validity::left_out_faces() const {
  const std::size_t left_out = cleaning.degenerate_faces + cleaning.duplicate_faces;
  if (left_out == 0) {
    return {};
  }
  return fmt::format("left out {} of {} ({} degenerate, {} duplicate)", left_out,
                     counted(faces_in_file, "face", "faces"), cleaning.degenerate_faces, cleaning.duplicate_faces);
}

Validity validate(const Mesh& mesh) { return Examination{mesh}.run(); }

std::string to_text(const Validity& validity) {
  constexpr std::size_t most_components = 10;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "cells                 {}, {}, {}; Euler characteristic {}\n",
                 counted(validity.vertices, "vertex", "vertices"), counted(validity.edges, "edge", "edges"),
                 counted(validity.faces, "face", "faces"), validity.euler());
  fmt::format_to(out, "boundary              {}\n", describe_edges(validity));
  text += describe_singularities(validity);
  if (validity.faces > 0) {
    fmt::format_to(out, "orientation           {}\n", describe_orientation(validity));
  }
  const char* verdict = !validity.is_manifold() ? "not a surface"
                        : validity.is_closed()  ? "a closed surface"
                                                : "a surface with boundary";
  fmt::format_to(out, "verdict               {}, {}\n", verdict,
                 counted(validity.components.size(), "component", "components"));
  if (validity.edges == 0) {  // every point is a component
    return text + describe_remarks(validity);
  }
  for (std::size_t i = 0; i < std::min(validity.components.size(), most_components); ++i) {
    fmt::format_to(out, "  component {:<10}{}\n", i, describe(validity.components[i]));
  }
  if (validity.components.size() > most_components) {
    fmt::format_to(out, "  and {}\n", counted(validity.components.size() - most_components, "more", "more"));
  }
  return text + describe_remarks(validity);
}

}  // namespace sesame::tools
