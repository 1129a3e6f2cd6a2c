// The format: Greg Turk, "The PLY Polygon File Format" (1994).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "tools/mesh/ply_header.hpp"
#include "tools/mesh/readers.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

/// The values after the header, one after the other, as doubles, which hold every type exactly.
class Values {
 public:
  Values(PlyEncoding encoding, const LineReader& lines, std::string_view name)
      : encoding_{encoding},
        words_{lines, WordReader::Comments::none},
        text_{lines.text()},
        name_{name},
        at_{std::min(lines.offset(), text_.size())} {
    // Where lines end in \r alone, a \n after `end_header` is data.
    const bool lone_returns = text_.starts_with("ply\r") && !text_.starts_with("ply\r\n");
    if (lone_returns && at_ >= 2 && text_.substr(at_ - 2, 2) == "\r\n") {
      --at_;
    }
  }

  [[nodiscard]] bool is_ascii() const { return encoding_ == PlyEncoding::ascii; }
  [[nodiscard]] std::size_t remaining() const { return is_ascii() ? words_.remaining() : text_.size() - at_; }

  bool read(PlyType type, double& value) { return is_ascii() ? read_word(value) : read_binary(type, value); }

  /// An error at the value that was read last, or that could not be.
  [[nodiscard]] Error error(std::string_view what) const {
    return is_ascii() ? words_.error(what) : error_at_byte(name_, value_at_, what);
  }
  /// What follows the last value, as remarks name it; empty when nothing does.
  [[nodiscard]] std::string rest() {
    if (!is_ascii()) {
      return remaining() == 0 ? "" : counted(remaining(), "byte", "bytes");
    }
    return words_.next().empty() ? "" : fmt::format("line {} and what follows", words_.lines().number());
  }
  [[nodiscard]] std::string problem() const {
    if (!is_ascii() || word_.empty()) {
      return "the file ends";
    }
    return fmt::format("{} is not a number", shown(word_));
  }

 private:
  bool read_word(double& value) {
    word_ = words_.next();
    return parse_real(word_, value);
  }

  bool read_binary(PlyType type, double& value) {
    const std::size_t size = size_of(type);
    value_at_ = at_;
    if (text_.size() - at_ < size) {
      return false;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = encoding_ == PlyEncoding::big_endian ? i : size - 1 - i;
      bits = (bits << 8) | static_cast<unsigned char>(text_[at_ + place]);
    }
    at_ += size;
    value = value_of(type, bits);
    return true;
  }

  static double value_of(PlyType type, std::uint64_t bits) {
    switch (type) {
      case PlyType::int8:
        return static_cast<double>(static_cast<std::int8_t>(bits));
      case PlyType::int16:
        return static_cast<double>(static_cast<std::int16_t>(bits));
      case PlyType::int32:
        return static_cast<double>(static_cast<std::int32_t>(bits));
      case PlyType::float32:
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      case PlyType::float64:
        return std::bit_cast<double>(bits);
      case PlyType::uint8:
      case PlyType::uint16:
      case PlyType::uint32:
        break;
    }
    return static_cast<double>(bits);
  }

