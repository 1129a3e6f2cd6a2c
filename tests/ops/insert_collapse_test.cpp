// Insertions and collapses as steps of a structure: cells, names, orientations, bodies, refusals, undo, cost.
#include <map>
#include <set>

#include "ops/plan/step_sequence.hpp"
#include "reductions/defect.hpp"
#include "tests/support/abstract_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Matchers::Contains;

namespace {

void carry_out(Workshop& shop, const Operation& op) {
  if (const Status status = shop.apply(op); !status) {
    FAIL(to_text(op) << ": " << status.error().what);
  }
}
void insert_all(Workshop& shop, const std::vector<std::vector<std::string>>& simplices) {
  for (const auto& simplex : simplices) {
    carry_out(shop, insert(simplex));
  }
}

/// The present cells by their canonical names, in the order of their ages.
Texts names_of(const Workshop& shop) {
  Texts names;
  for (CellId c = 0; c < shop.structure().cells().size(); ++c) {
    if (shop.structure().forest().oldest(c) == c && shop.structure().find(c) != none) {
      names.emplace_back(shop.structure().name(c));
    }
  }
  return names;
}

std::string face_law_defect(const Structure& structure) {
  return first_broken_face_law(structure, cells_at(structure, now(structure))).value_or("");
}

constexpr BodyKind orders_agree{true, true};
constexpr BodyKind orders_differ{true, false};

BodyKind kind_of(const Workshop& shop, const std::string& cell) {
  return shop.structure().bodies().kind(shop.structure().body_of(shop.cell(cell)));
}

/// A star of n triangles around a vertex: {centre, k, k + 1}.
void insert_fan(Workshop& shop, const std::string& centre, int first, int n) {
  for (int k = first; k < first + n; ++k) {
    carry_out(shop, insert({centre, std::to_string(k), std::to_string(k + 1)}));
  }
}

}  // namespace

TEST_CASE("an insertion adds the simplex and its missing faces, oriented by the order of the labels", "[ops]") {
  Workshop shop;
  carry_out(shop, insert({"b", "10", "9"}));
  CHECK(names_of(shop) == Texts{"{9}", "{10}", "{b}", "{9,10}", "{9,b}", "{10,b}", "{9,10,b}"});
  CHECK(faces(shop, "{9,10,b}") == Texts{"{10,b}", "{9,b}", "{9,10}"});
  carry_out(shop, insert({"9", "c"}));
  carry_out(shop, insert({"10", "b", "c"}));
  CHECK(counts(shop) == Counts{4, 6, 2});
  CHECK(faces(shop, "{10,b,c}") == Texts{"{b,c}", "{10,c}", "{10,b}"});
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("{c}"))) == "{9}");
  CHECK(shop.structure().bodies().current().size() == 1);
}

TEST_CASE("a list of simplices is inserted with all faces in one step, by dimension and then by labels", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"insert","simplices":[["b","c"],[10,9,"b"],["b","c","d"],["q"]]})"});
  CHECK(names_of(shop) == Texts{"{9}", "{10}", "{b}", "{c}", "{d}", "{q}", "{9,10}", "{9,b}", "{10,b}", "{b,c}",
                                "{b,d}", "{c,d}", "{9,10,b}", "{b,c,d}"});
  CHECK(faces(shop, "{b,c,d}") == Texts{"{c,d}", "{b,d}", "{b,c}"});
  CHECK(face_law_defect(shop.structure()) == "");
  CHECK(shop.structure().bodies().current().size() == 1);
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("{q}"))) == "{9}");
}

