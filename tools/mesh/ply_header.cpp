#include "tools/mesh/ply_header.hpp"

#include <fmt/format.h>

#include <array>

namespace sesame::tools {

namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr auto type_names = std::to_array<TypeName>({{"char", PlyType::int8},
                                                     {"uchar", PlyType::uint8},
                                                     {"short", PlyType::int16},
                                                     {"ushort", PlyType::uint16},
                                                     {"int", PlyType::int32},
                                                     {"uint", PlyType::uint32},
                                                     {"float", PlyType::float32},
                                                     {"double", PlyType::float64},
                                                     {"int8", PlyType::int8},
                                                     {"uint8", PlyType::uint8},
                                                     {"int16", PlyType::int16},
                                                     {"uint16", PlyType::uint16},
                                                     {"int32", PlyType::int32},
                                                     {"uint32", PlyType::uint32},
                                                     {"float32", PlyType::float32},
                                                     {"float64", PlyType::float64}});

std::optional<PlyType> type_of(std::string_view name) {
  const auto* const found =
      std::find_if(type_names.begin(), type_names.end(), [name](const TypeName& entry) { return entry.name == name; });
  if (found == type_names.end()) {
    return std::nullopt;
  }
  return found->type;
}

/// Reads the lines up to `end_header`.
class HeaderReader {
 public:
  explicit HeaderReader(LineReader& lines) : lines_{lines} {}

  Result<PlyHeader> read() {
    if (!lines_.next() || word_of_line() != "ply") {
      return lines_.error("a PLY file begins with a line `ply`");
    }
    bool has_format = false;
    while (lines_.next()) {
      const auto keyword = word_of_line();
      Status done = Done{};
      if (keyword == "end_header") {
        if (!has_format) {
          return lines_.error("the header ends without a line `format ascii 1.0` or `format binary_...`");
        }
        return std::move(header_);
      }
      if (keyword == "format") {
        done = read_format();
        has_format = true;
      } else if (keyword == "element") {
        done = read_element();
      } else if (keyword == "property") {
        done = read_property();
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        return lines_.error(fmt::format(
            "{} in the header, `element`, `property`, `comment` or `end_header` is expected", shown(keyword)));
      }
      if (!done) {
        return done.error();
      }
    }
    return lines_.error("the file ends before `end_header`");
  }

 private:
  std::string_view word_of_line() {
    rest_ = lines_.line();
    return next_word(rest_);
  }

  Status read_format() {
    const auto encoding = next_word(rest_);
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      return lines_.error(
          fmt::format("the format {} is unknown, `ascii`, `binary_little_endian` or "
                      "`binary_big_endian` is expected",
                      shown(encoding)));
    }
    return Done{};
  }

  Status read_element() {
    PlyElement element;
    element.name = next_word(rest_);
    const auto word = next_word(rest_);
    std::int64_t count = 0;
    if (!parse_integer(word, count) || count < 0) {
      return lines_.error(fmt::format("element {} has {} in the place of its number, which is one from 0",
                                      shown(element.name), shown(word)));
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
    return Done{};
  }

  Status read_property() {
    if (header_.elements.empty()) {
      return lines_.error("a property before any `element`");
    }
    PlyProperty property{};
    auto word = next_word(rest_);
    if (word == "list") {
      word = next_word(rest_);
      property.count = type_of(word);
      if (!property.count || *property.count == PlyType::float32 || *property.count == PlyType::float64) {
        return lines_.error(fmt::format("a list counts its entries in {}, an integer type is expected", shown(word)));
      }
      word = next_word(rest_);
    }
    const auto type = type_of(word);
    property.name = next_word(rest_);
    if (!type || property.name.empty()) {
      return lines_.error(
          fmt::format("{} {} is not a property, a type (char uchar short ushort int uint float double, "
                      "or int8 ... float64) and a name are expected",
                      shown(word), shown(property.name)));
    }
    property.type = *type;
    header_.elements.back().properties.push_back(property);
    return Done{};
  }

  LineReader& lines_;
  std::string_view rest_;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> read_ply_header(LineReader& lines) { return HeaderReader{lines}.read(); }

}  // namespace sesame::tools
