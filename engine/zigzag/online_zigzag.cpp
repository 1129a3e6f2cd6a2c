#include <algorithm>
#include <utility>
#include <variant>

#include "engine/zigzag/cycle_history.hpp"
#include "engine/zigzag/cycle_level.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

/// The open cycles are ranked: those born by inclusions in the order of their births, and before all of them those
/// born by exclusions, the last one first. A cycle may be changed by those of lower rank, and by boundaries, and still
/// stands for its bar. So of the classes that an inclusion makes dependent the highest dies, and of those that an
/// exclusion leaves without their cell the lowest.
/// Source: G. Carlsson, V. de Silva, D. Morozov, "Zigzag persistent homology and real-valued functions" (2009);
/// C. Maria, S. Oudot, "Zigzag persistence via reflections and transpositions" (2015).
template <sparse::Ring R>
class OnlineZigzag final : public ZigzagBarcode {
 public:
  OnlineZigzag(R ring, OnBar on_bar) : ring_{ring}, any_ring_{ring}, on_bar_{std::move(on_bar)}, sum_{ring} {}
  OnlineZigzag(R ring, OnBar on_bar, OnCycles on_cycles, std::function<bool(int)> wants)
      : OnlineZigzag(ring, std::move(on_bar)) {
    on_cycles_ = std::move(on_cycles);
    history_ = std::make_unique<CycleHistory<R>>(ring, std::move(wants));
  }

