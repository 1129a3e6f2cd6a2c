/// \file
/// Reading towers and filtrations, one operation at a time, from a file or a pipe of any length.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/script/facet_list.hpp"
#include "replay/script/script.hpp"
#include "replay/text/byte_source.hpp"
#include "replay/text/line_source.hpp"
#include "replay/text/line_words.hpp"
#include "replay/text/time_reader.hpp"
#include "replay/tower/tower_format.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

struct TowerOperation {
  enum class Kind {
    insert,    ///< the simplex with these vertices
    remove,    ///< the simplex with these vertices; in a zigzag only
    contract,  ///< labels are u and v: u becomes v
    column,    ///< of a boundary matrix; labels are its rows, ascending, none twice, all less than its own index
  };
  Kind kind;
  engine::Time time;
  int dimension;                          ///< of the simplex; 0 for a contraction
  std::span<const std::uint64_t> labels;  ///< valid until the next operation is read
  /// Of a binary input, what follows it as far as it is in memory: rows of later columns among other numbers, of which
  /// some will be asked for soon.
  std::span<const std::uint64_t> ahead = {};
};

/// Reads all formats, packed by gzip or not. In texts, `#` starts a comment, empty lines mean nothing, and lines may
/// end with CR LF.
///
/// The time of an operation is what its line says, a finite number (see TimeReader) that is not less than the one
/// before; where a format has none (phat, facets) or a tower leaves it out on every line, operation k happens at time
/// k, from 0 on. The reader checks what a line says by itself and against the times; what the labels mean is the
/// caller's to check: repeated vertices, missing faces, rows whose dimension is not one less.
///
/// An automatic format is found out by `find_format`.
///
/// Errors are `NAME:LINE: what, and what would be right`; in phat_binary, `NAME: column K: ...` with K from 0.
/// Cost: proportional to the bytes read; memory: the longest line or column.
class TowerReader {
 public:
  /// `path` may be "-": standard input. When `stop` is there and set, the input ends (see ByteSource).
  /// Errors: io when the input cannot be read; bad_input when an automatic format is none of those above.
  /// In texts, a line may have that many bytes.
  static Result<std::unique_ptr<TowerReader>> open(const std::string& path, TowerFormat format = TowerFormat::automatic,
                                                   const std::atomic<bool>* stop = nullptr,
                                                   std::size_t longest = longest_line);
  /// The same for a source that is open.
  static Result<std::unique_ptr<TowerReader>> from(ByteSource source, TowerFormat format = TowerFormat::automatic,
                                                   std::size_t longest = longest_line);

  /// The next operation; false at the end, and always after an error. Requires a format other than script.
  /// Errors: bad_input, io.
  Result<bool> next(TowerOperation& into);

  /// What messages call the input.
  [[nodiscard]] const std::string& name() const { return source_.name(); }
  /// Never automatic.
  [[nodiscard]] TowerFormat format() const { return format_; }
  /// Of the last operation: its line, counted from 1; in phat_binary its column, counted from 0.
  [[nodiscard]] std::uint64_t line() const { return line_; }
  /// `NAME:LINE: ` of the last operation, or `NAME: column K: `.
  [[nodiscard]] std::string place() const;
  /// How many operations have been read.
  [[nodiscard]] std::uint64_t operations() const { return operations_; }

  /// The whole input, as a script. Requires the format script, and leaves nothing to this reader.
  ScriptReader take_script();

 private:
  TowerReader(ByteSource source, TowerFormat format, std::size_t longest)
      : source_{std::move(source)}, format_{format}, longest_{longest} {}

  Result<bool> read_operation(TowerOperation& into);
  Result<bool> read_tower_line(TowerOperation& into);
  Result<bool> read_phat_line(TowerOperation& into);
  Result<bool> read_gudhi_line(TowerOperation& into);
  Result<bool> read_facet(TowerOperation& into);
  Result<bool> read_column(TowerOperation& into);
  Result<bool> read_header();
  Result<bool> finish_columns();
  Result<bool> wait_for_column(std::size_t numbers);

  Result<bool> read_line();
  Result<bool> read_content_line();
  Status read_dimension(LineWords& words);
  Status read_labels(LineWords& words, std::size_t count, const char* what);
  Status read_time(LineWords& words, std::string_view what);
  Status read_optional_time(LineWords& words);
  [[nodiscard]] bool is_operation(std::string_view word) const {
    return format_ == TowerFormat::zigzag ? is_zigzag_operation(word) : is_tower_operation(word);
  }
  Status check_rows(std::span<const std::uint64_t>& rows);
  [[nodiscard]] bool is_stopped() const { return source_.is_stopped(); }
  [[nodiscard]] Error error(const std::string& what) const { return {Errc::bad_input, place() + what}; }

  ByteSource source_;
  TowerFormat format_;
  std::size_t longest_;                ///< that a line may be
  std::string_view text_;              ///< the line read last, in the window of the source
  std::vector<std::uint64_t> labels_;  ///< of the last operation, unless they are used where they lie
  std::uint64_t line_ = 0;             ///< see line()
  std::uint64_t operations_ = 0;
  bool is_traced_ = false;  ///< each operation is to be said; asked once, since a level costs more than a column
  std::optional<std::uint64_t> columns_;  ///< that the header announces
  std::optional<FacetParser> facets_;
  std::uint64_t first_line_ = 0;  ///< of a tower: the line of its first operation, which says whether all have times
  bool is_timed_ = false;
  TimeReader times_;
  engine::Time time_;  ///< of the last operation whose line says it
  int dimension_ = 0;  ///< of the present line
  bool is_done_ = false;
};

}  // namespace sesame::replay
