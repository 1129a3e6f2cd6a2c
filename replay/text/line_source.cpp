#include "replay/text/line_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/text/line_words.hpp"

namespace sesame::replay {

Result<std::size_t> find_line_end(ByteSource& source, std::size_t begin, std::uint64_t line, std::size_t longest) {
  for (std::size_t searched = begin;;) {
    const std::size_t end = std::min(source.window().find('\n', searched), source.window().size());
    const std::size_t zero = source.window().substr(0, end).find('\0', searched);
    if (zero != std::string_view::npos && zero - begin <= longest) {
      return Error{Errc::bad_input, fmt::format("{}:{}: byte {} of this line is zero, and no text has such bytes",
                                                source.name(), line, zero - begin)};
    }
    if (end - begin > longest) {
      return Error{Errc::bad_input, fmt::format("{}:{}: this line is longer than {} bytes; where such lines are "
                                                "meant, --max-line (replay, tower) raises the limit",
                                                source.name(), line, longest)};
    }
    if (end < source.window().size()) {
      return end;
    }
    searched = end;
    const Result<bool> got = source.more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      return searched;
    }
  }
}

Result<std::string_view> LineSource::beginning() {
  constexpr std::size_t most = std::size_t{1} << 16;
  constexpr std::string_view space = " \t\r\n";
  bool says_something = false;
  for (std::size_t at = 0;;) {
    const std::string_view text = source_.window().substr(0, most);
    for (; at < text.size(); ++at) {
      if (text[at] == '\0' || (says_something && text[at] == '\n')) {
        return text.substr(0, at + 1);
      }
      says_something = says_something || space.find(text[at]) == std::string_view::npos;
    }
    if (text.size() == most) {
      return text;
    }
    const Result<bool> got = source_.more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      return text;
    }
  }
}

Result<std::optional<std::string_view>> LineSource::next() {
  if (is_done_) {
    return std::optional<std::string_view>{};
  }
  ++line_;
  const Result<std::size_t> end = find_line_end(source_, 0, line_, longest_);
  is_broken_ = !end;
  has_end_ = end && *end < source_.window().size();
  is_done_ = !has_end_;
  if (!end) {
    return end.error();
  }
  if (is_done_ && (*end == 0 || source_.is_stopped())) {
    --line_;
    return std::optional<std::string_view>{};
  }
  std::string_view text = source_.window().substr(0, *end);
  source_.consume(std::min(*end + 1, source_.window().size()));
  if (line_ == 1) {
    text = without_mark(text);
  }
  return std::optional{text};
}

std::string LineSource::place() const { return fmt::format("{}:{}: ", source_.name(), line_); }

}  // namespace sesame::replay
