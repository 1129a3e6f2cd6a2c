// The explicit pipeline as oracle: each step's exact sequence and the theorem on effective exact sequences, with every
// map a matrix, beside the live form.
#include "reductions/elimination.hpp"
#include "reductions/exact_sequence.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::equivalence_of;
using reductions::trivial_equivalence;

namespace {

/// The equivalence with the generators of its object put into another order.
template <Ring R>
Equivalence<R> reordered(const Equivalence<R>& equivalence, const ops::CellBasis& from, const ops::CellBasis& to) {
  const ChainComplex<R>& object = equivalence.object();
  const R& ring = object.ring();
  std::vector<Matrix<R>> there;
  std::vector<Matrix<R>> back;
  for (std::size_t p = 0; p < object.sizes().size(); ++p) {
    there.emplace_back(ring, object.sizes()[p], object.sizes()[p]);
    back.emplace_back(ring, object.sizes()[p], object.sizes()[p]);
    for (Index k = 0; k < object.sizes()[p]; ++k) {
      const Index at = to.index(from.generators()[p][k]);
      there[p].set_column(k, Terms<R>{{at, ring.one()}});
      back[p].set_column(at, Terms<R>{{k, ring.one()}});
    }
  }
  const auto& sizes = object.sizes();
  return {
      compose(equivalence.left, reductions::isomorphism(object, GradedMap<R>(ring, 0, sizes, sizes, std::move(there)),
                                                        GradedMap<R>(ring, 0, sizes, sizes, std::move(back)))),
      equivalence.right};
}

/// Carries an equivalence along with the steps of an engine, by the theorem alone.
template <Ring R>
class Pipeline {
 public:
  explicit Pipeline(R ring)
      : ring_{ring}, equivalence_{trivial_equivalence(ChainComplex<R>::with_zero_boundary(ring, {}))} {}

  void follow(const ops::StepSequence<R>& step) {
    const auto& sequence = step.sequence;
    if (step.direction == ops::Direction::forward) {
      const auto before = reordered(equivalence_, basis_, step.basis1);
      REQUIRE(before.object() == sequence.c1);
      equivalence_ = forward(sequence, trivial_equivalence(sequence.c0), before);
      basis_ = step.basis2;
    } else {
      REQUIRE(equivalence_.object() == sequence.c0);
      auto after = backward(sequence, equivalence_, trivial_equivalence(sequence.c2));
      REQUIRE(after);
      equivalence_ = std::move(*after);
      basis_ = step.basis1;
    }
    equivalence_ = shrink(equivalence_, reductions::reduce(equivalence_.small()));
  }
  const Equivalence<R>& equivalence() const { return equivalence_; }

 private:
  R ring_;
  Equivalence<R> equivalence_;
  ops::CellBasis basis_;
};

template <Ring R>
std::vector<AbelianGroup> groups_of(const ChainComplex<R>& complex) {
  std::vector<AbelianGroup> groups = reductions::homology_groups(complex);
  while (!groups.empty() && groups.back().is_trivial()) {
    groups.pop_back();
  }
  return groups;
}

}  // namespace

TEMPLATE_TEST_CASE("the live form is the pipeline of exact sequences, step by step", "[engine][stream]", Integers, Z2,
                   Zp) {
  const auto ring = test_ring<TestType>();
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Engine engine(AnyRing{ring}, {}, taking_splits_in);
  Pipeline<TestType> pipeline(ring);
  RandomSteps random(seed, {.most_cells = 50, .simploids = true, .cones = true});
  for (int k = 0; k < 24; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    const engine::StepReport report = carry_out(engine, op);
    const auto step = only(engine.sequences(engine.undoable(), ring));
    REQUIRE(step.has_value() == report.sequence.has_value());
    if (!step) {
      continue;
    }
    pipeline.follow(*step);
    REQUIRE(defect_of(pipeline.equivalence()) == "");
    REQUIRE(groups_of(pipeline.equivalence().small()) == live_groups(engine));
    // The same big complex, up to the order of its generators and their signs; the same object.
    REQUIRE(pipeline.equivalence().big().sizes() == reductions::trimmed(engine.homology().big));
    const auto live = engine.template live<TestType>()->matrices();
    REQUIRE(live.object() == pipeline.equivalence().object());
    REQUIRE(groups_of(live.big()) == groups_of(pipeline.equivalence().big()));
    if (TestType::is_field) {
      REQUIRE(pipeline.equivalence().small().sizes() == live.small().sizes());
    }
  }
}

TEMPLATE_TEST_CASE("the class of a cell's boundary chain is the same by the pipeline's F and the live one",
                   "[engine][stream]", Integers, Z2, Zp) {
  // Both F are chain maps to models of the same homology; a cycle is a boundary for both or for none.
  const auto ring = test_ring<TestType>();
  const unsigned seed = GENERATE(range(100U, 120U));
  CAPTURE(seed);
  Engine engine(AnyRing{ring}, {}, taking_splits_in);
  Pipeline<TestType> pipeline(ring);
  RandomSteps random(seed, {.most_cells = 50, .simploids = true, .cones = true});
  for (int k = 0; k < 24; ++k) {
    carry_out(engine, random.next(engine.structure()));
    if (const auto step = only(engine.sequences(engine.undoable(), ring))) {
      pipeline.follow(*step);
    }
  }
  const ops::CellBasis basis = ops::cells_at(engine.structure(), ops::now(engine.structure()));
  const auto homology = reductions::homology(pipeline.equivalence().object());
  for (std::size_t p = 0; p < homology.size(); ++p) {
    for (const auto& generator : homology[p].generators) {
      CellChain cycle{static_cast<int>(p), {}};
      for (const auto& term : generator.cycle.terms()) {
        cycle.terms.push_back({ring.to_integer(term.coefficient), basis.generators()[p][term.index]});
      }
      const ClassAnswer answer = engine.classify(cycle);
      CHECK(answer.is_cycle);
      CHECK_FALSE(answer.is_zero);
      const ClassAnswer multiple = engine.classify(sum({}, generator.order, cycle, AnyRing{ring}));
      CHECK(multiple.is_zero);
    }
  }
}
