/// \file
/// Deletions for which lifts can be corrected afterwards.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// Deletions whose generator e is small, or was eliminated at once with a cycle z and so is rewritten to 0: the former
/// change no lift, the latter by multiples of V(z). By degree of e those since the last one that is not so, the oldest
/// first.
class CorrectableDeletions {
 public:
  struct Deletion {
    Symbol e;
    std::vector<GeneratorId> changed;  ///< generators whose boundary has a multiple of e: old ones, and some that came
  };

  void record(int degree, Symbol e, std::vector<GeneratorId> changed) {
    const auto list = static_cast<std::size_t>(degree + 1);
    of_degree_.resize(std::max(of_degree_.size(), list + 1));
    place_.resize(std::max(place_.size(), std::size_t{e} + 1));
    place_[e] = static_cast<std::uint32_t>(of_degree_[list].size());
    of_degree_[list].push_back({e, std::move(changed)});
  }
  /// A new generator has e in its boundary, as one that is attached to lazy cells may. Nothing when e is none of these.
  void add_changed(int degree, Symbol e, GeneratorId generator) {
    if (const std::size_t at = place(degree, e); at < of_degree(degree).size()) {
      of_degree_[static_cast<std::size_t>(degree + 1)][at].changed.push_back(generator);
    }
  }
  void forget(int degree) {
    if (static_cast<std::size_t>(degree + 1) < of_degree_.size()) {
      of_degree_[static_cast<std::size_t>(degree + 1)].clear();
    }
  }
  /// Forgets those until one, which has become another kind.
  void forget_until(int degree, Symbol e) {
    auto& all = of_degree_[static_cast<std::size_t>(degree + 1)];
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(place(degree, e)) + 1);
    for (std::size_t at = 0; at < all.size(); ++at) {
      place_[all[at].e] = static_cast<std::uint32_t>(at);
    }
  }
  void clear() { of_degree_.clear(); }

  [[nodiscard]] std::span<const Deletion> of_degree(int degree) const {
    const auto list = static_cast<std::size_t>(degree + 1);
    return list < of_degree_.size() ? std::span<const Deletion>{of_degree_[list]} : std::span<const Deletion>{};
  }
  /// The place of a symbol of a degree among those of that degree; their number: it is none of them.
  [[nodiscard]] std::size_t place(int degree, Symbol e) const {
    const std::span<const Deletion> all = of_degree(degree);
    const std::size_t at = e < place_.size() ? place_[e] : all.size();
    return at < all.size() && all[at].e == e ? at : all.size();
  }
  [[nodiscard]] bool contains(int degree, Symbol e) const { return place(degree, e) < of_degree(degree).size(); }

 private:
  std::vector<std::vector<Deletion>> of_degree_;  ///< from -1 on
  std::vector<std::uint32_t> place_;              ///< per symbol, as far as needed: where it is, if it is there
};

}  // namespace sesame::engine
