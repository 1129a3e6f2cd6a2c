#include "engine/towers/class_space.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;

template <Ring R>
typename R::Element ClassSpace<R>::coefficient(const TermType& term) const {
  if constexpr (has_inline_terms) {
    return ring_.one();
  } else {
    return term.coefficient;
  }
}

template <Ring R>
ClassTerm<R> ClassSpace<R>::term(Node node, [[maybe_unused]] Element coefficient) const {
  if constexpr (has_inline_terms) {
    return {node};
  } else {
    return {node, coefficient};
  }
}

template <Ring R>
std::span<const ClassTerm<R>> ClassSpace<R>::terms(const Record& record) const {
  if constexpr (has_inline_terms) {
    if (record.size == 1) {
      return {&record.at, 1};
    }
  }
  return {pool_.data() + record.at.node, record.size};
}

template <Ring R>
void ClassSpace<R>::store(Record& record, std::span<const TermType> terms) {
  const bool was_in_pool = record.size != alive_mark && !(has_inline_terms && record.size == 1);
  const std::size_t room = was_in_pool ? record.size : 0;
  const auto size = static_cast<std::uint32_t>(terms.size());
  garbage_ += room;
  record.size = size;
  if (size == 0) {
    record.at = {0};  // a place that is in the pool, however little is there
    return;
  }
  if constexpr (has_inline_terms) {
    if (size == 1) {
      record.at = terms[0];
      return;
    }
  }
  if (size <= room) {
    std::copy(terms.begin(), terms.end(), pool_.begin() + record.at.node);
    garbage_ -= size;
  } else {
    expects(pool_.size() + size < UINT32_MAX, "fewer than 2^32 terms of classes are held");
    record.at = {static_cast<std::uint32_t>(pool_.size())};
    pool_.insert(pool_.end(), terms.begin(), terms.end());
  }
}

template <Ring R>
typename ClassSpace<R>::Node ClassSpace<R>::add(Time birth) {
  expects(nodes_.size() < ClassRef::most_nodes, "fewer than 2^31 classes are held");
  nodes_.push_back({{0}, alive_mark});
  births_.push_back(birth);
  ++alive_;
  return static_cast<Node>(nodes_.size() - 1);
}

// ---- sums

/// into += factor * terms, both by descending node.
template <Ring R>
void ClassSpace<R>::add_multiple(std::vector<TermType>& into, [[maybe_unused]] const Element& factor,
                                 std::span<const TermType> terms) {
  terms_touched_ += into.size() + terms.size();
  scratch_.resize(into.size() + terms.size());
  TermType* out = scratch_.data();
  const TermType* x = into.data();
  const TermType* const x_end = x + into.size();
  const TermType* y = terms.data();
  const TermType* const y_end = y + terms.size();
  while (x != x_end && y != y_end) {
    if constexpr (has_inline_terms) {  // without branches, which would be mispredicted every other time
      const Node from_x = x->node;
      const Node from_y = y->node;
      const auto takes_x = static_cast<std::uint32_t>(from_x >= from_y);
      const auto takes_y = static_cast<std::uint32_t>(from_y >= from_x);
      *out = {from_y ^ ((from_x ^ from_y) & (0U - takes_x))};
      out += takes_x ^ takes_y;
      x += takes_x;
      y += takes_y;
    } else if (x->node > y->node) {
      *out++ = *x++;
    } else if (x->node < y->node) {
      *out++ = term(y->node, ring_.multiply(factor, coefficient(*y)));
      ++y;
    } else {
      Element value = x->coefficient;
      ring_.add_product(value, factor, y->coefficient);
      if (!ring_.is_zero(value)) {
        *out++ = term(x->node, value);
      }
      ++x;
      ++y;
    }
  }
  out = std::copy(x, x_end, out);
  for (; y != y_end; ++y) {
    *out++ = term(y->node, ring_.multiply(factor, coefficient(*y)));
  }
  scratch_.resize(static_cast<std::size_t>(out - scratch_.data()));
  into.swap(scratch_);
}

template <Ring R>
void ClassSpace<R>::add_alive(Node node, bool is_negative) {
  ++terms_touched_;
  const Element one = is_negative ? ring_.negate(ring_.one()) : ring_.one();
  sum_.push_back(term(node, one));
  std::size_t at = sum_.size() - 1;
  for (; at > 0 && sum_[at - 1].node < node; --at) {
    sum_[at] = sum_[at - 1];
  }
  sum_[at] = term(node, one);
  if (at == 0 || sum_[at - 1].node != node) {
    return;
  }
  const auto where = sum_.begin() + static_cast<std::ptrdiff_t>(at);
  if constexpr (has_inline_terms) {
    sum_.erase(where - 1, where + 1);
  } else {
    const Element total = ring_.add(sum_[at - 1].coefficient, one);
    sum_[at - 1].coefficient = total;
    sum_.erase(ring_.is_zero(total) ? where - 1 : where, where + 1);
  }
}

