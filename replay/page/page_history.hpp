/// \file
/// What a page shows of a replay: cells and steps, gathered step by step.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "replay/page/generator_history.hpp"
#include "replay/page/page_cells.hpp"
#include "replay/page/vertex_places.hpp"

namespace sesame::replay {

/// The history of an object as a page can go through it, forwards and backwards: the page carries events out and takes
/// them back, so an undo is the list of the steps that it took back.
class PageHistory {
 public:
  explicit PageHistory(const PageLimits& limits) : limits_{limits}, generators_{limits} {}

  /// To be called after each step, none left out. Cost: what the step did, the groups after it, and at a product all
  /// cells that are shown.
  void take(engine::Engine& engine, const ops::Operation& operation, const engine::StepReport& report);

  /// To be called before a page is written: the generators after the last step are kept whatever that takes, unless
  /// `stop` says no.
  void take_last_generators(engine::Engine& engine, const std::atomic<bool>* stop);

  [[nodiscard]] const PageLimits& limits() const { return limits_; }
  [[nodiscard]] const PageCells& cells() const { return cells_; }
  [[nodiscard]] const std::vector<PageStep>& steps() const { return steps_; }
  /// After every so many steps the page stops, and at the end: a power of 2. The steps between have their events only.
  [[nodiscard]] std::uint64_t stride() const { return stride_; }
  [[nodiscard]] const GeneratorHistory& generators() const { return generators_; }
  [[nodiscard]] const VertexPlaces& places() const { return places_; }
  /// Cells that there were and that are not shown, for want of room or as those of a family that is too large.
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }
  [[nodiscard]] std::uint64_t families_left_out() const { return families_left_out_; }
  /// A chain of the present object.
  [[nodiscard]] PageChain chain(const ops::Structure& structure, const engine::CellChain& chain) const;

 private:
  void thin_out();
  void take_in(const ops::Structure& structure, PageStep& step);
  void take_back(std::uint64_t steps, const ops::Structure& structure, PageStep& step);
  void add_families(const ops::Structure& structure, PageStep& step);
  void note_consumed(const ops::Structure& structure, PageStep& step);
  void number_nodes(const ops::Structure& structure);
  void add_node(const ops::Structure& structure, ops::CellId node);
  void place(const ops::Structure& structure, ops::CellId node, std::uint32_t cell);
  void add_removals(const ops::Structure& structure, PageStep& step);
  void add_moves(const ops::Structure& structure, PageStep& step);
  void add_answer(engine::Engine& engine, const ops::Operation& operation, const engine::StepReport& report,
                  PageStep& step) const;
  [[nodiscard]] PageRef face(const ops::Structure& structure, ops::CellId node, bool is_turned) const;
  /// The number of a node, or none.
  [[nodiscard]] std::uint32_t number(ops::CellId node) const {
    const auto& list = numbers_[ops::is_asked_for(node) ? 1 : 0];
    return ops::number_of(node) < list.size() ? list[ops::number_of(node)] : std::uint32_t{ops::none};
  }
  [[nodiscard]] GeneratorHistory::Place place(std::size_t step) const;
  [[nodiscard]] GeneratorHistory::Writer writer(const ops::Structure& structure) const;
  [[nodiscard]] std::uint32_t type_number(const ops::CellType& type, int faces);

  PageLimits limits_;
  PageCells cells_;
  std::vector<PageStep> steps_;
  GeneratorHistory generators_;
  VertexPlaces places_;
  std::array<std::vector<std::uint32_t>, 2> numbers_;  ///< of nodes that steps made, that were asked for; or none
  std::vector<ops::CellId> nodes_;                     ///< of cells of the page
  std::map<ops::CellType, std::uint32_t> types_;
  std::vector<bool> shown_;              ///< per family
  std::vector<std::uint32_t> undoable_;  ///< the steps that are not undone
  ops::LinkId links_ = 0;                ///< until the last step
  std::uint32_t moves_ = 0;              ///< likewise
  std::uint64_t left_out_ = 0, families_left_out_ = 0;
  std::uint64_t stride_ = 1;
};

}  // namespace sesame::replay
