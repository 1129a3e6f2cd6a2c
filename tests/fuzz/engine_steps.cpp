// The engine, driven by bytes through all operations over Z, Z/2, Z/3 and Q. Most steps are drawn so that they are
// legal; now and then every law is checked, the groups are worked out anew, steps are taken back and done again.
#include <optional>
#include <vector>

#include "tests/fuzz/draws.hpp"
#include "tests/fuzz/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using Steps = DrawnSteps<ByteDraws>;

constexpr int most_steps = 60, most_checks = 2;
constexpr std::uint64_t most_checked = 60;  ///< cells of an object whose laws are checked

const char* const rings[] = {"Z", "Z/2", "Z/3", "Q"};

/// Any node, by the name that it was made with: of cells that were merged or squashed, too, and of those consumed.
std::optional<std::string> any_name(const ops::Structure& structure, ByteDraws& draws) {
  if (structure.cells().size() == 0) {
    return std::nullopt;
  }
  std::vector<ops::CellId> nodes;
  structure.cells().for_each_node([&](ops::CellId c) { nodes.push_back(c); });
  if (nodes.empty()) {
    return std::nullopt;
  }
  return structure.directory().own_name(
      nodes[static_cast<std::size_t>(draws.in(0, static_cast<int>(std::min<std::size_t>(nodes.size(), 4096)) - 1))]);
}

/// Two cells of one type, glued by a map of their vertices.
std::optional<ops::Operation> twist(const ops::Structure& structure, ByteDraws& draws) {
  const std::vector<ops::CellId> cells = current_cells(structure);
  if (cells.empty()) {
    return std::nullopt;
  }
  const auto any = [&] { return cells[static_cast<std::size_t>(draws.in(0, static_cast<int>(cells.size()) - 1))]; };
  const ops::CellId a = any(), b = any();
  ops::Identify::Map map;
  if (ops::is_of_map(structure.cells().type(a).type)) {  // which has no vertices in order
    return std::nullopt;
  }
  for (const int dimension : structure.cells().type(a).type) {
    std::vector<int> vertices;
    for (int v = 0; v <= dimension; ++v) {
      vertices.insert(vertices.begin() + draws.in(0, static_cast<int>(vertices.size())), v);
    }
    map.push_back(std::move(vertices));
  }
  ops::Identify identify{{{structure.name(a), structure.name(b)}}, {}};
  if (!map.empty()) {
    identify.maps[0] = std::move(map);
  }
  return identify;
}

std::string any_label(ByteDraws& draws) { return std::to_string(draws.in(0, 8)); }

ops::Operation insertion(ByteDraws& draws) {
  std::vector<std::vector<std::string>> simplices;
  for (int count = draws.one_in(4) ? draws.in(2, 4) : 1; count > 0; --count) {
    std::vector<std::string> simplex;
    for (int size = draws.in(1, 4); size > 0; --size) {
      simplex.push_back(any_label(draws));
    }
    simplices.push_back(std::move(simplex));
  }
  ops::Insert insert{{}, draws.one_in(2)};
  for (auto& simplex : simplices) {
    insert.simplices.push_back(simplex);
  }
  return insert;
}

/// A complex whose faces are drawn, so that the face laws often fail.
ops::Operation any_complex(const std::string& name, ByteDraws& draws) {
  ops::MakeComplex complex{name, {}};
  const int cells = draws.in(1, 6);
  for (int k = 0; k < cells; ++k) {
    ops::ListedCell cell{"c" + std::to_string(k), {}, {}, {}};
    for (int faces = k == 0 ? 0 : draws.in(0, 4); faces > 0; --faces) {
      cell.faces.push_back("c" + std::to_string(draws.in(0, k - 1)));
    }
    complex.cells.push_back(cell);
  }
  return complex;
}

/// What the homology is, so that it has to be accepted; or something beside it, so that it has to be refused.
std::pair<ops::Expect, bool> expectation(Engine& engine, ByteDraws& draws) {
  const engine::Homology homology = engine.homology();
  ops::Expect expect;
  expect.betti.emplace(homology.betti.begin(), homology.betti.end());
  expect.torsion = homology.torsion;
  expect.euler = engine.euler_characteristic();
  expect.cells.emplace();
  for (const std::uint64_t cells : engine.cells()) {
    expect.cells->emplace_back(static_cast<std::int64_t>(cells));
  }
  const bool is_true = !draws.one_in(4) || expect.betti->empty();
  if (!is_true) {
    sparse::Integer& wrong =
        (*expect.betti)[static_cast<std::size_t>(draws.in(0, static_cast<int>(expect.betti->size()) - 1))];
    wrong = wrong + sparse::Integer{1};
  }
  return {expect, is_true};
}

class Session {
 public:
  explicit Session(ByteDraws draws)
      : draws_{draws},
        engine_{sparse::parse_ring(rings[draws_.in(0, 3)]).value(), small_limits, policy(draws_), {}, few_cells},
        steps_{draws, everything_and_maps(static_cast<std::size_t>(draws_.in(8, 40)))} {}

