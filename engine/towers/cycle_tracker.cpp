#include "engine/towers/cycle_tracker.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <variant>

#include "engine/towers/class_space.hpp"
#include "engine/towers/contraction_shifts.hpp"
#include "engine/towers/time_list.hpp"
#include "sparse/contract.hpp"
#include "sparse/descending_sum.hpp"

namespace sesame::engine {
namespace {

using ops::TowerComplex;
using sparse::Ring;
using sparse::Terms;
using TermRange = std::pair<std::uint64_t, std::uint32_t>;  ///< the first one, how many

template <Ring R>
class Tracker final : public CycleTracker {
 public:
  Tracker(R ring, OnBar on_bar, Dimensions dimensions)
      : ring_{ring}, any_ring_{ring}, on_bar_{std::move(on_bar)}, dimensions_{dimensions}, sum_{ring} {}

  void include(int dimension, Slot slot, std::span<const Slot> facets, Time time) override {
    times_.push_back(time);
    const auto d = static_cast<std::size_t>(dimension);
    const std::uint32_t inclusion = inclusions_++;
    if (dimensions_.are_above(d)) {
      return;
    }
    reach(d);
    typename R::Element sign = ring_.one();
    boundary_.clear();
    for (const Slot facet : facets) {
      add_cell(d - 1, facet, sign);
      sign = ring_.negate(sign);
    }
    std::vector<Image>& images = images_[d];
    if (slot >= images.size()) {
      images.resize(std::max<std::size_t>(slot + std::size_t{1}, images.size() + images.size() / 2));
    }
    images[slot] = Image{static_cast<Generator>(generators_.size()), false, no_terms};
    append(d, inclusion);
  }

  void contract(const TowerComplex& complex, const TowerComplex::Changes& changes, Time time) override {
    times_.push_back(time);
    reach(changes.size());
    for (std::size_t d = 0; d < changes.size() && dimensions_.have(d); ++d) {
      shifts_.begin_dimension(d);
      for (const TowerComplex::Change& change : changes[d]) {
        apply(complex, d, change);
      }
    }
  }

  [[nodiscard]] std::vector<std::uint64_t> betti() const override { return classes_alive(levels_); }

  void for_each_open_bar(const OnBar& visit) const override {
    std::vector<Bar> bars;
    for (const Cell& generator : generators_) {
      if (generator.partner == alive_mark) {
        bars.push_back({static_cast<int>(generator.dimension), times_[generator.operation], never});
      }
    }
    std::ranges::sort(bars);
    std::ranges::for_each(bars, visit);
  }

  [[nodiscard]] std::uint64_t hidden() const override { return hidden_; }
  [[nodiscard]] const sparse::AnyRing& ring() const override { return any_ring_; }
  [[nodiscard]] Work work() const override {
    return {terms_touched_, terms_.size() + additions_.size(), generators_.size()};
  }

  [[nodiscard]] std::vector<TracedBar> bars() const override {
    std::vector<TracedBar> found;
    for (Generator a = 0; a < generators_.size(); ++a) {
      const Cell& cell = generators_[a];
      const auto dimension = static_cast<int>(cell.dimension);
      if (cell.partner == alive_mark) {
        found.push_back({{dimension, times_[cell.operation], never}, cell.operation, cell.operation, a, a});
      } else if (cell.partner != negative_mark && generators_[cell.partner].operation != cell.operation) {
        const std::uint32_t killer = generators_[cell.partner].operation;
        found.push_back({{dimension, times_[cell.operation], times_[killer]}, cell.operation, killer, a, cell.partner});
      }
    }
    std::ranges::stable_sort(found, {}, &TracedBar::bar);
    return found;
  }

  [[nodiscard]] std::uint64_t last_operation_with(std::uint64_t operation) const override {
    return times_.last_equal(operation);
  }

  [[nodiscard]] InclusionChain cycle(const TracedBar& bar) override {
    if (bar.bar.death == never) {
      const std::span<const TermType> kept = kept_terms(generators_[bar.birth]);
      const Terms<R> boundary(kept.begin(), kept.end());
      std::vector<Addition> additions{{bar.birth, ring_.one()}};
      reduce(boundary, [&](Generator killer, const typename R::Element& factor) {
        additions.push_back({killer, factor});
      });
      return expand(additions);
    }
    return inclusions(kept_terms(generators_[bar.birth]));
  }

