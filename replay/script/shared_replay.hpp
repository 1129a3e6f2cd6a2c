/// \file
/// A replay that others take part in while it goes on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/engine.hpp"

namespace sesame::replay {

/// Lets other threads look at a replay between its steps, and add steps to it. Only one has its turn at a time: a step
/// of the script, somebody who looks, or somebody's steps.
///
/// Threads: any, at any time.
class SharedReplay {
 public:
  /// What became of lines that were to be taken.
  struct Taken {
    std::uint64_t steps = 0;  ///< that happened
    struct Refusal {
      std::uint64_t line;  ///< of the text, counted from 1
      std::string what;
    };
    std::optional<Refusal> refusal;  ///< of the first one that did not; those behind it were not tried
  };
  /// Carries one operation out, or refuses it.
  using Taker = std::function<Status(ops::Operation)>;

  /// Whether there is an object: from the header of the script on, until the replay has ended.
  [[nodiscard]] bool is_open() const;
  /// Calls `look` in its turn; false when there is no object.
  bool look(const std::function<void(engine::Engine&)>& look);
  /// Takes the operations of a text, lines as in a script, blank ones and comments too; nothing when there is no
  /// object. Steps that happened stay when a later one is refused.
  std::optional<Taken> take(std::string_view lines);
  /// Grows with each step, and at the beginning and the end.
  [[nodiscard]] std::uint64_t revision() const;
  /// Waits until the revision is another one, or so long; the revision then.
  std::uint64_t wait_for_other(std::uint64_t revision, std::chrono::milliseconds most) const;

  // For the replay.

  /// From now on there is an object.
  void open(engine::Engine& engine, Taker taker);
  /// From now on there is none: returns when nobody has a turn.
  void close();
  /// Its turn, for as long as what is returned lives.
  [[nodiscard]] std::unique_lock<std::mutex> turn() { return std::unique_lock(turn_); }
  /// To be called in its turn, after each step.
  void note_step();

 private:
  std::mutex turn_;
  engine::Engine* engine_ = nullptr;  ///< guarded by turn_, as the next one is
  Taker taker_;
  mutable std::mutex revised_;
  mutable std::condition_variable changed_;
  std::uint64_t revision_ = 0;  ///< guarded by revised_, as the next one is
  bool is_open_ = false;
};

/// Keeps a replay open to others while it lives; none when it is null.
///
/// Threads: that of the replay.
class OpenReplay {
 public:
  OpenReplay(SharedReplay* shared, engine::Engine& engine, SharedReplay::Taker taker) : shared_{shared} {
    if (shared_ != nullptr) {
      shared_->open(engine, std::move(taker));
    }
  }
  OpenReplay(const OpenReplay&) = delete;
  OpenReplay& operator=(const OpenReplay&) = delete;
  ~OpenReplay() {
    if (shared_ != nullptr) {
      shared_->close();
    }
  }

 private:
  SharedReplay* shared_;
};

}  // namespace sesame::replay
