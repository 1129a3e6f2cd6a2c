#include "engine/towers/barcode_tracker.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "engine/towers/chain_images.hpp"
#include "engine/towers/class_space.hpp"
#include "engine/towers/contraction_shifts.hpp"
#include "sparse/contract.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {
namespace {

using ops::TowerComplex;

template <Ring R>
class Tracker final : public BarcodeTracker {
 public:
  Tracker(R ring, OnBar on_bar, const TrackerOptions& options)
      : ring_{ring},
        any_ring_{ring},
        on_bar_{std::move(on_bar)},
        has_shared_slots_{options.slots == Slots::shared},
        dimensions_{options.dimensions},
        chains_{options.keeps_cycles ? std::make_unique<ChainImages<R>>(ring, options.slots) : nullptr} {}

  void include(int dimension, Slot slot, std::span<const Slot> facets, Time time) override {
    const auto d = static_cast<std::size_t>(dimension);
    if (chains_) {
      chains_->begin_inclusion(time);
    }
    if (dimensions_.are_above(d)) {
      return;
    }
    reach(d);
    if (chains_) {
      chains_->include(d, slot, facets);
    }
    sparse::GrowingArray<ClassRef>& refs = refs_of(d);
    if (slot >= refs.size()) {
      refs.resize(slot + std::size_t{1});
    }
    refs[slot] = ClassRef{};
    if (d == 0) {
      refs[slot] = bear(d, time);
      return;
    }
    const sparse::GrowingArray<ClassRef>& below = refs_of(d - 1);
    ClassSpace<R>& space = levels_[d - 1].space;
    // Facets are anywhere in memory: all loads are begun before the first is waited for.
    facet_refs_.resize(facets.size());
    std::ranges::transform(facets, facet_refs_.begin(), [&](Slot facet) { return below[facet]; });
    for (const ClassRef ref : facet_refs_) {
      if (!ref.is_zero()) {
        space.prefetch(ref.node());
      }
    }
    space.clear_sum();
    bool is_negative = false;
    for (const ClassRef ref : facet_refs_) {
      add(space, ref, is_negative);
      is_negative = !is_negative;
    }
    if (space.sum_is_zero()) {
      refs[slot] = bear(d, time);
    } else {
      kill(d - 1, time, UINT32_MAX);
      report_ended();
    }
  }

  void contract(const TowerComplex& complex, const TowerComplex::Changes& changes, Time time) override {
    sparse::expects(!has_shared_slots_, "a complex of columns has no contractions");
    if (chains_) {
      chains_->begin_contraction(time);
    }
    reach(changes.size());
    // A class that is born and dies within the contraction is nobody's: it has no bar.
    nodes_before_.clear();
    for (const Level& level : levels_) {
      nodes_before_.push_back(level.space.nodes());
    }
    for (std::size_t d = 0; d < changes.size() && dimensions_.have(d); ++d) {
      shifts_.begin_dimension(d);
      for (const TowerComplex::Change& change : changes[d]) {
        apply(complex, d, change, time, static_cast<std::uint32_t>(nodes_before_[d]));
      }
    }
    report_ended();
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      Level& level = levels_[d];
      if (level.space.nodes() > 2 * (level.space.alive() + level.refs.size()) + most_idle) {
        const auto number = level.space.retire(level.refs);
        if (chains_) {
          chains_->renumber(d, number);
        }
      }
    }
  }

  void prefetch(const ops::ColumnComplex& complex, std::span<const std::uint64_t> far,
                std::span<const std::uint64_t> near) const override {
    if (levels_.empty() || levels_[0].refs.empty()) {
      return;
    }
    const sparse::GrowingArray<ClassRef>& refs = levels_[0].refs;
    for (const std::uint64_t slot : far) {
      __builtin_prefetch(refs.data() + std::min<std::uint64_t>(slot, refs.size() - 1));
    }
    for (const std::uint64_t slot : near) {
      if (slot < std::min<std::uint64_t>(complex.cells(), refs.size()) && !refs[slot].is_zero()) {
        levels_[static_cast<std::size_t>(complex.dimension(slot))].space.prefetch(refs[slot].node());
      }
    }
  }

  [[nodiscard]] std::vector<std::uint64_t> betti() const override { return classes_alive(levels_); }

