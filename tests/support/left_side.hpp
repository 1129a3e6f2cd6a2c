/// \file
/// The big complex of a structure and what it needs, without the rest of the equivalence; and the laws of its maps.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/left/new_family.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

namespace sesame::tests {

using engine::GeneratorId;
using ops::CellId;
using sparse::Terms;

template <sparse::Ring R, class Id>
Terms<R, Id> one_term(const R& ring, Id id) {
  return {{id, ring.one()}};
}

/// A linear map, given on generators, of a chain.
template <sparse::Ring R, class From, class Map>
auto applied(const R& ring, const Map& map, const Terms<R, From>& chain) {
  using To = decltype(map(std::declval<From>()).front().index);
  sparse::RawTerms<R, To> sum;
  for (const auto& [id, coefficient] : chain) {
    for (const auto& [other, factor] : map(id)) {
      sum.push_back({other, ring.multiply(coefficient, factor)});
    }
  }
  return std::move(sum).normal(ring);
}

template <class Id, sparse::Ring R>
Terms<R, Id> sum_of(const R& ring, const std::vector<Terms<R, Id>>& chains) {
  sparse::RawTerms<R, Id> sum;
  for (const Terms<R, Id>& chain : chains) {
    for (const auto& term : chain) {
      sum.push_back(term);
    }
  }
  return std::move(sum).normal(ring);
}

/// Follows the steps of a structure. Maps of cells and generators are in normal form.
template <sparse::Ring R>
class LeftSide {
 public:
  LeftSide(R ring, engine::Window window)
      : ring_{ring},
        window_{std::move(window)},
        big_{ring, window_},
        rewriter_{ring, big_.boundary()},
        frozen_{ring, big_, rewriter_},
        position_{window_.start()} {
    for (GeneratorId generator = 0; generator < big_.size(); ++generator) {
      rewriter_.append(big_.degree(generator));
    }
    follow();
  }

  const R& ring() const { return ring_; }
  const ops::Structure& structure() const { return window_.structure(); }
  const engine::BigComplex<R>& big() const { return big_; }
  const engine::LeftMaps<R>& maps() const { return big_.maps(); }
  engine::Rewriter<R>& rewriter() { return rewriter_; }
  engine::FrozenMaps<R>& frozen() { return frozen_; }

  /// Takes in a step and what queries have made before it. To be called after each step.
  void follow() {
    const engine::RuleId time = rewriter_.rules();
    GeneratorId first_copy = ops::none;
    std::vector<std::uint32_t> moves;
    const ops::Journal& journal = structure().journal();
    while (position_ < journal.end()) {
      const ops::Journal::Position begin = std::exchange(position_, journal.end());
      journal.for_each_since(begin, [&](const ops::Journal::Run& run) {
        for (std::uint32_t number = run.first; number < run.first + run.count; ++number) {
          if (run.kind == ops::EventKind::copy) {
            first_copy = std::min(first_copy, big_.size());
          }
          if (run.kind == ops::EventKind::move) {
            moves.push_back(number);
          }
          const engine::RuleId before = rewriter_.rules();
          append(run.kind, number);
          if (run.kind == ops::EventKind::deletion) {
            rewriter_.take_away(before, big_.size() - 1, big_.take_away(big_.size() - 1));
          }
        }
      });
    }
    if (!moves.empty()) {
      const ops::MoveRange made{moves.front(), moves.back() + 1};
      if (const std::vector<GeneratorId> changed = big_.split(first_copy, made); !changed.empty()) {
        rewriter_.perturb(time, first_copy, changed);
      }
    }
  }

  struct Mark {
    ops::Journal::Position position;
    typename engine::BigComplex<R>::Mark big;
    typename engine::FrozenMaps<R>::Mark frozen;
    typename engine::Rewriter<R>::Mark rewriter;
  };
  Mark mark() { return {position_, big_.mark(), frozen_.mark(), rewriter_.mark()}; }
  /// The structure has gone back before.
  void go_back_to(const Mark& mark) {
    rewriter_.undo(mark.rewriter);
    big_.truncate(mark.big);
    frozen_.truncate(mark.frozen);
    position_ = mark.position;
  }

  /// f, g, h; and K of a cell, which is not 0 where there are lazy cells.
  Terms<R, CellId> f(GeneratorId generator) const { return maps().f(one_term(ring_, generator)); }
  Terms<R, GeneratorId> g(CellId cell) const { return maps().g(cell); }
  Terms<R, GeneratorId> h(GeneratorId generator) const { return maps().h(generator); }
  Terms<R, CellId> K(CellId cell) const {
    sparse::RawTerms<R, CellId> out;
    maps().add_K_of_lazy_part(cell, ring_.one(), out);
    return std::move(out).normal(ring_);
  }
  Terms<R, GeneratorId> boundary_of_generator(GeneratorId generator) const { return big_.boundary().column(generator); }
  Terms<R, CellId> boundary_of_cell(CellId cell) const {
    sparse::RawTerms<R, CellId> out;
    const auto faces = structure().faces().of(cell);
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      if (const auto [face, sign] = structure().forest().find_oriented(faces[k]); face != ops::none) {
        out.push_back({face, ring_.from(sign * structure().faces().sign(cell, k))});
      }
    }
    return std::move(out).normal(ring_);
  }

