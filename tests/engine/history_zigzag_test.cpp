// The barcode of a history in which cells are split and taken away, beside ranks of all composed relations.
#include "engine/history_zigzag.hpp"

#include <map>
#include <string>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/plain_relations.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using sparse::Integers;

/// A map of chains between the cells of two moments, by the exact sequence of a step.
PlainRows rows_of(const sparse::Matrix<Integers>& map, const std::vector<ops::CellId>& from,
                  const std::vector<ops::CellId>& to, const ops::CellBasis& rows_now, int degree,
                  const std::vector<ops::CellId>& columns_now, const PlainField& field) {
  std::map<ops::CellId, PlainVector> image;
  for (sparse::Index k = 0; k < columns_now.size(); ++k) {
    PlainVector row(to.size(), 0);
    map.for_each_in_column(k, [&](const auto& term) {
      const ops::CellId cell = rows_now.generators(static_cast<std::size_t>(degree))[term.index];
      row[static_cast<std::size_t>(std::find(to.begin(), to.end(), cell) - to.begin())] =
          field.reduced(term.coefficient.to_int64().value());
    });
    image[columns_now[k]] = row;
  }
  PlainRows rows;
  for (const ops::CellId cell : from) {
    rows.push_back(image.at(cell));
  }
  return rows;
}

/// The spaces and maps of a history, each from scratch.
class PlainHistory {
 public:
  explicit PlainHistory(std::int64_t p) : field_{p} {}

  void add(Engine& engine, const engine::StepReport& report) {
    const ops::Structure& structure = engine.structure();
    Step step{report.step,
              report.kind == ops::StepKind::split || report.kind == ops::StepKind::deletion,
              ops::cells_at(structure, report.after),
              {},
              {}};
    const auto complex = ops::chain_complex(structure, step.basis, report.after, Integers{});
    const auto boundary = [&](int degree) {
      PlainRows rows;
      for (const ops::CellId cell : step.basis.generators(static_cast<std::size_t>(degree))) {
        PlainVector row(degree > 0 ? step.basis.generators(static_cast<std::size_t>(degree - 1)).size() : 0, 0);
        if (degree > 0) {
          complex.boundary(degree).for_each_in_column(step.basis.index(cell), [&](const auto& term) {
            row[term.index] = field_.reduced(term.coefficient.to_int64().value());
          });
        }
        rows.push_back(row);
      }
      return rows;
    };
    const auto sequence = only(ops::step_sequences(structure, report.kind, report.before, report.after, Integers{}));
    for (int degree = 0; degree < dimensions; ++degree) {
      const auto d = static_cast<std::size_t>(degree);
      step.groups.emplace_back(boundary(degree), d > 0 ? step.basis.generators(d - 1).size() : 0, boundary(degree + 1),
                               field_);
      if (!steps_.empty()) {
        const Step& before = steps_.back();
        const Step& source = step.is_backward ? step : before;
        const Step& target = step.is_backward ? before : step;
        const PlainRows cells =
            cell_map(sequence, report.kind, source.basis.generators(d), target.basis.generators(d), degree);
        PlainRows images;
        const PlainGroup& to = step.is_backward ? before.groups[d] : step.groups[d];
        const PlainGroup& from = step.is_backward ? step.groups[d] : before.groups[d];
        for (const PlainVector& cycle : from.classes) {
          PlainVector image(target.basis.generators(d).size(), 0);
          for (std::size_t k = 0; k < cycle.size(); ++k) {
            field_.add(image, cells[k], cycle[k]);
          }
          images.push_back(to.class_of(image, field_));
        }
        step.maps.push_back(images);
      } else {
        step.maps.emplace_back();
      }
    }
    steps_.push_back(std::move(step));
  }
  void take_back(std::uint64_t steps) { steps_.erase(steps_.end() - static_cast<std::ptrdiff_t>(steps), steps_.end()); }

  [[nodiscard]] std::vector<engine::Bar> bars() const {
    std::vector<engine::Bar> bars;
    for (std::size_t d = 0; d < dimensions; ++d) {
      std::vector<std::size_t> sizes;
      std::vector<PlainRows> maps;
      std::vector<bool> is_backward;
      for (const Step& step : steps_) {
        sizes.push_back(step.groups[d].classes.size());
        maps.push_back(step.maps[d]);
        is_backward.push_back(step.is_backward);
      }
      for (const auto& [dimension, birth, death] :
           plain_bars_of_maps(static_cast<int>(d), sizes, maps, is_backward, field_)) {
        const auto time = [&](std::int64_t k) { return engine::Time{steps_[static_cast<std::size_t>(k)].number}; };
        bars.push_back({dimension, time(birth), death < 0 ? engine::never : time(death)});
      }
    }
    std::sort(bars.begin(), bars.end());
    return bars;
  }