  void for_each_open_bar(const OnBar& visit) const override {
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      const ClassSpace<R>& space = levels_[d].space;
      for (std::uint32_t node = 0; node < space.nodes(); ++node) {
        if (space.is_alive(node)) {
          visit({static_cast<int>(d), space.birth(node), never});
        }
      }
    }
  }

  [[nodiscard]] std::uint64_t hidden() const override { return hidden_; }
  [[nodiscard]] const sparse::AnyRing& ring() const override { return any_ring_; }
  [[nodiscard]] BarCycles* cycles() override { return chains_.get(); }

  [[nodiscard]] Work work() const override {
    if (chains_) {
      return chains_->work();
    }
    Work work;
    for (const Level& level : levels_) {
      work.terms_touched += level.space.terms_touched();
      work.terms_held += level.space.terms_held();
      work.classes_held += level.space.nodes();
    }
    return work;
  }

 private:
  /// Nodes that nobody needs are looked for when there are as many again as can be needed, and so many more.
  static constexpr std::size_t most_idle = 4096;

  struct Level {
    explicit Level(R ring) : space{ring} {}
    ClassSpace<R> space;
    sparse::GrowingArray<ClassRef> refs;  ///< per slot
  };

  [[nodiscard]] sparse::GrowingArray<ClassRef>& refs_of(std::size_t dimension) {
    return levels_[has_shared_slots_ ? 0 : dimension].refs;
  }

  void reach(std::size_t dimension) {
    while (levels_.size() <= dimension + 1) {
      levels_.emplace_back(ring_);
    }
  }

  static void add(ClassSpace<R>& space, ClassRef ref, bool is_negative) {
    if (!ref.is_zero()) {
      space.add_to_sum(ref.node(), ref.is_negative() != is_negative);
    }
  }

  /// A class of a dimension is born, if it is one of those that are kept; else this is 0.
  ClassRef bear(std::size_t dimension, Time time) {
    if (!dimensions_.have(dimension)) {
      return {};
    }
    const std::uint32_t node = levels_[dimension].space.add(time);
    if (chains_) {
      chains_->bear(dimension, node);
    }
    return ClassRef{node};
  }

  /// Kills the sum of a dimension; its bar is nobody's when the class was born as one of the nodes from `first` on.
  void kill(std::size_t dimension, Time time, std::uint32_t first) {
    ClassSpace<R>& space = levels_[dimension].space;
    const std::uint32_t dead = space.kill_sum();
    if (chains_) {
      chains_->kill(dimension, dead);
    }
    if (dead >= first) {
      return;
    }
    const Time birth = space.birth(dead);
    if (birth == time) {
      ++hidden_;
    } else {
      ended_.push_back({static_cast<int>(dimension), birth, time});
    }
  }

  /// Reports the bars that an operation has ended, in an order that is a matter of the bars alone.
  void report_ended() {
    if (!ended_.empty()) {
      std::ranges::sort(ended_);
      std::ranges::for_each(ended_, on_bar_);
      ended_.clear();
    }
  }

  /// What g of a simplex has become by the corrections of the contraction: the sum, in the space of its dimension.
  void sum_with_corrections(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
    ClassSpace<R>& space = levels_[d].space;
    space.clear_sum();
    add(space, levels_[d].refs[change.slot], false);
    shifts_.for_each_correction(complex, d, change, [&](const ContractionShifts::Shift& shift, bool is_negative) {
      add(space, shift.born, is_negative);
      if (chains_) {
        chains_->correct(d, change.slot, shift.generator, is_negative);
      }
    });
  }

  void apply(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change, Time time,
             std::uint32_t first) {
    if (change.fate == TowerComplex::Fate::renamed) {
      rename(complex, d, change);
      return;
    }
    Level& level = levels_[d];
    ClassRef& ref = level.refs[change.slot];
    sum_with_corrections(complex, d, change);
    if (change.fate == TowerComplex::Fate::merged) {
      add(level.space, level.refs[change.survivor], !change.is_reversed);
    }
    ref = ClassRef{};
    ContractionShifts::Shift shift{change.slot, {}, 0};
    if (chains_) {
      shift.generator = chains_->next_generator();
      chains_->contract(d, change);
    }
    if (level.space.sum_is_zero()) {
      shift.born = bear(d + 1, time);
    } else {
      kill(d, time, first);
    }
    if (chains_ || !shift.born.is_zero()) {
      shifts_.note(shift);
    }
  }

  void rename(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
    Level& level = levels_[d];
    ClassRef& ref = level.refs[change.slot];
    if (!shifts_.is_idle()) {
      sum_with_corrections(complex, d, change);
      ref = level.space.sum_is_zero() ? ClassRef{} : ClassRef{level.space.keep_sum()};
    }
    if (change.is_reversed) {
      ref = -ref;
      if (chains_) {
        chains_->reverse(d, change.slot);
      }
    }
  }

  R ring_;
  sparse::AnyRing any_ring_;
  OnBar on_bar_;
  bool has_shared_slots_;
  Dimensions dimensions_;
  std::vector<Level> levels_;
  std::uint64_t hidden_ = 0;
  std::vector<Bar> ended_;                 ///< by the operation at hand
  std::vector<ClassRef> facet_refs_;       ///< of the cell that is being included
  std::vector<std::size_t> nodes_before_;  ///< the contraction that is being made, by dimension
  ContractionShifts shifts_;
  std::unique_ptr<ChainImages<R>> chains_;  ///< when cycles are kept
};

}  // namespace

std::unique_ptr<BarcodeTracker> make_barcode_tracker(const sparse::AnyRing& ring, BarcodeTracker::OnBar on_bar,
                                                     const TrackerOptions& options) {
  if (const auto* z2 = std::get_if<sparse::Z2>(&ring)) {
    return std::make_unique<Tracker<sparse::Z2>>(*z2, std::move(on_bar), options);
  }
  if (const auto* q = std::get_if<sparse::Rationals>(&ring)) {
    return std::make_unique<Tracker<sparse::Rationals>>(*q, std::move(on_bar), options);
  }
  const auto* zp = std::get_if<sparse::Zp>(&ring);
  sparse::expects(zp != nullptr, "a barcode is taken over a field");
  return std::make_unique<Tracker<sparse::Zp>>(*zp, std::move(on_bar), options);
}

}  // namespace sesame::engine
