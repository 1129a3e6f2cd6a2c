/// \file
/// Where an engine writes down what it does: before it does it, so that nothing acknowledged is lost with the process.
#pragma once

#include <functional>

#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// A log of operations outside of the engine, such as a file: see LogWriter.
class StepLog {
 public:
  StepLog() = default;
  StepLog(const StepLog&) = delete;
  StepLog& operator=(const StepLog&) = delete;
  virtual ~StepLog() = default;

  /// Takes an operation that cannot be refused any more, before anything of it happens. Errors, io: it is not written;
  /// the step is refused then, and the next one is tried like any other.
  virtual Status append(const ops::Operation& operation) = 0;
  /// The operation appended last has happened, and is not taken back any more.
  virtual void confirm() noexcept = 0;
  /// The operation appended last has not happened after all: nothing of it is to remain. Errors: io.
  virtual Status take_back() = 0;
  /// Notes what the answers are after the operations appended so far, as a hash: see answer_hash. `syncs`: after these
  /// have been put on the disk. Errors: io.
  virtual Status bind(std::uint64_t state, bool syncs) = 0;
  /// Whether what was appended can be read back.
  [[nodiscard]] virtual bool can_be_read_back() const = 0;
  /// Hands out all operations that were appended and not taken back, in order, until one is not accepted.
  /// Errors: those of `accept`; io; bad_input when what was written is not there any more.
  virtual Status read_back(const std::function<Status(ops::Operation)>& accept) = 0;
};

}  // namespace sesame::engine
