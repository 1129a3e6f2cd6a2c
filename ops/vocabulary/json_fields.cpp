#include "ops/vocabulary/json_fields.hpp"
#include "sparse/quoted.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace sesame::ops {

std::string_view json_kind(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return "a truth value";
    case Json::value_t::string:
      return "a string";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::number_float:
      return "a number with a fraction or too large for 64 bits";
    default:
      return "a number";
  }
}

const Json* Fields::find(const std::string& field) {
  known_.insert(field);
  const auto at = object_.find(field);
  return at == object_.end() ? nullptr : &*at;
}

const Json& Fields::need(const std::string& field) {
  const Json* value = find(field);
  if (value == nullptr) {
    throw Wrong{fmt::format("{} needs a field \"{}\"", what_, field)};
  }
  return *value;
}

void Fields::finish() const {
  for (const auto& [key, value] : object_.items()) {
    if (!known_.contains(key)) {
      throw Wrong{fmt::format("{} has an unknown field {}; its fields are: {}", what_, sparse::quoted(key),
                              fmt::join(known_.begin(), known_.end(), ", "))};
    }
  }
}

void Fields::wrong(const std::string& field, std::string_view expected, const Json& value) const {
  throw Wrong{fmt::format("field \"{}\" of {} should be {}, but is {}", field, what_, expected,
                          value.is_number_integer() ? value.dump() : std::string{json_kind(value)})};
}

std::string Fields::text(const std::string& field, const Json& value) const {
  if (!value.is_string()) {
    wrong(field, "a string", value);
  }
  return value.get<std::string>();
}

bool Fields::truth(const std::string& field, const Json& value) const {
  if (!value.is_boolean()) {
    wrong(field, "true or false", value);
  }
  return value.get<bool>();
}

sparse::Integer Fields::integer(const std::string& field, const Json& value) const {
  if (value.is_number_integer()) {
    constexpr std::uint64_t largest_word = std::numeric_limits<std::int64_t>::max();
    const bool is_beyond_words = value.is_number_unsigned() && value.get<std::uint64_t>() > largest_word;
    return is_beyond_words ? *sparse::Integer::parse(std::to_string(value.get<std::uint64_t>()))
                           : value.get<std::int64_t>();
  }
  if (value.is_string()) {
    if (auto parsed = sparse::Integer::parse(value.get<std::string>())) {
      return *parsed;
    }
    throw Wrong{fmt::format("field \"{}\": {} is not an integer", field, sparse::quoted(value.get<std::string>()))};
  }
  wrong(field, "an integer (beyond 64 bits: a string of digits)", value);
}

int Fields::small(const std::string& field, const Json& value, int least) const {
  const sparse::Integer n = integer(field, value);
  const auto word = n.to_int64();
  if (!word || *word < least || *word > 1'000'000) {
    throw Wrong{fmt::format("field \"{}\" should be an integer from {} on that is no dimension out of reach, but is {}",
                            field, least, sparse::printable(n.to_string()))};
  }
  return static_cast<int>(*word);
}

const std::vector<Json>& Fields::items(const std::string& field, const Json& value, std::string_view expected) const {
  if (!value.is_array()) {
    wrong(field, expected, value);
  }
  return value.get_ref<const Json::array_t&>();
}

std::vector<std::string> Fields::texts(const std::string& field, const Json& value, std::string_view expected) const {
  return read_each(items(field, value, expected), [&](const Json& item) { return text(field, item); });
}

}  // namespace sesame::ops
