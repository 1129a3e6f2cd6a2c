/// \file
/// The filtration that has the bars of a zigzag, see OfflineZigzag.
#pragma once

#include <cstdint>

#include "engine/zigzag/offline_zigzag.hpp"

namespace sesame::engine {

/// The filtration that a zigzag is turned into. A place is the number of a cell in it.
class ZigzagFiltration {
 public:
  using Place = std::uint32_t;

  explicit ZigzagFiltration(const OfflineZigzag& zigzag)
      : zigzag_{zigzag}, exclusions_{static_cast<Place>(zigzag.excluded_.size())} {}

  [[nodiscard]] std::size_t size() const { return exclusions_ + zigzag_.dimensions_.size(); }
  [[nodiscard]] bool is_exclusion(Place place) const { return place < exclusions_; }
  [[nodiscard]] std::uint32_t inclusion(Place place) const {
    return is_exclusion(place) ? zigzag_.excluded_[exclusions_ - 1 - place] : place - exclusions_;
  }
  /// That of the simplex; an exclusion has one less, `dimension`, in the filtration.
  [[nodiscard]] int dimension_of_simplex(Place place) const { return zigzag_.dimensions_[inclusion(place)]; }
  [[nodiscard]] int dimension(Place place) const { return dimension_of_simplex(place) - (is_exclusion(place) ? 1 : 0); }
  [[nodiscard]] Moment moment(Place place) const {
    return is_exclusion(place) ? zigzag_.exclusions_[exclusions_ - 1 - place]
                               : zigzag_.inclusions_[place - exclusions_];
  }

  /// Calls visit(place, is_negative) for each cell in the boundary of one, in no order.
  template <class Visit>
  void for_each_in_boundary(Place place, Visit&& visit) const {
    const std::uint32_t number = inclusion(place);
    const std::size_t first = zigzag_.first_[number];
    const int dimension = zigzag_.dimensions_[number];
    const std::size_t facets = dimension == 0 ? 0 : static_cast<std::size_t>(dimension) + 1;
    const bool is_of_exclusion = is_exclusion(place);
    for (std::size_t k = 0; k < facets; ++k) {
      const std::uint32_t facet = zigzag_.facets_[first + k];
      if (!is_of_exclusion) {
        visit(exclusions_ + facet, k % 2 == 1);
      } else if (zigzag_.exclusion_[facet] != OfflineZigzag::never_excluded) {
        visit(exclusions_ - 1 - zigzag_.exclusion_[facet], k % 2 == 0);
      }
    }
    if (!is_of_exclusion && zigzag_.exclusion_[number] != OfflineZigzag::never_excluded) {
      visit(exclusions_ - 1 - zigzag_.exclusion_[number], false);
    }
  }

 private:
  const OfflineZigzag& zigzag_;
  Place exclusions_;
};

}  // namespace sesame::engine
