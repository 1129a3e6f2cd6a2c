// The cycles of the bars of a history: interval decompositions, by dense linear algebra on objects made anew.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/history_audit.hpp"
#include "engine/history_maps.hpp"
#include "engine/history_zigzag.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/plain_history.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// A bar with its cycles.
struct ToldBar {
  engine::Bar bar;
  std::vector<engine::NamedCycle> cycles;
};

engine::HistoryOptions telling(std::vector<ToldBar>& told) {
  engine::HistoryOptions options;
  options.wants = [](int) { return true; };
  options.on_cycles = [&told](const engine::Bar& bar, const engine::HistoryOptions::Cycles& cycles) {
    told.push_back({bar, cycles()});
  };
  return options;
}

/// The cycles that are told of a history, sorted by their bars, which are those of the barcode.
std::vector<ToldBar> cycles_of(Engine& engine) {
  std::vector<ToldBar> told;
  const auto barcode = engine.barcode(telling(told));
  REQUIRE((barcode ? "" : barcode.error().what) == "");
  std::stable_sort(told.begin(), told.end(), [](const ToldBar& a, const ToldBar& b) { return a.bar < b.bar; });
  std::vector<engine::Bar> bars;
  for (const ToldBar& each : told) {
    bars.push_back(each.bar);
  }
  REQUIRE(bars == barcode->bars);
  return told;
}

std::size_t number(engine::Time time) { return static_cast<std::size_t>(time.nearest()); }

/// Does the steps of a history again, with replacements in their halves, and looks at what is told of its bars after
/// each.
class CycleCheck {
 public:
  CycleCheck(const AnyRing& ring, std::int64_t p, std::vector<ToldBar> told)
      : engine_{ring}, history_{p}, told_{std::move(told)}, at_(told_.size(), 0), vectors_(told_.size()) {
    for (const ToldBar& each : told_) {
      REQUIRE(each.cycles.front().from == each.bar.birth);
      REQUIRE(each.cycles.back().from < each.bar.death);
      for (std::size_t k = 1; k < each.cycles.size(); ++k) {
        REQUIRE(each.cycles[k - 1].from < each.cycles[k].from);
        REQUIRE(each.cycles[k - 1].cycle != each.cycles[k].cycle);
        ++changes_;
      }
    }
  }

  void add(const engine::NumberedStep& step) {
    CAPTURE(step.number, ops::to_text(step.operation));
    std::vector<ops::Operation> maps = engine::maps_of(step.operation);
    for (const ops::Operation& map : maps) {
      history_.add(engine_, carry_out(engine_, map));
    }
    for (std::size_t k = 0; k < told_.size(); ++k) {
      const PlainVector before = std::exchange(vectors_[k], cycle_now(k, step.number));
      CAPTURE(told_[k].bar.dimension, number(told_[k].bar.birth));
      if (maps.size() == 2) {
        REQUIRE(told_[k].bar.birth != engine::Time{step.number});
        REQUIRE(told_[k].bar.death != engine::Time{step.number});
        check_replacement(k, before);
      } else if (history_.steps().size() > 1) {
        check_map(k, before, step.number);
      }
    }
    check_basis();
  }
  [[nodiscard]] std::size_t changes() const { return changes_; }

 private:
  using Step = PlainHistory::Step;

