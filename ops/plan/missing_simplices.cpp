#include "ops/plan/missing_simplices.hpp"

#include <compare>

namespace sesame::ops {

std::uint32_t MissingSimplices::add(std::span<const Position> simplex, std::uint64_t hash) {
  positions_.insert(positions_.end(), simplex.begin(), simplex.end());
  return note_last(hash);
}

std::uint32_t MissingSimplices::add_face(std::span<const Position> simplex, std::size_t k, std::uint64_t hash) {
  for (std::size_t at = 0; at < simplex.size(); ++at) {
    if (at != k) {
      positions_.push_back(simplex[at]);
    }
  }
  return note_last(hash);
}

std::uint32_t MissingSimplices::note_last(std::uint64_t hash) {
  const std::uint32_t last = size() - 1;
  if (last == few) {
    for (std::uint32_t number = 0; number < few; ++number) {
      index_.insert(hash_of(operator[](number)), number);
    }
  }
  if (last >= few) {
    index_.insert(hash, last);
  }
  return last;
}

std::vector<std::uint32_t> MissingSimplices::sorted() const {
  // The first two vertices decide between most of them, in one comparison and without a look at the others.
  struct Key {
    std::uint64_t first_two;
    std::uint32_t number;
  };
  std::vector<Key> keys;
  keys.reserve(size());
  for (std::uint32_t number = 0; number < size(); ++number) {
    const auto simplex = operator[](number);
    keys.push_back({std::uint64_t{simplex[0]} << 32U | (vertices_ > 1 ? simplex[1] : 0), number});
  }
  std::sort(keys.begin(), keys.end(), [this](const Key& a, const Key& b) {
    if (a.first_two != b.first_two) {
      return a.first_two < b.first_two;
    }
    return std::ranges::lexicographical_compare(operator[](a.number), operator[](b.number));
  });
  std::vector<std::uint32_t> numbers(keys.size());
  std::ranges::transform(keys, numbers.begin(), &Key::number);
  return numbers;
}

}  // namespace sesame::ops