TEST_CASE("a list makes the complex that its simplices make one after the other", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Workshop one, other;
  RandomAbstractSteps steps(seed, 9, 3);
  for (int k = 0; k < 12; ++k) {
    const Operation op = steps.next();
    carry_out(one, op);
    carry_out(other, op);
  }
  const std::vector<std::string> labels = steps.complex().labels();
  Insert list{{}, true};
  Random random(seed);
  for (int k = 0; k < 10; ++k) {
    std::set<std::string> simplex{"new" + std::to_string(random.in(0, 3))};
    while (random.in(0, 2) > 0 && simplex.size() < 5) {
      simplex.insert(labels[static_cast<std::size_t>(random.in(0, static_cast<int>(labels.size()) - 1))]);
    }
    const std::vector<std::string> reversed(simplex.rbegin(), simplex.rend());
    list.simplices.push_back(reversed);
    carry_out(one, Insert{{reversed}, true});
  }
  const std::string before = dump(other.structure());
  const StructureMark mark = mark_of(other.structure());
  const Moment then = now(other.structure());
  carry_out(other, list);
  Texts names_of_one = names_of(one), names_of_other = names_of(other);
  std::sort(names_of_one.begin(), names_of_one.end());
  std::sort(names_of_other.begin(), names_of_other.end());
  CHECK(names_of_one == names_of_other);
  CHECK(face_law_defect(other.structure()) == "");
  const auto step = tests::sequence_between(other.structure(), then, now(other.structure()), sparse::Integers{});
  REQUIRE(step.has_value());
  const auto defect = reductions::first_defect(step->sequence);
  CHECK((defect ? defect->to_string() : "") == "");
  other.go_back_to(mark);
  CHECK(first_difference(dump(other.structure()), before) == "");
}

TEST_CASE("simplices that are there already are counted where that is allowed, and change nothing", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b", "c"}, {"x"}});
  const std::string before = dump(shop.structure());
  shop.build({R"({"op":"insert","simplex":["b","a"],"exist_ok":true})"});
  CHECK(shop.last_plan().already == 1);
  CHECK(shop.last_plan().changes_nothing());
  shop.build({R"({"op":"insert","simplices":[["x"],["a"],["c","b","a"]]})", R"({"op":"insert","simplices":[]})"});
  CHECK(first_difference(dump(shop.structure()), before) == "");
  // What is there already joins no bodies; what is new does, and one that is listed twice is counted once.
  shop.build({R"({"op":"insert","simplices":[["x"],["p","q"],["q","p"]]})"});
  CHECK(shop.last_plan().already == 2);
  CHECK(shop.structure().bodies().current().size() == 3);
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("{q}"))) == "{p}");
  shop.build({R"({"op":"insert","simplices":[["a","b"],["p","x"],["y","a"]]})"});
  CHECK(shop.last_plan().already == 1);
  CHECK(shop.structure().bodies().current().size() == 1);
  CHECK_THAT(refused(shop, R"({"op":"insert","simplices":[["n"],["x"]],"exist_ok":false})").what,
             Contains("{x} is there already"));
}

TEST_CASE("an integer and its decimal text are one label, with leading zeros they are not", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"insert","simplex":[3,"a"]})", R"({"op":"insert","simplex":["3","03"]})"});
  CHECK(counts(shop) == Counts{3, 2});
  CHECK_THAT(refused(shop, R"({"op":"insert","simplex":[3,"3"]})").what, Contains("\"3\" stands twice"));
}

TEST_CASE("a collapse merges, squashes and renames, and all names go on", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b", "u"}, {"b", "u", "v"}, {"a", "v"}, {"u", "w"}});
  carry_out(shop, collapse("u", "v"));
  CHECK(counts(shop) == Counts{4, 4, 1});  // a b v w; ab av bv vw; abv
  CHECK(meaning(shop.structure(), "{u}") == meaning(shop.structure(), "{v}"));
  CHECK(shop.cell("{a,u}") == shop.cell("{a,v}"));
  CHECK(shop.cell("{a,b,u}") == shop.cell("{a,b,v}"));
  CHECK(shop.cell("{u,w}") == shop.cell("{v,w}"));
  CHECK(shop.cell("{w,v}") == shop.cell("{v,w}"));
  CHECK(shop.cell("{u,v}") == none);
  CHECK(shop.cell("{b,u,v}") == none);
  CHECK(meaning(shop.structure(), "{b,u,v}") == "{b,u}^1 of a simplex of dimension 2");
  CHECK(meaning(shop.structure(), "{a,u,v}") == "{a,u}^1 of a simplex of dimension 2");
  CHECK(face_law_defect(shop.structure()) == "");
}

