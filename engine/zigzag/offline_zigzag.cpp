#include "engine/zigzag/offline_zigzag.hpp"

#include <algorithm>
#include <variant>

#include "engine/zigzag/filtration_pairs.hpp"
#include "engine/zigzag/zigzag_filtration.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

void OfflineZigzag::include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) {
  const auto d = static_cast<std::size_t>(dimension);
  if (present_.size() <= d) {
    present_.resize(d + 1);
  }
  if (present_[d].size() <= slot) {
    present_[d].resize(slot + std::size_t{1});
  }
  const std::size_t number = dimensions_.size();
  sparse::expects(number < UINT32_MAX / 2, "fewer than 2^31 inclusions");
  present_[d][slot] = static_cast<std::uint32_t>(number);
  dimensions_.push_back(static_cast<std::uint8_t>(dimension));
  slots_.push_back(slot);
  first_.push_back(facets_.size());
  for (const Slot facet : facets) {
    facets_.push_back(present_[d - 1][facet]);
  }
  exclusion_.push_back(never_excluded);
  after_.push_back(static_cast<std::uint32_t>(excluded_.size()));
  most_present_ = std::max(most_present_, dimensions_.size() - excluded_.size());
  inclusions_.push_back(moment);
}

void OfflineZigzag::exclude(int dimension, Slot slot, Moment moment) {
  const std::uint32_t number = present_[static_cast<std::size_t>(dimension)][slot];
  exclusion_[number] = static_cast<std::uint32_t>(excluded_.size());
  excluded_.push_back(number);
  exclusions_.push_back(moment);
}

void OfflineZigzag::tell(ZigzagTracker& tracker) const {
  std::vector<Slot> facets;
  std::size_t told = 0;
  const auto exclude_until = [&](std::size_t end) {
    for (; told < end; ++told) {
      tracker.exclude(dimensions_[excluded_[told]], slots_[excluded_[told]], exclusions_[told]);
    }
  };
  for (std::size_t number = 0; number < inclusions(); ++number) {
    exclude_until(after_[number]);
    facets.clear();
    const std::size_t end = number + 1 < inclusions() ? first_[number + 1] : facets_.size();
    for (std::size_t k = first_[number]; k < end; ++k) {
      facets.push_back(slots_[facets_[k]]);
    }
    tracker.include(dimensions_[number], slots_[number], facets, inclusions_[number]);
  }
  exclude_until(exclusions());
}

namespace {

using Place = ZigzagFiltration::Place;
constexpr Place no_place = UINT32_MAX;

MomentBar bar_of(const ZigzagFiltration& filtration, Place place, Place killer) {
  const Moment own = filtration.moment(place);
  const int dimension = filtration.dimension_of_simplex(place);
  if (killer == no_place) {
    return {filtration.dimension(place), own, {UINT64_MAX, never}};
  }
  const Moment other = filtration.moment(killer);
  if (!filtration.is_exclusion(place)) {
    return {dimension, own, other};
  }
  if (filtration.is_exclusion(killer)) {
    return {dimension, other, own};
  }
  // Within one operation, a contraction, inclusions come before exclusions.
  return own.operation < other.operation ? MomentBar{dimension - 1, own, other} : MomentBar{dimension, other, own};
}

template <sparse::Ring R>
ZigzagBarcode::Work add_bars(R ring, const ZigzagFiltration& filtration, std::vector<MomentBar>& bars) {
  const FiltrationPairs<R> pairs(ring, filtration);
  pairs.for_each([&](Place place, Place killer) {
    const MomentBar bar = bar_of(filtration, place, killer);
    if (bar.birth.operation != bar.death.operation) {
      bars.push_back(bar);
    }
  });
  return pairs.work();
}

}  // namespace

ZigzagBarcode::Work OfflineZigzag::for_each_bar(const sparse::AnyRing& ring, const OnBar& visit) const {
  std::vector<MomentBar> bars;
  const ZigzagBarcode::Work work = std::visit(
      [&]<class R>(const R& field) {
        if constexpr (R::is_field) {
          return add_bars(field, ZigzagFiltration(*this), bars);
        } else {
          sparse::expects(false, "a barcode is taken over a field");
          return ZigzagBarcode::Work{};
        }
      },
      ring);
  std::ranges::sort(bars, {}, [](const MomentBar& bar) { return bar.death.operation; });
  std::ranges::for_each(bars, visit);
  return work;
}

}  // namespace sesame::engine
