#include "replay/tower/tower_reader.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <algorithm>
#include <limits>

#include "replay/text/log.hpp"
#include "replay/text/text_buffer.hpp"
#include "sparse/contract.hpp"

namespace sesame::replay {
namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// What a line of a tower or a zigzag may be.
constexpr std::string_view operations_of(TowerFormat format) {
  return format == TowerFormat::zigzag
             ? "i (a simplex is included), d or r (one is deleted) or c (a vertex is contracted)"
             : "i (a simplex is included) or c (a vertex is contracted)";
}

}  // namespace

Result<std::unique_ptr<TowerReader>> TowerReader::open(const std::string& path, TowerFormat format,
                                                       const std::atomic<bool>* stop, std::size_t longest) {
  Result<ByteSource> source = ByteSource::open(path, {stop});
  if (!source) {
    return source.error();
  }
  return from(std::move(*source), format, longest);
}

Result<std::unique_ptr<TowerReader>> TowerReader::from(ByteSource source, TowerFormat format, std::size_t longest) {
  if (format == TowerFormat::automatic) {
    const Result<TowerFormat> found = find_format(source, longest);
    if (!found) {
      return found.error();
    }
    format = *found;
  } else if (format == TowerFormat::zigzag) {
    const Result<bool> script = is_script(source, longest);
    if (!script) {
      return script.error();
    }
    format = *script ? TowerFormat::script : format;
  }
  tower_log().info("{}: read as {}", source.name(), format_description(format));
  std::unique_ptr<TowerReader> reader(new TowerReader(std::move(source), format, longest));
  reader->is_traced_ = tower_log().should_log(spdlog::level::trace);
  return reader;
}

std::string TowerReader::place() const {
  return format_ == TowerFormat::phat_binary ? fmt::format("{}: column {}: ", source_.name(), line_)
                                             : fmt::format("{}:{}: ", source_.name(), line_);
}

ScriptReader TowerReader::take_script() {
  sparse::expects(format_ == TowerFormat::script && !is_done_, "a script is taken once, and from an input that is one");
  is_done_ = true;
  return ScriptReader(std::move(source_), longest_);
}

Result<bool> TowerReader::next(TowerOperation& into) {
  if (is_done_) {
    return false;
  }
  Result<bool> got = read_operation(into);
  if (got && *got) {
    [[likely]] { ++operations_; }
    if (is_traced_) {
      tower_log().trace("line {}: operation {}", line_, operations_);
    }
  } else {
    is_done_ = true;
    tower_log().info("{}: {} operations were read", name(), operations_);
  }
  return got;
}

Result<bool> TowerReader::read_operation(TowerOperation& into) {
  switch (format_) {
    case TowerFormat::tower:
    case TowerFormat::zigzag:
      return read_tower_line(into);
    case TowerFormat::phat:
      return read_phat_line(into);
    case TowerFormat::gudhi:
      return read_gudhi_line(into);
    case TowerFormat::facets:
      return read_facet(into);
    case TowerFormat::phat_binary:
      return read_column(into);
    case TowerFormat::automatic:
    case TowerFormat::script:
      break;
  }
  sparse::expects(false, "a script is read by a ScriptReader");
  return false;
}

// ------------------------------------------------------------------------------------------------------------- lines

Result<bool> TowerReader::read_line() {
  const Result<std::size_t> end = find_line_end(source_, 0, line_ + 1, longest_);
  if (!end) {
    return end.error();
  }
  const std::size_t size = source_.window().size();
  if (*end == size && (size == 0 || is_stopped())) {  // a line that was still being written is none
    return false;
  }
  text_ = source_.window().substr(0, *end);
  source_.consume(std::min(*end + 1, size));
  if (++line_ == 1) {
    text_ = without_mark(text_);
  }
  return true;
}

Result<bool> TowerReader::read_content_line() {
  while (true) {
    Result<bool> got = read_line();
    if (!got || !*got || !LineWords(text_).is_done()) {
      return got;
    }
  }
}

Status TowerReader::read_dimension(LineWords& words) {
  std::uint32_t dimension = 0;
  if (!words.take_number(dimension) || dimension > std::numeric_limits<int>::max()) {
    return error(fmt::format("{} should be a dimension, a whole number from 0 on", shown(words.word())));
  }
  dimension_ = static_cast<int>(dimension);
  return Done{};
}

Status TowerReader::read_labels(LineWords& words, std::size_t count, const char* what) {
  labels_.clear();
  while (!words.is_done() && labels_.size() < count) {
    if (!words.take_number(labels_.emplace_back())) {
      return error(fmt::format("{} should be {}, a whole number from 0 to 2^64 - 1", shown(words.word()), what));
    }
  }
  return Done{};
}