TEST_CASE("collapsing one way or the other gives the same complex, called differently", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 10U));
  CAPTURE(seed);
  Workshop one;
  Workshop other;
  RandomAbstractSteps steps(seed, 8, 3, 1'000'000);
  for (int k = 0; k < 12; ++k) {
    const Operation op = steps.next();
    carry_out(one, op);
    carry_out(other, op);
  }
  const auto labels = steps.complex().labels();
  carry_out(one, collapse(labels[0], labels[1]));
  carry_out(other, collapse(labels[1], labels[0]));
  CHECK(names_of(one) == names_of(other));
  CHECK(counts(one) == counts(other));
  CHECK_THAT(refused(one, insert({labels[0]})).what, Contains("write \"" + labels[1] + "\""));
  CHECK_THAT(refused(other, insert({labels[1]})).what, Contains("write \"" + labels[0] + "\""));
}

TEST_CASE("random insertions and collapses make the complexes that sets of labels say", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Workshop shop;
  RandomAbstractSteps steps(seed, 9, 3);
  std::vector<std::pair<StructureMark, std::string>> past;
  for (int k = 0; k < 60; ++k) {
    past.emplace_back(mark_of(shop.structure()), dump(shop.structure()));
    const Moment before = now(shop.structure());
    const Operation op = steps.next();
    CAPTURE(k, to_text(op));
    carry_out(shop, op);
    REQUIRE(counts(shop) == steps.complex().counts());
    REQUIRE(face_law_defect(shop.structure()) == "");
    for (const auto& simplex : steps.complex().simplices) {
      std::string name;
      for (const std::string& label : simplex) {
        name += (name.empty() ? "{" : ",") + label;
      }
      REQUIRE(shop.cell(name + "}") != none);
    }
    const auto step = tests::sequence_between(shop.structure(), before, now(shop.structure()), sparse::Integers{});
    REQUIRE(step.has_value());
    const auto defect = reductions::first_defect(step->sequence);
    REQUIRE((defect ? defect->to_string() : "") == "");
  }
  for (; !past.empty(); past.pop_back()) {
    shop.go_back_to(past.back().first);
    REQUIRE(first_difference(dump(shop.structure()), past.back().second) == "");
  }
  CHECK(shop.structure().abstract().empty());
}

namespace {

/// What the labels that were ever used are called now, followed by hand.
class LabelsNow {
 public:
  void follow(const Operation& op) {
    if (const auto* inserted = std::get_if<Insert>(&op)) {
      for (const std::string_view label : inserted->simplices[0]) {
        now_.emplace(std::string{label}, std::string{label});
      }
    } else {
      const auto& collapsed = std::get<Collapse>(op);
      for (auto& [label, called] : now_) {
        called = called == collapsed.from ? collapsed.to : called;
      }
    }
  }
  [[nodiscard]] std::vector<std::string> all() const {
    std::vector<std::string> labels;
    for (const auto& [label, called] : now_) {
      labels.push_back(label);
    }
    return labels;
  }
  [[nodiscard]] const std::string& now(const std::string& label) const { return now_.at(label); }

 private:
  std::map<std::string, std::string> now_;
};

std::string listed(const std::vector<std::string>& labels) {
  std::string name;
  for (const std::string& label : labels) {
    name += (name.empty() ? "{" : ",") + label;
  }
  return name + "}";
}

int parity(const std::vector<std::string>& labels) {
  int sign = 1;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (std::size_t j = i + 1; j < labels.size(); ++j) {
      sign = compare_labels(labels[i], labels[j]) > 0 ? -sign : sign;
    }
  }
  return sign;
}

