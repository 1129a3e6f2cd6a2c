#include "replay/page/generator_history.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "sparse/growing_span.hpp"

namespace sesame::replay {
namespace {

using engine::CellChain;
using ops::CellId;
using sparse::Rational;

/// A chain of nodes that were there as a chain of the object now; degenerate cells are 0. Terms by cell.
CellChain carried(const ops::Structure& structure, const CellChain& chain) {
  std::map<CellId, Rational> terms;
  for (const auto& [coefficient, node] : chain.terms) {
    const ops::OrientedCell now = structure.forest().find_oriented(node);
    if (now.cell != ops::none) {
      terms[now.cell] += now.sign < 0 ? -coefficient : coefficient;
    }
  }
  CellChain sum{chain.degree, {}};
  for (auto& [cell, coefficient] : terms) {
    if (!coefficient.is_zero()) {
      sum.terms.push_back({std::move(coefficient), cell});
    }
  }
  return sum;
}

bool is_consumed(const ops::Structure& structure, const CellChain& chain) {
  return std::ranges::any_of(chain.terms,
                             [&](const auto& term) { return structure.lazy().is_consumed(term.generator); });
}

bool is_removed(const ops::Structure& structure, const CellChain& chain) {
  const ops::Forest& forest = structure.forest();
  return forest.deletions().size() > 0 && std::ranges::any_of(chain.terms, [&](const auto& term) {
           return is_deleted(forest, forest.last_root(term.generator));
         });
}

template <sparse::Ring R>
std::vector<typename R::Element> in_ring(const R& ring, const std::vector<Rational>& numbers) {
  std::vector<typename R::Element> elements;
  for (const Rational& number : numbers) {
    elements.push_back(sparse::from_rational(ring, number));
  }
  return elements;
}

/// How many of the ages, ascending, it takes until the classes of these and of lower ages generate an element of the
/// basis: for each one asked for, the index of an age, or their number when all do not.
template <sparse::Ring R, class News>
std::vector<std::size_t> stages(const R& ring, std::span<const sparse::Integer> orders,
                                const std::map<std::uint32_t, std::vector<const std::vector<Rational>*>>& by_age,
                                const News& asked) {
  const auto multiple = [&](std::size_t k, const sparse::Integer& factor) {
    std::vector<typename R::Element> v(orders.size(), ring.zero());
    v[k] = ring.from(factor);
    return v;
  };
  sparse::GrowingSpan<R> span(ring, orders.size());
  for (std::size_t k = 0; k < orders.size(); ++k) {
    span.add(multiple(k, orders[k]));
  }
  std::vector<std::size_t> found(asked.size(), by_age.size());
  std::size_t stage = 0;
  for (const auto& [age, classes] : by_age) {
    for (const std::vector<Rational>* coefficients : classes) {
      span.add(in_ring(ring, *coefficients));
    }
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (found[k] == by_age.size() && span.contains(multiple(asked[k].index, 1))) {
        found[k] = stage;
      }
    }
    ++stage;
  }
  return found;
}

/// What is too long for a page is given by its length.
void shorten(PageChain& chain, const std::optional<ChainLength>& length) {
  if (length) {
    chain.terms.clear();
    chain.length = length->terms;
    chain.is_length_exact = length->is_exact;
  }
}

/// The terms of a chain, those more with long names that the page has not got elsewhere.
std::uint64_t weight_of(const PageChain& chain) {
  std::uint64_t weight = chain.terms.size();
  for (const PageChain::Term& term : chain.terms) {
    weight += term.name.size() / 16;
  }
  return weight;
}

}  // namespace

void GeneratorHistory::take(engine::Engine& engine, Place place, std::span<const std::uint32_t> undone,
                            const Writer& writer, PageStep& into) {
  if (given_up_) {
    return;
  }
  if (work_ > limits_.work_on_generators || terms_ > limits_.terms_of_history) {
    given_up_ = place.step;
    followed_ = {};
    return;
  }
  forget_undone(undone, into);
  carry_on(engine, place.step, into);
  record(engine, place, writer, nullptr, into);
}

void GeneratorHistory::take_last(engine::Engine& engine, Place place, const Writer& writer,
                                 const std::atomic<bool>* stop, PageStep& into) {
  if (!into.generators) {
    record(engine, place, writer, stop, into);
  }
}

/// Classes whose cycles were written in steps that are taken back end; those that ended there go on.
void GeneratorHistory::forget_undone(std::span<const std::uint32_t> undone, PageStep& into) {
  if (undone.empty()) {
    return;
  }
  const auto is_undone = [&](std::uint32_t step) {
    return std::find(undone.begin(), undone.end(), step) != undone.end();
  };
  for (Followed& each : followed_) {
    if (is_undone(each.recorded) && !each.ended) {
      into.ended.push_back({each.number, ClassEnd::undone});
    }
    if (each.ended && is_undone(*each.ended)) {
      each.ended.reset();
    }
  }
  std::erase_if(followed_, [&](const Followed& each) { return is_undone(each.recorded); });
}

/// How a class that was there ends with this step, if it does; else its coefficients are those now.
std::optional<ClassEnd> GeneratorHistory::end_of(engine::Engine& engine, Followed& each) {
  if (is_consumed(engine.structure(), each.now)) {
    return ClassEnd::consumed;
  }
  if (is_removed(engine.structure(), each.cycle)) {
    return ClassEnd::removed;
  }
  if (each.now.terms.empty()) {
    return ClassEnd::bounds;
  }
  engine::ClassAnswer answer = engine.classify(each.now);
  if (!answer.is_cycle) {
    return ClassEnd::cut;
  }
  if (answer.is_zero) {
    return ClassEnd::bounds;
  }
  each.coefficients = std::move(answer.coefficients);
  work_ += each.coefficients.size();
  return std::nullopt;
}