template <Ring R>
void ClassSpace<R>::add_to_sum(Node node, bool is_negative) {
  if (is_alive(node)) {
    add_alive(node, is_negative);
    return;
  }
  refresh(node);
  const std::span<const TermType> value = terms(nodes_[node]);
  if (sum_.empty() && !is_negative) {
    sum_.assign(value.begin(), value.end());
  } else if (!value.empty()) {
    add_multiple(sum_, is_negative ? ring_.negate(ring_.one()) : ring_.one(), value);
  }
}

template <Ring R>
typename ClassSpace<R>::Node ClassSpace<R>::kill_sum() {
  expects(!sum_.empty(), "a class that is 0 cannot be made 0");
  if constexpr (!R::is_field) {
    const auto youngest_unit =
        std::ranges::find_if(sum_, [this](const TermType& each) { return ring_.is_unit(each.coefficient); });
    const bool is_mild = sum_.size() <= 2 || std::ranges::all_of(sum_, [](const TermType& each) {
                           return each.coefficient <= largest_of_mild_sum && each.coefficient >= -largest_of_mild_sum;
                         });
    if (youngest_unit == sum_.end() || !is_mild) {
      return no_node;
    }
    std::rotate(sum_.begin(), youngest_unit, youngest_unit + 1);  // the others stay in order
  }
  const Node youngest = sum_.front().node;
  if constexpr (!has_inline_terms) {
    const Element factor = ring_.negate(ring_.inverse(sum_.front().coefficient));
    for (TermType& each : sum_) {
      each.coefficient = ring_.multiply(factor, each.coefficient);
    }
  }
  store(nodes_[youngest], std::span<const TermType>{sum_}.subspan(1));
  --alive_;
  // Compaction walks the nodes and the pool, so it waits until there is that much to gain.
  if (garbage_ > pool_.size() / 2 && garbage_ > nodes_.size() / 4 + (std::size_t{1} << 15)) {
    compact_pool();
  }
  return youngest;
}

template <Ring R>
typename ClassSpace<R>::Node ClassSpace<R>::keep_sum() {
  expects(!sum_.empty(), "a class that is 0 needs no node");
  expects(nodes_.size() < ClassRef::most_nodes, "fewer than 2^31 classes are held");
  nodes_.push_back({{0}, alive_mark});
  births_.push_back(0);
  store(nodes_.back(), sum_);
  return static_cast<Node>(nodes_.size() - 1);
}

// ---- bringing up to date

template <Ring R>
bool ClassSpace<R>::is_fresh(Node node) const {
  return std::ranges::all_of(terms(nodes_[node]), [&](const TermType& each) { return is_alive(each.node); });
}

template <Ring R>
void ClassSpace<R>::refresh(Node node) {
  if (is_fresh(node)) {
    return;
  }
  pending_.assign(1, node);
  while (!pending_.empty()) {
    const Node top = pending_.back();
    for (const TermType& each : terms(nodes_[top])) {
      if (!is_alive(each.node) && !is_fresh(each.node)) {
        pending_.push_back(each.node);
      }
    }
    if (pending_.back() == top) {
      pending_.pop_back();
      rewrite(top);
    }
  }
}

/// Replaces the dead nodes in a node's sum. Requires: their own sums are fresh.
template <Ring R>
void ClassSpace<R>::rewrite(Node node) {
  const std::span<const TermType> old = terms(nodes_[node]);
  terms_touched_ += old.size();
  rewritten_.clear();
  std::ranges::copy_if(old, std::back_inserter(rewritten_), [&](const TermType& each) { return is_alive(each.node); });
  if (rewritten_.size() == old.size()) {
    return;
  }
  if constexpr (has_inline_terms) {
    if (rewrite_in_bits(old)) {
      store(nodes_[node], rewritten_);
      return;
    }
  }
  for (const TermType& each : old) {
    if (!is_alive(each.node)) {
      const std::span<const TermType> value = terms(nodes_[each.node]);
      if (!value.empty()) {
        add_multiple(rewritten_, coefficient(each), value);
      }
    }
  }
  store(nodes_[node], rewritten_);
}

