#include "ops/name_table.hpp"

#include <boost/locale/utf.hpp>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

constexpr std::uint32_t vacant = UINT32_MAX;

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

const NameTable::Name* NameTable::find(std::string_view text, std::uint32_t hash) const {
  ++looked_up_;
  if (slots_.empty()) {
    return nullptr;
  }
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = hash & mask; slots_[at].number != vacant; at = (at + 1) & mask) {
    if (slots_[at].hash == hash && names_[slots_[at].number].text == text) {
      return &names_[slots_[at].number];
    }
  }
  return nullptr;
}

void NameTable::add(std::string_view text, std::uint32_t cell, std::uint32_t body) {
  if (2 * (names_.size() + 1) > slots_.size()) {
    grow();
  }
  const std::uint32_t hash = hash_of(text);
  sparse::expects(find(text, hash) == nullptr, "a plan's new names are free");
  insert({hash, size()});
  names_.push_back({std::string{text}, cell, body});
}

void NameTable::insert(Slot slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = slot.hash & mask;
  while (slots_[at].number != vacant) {
    at = (at + 1) & mask;
  }
  slots_[at] = slot;
}

void NameTable::grow() {
  std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size(), Slot{0, vacant});
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.number != vacant) {
      insert(slot);
    }
  }
}

void NameTable::pop_back() {
  const std::size_t mask = slots_.size() - 1;
  std::size_t hole = hash_of(names_.back().text) & mask;
  while (slots_[hole].number != size() - 1) {
    hole = (hole + 1) & mask;
  }
  // Close the gap: what follows moves up unless it would pass the slot that its hash asks for.
  for (std::size_t at = (hole + 1) & mask; slots_[at].number != vacant; at = (at + 1) & mask) {
    const std::size_t wanted = slots_[at].hash & mask;
    if (((at - wanted) & mask) >= ((at - hole) & mask)) {
      slots_[hole] = slots_[at];
      hole = at;
    }
  }
  slots_[hole].number = vacant;
  names_.pop_back();
}

}  // namespace sesame::ops