  void include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) override {
    const auto d = static_cast<std::size_t>(dimension);
    while (levels_.size() <= d) {
      levels_.emplace_back();
    }
    const CellKey cell = levels_[d].add_cell(slot);
    levels_[d].reserve_holders(std::max(levels_[d].numbers(), d > 0 ? levels_[d - 1].numbers() : 0));
    used_.clear();
    first_open_ = used_.size();
    highest_ = first_open_;
    if (d > 0) {
      reduce(d - 1, facets);
    }
    if (highest_ == used_.size()) {
      bear(d, cell, moment);
    } else {
      kill(d, cell, moment);
    }
  }

  void exclude(int dimension, Slot slot, Moment moment) override {
    const auto d = static_cast<std::size_t>(dimension);
    Level& level = levels_[d];
    const CellKey cell = level.key(slot);
    cycles_with_.clear();
    fillings_with_.clear();
    level.collect(cell, cycles_with_, fillings_with_);
    if (cycles_with_.empty()) {
      reopen(d, cell, moment);
    } else {
      lose(d, cell, moment);
    }
  }

  [[nodiscard]] std::vector<std::uint64_t> betti() const override {
    std::vector<std::uint64_t> betti;
    for (const Level& level : levels_) {
      betti.push_back(level.open());
    }
    while (!betti.empty() && betti.back() == 0) {
      betti.pop_back();
    }
    return betti;
  }

  void for_each_open_bar(const OnBar& visit) const override {
    for_each_open([&](const MomentBar& bar, Number) { visit(bar); });
  }
  void for_each_open_cycle(const OnCycles& visit) const override {
    for_each_open([&](const MomentBar& bar, Number number) { visit_cycles(bar, number, visit); });
  }

  [[nodiscard]] const sparse::AnyRing& ring() const override { return any_ring_; }

  [[nodiscard]] Work work() const override {
    Work work{touched_, 0};
    for (const Level& level : levels_) {
      for (const Cycle& cycle : level.cycles()) {
        work.terms_held += cycle.terms.size() + cycle.filling.size();
      }
    }
    return work;
  }

 private:
  using Level = CycleLevel<R>;
  using Chain = CellChain<R>;
  using Cycle = typename Level::Cycle;
  using Holder = typename Level::Holder;
  using Number = typename Level::Number;
  using Used = typename Level::Used;
  using Element = typename R::Element;

  /// Calls visit(bar, number) for each class that is alive, by dimension and birth.
  template <class Visit>
  void for_each_open(Visit&& visit) const {
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      for (const Number number : levels_[d].open_by_birth()) {
        visit(MomentBar{static_cast<int>(d), levels_[d][number].birth, {UINT64_MAX, never}}, number);
      }
    }
  }

  // ---- who has what

  /// A chain of level d comes, or goes, with all that it has.
  void toggle(std::size_t d, Holder holder, const Chain& chain) {
    Level& level = levels_[d];
    for (const CellTerm<R>& term : chain) {
      level.toggle(term.cell, holder);
    }
  }
  /// A number for one more cycle of level d.
  Number add_cycle(std::size_t d) {
    const Number number = levels_[d].add();
    levels_[d].reserve_holders(levels_[d].numbers());
    if (d + 1 < levels_.size()) {
      levels_[d + 1].reserve_holders(levels_[d].numbers());
    }
    return number;
  }

  /// x += factor y, chains of level d.
  void add(std::size_t d, Chain& x, Holder holder, const Chain& y, const Element& factor) {
    touched_ += x.size() + y.size();
    Level& level = levels_[d];
    if (holder.is_filling || level[holder.number].is_open) {
      add_chain(ring_, x, y, factor, scratch_, [&](CellKey cell) { level.toggle(cell, holder); });
    } else {  // nobody asks which boundaries have a cell
      add_chain(ring_, x, y, factor, scratch_, [](CellKey) {});
    }
  }

  // ---- inclusion

  void add_boundary(const Level& level, std::span<const Slot> facets) {
    Element sign = ring_.one();
    for (const Slot facet : facets) {
      sum_.add(level.key(facet), sign);
      sign = ring_.negate(sign);
    }
  }

  /// Writes a boundary in the basis of cycles of level d, into `used_`, the youngest first. What is left of it when the
  /// first open cycle is met goes to `rest_`.
  void reduce(std::size_t d, std::span<const Slot> facets) {
    Level& level = levels_[d];
    add_boundary(level, facets);
    CellKey cell;
    Element value;
    first_open_ = highest_ = SIZE_MAX;
    while (sum_.take(cell, value)) {
      const Number number = level.owner(cell);
      const Cycle& cycle = level[number];
      if (cycle.is_open && first_open_ == SIZE_MAX) {
        first_open_ = used_.size();
        sum_.add(cell, value);
        rest_ = sum_.terms(ring_.one());
        sum_.take(cell, value);
      }
      if (cycle.is_open && (highest_ == SIZE_MAX || level[used_[highest_].number].rank < cycle.rank)) {
        highest_ = used_.size();
      }
      used_.push_back({number, value});
      touched_ += cycle.terms.size();
      sum_.add(std::span{cycle.terms}.subspan(1), ring_.negate(value));
    }
    first_open_ = std::min(first_open_, used_.size());
    highest_ = std::min(highest_, used_.size());
  }

  /// The cell less the fillings of what the boundary had before `end`.
  Chain less_fillings(std::size_t d, CellKey cell, std::size_t end, const Element& factor) {
    if (end == 0) {
      return {cell_term<R>(cell, factor)};
    }
    sum_.add(cell, ring_.one());
    for (std::size_t k = 0; k < end; ++k) {
      const Chain& filling = levels_[d - 1][used_[k].number].filling;
      touched_ += filling.size();
      sum_.add(filling, ring_.negate(used_[k].times));
    }
    Chain chain = sum_.terms(factor);
    sum_.clear();
    return chain;
  }

  void bear(std::size_t d, CellKey cell, Moment moment) {
    Chain terms = less_fillings(d, cell, used_.size(), ring_.one());
    Level& level = levels_[d];
    const Number number = add_cycle(d);
    level[number].terms = std::move(terms);
    level.owner(cell) = number;
    open(d, number, ++highest_rank_, moment);
  }

  void open(std::size_t d, Number number, std::int64_t rank, Moment moment) {
    levels_[d].open(number, rank, moment);
    toggle(d, {number, false}, levels_[d][number].terms);
    if (keeps_pasts(d)) {
      history_->begin(d, number);
    }
  }

  /// The highest class that the boundary has dies. Its number goes to the boundary, as far as boundaries have been
  /// taken from it, whose youngest cell is that of the first open cycle in it.
  void kill(std::size_t d, CellKey cell, Moment moment) {
    Level& level = levels_[d - 1];
    const Number dying = used_[highest_].number;
    const Element to_one = ring_.inverse(used_[first_open_].times);
    Chain filling = less_fillings(d, cell, first_open_, to_one);
    Chain was = keeps_pasts(d - 1)
                    ? history_->pass_on(d - 1, level, std::span{used_}.subspan(first_open_), rest_, sum_, moment)
                    : Chain{};
    if (first_open_ != highest_) {
      pass_on(d - 1);
    }
    toggle(d - 1, {dying, false}, level[dying].terms);
    level[dying].terms = std::move(was);
    end(d - 1, dying, moment);
    if (keeps_pasts(d - 1)) {
      history_->end(d - 1, dying);
    }
    level.owner(rest_) = dying;
    Cycle& cycle = level[dying];
    cycle.terms = scaled(ring_, std::move(rest_), to_one);
    cycle.filling = std::move(filling);
    toggle(d, {dying, true}, cycle.filling);
  }

  /// The boundary takes the youngest cell of the first open cycle that it has. So this cycle becomes what is left of
  /// the boundary after it, which is in its class now, as long as all of that bounds or is of lower rank; it takes the
  /// youngest cell of the next one of higher rank, and so on to the highest, which is not needed any more.
  void pass_on(std::size_t d) {
    Level& level = levels_[d];
    Number carrier = used_[first_open_].number;
    sum_.add(rest_, ring_.one());
    for (std::size_t k = first_open_; k <= highest_; ++k) {
      const auto& [number, times] = used_[k];
      const Cycle& cycle = level[number];
      if (cycle.is_open && level[carrier].rank < cycle.rank) {
        Chain& terms = level[carrier].terms;
        toggle(d, {carrier, false}, terms);
        terms = sum_.terms(ring_.inverse(times));
        toggle(d, {carrier, false}, terms);
        level.owner(terms) = carrier;
        carrier = number;
      }
      sum_.add(cycle.terms, ring_.negate(times));
    }
    sum_.clear();
  }

  /// A class ends.
  void end(std::size_t d, Number number, Moment moment) {
    levels_[d].close(number);
    if (const Moment birth = levels_[d][number].birth; birth.operation != moment.operation) {
      const MomentBar bar{static_cast<int>(d), birth, moment};
      on_bar_(bar);
      visit_cycles(bar, number, on_cycles_);
    }
  }

  // ---- cycles of bars

  [[nodiscard]] bool keeps_pasts(std::size_t d) const { return history_ != nullptr && history_->keeps(d); }
  void visit_cycles(const MomentBar& bar, Number number, const OnCycles& visit) const {
    if (const auto d = static_cast<std::size_t>(bar.dimension); keeps_pasts(d)) {
      visit(bar, [&] { return history_->pieces(history_->past(d, number), levels_[d][number].terms, bar); });
    }
  }

  // ---- exclusion

  /// No open cycle has the cell: what bounded by it is open again. Of all fillings that have the cell the one whose
  /// boundary has the oldest youngest cell gives its cycle; to the others any of those before them is added, and so
  /// their cycles keep their youngest cells.
  void reopen(std::size_t d, CellKey cell, Moment moment) {
    sparse::expects(d > 0 && !fillings_with_.empty(), "a cell is in a cycle or in a filling");
    Level& below = levels_[d - 1];
    std::ranges::sort(fillings_with_, {}, [&](Number number) { return below[number].terms.front().cell; });
    const auto length = [&](std::size_t k) {
      const Cycle& cycle = below[fillings_with_[k]];
      return cycle.terms.size() + cycle.filling.size();
    };
    shortest_.assign(fillings_with_.size(), 0);
    for (std::size_t k = 2; k < fillings_with_.size(); ++k) {
      shortest_[k] = length(k - 1) < length(shortest_[k - 1]) ? k - 1 : shortest_[k - 1];
    }
    for (std::size_t k = fillings_with_.size(); k-- > 1;) {
      const Number number = fillings_with_[k];
      const Cycle& other = below[fillings_with_[shortest_[k]]];
      Cycle& cycle = below[number];
      const Element factor = ring_.negate(
          ring_.quotient(coefficient_at(ring_, cycle.filling, cell), coefficient_at(ring_, other.filling, cell)));
      add(d, cycle.filling, {number, true}, other.filling, factor);
      add(d - 1, cycle.terms, {number, false}, other.terms, factor);
    }
    toggle(d, {fillings_with_[0], true}, below[fillings_with_[0]].filling);
    below[fillings_with_[0]].filling = {};
    open(d - 1, fillings_with_[0], --lowest_rank_, moment);
    if (keeps_pasts(d - 1)) {  // it bounded until now
      history_->begin(d - 1, fillings_with_[0], below[fillings_with_[0]].terms, moment);
    }
  }

  /// Open cycles have the cell: the lowest of them dies. It is taken from the others in turn, and where that one has an
  /// older youngest cell, they exchange these.
  void lose(std::size_t d, CellKey cell, Moment moment) {
    Level& level = levels_[d];
    std::ranges::sort(cycles_with_, {}, [&](Number number) { return level[number].rank; });
    const Number sparsest =
        *std::ranges::min_element(cycles_with_, {}, [&](Number number) { return level[number].terms.size(); });
    for (const Number number : fillings_with_) {
      Chain& filling = levels_[d - 1][number].filling;
      add(d, filling, {number, true}, level[sparsest].terms,
          ring_.negate(ring_.quotient(coefficient_at(ring_, filling, cell),
                                      coefficient_at(ring_, level[sparsest].terms, cell))));
    }
    const Number dying = cycles_with_[0];
    toggle(d, {dying, false}, level[dying].terms);
    end(d, dying, moment);
    Chain taken = std::move(level[dying].terms);
    Chain past_of_taken = keeps_pasts(d) ? std::move(history_->past(d, dying)) : Chain{};
    for (const Number number : std::span{cycles_with_}.subspan(1)) {
      Chain& terms = level[number].terms;
      const Element factor =
          ring_.negate(ring_.quotient(coefficient_at(ring_, terms, cell), coefficient_at(ring_, taken, cell)));
      if (terms.front().cell > taken.front().cell) {
        add(d, terms, {number, false}, taken, factor);
        if (keeps_pasts(d)) {
          history_->add(history_->past(d, number), past_of_taken, factor, level[number].birth);
        }
      } else {
        level.owner(taken) = number;
        Chain old = terms;
        add(d, terms, {number, false}, taken, factor);
        terms = scaled(ring_, std::move(terms), ring_.inverse(factor));
        taken = std::move(old);
        if (keeps_pasts(d)) {
          history_->exchange(history_->past(d, number), past_of_taken, factor, level[number].birth);
        }
      }
    }
    level.owner(taken) = Level::nobody;
    level.remove(dying);
  }

  R ring_;
  sparse::AnyRing any_ring_;
  OnBar on_bar_;
  OnCycles on_cycles_;
  std::unique_ptr<CycleHistory<R>> history_;  ///< or null
  std::vector<Level> levels_;
  std::int64_t highest_rank_ = 0, lowest_rank_ = 0;
  std::uint64_t touched_ = 0;
  CellSum<R> sum_;
  // Of the change at hand:
  std::vector<Used> used_;                           ///< the youngest first
  std::size_t first_open_ = 0, highest_ = 0;         ///< in `used_`, or its size: no class dies
  Chain rest_;                                       ///< the boundary less what is used before the first open one
  std::vector<Number> cycles_with_, fillings_with_;  ///< that have the cell
  std::vector<std::size_t> shortest_;
  Chain scratch_;
};

