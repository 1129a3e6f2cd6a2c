/// \file
/// Running the engine and looking at all of it, for the tests of engine/ and of what uses it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "engine/live_equivalence.hpp"
#include "sparse/matrix_text.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/structures.hpp"

namespace sesame::tests {

using engine::CellChain;
using engine::ClassAnswer;
using engine::Engine;
using sparse::AnyRing;
using sparse::Integer;

/// For engines that are to take splits in: as objects of tests are small, they would be begun afresh at each.
inline constexpr engine::RebasePolicy taking_splits_in{.cells_begun_at_once = 0, .cells_per_move = 0};

/// The ring of a name that is known to be right.
inline AnyRing ring_named(const std::string& name) { return sparse::parse_ring(name).value(); }

/// Applies an operation that must be legal.
inline engine::StepReport carry_out(Engine& engine, const ops::Operation& op) {
  auto report = engine.apply(op);
  if (!report) {
    FAIL(ops::to_text(op) << ": " << report.error().what);
  }
  return *report;
}
inline engine::StepReport carry_out(Engine& engine, const std::string& line) {
  return carry_out(engine, operation(line));
}
inline void build(Engine& engine, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    carry_out(engine, line);
  }
}

inline std::string to_text(const CellChain& chain) {
  std::string text = "deg " + std::to_string(chain.degree) + ":";
  for (const auto& [coefficient, cell] : chain.terms) {
    text += " " + coefficient.to_string() + "*" + std::to_string(cell);
  }
  return text;
}

inline std::string to_text(const ClassAnswer& answer) {
  std::string text = answer.is_cycle ? "cycle" : "no cycle";
  text += answer.is_zero ? " zero" : "";
  for (const sparse::Rational& a : answer.coefficients) {
    text += " " + a.to_string();
  }
  return text + (answer.bounds ? " bounds " + to_text(*answer.bounds) : "");
}

/// Sizes, groups, generators with their bounding chains.
inline std::string answers(Engine& engine) {
  const engine::Homology homology = engine.homology();
  std::string text;
  for (std::size_t p = 0; p < homology.big.size(); ++p) {
    text += "big " + std::to_string(homology.big[p]) + "\n";
  }
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += "H" + std::to_string(p) + " " + std::to_string(homology.betti[p]) + " small " +
            std::to_string(homology.small[p]);
    for (const Integer& t : homology.torsion[p]) {
      text += " " + t.to_string();
    }
    text += "\n";
    for (const engine::Generator& generator : engine.generators(static_cast<int>(p))) {
      text += "  order " + generator.order.to_string() + " " + to_text(generator.cycle) + " | " +
              to_text(generator.bounding) + "\n";
    }
  }
  return text;
}

template <sparse::Ring R>
void append_map(const reductions::GradedMap<R>& map, std::string& text) {
  for (int p = 0; p < static_cast<int>(map.source().size()); ++p) {
    text += sparse::to_string(map.at(p)) + "\n";
  }
}

/// Every map of the equivalence, written out.
template <sparse::Ring R>
std::string matrices_of(Engine& engine) {
  std::string text;
  if (auto* live = engine.live<R>()) {
    const auto equivalence = live->matrices();
    for (const auto& reduction : {equivalence.left, equivalence.right}) {
      append_map(differential(reduction.big), text);
      append_map(differential(reduction.small), text);
      append_map(reduction.f, text);
      append_map(reduction.g, text);
      append_map(reduction.h, text);
    }
  }
  return text;
}

/// Everything that can be asked of an engine but its log. Two engines answer alike exactly when these are equal.
inline std::string dump(Engine& engine) {
  std::string text = dump(engine.structure()) + answers(engine);
  text += "euler " + std::to_string(engine.euler_characteristic()) + "\n";
  engine.structure().cells().for_each_node([&](ops::CellId c) {
    if (engine.structure().is_current(c)) {
      const CellChain cell{engine.structure().dimension(c), {{1, c}}};
      text += to_text(engine.classify(cell)) + "; " + to_text(engine.classify(engine.maps().boundary(cell))) + "\n";
    }
  });
  return text + matrices_of<sparse::Integers>(engine) + matrices_of<sparse::Z2>(engine) +
         matrices_of<sparse::Zp>(engine) + matrices_of<sparse::Rationals>(engine);
}

// ---- chains with integer or rational coefficients

/// a + factor * b, reduced modulo the ring's characteristic, in the order of the cells' ids.
inline CellChain sum(const CellChain& a, const sparse::Rational& factor, const CellChain& b, const AnyRing& ring) {
  std::map<ops::CellId, sparse::Rational> total;
  for (const auto& [coefficient, cell] : a.terms) {
    total[cell] += coefficient;
  }
  for (const auto& [coefficient, cell] : b.terms) {
    total[cell] += factor * coefficient;
  }
  const std::uint32_t p = std::visit([](const auto& r) { return r.characteristic(); }, ring);
  CellChain result{a.terms.empty() ? b.degree : a.degree, {}};
  for (const auto& [cell, coefficient] : total) {
    const sparse::Rational value = p == 0 ? coefficient : std::int64_t{coefficient.numerator().modulo(p)};
    if (!value.is_zero()) {
      result.terms.push_back({value, cell});
    }
  }
  return result;
}

/// True when a = factor * b over the ring.
inline bool equal_to(const CellChain& a, const sparse::Rational& factor, const CellChain& b, const AnyRing& ring) {
  return sum(a, -factor, b, ring).terms.empty();
}

}  // namespace sesame::tests