  PlyEncoding encoding_;
  WordReader words_;
  std::string_view text_;
  std::string_view name_;
  std::string_view word_;
  std::size_t at_;
  std::size_t value_at_ = at_;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, std::string_view name) : lines_{bytes, name}, name_{name} {}

  Result<Mesh> read() {
    auto header = read_ply_header(lines_);
    if (!header) {
      return header.error();
    }
    Values values{header->encoding, lines_, name_};
    bool has_points = false;
    for (const auto& element : header->elements) {
      if (element.name != "vertex") {
        continue;
      }
      points_ = element.count;
      has_points = true;
    }
    for (const auto& element : header->elements) {
      if (auto done = check(element, values); !done) {
        return done.error();
      }
      for (std::uint64_t row = 0; row < element.count; ++row) {
        if (auto done = read_row(element, row, values); !done) {
          return done.error();
        }
        if (auto done = use_row(element, row, values); !done) {
          return done.error();
        }
      }
    }
    if (!has_points) {
      return lines_.error("the header announces no element `vertex`");
    }
    if (mesh_.points.size() != points_) {
      return lines_.error("element `vertex` is announced twice");
    }
    for (const auto& element : header->elements) {
      remark_skipped(element);
    }
    if (const auto rest = values.rest(); !rest.empty()) {
      mesh_.remarks.push_back(fmt::format("left out {} after the last element", rest));
    }
    if (short_strips_ > 0) {
      mesh_.remarks.push_back(
          fmt::format("left out {} of fewer than three points", counted(short_strips_, "strip", "strips")));
    }
    return std::move(mesh_);
  }

 private:
  /// Whether an element has the properties that are needed, and whether its rows can fit into what is left.
  Status check(const PlyElement& element, const Values& values) {
    std::uint64_t least = 0;
    for (const auto& property : element.properties) {
      least += values.is_ascii() ? 1 : size_of(property.count.value_or(property.type));
    }
    if (element.count > 0 && least == 0) {
      return lines_.error(fmt::format("element {} has no property", shown(element.name)));
    }
    if (element.count > 0 && element.count > values.remaining() / least) {
      return values.error(fmt::format("{} of element {} announced, but only {}", counted(element.count, "row", "rows"),
                                      shown(element.name) + (element.count == 1 ? " is" : " are"),
                                      counted(values.remaining(), "byte follows", "bytes follow")));
    }
    uses_ = element.count == 0 ? std::array<std::size_t, 3>{} : properties_of(element);
    for (const auto use : uses_) {
      if (use >= element.properties.size() && element.count > 0 && is_used(element)) {
        return lines_.error(
            fmt::format("element {} lacks a property, {} is expected", shown(element.name), needed_of(element)));
      }
    }
    return Done{};
  }

  static bool has_corners(const PlyElement& element) { return element.name == "face" || element.name == "tristrips"; }
  static bool is_used(const PlyElement& element) {
    return element.name == "vertex" || element.name == "edge" || has_corners(element);
  }

  static std::string_view needed_of(const PlyElement& element) {
    if (element.name == "vertex") {
      return "`x`, `y` and `z`, numbers,";
    }
    if (has_corners(element)) {
      return "`vertex_indices` or `vertex_index`, a list,";
    }
    return "`vertex1` and `vertex2`, numbers,";
  }

  /// Where the properties that are used stand in a row; a position past the end for one that is missing or is a list
  /// in the place of a number, or the reverse.
  static std::array<std::size_t, 3> properties_of(const PlyElement& element) {
    const auto find = [&element](std::string_view name, bool list) {
      const auto place = element.find(name);
      const bool fits = place < element.properties.size() && element.properties[place].count.has_value() == list;
      return fits ? place : element.properties.size();
    };
    if (element.name == "vertex") {
      return {find("x", false), find("y", false), find("z", false)};
    }
    if (element.name == "edge") {
      return {find("vertex1", false), find("vertex2", false), 0};
    }
    if (!has_corners(element)) {
      return {};
    }
    const auto list = std::min(find("vertex_indices", true), find("vertex_index", true));
    return {list, list, list};
  }

  /// Reads a row: its numbers to row_, the list that holds the corners to corners_.
  Status read_row(const PlyElement& element, std::uint64_t row, Values& values) {
    row_.assign(element.properties.size(), 0);
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const auto& property = element.properties[i];
      const bool is_corners = has_corners(element) && i == uses_[0];
      double& value = row_[i];
      if (is_corners) {
        corners_.clear();
      }
      bool there = values.read(property.count.value_or(property.type), value);
      if (there && property.count) {
        if (value < 0 || value != std::floor(value)) {
          return values.error("the length of a list is not a number from 0");
        }
        for (double k = value; there && k > 0; --k) {
          there = values.read(property.type, value);
          if (there && is_corners) {
            corners_.push_back(value);
          }
        }
      }
      if (!there) {
        return values.error(fmt::format("{} in row {} of the {} of element {}", values.problem(), row, element.count,
                                        shown(element.name)));
      }
    }
    return Done{};
  }

  Status use_row(const PlyElement& element, std::uint64_t row, const Values& values) {
    if (element.name == "vertex") {
      Point point{};
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] = row_[uses_[i]];
        if (!std::isfinite(point[i])) {
          return values.error(fmt::format("a coordinate of point {} is not finite", row));
        }
      }
      mesh_.points.push_back(point);
    } else if (element.name == "tristrips") {
      return use_strips(values);
    } else if (element.name == "face") {
      for (const double corner : corners_) {
        std::uint32_t point = 0;
        if (auto done = to_point(corner, values, point); !done) {
          return done;
        }
        mesh_.faces.push_corner(point);
      }
      mesh_.faces.close_face();
    } else if (element.name == "edge") {
      Edge edge{};
      for (std::size_t i = 0; i < 2; ++i) {
        if (auto done = to_point(row_[uses_[i]], values, edge[i]); !done) {
          return done;
        }
      }
      mesh_.lines.push_back(edge);
    }
    return Done{};
  }

  /// In a strip each point makes a triangle with the two before it, every second one turned over. -1 begins another.
  Status use_strips(const Values& values) {
    constexpr double restart = -1;
    constexpr double unsigned_restart = 0xffffffff;
    std::vector<std::uint32_t> strip;
    const auto end_strip = [&] {
      if (!strip.empty() && strip.size() < 3) {
        ++short_strips_;
      }
      strip.clear();
    };
    for (const double corner : corners_) {
      if (corner == restart || corner == unsigned_restart) {
        end_strip();
        continue;
      }
      if (auto done = to_point(corner, values, strip.emplace_back()); !done) {
        return done;
      }
      if (strip.size() < 3) {
        continue;
      }
      const auto* const last = &strip.back();
      const bool is_turned = strip.size() % 2 == 0;
      mesh_.faces.push_face(std::array{last[is_turned ? -1 : -2], last[is_turned ? -2 : -1], *last});
    }
    end_strip();
    return Done{};
  }

  Status to_point(double number, const Values& values, std::uint32_t& point) const {
    if (!(number >= 0 && number < static_cast<double>(points_) && number == std::floor(number))) {
      return values.error(
          fmt::format("{} does not number a point, the {} points are numbered from 0", number, points_));
    }
    point = static_cast<std::uint32_t>(number);
    return Done{};
  }

  void remark_skipped(const PlyElement& element) {
    if (is_used(element) || element.count == 0) {
      return;
    }
    mesh_.remarks.push_back(
        fmt::format("left out {} of element {}", counted(element.count, "row", "rows"), shown(element.name)));
  }

  LineReader lines_;
  std::string_view name_;
  std::uint64_t points_ = 0;
  std::array<std::size_t, 3> uses_{};
  std::vector<double> row_;
  std::vector<double> corners_;
  std::size_t short_strips_ = 0;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> read_ply(std::string_view bytes, std::string_view name) { return PlyReader{bytes, name}.read(); }

}  // namespace sesame::tools
