#include "tools/mesh/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <utility>

#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using ops::Dart;
using ops::no_dart;

/// A link of a dart as the file has it.
struct Link {
  Dart from, to;
  int index;
  std::size_t line;
};

class MapFileReader {
 public:
  MapFileReader(std::string_view bytes, std::string_view name, std::optional<int> dimension)
      : bytes_{bytes}, name_{name}, dimension_{dimension} {}

  Result<MapFile> read() {
    const pugi::xml_parse_result parsed =
        document_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      return error_at(static_cast<std::size_t>(parsed.offset),
                      fmt::format("this is no XML, which CGAL's map files are: {}",
                                  lower_case(std::string_view{parsed.description()})));
    }
    const pugi::xml_node data = document_.child("data");
    const pugi::xml_node darts = data.child("darts");
    if (!darts) {
      return error(data ? data : document_.first_child(),
                   "there is no element `darts` in one `data`, as there is in CGAL's map files");
    }
    if (Status s = read_darts(darts); !s) {
      return s.error();
    }
    if (Status s = make_map(); !s) {
      return s.error();
    }
    for (const pugi::xml_node& child : data.children()) {
      const std::string_view is = child.name();
      if (is == "attributes") {
        if (Status s = read_attributes(child); !s) {
          return s.error();
        }
      } else if (is != "darts" && child.type() == pugi::node_element) {
        file_.remarks.push_back(fmt::format("left out the element {} of the file", shown(is)));
      }
    }
    return std::move(file_);
  }

 private:
  [[nodiscard]] std::size_t line_of(std::size_t offset) const {
    const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, bytes_.size()));
    return 1 + static_cast<std::size_t>(std::count(bytes_.begin(), end, '\n'));
  }
  /// That of a node which is asked for after the one before: the file is gone through once.
  [[nodiscard]] std::size_t line_of(const pugi::xml_node& node) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    if (offset < counted_to_) {
      return line_of(offset);
    }
    counted_ += static_cast<std::size_t>(std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(counted_to_),
                                                    bytes_.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
    counted_to_ = offset;
    return counted_;
  }
  [[nodiscard]] Error error_in_line(std::size_t line, std::string_view what) const {
    return {Errc::bad_input, fmt::format("{}:{}: {}", name_, line, what)};
  }
  [[nodiscard]] Error error_at(std::size_t offset, std::string_view what) const {
    return error_in_line(line_of(offset), what);
  }
  [[nodiscard]] Error error(const pugi::xml_node& node, std::string_view what) {
    return error_in_line(line_of(node), what);
  }

  Status read_darts(const pugi::xml_node& darts) {
    const auto children = darts.children("d");
    const auto count = std::distance(children.begin(), children.end());
    if (count == 0) {
      return error(darts, "there are no darts, elements `d` of `darts`: a map needs one at least");
    }
    if (count >= Dart{1} << 31) {
      return error(darts, "there are 2^31 darts or more: fewer are possible");
    }
    count_ = static_cast<Dart>(count);
    Dart dart = 0;
    for (const pugi::xml_node& each : children) {
      for (const pugi::xml_node& link : each.children()) {
        if (Status s = read_link(dart, link); !s) {
          return s;
        }
      }
      ++dart;
    }
    if (has_values_) {
      file_.remarks.emplace_back("left out the values of darts");
    }
    return Done{};
  }

  Status read_link(Dart dart, const pugi::xml_node& link) {
    const std::string_view is = link.name();
    has_values_ = has_values_ || is == "v";
    if (is != "a" && is != "b") {
      return Done{};
    }
    if (kind_.value_or(is[0]) != is[0]) {
      return error(link, fmt::format("dart {} has a link `{}`, and there are links `{}` before: in a combinatorial map "
                                     "all are `b`, in a generalized one all are `a`",
                                     dart + 1, is, *kind_));
    }
    kind_ = is[0];
    const int least = is == "a" ? 0 : 1;
    std::int64_t index = -1, to = 0;
    if (!parse_integer(trimmed(link.attribute("i").value()), index) || index < least ||
        index > ops::largest_map_dimension) {
      return error(link, fmt::format("a link of dart {} has the index {}: `i` should be a number from {} to {}",
                                     dart + 1, shown(link.attribute("i").value()), least, ops::largest_map_dimension));
    }
    if (dimension_ && index > *dimension_) {
      return error(link, fmt::format("dart {} has a link with index {}, and the dimension should be {}: --dim says "
                                     "which it is",
                                     dart + 1, index, *dimension_));
    }
    if (!parse_integer(trimmed(link.text().get()), to) || to < 1 || to > count_) {
      return error(link, fmt::format("a link of dart {} leads to {}: it should be the number of a dart, from 1 to {}",
                                     dart + 1, shown(link.text().get()), count_));
    }
    links_.push_back({dart, static_cast<Dart>(to - 1), static_cast<int>(index), line_of(link)});
    return Done{};
  }

  static std::string_view trimmed(std::string_view text) { return next_word(text); }
  [[nodiscard]] std::string_view letter() const { return kind_ == 'a' ? "alpha" : "beta"; }

  Status make_map() {
    int n = dimension_.value_or(kind_ == 'a' ? 0 : 1);
    for (const Link& link : links_) {
      n = std::max(n, link.index);
    }
    std::vector<std::vector<Dart>> images(static_cast<std::size_t>(n) + 1, std::vector<Dart>(count_, no_dart));
    for (const auto& [from, to, index, line] : links_) {
      Dart& image = images[static_cast<std::size_t>(index)][from];
      if (image != no_dart) {
        return error_in_line(
            line, fmt::format("dart {} has two links with index {}: it should have one at most", from + 1, index));
      }
      image = to;
    }
    for (const auto& [from, to, index, line] : links_) {
      const Dart back = images[static_cast<std::size_t>(index)][to];
      if (back != from && (kind_ == 'a' || index > 1)) {
        return error_in_line(line, fmt::format("{0}_{1} sends dart {2} to dart {3}, and that one {4}: it should be "
                                               "sent back",
                                               letter(), index, from + 1, to + 1,
                                               back == no_dart ? "nowhere" : fmt::format("to dart {}", back + 1)));
      }
    }
    return kind_ == 'a' ? make_gmap(std::move(images)) : make_nmap(std::move(images));
  }

  Status make_gmap(std::vector<std::vector<Dart>> images) {
    for (std::vector<Dart>& alpha : images) {
      for (Dart d = 0; d < count_; ++d) {
        alpha[d] = alpha[d] == no_dart ? d : alpha[d];
      }
    }
    Result<ops::GMap> map = ops::GMap::make(std::move(images));
    if (!map) {
      return broken_law(map.error());
    }
    file_.map = std::move(*map);
    return Done{};
  }

  Status make_nmap(std::vector<std::vector<Dart>> images) {
    images.erase(images.begin());
    Result<ops::NMap> map = ops::NMap::make(std::move(images));
    if (!map) {
      return broken_law(map.error());
    }
    file_.map = std::move(*map);
    return Done{};
  }

  [[nodiscard]] Error broken_law(const Error& error) const {
    return {Errc::bad_input, fmt::format("{}: with darts counted from 0, {}", name_, error.what)};
  }

  Status read_attributes(const pugi::xml_node& attributes) {
    for (const pugi::xml_node& dimension : attributes.children("dimension")) {
      const std::string_view index = trimmed(dimension.attribute("index").value());
      if (index != "0") {
        file_.remarks.push_back(fmt::format("left out the attributes of dimension {}", shown(index)));
        continue;
      }
      for (const pugi::xml_node& attribute : dimension.children("a")) {
        if (Status s = read_vertex(attribute); !s) {
          return s;
        }
      }
    }
    return Done{};
  }

  Status read_vertex(const pugi::xml_node& attribute) {
    const pugi::xml_node point = attribute.child("p");
    if (!point) {
      return Done{};
    }
    std::int64_t dart = 0;
    if (!parse_integer(trimmed(attribute.child("d").text().get()), dart) || dart < 1 || dart > count_) {
      return error(attribute, fmt::format("an attribute has the dart {}: `d` should be the number of a dart, from 1 to "
                                          "{}",
                                          shown(attribute.child("d").text().get()), count_));
    }
    MapFile::Placed placed{static_cast<Dart>(dart - 1), {}, line_of(attribute)};
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const pugi::xml_node coordinate = point.child(names[k]);
      if (k == 2 && !coordinate) {
        break;  // in the plane
      }
      const std::string_view word = trimmed(coordinate.text().get());
      if (!parse_coordinate(word, placed.point[k])) {
        return error(attribute, fmt::format("the point of dart {}, `{}`: {}", dart, names[k], not_a_coordinate(word)));
      }
    }
    file_.points.push_back(placed);
    return Done{};
  }

  std::string_view bytes_, name_;
  std::optional<int> dimension_;
  pugi::xml_document document_;
  std::size_t counted_ = 1, counted_to_ = 0;  // lines, up to a byte
  Dart count_ = 0;
  std::optional<char> kind_;  // of links: 'a' or 'b'
  bool has_values_ = false;
  std::vector<Link> links_;
  MapFile file_;
};

}  // namespace

std::optional<int> map_dimension_of_extension(std::string_view name) {
  constexpr std::string_view packed = ".gz", map = "map";
  if (name.ends_with(packed)) {
    name.remove_suffix(packed.size());
  }
  const auto dot = name.rfind('.');
  if (dot == std::string_view::npos || !name.ends_with(map)) {
    return std::nullopt;
  }
  name.remove_prefix(dot + 1);
  name.remove_suffix(map.size());
  std::int64_t dimension = -1;
  const bool is_number = parse_integer(name, dimension) && dimension >= 0 && dimension <= ops::largest_map_dimension;
  return is_number ? std::optional{static_cast<int>(dimension)} : std::nullopt;
}

Result<MapFile> parse_map_file(std::string_view bytes, std::string_view name, std::optional<int> dimension) {
  if (bytes.starts_with("\xef\xbb\xbf")) {
    bytes.remove_prefix(3);
  }
  return MapFileReader(bytes, name, dimension).read();
}

}  // namespace sesame::tools
