// Others who take part in a replay that goes on: in their turn, with steps of their own, until somebody stops it.
#include <atomic>
#include <sstream>
#include <thread>
#include <vector>

#include "replay/script/shared_replay.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// A replay in a thread of its own, which others take part in until this is stopped.
class Session {
 public:
  explicit Session(const std::string& script, replay::ReplayOptions options = {}) : options_{std::move(options)} {
    options_.shared = &shared;
    options_.stop = &stop_;
    options_.engine = &engine_;
    thread_ = std::thread([this, script] { replayed = replay_text(script, nullptr, options_); });
    while (!shared.is_open() && !is_over_) {
      shared.wait_for_other(shared.revision(), std::chrono::milliseconds(5));
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { stop(); }

  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
    is_over_ = true;
  }
  void wait_for_steps(std::uint64_t steps) {
    while (this->steps() < steps) {
      shared.wait_for_other(shared.revision(), std::chrono::milliseconds(5));
    }
  }
  std::uint64_t steps() {
    std::uint64_t found = 0;
    shared.look([&](engine::Engine& engine) { found = engine.undoable(); });
    return found;
  }

  replay::SharedReplay shared;
  Replayed replayed;

 private:
  replay::ReplayOptions options_;
  std::atomic<bool> stop_ = false, is_over_ = false;
  std::unique_ptr<engine::Engine> engine_;
  std::thread thread_;
};

const std::string edge = R"({"op":"simplex","name":"e","dim":1})";

}  // namespace

TEST_CASE("steps from outside are taken until one is refused, which is told with its line", "[shared]") {
  Session session(joined({header_line, edge}));
  session.wait_for_steps(1);
  const auto taken = session.shared.take(
      "\n# a circle\n{\"op\":\"identify\",\"pairs\":[[\"e.0\",\"e.1\"]]}\r\n  \n"
      "{\"op\":\"cone\",\"apex\":\"v\",\"over\":\"nothing\"}\n{\"op\":\"undo\"}");
  REQUIRE(taken);
  CHECK(taken->steps == 1);
  REQUIRE(taken->refusal);
  CHECK(taken->refusal->line == 5);
  CHECK(taken->refusal->what == "there is no body \"nothing\"");
  CHECK(session.steps() == 2);
  const auto wrong = session.shared.take("[");
  REQUIRE(wrong);
  CHECK(wrong->refusal->line == 1);
  CHECK_THAT(wrong->refusal->what, Contains("JSON"));
  std::vector<std::int64_t> betti;
  CHECK(session.shared.look([&](engine::Engine& engine) { betti = engine.homology().betti; }));
  CHECK(betti == std::vector<std::int64_t>{1, 1});
  session.stop();
  CHECK(session.replayed.outcome == replay::Outcome::interrupted);
  CHECK(session.replayed.errors.empty());  // who sent them was told
  CHECK_FALSE(session.shared.is_open());
  CHECK_FALSE(session.shared.take(edge));
  CHECK_FALSE(session.shared.look([](engine::Engine&) {}));
}

TEST_CASE("a replay that fails ends for those who take part, too", "[shared]") {
  replay::SharedReplay shared;
  std::atomic<bool> stop = false;
  replay::ReplayOptions options;
  options.shared = &shared;
  options.stop = &stop;
  const Replayed replayed =
      replay_text(joined({header_line, R"({"op":"cone","apex":"v","over":"x"})"}), nullptr, options);
  CHECK(replayed.outcome == replay::Outcome::wrong_script);
  CHECK_FALSE(shared.is_open());
  CHECK(shared.revision() == 2);  // it was open
}

TEST_CASE("many take part at once, and nobody sees a step in its middle", "[shared]") {
  std::string script = joined({header_line});
  constexpr int steps_of_script = 60;
  for (int k = 0; k < steps_of_script; ++k) {
    script += R"({"op":"insert","simplex":[)" + std::to_string(k) + "," + std::to_string(k + 1) + "]}\n";
  }
  std::uint64_t seen_by_observer = 0;  // in turns, so without a lock of its own
  replay::ReplayOptions options;
  options.observer = [&](const ops::Operation&, const engine::StepReport&) { ++seen_by_observer; };
  Session session(script, options);
  constexpr int senders = 3, steps_of_sender = 20;
  std::vector<std::thread> threads;
  std::atomic<int> taken = 0;
  std::atomic<bool> is_right = true;
  for (int sender = 0; sender < senders; ++sender) {
    threads.emplace_back([&, sender] {
      for (int k = 0; k < steps_of_sender; ++k) {
        const std::string name = "s" + std::to_string(sender) + "_" + std::to_string(k);
        const auto done = session.shared.take(R"({"op":"simplex","dim":1,"name":")" + name + "\"}");
        taken += done && done->steps == 1 ? 1 : 0;
        session.shared.look([&](engine::Engine& engine) {
          if (engine.undoable() != seen_by_observer || engine.homology().betti[0] != engine.euler_characteristic()) {
            is_right = false;  // edges and chains of edges: as many components as the Euler characteristic says
          }
        });
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  session.wait_for_steps(steps_of_script + senders * steps_of_sender);
  CHECK(taken == senders * steps_of_sender);
  CHECK(is_right);
  session.stop();
  CHECK(session.replayed.errors.empty());
}