/// Adds up what the dead nodes of a sum have become, and `rewritten_`, in one bit a node, if that is quicker than one
/// after the other: then `rewritten_` is the result.
template <Ring R>
bool ClassSpace<R>::rewrite_in_bits(std::span<const TermType> old) {
  std::size_t terms_of_dead = 0;
  Node youngest = rewritten_.empty() ? 0 : rewritten_.front().node;
  Node oldest = rewritten_.empty() ? no_node : rewritten_.back().node;
  for (const TermType& each : old) {
    if (is_alive(each.node)) {
      continue;
    }
    if (const std::span<const TermType> value = terms(nodes_[each.node]); !value.empty()) {
      terms_of_dead += value.size();
      youngest = std::max(youngest, value.front().node);
      oldest = std::min(oldest, value.back().node);
    }
  }
  constexpr Node word = 64;
  if (youngest < oldest || terms_of_dead < youngest / word - oldest / word) {
    return false;
  }
  const std::size_t words = youngest / word + 1;
  if (bits_.size() < words) {
    bits_.resize(words, 0);
  }
  const auto toggle = [this](std::span<const TermType> terms) {
    for (const TermType& each : terms) {
      bits_[each.node / word] ^= std::uint64_t{1} << (each.node % word);
    }
  };
  toggle(rewritten_);
  for (const TermType& each : old) {
    if (!is_alive(each.node)) {
      toggle(terms(nodes_[each.node]));
    }
  }
  terms_touched_ += rewritten_.size() + terms_of_dead;
  rewritten_.clear();
  for (std::size_t at = words; at-- > oldest / word;) {
    for (std::uint64_t bits = std::exchange(bits_[at], 0); bits != 0;) {
      const auto highest = static_cast<Node>(std::bit_width(bits) - 1);
      rewritten_.push_back(term(static_cast<Node>(at) * word + highest, ring_.one()));
      bits ^= std::uint64_t{1} << highest;
    }
  }
  return true;
}

// ---- memory

template <Ring R>
void ClassSpace<R>::compact_pool() {
  std::vector<TermType> fresh;
  fresh.reserve(pool_.size() - garbage_);
  for (Record& record : nodes_) {
    if (record.size != alive_mark && !(has_inline_terms && record.size == 1)) {
      const auto at = static_cast<std::uint32_t>(fresh.size());
      fresh.insert(fresh.end(), pool_.begin() + record.at.node, pool_.begin() + record.at.node + record.size);
      record.at = {at};
    }
  }
  pool_.swap(fresh);
  garbage_ = 0;
}

template <Ring R>
std::vector<typename ClassSpace<R>::Node> ClassSpace<R>::retire(std::span<ClassRef> refs) {
  std::vector<bool> stays(nodes_.size(), false);
  for (ClassRef& ref : refs) {
    if (ref.is_zero() || is_alive(ref.node())) {
      continue;
    }
    refresh(ref.node());
    if (nodes_[ref.node()].size == 0) {
      ref = ClassRef{};
    } else {
      stays[ref.node()] = true;
    }
  }
  std::vector<Node> number(nodes_.size(), no_node);
  Node next = 0;
  for (Node node = 0; node < nodes_.size(); ++node) {
    if (is_alive(node) || stays[node]) {
      births_.copy(node, next);
      number[node] = next++;
    }
  }
  std::vector<TermType> fresh;
  for (Node node = 0; node < nodes_.size(); ++node) {
    Record record = nodes_[node];
    if (!is_alive(node) && !stays[node]) {
      continue;
    }
    if (record.size != alive_mark) {
      const std::span<const TermType> value = terms(record);
      if (has_inline_terms && record.size == 1) {
        record.at = {number[value[0].node]};
      } else {
        record.at = {static_cast<std::uint32_t>(fresh.size())};
        for (const TermType& each : value) {
          fresh.push_back(term(number[each.node], coefficient(each)));
        }
      }
    }
    nodes_[number[node]] = record;
  }
  nodes_.truncate(next);
  births_.truncate(next);
  pool_.swap(fresh);
  garbage_ = 0;
  for (ClassRef& ref : refs) {
    if (!ref.is_zero()) {
      ref = ClassRef{number[ref.node()], ref.is_negative()};
    }
  }
  return number;
}

template class ClassSpace<sparse::Z2>;
template class ClassSpace<sparse::Zp>;
template class ClassSpace<sparse::Rationals>;
template class ClassSpace<sparse::Integers>;

}  // namespace sesame::engine
