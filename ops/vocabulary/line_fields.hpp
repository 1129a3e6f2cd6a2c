/// \file
/// The fields of a line by simdjson, without a JSON value in between. For OperationReader.
#pragma once

#include <simdjson.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "ops/vocabulary/operation.hpp"

namespace sesame::ops::line {

namespace json = simdjson::ondemand;

/// What is wrong with a line, or only rare in one: somebody else is to read it.
struct LeftToOthers {};

template <class T>
T got(simdjson::simdjson_result<T> result) {
  T value;
  if (std::move(result).get(value) != simdjson::SUCCESS) {
    throw LeftToOthers{};
  }
  return value;
}

inline void require(bool condition) {
  if (!condition) {
    throw LeftToOthers{};
  }
}

/// Calls take(item) for each of a list.
template <class Take>
void each(json::value value, Take take) {
  for (auto item : got(value.get_array())) {
    take(got(std::move(item)));
  }
}

/// Calls take(name, value) for each field of an object; take says which field it was, and no field comes twice.
template <class Take>
void each_field(json::object object, Take take) {
  unsigned met = 0;
  for (auto entry : object) {
    json::field field = got(std::move(entry));
    const std::string_view name = got(field.unescaped_key());
    const unsigned bit = 1U << take(name, field.value());
    require((met & bit) == 0);
    met |= bit;
  }
}

inline std::string text(json::value value) { return std::string{got(value.get_string())}; }

/// From `least` on, and no dimension out of reach: see Fields::small.
inline int small(json::value value, int least) {
  const std::int64_t n = got(value.get_int64());
  require(n >= least && n <= 1'000'000);
  return static_cast<int>(n);
}

/// An integer is read as one, so that -0 is 0, as a number is everywhere else.
/// Numbers with more digits than a double tells apart, which simdjson may read as another one, are left to others.
inline double number(json::value value) {
  constexpr auto most_digits = 19;
  std::string_view token = value.raw_json_token();
  token = token.substr(0, token.find_first_of("eE"));
  require(std::count_if(token.begin(), token.end(), [](char c) { return c >= '0' && c <= '9'; }) <= most_digits);
  return got(value.is_integer()) ? static_cast<double>(got(value.get_int64())) : got(value.get_double());
}

inline Point point(json::value value) {
  Point p{};
  std::size_t k = 0;
  each(value, [&](json::value coordinate) {
    require(k < p.size());
    p.at(k++) = number(coordinate);
  });
  require(k >= 2);
  return p;
}

/// Calls read(name, value) for each field of an operation but the first, its "op"; it answers its number, from 1 on.
template <class Read>
void each_field_but_op(json::object object, Read read) {
  each_field(object, [&](std::string_view name, json::value value) -> unsigned {
    if (name == "op") {
      (void)got(value.get_string());  // else the parser would skip over whatever stands there
      return 0;
    }
    return read(name, value);
  });
}

/// An operation that has a name and one other field, which read(value, operation) reads.
template <class Op, class Read>
Op read_with_name(json::object object, std::string_view other, Read read) {
  Op op;
  unsigned met = 0;
  each_field_but_op(object, [&](std::string_view name, json::value value) -> unsigned {
    ++met;
    if (name == "name") {
      op.name = text(value);
      return 1;
    }
    require(name == other);
    read(value, op);
    return 2;
  });
  require(met == 2);
  return op;
}

}  // namespace sesame::ops::line
