#include "ops/maps/map_product.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// n over k, for n <= largest_map_dimension.
std::uint64_t binomial(int n, int k) {
  std::uint64_t value = k < 0 || k > n ? 0 : 1;
  for (int i = 1; i <= k && value != 0; ++i) {
    value = value * static_cast<std::uint64_t>(n - k + i) / static_cast<std::uint64_t>(i);
  }
  return value;
}

/// Where alpha_i of a product leads from one of its darts.
ProductDarts::Place image(const ProductDarts& darts, const GMap& left, const GMap& right, int i,
                          ProductDarts::Place at) {
  const int n = darts.dimension();
  if (n == 0) {
    return at;
  }
  const bool comes_before = i > 0, goes_on = i < n;
  if (comes_before && goes_on && darts.is_left(at.word, i - 1) != darts.is_left(at.word, i)) {
    return {at.left, at.right, darts.exchanged(at.word, i)};
  }
  const int a = darts.left_steps(at.word, i);
  return darts.is_left(at.word, goes_on ? i : i - 1)
             ? ProductDarts::Place{left.alpha(a, at.left), at.right, at.word}
             : ProductDarts::Place{at.left, right.alpha(i - a, at.right), at.word};
}

/// The first involutions of a product.
std::vector<std::vector<Dart>> involutions(const ProductDarts& darts, const GMap& left, const GMap& right, int count) {
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    std::vector<Dart>& images = alpha[static_cast<std::size_t>(i)];
    images.reserve(darts.size());
    for (Dart d = 0; d < darts.size(); ++d) {
      images.push_back(darts.dart(image(darts, left, right, i, darts.place(d))));
    }
  }
  return alpha;
}

GMap map_of(std::vector<std::vector<Dart>> alpha) {
  Result<GMap> map = GMap::make(std::move(alpha));
  sparse::expects(map.has_value(), "a product of maps is a map");
  return std::move(*map);
}

}  // namespace

ProductDarts::ProductDarts(Dart left_darts, int k, Dart right_darts, int l)
    : k_{k}, l_{l}, left_darts_{left_darts}, right_darts_{right_darts} {
  sparse::expects(
      k >= 0 && l >= 0 && k + l <= largest_map_dimension && count_of_darts(left_darts, k, right_darts, l) < no_dart,
      "a product of maps has a dimension and darts that can be numbered");
  words_.reserve(binomial(k + l, k));
  const std::uint64_t last = k == 0 ? 0 : ((std::uint64_t{1} << k) - 1) << l;
  for (std::uint64_t word = (std::uint64_t{1} << k) - 1;;) {
    words_.push_back(word);
    if (word == last) {
      break;
    }
    const std::uint64_t lowest = word & -word, ripple = word + lowest;  // the next number with as many bits
    word = ripple | ((word ^ ripple) >> 2) / lowest;
  }
}

int ProductDarts::left_steps(std::uint32_t word, int i) const {
  return std::popcount(words_[word] >> (dimension() - i));
}

std::uint32_t ProductDarts::beginning(std::uint32_t word, int i) const {
  std::uint64_t number = 0;  // of those before it, which have a step to the right where it has one to the left
  int left = left_steps(word, i);
  for (int step = 0; step < i; ++step) {
    if (is_left(word, step)) {
      number += binomial(i - step - 1, left);
      --left;
    }
  }
  return static_cast<std::uint32_t>(number);
}

std::uint32_t ProductDarts::exchanged(std::uint32_t word, int i) const {
  const std::uint64_t both = std::uint64_t{3} << (dimension() - 1 - i);
  return static_cast<std::uint32_t>(std::ranges::lower_bound(words_, words_[word] ^ both) - words_.begin());
}

std::uint64_t count_of_darts(Dart left_darts, int k, Dart right_darts, int l) {
  const std::uint64_t pairs = std::uint64_t{left_darts} * right_darts, words = binomial(k + l, k);
  return pairs != 0 && words > UINT64_MAX / pairs ? UINT64_MAX : pairs * words;
}

GMap product(const GMap& left, const GMap& right) {
  const ProductDarts darts(left.size(), left.dimension(), right.size(), right.dimension());
  return map_of(involutions(darts, left, right, darts.dimension() + 1));
}

GMap boundary_of_product(const GMap& left, const GMap& right) {
  const ProductDarts darts(left.size(), left.dimension() + 1, right.size(), right.dimension() + 1);
  return darts.dimension() == 0 ? GMap::points(darts.size())
                                : map_of(involutions(darts, left, right, darts.dimension()));
}

ChainOfMaps product(const ChainOfMaps& left, const ChainOfMaps& right) {
  const int k = left.dimension(), l = right.dimension();
  const auto first_of = [&](int n) { return std::max(0, n - l); };  // the least a
  const auto last_of = [&](int n) { return std::min(n, k); };
  const auto darts_of = [&](int a, int b) { return ProductDarts(left.level(a).size(), a, right.level(b).size(), b); };
  std::vector<GMap> levels;
  std::vector<std::vector<Dart>> sigma;
  std::vector<Dart> begin_below;  // of the products on the level below, by a
  for (int n = 0; n <= k + l; ++n) {
    std::vector<Dart> begin(static_cast<std::size_t>(k) + 1, 0);
    Dart next = 0;
    GMap level;
    std::vector<Dart> faces;
    for (int a = first_of(n); a <= last_of(n); ++a) {
      const int b = n - a;
      const ProductDarts darts = darts_of(a, b);
      begin[static_cast<std::size_t>(a)] = next;
      next += darts.size();
      const GMap block = boundary_of_product(left.level(a), right.level(b));
      level = a == first_of(n) ? block : disjoint_union(level, block);
      for (Dart d = 0; n > 0 && d < darts.size(); ++d) {
        const auto [of_left, of_right, word] = darts.place(d);
        const std::uint32_t rest = darts.beginning(word, n - 1);
        if (darts.is_left(word, n - 1)) {
          faces.push_back(begin_below[static_cast<std::size_t>(a) - 1] +
                          darts_of(a - 1, b).dart({left.sigma(a, of_left), of_right, rest}));
        } else {
          faces.push_back(begin_below[static_cast<std::size_t>(a)] +
                          darts_of(a, b - 1).dart({of_left, right.sigma(b, of_right), rest}));
        }
      }
    }
    levels.push_back(std::move(level));
    if (n > 0) {
      sigma.push_back(std::move(faces));
    }
    begin_below = std::move(begin);
  }
  Result<ChainOfMaps> chain = ChainOfMaps::make(std::move(levels), std::move(sigma));
  sparse::expects(chain.has_value(), "a product of chains of maps is a chain of maps");
  return std::move(*chain);
}

int sign_of_word(const ProductDarts& darts, std::uint32_t word) {
  int left = 0, sign = 1;
  for (int i = 0; i < darts.dimension(); ++i) {
    if (darts.is_left(word, i)) {
      ++left;
    } else if (left % 2 != 0) {
      sign = -sign;
    }
  }
  return sign;
}

}  // namespace sesame::ops