/// "nothing", "degenerate of dimension 2 over {a,b}", or "-{a,b}" for the opposite of {a,b}.
std::string plain_meaning(const std::vector<std::string>& labels, const LabelsNow& now, const SetComplex& complex) {
  std::vector<std::string> called;
  for (const std::string& label : labels) {
    called.push_back(now.now(label));
  }
  const std::set<std::string> simplex(called.begin(), called.end());
  if (!complex.simplices.contains(simplex)) {
    return "nothing";
  }
  std::vector<std::string> sorted(simplex.begin(), simplex.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return compare_labels(a, b) < 0; });
  if (sorted.size() < called.size()) {
    return "degenerate of dimension " + std::to_string(labels.size() - 1) + " over " + listed(sorted);
  }
  return (parity(called) < 0 ? "-" : "") + listed(sorted);
}

/// The same of the structure. A name that lists what labels are called now, sorted, says what is meant.
std::string meaning_of(const Workshop& shop, const std::vector<std::string>& labels, const LabelsNow& now) {
  const auto named = shop.planner().resolve(listed(labels));
  if (!named) {
    return "nothing";
  }
  std::set<std::string> simplex;
  for (const std::string& label : labels) {
    simplex.insert(now.now(label));
  }
  std::vector<std::string> sorted(simplex.begin(), simplex.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return compare_labels(a, b) < 0; });
  const auto plain = shop.planner().resolve(listed(sorted));
  REQUIRE(plain);
  REQUIRE(named->cell == plain->cell);
  const Structure& structure = shop.structure();
  if (named->is_degenerate()) {
    return "degenerate of dimension " + std::to_string(structure.types().info(named->type).dimension) + " over " +
           listed(sorted);
  }
  const VertexMaps& maps = structure.maps();
  return (maps.sign(named->order) == maps.sign(plain->order) ? "" : "-") + listed(sorted);
}

}  // namespace

TEST_CASE("names of labels go on denoting what their simplices become, also where vertices have met", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 15U));
  CAPTURE(seed);
  Workshop shop;
  RandomAbstractSteps steps(seed, 7, 3);
  Random random(seed);
  LabelsNow now;
  std::set<std::vector<std::string>> valid;
  for (int k = 0; k < 40; ++k) {
    const Operation op = steps.next();
    carry_out(shop, op);
    now.follow(op);
    const std::vector<std::string> labels = now.all();
    std::vector<std::vector<std::string>> lists(valid.begin(), valid.end());
    for (int n = 0; n < 60; ++n) {
      std::vector<std::string> list = labels;
      for (std::size_t i = list.size(); i > 1; --i) {
        std::swap(list[i - 1], list[static_cast<std::size_t>(random.in(0, static_cast<int>(i) - 1))]);
      }
      list.resize(std::min(list.size(), static_cast<std::size_t>(random.in(1, 5))));
      lists.push_back(list);
    }
    for (const auto& list : lists) {
      CAPTURE(k, to_text(op), listed(list));
      const std::string wanted = plain_meaning(list, now, steps.complex());
      REQUIRE(meaning_of(shop, list, now) == wanted);
      REQUIRE((wanted != "nothing" || !valid.contains(list)));  // what was valid stays valid
      if (wanted != "nothing" && valid.size() < 400) {
        valid.insert(list);
      }
    }
  }
}

TEST_CASE("a simplex on vertices that have met is degenerate, joined before or not", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "c"}, {"b"}, {"d"}});
  carry_out(shop, collapse("a", "b"));
  CHECK(meaning(shop.structure(), "{b,c}") == "{a,c}");
  carry_out(shop, collapse("b", "c"));
  for (const std::string name : {"{b,c}", "{c,b}", "{a,c}", "{a,b}"}) {
    CHECK(meaning(shop.structure(), name) == "{a}^0 of a simplex of dimension 1");
  }
  CHECK(meaning(shop.structure(), "{a,b,c}") == "{a}^0,1 of a simplex of dimension 2");
  for (const std::string name : {"{a,a}", "{b,d}", "{a,b,d}", "{a,x}"}) {
    CHECK_FALSE(shop.structure().lookup(name));
  }
  CHECK_THAT(refused(shop, R"({"op":"simplex","name":"{b,a}","dim":0})").what, Contains("in use"));
  CHECK_THAT(refused(shop, R"({"op":"deidentify","split":[{"cell":"{b,a}","as":"x","moves":[]}]})").what,
             Contains("is degenerate"));
  // What is glued to it is squashed; a cone over it is taken over the cell that it lies on.
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["{b,a}","e"]]})"});
  CHECK(meaning(shop.structure(), "e") == "{a}^0 of a simplex of dimension 1");
  shop.build({R"({"op":"cone","apex":"v","over":["{a,b}"]})"});
  CHECK(meaning(shop.structure(), "v*{a,b}") == "v*{a}^0 of a simplex of dimension 2");
}