  [[nodiscard]] const Step& now() const { return history_.steps().back(); }
  [[nodiscard]] std::size_t degree(std::size_t k) const { return static_cast<std::size_t>(told_[k].bar.dimension); }
  [[nodiscard]] bool is_alive(std::size_t k, std::uint64_t step) const {
    return told_[k].bar.birth <= engine::Time{step} && engine::Time{step} < told_[k].bar.death;
  }
  /// In the cells that there are, by the names that are told; nothing when the bar is not alive.
  PlainVector cycle_now(std::size_t k, std::uint64_t step) {
    if (!is_alive(k, step)) {
      return {};
    }
    const std::vector<engine::NamedCycle>& cycles = told_[k].cycles;
    if (at_[k] + 1 < cycles.size() && cycles[at_[k] + 1].from == engine::Time{step}) {
      ++at_[k];
    }
    const bool is_first = cycles[at_[k]].from == engine::Time{step};
    const ops::Directory& directory = engine_.structure().directory();
    PlainVector vector(now().basis.generators(degree(k)).size(), 0);
    for (const auto& [coefficient, name] : cycles[at_[k]].cycle.terms) {
      const auto chain = engine_.chain({{1, name}});
      REQUIRE((chain ? "" : chain.error().what) == "");
      REQUIRE(chain->degree == told_[k].bar.dimension);
      const auto& [sign, cell] = chain->terms.at(0);
      REQUIRE((!is_first || directory.name(cell) == name));
      const PlainField& field = history_.field();
      const std::int64_t numerator = coefficient.numerator().to_int64().value();
      const std::int64_t denominator = field.reduced(coefficient.denominator().to_int64().value());
      const std::int64_t own = sign == sparse::Rational{1} ? 1 : -1;
      std::int64_t& entry = vector[now().basis.index(cell)];
      REQUIRE(entry == 0);
      entry = field.reduced(numerator * field.inverse(denominator) * own * directory.sign_of_name(cell));
      REQUIRE(entry != 0);
    }
    return vector;
  }
  /// The image under the map to a step, or from it.
  [[nodiscard]] PlainVector sent(const PlainVector& vector, const Step& map, std::size_t d, std::size_t size) const {
    PlainVector image(size, 0);
    for (std::size_t k = 0; k < vector.size(); ++k) {
      history_.field().add(image, map.cells[d][k], vector[k]);
    }
    return image;
  }
  [[nodiscard]] PlainVector class_in(const Step& step, std::size_t d, PlainVector vector) const {
    vector.resize(step.basis.generators(d).size(), 0);
    return step.groups[d].class_of(vector, history_.field());
  }
  void check_map(std::size_t k, const PlainVector& before, std::uint64_t step) {
    const std::size_t d = degree(k);
    const Step& past = history_.steps()[history_.steps().size() - 2];
    const bool leads_out =
        now().is_backward ? told_[k].bar.death == engine::Time{step} : told_[k].bar.birth == engine::Time{step};
    if (leads_out) {
      return;
    }
    const Step& target = now().is_backward ? past : now();
    const PlainVector& from = now().is_backward ? vectors_[k] : before;
    const PlainVector& to = now().is_backward ? before : vectors_[k];
    const PlainVector image = sent(from, now(), d, target.basis.generators(d).size());
    REQUIRE(class_in(target, d, image) == class_in(target, d, to));
  }
  /// Both are included into the object with the cells of both.
  void check_replacement(std::size_t k, const PlainVector& before) {
    const std::size_t d = degree(k);
    const Step& both = history_.steps()[history_.steps().size() - 2];
    const std::size_t size = both.basis.generators(d).size();
    const PlainVector old = sent(before, both, d, size), young = sent(vectors_[k], now(), d, size);
    REQUIRE(class_in(both, d, old) == class_in(both, d, young));
  }
  void check_basis() {
    for (std::size_t d = 0; d < PlainHistory::dimensions; ++d) {
      PlainRows classes;
      for (std::size_t k = 0; k < told_.size(); ++k) {
        if (degree(k) == d && !vectors_[k].empty()) {
          classes.push_back(class_in(now(), d, vectors_[k]));
        }
      }
      REQUIRE(classes.size() == now().groups[d].classes.size());
      REQUIRE(history_.field().rank(classes) == classes.size());
    }
  }

  Engine engine_;
  PlainHistory history_;
  std::vector<ToldBar> told_;
  std::vector<std::size_t> at_;
  std::vector<PlainVector> vectors_;  ///< per bar
  std::size_t changes_ = 0;
};

/// Glues two edges the wrong way round, or does nothing where that is not possible.
std::optional<ops::Operation> reversed_gluing(Engine& engine, Random& random) {
  std::vector<std::string> edges;
  for (const ops::CellId cell : current_cells(engine.structure())) {
    if (engine.structure().dimension(cell) == 1) {
      edges.push_back(engine.structure().name(cell));
    }
  }
  if (edges.empty()) {
    return std::nullopt;
  }
  const std::string& one = edges[static_cast<std::size_t>(random.in(0, static_cast<int>(edges.size()) - 1))];
  const std::string& other = edges[static_cast<std::size_t>(random.in(0, static_cast<int>(edges.size()) - 1))];
  const ops::Operation op = operation(R"({"op":"identify","pairs":[[")" + one + R"(",")" + other + R"(",[1,0]]]})");
  return engine.apply(op) ? std::optional{op} : std::nullopt;
}

