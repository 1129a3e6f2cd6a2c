#include "tools/commands/mesh_page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <span>

#include "ops/vocabulary/json_text.hpp"
#include "replay/page/packed_numbers.hpp"
#include "replay/page/page_file.hpp"
#include "sesame/version.hpp"
#include "tools/mesh/geometry.hpp"
#include "tools/mesh/graph.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/mesh_cells.hpp"
#include "tools/mesh/script.hpp"

namespace sesame::tools {

namespace {

using ops::JsonText;
using replay::write_packed;

/// A number, or its digits where doubles do not reach: as `--json` has it.
void write_measure(const Measure& measure, JsonText& out) {
  const double value = measure.to_double();
  measure.value == 0 || std::isnormal(value) ? out.value(value) : out.value(to_text(measure));
}

class PageWriter {
 public:
  PageWriter(const Mesh& mesh, const MeshHomology& found, const MeshPageOptions& options, std::string& text)
      : raw_{mesh},
        found_{found},
        options_{options},
        out_{text},
        parts_{prepared(mesh)},
        cells_{parts_, found.engine->structure(), options.source},
        edges_{incidence_of(parts_.triangles).edges},
        part_of_{connected_parts(points().size(), edges_).of} {
    box_ = empty_box();
    for (const Point& point : points()) {
      extend(box_, point);
    }
    scale_ = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      middle_[i] = std::midpoint(box_[0][i], box_[1][i]);
      scale_ = std::max(scale_, box_[1][i] / 2 - box_[0][i] / 2);
    }
    scale_ = scale_ > 0 ? scale_ : 1;
    for (std::uint32_t p = 0; p < points().size(); ++p) {
      const std::uint32_t number = cells_.in_file(p);
      point_of_.resize(std::max<std::size_t>(point_of_.size(), number + std::size_t{1}));
      point_of_[number] = p;
    }
  }

  void write() {
    out_.begin_object();
    out_.field("kind", "mesh");
    out_.field("format", 1);
    out_.field("version", SESAME_VERSION);
    out_.field("source", std::filesystem::path(options_.source).filename().string());  // folders concern nobody
    out_.field("stem", name_of_source(options_.source));
    out_.field("ring", sparse::ring_name(found_.ring));
    write_counts();
    write_components();
    write_groups();
    write_geometry();
    write_places();
    write_meetings();
    write_faces();
    write_generators();
    out_.end_object();
  }

 private:
  [[nodiscard]] const std::vector<Point>& points() const { return parts_.triangles.points; }

  template <class T>
  void write_if(const char* name, const std::optional<T>& value) {
    out_.key(name);
    value ? out_.value(*value) : out_.null();
  }

  void write_counts() {
    const Validity& validity = found_.validity;
    out_.field("points_in_file", validity.points_in_file);
    out_.field("faces_in_file", validity.faces_in_file);
    out_.field("vertices", validity.vertices);
    out_.field("edges", validity.edges);
    out_.field("faces", validity.faces);
    out_.field("polygons", validity.polygons);
    out_.field("euler", validity.euler());
    out_.field("manifold", validity.is_manifold());
    out_.field("closed", validity.is_closed());
    out_.field("orientable", validity.is_orientable());
    out_.field("consistently_oriented", validity.is_consistently_oriented());
    out_.field("boundary_loops", validity.boundary_loops);
    std::vector<std::string> remarks = validity.remarks;
    remarks.insert(remarks.end(), found_.remarks.begin(), found_.remarks.end());
    out_.field("remarks", remarks);
  }

  void write_components() {
    const auto& components = found_.validity.components;
    std::vector<Box> boxes(components.size(), empty_box());
    for (std::uint32_t p = 0; p < points().size(); ++p) {
      extend(boxes[part_of_[p]], points()[p]);
    }
    out_.field("components_in_all", components.size());
    out_.key("components");
    out_.begin_list();
    for (std::size_t k = 0; k < std::min(components.size(), options_.limits.components); ++k) {
      write_component(k, components[k], boxes[k]);
    }
    out_.end_list();
  }

  void write_component(std::size_t k, const Component& component, const Box& box) {
    out_.begin_object();
    out_.field("vertices", component.vertices);
    out_.field("edges", component.edges);
    out_.field("faces", component.faces);
    out_.field("euler", component.euler());
    out_.field("boundary_loops", component.boundary_loops);
    out_.field("manifold", component.is_manifold);
    out_.field("orientable", component.is_orientable);
    out_.field("closed", component.is_closed());
    write_if("genus", component.genus());
    const bool is_unsorted = k < found_.sorting.size() && !found_.sorting[k].why_not.empty();
    write_if("unsorted", is_unsorted ? std::optional{found_.sorting[k].why_not} : std::nullopt);
    out_.field("box", box);
    out_.end_object();
  }

