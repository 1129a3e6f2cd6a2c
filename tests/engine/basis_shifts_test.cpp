#include "engine/left/basis_shifts.hpp"

#include "tests/support/left_side.hpp"

using namespace sesame;
using namespace sesame::tests;
using sparse::Integers;

namespace {

using Row = std::vector<int>;

/// What the present generators are in those as created, a row each; and which node has which.
struct PlainBasis {
  std::vector<Row> rows;
  std::vector<std::vector<GeneratorId>> generators_of;

  void append() {
    const std::size_t at = rows.size();
    for (Row& row : rows) {
      row.push_back(0);
    }
    rows.emplace_back(at + 1, 0).back() = 1;
    generators_of.push_back({GeneratorId{at}});
  }
  void shift(std::size_t node, std::size_t copy) {
    for (const GeneratorId generator : generators_of[node]) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[generator][k] += rows[copy][k];
      }
      generators_of[copy].push_back(generator);
    }
    generators_of[node].clear();
  }
};

/// The node that a generator was made for: here there is one for each.
CellId node_of(GeneratorId generator) { return CellId{std::uint32_t{generator}}; }

void check(const engine::BasisShifts<Integers>& shifts, const PlainBasis& plain) {
  for (GeneratorId x = 0; x < plain.rows.size(); ++x) {
    sparse::RawTerms<Integers, GeneratorId> as_created;
    shifts.add_as_created(x, Integers::Element{2}, as_created);
    Row sum(plain.rows.size(), 0);
    for (const auto& [index, coefficient] : as_created) {
      for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += static_cast<int>(coefficient.to_int64().value()) * plain.rows[index][k];
      }
    }
    Row twice(plain.rows.size(), 0);
    twice[x] = 2;
    REQUIRE(sum == twice);
    // What was added: with the e as created, that is the present generator.
    Row present(plain.rows.size(), 0);
    present[x] = 1;
    for (const GeneratorId e : shifts.added_to(x)) {
      ++present[e];
      const auto with = shifts.with(e);
      REQUIRE(std::find(with.begin(), with.end(), x) != with.end());
    }
    REQUIRE(present == plain.rows[x]);
    REQUIRE(shifts.generators_of(node_of(x)) == plain.generators_of[x]);
  }
}

}  // namespace

TEST_CASE("generators as created are what a matrix of the present basis says, through undo", "[engine][left]") {
  Random random(GENERATE(range(0U, 8U)));
  constexpr std::uint32_t most = 16;
  Workshop shop;
  for (std::uint32_t k = 0; k < most; ++k) {  // node k is a vertex: enough to shift
    REQUIRE(shop.apply(ops::MakeSimplex{"p" + std::to_string(k), 0, {}}));
  }
  const engine::Window window(shop.structure());
  engine::Generators generators(window);
  engine::BasisShifts<Integers> shifts(Integers{}, generators);
  struct State {
    engine::Generators::Mark generators;
    std::size_t shifts;
    PlainBasis plain;
  };
  PlainBasis plain;
  std::vector<State> states;
  for (int step = 0; step < 60; ++step) {
    if (!states.empty() && (generators.size() == most || random.one_in(5))) {
      const auto back = static_cast<std::size_t>(random.in(0, static_cast<int>(states.size()) - 1));
      shifts.truncate(states[back].shifts, states[back].generators.generators);
      generators.truncate(states[back].generators);
      plain = states[back].plain;
      states.resize(back);
    } else {
      states.push_back({generators.mark(), shifts.mark(), plain});
      const GeneratorId copy = generators.append_cell(generators.cells());
      plain.append();
      if (copy > 0 && !random.one_in(3)) {
        const auto node = static_cast<unsigned>(random.in(0, static_cast<int>(copy) - 1));
        shifts.shift(ops::CellId{node}, node_of(copy));
        plain.shift(node, copy);
      }
    }
    REQUIRE(generators.size() == plain.rows.size());
    check(shifts, plain);
  }
}