/// A random history with steps that are undone. Returns those that are not.
std::vector<engine::NumberedStep> random_history(Engine& engine, unsigned seed, const StreamShape& shape, int length) {
  RandomSteps random(seed, shape);
  std::vector<engine::NumberedStep> steps;
  std::uint64_t number = 0;
  for (int k = 0; k < length; ++k) {
    const ops::Operation op = random.next(engine.structure());
    carry_out(engine, op);
    steps.push_back({++number, op});
    if (random.random().one_in(6)) {
      if (const auto reversed = reversed_gluing(engine, random.random())) {
        steps.push_back({++number, *reversed});
      }
    }
    if (random.random().one_in(10)) {
      const std::uint64_t undone = std::min<std::uint64_t>(steps.size(), 2);
      carry_out(engine, ops::Undo{undone});
      ++number;
      steps.erase(steps.end() - static_cast<std::ptrdiff_t>(undone), steps.end());
    }
  }
  return steps;
}

StreamShape shape_of(unsigned seed) {
  StreamShape shape = everything(14 + seed % 12);
  shape.products = shape.pyramids = false;
  shape.degeneracies = seed % 3 != 0;
  return shape;
}

/// Returns how often a cycle has changed.
std::size_t check_history(const char* ring, std::int64_t p, unsigned seed, const StreamShape& shape, int length) {
  CAPTURE(ring, seed);
  Engine engine(ring_named(ring));
  const std::vector<engine::NumberedStep> steps = random_history(engine, seed, shape, length);
  CycleCheck check(engine.ring(), p, cycles_of(engine));
  for (const engine::NumberedStep& step : steps) {
    check.add(step);
  }
  engine::HistoryOptions options;
  options.verifies = true;
  const auto verified = engine.barcode(options);
  REQUIRE((verified ? "" : verified.error().what) == "");
  return check.changes();
}

constexpr std::int64_t large_prime = 103;  // a fraction that is wrong is so modulo it, too, almost certainly

/// What is told of the bars of a degree, a line each.
std::string text_of(Engine& engine, int degree) {
  std::string text;
  for (const ToldBar& each : cycles_of(engine)) {
    if (each.bar.dimension != degree) {
      continue;
    }
    const bool is_open = each.bar.death == engine::never;
    text += std::to_string(number(each.bar.birth)) + "-" + (is_open ? "" : std::to_string(number(each.bar.death)));
    for (const engine::NamedCycle& cycle : each.cycles) {
      text += " " + std::to_string(number(cycle.from)) + ":";
      for (const auto& [coefficient, name] : cycle.cycle.terms) {
        text += " " + (coefficient == 1 ? "" : coefficient.to_string() + "*") + name;
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("the cycles of the bars of random histories are interval decompositions", "[engine][zigzag]") {
  std::size_t changes = 0;
  for (unsigned seed = 0; seed < 70; ++seed) {
    changes += check_history("Z/2", 2, seed, shape_of(seed), 22);
    changes += check_history("Z/3", 3, seed + 1000, shape_of(seed), 22);
    changes += check_history("Q", large_prime, seed + 2000, shape_of(seed), 22);
  }
  CHECK(changes > 300);
}

TEST_CASE("the cycles of the bars of a longer history are an interval decomposition", "[engine][zigzag]") {
  const unsigned seed = GENERATE(range(0U, 6U));
  StreamShape shape = shape_of(seed);
  shape.most_cells = 20;
  CHECK(check_history(seed % 2 == 0 ? "Z/3" : "Q", seed % 2 == 0 ? 3 : large_prime, seed, shape, 120) > 5);
}

TEST_CASE("a cycle stays as it is, to the letter, while its cells do", "[engine][zigzag]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"remove","cells":["t"]})",
                 R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","t.0"],["e.1","t.1"]]})",
                 R"({"op":"remove","cells":["e"]})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"identify","pairs":[["f","t.0-1"]]})", R"({"op":"remove","cells":["t.1-2"]})"});
  CHECK(text_of(engine, 1) == "2-8 2: t.0-1 t.0-2 t.1-2\n4-5 4: t.0-1 e\n");
}

TEST_CASE("a split gives a loop another way, and a cycle the copies", "[engine][zigzag]") {
  Engine engine(ring_named("Q"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                 R"({"op":"simplex","name":"f","dim":1})", R"({"op":"identify","pairs":[["f.0","e.0"],["f.1","e.0"]]})",
                 R"({"op":"deidentify","split":[{"cell":"e.0","as":"w","moves":[["e",0],["f",0]]}]})"});
  // e and f were loops; now they are arcs, and together they are one.
  CHECK(text_of(engine, 1) == "2-5 2: e\n4- 4: -1*e f\n");
}

TEST_CASE("the name of a copy stands for the orientation of the name that it is a copy of", "[engine][zigzag]") {
  Engine engine(ring_named("Q"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"identify","pairs":[["e","f",[1,0]]]})",
                 R"({"op":"deidentify","split":[{"cell":"f","as":"w","moves":[]}]})"});
  CHECK(text_of(engine, 1) == "4- 4: -1*e -1*w\n");
}

