// Engines that go on from logs.
#include "engine/open.hpp"

#include "tests/support/engines.hpp"
#include "tests/support/logs.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Matchers::Contains;

namespace {

engine::OpenOptions on(MemoryDisk& disk, const engine::SyncPolicy& sync = batches_of(400)) {
  engine::OpenOptions options;
  options.disk = &disk;
  options.sync = sync;
  return options;
}

}  // namespace

TEST_CASE("an engine that is opened again is where it was", "[engine][log]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  MemoryDisk disk;
  RandomSteps random(seed, everything_and_maps(40));
  std::vector<ops::Operation> applied;
  for (int session = 0; session < 3; ++session) {
    auto opened = engine::Engine::open("log", on(disk));
    REQUIRE(opened);
    Engine& engine = *opened->engine;
    REQUIRE(opened->steps == applied.size());
    Engine twin;
    for (const ops::Operation& operation : applied) {
      carry_out(twin, operation);
    }
    REQUIRE(live_groups(engine) == live_groups(twin));
    REQUIRE(std::equal(engine.cells().begin(), engine.cells().end(), twin.cells().begin(), twin.cells().end()));
    REQUIRE(engine.undoable() == twin.undoable());
    for (int k = 0; k < 12; ++k) {
      ops::Operation operation = k % 5 == 4 ? ops::Operation{ops::Undo{2}} : random.next(engine.structure());
      if (engine.apply(operation)) {
        applied.push_back(std::move(operation));
      }
    }
    REQUIRE(engine.bind_log());
    REQUIRE(opened->log->close());
  }
}

TEST_CASE("a step that is refused leaves no record, one that cannot be written does not happen", "[engine][log]") {
  MemoryDisk disk;
  auto opened = engine::Engine::open("log", on(disk));
  Engine& engine = *opened->engine;
  build(engine, {R"({"op":"simplex","name":"t","dim":2})"});
  CHECK(!engine.apply(operation(R"({"op":"identify","pairs":[["t.0","t.9"]]})")));
  CHECK(!engine.apply(operation(R"({"op":"undo","steps":5})")));
  CHECK(!engine.apply(operation(R"({"op":"expect","betti":[7]})")));
  CHECK(!engine.apply(operation(R"({"op":"class","chain":[[1,"t.9"]]})")));
  CHECK(read_log(disk.bytes("log")).steps.size() == 1);
  disk.fault = [](std::string_view call) { return call == "append" ? ENOSPC : 0; };
  const auto refused = engine.apply(operation(R"({"op":"identify","pairs":[["t.0","t.1"]]})"));
  REQUIRE(!refused);
  CHECK(refused.error().code == Errc::io);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0});
  disk.fault = [](std::string_view) { return 0; };
  build(engine, {R"({"op":"identify","pairs":[["t.0","t.1"]]})"});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 1, 0});
  CHECK(read_log(disk.bytes("log")).steps.size() == 2);
}

TEST_CASE("a log has one writer", "[engine][log]") {
  MemoryDisk disk;
  const auto first = engine::Engine::open("log", on(disk));
  REQUIRE(first);
  const auto second = engine::Engine::open("log", on(disk));
  REQUIRE(!second);
  CHECK_THAT(second.error().what, Contains("another process, 42, is writing this log"));
}

TEST_CASE("a damaged log is not opened, and stays as it was", "[engine][log]") {
  MemoryDisk disk;
  {
    auto opened = engine::Engine::open("log", on(disk));
    build(*opened->engine,
          {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"note","text":"abc"})", R"({"op":"note","text":"def"})"});
  }
  std::string& bytes = disk.bytes("log");
  bytes[bytes.find("abc")] = 'A';
  const std::string before = bytes;
  const auto opened = engine::Engine::open("log", on(disk));
  REQUIRE(!opened);
  CHECK_THAT(opened.error().what,
             Contains("log:3: record 2, at byte " + std::to_string(before.find("\n{\"op\":\"note\"") + 1)));
  CHECK(disk.bytes("log") == before);
}

TEST_CASE("a log that is bound to other answers is not gone on from", "[engine][log]") {
  MemoryDisk disk;
  {
    const auto writer = begin_log(disk, batches_of(400));
    REQUIRE(writer->append(operation(R"({"op":"simplex","name":"t","dim":2})")));
    REQUIRE(writer->bind(12345, false));
  }
  const auto opened = engine::Engine::open("log", on(disk));
  REQUIRE(!opened);
  CHECK(opened.error().code == Errc::law_broken);
  CHECK_THAT(opened.error().what, Contains("after step 1"));
}

TEST_CASE("whatever the disk does, an engine opened again has the steps that were acknowledged", "[engine][log]") {
  for (unsigned seed = 0; seed < 120; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    MemoryDisk disk;
    std::vector<std::string> acknowledged;
    for (int session = 0; session < 3; ++session) {
      disk.fault = [](std::string_view) { return 0; };
      auto opened = engine::Engine::open("log", on(disk, engine::SyncPolicy::always()));
      REQUIRE(opened);
      REQUIRE(opened->steps == acknowledged.size());
      disk.fault = [&](std::string_view call) { return call != "truncate" && random() % 12 == 0 ? EIO : 0; };
      disk.short_write = [&](std::size_t size) { return random() % (size + 1); };
      for (int k = 0; k < 6; ++k) {
        const std::string name = "s" + std::to_string(session) + "_" + std::to_string(k);
        ops::Operation step = ops::MakeSimplex{name, static_cast<int>(random() % 3), {}};
        if (opened->engine->apply(step)) {
          acknowledged.push_back(ops::to_text(step));
        }
      }
      disk.fault = [](std::string_view) { return 0; };
      disk.cut_power(random);
    }
    const Found found = read_log(disk.bytes("log"));
    REQUIRE(!found.damage);
    REQUIRE(found.steps == acknowledged);
  }
}
