/// \file
/// A line of progress on a terminal, with rate and time left, at most ten times a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <ostream>

namespace sesame::replay {

class Progress {
 public:
  /// Writes to `out`; `total` is the number of steps when it is known.
  Progress(std::ostream& out, std::optional<std::uint64_t> total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Wipes the line.
  ~Progress();

  void update(std::uint64_t done);
  /// Wipes the line, so that something else can be written; the next update writes it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& out_;
  std::optional<std::uint64_t> total_;
  Clock::time_point start_, last_;
  bool visible_ = false;
};

}  // namespace sesame::replay
