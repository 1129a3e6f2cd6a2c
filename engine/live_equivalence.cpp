#include "engine/live_equivalence.hpp"

#include <algorithm>
#include <utility>

#include "engine/audit.hpp"
#include "engine/left/new_family.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;
using sparse::Matrix;
using sparse::Term;

namespace {

/// The cells of the object by dimension and age, lazy ones written out.
std::vector<CellId> cells_of_object(const Structure& structure) {
  structure.make_all_lazy_cells();
  const ops::CellBasis basis = ops::cells_at(structure, ops::now(structure));
  std::vector<CellId> cells;
  for (const std::vector<CellId>& of_degree : basis.cells()) {
    cells.insert(cells.end(), of_degree.begin(), of_degree.end());
  }
  return cells;
}

template <Ring R>
Terms<R> unit(const R& ring, Index index) {
  return {{index, ring.one()}};
}

}  // namespace

template <Ring R>
LiveEquivalence<R>::LiveEquivalence(R ring, Window window)
    : ring_{ring},
      window_{std::move(window)},
      structure_{window_.structure()},
      big_{ring, window_},
      rewriter_{ring, big_.boundary()},
      groups_{ring, rewriter_},
      frozen_{ring, big_, rewriter_},
      position_{window_.start()} {
  for (Index generator = 0; generator < big_.size(); ++generator) {
    rewriter_.append(big_.degree(generator));
  }
  take_in_step();
}

template <Ring R>
std::unique_ptr<HomologyTracker> LiveEquivalence<R>::afresh() const {
  return std::make_unique<LiveEquivalence>(ring_, Window{structure_, current_cells()});
}

// ------------------------------------------------------------------------------------------------------- maintenance

/// The cells of the object, by dimension and age.
template <Ring R>
std::vector<CellId> LiveEquivalence<R>::current_cells() const {
  if (structure_.families() > 0) {
    return cells_of_object(structure_);
  }
  std::vector<CellId> cells;
  // Not all that were ever made: those that the window began with and those made in it.
  const auto add = [&](CellId c) {
    if (structure_.is_current(c)) {
      cells.push_back(c);
    }
  };
  std::for_each(window_.cells().begin(), window_.cells().end(), add);
  for (CellId c = window_.begin().created; c < structure_.created(); ++c) {
    add(c);
  }
  std::sort(cells.begin(), cells.end(), [this](CellId a, CellId b) {
    return std::pair{structure_.dimension(a), structure_.oldest(a)} <
           std::pair{structure_.dimension(b), structure_.oldest(b)};
  });
  return cells;
}

template <Ring R>
bool LiveEquivalence<R>::extend(std::uint64_t budget) {
  rewriter_.set_budget(window_.has_splits() ? budget : unlimited);
  try {
    take_in_step();
  } catch (const OverBudget&) {
    rewriter_.drop_work();
    rewriter_.set_budget(unlimited);
    go_back_to(marks_.back());
    return false;
  }
  rewriter_.set_budget(unlimited);
  return true;
}

/// Reads the journal from where it has come to.
template <Ring R>
void LiveEquivalence<R>::take_in_step() {
  const RuleId time = rewriter_.rules();
  Index first_copy = ops::none;
  std::uint32_t first_move = ops::none, last_move = ops::none;
  const auto take_in = [&](const ops::Journal::Run& run) {
    switch (run.kind) {
      case ops::EventKind::cell:
      case ops::EventKind::degenerate:
      case ops::EventKind::lazy:
        for (CellId c = run.first; c < run.first + run.count; ++c) {
          if (const auto generator = big_.append_cell(c)) {
            rewriter_.append(big_.degree(*generator));
          }
        }
        break;
      case ops::EventKind::copy:
        for (CellId c = run.first; c < run.first + run.count; ++c) {
          const Index copy = big_.append_copy(c);
          first_copy = std::min(first_copy, copy);
          rewriter_.append(big_.degree(copy));
        }
        break;
      case ops::EventKind::move:  // looking at a face may have made nodes between two of them
        first_move = std::min(first_move, run.first);
        last_move = run.first + run.count - 1;
        break;
      case ops::EventKind::family:
        append_family(run.first, structure_, frozen_, big_, rewriter_);
        break;
      case ops::EventKind::removal:
        for (LinkId link = run.first; link < run.first + run.count; ++link) {
          rewriter_.append(big_.degree(big_.append_removal(link)));
        }
        break;
      default:  // nothing that homology knows of
        break;
    }
  };
  const ops::Journal& journal = structure_.journal();
  while (position_ < journal.end()) {  // looking at cells may make others
    const ops::Journal::Position begin = std::exchange(position_, journal.end());
    journal.for_each_since(begin, take_in);
  }
  if (first_move != ops::none) {
    expects(first_copy != ops::none, "incidences move to copies made in the same step");
    const std::vector<Index> changed =
        big_.split(first_copy, structure_.splits().moves().subspan(first_move, last_move - first_move + 1));
    if (!changed.empty()) {
      rewriter_.perturb(time, first_copy, changed);
    }
  }
}