TEST_CASE("a list of labels has as many as a simplex may have vertices", "[ops]") {
  Workshop shop;
  std::vector<std::string> labels{"v0"};
  carry_out(shop, insert({"v0"}));
  for (int k = 1; k < 70; ++k) {
    labels.push_back("v" + std::to_string(k));
    carry_out(shop, insert({labels.back()}));
    carry_out(shop, collapse(labels.back(), "v0"));
    const bool is_named = shop.structure().lookup(listed(labels)).has_value();
    CHECK(is_named == (k <= largest_dimension));
  }
}

TEST_CASE("a name stands for the orientation of its labels in their order", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b"}, {"b", "z"}, {"z", "x"}, {"z", "y"}});
  carry_out(shop, collapse("a", "z"));  // {a,b}, from a to b, becomes {b,z}, from b to z, backwards
  const Structure& structure = shop.structure();
  CHECK(shop.cell("{a,b}") == shop.cell("{b,z}"));
  const auto sign = [&](const std::string& name) {
    return structure.forest().find_oriented(structure.lookup(name).value()).sign * sign_denoted(structure, name);
  };
  CHECK(sign("{a,b}") == -sign("{b,z}"));
  CHECK(structure.name(shop.cell("{b,z}")) == "{a,b}");
  CHECK(sign("{a,b}") == structure.directory().sign_of_name(shop.cell("{a,b}")));
}

TEST_CASE("faces with another order of their vertices are taken with a sign", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b"}, {"z", "p"}, {"z", "q"}});
  carry_out(shop, collapse("a", "z"));  // the edge {a,b} is now that from z to b
  carry_out(shop, insert({"b", "c", "z"}));
  CHECK(kind_of(shop, "{b}") == orders_differ);
  const CellId triangle = shop.cell("{b,c,z}");
  CHECK(shop.structure().faces().sign_as_created(triangle, 1) == 1);  // -1 for face 1, and -1 for the order
  CHECK(shop.structure().cells().type(triangle).faces[1].sign == -1);
  CHECK(face_law_defect(shop.structure()) == "");
}

TEST_CASE("collapses join bodies, and the older name stays", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b"}, {"c", "d", "e"}, {"f"}});
  CHECK(shop.structure().bodies().current().size() == 3);
  carry_out(shop, collapse("d", "a"));
  CHECK(shop.structure().bodies().current().size() == 2);
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("{e}"))) == "{a}");
  CHECK(shop.structure().lookup_body("{c}") == shop.structure().lookup_body("{a}"));
  carry_out(shop, insert({"f", "e"}));
  CHECK(shop.structure().bodies().current().size() == 1);
  CHECK(counts(shop) == Counts{5, 5, 1});
}

TEST_CASE("a chain of collapses leaves every old label usable in names", "[ops]") {
  Workshop shop;
  for (int k = 0; k < 50; ++k) {
    carry_out(shop, insert({"x", "v" + std::to_string(k)}));
  }
  for (int k = 0; k + 1 < 50; ++k) {
    carry_out(shop, collapse("v" + std::to_string(k), "v" + std::to_string(k + 1)));
  }
  CHECK(counts(shop) == Counts{2, 1});
  for (int k = 0; k < 50; ++k) {
    CHECK(shop.cell("{v" + std::to_string(k) + ",x}") == shop.cell("{v49,x}"));
  }
  CHECK_THAT(refused(shop, insert({"v7"})).what, Contains("\"v7\"") && Contains("write \"v49\""));
}

