#include "engine/zigzag/offline_zigzag.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "sparse/contract.hpp"
#include "sparse/descending_sum.hpp"

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
  std::vector<std::vector<Slot>> free(present_.size());
  std::vector<Slot> slots(present_.size(), 0), slot_of(inclusions()), facets;
  std::size_t told = 0;
  const auto exclude_until = [&](std::size_t end) {
    for (; told < end; ++told) {
      const std::uint32_t number = excluded_[told];
      const std::uint8_t d = dimensions_[number];
      tracker.exclude(d, slot_of[number], exclusions_[told]);
      free[d].push_back(slot_of[number]);
    }
  };
  for (std::size_t number = 0; number < inclusions(); ++number) {
    exclude_until(after_[number]);
    const std::uint8_t d = dimensions_[number];
    if (free[d].empty()) {
      free[d].push_back(slots[d]++);
    }
    slot_of[number] = free[d].back();
    free[d].pop_back();
    facets.clear();
    const std::size_t end = number + 1 < inclusions() ? first_[number + 1] : facets_.size();
    for (std::size_t k = first_[number]; k < end; ++k) {
      facets.push_back(slot_of[facets_[k]]);
    }
    tracker.include(d, slot_of[number], facets, inclusions_[number]);
  }
  exclude_until(exclusions());
}

/// The filtration that a zigzag is turned into. A place is the number of a cell in it.
class ZigzagFiltration {
 public:
  using Place = std::uint32_t;

  explicit ZigzagFiltration(const OfflineZigzag& zigzag)
      : zigzag_{zigzag}, exclusions_{static_cast<Place>(zigzag.excluded_.size())} {}

  [[nodiscard]] std::size_t size() const { return exclusions_ + zigzag_.dimensions_.size(); }
  [[nodiscard]] int largest_dimension() const { return static_cast<int>(zigzag_.present_.size()) - 1; }
  [[nodiscard]] bool is_exclusion(Place place) const { return place < exclusions_; }
  [[nodiscard]] std::uint32_t inclusion(Place place) const {
    return is_exclusion(place) ? zigzag_.excluded_[exclusions_ - 1 - place] : place - exclusions_;
  }
  /// That of the simplex; an exclusion has one less in the filtration.
  [[nodiscard]] int dimension_of_simplex(Place place) const { return zigzag_.dimensions_[inclusion(place)]; }
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

namespace {

using Place = ZigzagFiltration::Place;
constexpr Place no_place = UINT32_MAX;

template <sparse::Ring R>
struct ColumnTerm {
  Place place;
  typename R::Element coefficient;
};
template <>
struct ColumnTerm<sparse::Z2> {
  Place place;
};

/// Reduces the boundary matrix of a filtration, from the highest dimension down: whose boundary is reduced to something
/// with the youngest cell x makes the column of x empty.
template <sparse::Ring R>
class FiltrationPairs {
 public:
  FiltrationPairs(R ring, const ZigzagFiltration& filtration)
      : ring_{ring}, filtration_{filtration}, sum_{ring}, killer_(filtration.size(), no_place) {
    const auto dimensions = static_cast<std::size_t>(filtration.largest_dimension() + 2);
    std::vector<std::vector<Place>> cells(dimensions);  // by dimension, ascending
    for (Place place = 0; place < filtration.size(); ++place) {
      const int dimension = filtration.dimension_of_simplex(place) - (filtration.is_exclusion(place) ? 1 : 0);
      cells[static_cast<std::size_t>(dimension + 1)].push_back(place);
    }
    is_killer_.resize(filtration.size(), false);
    stored_.resize(filtration.size());
    for (std::size_t k = cells.size(); k-- > 0;) {
      for (const Place place : cells[k]) {
        if (killer_[place] == no_place) {
          reduce(place);
        }
      }
    }
  }

  /// Calls visit(place, killer) for all pairs and, with no_place, for what has no partner.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (Place place = 0; place < killer_.size(); ++place) {
      if (!is_killer_[place]) {
        visit(place, killer_[place]);
      }
    }
  }

 private:
  using Element = typename R::Element;
  /// Of a column that has been reduced: where in the pool it is; of length 0: it is the boundary itself.
  struct Stored {
    std::uint64_t first = 0;
    std::uint32_t size = 0;
  };

