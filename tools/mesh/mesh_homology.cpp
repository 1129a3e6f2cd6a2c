#include "tools/mesh/mesh_homology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

#include "sparse/contract.hpp"
#include "tools/mesh/first_homology.hpp"
#include "tools/mesh/graph.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/short_loops.hpp"
#include "tools/mesh/triangulate.hpp"

namespace sesame::tools {

namespace {

using engine::CellChain;
using engine::SmallChain;
using ops::CellId;
using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Terms;

/// A mesh as `normalise` leaves it, and which point of the file each of its points is.
struct Normalised {
  Mesh mesh;
  std::vector<std::uint32_t> point_in_file;
};

/// What is left out depends on the numbers of points alone, so they can carry their numbers through as coordinates.
Normalised normalised(const Mesh& raw) {
  Mesh mesh = raw;
  for (std::size_t p = 0; p < raw.points.size(); ++p) {
    mesh.points[p] = {static_cast<double>(p), 0, 0};
  }
  normalise(mesh);
  std::vector<std::uint32_t> point_in_file;
  for (Point& point : mesh.points) {
    point_in_file.push_back(static_cast<std::uint32_t>(point[0]));
    point = raw.points[point_in_file.back()];
  }
  return {std::move(mesh), std::move(point_in_file)};
}

bool is_rational(const sparse::AnyRing& ring) { return std::holds_alternative<sparse::Rationals>(ring); }

/// Builds the complex by the step that `sesame import` writes, so that cells have the same names here and there.
Result<std::unique_ptr<engine::Engine>> build(const Mesh& triangulated, const MeshHomologyOptions& options) {
  auto complex = make_complex(triangulated, {options.source, "Z", Polygons::fan, BuildOrder::breadth_first, false});
  if (!complex) {
    return complex.error();
  }
  auto engine =
      std::make_unique<engine::Engine>(is_rational(options.ring) ? sparse::AnyRing{Integers{}} : options.ring);
  if (const auto report = engine->apply(std::move(*complex)); !report) {
    return report.error();
  }
  return engine;
}

/// The points, scaled to within 1 of the origin, so that no distance between them is too large for a double.
std::vector<Point> within_one(std::vector<Point> points) {
  const int exponent = binary_exponent(points);
  for (Point& point : points) {
    point = scaled(point, -exponent);
  }
  return points;
}

/// A mesh cut into triangles, and which face of the uncut mesh each of them is a part of.
struct Triangulated {
  Mesh mesh;
  std::vector<std::uint32_t> face_of_triangle;
};

class Generators {
 public:
  Generators(const Normalised& polygons, const Triangulated& triangulated, const MeshHomologyOptions& options,
             MeshHomology& result)
      : polygons_{polygons},
        triangles_{triangulated.mesh},
        face_of_triangle_{triangulated.face_of_triangle},
        ring_{options.ring},
        name_{name_of_source(options.source)},
        result_{result},
        engine_{*result.engine},
        edges_{incidence_of(polygons.mesh).edges},
        graph_{within_one(polygons.mesh.points), edges_} {
    for (std::uint32_t v = 0; v < triangles_.points.size(); ++v) {
      vertex_of_cell_[cell("v{}", v)] = v;
    }
    for (const auto& [low, high] : edges_) {
      cell_of_edge_.push_back(cell("e{}-{}", low, high));
    }
  }

  void find() {
    find_components();
    if (!edges_.empty()) {
      find_loops();
    }
    for (const auto& generator : engine_.generators(2)) {
      add_surface(generator);
    }
  }

 private:
  template <class... Numbers>
  [[nodiscard]] CellId cell(fmt::format_string<Numbers&...> format, Numbers... numbers) const {
    const auto found = engine_.structure().lookup(name_ + "." + fmt::format(format, numbers...));
    sparse::expects(found.has_value(), "the script names every cell of the mesh");
    return *found;
  }

