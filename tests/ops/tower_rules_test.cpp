#include "ops/simplicial/tower_rules.hpp"

#include <map>

#include "ops/simplicial/abstract_complex.hpp"
#include "ops/simplicial/tower_complex.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"

namespace sesame {
namespace {

using ops::Label;
using ops::TowerRules;
using tests::TowerStep;

/// The complex of a tower with cells and labels that stay for ever, as the structure of an engine has it.
class CellTower {
 public:
  [[nodiscard]] TowerRules rules() const {
    return {complex_.simplices(), [this](Label label) {
              const auto known = label_.find(label);
              return known == label_.end() || complex_.is_contracted(known->second) ? ops::none
                                                                                    : complex_.vertex(known->second);
            }};
  }

  void apply(const TowerStep& step) {
    if (step.is_contraction) {
      contract(label_.at(step.labels[0]), label_.at(step.labels[1]));
      return;
    }
    if (step.labels.size() == 1) {
      label_[step.labels[0]] = complex_.add_label(std::to_string(complex_.labels()));
    }
    std::vector<ops::VertexId> vertices;
    for (const Label label : step.labels) {
      vertices.push_back(complex_.vertex(label_.at(label)));
    }
    complex_.include(next_cell_++, vertices);
  }

 private:
  void contract(ops::LabelId from, ops::LabelId to) {
    ops::VertexId moved = complex_.vertex(from), kept = complex_.vertex(to);
    if (complex_.star_size(moved) > complex_.star_size(kept)) {
      std::swap(moved, kept);
    }
    for (const ops::CellId cell : complex_.star(moved)) {
      if (complex_.fate_of(cell, moved, kept).fate == ops::SimplexIndex::Fate::renamed) {
        complex_.rename(cell, moved, kept);
      } else {
        complex_.exclude(cell);
      }
    }
    complex_.contract_labels(from, to, kept);
  }

  ops::AbstractComplex complex_;
  std::map<Label, ops::LabelId> label_;
  ops::CellId next_cell_ = 0;
};

/// What is said of an operation; nothing when it is allowed.
std::string said(const Status& status) { return status ? "" : status.error().what; }

TEST_CASE("what a tower may not do is said in the same words, whatever keeps its complex", "[ops][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  ops::TowerComplex complex;
  CellTower cells;
  std::mt19937 random(seed);
  std::size_t refused = 0;
  for (const TowerStep& step : tests::random_tower(seed, 80, 8, seed % 5)) {
    REQUIRE(said(step.is_contraction ? cells.rules().check_contraction(step.labels[0], step.labels[1])
                                     : cells.rules().check_inclusion(step.labels)) == "");
    tests::apply(step, complex);
    cells.apply(step);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<Label> labels(1 + random() % 4);
      std::ranges::generate(labels, [&] { return random() % 9; });
      CHECK(complex.rules().contains(labels) == cells.rules().contains(labels));
      const Status status = complex.rules().check_inclusion(labels);
      const Status other = cells.rules().check_inclusion(labels);
      REQUIRE(status.has_value() == other.has_value());
      if (!status) {
        CHECK(status.error().code == other.error().code);
        // Which of several faces that are missing is named depends on the numbers of vertices.
        if (status.error().what.find("the face") == std::string::npos) {
          CHECK(status.error().what == other.error().what);
        }
        CHECK(complex.include(labels).error().what == status.error().what);
        ++refused;
      }
      if (labels.size() == 2) {
        CHECK(said(complex.rules().check_contraction(labels[0], labels[1])) ==
              said(cells.rules().check_contraction(labels[0], labels[1])));
      }
      const auto faces = complex.rules().missing_faces(labels);
      const auto others = cells.rules().missing_faces(labels);
      REQUIRE(faces.has_value() == others.has_value());
      if (faces) {
        CHECK(*faces == *others);
      }
    }
  }
  CHECK(refused > 100);
}

}  // namespace
}  // namespace sesame