  void reduce(Place column) {
    Place youngest = no_place;
    filtration_.for_each_in_boundary(column, [&](Place place, bool) {
      if (youngest == no_place || place > youngest) {
        youngest = place;
      }
    });
    if (youngest == no_place) {
      return;
    }
    if (killer_[youngest] == no_place) {  // nothing to do, and nothing to keep
      pair(youngest, column);
      return;
    }
    add(column, ring_.one());
    while (auto term = sum_.take()) {
      if (killer_[term->index] == no_place) {
        pair(static_cast<Place>(term->index), column);
        store(column, static_cast<Place>(term->index), term->coefficient);
        return;
      }
      const Place other = killer_[term->index];
      // The youngest term of the other column has been taken out already.
      add_rest(other, static_cast<Place>(term->index), term->coefficient);
    }
  }
  void pair(Place place, Place killer) {
    killer_[place] = killer;
    is_killer_[killer] = true;
  }
  void store(Place column, Place place, const Element& coefficient) {
    Stored& stored = stored_[column];
    stored.first = pool_.size();
    pool_.push_back(term(place, coefficient));
    while (auto next = sum_.take()) {
      pool_.push_back(term(static_cast<Place>(next->index), next->coefficient));
    }
    stored.size = static_cast<std::uint32_t>(pool_.size() - stored.first);
  }
  static ColumnTerm<R> term(Place place, [[maybe_unused]] const Element& coefficient) {
    if constexpr (std::is_same_v<R, sparse::Z2>) {
      return {place};
    } else {
      return {place, coefficient};
    }
  }
  void add(Place column, const Element& factor) {
    const Element minus = ring_.negate(factor);
    filtration_.for_each_in_boundary(column, [&](Place place, bool is_negative) {
      sum_.add_product(place, is_negative ? minus : factor, ring_.one());
    });
  }
  /// Adds a multiple of a column, so that its youngest term cancels one with a coefficient that has been taken out.
  void add_rest(Place column, Place youngest, const Element& coefficient) {
    const Stored& stored = stored_[column];
    if (stored.size == 0) {
      bool leads_with_minus = false;
      filtration_.for_each_in_boundary(
          column, [&](Place place, bool is_negative) { leads_with_minus |= place == youngest && is_negative; });
      const Element factor = leads_with_minus ? coefficient : ring_.negate(coefficient);
      const Element minus = ring_.negate(factor);
      filtration_.for_each_in_boundary(column, [&](Place place, bool is_negative) {
        if (place != youngest) {
          sum_.add_product(place, is_negative ? minus : factor, ring_.one());
        }
      });
      return;
    }
    const std::span<const ColumnTerm<R>> terms{pool_.data() + stored.first, stored.size};
    if constexpr (std::is_same_v<R, sparse::Z2>) {
      for (const ColumnTerm<R>& each : terms.subspan(1)) {
        sum_.add_product(each.place, 1, 1);
      }
    } else {
      const Element factor = ring_.negate(ring_.quotient(coefficient, terms[0].coefficient));
      for (const ColumnTerm<R>& each : terms.subspan(1)) {
        sum_.add_product(each.place, factor, each.coefficient);
      }
    }
  }

  R ring_;
  const ZigzagFiltration& filtration_;
  sparse::DescendingSum<R> sum_;
  std::vector<Place> killer_;  ///< of each cell whose class has one
  std::vector<bool> is_killer_;
  std::vector<Stored> stored_;  ///< per killer
  std::vector<ColumnTerm<R>> pool_;
};

MomentBar bar_of(const ZigzagFiltration& filtration, Place place, Place killer) {
  const Moment own = filtration.moment(place);
  const int dimension = filtration.dimension_of_simplex(place);
  if (killer == no_place) {
    return {dimension - (filtration.is_exclusion(place) ? 1 : 0), own, {UINT64_MAX, never}};
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
std::vector<MomentBar> bars_over(R ring, const ZigzagFiltration& filtration) {
  std::vector<MomentBar> bars;
  FiltrationPairs<R>(ring, filtration).for_each([&](Place place, Place killer) {
    const MomentBar bar = bar_of(filtration, place, killer);
    if (bar.birth.operation != bar.death.operation) {
      bars.push_back(bar);
    }
  });
  return bars;
}

}  // namespace

void OfflineZigzag::for_each_bar(const sparse::AnyRing& ring, const OnBar& visit) const {
  const ZigzagFiltration filtration(*this);
  std::vector<MomentBar> bars = std::visit(
      [&]<class R>(const R& field) {
        if constexpr (R::is_field) {
          return bars_over(field, filtration);
        } else {
          sparse::expects(false, "a barcode is taken over a field");
          return std::vector<MomentBar>{};
        }
      },
      ring);
  std::ranges::sort(bars, {}, [](const MomentBar& bar) { return bar.death.operation; });
  std::ranges::for_each(bars, visit);
}

}  // namespace sesame::engine
