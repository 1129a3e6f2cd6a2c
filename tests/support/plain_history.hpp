/// \file
/// The spaces and maps of a history of an engine, by dense linear algebra.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/plain_relations.hpp"

namespace sesame::tests {

/// A map of chains between the cells of two moments, by the exact sequence of a step.
inline PlainRows rows_of(const sparse::Matrix<sparse::Integers>& map, const std::vector<ops::CellId>& from,
                         const std::vector<ops::CellId>& to, const ops::CellBasis& rows_now, int degree,
                         const std::vector<ops::CellId>& columns_now, const PlainField& field) {
  std::map<ops::CellId, PlainVector> image;
  for (sparse::Index k = 0; k < columns_now.size(); ++k) {
    PlainVector row(to.size(), 0);
    map.for_each_in_column(k, [&](const auto& term) {
      const ops::CellId cell = rows_now.generators(static_cast<std::size_t>(degree))[term.index];
      row[static_cast<std::size_t>(std::find(to.begin(), to.end(), cell) - to.begin())] =
          field.reduced(term.coefficient.to_int64().value());
    });
    image[columns_now[k]] = row;
  }
  PlainRows rows;
  for (const ops::CellId cell : from) {
    rows.push_back(image.at(cell));
  }
  return rows;
}

/// The spaces and maps of a history, each from scratch.
class PlainHistory {
 public:
  static constexpr int dimensions = 4;
  /// The object after a step, and how it is mapped.
  struct Step {
    std::uint64_t number;
    bool is_backward;
    ops::CellBasis basis;
    std::vector<PlainGroup> groups;  ///< by degree
    std::vector<PlainRows> maps;     ///< from the step before to this one, or back
    std::vector<PlainRows> cells;    ///< the same of chains of cells
  };

  explicit PlainHistory(std::int64_t p) : field_{p} {}

  void add(Engine& engine, const engine::StepReport& report) {
    const ops::Structure& structure = engine.structure();
    Step step{report.step,
              report.kind == ops::StepKind::split || report.kind == ops::StepKind::deletion,
              ops::cells_at(structure, report.after),
              {},
              {},
              {}};
    const auto complex = ops::chain_complex(structure, step.basis, report.after, sparse::Integers{});
    const auto boundary = [&](int degree) {
      PlainRows rows;
      for (const ops::CellId cell : step.basis.generators(static_cast<std::size_t>(degree))) {
        PlainVector row(degree > 0 ? step.basis.generators(static_cast<std::size_t>(degree - 1)).size() : 0, 0);
        if (degree > 0) {
          complex.boundary(degree).for_each_in_column(step.basis.index(cell), [&](const auto& term) {
            row[term.index] = field_.reduced(term.coefficient.to_int64().value());
          });
        }
        rows.push_back(row);
      }
      return rows;
    };
    const auto sequence =
        only(ops::step_sequences(structure, report.kind, report.before, report.after, sparse::Integers{}));
    for (int degree = 0; degree < dimensions; ++degree) {
      const auto d = static_cast<std::size_t>(degree);
      step.groups.emplace_back(boundary(degree), d > 0 ? step.basis.generators(d - 1).size() : 0, boundary(degree + 1),
                               field_);
      if (!steps_.empty()) {
        const Step& before = steps_.back();
        const Step& source = step.is_backward ? step : before;
        const Step& target = step.is_backward ? before : step;
        const PlainRows cells =
            cell_map(sequence, report.kind, source.basis.generators(d), target.basis.generators(d), degree);
        PlainRows images;
        const PlainGroup& to = step.is_backward ? before.groups[d] : step.groups[d];
        const PlainGroup& from = step.is_backward ? step.groups[d] : before.groups[d];
        for (const PlainVector& cycle : from.classes) {
          PlainVector image(target.basis.generators(d).size(), 0);
          for (std::size_t k = 0; k < cycle.size(); ++k) {
            field_.add(image, cells[k], cycle[k]);
          }
          images.push_back(to.class_of(image, field_));
        }
        step.maps.push_back(images);
        step.cells.push_back(cells);
      } else {
        step.maps.emplace_back();
        step.cells.emplace_back();
      }
    }
    steps_.push_back(std::move(step));
  }
  void take_back(std::uint64_t steps) { steps_.erase(steps_.end() - static_cast<std::ptrdiff_t>(steps), steps_.end()); }

  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  [[nodiscard]] const PlainField& field() const { return field_; }

  [[nodiscard]] std::vector<engine::Bar> bars() const {
    std::vector<engine::Bar> bars;
    for (std::size_t d = 0; d < dimensions; ++d) {
      std::vector<std::size_t> sizes;
      std::vector<PlainRows> maps;
      std::vector<bool> is_backward;
      for (const Step& step : steps_) {
        sizes.push_back(step.groups[d].classes.size());
        maps.push_back(step.maps[d]);
        is_backward.push_back(step.is_backward);
      }
      for (const auto& [dimension, birth, death] :
           plain_bars_of_maps(static_cast<int>(d), sizes, maps, is_backward, field_)) {
        const auto time = [&](std::int64_t k) { return engine::Time{steps_[static_cast<std::size_t>(k)].number}; };
        bars.push_back({dimension, time(birth), death < 0 ? engine::never : time(death)});
      }
    }
    std::sort(bars.begin(), bars.end());
    return bars;
  }

 private:
  PlainRows cell_map(const std::optional<ops::StepSequence<sparse::Integers>>& sequence, ops::StepKind kind,
                     const std::vector<ops::CellId>& from, const std::vector<ops::CellId>& to, int degree) const {
    const auto d = static_cast<std::size_t>(degree);
    if (!sequence) {
      PlainRows identity(from.size(), PlainVector(to.size(), 0));
      for (std::size_t k = 0; k < from.size(); ++k) {
        identity[k][k] = 1;
      }
      return identity;
    }
    const bool is_quotient = kind == ops::StepKind::removal || kind == ops::StepKind::split;
    const auto& map = is_quotient ? sequence->sequence.j : sequence->sequence.i;
    const ops::CellBasis& columns = is_quotient ? sequence->basis1 : sequence->basis0;
    const ops::CellBasis& rows = is_quotient ? sequence->basis2 : sequence->basis1;
    return rows_of(map.at(degree), from, to, rows, degree, columns.generators(d), field_);
  }

  PlainField field_;
  std::vector<Step> steps_;
};

}  // namespace sesame::tests
