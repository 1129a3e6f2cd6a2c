#include "ops/maps/nmap_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// One or two steps that are taken together; the second is absent where it is -1.
using Word = std::array<int, 2>;

/// Back along the inverse of beta_i.
int back(int i) { return i == 0 ? 1 : i == 1 ? 0 : i; }

Dart follow(const NMap& map, const Word& word, Dart d) {
  const Dart between = map.beta(word[0], d);
  return word[1] < 0 ? between : map.beta(word[1], between);
}

/// The words that lead around an i-cell, with their inverses.
std::vector<Word> words_of_cell(int n, int i) {
  std::vector<Word> words;
  for (int j = i == 0 ? 2 : 1; j <= n; ++j) {
    if (i != 0) {
      if (j != i) {
        words.push_back({j, -1});
        words.push_back({back(j), -1});
      }
      continue;
    }
    for (int first = 0; first < j; first += first == 0 ? 2 : 1) {
      words.push_back({first, j});
      words.push_back({j, back(first)});
    }
  }
  return words;
}

/// Appends what is reached from the last dart of a list.
template <class Meet>
void walk(const NMap& map, const std::vector<Word>& words, std::vector<Dart>& found, Meet meet) {
  for (std::size_t at = found.size() - 1; at < found.size(); ++at) {
    for (const Word& word : words) {
      if (const Dart next = follow(map, word, found[at]); next != no_dart && meet(next)) {
        found.push_back(next);
      }
    }
  }
}

Orbits orbits_of(const NMap& map, const std::vector<Word>& words) {
  Orbits all;
  all.of.assign(map.size(), no_dart);
  std::vector<Dart> found;
  for (Dart d = 0; d < map.size(); ++d) {
    if (all.of[d] != no_dart) {
      continue;
    }
    const std::uint32_t number = all.count();
    all.first.push_back(d);
    all.of[d] = number;
    found.assign(1, d);
    walk(map, words, found, [&](Dart next) { return std::exchange(all.of[next], number) == no_dart; });
  }
  return all;
}

/// Whether the dual exists.
Status check_dual(const NMap& map) {
  const int n = map.dimension();
  for (Dart d = 0; d < map.size(); ++d) {
    if (map.is_free(n, d)) {
      return Error{Errc::refused, fmt::format("dart {} is {}-free, but only a map without such darts has a dual: its "
                                              "boundary would be lost",
                                              d, n)};
    }
    for (int i = 1; i <= n - 2; ++i) {
      if (map.beta(n, d) == map.beta(i, d)) {
        return Error{Errc::refused, fmt::format("beta_{0} and beta_{1} both send dart {2} to dart {3}, so beta_{4} of "
                                                "the dual would fix a dart; they must differ everywhere",
                                                n, i, d, map.beta(n, d), n - i)};
      }
    }
  }
  return Done{};
}

}  // namespace

Orbits cells(const NMap& map, int i) {
  sparse::expects(i >= 0 && i <= map.dimension(), "a map has cells of dimension 0 to its own");
  return orbits_of(map, words_of_cell(map.dimension(), i));
}

Orbits components(const NMap& map) {
  std::vector<Word> words;
  for (int j = 0; j <= map.dimension(); ++j) {
    words.push_back({j, -1});
  }
  return orbits_of(map, words);
}

bool is_connected(const NMap& map) { return components(map).count() == 1; }

Dart opening(const NMap& map, int i, Dart d) {
  const std::vector<Word> words = words_of_cell(map.dimension(), i);
  std::vector<Dart> found{d};
  std::vector<bool> met(map.size(), false);
  met[d] = true;
  walk(map, words, found, [&](Dart next) {
    const bool is_new = !met[next];
    met[next] = true;
    return is_new;
  });
  const auto open = std::ranges::find_if(found, [&](Dart each) {
    return std::ranges::any_of(words, [&](const Word& word) { return follow(map, word, each) == no_dart; });
  });
  return open == found.end() ? no_dart : *open;
}

Result<NMap> dual(const NMap& map) {
  const int n = map.dimension();
  if (n == 0) {
    return map;
  }
  if (Status s = check_dual(map); !s) {
    return s.error();
  }
  if (n == 1) {
    return map.inverse();
  }
  std::vector<std::vector<Dart>> beta(static_cast<std::size_t>(n));
  for (Dart d = 0; d < map.size(); ++d) {
    for (int k = 1; k < n; ++k) {
      beta[static_cast<std::size_t>(k) - 1].push_back(map.beta({n, n - k}, d));
    }
    beta.back().push_back(map.beta(n, d));
  }
  return NMap::make(std::move(beta));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> graph_of(const NMap& map) {
  sparse::expects(map.dimension() == 2, "a graph is drawn by a map of dimension 2");
  const Orbits vertices = cells(map, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Dart d : cells(map, 1).first) {
    sparse::expects(!map.is_free(2, d), "each edge of a graph has two ends");
    edges.emplace_back(vertices.of[d], vertices.of[map.beta(2, d)]);
  }
  return edges;
}

}  // namespace sesame::ops
