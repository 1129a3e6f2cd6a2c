#include "engine/right/known_lifts.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

template <Ring R>
void KnownLifts<R>::add_to(Written& written, const Element& factor, const Terms<R, GeneratorId>& terms) const {
  const Element by = ring_.multiply(factor, ring_.inverse(written.scale));
  for (const TermOfB& term : terms) {
    ring_.add_product(written.more.try_emplace(term.index, ring_.zero()).first->second, by, term.coefficient);
  }
}

/// A version is f times its base plus d; so the base is 1/f times the version, minus d/f.
template <Ring R>
void KnownLifts<R>::move_from(NodeId base, NodeId to) {
  Node& from = nodes_[base];
  Node& next = nodes_[to];
  next.written = std::move(from.written);
  next.written->scale = ring_.multiply(next.written->scale, next.factor);
  add_to(*next.written, ring_.one(), next.difference);
  from.base = to;
  from.factor = ring_.inverse(next.factor);
  from.difference = std::move(next.difference);
  const Element by = ring_.negate(from.factor);
  for (TermOfB& term : from.difference) {
    term.coefficient = ring_.multiply(by, term.coefficient);
  }
  next.base = no_node;
  next.difference.clear();
}

template <Ring R>
typename KnownLifts<R>::Written& KnownLifts<R>::reach_node(NodeId node) {
  std::vector<NodeId> way{node};
  while (nodes_[way.back()].written == nullptr) {
    way.push_back(nodes_[way.back()].base);
  }
  for (; way.size() > 1; way.pop_back()) {
    move_from(way.back(), way[way.size() - 2]);
  }
  return *nodes_[node].written;
}

template <Ring R>
typename R::Element KnownLifts<R>::coefficient(Symbol x, GeneratorId generator) {
  const Written& written = reach(x);
  const TermOfB* term = sparse::find_term<R>(written.terms, generator);
  Element sum = term != nullptr ? term->coefficient : ring_.zero();
  if (const auto more = written.more.find(generator); more != written.more.end()) {
    ring_.add_product(sum, more->second, ring_.one());
  }
  return ring_.multiply(written.scale, sum);
}

template <Ring R>
std::vector<typename KnownLifts<R>::NodeId> KnownLifts<R>::way_from(NodeId node) const {
  constexpr std::size_t a_few = 8;
  std::vector<NodeId> way{node};
  while (way.size() < a_few && nodes_[way.back()].base != no_node) {
    way.push_back(nodes_[way.back()].base);
  }
  return way;
}

template <Ring R>
typename KnownLifts<R>::Relation KnownLifts<R>::along(std::span<const NodeId> way, std::size_t place) const {
  Relation relation{ring_.one(), {}};
  for (std::size_t k = 0; k < place; ++k) {
    const Node& node = nodes_[way[k]];
    sparse::add_multiple<R>(ring_, relation.difference, relation.factor, node.difference);
    relation.factor = ring_.multiply(relation.factor, node.factor);
  }
  return relation;
}

/// By the first node that both ways have; its factors are units.
template <Ring R>
std::optional<typename KnownLifts<R>::Relation> KnownLifts<R>::relation(Symbol x, Symbol y) const {
  const std::vector<NodeId> of_x = way_from(node_of_.at(x)), of_y = way_from(node_of_.at(y));
  const auto common = std::find_first_of(of_x.begin(), of_x.end(), of_y.begin(), of_y.end());
  if (common == of_x.end()) {
    return std::nullopt;
  }
  Relation relation = along(of_x, static_cast<std::size_t>(common - of_x.begin()));
  const auto place = static_cast<std::size_t>(std::find(of_y.begin(), of_y.end(), *common) - of_y.begin());
  const auto [factor, difference] = along(of_y, place);
  relation.factor = ring_.multiply(relation.factor, ring_.inverse(factor));
  sparse::add_multiple<R>(ring_, relation.difference, ring_.negate(relation.factor), difference);
  return relation;
}

/// False when there was none, so that everything is forgotten.
template <Ring R>
bool KnownLifts<R>::make_room(std::size_t terms) {
  const bool has_room = terms_ + terms + terms_of_a_node <= most_terms;
  if (!has_room) {
    clear();
  }
  terms_ += terms + terms_of_a_node;
  return has_room;
}

template <Ring R>
void KnownLifts<R>::keep(Symbol x, Terms<R, GeneratorId> lift) {
  forget(x);
  if (lift.size() <= short_lift || lift.size() > most_terms) {
    return;
  }
  make_room(lift.size());
  node_of_[x] = static_cast<NodeId>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.written = std::make_unique<Written>(Written{ring_.one(), std::move(lift), {}});
  node.factor = ring_.one();
}

template <Ring R>
void KnownLifts<R>::keep(Symbol x, Symbol base, const Element& factor, Terms<R, GeneratorId> difference) {
  if (ring_.is_unit(factor)) {
    keep_version(x, node_of_.at(base), factor, std::move(difference));
  } else {
    sparse::add_multiple<R>(ring_, difference, factor, written_out(base));
    keep(x, std::move(difference));
  }
}

template <Ring R>
void KnownLifts<R>::keep_version(Symbol x, NodeId base, const Element& factor, Terms<R, GeneratorId> difference) {
  if (!make_room(difference.size())) {
    return;
  }
  node_of_[x] = static_cast<NodeId>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.base = base;
  node.factor = factor;
  node.difference = std::move(difference);
}

template <Ring R>
void KnownLifts<R>::add(Symbol x, const Element& factor, Symbol y) {
  const std::size_t size_of_x = reach(x).size();
  const std::size_t size_of_y = reach(y).size();
  if (size_of_y <= size_of_x || !ring_.is_unit(factor)) {
    Terms<R, GeneratorId> other = written_out(y);
    for (TermOfB& term : other) {
      term.coefficient = ring_.multiply(factor, term.coefficient);
    }
    keep_version(x, node_of_.at(x), ring_.one(), std::move(other));
  } else {
    keep_version(x, node_of_.at(y), factor, written_out(x));
  }
}

template <Ring R>
Terms<R, GeneratorId> KnownLifts<R>::written_out(Symbol x) {
  const Written& written = reach(x);
  RawTerms<R, GeneratorId> sum;
  for (const TermOfB& term : written.terms) {
    sum.push_back({term.index, ring_.multiply(written.scale, term.coefficient)});
  }
  for (const auto& [generator, coefficient] : written.more) {
    sum.push_back({generator, ring_.multiply(written.scale, coefficient)});
  }
  return std::move(sum).normal(ring_);
}

template <Ring R>
void KnownLifts<R>::clear() {
  nodes_.clear();
  node_of_.clear();
  terms_ = 0;
}

#define SESAME_INSTANTIATE(R) template class KnownLifts<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine
