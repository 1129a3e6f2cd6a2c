#include "tools/bench/loaded_operations.hpp"

#include <fstream>
#include <span>

#include "sparse/contract.hpp"
#include "tools/bench/processes.hpp"

namespace sesame::tools {

using replay::TowerOperation;

LoadedOperations::LoadedOperations(const Scenario& scenario, std::uint64_t size) {
  if (const auto* filtration = std::get_if<CellFiltration>(&scenario.input)) {
    load(filtration->make(size));
    return;
  }
  const ScratchDirectory directory;
  const auto* zigzag = std::get_if<Zigzag>(&scenario.input);
  {
    std::ofstream file(directory.path("operations"));
    if (zigzag != nullptr) {
      zigzag->write(file, size);
    } else {
      TowerOptions tower = std::get<RandomTower>(scenario.input).options;
      tower.operations = size;
      write_random_tower(file, tower);
    }
  }
  const auto reader = replay::TowerReader::open(
      directory.path("operations"), zigzag != nullptr ? replay::TowerFormat::zigzag : replay::TowerFormat::tower);
  sparse::expects(reader.has_value(), "operations that were written can be opened");
  load(**reader);
}

TowerOperation LoadedOperations::operator[](std::size_t k) const {
  const auto& [kind, dimension, at] = heads_[k];
  const std::span<const std::uint64_t> rest{words_.data() + at, words_.data() + words_.size()};
  const auto count = static_cast<std::size_t>(rest[0]);
  return {kind, static_cast<double>(k), dimension, rest.subspan(1, count),
          are_columns_ ? rest.subspan(1 + count) : std::span<const std::uint64_t>{}};
}

void LoadedOperations::load(const Filtration& filtration) {
  are_columns_ = true;
  for (std::size_t k = 0; k < filtration.size(); ++k) {
    const auto faces = filtration.faces[k];
    begin(Kind::column, filtration.dimensions[k]);
    words_.push_back(faces.size());
    words_.insert(words_.end(), faces.begin(), faces.end());
  }
}

void LoadedOperations::load(replay::TowerReader& reader) {
  TowerOperation operation;
  while (true) {
    const Result<bool> got = reader.next(operation);
    sparse::expects(got.has_value(), "operations that were made can be read");
    if (!*got) {
      break;
    }
    begin(operation.kind, operation.dimension);
    words_.push_back(operation.labels.size());
    words_.insert(words_.end(), operation.labels.begin(), operation.labels.end());
  }
}

void LoadedOperations::begin(Kind kind, int dimension) {
  words_.push_back(static_cast<std::uint64_t>(dimension));
  heads_.push_back({kind, dimension, words_.size()});
}

}  // namespace sesame::tools
