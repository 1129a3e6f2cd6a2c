#include "tools/mesh/script.hpp"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <ostream>
#include <utility>

#include "tools/mesh/incidence.hpp"
#include "tools/mesh/mesh_items.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

/// What both kinds of script have in common: the head, the comments, the expectation, and a buffer before the stream.
class ScriptWriter {
 public:
  ScriptWriter(const MeshItems& items, std::ostream& out, const ScriptOptions& options)
      : items_{items}, options_{options}, out_{out} {}

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    constexpr std::size_t enough = 1U << 16U;
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    if (buffer_.size() > enough) {
      flush();
    }
  }

  void print_point(std::uint32_t vertex) {
    const auto& [x, y, z] = items_.mesh().points[vertex];
    print("[{},{},{}]", x, y, z);
  }

  void head(std::string_view what) {
    const auto& mesh = items_.mesh();
    print("{{\"sesame\":1,\"ring\":\"{}\",\"title\":\"{}\"}}\n", printable(options_.ring),
          name_of_source(options_.source));
    print("# {}{}{}\n", what, options_.source.empty() ? "" : " from ", printable(options_.source));
    print("# {}, {}, {}; they are counted from 0\n", counted(mesh.points.size(), "vertex", "vertices"),
          counted(items_.incidence().edges.size(), "edge", "edges"),
          counted(mesh.faces.size(), "triangle", "triangles"));
    for (const auto& remark : mesh.remarks) {
      print("# {}\n", printable(remark));
    }
  }

  /// The cells are counted on the mesh, so this holds of any engine that works.
  void expectation() {
    if (!options_.expect) {
      return;
    }
    const auto vertices = static_cast<long long>(items_.mesh().points.size());
    const auto edges = static_cast<long long>(items_.incidence().edges.size());
    const auto triangles = static_cast<long long>(items_.mesh().faces.size());
    print("{{\"op\":\"expect\",\"cells\":[{}", vertices);
    if (edges > 0) {
      print(",{}", edges);
    }
    if (triangles > 0) {
      print(",{}", triangles);
    }
    print("],\"euler\":{}}}\n", vertices - edges + triangles);
    ++steps_;
  }

  void count_step() { ++steps_; }

  Result<ScriptSummary> finish() {
    flush();
    const auto& mesh = items_.mesh();
    return ScriptSummary{mesh.points.size(), items_.incidence().edges.size(), mesh.faces.size(), steps_, mesh.remarks};
  }

 private:
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  const MeshItems& items_;
  const ScriptOptions& options_;
  std::ostream& out_;
  fmt::memory_buffer buffer_;
  std::size_t steps_ = 0;
};

/// Visits the cells of a complex, each after its faces: vertex(v), edge(e) and triangle(item) with the numbers that
/// points, edges and items have.
template <class Vertex, class Edge, class Triangle>
void for_each_cell(const MeshItems& items, BuildOrder order, Vertex&& vertex, Edge&& edge, Triangle&& triangle) {
  std::vector<bool> has_vertex(items.mesh().points.size(), false);
  std::vector<bool> has_edge(items.incidence().edges.size(), false);
  const auto visit_vertex = [&](std::uint32_t v) {
    if (!has_vertex[v]) {
      vertex(v);
    }
    has_vertex[v] = true;
  };
  for (const auto item : build_order(items, order)) {
    const auto simplex = items[item];
    for (const auto v : simplex.all_vertices()) {
      visit_vertex(v);
    }
    for (const auto e : simplex.all_edges()) {
      if (!has_edge[e]) {
        edge(e);
      }
      has_edge[e] = true;
    }
    if (!items.is_line(item)) {
      triangle(item);
    }
  }
  for (std::uint32_t v = 0; v < items.mesh().points.size(); ++v) {
    visit_vertex(v);
  }
}

