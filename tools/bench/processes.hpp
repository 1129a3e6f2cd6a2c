/// \file
/// Work in processes of its own, so that its memory is its own and its end does not end the program.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::tools {

/// Runs `work` in a copy of this process and returns its text. Requires: one thread.
/// Errors: refused, with a sentence, when it threw, ran out of memory, was ended by a signal or took longer than
/// `most_seconds`, or than it allowed itself (SIGPROF); io when there can be no such process. When it took too long and
/// `when_late` is given, the text is what that returns, called in this process.
Result<std::string> in_child(const std::function<std::string()>& work, unsigned most_seconds,
                             const std::function<std::string()>& when_late = nullptr);

struct ProgramRun {
  double seconds = 0;
  double processor_seconds = 0;
  std::uint64_t peak_bytes = 0;  ///< of resident memory
  std::string output;            ///< what it wrote to standard output
};
/// Runs another program with its arguments, to the end. Errors: as in_child, and when its exit status is not 0.
Result<ProgramRun> run_program(const std::vector<std::string>& command, unsigned most_seconds);

/// The path of a program beside this one or on the PATH.
[[nodiscard]] std::optional<std::string> find_program(const std::string& name);

/// The resident memory of this process, and the most that it was since `forget_peak_memory`, where the system can
/// forget; that also gives back what is free, so that what is taken next shows.
struct ResidentMemory {
  std::uint64_t now = 0, peak = 0;  ///< in bytes; 0 when the system does not tell
};
[[nodiscard]] ResidentMemory resident_memory();
void forget_peak_memory();

/// A directory for files that are gone when this is destroyed.
class ScratchDirectory {
 public:
  ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  ~ScratchDirectory();
  /// Of a file in it.
  [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace sesame::tools
