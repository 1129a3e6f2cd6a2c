#include "tools/bench/scenarios.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "tools/bench/batch_scenarios.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/editing_scenarios.hpp"
#include "tools/bench/surface_count.hpp"
#include "tools/bench/torsion_scenarios.hpp"
#include "tools/bench/zigzag_scenarios.hpp"

namespace sesame::tools {
namespace {

using Size = std::uint64_t;
using AnswerAt = std::function<std::optional<Answer>(Size)>;

std::uint32_t small(Size size) { return static_cast<std::uint32_t>(size); }
std::int64_t whole(Size size) { return static_cast<std::int64_t>(size); }

AnswerAt always(Answer answer) {
  return [answer = std::move(answer)](Size) { return answer; };
}

std::int64_t binomial(std::int64_t n, std::int64_t k) {
  std::int64_t product = 1;
  for (std::int64_t i = 1; i <= k; ++i) {
    product = product * (n - k + i) / i;
  }
  return product;
}

std::vector<std::int64_t> binomials(Size n) {
  std::vector<std::int64_t> row;
  for (std::int64_t k = 0; k <= whole(n); ++k) {
    row.push_back(binomial(whole(n), k));
  }
  return row;
}

const Answer torus_groups{{1, 2, 1}};
const Answer klein_groups{{1, 1}, {{}, {2}}};
const Answer solid_torus_groups{{1, 3, 3, 1}};  // of the 3-torus

// ---- what is known on the way

using Follow = std::function<AnswerAfter(Size)>;
using Make = std::function<Operations(Size)>;

/// From counting: for surfaces.
Follow counted(const Make& make) {
  return [make](Size size) { return tools::counted(make(size)); };
}

/// What one function says at a step, whatever the size.
Follow by_step(std::function<Answer(std::size_t step)> answer) {
  return [answer = std::move(answer)](Size) { return answer; };
}

/// While pairs of triangles are made, three steps each, and then a place is glued and opened again, in turn.
Follow glued_in_turn(std::int64_t places) {
  return by_step([places](std::size_t step) -> Answer {
    const auto k = static_cast<std::int64_t>(step);
    if (k < 3 * places) {
      return {{k / 3 + (k % 3 == 1 ? 2 : 1)}};
    }
    return (k - 3 * places) % 2 == 0 ? Answer{{places, 1}} : Answer{{places}};
  });
}

/// While circles are made and multiplied: circle, circle, product, circle, product, ...
Answer multiplied(std::size_t step) {
  Answer answer{binomials((step + 2) / 2)};
  if (step % 2 == 1) {  // and one beside the product
    ++answer.betti[0];
    ++answer.betti[1];
  }
  return answer;
}

Answer sphere(std::size_t dimension) {
  Answer answer{{1}};
  answer.betti.resize(dimension + 1);
  ++answer.betti[dimension];
  return answer;
}

struct NamedOrder {
  std::string suffix, what;
  Assembly assembly;
};

const std::vector<NamedOrder>& orders() {
  static const std::vector<NamedOrder> all{
      {"inside-out", "breadth first", {Order::inside_out, 1}},
      {"random", "in random order", {Order::random, 1}},
      {"tiles-first", "all tiles, then all gluings in random order: the worst case", {Order::tiles_first, 1}}};
  return all;
}

/// An assembly in all orders; of surfaces, or of solids, which are not followed.
void add_assemblies(std::vector<Scenario>& list, Scenario base, bool is_surface,
                    const std::function<Operations(Size, const Assembly&)>& make) {
  const Scenario first = std::move(base);
  for (const auto& [suffix, what, assembly] : orders()) {
    Scenario scenario = first;
    scenario.name += "-" + suffix;
    scenario.what += ", " + what;
    const Make make_so = [make, assembly = assembly](Size size) { return make(size, assembly); };
    scenario.input = Construction{make_so, is_surface ? counted(make_so) : nullptr};
    list.push_back(std::move(scenario));
  }
}

void add_surfaces(std::vector<Scenario>& list) {
  add_assemblies(list,
                 {.name = "torus",
                  .family = "surfaces",
                  .what = "a torus of squares",
                  .size_name = "squares a side",
                  .size = 200,
                  .quick_size = 16,
                  .input = Construction{},
                  .answer = always(torus_groups)},
                 true, [](Size n, const Assembly& assembly) { return torus(small(n), assembly); });
  add_assemblies(list,
                 {.name = "klein-bottle",
                  .family = "surfaces",
                  .what = "a Klein bottle of triangles",
                  .size_name = "squares of two triangles a side",
                  .size = 150,
                  .quick_size = 12,
                  .input = Construction{},
                  .answer = always(klein_groups)},
                 true, [](Size n, const Assembly& assembly) { return klein_bottle(small(n), assembly); });
  add_assemblies(list,
                 {.name = "genus",
                  .family = "surfaces",
                  .what = "an orientable surface of triangles",
                  .size_name = "handles",
                  .size = 400,
                  .quick_size = 6,
                  .input = Construction{},
                  .answer =
                      [](Size genus) {
                        return Answer{{1, 2 * whole(genus), 1}};
                      }},
                 true,
                 [](Size genus, const Assembly& assembly) { return surface_of_genus(small(genus), 10, assembly); });
}

void add_solids(std::vector<Scenario>& list) {
  add_assemblies(list,
                 {.name = "3-torus",
                  .family = "solids",
                  .what = "a 3-torus of tetrahedra (Freudenthal)",
                  .size_name = "cubes of six tetrahedra a side",
                  .size = 20,
                  .quick_size = 4,
                  .input = Construction{},
                  .answer = always(solid_torus_groups)},
                 false, [](Size n, const Assembly& assembly) { return freudenthal_torus(small(n), assembly); });
  const auto tunnels = [](Size level) { return Answer{{1, menger_tunnels(static_cast<int>(level))}}; };
  for (const Size level : {Size{1}, Size{2}, Size{3}, Size{4}}) {
    const Size quick = level <= 2 ? level : 0;
    add_assemblies(list,
                   {.name = "menger-" + std::to_string(level),
                    .family = "solids",
                    .what = "Menger's sponge, cube by cube",
                    .size_name = "level",
                    .size = level,
                    .quick_size = quick,
                    .input = Construction{},
                    .answer = tunnels},
                   false,
                   [](Size n, const Assembly& assembly) { return menger_sponge(static_cast<int>(n), assembly); });
  }
}

/// Constructions of one family.
class Adder {
 public:
  Adder(std::vector<Scenario>& list, std::string family, bool all_methods)
      : list_{list}, family_{std::move(family)}, all_methods_{all_methods} {}