 private:
  void append(ops::EventKind kind, std::uint32_t number) {
    std::optional<GeneratorId> generator;
    switch (kind) {
      case ops::EventKind::cell:
        generator = big_.append_cell(ops::CellId{number});
        break;
      case ops::EventKind::copy:
        generator = big_.append_copy(ops::CellId{number});
        break;
      case ops::EventKind::removal:
        generator = big_.append_removal(ops::LinkId{number});
        break;
      case ops::EventKind::deletion:
        generator = big_.append_deletion(ops::LinkId{number});
        break;
      case ops::EventKind::family:
        engine::append_family(ops::FamilyId{number}, structure(), frozen_, big_, rewriter_);
        break;
      default:
        break;
    }
    if (generator) {
      rewriter_.append(big_.degree(*generator));
    }
  }

  R ring_;
  engine::Window window_;
  engine::BigComplex<R> big_;
  engine::Rewriter<R> rewriter_;
  engine::FrozenMaps<R> frozen_;
  ops::Journal::Position position_;
};

/// The first law of the left reduction that is broken, or of f, g and K where there are lazy cells; "" if there is
/// none.
template <sparse::Ring R>
std::string broken_left_law(const LeftSide<R>& side) {
  const R& ring = side.ring();
  const auto f = [&](GeneratorId x) { return side.f(x); };
  const auto g = [&](CellId c) { return side.g(c); };
  const auto h = [&](GeneratorId x) { return side.h(x); };
  const auto K = [&](CellId c) { return side.K(c); };
  const auto d_big = [&](GeneratorId x) { return side.boundary_of_generator(x); };
  const auto d_object = [&](CellId c) { return side.boundary_of_cell(c); };
  const auto of = [&](const auto& map, const auto& chain) { return applied(ring, map, chain); };
  const bool is_reduction = side.structure().lazy().families() == 0;
  const std::vector<ops::CellId> cells = current_cells(side.structure());
  for (const ops::CellId c : cells) {
    const Terms<R, CellId> dc = d_object(c);
    if (!of(d_object, dc).empty()) {
      return "d d = 0 on a cell";
    }
    if (of(d_big, g(c)) != of(g, dc)) {
      return "d g = g d";
    }
    if (sum_of<CellId>(ring, {of(f, g(c)), of(d_object, K(c)), of(K, dc)}) != one_term(ring, c)) {
      return "f g + d K + K d = 1";
    }
    if (is_reduction && !(K(c).empty() && of(h, g(c)).empty())) {
      return "K = 0, h g = 0";
    }
  }
  for (GeneratorId x = 0; x < side.big().size(); ++x) {
    const Terms<R, GeneratorId> dx = d_big(x);
    if (!of(d_big, dx).empty()) {
      return "d d = 0 on a generator";
    }
    const Terms<R, CellId> fx = f(x);
    if (of(d_object, fx) != of(f, dx)) {
      return "d f = f d";
    }
    if (is_reduction) {
      if (sum_of<GeneratorId>(ring, {of(g, fx), of(d_big, h(x)), of(h, dx)}) != one_term(ring, x)) {
        return "g f + d h + h d = 1";
      }
      if (!(of(f, h(x)).empty() && of(h, h(x)).empty())) {
        return "f h = 0, h h = 0";
      }
    }
  }
  return "";
}

/// Everything that can be seen of a left side, as text.
template <sparse::Ring R>
std::string dump(const LeftSide<R>& side) {
  std::string text;
  const auto add = [&](const char* what, std::uint32_t of, const auto& chain) {
    text += std::string{what} + std::to_string(of) + ":";
    for (const auto& [id, coefficient] : chain) {
      text += " " + to_rational(side.ring(), coefficient).to_string() + "*" + std::to_string(id);
    }
    text += "\n";
  };
  for (GeneratorId x = 0; x < side.big().size(); ++x) {
    add("d ", x, side.boundary_of_generator(x));
    add("f ", x, side.f(x));
    if (side.structure().lazy().families() == 0) {
      add("h ", x, side.h(x));
    }
  }
  for (const ops::CellId c : current_cells(side.structure())) {
    add("g ", c, side.g(c));
  }
  for (const std::uint32_t count : side.big().counts()) {
    text += std::to_string(count) + " ";
  }
  return text;
}

}  // namespace sesame::tests