TEST_CASE("the work of a collapse is that of the smaller star, in both directions", "[ops][cost]") {
  const bool small_goes = GENERATE(true, false);
  std::vector<std::uint64_t> work;
  for (const int size : {100, 5000}) {
    Workshop shop;
    insert_fan(shop, "big", 0, size);  // a star of 2 size + 2 cells
    insert_fan(shop, "small", size + 1000, 2);
    const std::uint64_t before = shop.structure().abstract().simplices().touched();
    carry_out(shop, small_goes ? collapse("small", "big") : collapse("big", "small"));
    work.push_back(shop.structure().abstract().simplices().touched() - before);
    CHECK(shop.last_plan().merges.size() == 1);
    CHECK(shop.last_plan().abstract->renamed.size() <= 6);
    const VertexId kept = shop.structure().abstract().vertex(shop.structure().abstract().label("big"));
    CHECK(shop.structure().abstract().star_size(kept) > 200);
    CHECK(shop.cell("{small}") == shop.cell("{big}"));
  }
  CHECK(work[0] == work[1]);
  CHECK(work[1] < 60);
}

TEST_CASE("a cell that is merged again and again is never far from what it is", "[ops][cost]") {
  Workshop shop;
  carry_out(shop, insert({"x", "v0"}));
  const CellId first = shop.cell("{v0,x}");
  for (int k = 1; k <= 9; ++k) {  // each time into a vertex with a larger star
    const std::string next = "v" + std::to_string(k);
    carry_out(shop, insert({"x", next}));
    for (int j = 0; j < 3 << k; ++j) {
      carry_out(shop, insert({next, "y" + std::to_string((4 << k) + j)}));
    }
    carry_out(shop, collapse("v" + std::to_string(k - 1), next));
    CHECK(shop.structure().abstract().vertex(shop.structure().abstract().label(next)) ==
          shop.last_plan().abstract->collapse->kept);
    int steps = 0;
    for (CellId c = first; shop.structure().forest().parent(c) != c; c = shop.structure().forest().parent(c)) {
      ++steps;
    }
    REQUIRE(steps <= 1);
  }
  CHECK(shop.structure().forest().members(shop.cell("{v9,x}")) == 10);
}

TEST_CASE("refused insertions say what would be right, and change nothing", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b", "c"}, {"c", "u"}});
  carry_out(shop, collapse("u", "a"));
  CHECK_THAT(refused(shop, insert({})).what, Contains("at least one vertex"));
  CHECK_THAT(refused(shop, insert({"a", "x", "a"})).what, Contains("\"a\" stands twice"));
  CHECK_THAT(refused(shop, insert({"c", "b", "a"})).what, Contains("{a,b,c} is there already"));
  CHECK_THAT(refused(shop, insert({"u", "x"})).what, Contains("\"u\" was collapsed") && Contains("write \"a\""));
  CHECK_THAT(refused(shop, insert({"x,y"})).what, Contains("\"x,y\" is not a label"));
  CHECK_THAT(refused(shop, insert({"x y"})).what, Contains("not a label"));
  CHECK_THAT(refused(shop, insert({""})).what, Contains("not a label"));
  std::vector<std::string> many;
  for (int k = 0; k < 70; ++k) {
    many.push_back(std::to_string(k));
    if (k == 20 || k == 69) {
      CHECK_THAT(refused(shop, insert(many)).what, Contains("the limit is"));
    }
  }
  CHECK_THAT(refused(shop, Insert{{{"y", "z"}, {"x", "x"}}, true}).what, Contains("\"x\" stands twice"));
  CHECK_THAT(refused(shop, Insert{{{"y", "z"}, {}}, true}).what, Contains("at least one vertex"));
  CHECK_THAT(refused(shop, Insert{{{"y", "z"}, {"u"}}, true}).what, Contains("write \"a\""));
}

