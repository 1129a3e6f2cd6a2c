/// \file
/// The cells that a page shows, under numbers of its own, and what each step did to them.
#pragma once

#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/ids.hpp"
#include "sparse/integer.hpp"

namespace sesame::replay {

/// How much a page has of an object; what is left out is said on the page.
struct PageLimits {
  std::uint64_t cells = 40'000;                   ///< that were ever there, undone ones too
  std::uint64_t cells_of_family = 20'000;         ///< of one product or large cone; a larger one is not shown
  std::uint64_t steps = 10'000;                   ///< of more, several are shown as one
  std::uint64_t generators = 100;                 ///< of the object at the end
  std::uint64_t terms = 5'000;                    ///< of a chain
  std::uint64_t terms_of_generators = 50'000;     ///< of all generators after one step together
  std::uint64_t terms_of_history = 300'000;       ///< of all generators after all steps; then those at the end only
  std::uint64_t work_on_generators = 10'000'000;  ///< until likewise, in terms that are looked at
  std::uint64_t bytes_of_operation = 300;         ///< of its text
};

/// A cell as another one sees it: a face, or what it became. From 0 on: twice its number, and 1 more when it is turned
/// round (an edge with its ends exchanged). Below: see the constants.
using PageRef = std::int64_t;
/// A cell that is not shown.
inline constexpr PageRef ref_to_unshown = -1;
/// A degenerate cell, which lies on the cell of this number.
[[nodiscard]] constexpr PageRef ref_squashed_onto(std::uint32_t number) { return -2 - PageRef{number}; }
[[nodiscard]] constexpr PageRef ref_to(std::uint32_t number, bool is_turned) {
  return 2 * PageRef{number} + (is_turned ? 1 : 0);
}

/// The cells that were ever there, in the order in which they came: of those that were undone and made anew, each has a
/// number of its own. Names, types and faces are those at their beginning.
struct PageCells {
  std::vector<std::string> names;
  std::vector<ops::CellType> types;    ///< that occur; of one that is no simploid its first two numbers and how many
                                       ///< faces it has
  std::vector<std::uint32_t> type_of;  ///< by cell, its number in `types`
  std::vector<std::uint32_t> first_face{0};  ///< by cell, and one more
  std::vector<PageRef> faces;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(names.size()); }
  [[nodiscard]] int dimension(std::uint32_t cell) const {
    const ops::CellType& type = types[type_of[cell]];
    return !ops::is_simploid(type) ? type[1] : std::accumulate(type.begin(), type.end(), 0);
  }
};

/// A sum of cells; a coefficient is a text.
struct PageChain {
  struct Term {
    std::string coefficient;
    std::int64_t cell;  ///< its number, or -1
    std::string name;   ///< of one that is not shown
    friend bool operator==(const Term&, const Term&) = default;
  };
  std::vector<Term> terms;
  std::uint64_t length = 0;     ///< of the chain, when it is too long to be written; else 0
  bool is_length_exact = true;  ///< or only a bound
  friend bool operator==(const PageChain&, const PageChain&) = default;
};

/// A class that was a generator after some step.
struct PageClass {
  int degree = 0;
  sparse::Integer order;               ///< 0: free
  std::optional<std::uint32_t> since;  ///< the step, counted from 0, that made it, when that is known
  PageChain cycle;
  std::optional<PageChain> bounding;  ///< of a class of finite order: what so many times the cycle bounds
};

/// How a class came to its end.
enum class ClassEnd : std::uint8_t {
  bounds,    ///< its cycle became a boundary
  cut,       ///< what its cycle goes through was split, so that it is a cycle no more
  removed,   ///< a cell that its cycle goes through was removed
  consumed,  ///< its cells became those of a factor of a product
  undone,    ///< the step behind which its cycle was written was taken back
};

/// The answer to a `class` step.
struct PageAnswer {
  bool is_cycle = false, is_zero = false;
  std::vector<std::string> coefficients;
  PageChain asked;
  std::optional<PageChain> bounds;
};

/// What a step did, and the object after it.
struct PageStep {
  std::string op, text;
  std::uint32_t first = 0, made = 0;    ///< it made so many cells, from this number on
  std::vector<PageRef> removed;         ///< in pairs: a number, and what that cell became
  std::vector<PageRef> moved;           ///< in triples: a number, which of its faces, and what that is now
  std::vector<std::uint32_t> consumed;  ///< cells that became part of a factor of a product
  std::vector<std::uint32_t> undone;    ///< the steps that it took back, counted from 0, the last one first
  std::vector<std::pair<std::uint32_t, ClassEnd>> ended;  ///< the classes that ended with it
  std::vector<std::uint64_t> cells;
  std::int64_t euler = 0;
  std::vector<std::int64_t> betti;
  std::vector<std::vector<sparse::Integer>> torsion;
  std::optional<std::vector<std::uint32_t>> generators;  ///< the classes that are generators after it, if it is known
  std::unique_ptr<PageAnswer> answer;                    ///< or null

  /// The page does not stop there: nobody reads the rest.
  void keep_events_only() {
    op = text = {};
    cells = {};
    betti = {};
    torsion = {};
    generators.reset();
    answer = nullptr;
  }
};

}  // namespace sesame::replay