 private:
  static constexpr int dimensions = 4;
  struct Step {
    std::uint64_t number;
    bool is_backward;
    ops::CellBasis basis;
    std::vector<PlainGroup> groups;  ///< by degree
    std::vector<PlainRows> maps;     ///< from the step before to this one, or back
  };

  PlainRows cell_map(const std::optional<ops::StepSequence<Integers>>& sequence, ops::StepKind kind,
                     const std::vector<ops::CellId>& from, const std::vector<ops::CellId>& to, int degree) const {
    const auto d = static_cast<std::size_t>(degree);
    if (!sequence) {
      PlainRows identity(from.size(), PlainVector(to.size(), 0));
      for (std::size_t k = 0; k < from.size(); ++k) {
        identity[k][k] = 1;
      }
      return identity;
    }
    const bool is_quotient = kind == ops::StepKind::removal || kind == ops::StepKind::split;
    const auto& map = is_quotient ? sequence->sequence.j : sequence->sequence.i;
    const ops::CellBasis& columns = is_quotient ? sequence->basis1 : sequence->basis0;
    const ops::CellBasis& rows = is_quotient ? sequence->basis2 : sequence->basis1;
    return rows_of(map.at(degree), from, to, rows, degree, columns.generators(d), field_);
  }

  PlainField field_;
  std::vector<Step> steps_;
};

std::vector<engine::Bar> bars_of(Engine& engine) {
  const auto barcode = engine.barcode();
  REQUIRE(barcode);
  return barcode->bars;
}

}  // namespace

TEST_CASE("the barcode of a history with splits and removals is that of its maps, by ranks over all intervals",
          "[engine][zigzag]") {
  const std::int64_t p = GENERATE(2, 3);
  const unsigned seed = GENERATE(range(0U, 40U));
  CAPTURE(p, seed);
  Engine engine(ring_named(p == 2 ? "Z/2" : "Z/3"));
  StreamShape shape = everything(25);
  shape.products = shape.pyramids = false;
  shape.replacements = false;  // they are two maps: see replacement_test.cpp
  RandomSteps random(seed, shape);
  PlainHistory plain(p);
  for (int k = 0; k < 24; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    plain.add(engine, carry_out(engine, op));
    if (random.random().one_in(8)) {
      const std::uint64_t steps = std::min<std::uint64_t>(engine.undoable(), 2);
      REQUIRE(engine.undo(steps));
      plain.take_back(steps);
    }
  }
  CHECK(bars_of(engine) == plain.bars());
}

TEST_CASE("a circle that is cut and glued again is two bars, and a split point one of each", "[engine][zigzag]") {
  Engine engine(ring_named("Q"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                 R"({"op":"note","text":"a circle"})",
                 R"({"op":"deidentify","split":[{"cell":"e.0","as":"w","moves":[["e",0]]}]})",
                 R"({"op":"identify","pairs":[["e.0","w"]]})", R"({"op":"remove","cells":["e"]})"});
  // The loop lives until the cut, and another one until the edge goes.
  CHECK(bars_of(engine) == std::vector<engine::Bar>{{0, engine::Time{1U}, engine::never},
                                                    {1, engine::Time{2U}, engine::Time{4U}},
                                                    {1, engine::Time{5U}, engine::Time{6U}}});
}

TEST_CASE("without splits and removals the two ways to a barcode agree", "[engine][zigzag]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Engine engine(ring_named("Z/3"));
  StreamShape shape = everything(40);
  shape.products = shape.pyramids = shape.splits = shape.removals = false;
  RandomSteps random(seed, shape);
  std::vector<engine::NumberedStep> steps;
  for (std::uint64_t k = 1; k <= 40; ++k) {
    steps.push_back({k, random.next(engine.structure())});
    carry_out(engine, steps.back().operation);
  }
  const auto zigzag = engine::barcode_of_history(engine.ring(), {}, {}, steps);
  REQUIRE(zigzag);
  CHECK(zigzag->bars == bars_of(engine));
}

TEST_CASE("what has no barcode says why, and at which step", "[engine][zigzag]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"remove","cells":["f"]})", R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const auto barcode = engine.barcode();
  REQUIRE(!barcode);
  CHECK(barcode.error().what == "there is no barcode: step 4 is a product, which consumes the bodies before it");
  Engine integral(ring_named("Z"));
  build(integral, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"remove","cells":["e"]})"});
  CHECK(integral.barcode().error().what == "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z");
}
