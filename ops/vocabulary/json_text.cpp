#include "ops/vocabulary/json_text.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

namespace sesame::ops {
namespace {

template <class N>
void append_digits(std::string& to, N n) {
  char digits[24];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), n).ptr;
  to.append(std::begin(digits), end);
}

/// Printable ASCII that stands for itself.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

/// As the library writes a single value: that of a leaf needs no memory to be destroyed.
std::string written(const nlohmann::json& leaf) {
  return leaf.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void JsonText::key(std::string_view name) {
  add_text(name);
  to_ += ':';
  is_next_ = false;
}

void JsonText::separate() {
  if (is_next_) {
    to_ += ',';
  }
  is_next_ = true;
}

void JsonText::open(char bracket) {
  separate();
  to_ += bracket;
  is_next_ = false;
}

void JsonText::close(char bracket) {
  to_ += bracket;
  is_next_ = true;
}

void JsonText::add_word(std::string_view word) {
  separate();
  to_ += word;
}

void JsonText::add_signed(std::int64_t n) {
  separate();
  append_digits(to_, n);
}

void JsonText::add_unsigned(std::uint64_t n) {
  separate();
  append_digits(to_, n);
}

void JsonText::add_number(double x) { add_word(written(x)); }

void JsonText::add_integer(const sparse::Integer& n) {
  if (const auto word = n.to_int64()) {
    add_signed(*word);
  } else {
    add_text(n.to_string());
  }
}

void JsonText::add_text(std::string_view text) {
  if (!std::all_of(text.begin(), text.end(), is_plain)) {
    add_word(written(std::string{text}));
    return;
  }
  separate();
  to_ += '"';
  to_ += text;
  to_ += '"';
}

}  // namespace sesame::ops
