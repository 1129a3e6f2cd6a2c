/// \file
/// The fields of a JSON object, read by name and by kind. What is not as it should be is an error that names the field
/// and says what it should be.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sparse/integer.hpp"

namespace sesame::ops {

using Json = nlohmann::ordered_json;

/// Thrown by all that reads JSON here, and caught where the reading of a line began: ends it with a sentence.
struct Wrong {
  std::string what;
};

/// "a string", "a list", "null": what a value is, for a sentence.
[[nodiscard]] std::string_view json_kind(const Json& value);

/// Reads the fields of one object and remembers which were asked for; what is left over is unknown.
///
/// The functions that take a value as well read it as what the field holds, or as a part of that; the others read the
/// whole field, which must be there. All throw Wrong.
class Fields {
 public:
  /// `what` stands for the object in sentences.
  Fields(const Json& object, std::string what) : object_{object}, what_{std::move(what)} {}

  /// The value of a field, or null.
  [[nodiscard]] const Json* find(const std::string& field);
  const Json& need(const std::string& field);
  /// Throws when there is a field that was not asked for.
  void finish() const;
  [[noreturn]] void wrong(const std::string& field, std::string_view expected, const Json& value) const;

  [[nodiscard]] std::string text(const std::string& field, const Json& value) const;
  [[nodiscard]] std::string text(const std::string& field) { return text(field, need(field)); }
  [[nodiscard]] bool truth(const std::string& field, const Json& value) const;
  /// Integers beyond 64 bits are written as strings of digits.
  [[nodiscard]] sparse::Integer integer(const std::string& field, const Json& value) const;
  /// An integer from `least` on, not larger than any dimension could be.
  [[nodiscard]] int small(const std::string& field, const Json& value, int least) const;
  /// The items of a list.
  [[nodiscard]] const std::vector<Json>& items(const std::string& field, const Json& value,
                                               std::string_view expected) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& field, const Json& value,
                                               std::string_view expected) const;

 private:
  const Json& object_;
  std::string what_;
  std::set<std::string> known_;
};

/// What `read` makes of each item of a list, in order.
template <class Item, class Read>
[[nodiscard]] auto read_each(const std::vector<Item>& items, Read read) {
  std::vector<decltype(read(items.front()))> all;
  all.reserve(items.size());
  for (const Item& item : items) {
    all.push_back(read(item));
  }
  return all;
}

}  // namespace sesame::ops
