#include "ops/vocabulary/json_line.hpp"
#include "sparse/quoted.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sesame::ops {
namespace {

constexpr std::size_t most_within = 32;

/// Takes away what is in a value, from the inside, so that nothing is left for which its destructor wants memory.
void empty(Json& value) {
  if (value.is_structured()) {
    for (Json& item : value) {
      empty(item);
    }
    value.clear();
  }
}

/// Builds the value that a line says, and looks through the fields of each object when it ends.
class LineParser final : public nlohmann::json_sax<Json> {
 public:
  /// Throws Wrong.
  static void parse(std::string_view line, Json& root) {
    LineParser parser(root);
    Json::sax_parse(line, &parser);
  }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& /*value*/) override { return false; }  // no text has one
  bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
  bool end_array() override { return close(); }
  bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
  bool end_object() override {
    refuse_doubled_fields(*open_.back()->get_ptr<const Json::object_t*>());
    return close();
  }
  bool key(string_t& field) override {
    auto& object = *open_.back()->get_ptr<Json::object_t*>();
    make_room(object);
    // Not by operator[], which would look through all the fields before it.
    object.emplace_back(std::move(field), nullptr);
    return true;
  }
  bool parse_error(std::size_t column, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    // The only other complaint of the reader is about numbers beyond all machine numbers.
    throw Wrong{dynamic_cast<const Json::parse_error*>(&error) != nullptr
                    ? fmt::format("this is not a JSON object (at column {}): a line is one object, {{...}}", column)
                    : "this object cannot be read: a number in it is out of range; write integers beyond 64 bits as "
                      "strings"};
  }

 private:
  explicit LineParser(Json& root) : root_{root} {}

  /// Puts a value at the end of what is open.
  Json& place(Json value) {
    if (open_.empty()) {
      return root_ = std::move(value);
    }
    if (auto* list = open_.back()->get_ptr<Json::array_t*>()) {
      return list->emplace_back(std::move(value));
    }
    return open_.back()->get_ptr<Json::object_t*>()->back().second = std::move(value);
  }
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json value) {
    if (open_.size() == most_within) {
      throw Wrong{fmt::format("lists and objects stand more than {} deep within one another; no operation has so many",
                              most_within)};
    }
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  /// For one more field. An object that grows by itself copies its values, whole, as its keys cannot be moved.
  static void make_room(Json::object_t& object) {
    if (object.size() < object.capacity()) {
      return;
    }
    Json::object_t larger;
    larger.reserve(2 * object.size() + 4);
    for (auto& [field, value] : object) {
      larger.emplace_back(field, std::move(value));
    }
    object.swap(larger);
  }

  void refuse_doubled_fields(const Json::object_t& object) {
    fields_.clear();
    for (const auto& [field, value] : object) {
      fields_.push_back(field);
    }
    std::sort(fields_.begin(), fields_.end());
    if (const auto twice = std::adjacent_find(fields_.begin(), fields_.end()); twice != fields_.end()) {
      throw Wrong{fmt::format("the field {} stands twice in one object", sparse::quoted(*twice))};
    }
  }

  Json& root_;
  std::vector<Json*> open_;               ///< each the last in the one before it, so that none moves while it is open
  std::vector<std::string_view> fields_;  ///< of the object that ends; kept for the next one
};

}  // namespace

/// By way of the other constructor, so that what was read is emptied when this one throws.
JsonLine::JsonLine(std::string_view line) : JsonLine() {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos || line[begin] != '{') {
    throw Wrong{"a line should be one JSON object, {...}"};
  }
  LineParser::parse(line, object_);
}

JsonLine::~JsonLine() { empty(object_); }

}  // namespace sesame::ops