template <Ring R>
void LiveEquivalence<R>::push_mark() {
  marks_.push_back({position_, big_.mark(), frozen_.mark(), rewriter_.mark()});
}

template <Ring R>
void LiveEquivalence<R>::undo_to_mark() {
  go_back_to(marks_.back());
  marks_.pop_back();
}

template <Ring R>
void LiveEquivalence<R>::go_back_to(const Mark& mark) {
  rewriter_.undo(mark.rewriter);
  big_.truncate(mark.big);
  frozen_.truncate(mark.frozen);
  position_ = mark.position;
}

template <Ring R>
std::uint64_t LiveEquivalence<R>::small_of(ops::BodyId body) const {
  std::uint64_t count = 0;
  for (int p = 0; p < static_cast<int>(rewriter_.small_counts().size()); ++p) {
    for (const Symbol x : rewriter_.small(p)) {
      count += big_.body_of(rewriter_.generator_in(x)) == body ? 1 : 0;
    }
  }
  return count;
}

template <Ring R>
std::vector<Lifetime> LiveEquivalence<R>::lifetimes() const {
  expects(R::is_field, "classes live and die over fields");
  const auto step_of = [this](Index generator) {
    const auto next = std::upper_bound(marks_.begin(), marks_.end(), generator,
                                       [](Index g, const Mark& mark) { return g < mark.big.size(); });
    return static_cast<std::size_t>(next - marks_.begin()) - 1;
  };
  std::vector<Lifetime> lifetimes;
  rewriter_.for_each_pair([&](Index a, Index b) { lifetimes.push_back({big_.degree(a), step_of(a), step_of(b)}); });
  for (int p = 0; p < static_cast<int>(rewriter_.small_counts().size()); ++p) {
    for (const Symbol x : rewriter_.small(p)) {
      lifetimes.push_back({p, step_of(rewriter_.generator_in(x)), Lifetime::never});
    }
  }
  return lifetimes;
}

// ------------------------------------------------------------------------------------------------------------ groups

template <Ring R>
Homology LiveEquivalence<R>::homology(std::size_t dimensions) {
  const typename Groups<R>::Torsion& core = groups_.torsion();
  const std::vector<std::uint32_t>& small = rewriter_.small_counts();
  const auto at = [](const auto& counts, std::size_t p) -> std::int64_t { return p < counts.size() ? counts[p] : 0; };
  Homology homology;
  for (std::size_t p = 0; p < dimensions; ++p) {
    homology.betti.push_back(at(small, p) - at(core.ranks, p) - at(core.ranks, p + 1));
    homology.torsion.push_back(p < core.coefficients.size() ? core.coefficients[p] : std::vector<Integer>{});
    homology.small.push_back(static_cast<std::uint32_t>(at(small, p)));
  }
  homology.big = big_.counts();
  homology.big.resize(std::max(dimensions, homology.big.size()), 0);
  return homology;
}

template <Ring R>
void LiveEquivalence<R>::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
  const Group<R> h = groups_.of(degree);
  const auto in_columns = [&h](Terms<R> terms) {
    for (Term<R>& term : terms) {
      term.index = h.columns[term.index];
    }
    return terms;
  };
  const auto write_out = [&](int p, const Terms<R>& chain_of_s, CellChain& chain, std::uint64_t& terms) {
    const Terms<R> lift = rewriter_.lift(chain_of_s);
    terms = most_terms == uncountable ? 0 : big_.maps().terms_of_f(lift);
    if (terms > most_terms) {
      chain.degree = p;
    } else {
      terms = 0;
      chain = to_cells(p, lift);
    }
  };
  for (Index k = 0; k < h.cycles(); ++k) {
    const bool has_order = k < h.smith.factors.size();
    if (has_order && ring_.is_unit(h.smith.factors[k])) {
      continue;
    }
    Generator generator;
    generator.degree = degree;
    write_out(degree, h.in_symbols(ring_, h.smith.left_inverse.column(k)), generator.cycle, generator.terms_of_cycle);
    if (has_order) {
      generator.order = ring_.to_integer(h.smith.factors[k]);
      write_out(degree + 1, in_columns(h.smith.right.column(k)), generator.bounding, generator.terms_of_bounding);
    }
    if (!visit(std::move(generator))) {
      return;
    }
  }
  for (const Symbol x : h.free) {
    Generator generator;
    generator.degree = degree;
    write_out(degree, unit(ring_, x), generator.cycle, generator.terms_of_cycle);
    if (!visit(std::move(generator))) {
      return;
    }
  }
}

