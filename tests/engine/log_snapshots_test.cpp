// Snapshots beside a log: they make opening it quicker, and change nothing else.
#include "engine/log_snapshots.hpp"

#include "engine/open.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/logs.hpp"
#include "tests/support/temporary_file.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// A log of many steps, in which something is glued and split again and again, and its snapshot.
class LongLog {
 public:
  static constexpr int rounds = 2600;
  static constexpr std::uint64_t steps = 2 + 4 * rounds;

  LongLog() : file_{""} {
    auto opened = engine::Engine::open(path(), {});
    REQUIRE(opened);
    Engine& engine = *opened->engine;
    build(engine, {R"({"op":"simplex","name":"x","dim":1})", R"({"op":"simplex","name":"y","dim":2})"});
    for (int k = 0; k < rounds; ++k) {
      const std::string copy = "c" + std::to_string(k);
      const std::string other = k == 0 ? "x.1" : "c" + std::to_string(k - 1);
      build(engine, {R"({"op":"identify","pairs":[["x.0",")" + other + R"("]]})",
                     R"({"op":"deidentify","split":[{"cell":"x.0","as":")" + copy + R"(","moves":[["x",0]]}]})",
                     R"({"op":"identify","pairs":[["y.0","y.1"]]})", R"({"op":"undo","steps":1})"});
    }
    REQUIRE(engine.bind_log());
    REQUIRE(opened->log->close());
    REQUIRE(std::filesystem::exists(snapshot()));
  }
  LongLog(const LongLog&) = delete;
  LongLog& operator=(const LongLog&) = delete;
  ~LongLog() { std::filesystem::remove(snapshot()); }

  [[nodiscard]] const std::string& path() const { return file_.path(); }
  [[nodiscard]] std::string snapshot() const { return engine::LogSnapshots::path_of(path()); }

 private:
  TemporaryFile file_;
};

/// What an engine says that is opened from the log, and goes on.
std::string story_of(const LongLog& log, bool has_snapshots) {
  engine::OpenOptions options;
  options.has_snapshots = has_snapshots;
  auto opened = engine::Engine::open(log.path(), options);
  REQUIRE(opened);
  REQUIRE(opened->steps == LongLog::steps);
  Engine& engine = *opened->engine;
  std::string story;
  const auto tell = [&] {
    const engine::Homology homology = engine.homology();
    for (std::size_t p = 0; p < homology.betti.size(); ++p) {
      story += std::to_string(homology.betti[p]) + "/" + std::to_string(engine.cells()[p]) + " ";
    }
    story += std::to_string(engine.undoable()) + ";";
  };
  tell();
  build(engine, {R"({"op":"identify","pairs":[["y.0","y.2"]]})"});
  tell();
  build(engine, {R"({"op":"undo","steps":1})"});
  tell();
  build(engine, {R"({"op":"undo","steps":2})"});  // of steps before the snapshot
  tell();
  build(engine, {R"({"op":"identify","pairs":[["c17","y.2"]]})"});
  tell();
  build(engine, {R"({"op":"undo","steps":4000})"});
  tell();
  REQUIRE(engine.first_defect() == std::nullopt);
  return story;
}

}  // namespace

TEST_CASE("a log is gone on from its snapshot as without one, also when steps before it are undone", "[engine][log]") {
  const LongLog log;
  const std::string before = text_of(log.path());
  const auto put_back = [&] { std::ofstream(log.path(), std::ios::binary) << before; };
  const std::string story = story_of(log, true);
  put_back();
  CHECK(story_of(log, false) == story);
  SECTION("one that is damaged is not used") {
    put_back();
    std::string bytes = text_of(log.snapshot());
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(log.snapshot(), std::ios::binary) << bytes;
    CHECK(story_of(log, true) == story);
  }
  SECTION("one that is missing is not missed") {
    put_back();
    std::filesystem::remove(log.snapshot());
    CHECK(story_of(log, true) == story);
  }
  SECTION("one that is ahead of its log is not used") {
    const std::size_t cut = before.rfind("{\"op\":\"identify\"");
    std::ofstream(log.path(), std::ios::binary) << before.substr(0, cut);
    const auto opened = engine::Engine::open(log.path(), {});
    REQUIRE(opened);
    CHECK(opened->steps == LongLog::steps - 2);
  }
  SECTION("a log that is damaged before it is not opened") {
    std::string damaged = before;
    damaged[damaged.size() / 2] ^= 1;
    std::ofstream(log.path(), std::ios::binary) << damaged;
    const auto opened = engine::Engine::open(log.path(), {});
    REQUIRE(!opened);
    CHECK(opened.error().code == Errc::bad_input);
  }
}

TEST_CASE("steps of the log behind its snapshot may undo steps before it", "[engine][log]") {
  const LongLog log;
  {
    auto opened = engine::Engine::open(log.path(), {});
    build(*opened->engine, {R"({"op":"undo","steps":10})", R"({"op":"simplex","name":"z","dim":3})"});
  }
  std::string answers[2];
  for (const bool has_snapshots : {false, true}) {
    engine::OpenOptions options;
    options.has_snapshots = has_snapshots;
    auto opened = engine::Engine::open(log.path(), options);
    REQUIRE(opened);
    CHECK(opened->steps == LongLog::steps + 2);
    CHECK(opened->engine->undoable() == 2 + 3 * LongLog::rounds - LongLog::rounds - 10 + 1);
    for (const std::uint64_t count : opened->engine->cells()) {
      answers[has_snapshots ? 1 : 0] += std::to_string(count) + " ";
    }
  }
  CHECK(answers[0] == answers[1]);
}