  [[nodiscard]] InclusionChain bounded_chain(const TracedBar& bar) override {
    sparse::expects(bar.bar.death != never, "a bar that has ended has a chain that its cycle bounds");
    const Addition whole{bar.death, ring_.one()};
    return expand({&whole, 1});
  }

 private:
  using Generator = std::uint32_t;
  using TermType = sparse::Term<R>;
  static constexpr std::uint32_t alive_mark = UINT32_MAX;
  static constexpr std::uint32_t negative_mark = UINT32_MAX - 1;
  static constexpr std::uint32_t no_inclusion = UINT32_MAX;
  static constexpr std::uint32_t no_terms = UINT32_MAX;

  /// A generator of the big complex.
  struct Cell {
    std::uint64_t first_term;  ///< in terms_: of its boundary while it is alive, of R(partner) once it is dead
    std::uint32_t terms;
    Generator partner;  ///< what killed it, or alive_mark, or negative_mark: it killed another one
    std::uint32_t operation;
    std::uint32_t inclusion;  ///< no_inclusion when it is that of a merged or squashed simplex
    std::uint8_t dimension;
  };
  /// g of a current cell: plus or minus a generator, and corrections.
  struct Image {
    Generator generator = 0;
    bool is_negative = false;
    std::uint32_t corrections = no_terms;  ///< in corrections_
  };

  struct Addition {
    Generator killer;
    typename R::Element factor;
  };
  /// The classes of a dimension, which say at once who kills and whom.
  using Node = typename ClassSpace<R>::Node;
  static constexpr Node no_node = UINT32_MAX;
  struct Level {
    explicit Level(R ring) : space{ring} {}
    ClassSpace<R> space;
    std::vector<Generator> generators;  ///< per node
  };

  void reach(std::size_t dimension) {
    if (images_.size() < dimension + 2) {
      images_.resize(dimension + 2);
    }
    while (levels_.size() < dimension + 2) {
      levels_.emplace_back(ring_);
    }
  }

  // ---- reduction

  /// boundary_ += factor g(cell).
  void add_cell(std::size_t d, Slot slot, const typename R::Element& factor) {
    const Image& image = images_[d][slot];
    boundary_.push_back({image.generator, image.is_negative ? ring_.negate(factor) : factor});
    if (image.corrections != no_terms) {
      for (const TermType& each : corrections_[image.corrections]) {
        boundary_.push_back({each.index, ring_.multiply(factor, each.coefficient)});
      }
    }
  }

  /// The next generator, whose boundary is boundary_; none when it would be a class of a dimension that is not kept.
  void append(std::size_t dimension, std::uint32_t inclusion) {
    sparse::expects(std::max(generators_.size(), times_.size()) < negative_mark, "fewer than 2^32 - 2 generators");
    sparse::normalize(ring_, boundary_);
    const bool kills = is_killer(dimension);
    if (!kills && !dimensions_.have(dimension)) {
      return;
    }
    const auto b = static_cast<Generator>(generators_.size());
    const auto operation = static_cast<std::uint32_t>(times_.size() - 1);
    generators_.push_back({terms_.size(), static_cast<std::uint32_t>(boundary_.size()), alive_mark, operation,
                           inclusion, static_cast<std::uint8_t>(dimension)});
    added_.emplace_back(additions_.size(), 0);
    scale_.push_back(ring_.one());
    if (!kills) {
      // That V(b) is a cycle will do; which one is worked out when somebody asks.
      terms_.insert(terms_.end(), boundary_.begin(), boundary_.end());
      nodes_.push_back(levels_[dimension].space.add(0));
      levels_[dimension].generators.push_back(b);
      return;
    }
    Level& below = levels_[dimension - 1];
    const Generator pivot = below.generators[below.space.kill_sum()];
    nodes_.push_back(no_node);
    reduce(boundary_, [&](Generator killer, const typename R::Element& factor) {
      additions_.push_back({killer, factor});
    });
    added_[b].second = static_cast<std::uint32_t>(additions_.size() - added_[b].first);
    sparse::expects(!column_.empty() && column_.back().index == pivot, "two methods find the same pair");
    kill(pivot, b);
  }

