#include "ops/vocabulary/field_values.hpp"

#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace sesame::ops {

Point read_point(Fields& in, const Json& value) {
  if (!value.is_array() || value.size() < 2 || value.size() > 3) {
    in.wrong("at", "a point, [x,y] or [x,y,z]", value);
  }
  Point p{};
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (!value[k].is_number()) {
      in.wrong("at", "a point of numbers", value[k]);
    }
    p.at(k) = value[k].get<double>();
  }
  return p;
}

std::vector<Point> read_points(Fields& in) {
  const Json* at = in.find("at");
  return at == nullptr ? std::vector<Point>{}
                       : read_each(in.items("at", *at, "a list of points"),
                                   [&](const Json& point) { return read_point(in, point); });
}

std::optional<Point> read_point(Fields& in) {
  const Json* at = in.find("at");
  return at != nullptr ? std::optional{read_point(in, *at)} : std::nullopt;
}

std::string read_label(Fields& in, const std::string& field, const Json& value) {
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (!value.is_number_unsigned()) {
    in.wrong(field, "made of labels, which are strings or integers from 0 on", value);
  }
  return std::to_string(value.get<std::uint64_t>());
}

void write_label(std::string_view label, JsonText& out) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
  if (error == std::errc{} && std::to_string(number) == label) {
    out.value(number);
  } else {
    out.value(label);
  }
}

}  // namespace sesame::ops
