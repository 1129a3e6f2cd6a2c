// Generators after each step, which step made a class, and which one ended it.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "replay/page/page_writer.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// The classes of a script, followed from step to step.
class Classes {
 public:
  explicit Classes(const std::string& script, const replay::PageLimits& limits = {}) : history{limits} {
    replay::ReplayOptions options;
    options.engine = &engine;
    options.observer = [this](const ops::Operation& operation, const engine::StepReport& report) {
      history.take(*engine, operation, report);
    };
    CHECK(replay_text(script, nullptr, options).errors.empty());
  }
  Classes(const Classes&) = delete;
  Classes& operator=(const Classes&) = delete;
  ~Classes() = default;

  /// Those of a degree that are generators after so many steps.
  [[nodiscard]] std::vector<std::uint32_t> after(std::size_t steps, int degree) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t number : history.steps()[steps - 1].generators.value()) {
      if (all()[number].degree == degree) {
        found.push_back(number);
      }
    }
    return found;
  }
  /// The steps that made them, ascending.
  [[nodiscard]] std::vector<std::uint32_t> ages(std::size_t steps, int degree) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t number : after(steps, degree)) {
      found.push_back(all()[number].since.value());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  [[nodiscard]] const std::vector<replay::PageClass>& all() const { return history.generators().classes(); }
  [[nodiscard]] const auto& ended(std::size_t steps) const { return history.steps()[steps - 1].ended; }

  std::unique_ptr<engine::Engine> engine;
  replay::PageHistory history;
};

std::string script(const std::vector<std::string>& steps, const std::string& ring = "Z") {
  return joined({R"({"sesame":1,"ring":")" + ring + "\"}"}) + joined(steps);
}

using Ages = std::vector<std::uint32_t>;
using Ended = std::vector<std::pair<std::uint32_t, replay::ClassEnd>>;

const std::string edge = R"({"op":"simplex","name":"e","dim":1})";
const std::string loop = R"({"op":"identify","pairs":[["e.0","e.1"]]})";

}  // namespace

TEST_CASE("the sides of a torus are classes from the step on that glues them", "[classes]") {
  const Classes classes(
      script({R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"identify","pairs":[["q.0-1x0","q.0-1x1"]]})",
              R"({"op":"identify","pairs":[["q.0x0-1","q.1x0-1"]]})", R"({"op":"note","text":"x"})"}));
  CHECK(classes.ages(1, 0) == Ages{0});
  CHECK(classes.ages(2, 1) == Ages{1});
  CHECK(classes.ages(3, 1) == Ages{1, 2});
  CHECK(classes.ages(3, 2) == Ages{2});
  CHECK(classes.after(3, 1) == classes.after(4, 1));  // the same numbers: nothing is told again
  for (std::size_t steps = 1; steps <= 4; ++steps) {
    CHECK(classes.ended(steps).empty());
  }
}

TEST_CASE("a class ends where its cycle comes to bound", "[classes]") {
  const Classes classes(script({edge, loop, R"({"op":"cone","apex":"v"})"}));
  const Ages circle = classes.after(2, 1);
  REQUIRE(circle.size() == 1);
  CHECK(classes.ended(3) == Ended{{circle[0], replay::ClassEnd::bounds}});
  CHECK(classes.after(3, 1).empty());
  CHECK(classes.ages(3, 0) == Ages{0});
}

TEST_CASE("over Z a class is made by the step that brings what is no multiple", "[classes]") {
  // A circle of two edges; its double, which is a circle of a Moebius band, comes first: 2 g is older than g.
  const std::string band = R"({"op":"complex","name":"M","cells":[{"id":"v"},{"id":"b","faces":["v","v"]},)"
                           R"({"id":"c","faces":["v","v"]},{"id":"t","faces":["c","b","c"]}]})";
  const std::string glue = R"({"op":"identify","pairs":[["M.b","e"]]})";
  const Classes integral(script({edge, loop, band, glue}));
  CHECK(integral.ages(2, 1) == Ages{1});
  CHECK(integral.ages(4, 1) == Ages{2});
  const Classes rational(script({edge, loop, band, glue}, "Q"));
  CHECK(rational.ages(4, 1) == Ages{1});  // half of it
  const Classes mod2(script({edge, loop, band, glue}, "Z/2"));
  CHECK(mod2.ages(4, 1) == Ages{2});  // twice is nothing
}