TEST_CASE("a list that would make too many cells is refused before they are made", "[ops]") {
  Limits limits;
  limits.cells_per_step = 1000;
  Structure structure;
  Planner planner(structure, limits);
  Plan plan;
  Insert list{{}, true};
  for (int k = 0; k < 100; ++k) {  // 2^18 cells each
    list.simplices.begin_list();
    for (int j = 0; j < 18; ++j) {
      list.simplices.add(std::to_string(100 * k + j));
    }
  }
  CHECK_THAT(planner.plan(list, plan).error().what, Contains("more than 1000 cells"));
  list.simplices.clear();
  list.simplices.push_back({"0", "1", "2", "3", "4", "5", "6", "7", "8"});  // 2^9 - 1
  CHECK(planner.plan(list, plan));
}

TEST_CASE("refused collapses say what would be right, and change nothing", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b", "c"}, {"c", "u"}});
  carry_out(shop, collapse("u", "a"));
  CHECK_THAT(refused(shop, collapse("a", "x")).what, Contains("no vertex \"x\"") && Contains("\"insert\""));
  CHECK_THAT(refused(shop, collapse("x", "a")).what, Contains("no vertex \"x\""));
  CHECK_THAT(refused(shop, collapse("a", "a")).what, Contains("into itself"));
  CHECK_THAT(refused(shop, collapse("u", "b")).what, Contains("write \"a\""));
  CHECK_THAT(refused(shop, collapse("b", "u")).what, Contains("write \"a\""));
}

TEST_CASE("other cells are never touched, whatever they are called", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"{p,q}","dim":0})"});
  CHECK_THAT(refused(shop, collapse("a", "a.0")).what, Contains("no vertex \"a\""));
  CHECK_THAT(refused(shop, insert({"p", "q"})).what, Contains("\"{p,q}\"") && Contains("in use"));
  insert_all(shop, {{"a", "b"}, {"p"}, {"q", "b"}});
  CHECK(shop.cell("{a}") != shop.cell("a.0"));
  // By the collapse a name comes to denote a simplex, and no new cell may take it.
  carry_out(shop, insert({"u", "b"}));
  carry_out(shop, insert({"v"}));
  carry_out(shop, collapse("u", "v"));
  CHECK_THAT(refused(shop, R"({"op":"simplex","name":"{b,v}","dim":0})").what, Contains("in use"));
}

TEST_CASE("other operations take an abstract body whose orders agree, and end its being one", "[ops]") {
  const std::vector<std::string> operations{
      R"({"op":"identify","pairs":[["{a}","{c}"]]})",
      R"({"op":"degenerate","cell":"{a,b,c}","along":0})",
      R"({"op":"deidentify","split":[{"cell":"{b}","as":"b2","moves":[["{b,d}",1]]}]})",
      R"({"op":"cone","apex":"top","over":["{a,b}"]})",
      R"({"op":"cone","apex":"top"})",
      R"({"op":"product","name":"P","left":"{a}","right":"{a}"})",
      R"({"op":"product","name":"P","left":"{a}","right":"{s}","kind":"simplicial"})"};
  for (const std::string& line : operations) {
    CAPTURE(line);
    Workshop shop;
    insert_all(shop, {{"a", "b", "c"}, {"b", "d"}, {"d", "x"}, {"s", "t"}});
    carry_out(shop, collapse("x", "c"));
    CHECK(kind_of(shop, "{a}") == orders_agree);
    const std::string before = dump(shop.structure());
    const StructureMark mark = mark_of(shop.structure());
    shop.build({line});
    CHECK(face_law_defect(shop.structure()) == "");
    CHECK_THAT(refused(shop, insert({"a", "q"})).what, Contains("changed by another operation"));
    CHECK_THAT(refused(shop, collapse("a", "b")).what, Contains("changed by another operation"));
    CHECK_THAT(refused(shop, collapse("x", "b")).what, Contains("write \"c\""));
    carry_out(shop, insert({"new", "newer"}));
    shop.go_back_to(mark);
    CHECK(first_difference(dump(shop.structure()), before) == "");
    CHECK(kind_of(shop, "{a}") == orders_agree);
    carry_out(shop, collapse("a", "b"));
  }
}