TEST_CASE("what is asked of some dimensions is told of these, and a stop ends it", "[engine][zigzag]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"remove","cells":["t"]})",
                 R"({"op":"remove","cells":["t.0-1"]})"});
  std::vector<ToldBar> told;
  engine::HistoryOptions options = telling(told);
  options.wants = [](int dimension) { return dimension == 1; };
  REQUIRE(engine.barcode(options));
  REQUIRE(told.size() == 1);
  CHECK(told[0].bar == engine::Bar{1, engine::Time{2}, engine::Time{3}});

  told.clear();
  std::atomic<bool> stop = false;
  std::uint64_t last = 99;
  options.stop = &stop;
  options.stopped_after = &last;
  REQUIRE(engine.barcode(options));
  CHECK(last == 99);
  stop = true;
  const auto barcode = engine.barcode(options);
  REQUIRE(barcode);
  CHECK((barcode->bars.empty() && last == 0));
}

TEST_CASE("an engine without a log has no cycles of bars, and there are none over the integers", "[engine][zigzag]") {
  engine::HistoryOptions options;
  options.wants = [](int) { return true; };
  Engine engine(ring_named("Z/2"), {}, {}, {UINT64_MAX, false});
  carry_out(engine, R"({"op":"simplex","name":"t","dim":2})");
  REQUIRE(engine.barcode());
  CHECK(engine.barcode(options).error().what == "there are no cycles of bars: the steps are not kept");
  Engine integral(ring_named("Z"));
  CHECK(integral.barcode(options).error().what ==
        "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z");
}

TEST_CASE("what is wrong with the chains of bars is found by boundary matrices", "[engine][zigzag]") {
  // An edge that becomes a loop, and another one beside it that goes.
  const sparse::Zp ring = std::get<sparse::Zp>(ring_named("Z/3"));
  Engine engine(ring);
  std::vector<engine::HistoryMap> maps;
  const std::vector<std::string> lines{R"({"op":"simplex","name":"e","dim":1})",
                                       R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                                       R"({"op":"simplex","name":"f","dim":0})", R"({"op":"remove","cells":["f"]})"};
  for (const std::string& line : lines) {
    const auto report = carry_out(engine, line);
    maps.push_back({report.step, report.kind, report.before, report.after});
  }
  using Bars = std::vector<engine::ChainBar<sparse::Zp>>;
  using Chain = sparse::Terms<sparse::Zp, ops::CellId>;
  const auto chain = [&](const char* name, std::uint32_t factor = 1) {
    return Chain{{*engine.structure().lookup(name), factor}};
  };
  const ops::CellId loop = *engine.structure().lookup("e");
  const ops::CellId kept = engine.structure().find(*engine.structure().lookup("e.0"));
  const Bars right{{0, 0, UINT64_MAX, {{0, Chain{{kept, 1}}}}},
                   {1, 1, UINT64_MAX, {{1, Chain{{loop, 1}}}}},
                   {0, 2, 3, {{2, chain("f", 2)}}}};
  const auto defect = [&](const Bars& bars) { return engine::first_wrong_bar(ring, engine.structure(), maps, bars); };
  CHECK(defect(right) == std::nullopt);
  const auto with = [&](auto&& change) {
    Bars bars = right;
    change(bars);
    return defect(bars).value_or("");
  };
  CHECK(with([](Bars& bars) { bars.pop_back(); }) == "after step 3 there are 1 bars of H0, and its Betti number is 2");
  CHECK(with([&](Bars& bars) { bars[2].death = UINT64_MAX; }) ==
        "at step 4 the cycle of the bar of H0 that step 3 begins has a cell that is not there");
  CHECK(with([&](Bars& bars) {
          bars[2].pieces[0].chain = Chain{{kept, 1}};
        }) == "at step 3 the cycle of the bar of H0 that step 3 begins depends on others");
  CHECK(with([&](Bars& bars) { bars[1].birth = bars[1].pieces[0].from = 0; }) ==
        "at step 1 the cycle of the bar of H1 that step 1 begins is no cycle");
  CHECK(with([&](Bars& bars) {
          bars[1].pieces.push_back({2, Chain{{loop, 2}}});
        }) == "at step 3 the cycle of the bar of H1 that step 2 begins is not sent to what comes next");
  CHECK(with([](Bars& bars) { bars[1].death = 3; }) != "");
}
