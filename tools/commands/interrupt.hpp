/// \file
/// Signals: at Ctrl-C the work at hand is finished and reported, instead of lost; and nothing half-made is left behind
/// by a signal that ends the program.
#pragma once

#include <atomic>
#include <csignal>
#include <string>

namespace sesame::tools {

/// Set by Ctrl-C once `catch_interrupt` has been called.
[[nodiscard]] std::atomic<bool>& stop_requested();

/// From now on the first Ctrl-C sets `stop_requested`, and ends a read that waits for input; a second one ends the
/// program at once.
void catch_interrupt();

/// A file that goes when one of the usual signals ends the program (Ctrl-C, a broken pipe, a closed terminal, `kill`),
/// while this lives. Not when `kill -9` or a power cut does.
class RemovedBySignals {
 public:
  explicit RemovedBySignals(std::string path);
  RemovedBySignals(const RemovedBySignals&) = delete;
  RemovedBySignals& operator=(const RemovedBySignals&) = delete;
  ~RemovedBySignals();

 private:
  std::string path_;
};

/// While there is one, signals that would end the process wait: for a file that is made and not yet to be removed.
class HeldSignals {
 public:
  HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals();

 private:
  sigset_t before_{};
};

}  // namespace sesame::tools
