#include "engine/live_equivalence.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "reductions/defect.hpp"
#include "reductions/homology.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

using reductions::ChainComplex;
using reductions::GradedMap;
using sparse::expects;
using sparse::Matrix;
using sparse::Term;

namespace {

/// Where each symbol or generator stands within its degree.
struct Numbering {
  std::vector<std::vector<Index>> members;    ///< by degree
  std::unordered_map<Index, Index> position;  ///< within the degree

  void add(int degree, Index id) {
    const auto p = static_cast<std::size_t>(degree);
    if (p >= members.size()) {
      members.resize(p + 1);
    }
    position.emplace(id, static_cast<Index>(members[p].size()));
    members[p].push_back(id);
  }
  [[nodiscard]] std::vector<Index> sizes() const {
    std::vector<Index> sizes;
    for (const auto& degree : members) {
      sizes.push_back(static_cast<Index>(degree.size()));
    }
    return sizes;
  }
};

/// The graded map whose column at each member of `source` is column(member), a chain in members of `target`.
template <Ring R, class Column>
GradedMap<R> graded_map(const R& ring, int degree, const Numbering& source, const Numbering& target, Column column) {
  const std::vector<Index> from = source.sizes();
  const std::vector<Index> to = target.sizes();
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < from.size(); ++p) {
    Matrix<R> part(ring, reductions::size_at(to, static_cast<int>(p) + degree), 0);
    for (const Index member : source.members[p]) {
      Terms<R> terms = column(member);
      for (Term<R>& term : terms) {
        term.index = target.position.at(term.index);
      }
      sparse::normalize(ring, terms);
      part.append_column(terms);
    }
    parts.push_back(std::move(part));
  }
  return GradedMap<R>(ring, degree, from, to, std::move(parts));
}

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
      lazy_{ring, window_, big_, rewriter_},
      position_{window_.start()} {
  big_.set_lazy_maps(lazy_);
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
        lazy_.add_family(run.first);
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
  marks_.push_back({position_, big_.mark(), lazy_.mark(), rewriter_.mark()});
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
  lazy_.truncate(mark.lazy, mark.big.generators);
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
                                       [](Index g, const Mark& mark) { return g < mark.big.generators; });
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

/// The core's columns as a matrix on the rows that occur, in the order in which they do.
template <Ring R>
Matrix<R> LiveEquivalence<R>::core_matrix(const std::vector<Symbol>& columns) const {
  Numbering rows;
  Matrix<R> matrix(ring_, 0, 0);
  for (const Symbol x : columns) {
    Terms<R> terms;
    for (const Term<R>& term : *rewriter_.core().find(x)) {
      if (!rows.position.contains(term.index)) {
        rows.add(0, term.index);
        matrix.append_rows(1);
      }
      terms.push_back({rows.position.at(term.index), term.coefficient});
    }
    sparse::normalize(ring_, terms);
    matrix.append_column(terms);
  }
  return matrix;
}

template <Ring R>
const typename LiveEquivalence<R>::TorsionCache& LiveEquivalence<R>::torsion() {
  const TorsionCore<R>& core = rewriter_.core();
  if (torsion_.filled && torsion_.version == core.version()) {
    return torsion_;
  }
  torsion_ = {core.version(), true, {}, {}};
  std::map<int, std::vector<Symbol>> by_degree;
  for (const auto& [x, column] : core.columns()) {
    by_degree[rewriter_.degree(x)].push_back(x);
  }
  for (const auto& [degree, columns] : by_degree) {
    const auto p = static_cast<std::size_t>(degree);
    const auto factors = sparse::invariant_factors(core_matrix(columns));
    torsion_.ranks.resize(p + 1, 0);
    torsion_.ranks[p] = static_cast<std::uint32_t>(factors.size());
    torsion_.torsion.resize(p);
    for (const auto& factor : factors) {
      if (!ring_.is_unit(factor)) {
        torsion_.torsion[p - 1].push_back(ring_.to_integer(factor));
      }
    }
  }
  return torsion_;
}

