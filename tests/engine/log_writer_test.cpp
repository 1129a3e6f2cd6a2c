// A log on a disk on which everything goes wrong that can: what was acknowledged is there afterwards, and nothing else.
#include "engine/durable/log_writer.hpp"

#include "tests/support/logs.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Matchers::Contains;

namespace {

std::string text_of(int k) { return ops::to_text(note("step " + std::to_string(k))); }

/// That a log has these steps, and is whole.
void check_log(const std::string& bytes, const std::vector<std::string>& steps) {
  const Found found = read_log(bytes);
  REQUIRE(found.error.empty());
  REQUIRE(found.torn == 0);
  REQUIRE(found.steps == steps);
}

struct Policy {
  const char* name;
  engine::SyncPolicy policy;
};
const std::vector<Policy> policies{
    {"always", engine::SyncPolicy::always()}, {"batch", batches_of(200)}, {"never", engine::SyncPolicy::never()}};

}  // namespace

TEST_CASE("what is appended is read back, what is taken back is not", "[engine][log]") {
  const auto& [name, policy] = GENERATE(from_range(policies));
  CAPTURE(name);
  MemoryDisk disk;
  const auto writer = begin_log(disk, policy);
  std::vector<std::string> steps;
  for (int k = 1; k <= 20; ++k) {
    REQUIRE(writer->append(note("step " + std::to_string(k))));
    if (k % 3 == 0) {
      REQUIRE(writer->take_back());
    } else {
      steps.push_back(text_of(k));
    }
    check_log(disk.bytes("log"), steps);
  }
  std::vector<std::string> read;
  REQUIRE(writer->read_back([&](ops::Operation operation) -> Status {
    read.push_back(ops::to_text(operation));
    return Done{};
  }));
  CHECK(read == steps);
  CHECK(writer->position().steps() == steps.size());
  REQUIRE(writer->close());
  CHECK(writer->synced_steps() == steps.size());
}

TEST_CASE("a call that fails, whichever, loses no step and leaves no half one", "[engine][log]") {
  const auto& [name, policy] = GENERATE(from_range(policies));
  const int error = GENERATE(ENOSPC, EIO);
  CAPTURE(name, error);
  for (int failing = 0; failing < 60; ++failing) {
    for (const int in_a_row : {1, 2, 5}) {
      CAPTURE(failing, in_a_row);
      MemoryDisk disk;
      const auto writer = begin_log(disk, policy);
      int calls = 0;
      disk.fault = [&](std::string_view) {
        const int call = calls++;
        return call >= failing && call < failing + in_a_row ? error : 0;
      };
      disk.short_write = [&](std::size_t size) { return size / 2; };
      std::vector<std::string> steps;
      int refused = 0;
      for (int k = 1; k <= 20; ++k) {
        const Status appended = writer->append(note("step " + std::to_string(k)));
        if (appended) {
          steps.push_back(text_of(k));
        } else {
          ++refused;
          REQUIRE_THAT(appended.error().what, Contains("cannot write log: "));
          REQUIRE_THAT(appended.error().what, Contains("step " + std::to_string(writer->synced_steps())));
        }
      }
      REQUIRE(refused <= in_a_row);
      disk.fault = [](std::string_view) { return 0; };
      REQUIRE(writer->close());
      REQUIRE(writer->synced_steps() == steps.size());
      check_log(disk.bytes("log"), steps);
      // What the writer says is on the disk survives a power cut, though a sync that failed has dropped what it should
      // have written.
      std::mt19937 random(static_cast<unsigned>(failing));
      disk.cut_power(random);
      check_log(disk.bytes("log"), steps);
    }
  }
}

TEST_CASE("a program that ends all of a sudden leaves the steps that have happened, and no other", "[engine][log]") {
  const auto& [name, policy] = GENERATE(from_range(policies));
  CAPTURE(name);
  for (int steps = 0; steps <= 3; ++steps) {
    MemoryDisk disk;
    const auto writer = begin_log(disk, policy);
    std::vector<std::string> happened;
    for (int k = 1; k <= steps; ++k) {
      REQUIRE(writer->append(note("step " + std::to_string(k))));
      writer->confirm();
      happened.push_back(text_of(k));
    }
    SECTION("between two steps") {
      writer->end_suddenly();
      check_log(disk.bytes("log"), happened);
    }
    SECTION("in a step") {
      REQUIRE(writer->append(note("under way")));
      writer->end_suddenly();
      check_log(disk.bytes("log"), happened);
    }
    SECTION("in a step that is taken back") {
      REQUIRE(writer->append(note("under way")));
      REQUIRE(writer->take_back());
      writer->end_suddenly();
      check_log(disk.bytes("log"), happened);
    }
  }
}

