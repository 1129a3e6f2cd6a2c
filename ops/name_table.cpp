#include "ops/name_table.hpp"

#include <boost/locale/utf.hpp>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The Unicode characters of categories Z (separators) and Cc (control), and the byte order mark.
bool is_space_or_control(std::uint32_t c) {
  return c <= 0x20 || (c >= 0x7f && c <= 0xa0) || c == 0x1680 || (c >= 0x2000 && c <= 0x200a) || c == 0x2028 ||
         c == 0x2029 || c == 0x202f || c == 0x205f || c == 0x3000 || c == 0xfeff;
}

}  // namespace

bool is_name(std::string_view name) {
  namespace utf = boost::locale::utf;
  const char* at = name.data();
  const char* const end = at + name.size();
  while (at != end) {
    const utf::code_point c = utf::utf_traits<char>::decode(at, end);
    if (c == utf::illegal || c == utf::incomplete || is_space_or_control(c)) {
      return false;
    }
  }
  return !name.empty();
}

PartHashes::PartHashes(std::string_view text) {
  words_.reserve(text.size() + 1);
  powers_.reserve(text.size() + 1);
  TextHash hash;
  words_.push_back(hash.word());
  powers_.push_back(1);
  for (const char c : text) {
    hash.add(c);
    words_.push_back(hash.word());
    powers_.push_back(powers_.back() * TextHash::multiplier);
  }
}

std::uint32_t NameTable::hash_of(std::string_view text) {
  TextHash hash;
  hash.add(text);
  return hash.value();
}

std::uint32_t NameTable::number_of(std::string_view text, std::uint32_t hash) const {
  ++looked_up_;
  return index_.find(key(hash), [&](std::uint32_t each) { return names_[each].text == text; });
}

static_assert(sparse::HashIndex::nothing == none);

void NameTable::add(std::string_view text, CellId cell, BodyId body, TypeId standard) {
  const bool is_new =
      index_.insert_new(key(hash_of(text)), size(), [&](std::uint32_t each) { return names_[each].text == text; });
  sparse::expects(is_new, "a plan's new names are free");
  names_.push_back({std::string{text}, cell, body, standard});
}

void NameTable::pop_back() {
  index_.erase(key(hash_of(names_.back().text)), size() - 1);
  names_.pop_back();
}

}  // namespace sesame::ops