/// Which classes are still there, and what they are now.
void GeneratorHistory::carry_on(engine::Engine& engine, std::uint32_t step, PageStep& into) {
  for (Followed& each : followed_) {
    if (each.ended) {
      continue;
    }
    each.now = carried(engine.structure(), each.cycle);
    work_ += each.cycle.terms.size() + 1;
    const std::optional<ClassEnd> end = end_of(engine, each);
    if (end) {
      each.ended = step;
      into.ended.push_back({each.number, *end});
    }
  }
}

void GeneratorHistory::record(engine::Engine& engine, Place place, const Writer& writer, const std::atomic<bool>* stop,
                              PageStep& into) {
  into.generators.emplace();
  const engine::Homology homology = engine.homology();
  const std::size_t dimensions = engine.cells().size();
  std::uint64_t terms_left = limits_.terms_of_generators;
  for (std::size_t p = 0; p < dimensions; ++p) {
    std::vector<sparse::Integer> orders = homology.torsion[p];
    orders.resize(orders.size() + static_cast<std::size_t>(homology.betti[p]));
    const std::uint64_t room = limits_.generators / dimensions + 1;
    GeneratorOptions options;
    options.most_terms = std::min(limits_.terms, terms_left);  // a longer one is not even written out
    std::size_t index = 0;
    std::vector<New> added;
    visit_generators(engine, static_cast<int>(p), options, [&](const engine::Generator& generator) {
      if (index >= room || (stop != nullptr && stop->load())) {
        return false;
      }
      work_ += generator.cycle.terms.size() + generator.bounding.terms.size() + 1;
      options.most_terms = std::min(limits_.terms, terms_left);
      PageClass found = written(generator, options, writer);
      const std::uint64_t weight = weight_of(found.cycle) + (found.bounding ? weight_of(*found.bounding) : 0);
      terms_left -= std::min(terms_left, weight);
      const std::optional<std::uint32_t> known = known_class(generator, found);
      into.generators->push_back(known.value_or(static_cast<std::uint32_t>(classes_.size())));
      if (!known) {
        terms_ += weight;
        added.push_back({static_cast<std::uint32_t>(classes_.size()), index});
        follow(generator.cycle, place.state, writer);
        classes_.push_back(std::move(found));
      }
      return ++index < room;
    });
    if (!given_up_) {
      find_ages(engine.ring(), orders, place.step, added);
    }
  }
  last_ = *into.generators;
}

PageClass GeneratorHistory::written(const engine::Generator& generator, const GeneratorOptions& options,
                                    const Writer& writer) {
  PageClass found;
  found.degree = generator.degree;
  found.order = generator.order;
  found.cycle = writer.write(generator.cycle);
  shorten(found.cycle, length_of_cycle(generator, options));
  if (!generator.order.is_zero()) {
    found.bounding = writer.write(generator.bounding);
    shorten(*found.bounding, length_of_bounding(generator, options));
  }
  return found;
}

/// The class that has this very cycle.
std::optional<std::uint32_t> GeneratorHistory::known_class(const engine::Generator& generator,
                                                           const PageClass& found) const {
  for (const Followed& each : followed_) {
    if (!each.ended && each.now == generator.cycle && classes_[each.number].order == found.order) {
      return each.number;
    }
  }
  for (const std::uint32_t number : last_) {  // one that is not followed
    const PageClass& other = classes_[number];
    if (other.degree == found.degree && other.order == found.order && !found.cycle.terms.empty() &&
        other.cycle == found.cycle && other.bounding == found.bounding) {
      return number;
    }
  }
  return std::nullopt;
}

/// Requires: it gets the next number.
void GeneratorHistory::follow(const CellChain& cycle, std::uint32_t state, const Writer& writer) {
  const bool is_written = cycle.terms.size() <= limits_.terms && !cycle.terms.empty();
  if (!given_up_ && is_written &&
      std::ranges::all_of(cycle.terms, [&](const auto& term) { return writer.is_shown(term.generator); })) {
    followed_.push_back({static_cast<std::uint32_t>(classes_.size()), state, cycle, std::nullopt, cycle, {}});
  }
}

/// Of classes that are new as cycles, of one degree: each is as old as those older ones that generate it.
void GeneratorHistory::find_ages(const sparse::AnyRing& ring, std::span<const sparse::Integer> orders,
                                 std::uint32_t step, std::span<const New> added) {
  if (added.empty()) {
    return;
  }
  const int degree = classes_[added.front().number].degree;
  std::map<std::uint32_t, std::vector<const std::vector<Rational>*>> by_age;
  for (const Followed& each : followed_) {
    const PageClass& its = classes_[each.number];
    if (!each.ended && its.degree == degree && its.since && each.coefficients.size() == orders.size()) {
      by_age[*its.since].push_back(&each.coefficients);
      work_ += orders.size() * orders.size();
    }
  }
  const std::vector<std::size_t> found =
      std::visit([&](const auto& k) { return stages(k, orders, by_age, added); }, ring);
  for (std::size_t k = 0; k < added.size(); ++k) {
    auto age = by_age.begin();
    std::advance(age, found[k]);
    classes_[added[k].number].since = age == by_age.end() ? step : age->first;
  }
}

}  // namespace sesame::replay