template <Ring R>
Homology LiveEquivalence<R>::homology(std::size_t dimensions) {
  const TorsionCache& core = torsion();
  const std::vector<std::uint32_t>& small = rewriter_.small_counts();
  const auto at = [](const auto& counts, std::size_t p) -> std::int64_t { return p < counts.size() ? counts[p] : 0; };
  Homology homology;
  for (std::size_t p = 0; p < dimensions; ++p) {
    homology.betti.push_back(at(small, p) - at(core.ranks, p) - at(core.ranks, p + 1));
    homology.torsion.push_back(p < core.torsion.size() ? core.torsion[p] : std::vector<Integer>{});
    homology.small.push_back(static_cast<std::uint32_t>(at(small, p)));
  }
  homology.big = big_.counts();
  homology.big.resize(std::max(dimensions, homology.big.size()), 0);
  return homology;
}

template <Ring R>
typename LiveEquivalence<R>::Group LiveEquivalence<R>::group(int degree) const {
  const TorsionCore<R>& core = rewriter_.core();
  const auto columns_of = [&](int p) {
    std::vector<Symbol> columns;
    for (const auto& [x, column] : core.columns()) {
      if (rewriter_.degree(x) == p) {
        columns.push_back(x);
      }
    }
    return columns;
  };
  const auto smith_of_nothing = [&] { return sparse::smith_form(Matrix<R>(ring_, 0, 0)); };
  Group group{{}, {}, columns_of(degree), smith_of_nothing(), columns_of(degree + 1), smith_of_nothing()};
  group.kernel = sparse::smith_form(core_matrix(group.lower));
  std::set<Symbol> met;
  for (const Symbol x : group.columns) {
    for (const Term<R>& term : *core.find(x)) {
      met.insert(term.index);
    }
  }
  for (const Symbol x : rewriter_.small(degree)) {
    if (core.find(x) == nullptr) {
      (met.contains(x) ? group.bound : group.free).push_back(x);
    }
  }
  const std::size_t cycles = group.bound.size() + group.lower.size() - group.kernel.factors.size();
  Matrix<R> boundaries(ring_, static_cast<Index>(cycles), 0);
  for (const Symbol x : group.columns) {
    boundaries.append_column(group.coordinates(ring_, *core.find(x)));
  }
  group.smith = sparse::smith_form(boundaries);
  return group;
}

template <Ring R>
Terms<R> LiveEquivalence<R>::Group::in_symbols(const R& ring, const Terms<R>& coordinates) const {
  Terms<R> out;
  const auto rank = static_cast<Index>(kernel.factors.size());
  for (const Term<R>& term : coordinates) {
    if (term.index < bound.size()) {
      out.push_back({bound[term.index], term.coefficient});
      continue;
    }
    const Index column = rank + term.index - static_cast<Index>(bound.size());
    kernel.right.for_each_in_column(column, [&](const Term<R>& part) {
      out.push_back({lower[part.index], ring.multiply(term.coefficient, part.coefficient)});
    });
  }
  sparse::normalize(ring, out);
  return out;
}

template <Ring R>
Terms<R> LiveEquivalence<R>::Group::coordinates(const R& ring, const Terms<R>& cycle) const {
  const auto position = [](const std::vector<Symbol>& symbols, Symbol x) -> std::optional<Index> {
    const auto at = std::lower_bound(symbols.begin(), symbols.end(), x);
    return at != symbols.end() && *at == x ? std::optional{static_cast<Index>(at - symbols.begin())} : std::nullopt;
  };
  Terms<R> out;
  Terms<R> on_lower;
  for (const Term<R>& term : cycle) {
    if (const auto at = position(bound, term.index)) {
      out.push_back({*at, term.coefficient});
    } else {
      const auto row = position(lower, term.index);
      expects(row.has_value(), "a cycle is made of the small generators of its degree");
      on_lower.push_back({*row, term.coefficient});
    }
  }
  const auto rank = static_cast<Index>(kernel.factors.size());
  for (const Term<R>& term : kernel.right_inverse.apply(on_lower)) {
    expects(term.index >= rank, "the image of a cycle is a cycle of the small complex");
    out.push_back({static_cast<Index>(bound.size()) + term.index - rank, term.coefficient});
  }
  sparse::normalize(ring, out);
  return out;
}