  // ---- H_0
  void find_components() {
    const auto& points = polygons_.mesh.points;
    const Parts parts = connected_parts(points.size(), edges_);
    std::vector<MeshGenerator> components(parts.count);
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      MeshGenerator& component = components[parts.of[v]];
      if (component.vertices.empty()) {
        component.vertices.push_back(in_file(v));
        component.chain = {0, {{1, cell("v{}", v)}}};
        component.box = {points[v], points[v]};
      }
      extend(component.box, points[v]);
    }
    for (MeshGenerator& component : components) {
      for (std::size_t i = 0; i < 3; ++i) {
        component.centre[i] = std::midpoint(component.box[0][i], component.box[1][i]);
      }
      result_.generators.push_back(std::move(component));
    }
  }

  // ---- H_1
  void find_loops() {
    const FirstHomology h = first_homology(engine_, cell_of_edge_);
    if (!is_rational(ring_)) {
      find_torsion_loops(h);
    }
    const LoopBasis free_loops = short_loops(graph_, {ring_, &h.free});
    for (const Loop& loop : free_loops.loops) {
      result_.generators.push_back(from_loop(loop, 0));
    }
    for (const auto& rest : free_loops.completion)
      result_.generators.push_back(from_engine(sum(rest, h.free_cycles), 0));
    result_.loops_tried += free_loops.tried;
  }

  void find_torsion_loops(const FirstHomology& h) {
    std::vector<MeshGenerator> finite;
    LoopBasis torsion_loops;
    const auto prime = common_prime(h.orders);
    if (prime) {
      torsion_loops = short_loops(graph_, {*prime, &h.torsion, &h.free});
      for (const Loop& loop : torsion_loops.loops) {
        finite.push_back(from_loop(loop, h.orders[0]));
      }
      for (const auto& rest : torsion_loops.completion) {
        finite.push_back(from_engine(sum(rest, h.torsion_cycles), h.orders[0]));
      }
    } else {
      for (std::size_t k = 0; k < h.orders.size(); ++k) {
        finite.push_back(from_engine(h.torsion_cycles[k], h.orders[k]));
      }
    }
    for (MeshGenerator& generator : finite) {
      generator.bounding = bounding(generator);
    }
    result_.loops_tried += torsion_loops.tried;
    std::move(finite.begin(), finite.end(), std::back_inserter(result_.generators));
  }

  /// Z/p when all orders are one prime p: then bases of the torsion are bases over Z/p.
  [[nodiscard]] static std::optional<sparse::AnyRing> common_prime(const std::vector<Integer>& orders) {
    if (orders.empty() || orders.front() != orders.back()) {
      return std::nullopt;
    }
    const auto field = sparse::parse_ring("Z/" + orders.front().to_string());
    return field ? std::optional{*field} : std::nullopt;
  }

  [[nodiscard]] static SmallChain sum(const Terms<Integers>& factors, const std::vector<SmallChain>& cycles) {
    Terms<Integers> terms;
    for (const auto& [k, factor] : factors) {
      for (const auto& [coefficient, x] : cycles[k].terms) {
        terms.push_back({x, factor * coefficient.numerator()});
      }
    }
    sparse::normalize(Integers{}, terms);
    return small_chain(terms);
  }

  [[nodiscard]] MeshGenerator from_loop(const Loop& loop, const Integer& order) const {
    MeshGenerator generator;
    generator.degree = 1;
    generator.order = order;
    generator.is_short = true;
    generator.chain = {1, {}};
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const auto from = loop.points[i];
      const auto to = loop.points[i + 1 < loop.points.size() ? i + 1 : 0];
      generator.chain.terms.push_back({from < to ? Integer{1} : minus_one(), cell_of_edge_[graph_.way(from, to).edge]});
      generator.vertices.push_back(in_file(from));
    }
    std::sort(generator.chain.terms.begin(), generator.chain.terms.end(),
              [](const CellChain::Term& a, const CellChain::Term& b) { return a.cell < b.cell; });
    measure_cycle(generator);
    return generator;
  }

