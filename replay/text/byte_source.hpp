/// \file
/// The bytes of a file or of a pipe, of any length, unpacked when they are gzip data: what every reader reads from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "replay/text/byte_input.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Bytes in the order of the input, read in pieces. An input that ends badly is an error, never a shorter input.
/// Memory: the window, which grows only when `more` is called while little of it has been consumed, and only as bytes
/// arrive.
class ByteSource {
 public:
  /// `path` may be "-": standard input. gzip data are known by their first bytes.
  /// Errors: io when the input cannot be read; bad_input when it starts like gzip data and is none.
  static Result<ByteSource> open(const std::string& path, const InputOptions& options = {});
  /// The same for an input that is open. `name` is what messages call it.
  static Result<ByteSource> from(std::unique_ptr<ByteInput> input, std::string name);
  /// A text in memory, as it is.
  static ByteSource of_text(std::string_view text, std::string name);
  ByteSource(ByteSource&&) noexcept;
  ByteSource& operator=(ByteSource&&) noexcept;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  ~ByteSource();

  /// What messages call the input.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The bytes that are read and not consumed. Valid until `more`. Aligned as a std::uint64_t when the bytes before
  /// them are a multiple of 8, so that numbers can be used where they lie.
  [[nodiscard]] std::string_view window() const { return {bytes() + begin_, end_ - begin_}; }
  /// Removes the first `count` bytes of the window.
  void consume(std::size_t count) { begin_ += count; }
  /// Gives back most of the room that a large window has taken, when what is left of it is small. The window moves.
  void shrink();
  /// Adds bytes to the window, as many as there are without waiting, one at least; false at the end of the input.
  /// Errors: io when the input cannot be read; bad_input when gzip data are damaged or cut off.
  Result<bool> more();
  /// Whether the input ended because somebody said so, perhaps in the middle.
  [[nodiscard]] bool is_stopped() const { return input_->is_stopped(); }

 private:
  ByteSource(std::string name, std::unique_ptr<ByteInput> input);
  [[nodiscard]] char* bytes() { return reinterpret_cast<char*>(words_.data()); }
  [[nodiscard]] const char* bytes() const { return reinterpret_cast<const char*>(words_.data()); }
  void make_room();

  std::string name_;
  std::unique_ptr<ByteInput> input_;
  std::vector<std::uint64_t> words_;  ///< the window lies in it; words, so that it is aligned
  std::size_t begin_ = 0, end_ = 0;   ///< of the window, in bytes
};

/// All the bytes of an input. Errors: those of a ByteSource.
Result<std::string> read_file(const std::string& path);

}  // namespace sesame::replay