Status TowerReader::read_time(LineWords& words, std::string_view what) {
  const std::string_view text = words.take();
  const Result<engine::Time> time = times_.read(text, what, source_.name(), line_);
  if (!time) {
    return error(time.error().what);
  }
  if (!time->is_finite()) {
    return error(fmt::format("{} should be {}", shown(text), what));
  }
  if (operations_ > 0 && *time < time_) {
    return error(fmt::format("{} comes after {}: times should not decrease", number_text(*time), number_text(time_)));
  }
  time_ = *time;
  return Done{};
}

/// The time of an operation in a tower, given or not.
Status TowerReader::read_optional_time(LineWords& words) {
  if (format_ == TowerFormat::tower && !is_operation(words.word()) && is_zigzag_operation(words.word())) {
    return error(fmt::format("{} deletes a simplex, which a tower cannot; sesame zigzag can", shown(words.word())));
  }
  const bool is_timed = !is_operation(words.word());
  if (operations_ == 0) {
    is_timed_ = is_timed;
    first_line_ = line_;
  }
  if (is_timed) {
    Status read = read_time(words, std::string{operations_of(format_)} + ", perhaps after a time, a finite number");
    if (!read) {
      return read;
    }
  } else {
    time_ = operations_;
  }
  if (is_timed == is_timed_) {
    return Done{};
  }
  return error(fmt::format("an operation {} a time, but the one of line {} {}: all should have one, or none",
                           is_timed ? "with" : "without", first_line_, is_timed ? "has none" : "has one"));
}

Result<bool> TowerReader::read_tower_line(TowerOperation& into) {
  Result<bool> got = read_content_line();
  if (!got || !*got) {
    return got;
  }
  LineWords words(text_);
  if (Status read = read_optional_time(words); !read) {
    return read.error();
  }
  const std::string_view operation = words.take();
  if (!is_operation(operation)) {
    return error(fmt::format("after the time, {} should be {}", shown(operation), operations_of(format_)));
  }
  if (Status read = read_labels(words, no_limit, "a vertex"); !read) {
    return read.error();
  }
  if (labels_.empty()) {
    return error(fmt::format("{} should be followed by vertices", operation));
  }
  if (operation != "c") {
    into = {operation == "i" ? TowerOperation::Kind::insert : TowerOperation::Kind::remove, time_,
            static_cast<int>(labels_.size() - 1), labels_};
    return true;
  }
  if (labels_.size() != 2) {
    return error(fmt::format("c should be followed by 2 vertices, not {}", labels_.size()));
  }
  into = {TowerOperation::Kind::contract, time_, 0, labels_};
  return true;
}

Result<bool> TowerReader::read_gudhi_line(TowerOperation& into) {
  Result<bool> got = read_content_line();
  if (!got || !*got) {
    return got;
  }
  LineWords words(text_);
  if (Status read = read_dimension(words); !read) {
    return read.error();
  }
  const std::size_t vertices = static_cast<std::size_t>(dimension_) + 1;
  if (Status read = read_labels(words, vertices, "a vertex"); !read) {
    return read.error();
  }
  if (const std::size_t count = labels_.size() + words.count(); count != vertices + 1) {
    return error(fmt::format("a simplex of dimension {} should have {} vertices and then its value: {} numbers, not {}",
                             dimension_, vertices, vertices + 1, count));
  }
  if (Status read = read_time(words, "the value of the simplex, a finite number"); !read) {
    return read.error();
  }
  into = {TowerOperation::Kind::insert, time_, dimension_, labels_};
  return true;
}

Result<bool> TowerReader::read_facet(TowerOperation& into) {
  if (!facets_) {
    facets_.emplace(name());
  }
  std::optional<Facet> facet = facets_->next();
  while (!facet) {
    Result<bool> got = read_line();
    if (!got || (!*got && is_stopped())) {
      return got;
    }
    const Status taken = *got ? facets_->take(text_, line_) : facets_->finish();
    if (!taken) {
      return taken.error();
    }
    if (!*got) {
      return false;
    }
    facet = facets_->next();
  }
  labels_.clear();
  for (const std::string& label : facet->labels) {
    LineWords word(label);
    if (!word.take_number(labels_.emplace_back())) {
      return error(
          fmt::format("{} should be a vertex of a tower, a whole number from 0 to 2^64 - 1; in a script, which "
                      "sesame import makes of the list, it may be any name",
                      shown(label)));
    }
  }
  into = {TowerOperation::Kind::insert, static_cast<double>(operations_), static_cast<int>(labels_.size() - 1),
          labels_};
  return true;
}

}  // namespace sesame::replay
