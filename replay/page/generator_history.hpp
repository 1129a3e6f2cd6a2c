/// \file
/// The generators of a replay after each of its steps, and which step made a class and which one ended it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/engine.hpp"
#include "replay/page/page_cells.hpp"
#include "replay/script/generators.hpp"

namespace sesame::replay {

/// Keeps the generators after each step, as long as that does not take too long, and follows their classes from step to
/// step: a class is as old as the first object that it comes from, by the maps that the steps induce. Older ones go
/// first, as in persistence: what is a sum of older classes is none of its own. Behind a split, whose maps go the other
/// way, a cycle is followed as long as it is one.
///
/// Source: the elder rule of persistent homology; over Z, membership in the subgroup that the older ones generate.
class GeneratorHistory {
 public:
  /// What a page knows of chains: their cells by number, and how they are written.
  struct Writer {
    std::function<bool(ops::CellId)> is_shown;
    std::function<PageChain(const engine::CellChain&)> write;
  };

  explicit GeneratorHistory(const PageLimits& limits) : limits_{limits} {}

  /// Where a replay is.
  struct Place {
    std::uint32_t step;   ///< the number of the last step
    std::uint32_t state;  ///< of the last one that is not undone: what there is now was there after it
  };

  /// To be called after a step, which took back those of the numbers `undone`, none unless it was an undo. Puts into it
  /// which classes have ended with it, and which are the generators after it.
  /// Cost: that of the generators, and a question for each class that has not ended; or none, once it has given up.
  void take(engine::Engine& engine, Place place, std::span<const std::uint32_t> undone, const Writer& writer,
            PageStep& into);
  /// Puts the generators into a step behind which there is no other one, if they are not in it: whatever that takes,
  /// unless `stop` says no.
  void take_last(engine::Engine& engine, Place place, const Writer& writer, const std::atomic<bool>* stop,
                 PageStep& into);

  /// By number.
  [[nodiscard]] const std::vector<PageClass>& classes() const { return classes_; }
  /// From which step on, counted from 0, generators have not been kept any more, if there is one.
  [[nodiscard]] std::optional<std::uint32_t> given_up() const { return given_up_; }

 private:
  /// A class whose cycle can be carried on.
  struct Followed {
    std::uint32_t number;     ///< of the class
    std::uint32_t recorded;   ///< the step behind which there are all nodes of its cycle
    engine::CellChain cycle;  ///< in nodes of that time
    std::optional<std::uint32_t> ended;
    engine::CellChain now;                       ///< the cycle in the object now
    std::vector<sparse::Rational> coefficients;  ///< of its class now
  };

  /// A class that was not there with this cycle, and which generator it is.
  struct New {
    std::uint32_t number;
    std::size_t index;
  };

  void forget_undone(std::span<const std::uint32_t> undone, PageStep& into);
  std::optional<ClassEnd> end_of(engine::Engine& engine, Followed& each);
  void carry_on(engine::Engine& engine, std::uint32_t step, PageStep& into);
  void record(engine::Engine& engine, Place place, const Writer& writer, const std::atomic<bool>* stop, PageStep& into);
  [[nodiscard]] static PageClass written(const engine::Generator& generator, const GeneratorOptions& options,
                                         const Writer& writer);
  [[nodiscard]] std::optional<std::uint32_t> known_class(const engine::Generator& generator,
                                                         const PageClass& found) const;
  void follow(const engine::CellChain& cycle, std::uint32_t state, const Writer& writer);
  void find_ages(const sparse::AnyRing& ring, std::span<const sparse::Integer> orders, std::uint32_t step,
                 std::span<const New> added);

  PageLimits limits_;
  std::vector<PageClass> classes_;
  std::vector<Followed> followed_;
  std::vector<std::uint32_t> last_;  ///< the generators that were recorded last
  std::uint64_t work_ = 0;           ///< so far, in terms
  std::uint64_t terms_ = 0;          ///< of the chains that are kept, roughly
  std::optional<std::uint32_t> given_up_;
};

}  // namespace sesame::replay