  void write_groups() {
    out_.field("betti", found_.homology.betti);
    out_.field("torsion", found_.homology.torsion);
    out_.field("loops_tried", found_.loops_tried);
  }

  [[nodiscard]] float placed(const Point& point, std::size_t axis) const {
    return static_cast<float>((point[axis] - middle_[axis]) / scale_);
  }

  void write_geometry() {
    out_.key("frame");
    out_.begin_object();
    out_.field("middle", middle_);
    out_.field("scale", scale_);
    out_.end_object();
    std::vector<float> places;
    std::vector<std::uint32_t> numbers;
    bool is_as_in_file = true;
    for (std::uint32_t p = 0; p < points().size(); ++p) {
      for (std::size_t i = 0; i < 3; ++i) {
        places.push_back(placed(points()[p], i));
      }
      numbers.push_back(cells_.in_file(p));
      is_as_in_file = is_as_in_file && numbers.back() == p;
    }
    out_.key("points");
    write_packed(places, out_);
    out_.key("numbers");
    is_as_in_file ? out_.null() : write_packed(numbers, out_);
    out_.key("part");
    found_.validity.components.size() < 2 ? out_.null() : write_packed(part_of_, out_);
    const Faces& triangles = parts_.triangles.faces;
    stride_ = triangles.size() / options_.limits.triangles + (triangles.size() % options_.limits.triangles > 0 ? 1 : 0);
    stride_ = std::max<std::size_t>(stride_, 1);
    out_.field("triangles_in_all", triangles.size());
    out_.field("stride", stride_);
    std::vector<std::uint32_t> corners;
    for (std::size_t t = 0; t < triangles.size(); t += stride_) {
      corners.insert(corners.end(), triangles[t].begin(), triangles[t].end());
    }
    out_.key("triangles");
    write_packed(corners, out_);
    out_.key("sides");
    write_edges(cells_.edges(), stride_);
  }

  void write_edges(std::span<const Edge> edges, std::size_t stride = 1) {
    std::vector<std::uint32_t> ends;
    for (std::size_t e = 0; e < edges.size(); e += stride) {
      ends.insert(ends.end(), edges[e].begin(), edges[e].end());
    }
    write_packed(ends, out_);
  }

  void write_places() {
    const MeshPlaces& places = found_.validity.places;
    out_.key("places");
    out_.begin_object();
    out_.key("lines");
    write_edges(places.lines);
    out_.key("boundary");
    write_edges(places.boundary);
    out_.key("boundary_loop");
    write_packed(places.boundary_loop, out_);
    out_.key("non_manifold_edges");
    write_edges(places.non_manifold_edges);
    out_.key("non_manifold_vertices");
    write_packed(places.non_manifold_vertices, out_);
    out_.key("reversed_edges");
    write_edges(places.reversed_edges);
    out_.end_object();
  }

  void write_meetings() {
    const auto& meetings = found_.meetings.meetings;
    out_.field("meetings_in_all", meetings.size());
    out_.field("meetings_complete", found_.meetings.is_complete);
    out_.key("meetings");
    out_.begin_list();
    for (std::size_t k = 0; k < std::min(meetings.size(), options_.limits.meetings); ++k) {
      out_.begin_object();
      out_.field("faces", meetings[k].faces);
      out_.field("crosses", meetings[k].crosses);
      out_.key("place");
      out_.list_of(placed(meetings[k].place, 0), placed(meetings[k].place, 1), placed(meetings[k].place, 2));
      out_.key("corners");
      out_.begin_list();
      for (const std::uint32_t face : meetings[k].faces) {
        const auto here = std::lower_bound(parts_.face_in_file.begin(), parts_.face_in_file.end(), face);
        out_.value(parts_.polygons.faces[static_cast<std::size_t>(here - parts_.face_in_file.begin())]);
      }
      out_.end_list();
      out_.end_object();
    }
    out_.end_list();
  }

  /// Faces of the file that are none of the mesh, or are folded, and where.
  void write_faces() {
    const Cleaning& cleaning = found_.validity.cleaning;
    out_.key("bad_faces");
    out_.begin_object();
    const std::pair<const char*, const std::vector<std::uint32_t>*> kinds[] = {
        {"degenerate", &cleaning.degenerate}, {"duplicate", &cleaning.duplicates}, {"folded", &cleaning.folded}};
    for (const auto& [kind, faces] : kinds) {
      out_.field(std::string{kind} + "_in_all", faces->size());
      out_.key(kind);
      out_.begin_list();
      for (std::size_t k = 0; k < std::min(faces->size(), options_.limits.faces); ++k) {
        write_face((*faces)[k]);
      }
      out_.end_list();
    }
    out_.end_object();
  }