template <Ring R>
ClassAnswer LiveEquivalence<R>::classify(const CellChain& chain) {
  ClassAnswer answer;
  if (!boundary(chain).terms.empty()) {
    return answer;
  }
  answer.is_cycle = true;
  const Terms<R> z = g(chain);
  const Terms<R> image = rewriter_.rewrite(z);
  const Group<R> h = groups_.of(chain.degree);
  // 1. The coordinates of F z: on the basis of the Smith form for what meets the core, on the free generators else.
  Terms<R> in_core;
  std::vector<Rational> on_free(h.free.size());
  for (const Term<R>& term : image) {
    const auto at = std::lower_bound(h.free.begin(), h.free.end(), term.index);
    if (at != h.free.end() && *at == term.index) {
      on_free[static_cast<std::size_t>(at - h.free.begin())] = to_rational(ring_, term.coefficient);
    } else {
      in_core.push_back(term);
    }
  }
  std::vector<typename R::Element> dense(h.cycles(), ring_.zero());
  for (const Term<R>& term : h.smith.left.apply(h.coordinates(ring_, in_core))) {
    dense[term.index] = term.coefficient;
  }
  // 2. What is left of them modulo the orders, and the chain y of S with d y = the rest.
  Terms<R> preimage;
  for (std::size_t k = 0; k < dense.size(); ++k) {
    if (k >= h.smith.factors.size()) {
      answer.coefficients.push_back(to_rational(ring_, dense[k]));
      continue;
    }
    const auto& order = h.smith.factors[k];
    const auto quotient = ring_.quotient(dense[k], order);
    sparse::add_multiple<R>(ring_, preimage, quotient, h.smith.right.column(static_cast<Index>(k)));
    if (!ring_.is_unit(order)) {
      answer.coefficients.push_back(ring_.to_integer(ring_.subtract(dense[k], ring_.multiply(quotient, order))));
    }
  }
  answer.coefficients.insert(answer.coefficients.end(), on_free.begin(), on_free.end());
  answer.is_zero = std::all_of(answer.coefficients.begin(), answer.coefficients.end(),
                               [](const Rational& a) { return a.is_zero(); });
  // 3. z = d(G y + K z).
  if (answer.is_zero) {
    for (Term<R>& term : preimage) {
      term.index = h.columns[term.index];
    }
    answer.bounds = bounding(chain, preimage, rewriter_.trace(z));
  }
  return answer;
}

// -------------------------------------------------------------------------------------------------------------- maps

template <Ring R>
Terms<R> LiveEquivalence<R>::g(const CellChain& chain) const {
  Terms<R> out;
  for (const auto& [coefficient, cell] : chain.terms) {
    expects(structure_.is_current(cell) && !structure_.is_consumed(cell) && structure_.dimension(cell) == chain.degree,
            "a chain is made of current cells of its degree");
    big_.maps().add_g(cell, in_own_orientation(cell, coefficient), out);
  }
  sparse::normalize(ring_, out);
  return out;
}

/// The coefficient of a current cell as it is oriented itself, where it is given as its canonical name says.
template <Ring R>
typename R::Element LiveEquivalence<R>::in_own_orientation(CellId cell, const Rational& coefficient) const {
  return from_rational(ring_, structure_.sign_of_name(cell) > 0 ? coefficient : -coefficient);
}

template <Ring R>
CellChain LiveEquivalence<R>::to_cells(int degree, const Terms<R>& chain_of_b) const {
  return to_chain(degree, big_.maps().f(chain_of_b));
}

template <Ring R>
CellChain LiveEquivalence<R>::to_chain(int degree, const Terms<R>& cells) const {
  CellChain chain{degree, {}};
  for (const Term<R>& term : cells) {
    const bool agrees = structure_.sign_of_name(CellId{term.index}) > 0;
    chain.terms.push_back({to_rational(ring_, agrees ? term.coefficient : ring_.negate(term.coefficient)), term.index});
  }
  std::sort(chain.terms.begin(), chain.terms.end(), [this](const CellChain::Term& a, const CellChain::Term& b) {
    return structure_.is_older(structure_.oldest(a.cell), structure_.oldest(b.cell));
  });
  return chain;
}

