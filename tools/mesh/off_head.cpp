#include "tools/mesh/off_head.hpp"

#include <fmt/format.h>

namespace sesame::tools {

std::optional<std::string_view> parse_off_keyword(std::string_view word, OffHead& head) {
  const std::size_t end = word.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
  if (end < 3 || lower_case(word.substr(end - 3, 3)) != "off") {
    return std::nullopt;
  }
  std::string_view prefixes = word.substr(0, end - 3);
  const auto take = [&prefixes](std::string_view prefix, bool& is_there) {
    if (is_there || lower_case(prefixes.substr(0, prefix.size())) != prefix) {
      return false;
    }
    prefixes.remove_prefix(prefix.size());
    return is_there = true;
  };
  while (!prefixes.empty()) {
    bool& n = prefixes[0] == 'n' ? head.has_dimension : head.has_normals;
    const bool is_known =
        take("st", head.has_texture) || take("c", head.has_colours) || take("4", head.is_homogeneous) || take("n", n);
    if (!is_known) {
      return std::nullopt;
    }
  }
  head.is_ambiguous = head.has_dimension && word[end - 1] == 'f';
  head.coordinates = head.is_homogeneous ? 4 : 3;
  head.other_numbers = (head.has_normals ? 3 : 0) + (head.has_colours ? 4 : 0) + (head.has_texture ? 2 : 0);
  return word.substr(end);
}

namespace {

class HeadReader {
 public:
  explicit HeadReader(WordReader& words) : words_{words} {}

  Result<OffHead> read() {
    auto word = words_.next();
    std::int64_t number = 0;
    if (const auto glued = parse_off_keyword(word, head_)) {
      if (head_.is_ambiguous) {
        return words_.error(fmt::format(
            "{} may be NOFF, with normals, or nOFF, with a dimension, write the one that is meant", shown(word)));
      }
      word = glued->empty() ? words_.next() : *glued;
    } else if (!parse_integer(word, number)) {
      return words_.error(fmt::format("{} in the place of the head of an OFF file, `OFF` is expected", shown(word)));
    } else {
      head_.has_keyword = false;
    }
    if (word == "BINARY") {
      return words_.error("binary OFF is not read, save the mesh as ASCII OFF or binary PLY");
    }
    if (head_.has_dimension) {
      if (auto done = read_dimension(word); !done) {
        return done.error();
      }
      word = words_.next();
    }
    if (auto done = read_count(word, "points", head_.points); !done) {
      return done.error();
    }
    if (auto done = read_count(words_.next(), "faces", head_.faces); !done) {
      return done.error();
    }
    if (auto done = skip_count_of_edges(); !done) {
      return done.error();
    }
    if (auto done = check_counts(); !done) {
      return done.error();
    }
    return head_;
  }

 private:
  Status read_count(std::string_view word, std::string_view what, std::uint64_t& count) const {
    std::int64_t value = 0;
    if (!parse_integer(word, value) || value < 0) {
      return words_.error(
          fmt::format("{} in the place of the number of {}, a number from 0 is expected", shown(word), what));
    }
    count = static_cast<std::uint64_t>(value);
    return Done{};
  }

  Status read_dimension(std::string_view word) {
    std::uint64_t dimension = 0;
    if (auto done = read_count(word, "coordinates", dimension); !done) {
      return done;
    }
    if (dimension == 0 || dimension > 1000) {
      return words_.error("points of nOFF have 1 to 1000 coordinates");
    }
    head_.coordinates = static_cast<std::size_t>(dimension) + (head_.is_homogeneous ? 1 : 0);
    return Done{};
  }

  /// Many files lack it. It follows on the same line, or is alone on the next one, where no point would be.
  Status skip_count_of_edges() {
    std::uint64_t edges = 0;
    auto word = words_.next_in_line();
    if (!word.empty()) {
      return read_count(word, "edges", edges);
    }
    WordReader ahead = words_;
    word = ahead.next();
    const bool is_alone = ahead.next_in_line().empty();
    if (head_.points > 0 && is_alone && read_count(word, "edges", edges)) {
      words_ = ahead;
    }
    return Done{};
  }

  /// Claims that no file of this size can keep are refused here; those that come close, where the file ends.
  Status check_counts() const {
    const std::size_t room = words_.remaining();
    if (head_.points <= room && head_.faces <= room) {
      return Done{};
    }
    return words_.error(fmt::format("{} and {} are announced, but only {}", counted(head_.points, "point", "points"),
                                    counted(head_.faces, "face", "faces"),
                                    counted(room, "byte follows", "bytes follow")));
  }

  WordReader& words_;
  OffHead head_;
};

}  // namespace

Result<OffHead> read_off_head(WordReader& words) { return HeadReader{words}.read(); }

}  // namespace sesame::tools