  [[nodiscard]] MeshGenerator from_engine(const SmallChain& cycle, const Integer& order) {
    MeshGenerator generator;
    generator.degree = 1;
    generator.order = order;
    generator.chain = engine_.maps().apply_G(cycle);
    generator.vertices = simple_loop(generator.chain);
    measure_cycle(generator);
    return generator;
  }

  [[nodiscard]] Integer minus_one() const {
    return std::visit([](const auto& ring) { return ring.to_integer(ring.from(std::int64_t{-1})); }, ring_);
  }

  /// The points of a cycle in order, in the file's numbers; none when it is not one simple loop.
  [[nodiscard]] std::vector<std::uint32_t> simple_loop(const CellChain& chain) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
    for (const auto& [coefficient, edge] : chain.terms) {
      if (coefficient != 1 && coefficient != minus_one()) {
        return {};
      }
      const auto [low, high] = ends(edge);
      neighbours[low].push_back(high);
      neighbours[high].push_back(low);
    }
    for (const auto& [point, others] : neighbours) {
      if (others.size() != 2) {
        return {};
      }
    }
    const std::uint32_t first = neighbours.begin()->first;
    std::vector<std::uint32_t> loop{in_file(first)};
    std::uint32_t before = first;
    for (std::uint32_t here = neighbours.at(first)[0]; here != first;) {
      loop.push_back(in_file(here));
      const auto& others = neighbours.at(here);
      before = std::exchange(here, others[0] == before ? others[1] : others[0]);
    }
    return loop.size() == neighbours.size() ? loop : std::vector<std::uint32_t>{};
  }

  [[nodiscard]] std::optional<CellChain> bounding(const MeshGenerator& generator) {
    CellChain multiple = generator.chain;
    for (auto& term : multiple.terms) {
      term.coefficient *= generator.order;
    }
    auto answer = engine_.classify(multiple);
    sparse::expects(answer.is_zero, "a torsion generator times its order is a boundary");
    return std::move(answer.bounds);
  }

  void measure_cycle(MeshGenerator& generator) const {
    start_box(generator.box);
    for (const auto& term : generator.chain.terms) {
      for (const auto end : ends(term.cell)) {
        extend(generator.box, triangles_.points[end]);
      }
    }
    const int exponent = binary_exponent(generator.box);
    double length = 0;
    Point moment{};
    for (const auto& [coefficient, edge] : generator.chain.terms) {
      const auto [a, b] = ends(edge);
      const Point p = scaled(triangles_.points[a], -exponent);
      const Point q = scaled(triangles_.points[b], -exponent);
      const double weight = times(coefficient) * std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
      length += weight;
      for (std::size_t i = 0; i < 3; ++i) {
        moment[i] += weight * std::midpoint(p[i], q[i]);
      }
    }
    generator.length = {length, exponent};
    place_centre(generator, moment, length, exponent);
  }

  /// How often a cell is in a chain; over Z/p, a coefficient and its negative count alike.
  [[nodiscard]] double times(const sparse::Rational& coefficient) const {
    const sparse::Rational size = sparse::abs(coefficient == minus_one() ? sparse::Rational{1} : coefficient);
    return static_cast<double>(size.to_int64().value_or(std::numeric_limits<std::int64_t>::max()));
  }

  [[nodiscard]] bool has_signs() const { return std::holds_alternative<Integers>(ring_) || is_rational(ring_); }

  // ---- H_2
  void add_surface(const engine::Generator& found) {
    MeshGenerator generator;
    generator.degree = 2;
    generator.order = found.order;
    generator.chain = found.cycle;
    generator.triangles = found.cycle.terms.size();
    start_box(generator.box);
    const Integer sign = orientation(found.cycle);
    for (auto& [coefficient, triangle] : generator.chain.terms) {
      if (sign != 1) {
        coefficient = coefficient * sign;
      }
      for (const auto corner : corners_of(triangle)) {
        extend(generator.box, triangles_.points[corner]);
      }
    }
    measure_surface(generator);
    if (has_signs()) {
      generator.volume = volume(generator);
    }
    result_.generators.push_back(std::move(generator));
  }

  /// Triangles of a concave polygon overlap, some of them turned over: each counts by its part of the area vector of
  /// the whole polygon.
  void measure_surface(MeshGenerator& generator) {
    const int exponent = binary_exponent(generator.box);
    std::unordered_map<std::uint32_t, Point> normal_of_face;
    for (const auto& term : generator.chain.terms) {
      const auto t = triangle_of_cell(term.cell);
      Point& sum = normal_of_face[face_of_triangle_[t]];
      const Point normal = normal_of(t, generator.box[0], exponent);
      for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += normal[i];
      }
    }
    double area = 0;
    Point moment{};
    for (const auto& term : generator.chain.terms) {
      const auto t = triangle_of_cell(term.cell);
      const Point normal = normal_of(t, generator.box[0], exponent);
      const double weight = times(term.coefficient) * part(normal, normal_of_face.at(face_of_triangle_[t])) / 2;
      area += weight;
      for (const Point& corner : corners_from(generator.box[0], triangles_.faces[t], exponent)) {
        for (std::size_t i = 0; i < 3; ++i) {
          moment[i] += weight * corner[i] / 3;
        }
      }
    }
    const Point origin = scaled(generator.box[0], -exponent);
    for (std::size_t i = 0; i < 3; ++i) {
      moment[i] += area * origin[i];
    }
    generator.area = {area, 2 * exponent};
    place_centre(generator, moment, area, exponent);
  }

  /// About the lowest corner of the box: far from the origin, volumes about the origin cancel badly.
  [[nodiscard]] Measure volume(const MeshGenerator& generator) const {
    const int exponent = binary_exponent(generator.box);
    double volume = 0;
    for (const auto& [coefficient, triangle] : generator.chain.terms) {
      const auto [a, b, c] = corners_from(generator.box[0], corners_of(triangle), exponent);
      volume += times(coefficient) * coefficient.sign() * dot(a, cross(b, c)) / 6;
    }
    return {volume, 3 * exponent};
  }

  /// Twice the area vector of a triangle, scaled by 2^-exponent.
  [[nodiscard]] Point normal_of(std::uint32_t triangle, const Point& origin, int exponent) const {
    const auto [a, b, c] = corners_from(origin, triangles_.faces[triangle], exponent);
    return cross(minus(b, a), minus(c, a));
  }

  /// The length of a vector along another; its own length when the other is nothing, but for rounding.
  static double part(const Point& normal, const Point& whole) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const double length_of_whole = std::hypot(whole[0], whole[1], whole[2]);
    return length_of_whole > 1e-9 * length ? dot(normal, whole) / length_of_whole : length;
  }

  /// 1 when the chain runs through its lowest triangle as the file does, else -1; 1 over Z/p.
  [[nodiscard]] Integer orientation(const CellChain& chain) {
    if (!has_signs()) {
      return 1;
    }
    const CellChain::Term* lowest = nullptr;
    std::uint32_t triangle = 0;
    for (const auto& term : chain.terms) {
      const std::uint32_t t = triangle_of_cell(term.cell);
      if (lowest == nullptr || t < triangle) {
        lowest = &term;
        triangle = t;
      }
    }
    const auto face = triangles_.faces[triangle];
    const bool is_even = (face[0] < face[1]) == ((face[1] < face[2]) == (face[0] < face[2]));
    return is_even == (lowest->coefficient.sign() > 0) ? 1 : -1;
  }

  // ---- cells and points
  [[nodiscard]] Edge ends(CellId edge) const {
    const auto faces = engine_.structure().cells().faces(edge);
    return {vertex_of_cell_.at(faces[1]), vertex_of_cell_.at(faces[0])};
  }
  [[nodiscard]] std::array<std::uint32_t, 3> corners_of(CellId triangle) const {
    const auto faces = engine_.structure().cells().faces(triangle);
    const auto [a, b] = ends(faces[2]);
    return {a, b, ends(faces[0])[1]};
  }
  [[nodiscard]] std::uint32_t triangle_of_cell(CellId cell_of_triangle) {
    if (triangle_of_cell_.empty()) {
      for (std::uint32_t t = 0; t < triangles_.faces.size(); ++t) {
        triangle_of_cell_.emplace(cell("f{}", t), t);
      }
    }
    return triangle_of_cell_.at(cell_of_triangle);
  }
  /// The corners as seen from a point, all scaled by 2^-exponent.
  [[nodiscard]] std::array<Point, 3> corners_from(const Point& origin, std::span<const std::uint32_t> corners,
                                                  int exponent) const {
    std::array<Point, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = minus(scaled(triangles_.points[corners[i]], -exponent), scaled(origin, -exponent));
    }
    return result;
  }
  [[nodiscard]] std::uint32_t in_file(std::uint32_t point) const {
    const auto& known = polygons_.point_in_file;
    if (point < known.size()) {
      return known[point];
    }
    return static_cast<std::uint32_t>(result_.validity.points_in_file + (point - known.size()));
  }

  static Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
  static double dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
  static Point cross(const Point& p, const Point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }
  static void start_box(std::array<Point, 2>& box) {
    constexpr double most = std::numeric_limits<double>::max();
    box = {Point{most, most, most}, Point{-most, -most, -most}};
  }
  static void extend(std::array<Point, 2>& box, const Point& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      box[0][i] = std::min(box[0][i], point[i]);
      box[1][i] = std::max(box[1][i], point[i]);
    }
  }
  /// The mean, which was computed scaled by 2^-exponent; where all weights are zero, the middle of the box.
  static void place_centre(MeshGenerator& generator, const Point& moment, double weight, int exponent) {
    const auto& [low, high] = generator.box;
    for (std::size_t i = 0; i < 3; ++i) {
      const double mean = std::ldexp(moment[i] / weight, exponent);
      generator.centre[i] = weight > 0 ? std::clamp(mean, low[i], high[i]) : std::midpoint(low[i], high[i]);
    }
  }

  const Normalised& polygons_;
  const Mesh& triangles_;
  const std::vector<std::uint32_t>& face_of_triangle_;
  const sparse::AnyRing& ring_;
  std::string name_;
  MeshHomology& result_;
  engine::Engine& engine_;
  std::vector<Edge> edges_;
  EdgeGraph graph_;
  std::vector<CellId> cell_of_edge_;
  std::unordered_map<CellId, std::uint32_t> vertex_of_cell_;
  std::unordered_map<CellId, std::uint32_t> triangle_of_cell_;
};

}  // namespace

Result<MeshHomology> mesh_homology(const Mesh& mesh, const MeshHomologyOptions& options) {
  MeshHomology result;
  result.validity = validate(mesh);
  const Normalised polygons = normalised(mesh);
  Triangulated triangles{polygons.mesh, {}};
  triangles.mesh.remarks.clear();
  triangles.face_of_triangle = triangulate(triangles.mesh, Polygons::fan);
  result.remarks = triangles.mesh.remarks;
  auto engine = build(triangles.mesh, options);
  if (!engine) {
    return engine.error();
  }
  result.engine = std::move(*engine);
  result.ring = options.ring;
  result.homology = result.engine->homology();
  if (is_rational(options.ring)) {
    for (auto& factors : result.homology.torsion) {
      factors.clear();
    }
  }
  if (options.generators) {
    Generators{polygons, triangles, options, result}.find();
  }
  return result;
}

}  // namespace sesame::tools
