// The lines and columns of PHAT's boundary matrices.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "replay/tower/tower_reader.hpp"

namespace sesame::replay {
namespace {

constexpr std::size_t word_size = sizeof(std::uint64_t);
constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// Makes the window that long; false when the input is shorter.
Result<bool> wait_for(ByteSource& source, std::size_t bytes) {
  while (source.window().size() < bytes) {
    Result<bool> got = source.more();
    if (!got || !*got) {
      return got;
    }
  }
  return true;
}

}  // namespace

/// Checks the rows of the column whose index is the number of operations; makes them ascending when they are not.
Status TowerReader::check_rows(std::span<const std::uint64_t>& rows) {
  bool is_ascending = true;
  std::uint64_t least = 0;
  for (const std::uint64_t row : rows) {
    if (row >= operations_) {
      return error(fmt::format("row {} of column {} should be the index of a column before it", row, operations_));
    }
    is_ascending = is_ascending && row >= least;
    least = row + 1;
  }
  if (is_ascending) {
    return Done{};
  }
  if (rows.data() != labels_.data()) {
    labels_.assign(rows.begin(), rows.end());
  }
  std::sort(labels_.begin(), labels_.end());
  rows = labels_;
  const auto twice = std::adjacent_find(rows.begin(), rows.end());
  if (twice != rows.end()) {
    return error(fmt::format("row {} should not be listed twice", *twice));
  }
  return Done{};
}

Result<bool> TowerReader::read_phat_line(TowerOperation& into) {
  Result<bool> got = read_content_line();
  if (!got || !*got) {
    return got;
  }
  LineWords words(text_);
  if (Status read = read_dimension(words); !read) {
    return read.error();
  }
  if (Status read = read_labels(words, no_limit, "a row"); !read) {
    return read.error();
  }
  std::span<const std::uint64_t> rows = labels_;
  if (Status checked = check_rows(rows); !checked) {
    return checked.error();
  }
  into = {TowerOperation::Kind::column, operations_, dimension_, rows};
  return true;
}

Result<bool> TowerReader::read_header() {
  Result<bool> got = wait_for(source_, word_size);
  if (!got || (!*got && is_stopped())) {
    return got;
  }
  if (!*got) {
    return Error{Errc::bad_input, source_.name() +
                                      ": a binary PHAT matrix should start with the number of its "
                                      "columns, in 8 bytes; the file is shorter"};
  }
  const std::uint64_t columns = *reinterpret_cast<const std::uint64_t*>(source_.window().data());
  if (columns > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
    return Error{Errc::bad_input, fmt::format("{}: the header of the binary PHAT matrix should be the number of its "
                                              "columns, not {}",
                                              source_.name(), static_cast<std::int64_t>(columns))};
  }
  source_.consume(word_size);
  columns_ = columns;
  return true;
}

Result<bool> TowerReader::finish_columns() {
  Result<bool> got = wait_for(source_, 1);
  if (!got || !*got) {
    return got;
  }
  return Error{Errc::bad_input, fmt::format("{}: the header says {} columns, but the file goes on after them",
                                            source_.name(), *columns_)};
}

/// Makes the window that many numbers long. Errors: when the input ends before.
Result<bool> TowerReader::wait_for_column(std::size_t numbers) {
  Result<bool> got = wait_for(source_, numbers * word_size);
  if (!got || *got || is_stopped()) {
    return got;
  }
  return error(fmt::format("the file ends here, but its header says {} columns", *columns_));
}

Result<bool> TowerReader::read_column(TowerOperation& into) {
  if (!columns_) {
    Result<bool> got = read_header();
    if (!got || !*got) {
      return got;
    }
  }
  if (operations_ == *columns_) {
    return finish_columns();
  }
  line_ = operations_;
  if (Result<bool> got = wait_for_column(2); !got || !*got) {
    return got;
  }
  const auto* head = reinterpret_cast<const std::uint64_t*>(source_.window().data());
  const std::uint64_t dimension = head[0], count = head[1];
  if (dimension > std::uint64_t{std::numeric_limits<int>::max()}) {
    return error(fmt::format("{} should be a dimension, from 0 on", static_cast<std::int64_t>(dimension)));
  }
  if (count > operations_) {
    return error(fmt::format("{} should be the number of its rows, at most the {} columns before it",
                             static_cast<std::int64_t>(count), operations_));
  }
  const auto size = static_cast<std::size_t>(2 + count) * word_size;
  if (Result<bool> got = wait_for_column(2 + static_cast<std::size_t>(count)); !got || !*got) {
    return got;
  }
  std::span<const std::uint64_t> rows{reinterpret_cast<const std::uint64_t*>(source_.window().data()) + 2,
                                      static_cast<std::size_t>(count)};
  source_.consume(size);
  if (Status checked = check_rows(rows); !checked) {
    return checked.error();
  }
  const std::span<const std::uint64_t> ahead{reinterpret_cast<const std::uint64_t*>(source_.window().data()),
                                             source_.window().size() / word_size};
  into = {TowerOperation::Kind::column, operations_, static_cast<int>(dimension), rows, ahead};
  return true;
}

}  // namespace sesame::replay
