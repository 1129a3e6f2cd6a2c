#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>

#include "engine/cycle_tracker.hpp"
#include "replay/tower_reader.hpp"
#include "replay/tower_replay.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

using replay::TowerOperation;

/// Operations that are all in memory, in one list of numbers each after the other, as a reader of a binary file has
/// them: so a tracker can look ahead as it does there.
class LoadedOperations {
 public:
  explicit LoadedOperations(const Filtration& filtration) : kind_{TowerOperation::Kind::column} {
    for (std::size_t k = 0; k < filtration.size(); ++k) {
      const auto faces = filtration.faces[k];
      begin(kind_, filtration.dimensions[k]);
      words_.push_back(faces.size());
      words_.insert(words_.end(), faces.begin(), faces.end());
    }
  }

  /// Requires: a tower that the reader understands, as write_random_tower makes them.
  explicit LoadedOperations(replay::TowerReader& reader) : kind_{TowerOperation::Kind::insert} {
    TowerOperation operation;
    while (true) {
      const Result<bool> got = reader.next(operation);
      sparse::expects(got.has_value(), "a tower that was made is one that can be read");
      if (!*got) {
        break;
      }
      begin(operation.kind, operation.dimension);
      words_.push_back(operation.labels.size());
      words_.insert(words_.end(), operation.labels.begin(), operation.labels.end());
    }
  }

  [[nodiscard]] std::size_t size() const { return heads_.size(); }
  [[nodiscard]] TowerOperation operator[](std::size_t k) const {
    const auto& [kind, dimension, at] = heads_[k];
    const std::span<const std::uint64_t> rest{words_.data() + at, words_.data() + words_.size()};
    const auto count = static_cast<std::size_t>(rest[0]);
    const bool is_column = kind == TowerOperation::Kind::column;
    return {kind, static_cast<double>(k), dimension, rest.subspan(1, count),
            is_column ? rest.subspan(1 + count) : std::span<const std::uint64_t>{}};
  }

 private:
  struct Head {
    TowerOperation::Kind kind;
    int dimension;
    std::size_t at;  ///< where in words_ the number of labels stands
  };
  void begin(TowerOperation::Kind kind, int dimension) {
    words_.push_back(static_cast<std::uint64_t>(dimension));
    heads_.push_back({kind, dimension, words_.size()});
  }

  TowerOperation::Kind kind_;
  std::vector<Head> heads_;
  std::vector<std::uint64_t> words_;
};

std::int64_t alternating_sum(std::span<const std::uint64_t> numbers) {
  std::int64_t sum = 0;
  for (std::size_t k = numbers.size(); k-- > 0;) {
    sum = static_cast<std::int64_t>(numbers[k]) - sum;
  }
  return sum;
}

/// What is wrong with the Betti numbers at the end, or an empty text.
std::string wrong_answer(const engine::BarcodeTracker& tracker, const replay::TowerReplay& tower,
                         const std::optional<Answer>& answer) {
  const std::vector<std::uint64_t> betti = tracker.betti();
  if (alternating_sum(betti) != alternating_sum(tower.cells())) {
    return "the Euler characteristics of cells and of homology differ";
  }
  return answer ? difference({{betti.begin(), betti.end()}, {}, {}, {}}, *answer) : "";
}

Sample run_tracker(const Scenario& scenario, std::uint64_t size, const std::string& method,
                   const LoadedOperations& operations, engine::Slots slots, const RunOptions& options) {
  std::uint64_t bars = 0;
  const auto count_bar = [&bars](const engine::Bar&) { ++bars; };
  std::unique_ptr<engine::BarcodeTracker> tracker;
  if (method == "cycles") {
    tracker = engine::make_cycle_tracker(sparse::Z2{}, count_bar);
  } else {
    tracker = engine::make_barcode_tracker(sparse::Z2{}, count_bar, slots);
  }
  replay::TowerReplay tower({tracker.get()});
  Sample sample = measure_steps(operations.size(), options, [&](std::size_t k) { return tower.apply(operations[k]); });
  const engine::BarcodeTracker::Work work = tracker->work();
  sample.counts = {{"terms_touched", work.terms_touched},
                   {"terms_held", work.terms_held},
                   {"classes_held", work.classes_held},
                   {"bars", bars}};
  if (sample.verdict == Verdict::right) {
    sample.remark = wrong_answer(*tracker, tower, scenario.answer(size));
    sample.verdict = sample.remark.empty() ? Verdict::right : Verdict::wrong;
  }
  return sample;
}

}  // namespace

std::span<const std::string> tracker_methods() {
  static const std::array<std::string, 2> names{"sesame", "cycles"};
  return names;
}

Sample run_filtration(const Scenario& scenario, std::uint64_t size, const std::string& method,
                      const RunOptions& options) {
  const LoadedOperations operations(std::get<CellFiltration>(scenario.input).make(size));
  const auto slots = method == "cycles" ? engine::Slots::by_dimension : engine::Slots::shared;
  return run_tracker(scenario, size, method, operations, slots, options);
}

Sample run_tower(const Scenario& scenario, std::uint64_t size, const std::string& method, const RunOptions& options) {
  const ScratchDirectory directory;
  TowerOptions tower = std::get<RandomTower>(scenario.input).options;
  tower.operations = size;
  {
    std::ofstream file(directory.path("tower"));
    write_random_tower(file, tower);
  }
  const auto reader = replay::TowerReader::open(directory.path("tower"), replay::TowerFormat::tower);
  sparse::expects(reader.has_value(), "a tower that was written can be opened");
  const LoadedOperations operations(**reader);
  return run_tracker(scenario, size, method, operations, engine::Slots::by_dimension, options);
}

}  // namespace sesame::tools
