#include "ops/name_table.hpp"

#include <algorithm>
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
  names_.push_back({std::string{text}, cell, body, standard});
  index_last();
}

void NameTable::index_last() {
  Name& last = names_.back();
  const std::uint32_t number = size() - 1;
  const std::uint64_t hash = key(hash_of(last.text));
  const auto is_same = [&](std::uint32_t each) { return names_[each].text == last.text; };
  if (index_.insert_new(hash, number, is_same)) {
    return;
  }
  const std::uint32_t before = index_.find(hash, is_same);
  index_.erase(hash, before);
  index_.insert(hash, number);
  shadowed_.emplace(number, before);
  if (last.body == none) {
    last.body = names_[before].body;
  }
}

void NameTable::pop_back() {
  const std::uint32_t number = size() - 1;
  const std::uint64_t hash = key(hash_of(names_.back().text));
  index_.erase(hash, number);
  if (const auto before = shadowed_.empty() ? shadowed_.end() : shadowed_.find(number); before != shadowed_.end()) {
    index_.insert(hash, before->second);
    shadowed_.erase(before);
  }
  names_.pop_back();
}

// --------------------------------------------------------------------------------------------------------- archives

namespace {

/// What is written of a name but its text.
struct SavedName {
  std::uint32_t length;
  CellId cell;
  BodyId body;
  TypeId standard;
};

bool is_plain_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7f; });
}

}  // namespace

void NameTable::save(sparse::ArchiveWriter& to) const {
  std::vector<SavedName> saved;
  saved.reserve(names_.size());
  for (const Name& name : names_) {
    saved.push_back({static_cast<std::uint32_t>(name.text.size()), name.cell, name.body, name.standard});
  }
  to.put_list(saved);
  for (const Name& name : names_) {
    to.put_bytes(name.text.data(), name.text.size());
  }
}

void NameTable::load(sparse::ArchiveReader& from) {
  const auto saved = from.get_list<std::vector<SavedName>>();
  index_.reserve(saved.size());
  from.check(saved.size() < none, "there are fewer than 2^32 names");
  for (const SavedName& each : saved) {
    Name& name = names_.emplace_back();
    name = {from.get_text_of(each.length), each.cell, each.body, each.standard};
    if (!from.check(is_plain_name(name.text) || is_name(name.text), "names are names")) {
      names_.clear();
      index_ = {};
      shadowed_.clear();
      return;
    }
    index_last();
  }
}

}  // namespace sesame::ops