Result<ScriptSummary> write_complex(const MeshItems& items, std::ostream& out, const ScriptOptions& options) {
  ScriptWriter writer{items, out, options};
  writer.head("a complex");
  writer.print("{{\"op\":\"complex\",\"name\":\"{}\",\"cells\":[", name_of_source(options.source));
  writer.count_step();
  const char* separator = "";
  const auto separate = [&] { writer.print("{}", std::exchange(separator, ",")); };
  for_each_cell(
      items, options.order,
      [&](std::uint32_t v) {
        separate();
        writer.print("{{\"id\":\"v{}\",\"at\":", v);
        writer.print_point(v);
        writer.print("}}");
      },
      [&](std::uint32_t e) {
        separate();
        const auto [low, high] = items.incidence().edges[e];
        writer.print("{{\"id\":\"e{}-{}\",\"faces\":[\"v{}\",\"v{}\"]}}", low, high, high, low);
      },
      [&](std::uint32_t item) {
        separate();
        const auto [a, b, c] = items[item].vertices;
        writer.print("{{\"id\":\"f{}\",\"faces\":[\"e{}-{}\",\"e{}-{}\",\"e{}-{}\"]}}", items.number(item), b, c, a, c,
                     a, b);
      });
  writer.print("]}}\n");
  writer.expectation();
  return writer.finish();
}

ops::MakeComplex complex_of(const MeshItems& items, const ScriptOptions& options) {
  ops::MakeComplex complex{name_of_source(options.source), {}};
  const auto edge_id = [](std::uint32_t low, std::uint32_t high) { return fmt::format("e{}-{}", low, high); };
  const auto add = [&](std::string id, std::vector<std::string> faces, std::optional<ops::Point> at) {
    complex.cells.push_back({std::move(id), std::nullopt, std::move(faces), at});
  };
  for_each_cell(
      items, options.order, [&](std::uint32_t v) { add(fmt::format("v{}", v), {}, items.mesh().points[v]); },
      [&](std::uint32_t e) {
        const auto [low, high] = items.incidence().edges[e];
        add(edge_id(low, high), {fmt::format("v{}", high), fmt::format("v{}", low)}, std::nullopt);
      },
      [&](std::uint32_t item) {
        const auto [a, b, c] = items[item].vertices;
        add(fmt::format("f{}", items.number(item)), {edge_id(b, c), edge_id(a, c), edge_id(a, b)}, std::nullopt);
      });
  return complex;
}

class AssembledScript {
 public:
  AssembledScript(const MeshItems& items, std::ostream& out, const ScriptOptions& options)
      : items_{items}, options_{options}, writer_{items, out, options} {}

  Result<ScriptSummary> write() {
    const auto& mesh = items_.mesh();
    vertex_owner_.assign(mesh.points.size(), {no_item, 0});
    edge_owner_.assign(items_.incidence().edges.size(), {no_item, 0});
    writer_.head("an assembly");
    for (const auto item : build_order(items_, options_.order)) {
      const auto simplex = items_[item];
      write_simplex(item, simplex);
      write_gluing(item, simplex);
      take_ownership(item, simplex);
    }
    for (std::uint32_t v = 0; items_.size() == 0 && v < mesh.points.size(); ++v) {
      writer_.print("{{\"op\":\"simplex\",\"name\":\"p{}\",\"dim\":0,\"at\":[", v);
      writer_.print_point(v);
      writer_.print("]}}\n");
      writer_.count_step();
    }
    writer_.expectation();
    return writer_.finish();
  }

 private:
  /// The first item that has a cell, and where in it the cell is: a vertex by its place, an edge by the vertex omitted.
  struct Owner {
    std::uint32_t item;
    std::size_t place;
  };

  void write_simplex(std::uint32_t item, const MeshSimplex& simplex) {
    writer_.print("{{\"op\":\"simplex\",\"name\":\"");
    print_name(item);
    writer_.print("\",\"dim\":{},\"at\":[", simplex.dimension);
    for (std::size_t i = 0; i <= simplex.dimension; ++i) {
      if (i > 0) {
        writer_.print(",");
      }
      writer_.print_point(simplex.vertices[i]);
    }
    writer_.print("]}}\n");
    writer_.count_step();
  }