template <class... Rest>
std::unique_ptr<ZigzagBarcode> make_over(const sparse::AnyRing& ring, Rest&&... rest) {
  if (const auto* z2 = std::get_if<sparse::Z2>(&ring)) {
    return std::make_unique<OnlineZigzag<sparse::Z2>>(*z2, std::forward<Rest>(rest)...);
  }
  if (const auto* q = std::get_if<sparse::Rationals>(&ring)) {
    return std::make_unique<OnlineZigzag<sparse::Rationals>>(*q, std::forward<Rest>(rest)...);
  }
  const auto* zp = std::get_if<sparse::Zp>(&ring);
  sparse::expects(zp != nullptr, "a barcode is taken over a field");
  return std::make_unique<OnlineZigzag<sparse::Zp>>(*zp, std::forward<Rest>(rest)...);
}

}  // namespace

std::unique_ptr<ZigzagBarcode> make_online_zigzag_barcode(const sparse::AnyRing& ring, ZigzagBarcode::OnBar on_bar) {
  return make_over(ring, std::move(on_bar));
}

std::unique_ptr<ZigzagBarcode> make_online_zigzag_barcode(const sparse::AnyRing& ring, ZigzagBarcode::OnBar on_bar,
                                                          ZigzagBarcode::OnCycles on_cycles,
                                                          std::function<bool(int dimension)> wants) {
  return make_over(ring, std::move(on_bar), std::move(on_cycles), std::move(wants));
}

}  // namespace sesame::engine
