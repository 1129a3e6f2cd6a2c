// Memory that runs out in the middle of a step: the log is the one before it, and the engine takes no further step.
#include <cstdlib>
#include <new>

#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

namespace {

/// The number of allocations until one fails; below zero: none does.
long until_failure = -1;

void* allocated(std::size_t size) {
  if (until_failure == 0) {
    until_failure = -1;
    throw std::bad_alloc{};
  }
  until_failure -= until_failure > 0 ? 1 : 0;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc{};
}

}  // namespace

void* operator new(std::size_t size) { return allocated(size); }
// What asks in this way has another way to go: the sorts of the standard library.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace sesame;
using namespace sesame::tests;

namespace {

/// An engine that carried out these operations.
std::unique_ptr<Engine> engine_after(const std::vector<ops::Operation>& operations) {
  auto engine = std::make_unique<Engine>();
  for (const ops::Operation& op : operations) {
    carry_out(*engine, op);
  }
  return engine;
}

/// True when the operation was cut off by the k-th allocation.
bool is_cut_off(Engine& engine, const ops::Operation& op, int k) {
  ops::Operation copy = op;
  until_failure = k;
  try {
    const auto result = engine.apply(std::move(copy));
    until_failure = -1;
    REQUIRE((result || result.error().code == Errc::limit));
    return !result;
  } catch (const std::bad_alloc&) {
    until_failure = -1;
    return true;
  }
}

}  // namespace

TEST_CASE("when any allocation of a step fails, the engine is as it was before it", "[engine]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  std::vector<ops::Operation> done;
  RandomSteps random(seed, {.most_cells = 25, .simploids = true, .cones = true});
  int failures = 0;
  for (int step = 0; step < 8; ++step) {
    const auto before = engine_after(done);
    ops::Operation op = random.next(before->structure());
    if (step == 4) {
      op = ops::AskClass{{{1, std::string{before->structure().name(0)}}}};
    } else if (step == 6) {
      op = ops::Undo{2};
    }
    CAPTURE(ops::to_text(op));
    for (int k = 0;; ++k) {
      CAPTURE(k);
      const auto engine = engine_after(done);
      if (!is_cut_off(*engine, op, k)) {
        done.push_back(op);
        REQUIRE(dump(*engine) == dump(*engine_after(done)));
        break;
      }
      ++failures;
      REQUIRE(engine->log().size() == done.size());
      REQUIRE(dump(*engine) == dump(*before));
    }
  }
  CHECK(failures > 100);
}

TEST_CASE("an observer that throws does not undo the step that it was told of", "[engine]") {
  Engine engine;
  engine.observe([](const ops::Operation&, const engine::StepReport&) { throw std::runtime_error("seen enough"); });
  CHECK_THROWS_AS(engine.apply(operation(R"({"op":"simplex","name":"t","dim":2})")), std::runtime_error);
  CHECK(engine.log().size() == 1);
  CHECK_THROWS_AS(engine.apply(operation(R"({"op":"identify","pairs":[["t.0","t.1"]]})")), std::runtime_error);
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(1)});
}
