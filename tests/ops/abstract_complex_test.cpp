// Labels, vertex sets and stars, beside sets of sets.
#include "ops/simplicial/abstract_complex.hpp"

#include "tests/support/abstract_steps.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::ops;
using namespace sesame::tests;

namespace {

using Vertices = std::vector<VertexId>;

/// The simplices as sets of labels, found through the stars; each must be found by its vertices and by its name.
std::set<std::set<std::string>> simplices_of(const AbstractComplex& complex) {
  std::set<std::set<std::string>> simplices;
  for (LabelId label = 0; label < complex.labels(); ++label) {
    if (complex.is_contracted(label)) {
      continue;
    }
    const std::vector<CellId> star = complex.star(complex.vertex(label));
    CHECK(star.size() == complex.star_size(complex.vertex(label)));
    for (const CellId cell : star) {
      const auto own = complex.vertices(cell);
      CHECK(complex.find(own) == cell);
      Vertices backwards(own.rbegin(), own.rend());
      CHECK(complex.find(backwards) == cell);
      std::set<std::string> simplex;
      std::string name;
      for (const VertexId v : own) {
        simplex.emplace(complex.text(complex.label_of(v)));
        name += (name.empty() ? "{" : ",") + std::string{complex.text(complex.label_of(v))};
      }
      CHECK(complex.find_named(name + "}").value().cell == cell);
      simplices.insert(simplex);
    }
  }
  return simplices;
}

/// Carries an operation out without any planner: the slow way.
void apply(AbstractComplex& complex, CellId& next_cell, const Insert& op) {
  const NameLists::List labels = *op.simplices.begin();
  const std::vector<std::string> simplex(labels.begin(), labels.end());
  for (std::uint64_t subset = 1; subset < std::uint64_t{1} << simplex.size(); ++subset) {
    Vertices vertices;
    for (std::size_t k = 0; k < simplex.size(); ++k) {
      if ((subset >> k & 1) != 0) {
        const LabelId known = complex.label(simplex[k]);
        vertices.push_back(complex.vertex(known == none ? complex.add_label(simplex[k]) : known));
      }
    }
    if (complex.find(vertices) == none) {
      complex.include(next_cell++, vertices);
    }
  }
}

void apply(AbstractComplex& complex, const Collapse& op) {
  const VertexId gone = complex.vertex(complex.label(op.from));
  const VertexId kept = complex.vertex(complex.label(op.to));
  for (const CellId cell : complex.star(gone)) {
    Vertices vertices(complex.vertices(cell).begin(), complex.vertices(cell).end());
    std::replace(vertices.begin(), vertices.end(), gone, kept);
    const bool is_squashed = std::count(vertices.begin(), vertices.end(), kept) > 1;
    if (is_squashed || complex.find(vertices) != none) {
      complex.exclude(cell);
    } else {
      complex.rename(cell, gone, kept);
    }
  }
  complex.contract_labels(complex.label(op.from), complex.label(op.to), kept);
}

}  // namespace

TEST_CASE("integer labels come before others, by value, and those by their bytes", "[ops]") {
  const std::vector<std::string> sorted{
      "0",  "7", "10",      "99999999999999999999", "100000000000000000000", "!", "007", "10x", "A", "a",
      "aa", "b", "\xc3\xa9"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      CHECK((compare_labels(sorted[i], sorted[j]) < 0) == (i < j));
    }
  }
}

TEST_CASE("a label is a name without braces and commas", "[ops]") {
  for (const std::string label : {"a", "0", "u*v", "w.(x|y)", "\xc3\xa9"}) {
    CHECK(is_label(label));
  }
  for (const std::string text : {"", "a b", "a,b", "{a", "a}", "\x01", "\xc3", "\xc2\xa0"}) {
    CHECK_FALSE(is_label(text));
  }
}

TEST_CASE("the places of vertices in another order are those where the other order has them", "[ops]") {
  using Places = std::vector<std::uint8_t>;
  CHECK(places_in(Vertices{5}, Vertices{5}) == Places{0});
  CHECK(places_in(Vertices{5, 7}, Vertices{7, 5}) == Places{1, 0});
  CHECK(places_in(Vertices{1, 2, 3}, Vertices{2, 3, 1}) == Places{1, 2, 0});
  CHECK(places_in(Vertices{}, Vertices{}).empty());
}

TEST_CASE("random changes do to stars and names what they do to sets of labels, and can be taken back", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  RandomAbstractSteps steps(seed, 9, 3);
  AbstractComplex complex;
  CellId next_cell = 100;  // other cells may lie between
  std::vector<std::pair<std::uint32_t, SetComplex>> past;
  Random random(seed);
  for (int k = 0; k < 60; ++k) {
    past.emplace_back(complex.mark(), steps.complex());
    const Operation op = steps.next();
    CAPTURE(k, to_text(op));
    if (const auto* inserted = std::get_if<Insert>(&op)) {
      apply(complex, next_cell, *inserted);
    } else {
      apply(complex, std::get<Collapse>(op));
    }
    next_cell += 3;
    if (random.one_in(4)) {
      const auto back = past.begin() + random.in(0, static_cast<int>(past.size()) - 1);
      complex.truncate(back->first);
      steps.go_back_to(back->second);
      past.erase(back, past.end());
    }
    REQUIRE(simplices_of(complex) == steps.complex().simplices);
    for (const std::string& label : steps.complex().dead) {
      CHECK(complex.is_contracted(complex.label(label)));
    }
  }
  complex.truncate(0);
  CHECK(complex.empty());
  CHECK(complex.label("0") == none);
  CHECK_FALSE(complex.contains(100));
}

TEST_CASE("names that are no list of known labels, or repeat a vertex, denote no simplex", "[ops]") {
  AbstractComplex complex;
  const LabelId a = complex.add_label("a");
  const LabelId b = complex.add_label("b");
  complex.include(0, Vertices{complex.vertex(a)});
  complex.include(1, Vertices{complex.vertex(b)});
  complex.include(2, Vertices{complex.vertex(b), complex.vertex(a)});
  CHECK(complex.find_named("{a,b}").value().cell == 2);
  CHECK(complex.find_named("{a,b}").value().places == std::vector<std::uint8_t>{1, 0});
  CHECK(complex.find_named("{b,a}").value().places == std::vector<std::uint8_t>{0, 1});
  for (const std::string name :
       {"", "{}", "{", "}", "a", "{a", "a}", "{a,}", "{,a}", "{a,a}", "{a,c}", "{a,b,}", "[a]"}) {
    CAPTURE(name);
    CHECK_FALSE(complex.find_named(name).has_value());
  }
}