  /// Whether boundary_ is no boundary yet: then the sum of the classes below is what it is.
  bool is_killer(std::size_t dimension) {
    if (dimension == 0) {
      return false;
    }
    ClassSpace<R>& space = levels_[dimension - 1].space;
    space.clear_sum();
    for (const TermType& each : boundary_) {
      if (nodes_[each.index] != no_node) {
        add_multiple(space, nodes_[each.index], each.coefficient);
      }
    }
    return !space.sum_is_zero();
  }

  /// The sum of a space += coefficient * node. Coefficients are small: 1 or -1, or a few of them added up.
  void add_multiple(ClassSpace<R>& space, Node node, const typename R::Element& coefficient) {
    const sparse::Integer value = ring_.to_integer(coefficient);
    const sparse::Integer opposite = ring_.to_integer(ring_.negate(coefficient));
    // Over Z/p neither is negative, and the smaller counts; over Q one of them is.
    const bool is_negative = value.sign() < 0 || (opposite.sign() > 0 && opposite < value);
    for (sparse::Integer left = is_negative ? opposite : value; left > 0; left -= 1) {
      space.add_to_sum(node, is_negative);
    }
  }

  /// Leaves in column_ a boundary with multiples of R(killer) added until its youngest generator is alive, or nothing
  /// is left; tells note(killer, factor) of each. For a cycle that is worked out late that is what it would have been
  /// when it was born: all classes in its boundary were dead by then.
  template <class Note>
  void reduce(std::span<const TermType> boundary, Note&& note) {
    for (const TermType& each : boundary) {
      add_term(each.index, ring_.one(), each.coefficient);
    }
    column_.clear();
    std::optional<TermType> top = sum_.take();
    for (; top; top = sum_.take()) {
      const Cell& cell = generators_[top->index];
      const Generator killer = cell.partner;
      sparse::expects(killer != negative_mark, "the youngest generator of a cycle is a class");
      if (killer == alive_mark) {
        break;
      }
      // R(killer) ends with 1 times this generator.
      const typename R::Element factor = ring_.negate(top->coefficient);
      for (const TermType& each : kept_terms(cell).first(cell.terms - 1)) {
        add_term(each.index, factor, each.coefficient);
      }
      note(killer, factor);
    }
    for (; top; top = sum_.take()) {
      column_.push_back(*top);
    }
    std::ranges::reverse(column_);
  }

  [[nodiscard]] std::span<const TermType> kept_terms(const Cell& cell) const {
    return {terms_.data() + cell.first_term, cell.terms};
  }

  void add_term(Generator generator, const typename R::Element& factor, const typename R::Element& coefficient) {
    ++terms_touched_;
    __builtin_prefetch(generators_.data() + generator);  // it may be the youngest some time soon
    sum_.add_product(generator, factor, coefficient);
  }

  /// Keeps the reduced boundary of b, made to end with 1 times the pivot, and notes the bar.
  void kill(Generator pivot, Generator b) {
    const std::uint64_t first_term = terms_.size();
    scale_[b] = ring_.inverse(column_.back().coefficient);
    for (const TermType& each : column_) {
      terms_.push_back({each.index, ring_.multiply(scale_[b], each.coefficient)});
    }
    Cell& dead = generators_[pivot];
    dead.first_term = first_term;
    dead.terms = static_cast<std::uint32_t>(column_.size());
    dead.partner = b;
    generators_[b].partner = negative_mark;
    if (dead.operation == generators_[b].operation) {
      return;  // born and dead within one contraction: nobody's
    }
    const Bar bar{static_cast<int>(dead.dimension), times_[dead.operation], times_.back()};
    if (bar.birth == bar.death) {
      ++hidden_;
    } else {
      on_bar_(bar);
    }
  }

  // ---- contraction: see the other tracker, engine/towers/barcode_tracker.cpp

