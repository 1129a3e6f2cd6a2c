#include "engine/durable/log_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sesame::engine {
namespace {

/// Of a line that was cut off, or is blank or a comment; not of one of another kind of file.
bool may_begin_header(std::string_view line) {
  constexpr std::string_view beginning = "{\"sesame\"";
  const bool is_nothing = line.find_first_not_of(std::string_view{" \t\r\0", 4}) == std::string_view::npos;
  return is_nothing || line.starts_with('#') || line.starts_with(beginning) || beginning.starts_with(line);
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------- records

Result<RecordReader::Entry> RecordReader::take(std::string_view line) {
  const Result<LogLine> taken = lines_.take(line);
  is_damaged_ = !taken;
  if (!taken) {
    return taken.error();
  }
  if (taken->binding) {
    return Entry{*taken->binding};
  }
  if (taken->record.empty()) {
    return Entry{};
  }
  if (!std::exchange(has_header_, true)) {
    Result<ops::Header> header = ops::parse_header(taken->record);
    return header ? Result<Entry>{std::move(*header)} : header.error();
  }
  Result<ops::Operation> operation = operations_.read(taken->record);
  lines_.shrink();
  return operation ? Result<Entry>{std::move(*operation)} : operation.error();
}

Status RecordReader::pass_over(std::string_view line) {
  const Result<LogLine> taken = lines_.take(line);
  is_damaged_ = !taken;
  return taken ? Status{Done{}} : taken.error();
}

bool RecordReader::is_sound(std::string_view line) const {
  if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string_view::npos) {
    return true;
  }
  return has_header_ ? ops::parse_operation(line).has_value() : ops::parse_header(line).has_value();
}

// ------------------------------------------------------------------------------------------------------------- logs

ReadBytes bytes_of(File& file, std::string name, std::uint64_t from) {
  return [&file, name = std::move(name), from](std::span<char> to) mutable -> Result<std::size_t> {
    const Transfer got = file.read(from, to);
    if (got.error != 0) {
      return cannot_read_file(name, got.error);
    }
    from += got.bytes;
    return got.bytes;
  };
}

std::string LogReader::place() const { return fmt::format("{}:{}: ", name_, line_); }

Error LogReader::damaged(const std::string& what) {
  const LogPosition& good = position();
  damage_ = Damage{good.records, good.bytes, what};
  return {Errc::bad_input, fmt::format("{}record {}, at byte {}: {}; what comes before it is whole, and "
                                       "\"sesame verify {} --salvage NEW\" writes it into a new log",
                                       place(), damage_->record, damage_->byte, what, name_)};
}

/// The next line, from `begin_` to `end_`; whether it has an end.
Result<bool> LogReader::find_line() {
  constexpr std::size_t piece = std::size_t{1} << 18;
  std::size_t searched = begin_;
  while (true) {
    const std::size_t end = window_.find('\n', searched);
    if (end != std::string::npos && end - begin_ <= longest_) {
      end_ = end;
      return true;
    }
    searched = std::min(end, window_.size());
    if (searched - begin_ > longest_) {
      return damaged(fmt::format("this line is longer than {} bytes", longest_));
    }
    if (is_at_end_) {
      end_ = searched;
      return false;
    }
    window_.erase(0, begin_);
    begin_ = 0;
    searched = window_.size();
    window_.resize(searched + std::max(piece, searched));  // so that a long line is copied some times only
    const Result<std::size_t> got = read_(std::span(window_).subspan(searched));
    window_.resize(searched + (got ? *got : 0));
    if (!got) {
      return got.error();
    }
    is_at_end_ = *got == 0;
  }
}

Result<std::optional<RecordReader::Entry>> LogReader::next_entry() {
  while (true) {
    const Result<bool> has_end = find_line();
    if (!has_end) {
      return has_end.error();
    }
    const std::string_view line = std::string_view{window_}.substr(begin_, end_ - begin_);
    line_ += line.empty() && !*has_end ? 0 : 1;
    if (!*has_end && position_.records == 0 && !may_begin_header(line)) {
      return damaged("a log begins with its header, such as {\"sesame\":1,\"ring\":\"Z\"}");
    }
    if (!*has_end && (line.empty() || !is_last_of_script(line))) {
      torn_ = line.size();
      return std::optional<RecordReader::Entry>{};
    }
    Result<RecordReader::Entry> entry = records_.take(line);
    if (!entry) {
      const std::string what = entry.error().what;
      const bool has_zeros = position_.is_checked && line.find('\0') != std::string_view::npos;
      const Result<bool> is_torn = has_zeros ? is_torn_here() : false;
      if (!is_torn) {
        return is_torn.error();
      }
      return *is_torn ? Result<std::optional<RecordReader::Entry>>{std::optional<RecordReader::Entry>{}}
                      : damaged(what);
    }
    position_ = records_.position();
    begin_ = std::min(end_ + 1, window_.size());
    if (!std::holds_alternative<std::monostate>(*entry)) {
      return std::optional{std::move(*entry)};
    }
  }
}

/// Reads to the end, for what lines behind the one at hand say of it.
Result<bool> LogReader::is_torn_here() {
  std::uint64_t behind = end_ - begin_ + 1;
  while (true) {
    begin_ = std::min(end_ + 1, window_.size());
    const Result<bool> has_end = find_line();
    if (!has_end) {
      return has_end.error();
    }
    const auto claimed = claimed_sync(std::string_view{window_}.substr(begin_, end_ - begin_));
    if (claimed && *claimed >= position_.records) {
      return false;
    }
    behind += end_ - begin_ + (*has_end ? 1 : 0);
    if (!*has_end) {
      torn_ = behind;
      return true;
    }
  }
}

Result<bool> LogReader::skip_to(std::uint64_t bytes, Chain chain, std::uint64_t steps) {
  std::uint64_t size = 0;
  if (file_ == nullptr || file_->size(size) != 0 || size < bytes) {
    return false;
  }
  while (position_.bytes < bytes) {
    const Result<bool> has_end = find_line();
    if (!has_end) {
      return has_end.error();
    }
    const std::string_view line = std::string_view{window_}.substr(begin_, end_ - begin_);
    if (!*has_end || !records_.pass_over(line)) {
      break;  // what is wrong, whoever reads on will tell
    }
    ++line_;
    position_ = records_.position();
    begin_ = end_ + 1;
  }
  if (position_.bytes == bytes && position_.chain == chain && position_.steps() == steps) {
    return true;
  }
  *this = LogReader(name_, *file_, longest_);
  const Result<std::optional<ops::Header>> again = header();
  return again ? Result<bool>{false} : again.error();
}

/// Of a line without an end: whether it says something, and nothing promises more.
bool LogReader::is_last_of_script(std::string_view line) const {
  return !position_.is_checked && !LineChecker::is_checked(line) && records_.is_sound(line);
}

Result<std::optional<ops::Header>> LogReader::header() {
  Result<std::optional<RecordReader::Entry>> entry = next_entry();
  if (!entry) {
    return entry.error();
  }
  if (!*entry) {
    return std::optional<ops::Header>{};
  }
  if (auto* header = std::get_if<ops::Header>(&**entry)) {
    return std::optional{std::move(*header)};
  }
  return damaged("a log begins with its header, not with a line that binds what comes before it");
}

Result<std::optional<LogReader::Entry>> LogReader::next() {
  Result<std::optional<RecordReader::Entry>> entry = next_entry();
  if (!entry) {
    return entry.error();
  }
  if (!*entry) {
    return std::optional<Entry>{};
  }
  if (const auto* binding = std::get_if<Binding>(&**entry)) {
    return std::optional<Entry>{*binding};
  }
  return std::optional<Entry>{std::get<ops::Operation>(std::move(**entry))};
}

Status read_steps(File& file, const std::string& name, std::uint64_t steps,
                  const std::function<Status(ops::Operation)>& accept) {
  LogReader reader(name, file);
  Result<std::optional<ops::Header>> header = reader.header();
  if (!header) {
    return header.error();
  }
  while (reader.position().steps() < steps) {
    Result<std::optional<LogReader::Entry>> entry = reader.next();
    if (!entry) {
      return entry.error();
    }
    if (!*entry) {
      return Error{Errc::bad_input, name + ": steps that were written are not there any more"};
    }
    if (auto* operation = std::get_if<ops::Operation>(&**entry)) {
      if (Status accepted = accept(std::move(*operation)); !accepted) {
        return accepted;
      }
    }
  }
  return Done{};
}

}  // namespace sesame::engine