  struct Sizes {
    const char* name;
    Size usual, quick;
  };
  void operator()(const char* name, const char* what, Sizes sizes, Make make, AnswerAt answer, Follow follow = nullptr,
                  Size generators_every = 0) const {
    list_.push_back({name, family_, what, sizes.name, sizes.usual, sizes.quick,
                     Construction{std::move(make), std::move(follow), generators_every}, std::move(answer), "Z",
                     all_methods_});
  }

 private:
  std::vector<Scenario>& list_;
  std::string family_;
  bool all_methods_;
};

void add_repetitions(std::vector<Scenario>& list) {
  const Adder add(list, "again and again", true);
  add(
      "glue-and-split", "one place is glued and split again", {"gluings", 5'000, 500},
      [](Size n) { return glued_and_split(1, n); }, always({{1}}), glued_in_turn(1));
  const auto places = [](Size n) { return std::clamp<Size>(n / 10, 1, 1000); };
  add(
      "glue-and-split-1000", "a thousand places (or a tenth as many as gluings) are glued and split again, in turn",
      {"gluings", 1'000'000, 500}, [places](Size n) { return glued_and_split(small(places(n)), n); },
      [places](Size n) { return Answer{{whole(places(n))}}; },
      [places](Size n) { return glued_in_turn(whole(places(n)))(n); });
  add("glue-and-cut", "a square is glued to a torus and cut open again", {"gluings", 2'000, 100}, glued_and_cut_square,
      always({{1}}), by_step([](std::size_t step) { return step % 2 == 1 ? torus_groups : Answer{{1}}; }));
  add(
      "glue-and-undo", "four places are glued and the gluing is undone, in turn", {"gluings", 1'000'000, 500},
      [](Size n) { return glued_and_undone(4, n); }, always({{4}}), glued_in_turn(4));
  const auto torus_backwards = [](Size n) { return replayed_backwards(torus(small(n), {Order::random, 1})); };
  add("torus-backwards", "a torus of squares in random order, then taken back step by step",
      {"squares a side", 150, 12}, torus_backwards, always({}), counted(torus_backwards));
  add(
      "menger-backwards", "Menger's sponge, then taken back step by step", {"level", 3, 1},
      [](Size n) { return replayed_backwards(menger_sponge(static_cast<int>(n))); }, always({}));
}

void add_other_constructions(std::vector<Scenario>& list) {
  const Adder add(list, "complexes, cones, products", false);
  // With so many triangles there is no H_1, with overwhelming probability (R. Meshulam and N. Wallach, 2009).
  const auto half = [](Size n) { return static_cast<Size>(binomial(whole(n), 3) / 2); };
  add(
      "random-triangles", "all edges, then half of all triangles in random order", {"vertices", 60, 12},
      [half](Size n) { return random_triangles(small(n), half(n), 1); },
      [half](Size n) {
        return Answer{{1, 0, whole(half(n)) - binomial(whole(n) - 1, 2)}};
      });
  add(
      "cones", "cones over everything, one after the other", {"cones", 16, 8},
      [](Size n) { return iterated_cones(10, small(n)); }, always({{1}}),
      by_step([](std::size_t step) { return Answer{{step == 0 ? 10 : 1}}; }));
  add(
      "suspensions", "two points, suspended", {"dimension", 10, 6}, [](Size n) { return suspended_points(small(n)); },
      [](Size n) { return sphere(n); },
      by_step([](std::size_t step) { return step % 2 == 1 ? Answer{{1}} : sphere(step / 2); }));
  const Answer suspended_groups{{1, 0, 1}, {{}, {}, {2}}};
  add(
      "suspended-klein-bottle", "a Klein bottle of squares, suspended", {"squares a side", 100, 8},
      [](Size n) { return suspended_klein_bottle(small(n)); }, always(suspended_groups),
      [=](Size n) -> AnswerAfter {
        const std::size_t cone = klein_bottle(small(n)).size();
        const AnswerAfter surface = counted([](Size m) { return klein_bottle(small(m)); })(n);
        return [=](std::size_t step) -> std::optional<Answer> {
          return step < cone ? surface(step) : step == cone ? Answer{{1}} : suspended_groups;
        };
      });
  add(
      "product-of-circles", "the product of circles of a hundred edges", {"factors", 7, 4},
      [](Size n) { return product_of_circles(100, small(n)); }, [](Size n) { return Answer{binomials(n)}; },
      by_step(multiplied));
  add(
      "glued-product", "the product of three circles, then a gluing of vertices at each step", {"gluings", 2000, 50},
      [](Size n) { return glued_product_of_circles(small(n) + 1, 3, small(n)); },
      [](Size n) {
        return Answer{{1, 3 + whole(n), 3, 1}};
      },
      by_step([](std::size_t step) {
        return step < 5 ? multiplied(step) : Answer{{1, whole(step) - 1, 3, 1}};
      }));
}

void add_generators(std::vector<Scenario>& list) {
  const Adder add(list, "generators", false);
  const Make torus_of_squares = [](Size n) { return torus(small(n)); };
  add("generators-torus", "a torus, inside out; all generators every 500 steps", {"squares a side", 100, 16},
      torus_of_squares, always(torus_groups), counted(torus_of_squares), 500);
  add(
      "generators-menger", "Menger's sponge; all generators every 500 steps", {"level", 3, 2},
      [](Size n) { return menger_sponge(static_cast<int>(n)); },
      [](Size n) {
        return Answer{{1, menger_tunnels(static_cast<int>(n))}};
      },
      nullptr, 500);
}

/// Small enough for methods that look at the whole object at every step.
void add_comparisons(std::vector<Scenario>& list) {
  const Adder add(list, "methods", true);
  add(
      "methods-torus", "a torus of squares, breadth first", {"squares a side", 12, 4},
      [](Size n) { return torus(small(n)); }, always(torus_groups));
  add(
      "methods-klein-bottle", "a Klein bottle of triangles in random order", {"squares of two triangles a side", 8, 3},
      [](Size n) {
        return klein_bottle(small(n), {Order::random, 1});
      },
      always(klein_groups));
  add(
      "methods-3-torus", "a 3-torus of tetrahedra, breadth first", {"cubes of six tetrahedra a side", 3, 2},
      [](Size n) { return freudenthal_torus(small(n)); }, always(solid_torus_groups));
  add(
      "methods-menger", "Menger's sponge, cube by cube", {"level", 1, 1},
      [](Size n) { return menger_sponge(static_cast<int>(n)); },
      [](Size n) {
        return Answer{{1, menger_tunnels(static_cast<int>(n))}};
      });
  add(
      "methods-random-triangles", "all edges, then all triangles in random order", {"vertices", 14, 7},
      [](Size n) { return random_triangles(small(n), SIZE_MAX, 1); },
      [](Size n) {
        return Answer{{1, 0, binomial(whole(n) - 1, 3)}};
      });
}

// ---- filtrations and towers

/// Betti numbers that other programs found, by size: PHAT those of filtrations, GUDHI those of the complex that a tower
/// comes to.
AnswerAt recorded(std::map<Size, std::vector<std::int64_t>> betti) {
  return [betti = std::move(betti)](Size size) {
    const auto found = betti.find(size);
    return found == betti.end() ? std::nullopt : std::optional<Answer>{Answer{found->second}};
  };
}

void add_filtrations(std::vector<Scenario>& list) {
  const auto filtration = [&](const char* name, const char* what, const char* size_name, Size size, Size quick,
                              std::function<Filtration(Size)> make, AnswerAt answer) {
    list.push_back({name, "filtrations", what, size_name, size, quick, CellFiltration{std::move(make)},
                    std::move(answer), "Z/2", true});
  };
  filtration(
      "filtration-torus", "a torus of triangles, by its largest vertex", "vertices a side", 400, 16,
      [](Size n) { return torus_filtration(small(n)); }, always(torus_groups));
  filtration(
      "filtration-rips", "a Vietoris-Rips complex of random points, 2000 simplices a point", "points", 500, 20,
      [](Size n) { return rips_filtration(small(n), 2000 * n, 1); },
      recorded({{20, {1, 0, 0, 3876}}, {500, {1, 0, 0, 722624}}}));
  filtration(
      "filtration-cubical", "random values on a grid", "vertices a side", 60, 6,
      [](Size n) { return cubical_filtration(small(n), 0, 1); }, always({{1}}));
  filtration(
      "filtration-cubical-smooth", "smoothed random values on a grid", "vertices a side", 60, 6,
      [](Size n) { return cubical_filtration(small(n), 4, 1); }, always({{1}}));
  const auto half = [](Size n) { return static_cast<Size>(binomial(whole(n), 3) / 2); };
  filtration(
      "filtration-random-triangles", "all edges, then half of all triangles in random order", "vertices", 90, 14,
      [half](Size n) { return random_two_complex(small(n), half(n), 1); },
      [half](Size n) {
        return Answer{{1, 0, whole(half(n)) - binomial(whole(n) - 1, 2)}};
      });
}

void add_towers(std::vector<Scenario>& list) {
  const auto tower = [&](const char* name, const char* what, Size size, Size quick, const TowerOptions& options,
                         AnswerAt answer) {
    list.push_back(
        {name, "towers", what, "operations", size, quick, RandomTower{options}, std::move(answer), "Z/2", true});
  };
  tower("tower-A", "triangles on 100 vertices, a tenth contractions of edges", 20'000, 500, {0, 100, 2, 0.1, true, 1},
        recorded({{500, {35, 17, 5}}, {20'000, {9, 91, 52}}}));
  tower("tower-B", "tetrahedra on 1000 vertices, one in twenty a contraction of an edge", 20'000, 500,
        {0, 1000, 3, 0.05, true, 1}, recorded({{500, {21, 71, 1}}, {20'000, {83, 2400, 369, 100}}}));
  tower("tower-C", "tetrahedra on 300 vertices, one in twenty a contraction of any two vertices", 20'000, 500,
        {0, 300, 3, 0.05, false, 1}, recorded({{500, {11, 103, 0, 7}}, {20'000, {24, 1201, 1799, 512}}}));
  tower("tower-D", "tetrahedra on 300 vertices, one in twenty a contraction of an edge", 200'000, 500,
        {0, 300, 3, 0.05, true, 1}, recorded({{500, {21, 71, 1}}, {200'000, {28, 501, 189, 157}}}));
}

}  // namespace

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = [] {
    std::vector<Scenario> list;
    add_surfaces(list);
    add_solids(list);
    add_repetitions(list);
    add_editing(list);
    add_other_constructions(list);
    add_batches(list);
    add_torsion(list);
    add_generators(list);
    add_comparisons(list);
    add_filtrations(list);
    add_towers(list);
    add_zigzags(list);
    return list;
  }();
  return all;
}

}  // namespace sesame::tools
