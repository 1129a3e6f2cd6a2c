/// \file
/// Reading a log record by record: what is whole, what is torn off at its end, and what is damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/durable/disk.hpp"
#include "engine/durable/log_format.hpp"
#include "ops/vocabulary/operation.hpp"
#include "ops/vocabulary/operation_reader.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// The first thing in a log that is not as it was written. Nothing behind it is read.
struct Damage {
  std::uint64_t record;  ///< its number, or that of the record that should come there: 0 the header, k step k
  std::uint64_t byte;    ///< where its line begins
  std::string what;
};

/// Takes lines and yields what they say. The one reader of records: of files of the disk (LogReader), and of whatever
/// else scripts are read from.
class RecordReader {
 public:
  using Entry = std::variant<std::monostate, ops::Header, ops::Operation, Binding>;

  /// A line without its line feed: nothing for blank lines and comments. Errors, bad_input: the checks of LineChecker;
  /// what parse_header and parse_operation find. After an error of a record that has no checksum it can go on.
  Result<Entry> take(std::string_view line);
  /// Behind the lines that were taken.
  [[nodiscard]] const LogPosition& position() const { return lines_.position(); }
  /// The line taken last was not as it was written: no other can be relied on.
  [[nodiscard]] bool is_damaged() const { return is_damaged_; }
  /// Takes a line, checks it, and does not read what it says.
  Status pass_over(std::string_view line);
  /// Whether a line without a checksum, here, would be no error. Cost: that of reading it.
  [[nodiscard]] bool is_sound(std::string_view line) const;

 private:
  LineChecker lines_;
  ops::OperationReader operations_;
  bool has_header_ = false, is_damaged_ = false;
};

/// Fills the front of a span; how much of it, 0 at the end. Errors: io, bad_input.
using ReadBytes = std::function<Result<std::size_t>(std::span<char>)>;

/// All bytes of a file, one piece after another. The file outlives it.
[[nodiscard]] ReadBytes bytes_of(File& file, std::string name, std::uint64_t from = 0);

/// A record that was cut off while it was written is no damage: it is torn. So is the last line of a log with checksums
/// when it has no end, and what begins with a line in which there are zeros, as a power cut leaves them where data were
/// still to be written, if no line behind it says that the disk had it all. Scripts have no checksums, and their last
/// line needs no end.
class LogReader {
 public:
  /// `name` is what messages call it. `longest`: the most bytes of a line.
  LogReader(std::string name, ReadBytes read, std::size_t longest = std::size_t{1} << 30)
      : name_{std::move(name)}, read_{std::move(read)}, longest_{longest} {}
  /// Of a file, which outlives it, and in which it can go back.
  LogReader(std::string name, File& file, std::size_t longest = std::size_t{1} << 30)
      : name_{std::move(name)}, file_{&file}, read_{bytes_of(file, name_)}, longest_{longest} {}

  /// The header; nothing when the log is empty, or torn before its end. To be called once, before `next`.
  /// Errors: io; bad_input when there is damage.
  Result<std::optional<ops::Header>> header();
  /// The next operation or binding; nothing at the end. Errors: likewise, and then there is no next.
  using Entry = std::variant<ops::Operation, Binding>;
  Result<std::optional<Entry>> next();

  /// Passes over the lines up to a place, which are checked, but not read, if they are the right ones: so many bytes
  /// and steps from the beginning, with this chain. If not, the next is what it would have been, and it takes a second
  /// reading to know that. Requires: the header has been read, and nothing else. Errors: those of `next`.
  Result<bool> skip_to(std::uint64_t bytes, Chain chain, std::uint64_t steps);

  /// Behind the last line that is whole.
  [[nodiscard]] const LogPosition& position() const { return position_; }
  /// At the end: the bytes behind it.
  [[nodiscard]] std::uint64_t torn() const { return torn_; }
  [[nodiscard]] const std::optional<Damage>& damage() const { return damage_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// `NAME:LINE: ` of the line read last.
  [[nodiscard]] std::string place() const;

 private:
  Result<std::optional<RecordReader::Entry>> next_entry();
  Result<bool> find_line();
  Result<bool> is_torn_here();
  [[nodiscard]] bool is_last_of_script(std::string_view line) const;
  Error damaged(const std::string& what);

  std::string name_;
  File* file_ = nullptr;
  ReadBytes read_;
  std::size_t longest_;
  RecordReader records_;
  LogPosition position_;
  std::string window_;
  std::size_t begin_ = 0, end_ = 0;  ///< of the line at hand in the window
  std::uint64_t line_ = 0;
  bool is_at_end_ = false;  ///< of the bytes
  std::uint64_t torn_ = 0;
  std::optional<Damage> damage_;
};

/// Hands out the first steps of a log, so many, until one is not accepted. Errors: those of `accept` and of LogReader;
/// bad_input when there are fewer.
Status read_steps(File& file, const std::string& name, std::uint64_t steps,
                  const std::function<Status(ops::Operation)>& accept);

}  // namespace sesame::engine
