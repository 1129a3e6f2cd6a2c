/// \file
/// Where bytes come from: files, pipes, texts in memory, gzip data.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "sparse/result.hpp"

namespace sesame::replay {

/// Bytes, one piece after the other.
class ByteInput {
 public:
  ByteInput() = default;
  ByteInput(const ByteInput&) = delete;
  ByteInput& operator=(const ByteInput&) = delete;
  virtual ~ByteInput() = default;

  /// Fills the front of `to`, which has room, with as many bytes as there are without waiting, one at least; their
  /// number, 0 at the end of the input. Errors: io when the input cannot be read; bad_input when it is damaged.
  virtual Result<std::size_t> read(std::span<char> to) = 0;
  /// Whether the input ended because somebody said so, perhaps in the middle.
  [[nodiscard]] virtual bool is_stopped() const { return false; }
};

struct InputOptions {
  /// When it is there and set, the input ends; a signal that sets it should interrupt a read that waits (no
  /// SA_RESTART).
  const std::atomic<bool>* stop = nullptr;
  /// At the end of a file, waits for it to grow by whole lines; it is an error (io) when what was read is taken away:
  /// the file is truncated, removed, replaced or written over. A log with checksums ends when another file has its
  /// name, or none. A pipe on standard input ends when its writers close it.
  bool follow = false;
};

/// Opens a file, or standard input when the path is "-". `name` is what messages call it. Errors: io.
Result<std::unique_ptr<ByteInput>> open_input(const std::string& path, const std::string& name,
                                              const InputOptions& options);

/// Unpacks what another input yields: gzip members, one after another, as the gzip program does. `packed` are the first
/// bytes of `input`, read already. Errors of its reads: those of `input`; bad_input when the data are damaged or cut
/// off.
[[nodiscard]] std::unique_ptr<ByteInput> unpacked(std::unique_ptr<ByteInput> input, std::string_view packed,
                                                  const std::string& name);

}  // namespace sesame::replay
