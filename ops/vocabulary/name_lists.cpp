#include "ops/vocabulary/name_lists.hpp"

namespace sesame::ops {
namespace {

/// A page grows to so many bytes, then there is another: so no text of many lists is ever copied as a whole.
constexpr std::size_t page_size = std::size_t{1} << 18;

}  // namespace

void NameLists::begin_list() {
  if (pages_.empty()) {
    pages_.emplace_back();
  } else if (pages_.back().size() >= page_size) {
    pages_.emplace_back().reserve(page_size + 128);
  }
  begins_.push_back({static_cast<std::uint32_t>(pages_.size() - 1), static_cast<std::uint32_t>(pages_.back().size())});
}

void NameLists::add(std::string_view name) {
  Place& list = begins_.back();
  // A list that has gone beyond its page has a page of its own, if it is not the first there.
  if (list.offset > 0 && pages_.back().size() + name.size() > page_size) {
    std::string own = pages_.back().substr(list.offset);
    pages_.back().resize(list.offset);
    pages_.push_back(std::move(own));
    list = {static_cast<std::uint32_t>(pages_.size() - 1), 0};
  }
  std::string& page = pages_.back();
  std::size_t length = name.size();
  for (; length > 0x7f; length >>= 7) {
    page += static_cast<char>((length & 0x7f) | 0x80);
  }
  page += static_cast<char>(length);
  page += name;
}

void NameLists::clear() {
  begins_.clear();
  pages_.clear();
}

}  // namespace sesame::ops
