/// \file
/// JSON values as text, straight from what they are made of.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "sparse/integer.hpp"

namespace sesame::ops {

/// Adds JSON values to a text, part by part, with the commas between them: the same bytes as of a JSON value that is
/// made first and written then, without that value. When memory runs out it throws, as everything does; the text ends
/// anywhere then, and no destructor wants memory of its own (those of nlohmann::json do, and end the program when there
/// is none).
class JsonText {
 public:
  /// `to` outlives this.
  explicit JsonText(std::string& to) : to_{to} {}

  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_list() { open('['); }
  void end_list() { close(']'); }
  /// The name of the field whose value comes next.
  void key(std::string_view name);

  /// Truth values, machine numbers, texts (anything illegal in UTF-8 is replaced), integers (those beyond 64 bits as a
  /// string of digits, as most readers would round them), and lists of values.
  template <class T>
  void value(const T& value) {
    if constexpr (std::same_as<T, bool>) {
      add_word(value ? "true" : "false");
    } else if constexpr (std::signed_integral<T>) {
      add_signed(value);
    } else if constexpr (std::unsigned_integral<T>) {
      add_unsigned(value);
    } else if constexpr (std::floating_point<T>) {
      add_number(value);
    } else if constexpr (std::convertible_to<const T&, std::string_view>) {
      add_text(value);
    } else if constexpr (std::same_as<T, sparse::Integer>) {
      add_integer(value);
    } else {
      begin_list();
      for (const auto& item : value) {
        this->value(item);
      }
      end_list();
    }
  }
  void null() { add_word("null"); }

  template <class T>
  void field(std::string_view name, const T& value) {
    key(name);
    this->value(value);
  }
  /// A list of values of any kinds.
  template <class... T>
  void list_of(const T&... items) {
    begin_list();
    (value(items), ...);
    end_list();
  }

 private:
  void separate();
  void open(char bracket);
  void close(char bracket);
  void add_word(std::string_view word);
  void add_signed(std::int64_t n);
  void add_unsigned(std::uint64_t n);
  void add_number(double x);
  void add_integer(const sparse::Integer& n);
  void add_text(std::string_view text);

  std::string& to_;
  bool is_next_ = false;  ///< something stands before what comes, in the same list or object
};

}  // namespace sesame::ops