TEST_CASE("torsion is as old as what generates it", "[classes]") {
  const std::string disc = R"({"op":"complex","name":"D","cells":[{"id":"v"},{"id":"a","faces":["v","v"]},)"
                           R"({"id":"b","faces":["v","v"]},{"id":"t","faces":["a","b","a"]}]})";
  const Classes classes(script(
      {edge, loop, disc, R"({"op":"identify","pairs":[["D.a","e"]]})", R"({"op":"cone","apex":"w","over":["D.b"]})"}));
  const Ages circle = classes.after(5, 1);
  REQUIRE(circle.size() == 1);
  CHECK(classes.all()[circle[0]].order == sparse::Integer{2});
  CHECK(classes.ages(5, 1) == Ages{1});
  CHECK(classes.all()[circle[0]].bounding.has_value());
}

TEST_CASE("classes end by splits, products and undo, and go on when their end is undone", "[classes]") {
  const Classes cut(script({edge, loop, R"({"op":"deidentify","split":[{"cell":"e.0","as":"w","moves":[["e",0]]}]})"}));
  CHECK(cut.ended(3) == Ended{{cut.after(2, 1)[0], replay::ClassEnd::cut}});
  const Classes product(script(
      {edge, loop, R"({"op":"simplex","name":"f","dim":1})", R"({"op":"product","name":"P","left":"e","right":"f"})"}));
  CHECK(product.ended(4).size() == 3);
  for (const auto& [number, how] : product.ended(4)) {
    CHECK(how == replay::ClassEnd::consumed);
  }
  const Classes undone(script({edge, loop, R"({"op":"undo"})"}));
  CHECK(undone.ended(3) == Ended{{undone.after(2, 1)[0], replay::ClassEnd::undone}});
  const Classes again(script({edge, loop, R"({"op":"cone","apex":"v"})", R"({"op":"undo"})"}));
  CHECK(again.after(4, 1) == again.after(2, 1));
  CHECK(again.ages(4, 1) == Ages{1});
}

TEST_CASE("what was written behind an undo ends when more is taken back", "[classes]") {
  // Behind step 4 the generators are written anew, in cells that step 5 takes away.
  const Classes classes(script({edge, R"({"op":"simplex","name":"f","dim":1})", loop, R"({"op":"undo"})",
                                R"({"op":"undo"})", R"({"op":"simplex","name":"g","dim":0})", loop}));
  CHECK(classes.ages(4, 0) == Ages{0, 1});
  CHECK(classes.ages(5, 0) == Ages{0});
  CHECK(classes.ages(7, 0) == Ages{0, 5});
  CHECK(classes.ages(7, 1) == Ages{6});
}

TEST_CASE("generators are given up when they take too much, and those at the end are there all the same", "[classes]") {
  replay::PageLimits limits;
  limits.work_on_generators = 0;
  Classes classes(script({edge, loop, R"({"op":"note","text":"x"})"}), limits);
  CHECK(classes.history.generators().given_up() == 1U);
  CHECK(classes.history.steps()[0].generators.has_value());
  CHECK_FALSE(classes.history.steps()[2].generators.has_value());
  const nlohmann::json data =
      nlohmann::json::parse(replay::page_data(classes.history, *classes.engine, {"", "script", ""}));
  CHECK(data["generators_until"] == 1);
  CHECK(data["steps"][1]["generators"].is_null());
  CHECK(data["steps"][2]["generators"].size() == 2);
  CHECK_FALSE(data["classes"].back().contains("since"));
  const std::size_t before = classes.all().size();
  (void)replay::page_data(classes.history, *classes.engine, {"", "script", ""});
  CHECK(classes.all().size() == before);
}

namespace {

/// Simplices on labels that are there or new, labels that are collapsed.
std::vector<std::string> random_steps(std::mt19937& random, int count) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::vector<std::string> steps;
  std::vector<int> there;
  int next = 0;
  while (static_cast<int>(steps.size()) < count) {
    if (there.size() > 5 && below(8) == 0) {
      const int from = there[below(there.size())];
      const int to = there[below(there.size())];
      if (from != to) {
        steps.push_back(R"({"op":"collapse","from":)" + std::to_string(from) + R"(,"to":)" + std::to_string(to) + "}");
        std::erase(there, from);
      }
      continue;
    }
    std::set<int> simplex;
    for (std::size_t size = 1 + below(3); simplex.size() < size;) {
      simplex.insert(there.size() <= size || below(6) == 0 ? next++ : there[below(there.size())]);
    }
    for (const int label : simplex) {
      if (std::find(there.begin(), there.end(), label) == there.end()) {
        there.push_back(label);
      }
    }
    steps.push_back(R"({"op":"insert","exist_ok":true,"simplex":)" + nlohmann::json(simplex).dump() + "}");
  }
  return steps;
}