  void write_gluing(std::uint32_t item, const MeshSimplex& simplex) {
    pairs_ = 0;
    std::array<bool, 3> is_glued{};
    for (std::size_t k = 0; simplex.dimension == 2 && k < 3; ++k) {
      const auto& owner = edge_owner_[simplex.edges[k]];
      if (owner.item == no_item) {
        continue;
      }
      begin_pair();
      print_edge(item, k);
      writer_.print("\",\"");
      print_edge(owner.item, owner.place);
      writer_.print("\"]");
      for (std::size_t i = 0; i < 3; ++i) {
        is_glued[i] = is_glued[i] || i != k;
      }
    }
    for (std::size_t i = 0; i <= simplex.dimension; ++i) {
      const auto& owner = vertex_owner_[simplex.vertices[i]];
      if (is_glued[i] || owner.item == no_item) {
        continue;
      }
      begin_pair();
      print_name(item);
      writer_.print(".{}\",\"", i);
      print_name(owner.item);
      writer_.print(".{}\"]", owner.place);
    }
    if (pairs_ > 0) {
      writer_.print("]}}\n");
    }
  }

  void begin_pair() {
    if (pairs_++ == 0) {
      writer_.print("{{\"op\":\"identify\",\"pairs\":[[\"");
      writer_.count_step();
    } else {
      writer_.print(",[\"");
    }
  }

  void take_ownership(std::uint32_t item, const MeshSimplex& simplex) {
    for (std::size_t i = 0; i <= simplex.dimension; ++i) {
      auto& owner = vertex_owner_[simplex.vertices[i]];
      if (owner.item == no_item) {
        owner = {item, i};
      }
    }
    for (std::size_t k = 0; k < simplex.all_edges().size(); ++k) {
      auto& owner = edge_owner_[simplex.edges[k]];
      if (owner.item == no_item) {
        owner = {item, k};
      }
    }
  }

  void print_name(std::uint32_t item) { writer_.print("{}{}", items_.is_line(item) ? 'l' : 'f', items_.number(item)); }

  /// Only triangles share edges: a line that is a side of one was left out by `normalise`.
  void print_edge(std::uint32_t triangle, std::size_t omitted) {
    constexpr std::array<const char*, 3> ends{"1-2", "0-2", "0-1"};
    print_name(triangle);
    writer_.print(".{}", ends[omitted]);
  }

  const MeshItems& items_;
  const ScriptOptions& options_;
  ScriptWriter writer_;
  std::vector<Owner> vertex_owner_;
  std::vector<Owner> edge_owner_;
  std::size_t pairs_ = 0;
};

Result<MeshItems> items_of(const Mesh& mesh, const ScriptOptions& options) {
  if (mesh.points.empty()) {
    return Error{Errc::bad_input, fmt::format("{}: the mesh has no points, there is nothing to build",
                                              options.source.empty() ? "mesh" : options.source)};
  }
  Mesh prepared = mesh;
  normalise(prepared);
  triangulate(prepared, options.polygons);
  return MeshItems{std::move(prepared)};
}

}  // namespace

Result<ScriptSummary> write_complex_script(const Mesh& mesh, std::ostream& out, const ScriptOptions& options) {
  auto items = items_of(mesh, options);
  if (!items) {
    return items.error();
  }
  return write_complex(*items, out, options);
}

Result<ops::MakeComplex> make_complex(const Mesh& mesh, const ScriptOptions& options) {
  auto items = items_of(mesh, options);
  if (!items) {
    return items.error();
  }
  return complex_of(*items, options);
}

Result<ScriptSummary> write_assembled_script(const Mesh& mesh, std::ostream& out, const ScriptOptions& options) {
  auto items = items_of(mesh, options);
  if (!items) {
    return items.error();
  }
  return AssembledScript{*items, out, options}.write();
}

std::string name_of_source(std::string_view path) {
  path.remove_prefix(path.find_last_of("/\\") + 1);  // npos + 1 is 0
  constexpr std::string_view packed = ".gz";
  if (path.ends_with(packed)) {
    path.remove_suffix(packed.size());
  }
  const auto dot = path.rfind('.');
  if (dot != std::string_view::npos && dot > 0) {
    path = path.substr(0, dot);
  }
  std::string name{path};
  for (char& c : name) {
    const bool stays =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!stays) {
      c = '_';
    }
  }
  return name.empty() ? "mesh" : name;
}

}  // namespace sesame::tools