TEST_CASE("an operation without an effect leaves an abstract body what it is", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b"}, {"b", "c"}});
  shop.build({R"({"op":"identify","pairs":[["{a}","{a}"]]})", R"({"op":"simplex","name":"t","dim":1})"});
  carry_out(shop, collapse("a", "c"));
  CHECK(counts(shop) == Counts{4, 2});
}

TEST_CASE("other operations work where vertex orders do not agree, and the face laws hold", "[ops]") {
  // Squashed across a vertex; two edges merged head to tail; a new face of another order.
  const std::vector<std::vector<Operation>> ways{
      {insert({"a", "b", "c"}), collapse("c", "a")},
      {insert({"a", "b"}), insert({"b", "c"}), collapse("c", "a")},
      {insert({"a", "b"}), insert({"z", "p"}), collapse("a", "z"), insert({"b", "c", "z"})}};
  for (const auto& way : ways) {
    Workshop shop;
    carry_out(shop, insert({"other"}));
    for (const Operation& op : way) {
      carry_out(shop, op);
    }
    CHECK(kind_of(shop, "{b}") == orders_differ);
    CHECK(face_law_defect(shop.structure()) == "");
    const std::string before = dump(shop.structure());
    const StructureMark mark = mark_of(shop.structure());
    for (const std::string line :
         {R"({"op":"identify","pairs":[["{other}","{b}"]]})", R"({"op":"degenerate","cell":"{a,b}","along":0})",
          R"({"op":"deidentify","split":[{"cell":"{b}","as":"b2","moves":[]}]})",
          R"({"op":"cone","apex":"top","over":["{b}"]})", R"({"op":"cone","apex":"top"})",
          R"({"op":"suspend","apexes":["up","down"]})",
          R"({"op":"product","name":"P","left":"{a}","right":"{other}"})"}) {
      CAPTURE(line);
      shop.build({line});
      CHECK(face_law_defect(shop.structure()) == "");
      shop.go_back_to(mark);
      CHECK(first_difference(dump(shop.structure()), before) == "");
    }
    CHECK_THAT(refused(shop, R"({"op":"product","name":"P","left":"{other}","right":"{a}","kind":"simplicial"})").what,
               Contains("another order") && Contains("a simploidal one takes all"));
  }
}

TEST_CASE("joining a body keeps track of whose orders agree, through undo", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"p", "q"}, {"a", "b", "c"}});
  const StructureMark apart = mark_of(shop.structure());
  carry_out(shop, collapse("c", "a"));
  CHECK(kind_of(shop, "{a}") == orders_differ);
  CHECK(kind_of(shop, "{p}") == orders_agree);
  const StructureMark unordered = mark_of(shop.structure());
  carry_out(shop, insert({"a", "p"}));
  CHECK(kind_of(shop, "{p}") == orders_differ);
  shop.go_back_to(unordered);
  CHECK(kind_of(shop, "{p}") == orders_agree);
  carry_out(shop, collapse("p", "b"));
  CHECK(kind_of(shop, "{q}") == orders_differ);
  shop.go_back_to(apart);
  CHECK(kind_of(shop, "{a}") == orders_agree);
  CHECK(kind_of(shop, "{q}") == orders_agree);
  CHECK(shop.structure().bodies().current().size() == 2);
}

TEST_CASE("a product knows the cells of an abstract factor by all their names", "[ops]") {
  Workshop shop;
  insert_all(shop, {{"a", "b"}, {"u"}});
  carry_out(shop, collapse("u", "b"));
  shop.build({R"({"op":"simplex","name":"I","dim":1})", R"({"op":"product","name":"P","left":"{a}","right":"I"})"});
  CHECK(shop.cell("P.({a,u}|I)") == shop.cell("P.({a,b}|I)"));
  CHECK(shop.cell("P.({u}|I.0)") == shop.cell("P.({b}|I.0)"));
}