/// The classes, in the object of an engine, of the generators that it had after its first steps, by a replay of these.
std::vector<std::vector<sparse::Rational>> images(const Classes& whole, const std::vector<std::string>& steps,
                                                  std::size_t first, int degree) {
  std::unique_ptr<engine::Engine> earlier;
  replay::ReplayOptions options;
  options.engine = &earlier;
  options.until = first;
  CHECK(replay_text(script(steps, "Z/2"), nullptr, options).errors.empty());
  std::vector<std::vector<sparse::Rational>> found;
  if (static_cast<std::size_t>(degree) >= earlier->cells().size()) {
    return found;
  }
  for (const engine::Generator& generator : earlier->generators(degree)) {
    std::vector<std::pair<sparse::Integer, std::string>> terms;
    for (const auto& [coefficient, cell] : generator.cycle.terms) {
      terms.emplace_back(coefficient.numerator(), earlier->structure().name(cell));
    }
    found.push_back(whole.engine->classify(whole.engine->chain(terms).value()).coefficients);
  }
  return found;
}

/// Whether a class is a sum of others modulo 2, by trying them all.
bool is_sum(const std::vector<std::vector<sparse::Rational>>& classes, std::size_t generator, std::size_t rank) {
  for (std::uint32_t mask = 0; mask < 1U << classes.size(); ++mask) {
    std::vector<std::int64_t> sum(rank);
    for (std::size_t k = 0; k < classes.size(); ++k) {
      for (std::size_t i = 0; i < rank; ++i) {
        sum[i] += (mask >> k & 1U) != 0 ? classes[k][i].to_int64().value() : 0;
      }
    }
    bool is_it = true;
    for (std::size_t i = 0; i < rank; ++i) {
      is_it = is_it && (sum[i] % 2 != 0) == (i == generator);
    }
    if (is_it) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("a class is as old as the first object from which it comes, by what its cycles are now", "[classes]") {
  std::mt19937 random(11);
  int older = 0;
  for (int round = 0; round < 8; ++round) {
    const std::vector<std::string> steps = random_steps(random, 30);
    const Classes whole(script(steps, "Z/2"));
    for (int degree = 0; degree < 2; ++degree) {
      const Ages last = whole.after(steps.size(), degree);
      for (std::size_t index = 0; index < last.size(); ++index) {
        std::size_t first = 1;
        while (!is_sum(images(whole, steps, first, degree), index, last.size())) {
          ++first;
        }
        CHECK(whole.all()[last[index]].since == first - 1);
        older += first < steps.size() ? 1 : 0;
      }
    }
  }
  CHECK(older > 10);
}

TEST_CASE("never are there more old classes than old bars", "[classes]") {
  std::mt19937 random(7);
  int equal = 0, all = 0;
  for (const std::string ring : {"Z/2", "Z/3", "Q"}) {
    for (int round = 0; round < 6; ++round) {
      const std::vector<std::string> steps = random_steps(random, 45);
      const Classes classes(script(steps, ring));
      const std::vector<engine::Lifetime> bars = classes.engine->maps().lifetimes();
      for (std::size_t n = 1; n <= steps.size(); ++n) {
        for (int degree = 0; degree < 3; ++degree) {
          Ages births;
          for (const engine::Lifetime& bar : bars) {
            if (bar.degree == degree && bar.born < n && bar.died >= n) {
              births.push_back(static_cast<std::uint32_t>(bar.born));
            }
          }
          std::sort(births.begin(), births.end());
          const Ages ages = classes.ages(n, degree);
          REQUIRE(ages.size() == births.size());
          for (std::size_t k = 0; k < ages.size(); ++k) {
            CHECK(ages[k] >= births[k]);  // equal when the generators are a basis of the older classes and of new ones
          }
          equal += ages == births ? 1 : 0;
          ++all;
        }
      }
    }
  }
  CHECK(equal * 10 > all * 9);
}