  void write_face(std::uint32_t face) {
    const auto corners = raw_.faces[face];
    out_.begin_object();
    out_.field("face", face);
    out_.field("corners", corners);
    out_.key("points");
    out_.begin_list();
    for (const std::uint32_t corner : corners) {
      for (std::size_t i = 0; i < 3; ++i) {
        out_.value(std::clamp((raw_.points[corner][i] - middle_[i]) / scale_, -1e3, 1e3));
      }
    }
    out_.end_list();
    out_.end_object();
  }

  void write_generators() {
    const auto& generators = found_.generators;
    const auto count = [&](int degree) {
      return std::count_if(generators.begin(), generators.end(), [=](const auto& g) { return g.degree == degree; });
    };
    out_.field("generators", options_.generators);
    write_if("shorter_than", options_.shorter_than);
    out_.field("loops_in_all", count(1));
    out_.field("surfaces_in_all", count(2));
    out_.key("loops");
    write_some(1, options_.limits.loops);
    out_.key("surfaces");
    write_some(2, options_.limits.surfaces);
  }

  void write_some(int degree, std::size_t most) {
    std::size_t written = 0;
    std::size_t edges = 0;
    out_.begin_list();
    for (const MeshGenerator& generator : found_.generators) {
      if (generator.degree == degree && written < most && edges + generator.edges.size() <= options_.limits.edges) {
        degree == 1 ? write_loop(generator) : write_surface(generator);
        edges += generator.edges.size();
        ++written;
      }
    }
    out_.end_list();
  }

  void write_loop(const MeshGenerator& loop) {
    out_.begin_object();
    out_.field("order", loop.order.to_string());
    write_if("side", loop.side ? std::optional<std::string>{side_name(*loop.side)} : std::nullopt);
    out_.field("component", loop.part);
    out_.key("length");
    write_measure(loop.length, out_);
    out_.field("short", loop.is_short);
    out_.field("closed", !loop.vertices.empty());
    out_.field("box", loop.box);
    out_.field("centre", loop.centre);
    out_.key("edges");
    out_.begin_list();
    for (const CycleEdge& edge : loop.edges) {
      out_.value(point_of_[edge.vertices[0]]);
      out_.value(point_of_[edge.vertices[1]]);
    }
    out_.end_list();
    if (std::any_of(loop.edges.begin(), loop.edges.end(), [](const CycleEdge& edge) { return edge.times != 1; })) {
      out_.key("times");
      out_.begin_list();
      for (const CycleEdge& edge : loop.edges) {
        out_.value(edge.times);
      }
      out_.end_list();
    }
    if (loop.bounding) {
      out_.key("bounds");
      write_runs(*loop.bounding);
    }
    out_.end_object();
  }

  void write_surface(const MeshGenerator& surface) {
    out_.begin_object();
    out_.field("order", surface.order.to_string());
    out_.field("triangles", surface.triangles);
    out_.key("area");
    write_measure(surface.area, out_);
    out_.key("volume");
    surface.volume ? write_measure(*surface.volume, out_) : out_.null();
    out_.field("box", surface.box);
    out_.field("centre", surface.centre);
    out_.key("runs");
    write_runs(surface.chain);
    out_.end_object();
  }

  /// The triangles of a chain, as runs of numbers: the first and how many, each.
  void write_runs(const engine::CellChain& chain) {
    std::vector<std::uint32_t> triangles;
    for (const auto& term : chain.terms) {
      triangles.push_back(cells_.triangle(term.generator));
    }
    std::sort(triangles.begin(), triangles.end());
    out_.begin_list();
    for (std::size_t begin = 0; begin < triangles.size();) {
      std::size_t end = begin + 1;
      while (end < triangles.size() && triangles[end] == triangles[end - 1] + 1) {
        ++end;
      }
      out_.value(triangles[begin]);
      out_.value(end - begin);
      begin = end;
    }
    out_.end_list();
  }

  const Mesh& raw_;
  const MeshHomology& found_;
  const MeshPageOptions& options_;
  JsonText out_;
  PreparedMesh parts_;
  MeshCells cells_;
  std::vector<Edge> edges_;  ///< of the triangles
  std::vector<std::uint32_t> part_of_;
  Box box_{};
  Point middle_{};
  double scale_ = 1;
  std::size_t stride_ = 1;
  std::vector<std::uint32_t> point_of_;  ///< by numbers of the file
};

}  // namespace

std::string mesh_page_data(const Mesh& mesh, const MeshHomology& found, const MeshPageOptions& options) {
  std::string text;
  PageWriter(mesh, found, options, text).write();
  return text;
}

void write_mesh_page(std::ostream& out, const Mesh& mesh, const MeshHomology& found, const MeshPageOptions& options) {
  replay::write_page_file(out, mesh_page_data(mesh, found, options));
}

}  // namespace sesame::tools
