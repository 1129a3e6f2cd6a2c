#include <algorithm>
#include <utility>
#include <variant>

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
    for (std::size_t d = 0; d < levels_.size(); ++d) {
      std::vector<Moment> births;
      for (const Cycle& cycle : levels_[d].cycles()) {
        if (cycle.is_open) {
          births.push_back(cycle.birth);
        }
      }
      std::ranges::sort(births, {}, &Moment::operation);
      for (const Moment& birth : births) {
        visit({static_cast<int>(d), birth, {UINT64_MAX, never}});
      }
    }
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
  using Element = typename R::Element;

  /// A cycle of the basis, and how often the boundary of the new cell has it.
  struct Used {
    Number number;
    Element times;
  };

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
  /// Of a cell that the chain has.
  [[nodiscard]] Element coefficient_at([[maybe_unused]] const Chain& chain, [[maybe_unused]] CellKey cell) const {
    if constexpr (std::is_same_v<R, sparse::Z2>) {
      return ring_.one();
    } else {
      return find_term<R>(chain, cell)->coefficient;
    }
  }
  [[nodiscard]] Chain scaled(Chain chain, [[maybe_unused]] const Element& factor) const {
    if constexpr (!std::is_same_v<R, sparse::Z2>) {
      for (CellTerm<R>& term : chain) {
        term.coefficient = ring_.multiply(term.coefficient, factor);
      }
    }
    return chain;
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
  }

  /// The highest class that the boundary has dies. Its number goes to the boundary, as far as boundaries have been
  /// taken from it, whose youngest cell is that of the first open cycle in it.
  void kill(std::size_t d, CellKey cell, Moment moment) {
    Level& level = levels_[d - 1];
    const Number dying = used_[highest_].number;
    const Element to_one = ring_.inverse(used_[first_open_].times);
    Chain filling = less_fillings(d, cell, first_open_, to_one);
    if (first_open_ != highest_) {
      pass_on(d - 1);
    }
    toggle(d - 1, {dying, false}, level[dying].terms);
    end(d - 1, dying, moment);
    level.owner(rest_) = dying;
    Cycle& cycle = level[dying];
    cycle.terms = scaled(std::move(rest_), to_one);
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
      on_bar_({static_cast<int>(d), birth, moment});
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
      const Element factor =
          ring_.negate(ring_.quotient(coefficient_at(cycle.filling, cell), coefficient_at(other.filling, cell)));
      add(d, cycle.filling, {number, true}, other.filling, factor);
      add(d - 1, cycle.terms, {number, false}, other.terms, factor);
    }
    toggle(d, {fillings_with_[0], true}, below[fillings_with_[0]].filling);
    below[fillings_with_[0]].filling = {};
    open(d - 1, fillings_with_[0], --lowest_rank_, moment);
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
          ring_.negate(ring_.quotient(coefficient_at(filling, cell), coefficient_at(level[sparsest].terms, cell))));
    }
    const Number dying = cycles_with_[0];
    toggle(d, {dying, false}, level[dying].terms);
    Chain taken = std::move(level[dying].terms);
    for (const Number number : std::span{cycles_with_}.subspan(1)) {
      Chain& terms = level[number].terms;
      const Element factor = ring_.negate(ring_.quotient(coefficient_at(terms, cell), coefficient_at(taken, cell)));
      if (terms.front().cell > taken.front().cell) {
        add(d, terms, {number, false}, taken, factor);
      } else {
        level.owner(taken) = number;
        Chain old = terms;
        add(d, terms, {number, false}, taken, factor);
        terms = scaled(std::move(terms), ring_.inverse(factor));
        taken = std::move(old);
      }
    }
    level.owner(taken) = Level::nobody;
    end(d, dying, moment);
    level.remove(dying);
  }

  R ring_;
  sparse::AnyRing any_ring_;
  OnBar on_bar_;
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

}  // namespace

std::unique_ptr<ZigzagBarcode> make_online_zigzag_barcode(const sparse::AnyRing& ring, ZigzagBarcode::OnBar on_bar) {
  if (const auto* z2 = std::get_if<sparse::Z2>(&ring)) {
    return std::make_unique<OnlineZigzag<sparse::Z2>>(*z2, std::move(on_bar));
  }
  if (const auto* q = std::get_if<sparse::Rationals>(&ring)) {
    return std::make_unique<OnlineZigzag<sparse::Rationals>>(*q, std::move(on_bar));
  }
  const auto* zp = std::get_if<sparse::Zp>(&ring);
  sparse::expects(zp != nullptr, "a barcode is taken over a field");
  return std::make_unique<OnlineZigzag<sparse::Zp>>(*zp, std::move(on_bar));
}

}  // namespace sesame::engine