template <Ring R>
SmallChain LiveEquivalence<R>::to_small(int degree, const Terms<R>& chain_of_s) const {
  SmallChain out{degree, {}};
  if (chain_of_s.empty()) {
    return out;
  }
  const std::vector<Symbol> symbols = rewriter_.small(degree);  // oldest first: increasing
  for (const Term<R>& term : chain_of_s) {
    const auto at = std::lower_bound(symbols.begin(), symbols.end(), term.index);
    out.terms.push_back({to_rational(ring_, term.coefficient), static_cast<std::uint32_t>(at - symbols.begin())});
  }
  return out;
}

template <Ring R>
Terms<R> LiveEquivalence<R>::to_symbols(const SmallChain& chain) const {
  const std::vector<Symbol> symbols = rewriter_.small(chain.degree);
  Terms<R> out;
  for (const auto& [coefficient, generator] : chain.terms) {
    expects(generator < symbols.size(), "a chain of the small complex is made of its generators");
    out.push_back({symbols[generator], from_rational(ring_, coefficient)});
  }
  sparse::normalize(ring_, out);
  return out;
}

template <Ring R>
SmallChain LiveEquivalence<R>::apply_F(const CellChain& chain) {
  return to_small(chain.degree, rewriter_.rewrite(g(chain)));
}

template <Ring R>
CellChain LiveEquivalence<R>::apply_G(const SmallChain& chain) {
  return to_cells(chain.degree, rewriter_.lift(to_symbols(chain)));
}

template <Ring R>
CellChain LiveEquivalence<R>::apply_K(const CellChain& chain) {
  return bounding(chain, {}, rewriter_.trace(g(chain)));
}

template <Ring R>
CellChain LiveEquivalence<R>::bounding(const CellChain& z, const Terms<R>& chain_of_s, const Trace<R>& trace) {
  Terms<R> cells = big_.maps().f(rewriter_.lift(chain_of_s, trace));
  for (const auto& [coefficient, cell] : z.terms) {
    big_.maps().add_K_of_lazy_part(cell, in_own_orientation(cell, coefficient), cells);
  }
  sparse::normalize(ring_, cells);
  return to_chain(z.degree + 1, cells);
}

template <Ring R>
CellChain LiveEquivalence<R>::boundary(const CellChain& chain) const {
  Terms<R> out;
  for (const auto& [coefficient, cell] : chain.terms) {
    const auto faces = structure_.faces(cell);
    const auto element = in_own_orientation(cell, coefficient);
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      if (const auto [face, sign] = structure_.find_oriented(faces[k]); face != ops::none) {
        out.push_back({face, sign * structure_.sign_of_face(cell, k) > 0 ? element : ring_.negate(element)});
      }
    }
  }
  sparse::normalize(ring_, out);
  return to_chain(chain.degree - 1, out);
}

template <Ring R>
Terms<R> LiveEquivalence<R>::core_boundary(std::span<const Term<R>> chain_of_s) const {
  Terms<R> out;
  for (const Term<R>& term : chain_of_s) {
    if (const Terms<R>* column = rewriter_.core().find(term.index)) {
      sparse::add_multiple<R>(ring_, out, term.coefficient, *column);
    }
  }
  return out;
}

template <Ring R>
SmallChain LiveEquivalence<R>::boundary(const SmallChain& chain) {
  return to_small(chain.degree - 1, core_boundary(to_symbols(chain)));
}

template <Ring R>
std::optional<std::string> LiveEquivalence<R>::first_defect(ops::StepKind last_step, ops::Moment before_it) {
  return engine::first_defect(*this, last_step, before_it);
}

template <Ring R>
reductions::Equivalence<R> LiveEquivalence<R>::matrices() {
  return matrices_of(*this);
}

namespace {

std::unique_ptr<HomologyTracker> make_tracker_of(const sparse::AnyRing& ring, Window window) {
  return std::visit(
      [&]<class R>(const R& k) -> std::unique_ptr<HomologyTracker> {
        return std::make_unique<LiveEquivalence<R>>(k, std::move(window));
      },
      ring);
}

}  // namespace

std::unique_ptr<HomologyTracker> make_tracker(const sparse::AnyRing& ring, const Structure& structure) {
  return make_tracker_of(ring, Window{structure});
}

std::unique_ptr<HomologyTracker> make_tracker_afresh(const sparse::AnyRing& ring, const Structure& structure) {
  return make_tracker_of(ring, Window{structure, cells_of_object(structure)});
}

#define SESAME_INSTANTIATE(R) template class LiveEquivalence<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