  void apply(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
    boundary_.clear();
    correct(complex, d, change);
    Image& image = images_[d][change.slot];
    if (change.fate == TowerComplex::Fate::renamed) {
      if (change.is_reversed) {
        reverse(image);
      }
      return;
    }
    add_cell(d, change.slot, ring_.one());
    if (change.fate == TowerComplex::Fate::merged) {
      add_cell(d, change.survivor, change.is_reversed ? ring_.one() : ring_.negate(ring_.one()));
    }
    shifts_.note(change.slot, static_cast<Generator>(generators_.size()));
    append(d + 1, no_inclusion);
  }

  /// Adds to g of a simplex the generators of its facets that were merged or squashed.
  void correct(const TowerComplex& complex, std::size_t d, const TowerComplex::Change& change) {
    shifts_.for_each_correction(complex, d, change, [&](Generator generator, bool is_negative) {
      Image& image = images_[d][change.slot];
      if (image.corrections == no_terms) {
        image.corrections = static_cast<std::uint32_t>(corrections_.size());
        corrections_.emplace_back();
      }
      corrections_[image.corrections].push_back({generator, ring_.from(is_negative ? -1 : 1)});
    });
  }

  void reverse(Image& image) {
    image.is_negative = !image.is_negative;
    if (image.corrections != no_terms) {
      for (TermType& each : corrections_[image.corrections]) {
        each.coefficient = ring_.negate(each.coefficient);
      }
    }
  }

  // ---- chains

  [[nodiscard]] InclusionChain inclusions(std::span<const TermType> terms) const {
    InclusionChain chain;
    for (const TermType& each : terms) {
      if (generators_[each.index].inclusion != no_inclusion) {
        chain.emplace_back(generators_[each.index].inclusion, to_rational(ring_, each.coefficient));
      }
    }
    return chain;
  }

  /// The sum of multiples of V(b): younger generators first, so that each is expanded once.
  [[nodiscard]] InclusionChain expand(std::span<const Addition> sum) {
    for (const Addition& each : sum) {
      sum_.add_product(each.killer, ring_.one(), each.factor);
    }
    Terms<R> found;
    while (const std::optional<TermType> top = sum_.take()) {
      const typename R::Element scaled = ring_.multiply(top->coefficient, scale_[top->index]);
      found.push_back({top->index, scaled});
      const TermRange range = added_[top->index];
      for (const Addition& each : std::span{additions_}.subspan(range.first, range.second)) {
        sum_.add_product(each.killer, scaled, each.factor);
      }
    }
    std::ranges::reverse(found);
    return inclusions(found);
  }

  R ring_;
  sparse::AnyRing any_ring_;
  OnBar on_bar_;
  Dimensions dimensions_;
  std::vector<Cell> generators_;
  TimeList times_;  ///< per operation
  std::uint64_t hidden_ = 0;
  std::uint64_t terms_touched_ = 0;
  std::uint32_t inclusions_ = 0;
  // Per generator b that killed a class: V(b) = scale (b + sum factor V(killer)). R(b) = dV(b) has the youngest term
  // last, coefficient 1.
  std::vector<TermRange> added_;
  std::vector<typename R::Element> scale_;
  Terms<R> terms_;
  std::vector<Addition> additions_;
  std::vector<std::vector<Image>> images_;  ///< per dimension and slot
  std::vector<Terms<R>> corrections_;
  ContractionShifts shifts_;
  sparse::DescendingSum<R> sum_;
  Terms<R> boundary_, column_;
  std::vector<Level> levels_;
  std::vector<Node> nodes_;  ///< per generator: its class, or no_node
};

}  // namespace

std::unique_ptr<CycleTracker> make_cycle_tracker(const sparse::AnyRing& ring, BarcodeTracker::OnBar on_bar,
                                                 Dimensions dimensions) {
  if (const auto* z2 = std::get_if<sparse::Z2>(&ring)) {
    return std::make_unique<Tracker<sparse::Z2>>(*z2, std::move(on_bar), dimensions);
  }
  if (const auto* q = std::get_if<sparse::Rationals>(&ring)) {
    return std::make_unique<Tracker<sparse::Rationals>>(*q, std::move(on_bar), dimensions);
  }
  const auto* zp = std::get_if<sparse::Zp>(&ring);
  sparse::expects(zp != nullptr, "a barcode is taken over a field");
  return std::make_unique<Tracker<sparse::Zp>>(*zp, std::move(on_bar), dimensions);
}

}  // namespace sesame::engine