  void run() {
    for (int k = 0; k < most_steps && !draws_.is_done(); ++k) {
      step();
    }
    check_laws();
  }

 private:
  static engine::RebasePolicy policy(ByteDraws& draws) {
    switch (draws.in(0, 2)) {
      case 0:
        return {};
      case 1:  // splits are taken in
        return {.cells_begun_at_once = 0, .cells_per_move = 0};
      default:
        return engine::RebasePolicy::never();
    }
  }

  void step() {
    const int kind = draws_.in(0, 31);
    if (kind < 15) {
      take(steps_.next(engine_.structure()));
    } else if (kind < 18) {
      take(insertion(draws_));
    } else if (kind == 18) {
      take(ops::Collapse{any_label(draws_), any_label(draws_)});
    } else if (kind == 19) {
      take_if(twist(engine_.structure(), draws_));
    } else if (kind == 20) {
      glue_any_names();
    } else if (kind == 21) {
      take(any_complex("k" + std::to_string(engine_.log().size()), draws_));
    } else if (kind < 24) {
      const auto [expect, is_true] = expectation(engine_, draws_);
      demand(attempt(engine_, expect) == is_true, "an expectation is met exactly when it is true");
    } else if (kind < 26) {
      ask_for_a_class();
    } else if (kind < 28) {
      attempt(engine_, ops::Undo{static_cast<std::uint64_t>(draws_.in(0, 6))});
    } else if (kind == 28) {
      attempt(engine_, ops::Note{"note"});
    } else if (kind == 29) {
      check_generators();
    } else {
      check_laws();
    }
  }

  /// A step that is taken, taken back and taken once more comes to the same as one that is taken once.
  void take(const ops::Operation& operation) {
    const std::string before = state_of(engine_);
    if (!attempt(engine_, operation) || !draws_.one_in(8)) {
      return;
    }
    const std::string after = state_of(engine_);
    demand(engine_.undo().has_value(), "a step that was taken can be taken back");
    demand_equal(before, state_of(engine_), "undo gives back what was before");
    demand(engine_.apply(operation).has_value(), "a step that was taken back can be taken again");
    demand_equal(after, state_of(engine_), "and comes to the same");
  }
  void take_if(const std::optional<ops::Operation>& operation) {
    if (operation) {
      take(*operation);
    }
  }

  void glue_any_names() {
    const auto a = any_name(engine_.structure(), draws_), b = any_name(engine_.structure(), draws_);
    if (a && b) {
      take(ops::Identify{{{*a, *b}}, {}});
    }
  }

  /// The class of a boundary is 0, and what it bounds has it as its boundary.
  void ask_for_a_class() {
    const std::vector<ops::CellId> cells = current_cells(engine_.structure());
    if (cells.empty()) {
      return;
    }
    ops::AskClass ask;
    const ops::CellId first = cells[static_cast<std::size_t>(draws_.in(0, static_cast<int>(cells.size()) - 1))];
    for (int terms = draws_.in(1, 4); terms > 0; --terms) {
      const ops::CellId c = cells[static_cast<std::size_t>(draws_.in(0, static_cast<int>(cells.size()) - 1))];
      if (engine_.structure().dimension(c) == engine_.structure().dimension(first)) {
        ask.chain.emplace_back(draws_.in(-3, 3), engine_.structure().name(c));
      }
    }
    if (!ask.chain.empty()) {
      attempt(engine_, ask);
    }
    const engine::CellChain cell{engine_.structure().dimension(first), {{1, first}}};
    const engine::CellChain boundary = engine_.maps().boundary(cell);
    if (boundary.terms.empty()) {
      return;
    }
    const engine::ClassAnswer answer = engine_.classify(boundary);
    demand(answer.is_cycle && answer.is_zero && answer.bounds.has_value(), "the class of a boundary is 0");
    demand(engine_.maps().boundary(*answer.bounds).terms == boundary.terms, "a boundary bounds what is said");
  }

  /// There are as many as the groups say; each is a cycle, and of its own class.
  void check_generators() {
    const engine::Homology homology = engine_.homology();
    for (std::size_t p = 0; p < homology.betti.size(); ++p) {
      const std::vector<engine::Generator> generators = engine_.generators(static_cast<int>(p));
      demand(generators.size() == static_cast<std::size_t>(homology.betti[p]) + homology.torsion[p].size(),
             "as many generators as the group has");
      for (std::size_t k = 0; k < generators.size(); ++k) {
        const engine::ClassAnswer answer = engine_.classify(generators[k].cycle);
        demand(answer.is_cycle && answer.coefficients.size() == generators.size(), "a generator is a cycle");
        for (std::size_t j = 0; j < generators.size(); ++j) {
          demand(answer.coefficients[j] == sparse::Rational{j == k ? 1 : 0}, "a generator is of its own class");
        }
      }
    }
  }

  void check_laws() {
    if (checks_ < most_checks && number_of_cells(engine_) <= most_checked) {
      ++checks_;
      demand_laws(engine_);
    }
  }

  ByteDraws draws_;
  Engine engine_;
  Steps steps_;
  int checks_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Session(ByteDraws(text_of(data, size))).run();
  return 0;
}