template <Ring R>
void LiveEquivalence<R>::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) {
  const Group h = group(degree);
  const auto in_columns = [&h](Terms<R> terms) {
    for (Term<R>& term : terms) {
      term.index = h.columns[term.index];
    }
    return terms;
  };
  const auto write_out = [&](int p, const Terms<R>& chain_of_s, CellChain& chain, std::uint64_t& terms) {
    const Terms<R> lift = rewriter_.lift(chain_of_s);
    terms = most_terms == uncountable ? 0 : big_.terms_of_f(lift);
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
  const Group h = group(chain.degree);
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
    big_.add_g(cell, in_own_orientation(cell, coefficient), out);
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
  return to_chain(degree, big_.f(chain_of_b));
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
  Terms<R> cells = big_.f(rewriter_.lift(chain_of_s, trace));
  for (const auto& [coefficient, cell] : z.terms) {
    lazy_.add_K_of_lazy_part(cell, in_own_orientation(cell, coefficient), cells);
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

// ---------------------------------------------------------------------------------------------------- matrices, laws

template <Ring R>
reductions::Equivalence<R> LiveEquivalence<R>::matrices() {
  expects(window_.families() == 0, "the big complex of lazy cells is not written out");
  const ops::CellBasis basis = ops::cells_at(structure_, ops::now(structure_));
  Numbering object;
  for (std::size_t p = 0; p < basis.cells().size(); ++p) {
    for (const CellId cell : basis.cells()[p]) {
      object.add(static_cast<int>(p), cell);
    }
  }
  Numbering big;
  for (Index b = 0; b < big_.size(); ++b) {
    big.add(big_.degree(b), b);
  }
  Numbering small;
  for (int p = 0; p < static_cast<int>(rewriter_.small_counts().size()); ++p) {
    for (const Symbol x : rewriter_.small(p)) {
      small.add(p, x);
    }
  }
  const ChainComplex<R> c = ops::chain_complex(structure_, basis, ops::now(structure_), ring_);
  const ChainComplex<R> b =
      reductions::complex_with(graded_map(ring_, -1, big, big, [&](Index x) { return big_.boundary().column(x); }));
  const ChainComplex<R> s = reductions::complex_with(
      graded_map(ring_, -1, small, small, [&](Index x) { return core_boundary(unit(ring_, x)); }));
  const auto f = [&](Index x) { return big_.f(unit(ring_, x)); };
  const auto g = [&](Index cell) {
    Terms<R> out;
    big_.add_g(cell, ring_.one(), out);
    return out;
  };
  return {
      {b, c, graded_map(ring_, 0, big, object, f), graded_map(ring_, 0, object, big, g),
       graded_map(ring_, 1, big, big, [&](Index x) { return big_.h(x); })},
      {b, s, graded_map(ring_, 0, big, small, [&](Index x) { return rewriter_.rewrite(unit(ring_, x)); }),
       graded_map(ring_, 0, small, big, [&](Index x) { return rewriter_.lift(unit(ring_, x)); }),
       graded_map(ring_, 1, big, big, [&](Index x) { return rewriter_.lift({}, rewriter_.trace(unit(ring_, x))); })}};
}

template <Ring R>
std::optional<std::string> LiveEquivalence<R>::defect_of_matrices() {
  if (const auto defect = reductions::first_defect(matrices())) {
    return "the equivalence: " + defect->to_string();
  }
  return std::nullopt;
}

/// The laws of F, G and K, cell by cell and generator by generator: of the equivalence as it is seen from outside.
template <Ring R>
std::optional<std::string> LiveEquivalence<R>::defect_of_maps(const ops::CellBasis& cells) {
  const auto minus = [](CellChain a, const CellChain& b) {
    for (const CellChain::Term& term : b.terms) {
      a.terms.push_back({-term.coefficient, term.cell});
    }
    return a;
  };
  const auto is_zero = [&](const CellChain& chain) {
    Terms<R> sum;
    for (const auto& [coefficient, cell] : chain.terms) {
      sum.push_back({cell, from_rational(ring_, coefficient)});
    }
    sparse::normalize(ring_, sum);
    return sum.empty();
  };
  for (std::size_t p = 0; p < cells.cells().size(); ++p) {
    const int degree = static_cast<int>(p);
    for (const CellId cell : cells.cells()[p]) {
      const CellChain c{degree, {{1, cell}}};
      const CellChain dc = boundary(c);
      if (!boundary(dc).terms.empty()) {
        return "d d is not 0 on " + std::string{structure_.name(cell)};
      }
      const SmallChain image = apply_F(c);
      if (!(p == 0 ? boundary(image).terms.empty() : apply_F(dc) == boundary(image))) {
        return "F does not obey d on " + std::string{structure_.name(cell)};
      }
      // d K + K d + G F - 1
      CellChain sum = minus(boundary(apply_K(c)), c);
      for (const CellChain& more : {p == 0 ? CellChain{} : apply_K(dc), apply_G(image)}) {
        sum.terms.insert(sum.terms.end(), more.terms.begin(), more.terms.end());
      }
      if (!is_zero(sum)) {
        return "d K + K d is not 1 - G F on " + std::string{structure_.name(cell)};
      }
    }
  }
  for (int p = 0; p < static_cast<int>(rewriter_.small_counts().size()); ++p) {
    const std::size_t size = rewriter_.small(p).size();
    for (std::uint32_t k = 0; k < size; ++k) {
      const SmallChain x{p, {{1, k}}};
      if (!is_zero(minus(boundary(apply_G(x)), apply_G(boundary(x))))) {
        return "G does not obey d on generator " + std::to_string(k) + " of S_" + std::to_string(p);
      }
    }
  }
  return std::nullopt;
}

template <Ring R>
std::optional<std::string> LiveEquivalence<R>::first_defect(ops::StepKind last_step, ops::Moment before_it) {
  constexpr std::uint64_t most = 1'000'000;
  const auto counts = structure_.counts();
  if (const auto cells = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
      structure_.families() > 0 && cells > most) {
    return "the object has " + std::to_string(cells) + " cells, most of them never written out: laws are checked on " +
           "objects of up to " + std::to_string(most) + " when there are products or large cones";
  }
  const ops::Moment present = ops::now(structure_);
  if (const auto step = ops::step_sequence(structure_, last_step, before_it, present, ring_)) {
    if (const auto defect = reductions::first_defect(step->sequence)) {
      return "the step's exact sequence: " + defect->to_string();
    }
  }
  const ops::CellBasis cells = ops::cells_at(structure_, present);
  if (auto defect = ops::first_broken_face_law(structure_, cells)) {
    return defect;
  }
  if (auto defect = window_.families() == 0 ? defect_of_matrices() : defect_of_maps(cells)) {
    return defect;
  }
  const std::vector<reductions::AbelianGroup> groups =
      reductions::homology_groups(ops::chain_complex(structure_, cells, present, ring_));
  const Homology live = homology(groups.size());
  for (std::size_t p = 0; p < live.betti.size(); ++p) {
    const reductions::AbelianGroup scratch = p < groups.size() ? groups[p] : reductions::AbelianGroup{};
    const reductions::AbelianGroup found{static_cast<Index>(live.betti[p]), live.torsion[p]};
    if (!(scratch == found)) {
      return "H_" + std::to_string(p) + " is " + found.to_string() + " here, but " + scratch.to_string() +
             " by a Smith form from scratch";
    }
    const std::vector<Generator> basis = generators(static_cast<int>(p));
    if (basis.size() != scratch.rank + scratch.torsion.size()) {
      return "H_" + std::to_string(p) + " has " + std::to_string(basis.size()) + " generators for " +
             scratch.to_string();
    }
    for (std::size_t k = 0; k < basis.size(); ++k) {
      const ClassAnswer own = classify(basis[k].cycle);
      for (std::size_t m = 0; m < own.coefficients.size(); ++m) {
        if (!(own.coefficients[m] == Integer(m == k ? 1 : 0))) {
          return "generator " + std::to_string(k) + " of H_" + std::to_string(p) + " is not the class of itself";
        }
      }
      CellChain multiple = basis[k].cycle;
      for (CellChain::Term& term : multiple.terms) {
        term.coefficient *= basis[k].order;
      }
      if (!basis[k].order.is_zero() && !(boundary(basis[k].bounding) == multiple)) {
        return "generator " + std::to_string(k) + " of H_" + std::to_string(p) + ": its order times it is not bounded";
      }
    }
  }
  return std::nullopt;
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
