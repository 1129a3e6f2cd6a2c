/// \file
/// The form of a durable log: the lines of a script, each with its number and a checksum of everything up to it.
///
///     {"sesame":1,"ring":"Z","title":"torus","seq":0,"xxh3":"0875bc94613c9cfd"}
///     {"op":"simplex","name":"t","dim":2,"seq":1,"xxh3":"8c0e6a2354a2b0c8"}
///     {"op":"note","text":"a disc","seq":2,"synced":1,"xxh3":"f5c246b370caaa65"}
///     #{"bound":2,"synced":2,"state":"a23489957306101f","xxh3":"91c2215c7559a225"}
///
/// A *record* is the header, which has the number 0, or an operation; records are numbered without gaps. The checksum
/// of a line is XXH3 (64 bits) of what stands before it, seeded by the *chain*: what the line before
/// has left. Every line leaves one, those without a checksum too: records as people write them, comments, blank lines.
/// So a line that is changed, lost, doubled or moved is found at the next line with a checksum. `synced` is the last
/// record that was known to be on the disk; a record has it when that is news.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sparse/result.hpp"

namespace sesame::engine {

/// What all lines up to some place come to; 0 before the first.
using Chain = std::uint64_t;

/// The place behind a line of a log.
struct LogPosition {
  std::uint64_t bytes = 0;    ///< the size of all lines until here
  std::uint64_t records = 0;  ///< the header among them: the number of the next
  Chain chain = 0;
  bool is_checked = false;   ///< whether some line had a checksum
  std::uint64_t synced = 0;  ///< the last record that a line says is on the disk
  bool is_bound = false;     ///< whether there is no record behind the last line that binds

  /// Steps, as replays count them.
  [[nodiscard]] std::uint64_t steps() const { return records > 0 ? records - 1 : 0; }
};

/// What a line that binds says of what comes before it.
struct Binding {
  std::uint64_t steps;   ///< that the log has
  std::uint64_t synced;  ///< of these, so many were known to be on the disk
  std::uint64_t state;   ///< of the answers after them: see answer_hash
};

/// The line of a record, with its end; `position` goes behind it. `text`: a JSON object with a field at least.
/// `synced`: the last record that is on the disk; 0 when not even the header is known to be.
[[nodiscard]] std::string record_line(std::string_view text, std::uint64_t synced, LogPosition& position);
/// The line of a binding, likewise.
[[nodiscard]] std::string binding_line(const Binding& binding, LogPosition& position);

/// A line, taken apart.
struct LogLine {
  /// The JSON text of a record, without number and checksum; valid until the next line is taken. Empty: no record.
  std::string_view record;
  std::optional<Binding> binding;
};

/// Reads lines one after another, and checks what they say of themselves.
class LineChecker {
 public:
  /// Takes a line without its line feed. Errors, bad_input, which end the log: it is not as it was written, or not what
  /// should come here.
  Result<LogLine> take(std::string_view line);
  /// Behind the lines that were taken.
  [[nodiscard]] const LogPosition& position() const { return position_; }
  /// Whether a line has a checksum of its own, be it right or wrong.
  [[nodiscard]] static bool is_checked(std::string_view line);
  /// Gives the memory back that a long line has taken; its record is not valid any more then.
  void shrink();

 private:
  Result<LogLine> take_binding(std::string_view line);
  Result<LogLine> take_record(std::string_view line);

  LogPosition position_;
  std::string text_;  ///< of the record at hand, when it is not what the line is
};

/// The last record that some bytes of a log, whole or not, say is on the disk, or nothing.
[[nodiscard]] std::optional<std::uint64_t> claimed_sync(std::string_view bytes);

/// XXH3 of some bytes, seeded.
[[nodiscard]] std::uint64_t checksum(std::string_view bytes, std::uint64_t seed);

/// As 16 hexadecimal digits.
[[nodiscard]] std::string digits_of(std::uint64_t hash);

}  // namespace sesame::engine