TEST_CASE("a disk that stays full refuses every step, and the log has those before", "[engine][log]") {
  const auto& [name, policy] = GENERATE(from_range(policies));
  CAPTURE(name);
  MemoryDisk disk;
  const auto writer = begin_log(disk, policy);
  REQUIRE(writer->append(note("step 1")));
  disk.fault = [](std::string_view call) { return call == "append" ? ENOSPC : 0; };
  for (int k = 0; k < 5; ++k) {
    const Status appended = writer->append(note("more"));
    REQUIRE(!appended);
    CHECK_THAT(appended.error().what, Contains("No space left on device") && Contains("step 1"));
    check_log(disk.bytes("log"), {text_of(1)});
  }
  disk.fault = [](std::string_view) { return 0; };
  REQUIRE(writer->append(note("step 2")));
  check_log(disk.bytes("log"), {text_of(1), text_of(2)});
}

TEST_CASE("a sync that fails is not made good by one that succeeds", "[engine][log]") {
  MemoryDisk disk;
  const auto writer = begin_log(disk, engine::SyncPolicy::always());
  REQUIRE(writer->append(note("step 1")));
  disk.fault = [](std::string_view call) { return call == "sync" ? EIO : 0; };
  REQUIRE(!writer->append(note("lost")));
  CHECK(writer->synced_steps() == 1);
  disk.fault = [](std::string_view) { return 0; };
  REQUIRE(writer->append(note("step 2")));
  std::mt19937 random(1);
  disk.cut_power(random);
  check_log(disk.bytes("log"), {text_of(1), text_of(2)});
}

TEST_CASE("a power cut at any moment leaves every synced step, none that was refused, in order", "[engine][log]") {
  const auto& [name, policy] = GENERATE(from_range(policies));
  CAPTURE(name);
  for (unsigned seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    MemoryDisk disk;
    std::vector<std::string> steps;
    std::uint64_t synced = 0;
    {
      const auto writer = begin_log(disk, policy);
      disk.fault = [&](std::string_view) { return random() % 40 == 0 ? EIO : 0; };
      disk.short_write = [&](std::size_t size) { return random() % (size + 1); };
      for (unsigned k = 0; k < 3 + seed % 30; ++k) {
        if (writer->append(note("step " + std::to_string(k)))) {
          steps.push_back(text_of(static_cast<int>(k)));
        }
        if (random() % 7 == 0) {
          (void)writer->take_back();  // if that fails it is still no step
          steps.resize(writer->position().steps());
        }
      }
      synced = writer->synced_steps();
      disk.fault = [](std::string_view) { return 0; };
      disk.cut_power(random);  // before the writer is closed
    }
    const Found found = read_log(disk.bytes("log"));
    REQUIRE(!found.damage);
    REQUIRE(found.error.empty());
    REQUIRE(found.steps.size() >= synced);
    REQUIRE(found.steps.size() <= steps.size() + 1);
    for (std::size_t k = 0; k < std::min(found.steps.size(), steps.size()); ++k) {
      REQUIRE(found.steps[k] == steps[k]);
    }
    // A step that was refused can still be there when the disk would not let go of it.
  }
}

TEST_CASE("what is due by its age is synced while nobody writes", "[engine][log]") {
  MemoryDisk disk;
  const auto writer = begin_log(disk, {std::uint64_t{1} << 22, std::chrono::milliseconds{1}});
  REQUIRE(writer->append(note("step 1")));
  while (writer->synced_steps() < 1) {  // would not end
    std::this_thread::yield();
  }
  SUCCEED();
}

TEST_CASE("a log is gone on from where it is whole", "[engine][log]") {
  MemoryDisk disk;
  {
    const auto writer = begin_log(disk, batches_of(200));
    for (int k = 1; k <= 3; ++k) {
      REQUIRE(writer->append(note("step " + std::to_string(k))));
    }
  }
  disk.bytes("log") += R"({"op":"note","te)";
  const Found found = read_log(disk.bytes("log"));
  CHECK(found.torn == 16);
  int error = 0;
  engine::LogWriter writer(disk.open("log", engine::Disk::Mode::write, error), "log", batches_of(200));
  REQUIRE(writer.go_on(found.end));
  REQUIRE(writer.append(note("step 4")));
  check_log(disk.bytes("log"), {text_of(1), text_of(2), text_of(3), text_of(4)});
}
