#include "engine/right/perturbations.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::GeneratorId;
using engine::no_rule;
using engine::no_symbol;
using engine::Perturbations;
using engine::RuleId;
using engine::Rules;
using engine::Symbol;

namespace {

using Pieces =
    std::vector<std::pair<std::size_t, sparse::Term<Zp, Symbol>>>;  // a term and the perturbation that gave it

/// All perturbations in one list, and for each rule how many of them it has seen and what each gave it.
struct PlainRecord {
  struct Perturbation {
    Symbol first;
    std::vector<Symbol> changed;  ///< that are the b of a rule
  };
  std::vector<Perturbation> all;
  std::map<RuleId, std::size_t> seen;
  std::map<RuleId, Pieces> gains;
};

struct Recording {
  Zp ring = test_ring<Zp>();
  Rules<Zp> rules{ring};
  Perturbations<Zp> perturbations{ring, rules};
  PlainRecord plain;

  [[nodiscard]] int degree_of_b(RuleId rule) const { return rules.degree(rules[rule].a) + 1; }
  /// Whether a rule's own b, or that of an older one of its degree, has changed: then its lift may have it.
  [[nodiscard]] bool may_change(const PlainRecord::Perturbation& perturbation, RuleId rule) const {
    return std::any_of(perturbation.changed.begin(), perturbation.changed.end(),
                       [&](Symbol x) { return rules.degree(x) == degree_of_b(rule) && rules.removed_by(x) <= rule; });
  }
  [[nodiscard]] bool is_of_degree(const PlainRecord::Perturbation& perturbation, RuleId rule) const {
    return std::any_of(perturbation.changed.begin(), perturbation.changed.end(),
                       [&](Symbol x) { return rules.degree(x) == degree_of_b(rule); });
  }
  /// The first perturbation of a rule's degree that it has not seen.
  [[nodiscard]] std::size_t first_unseen(RuleId rule) const {
    std::size_t k = plain.seen.at(rule);
    while (k < plain.all.size() && !is_of_degree(plain.all[k], rule)) {
      ++k;
    }
    return k;
  }

  void eliminate_any(Random& random) {
    const int p = random.in(0, 1);
    const std::vector<Symbol> small = rules.small(p), above = rules.small(p + 1);
    if (small.size() > 1 && !above.empty()) {
      const auto b = above[static_cast<std::size_t>(random.in(0, static_cast<int>(above.size()) - 1))];
      plain.seen[rules.eliminate(small.front(), b, terms_of<Symbol>(ring, {{small.front(), 3}, {small.back(), 2}}))] =
          plain.all.size();
    }
  }
  void perturb(Random& random) {
    const Symbol old = rules.next_symbol();
    const RuleId time = rules.size();
    const Symbol first = rules.append_generator(random.in(0, 2));
    rules.append_generator(random.in(0, 2));
    std::vector<GeneratorId> changed;
    PlainRecord::Perturbation perturbation{first, {}};
    for (Symbol x = 0; x < old; ++x) {
      if (random.one_in(6)) {
        changed.push_back(rules.generator_in(x));
        if (rules.removed_by(x) != no_rule && rules[rules.removed_by(x)].b == x) {
          perturbation.changed.push_back(x);
        }
      }
    }
    const auto concerned = perturbations.record(time, first, changed);
    plain.all.push_back(perturbation);
    for (Symbol x = 0; x < rules.next_symbol(); ++x) {
      const bool is_changed = std::find(changed.begin(), changed.end(), rules.generator_in(x)) != changed.end();
      const bool has_changed_lift = std::any_of(perturbation.changed.begin(), perturbation.changed.end(),
                                                [&](Symbol y) { return rules.degree(y) == rules.degree(x); });
      const bool is_small = rules.removed_by(x) == no_rule && x < first;
      REQUIRE(concerned.small.contains(x) == (is_small && (is_changed || has_changed_lift)));
    }
  }
  void take_in_any(Random& random) {
    if (rules.size() == 0) {
      return;
    }
    const auto rule = RuleId{static_cast<unsigned>(random.in(0, static_cast<int>(rules.size()) - 1))};
    const std::size_t from = first_unseen(rule);
    if (from == plain.all.size()) {
      return;
    }
    ChainOfS<Zp> more;
    for (std::size_t k = from; k < plain.all.size(); ++k) {
      if (random.one_in(2)) {
        more.push_back({plain.all[k].first, ring.from(std::int64_t{random.in(1, 4)})});
        plain.gains[rule].emplace_back(k, more.back());
      }
    }
    perturbations.take_in(rule, more);
    plain.seen[rule] = plain.all.size();
  }
  void undo(std::size_t size, const Rules<Zp>::Mark& mark) {
    perturbations.undo(size, mark.rules);
    rules.undo(mark);
    plain.all.resize(size);
    std::erase_if(plain.seen, [&](const auto& entry) { return entry.first >= mark.rules; });
    std::erase_if(plain.gains, [&](const auto& entry) { return entry.first >= mark.rules; });
    for (auto& [rule, seen] : plain.seen) {
      seen = std::min(seen, size);
    }
    for (auto& [rule, pieces] : plain.gains) {
      std::erase_if(pieces, [size](const auto& piece) { return piece.first >= size; });
    }
  }

  void require_same() {
    REQUIRE(perturbations.size() == plain.all.size());
    for (RuleId rule = 0; rule < rules.size(); ++rule) {
      CAPTURE(rule);
      const std::size_t seen = plain.seen.at(rule);
      const bool is_behind = std::any_of(plain.all.begin() + static_cast<std::ptrdiff_t>(seen), plain.all.end(),
                                         [&](const auto& each) { return may_change(each, rule); });
      REQUIRE(perturbations.is_behind(rule) == is_behind);
      REQUIRE(perturbations.lacks_any_of(perturbations.until(rule, rules.size()), rule) ==
              (first_unseen(rule) < plain.all.size()));
      if (first_unseen(rule) < plain.all.size()) {
        REQUIRE(perturbations.first_missing(rule) == plain.all[first_unseen(rule)].first);
      }
      const bool has_any =
          std::any_of(plain.all.begin(), plain.all.end(), [&](const auto& each) { return is_of_degree(each, rule); });
      REQUIRE((perturbations.last(rule) != 0) == has_any);
      ChainOfS<Zp> gain;
      for (const auto& [k, term] : plain.gains[rule]) {
        gain.push_back(term);
      }
      const auto found = perturbations.gain(rule);
      REQUIRE(ChainOfS<Zp>(found.begin(), found.end()) == gain);
      const auto as_made = rules.value(rule);
      ChainOfS<Zp> expected(as_made.begin(), as_made.end());
      for (const auto& [x, coefficient] : gain) {
        expected.push_back({x, ring.negate(ring.multiply(ring.inverse(3), coefficient))});  // the unit is 3
      }
      ChainOfS<Zp> value;
      perturbations.for_each_in_value(rule, [&](Symbol x, std::uint32_t factor) { value.push_back({x, factor}); });
      REQUIRE(value == expected);
    }
  }
};

}  // namespace

TEST_CASE("Perturbations: who is behind, and what was gained, is what one list says, through undo", "[engine][twin]") {
  Random random{GENERATE(range(0U, 20U))};
  Recording live;
  std::vector<std::pair<std::size_t, Rules<Zp>::Mark>> marks;
  for (int step = 0; step < 200; ++step) {
    switch (random.in(0, 9)) {
      case 0:
      case 1:
      case 2:
        live.rules.append_generator(random.in(0, 2));
        break;
      case 3:
      case 4:
        live.eliminate_any(random);
        break;
      case 5:
        live.perturb(random);
        break;
      case 6:
      case 7:
        live.take_in_any(random);
        break;
      case 8:
        marks.emplace_back(live.plain.all.size(), live.rules.mark());
        break;
      default:
        if (!marks.empty()) {
          live.undo(marks.back().first, marks.back().second);
          marks.pop_back();
        }
    }
    live.require_same();
  }
}

TEST_CASE("Perturbations: a generator that is in no lift changes no rule", "[engine]") {
  Rules<Integers> rules{Integers{}};
  Perturbations<Integers> perturbations{Integers{}, rules};
  const Symbol u = rules.append_generator(0), v = rules.append_generator(0), e = rules.append_generator(1);
  const Symbol loop = rules.append_generator(1);
  const RuleId rule = rules.eliminate(v, e, {{u, -1}, {v, 1}});
  rules.append_generator(0);
  const auto concerned =
      perturbations.record(rule + 1, 4, std::vector{rules.generator_in(v), rules.generator_in(loop)});
  CHECK(concerned.small == std::set<Symbol>{loop});
  CHECK_FALSE(perturbations.is_behind(rule));
  CHECK(perturbations.last(rule) == 0);
  perturbations.record(rule + 1, 4, std::vector{rules.generator_in(e)});
  CHECK(perturbations.is_behind(rule));
}

TEST_CASE("Perturbations: with changes of basis, whatever was born after a rule changes none before it", "[engine]") {
  Rules<Integers> rules{Integers{}};
  Perturbations<Integers> perturbations{Integers{}, rules};
  for (int k = 0; k < 4; ++k) {
    rules.append_generator(0);
  }
  const Symbol a = rules.append_generator(1), b = rules.append_generator(1);
  const RuleId early = rules.eliminate(0, a, {{0, 1}, {1, 1}});
  const Symbol x = rules.append_generator(1);
  rules.change_basis(b, 2, x, {});
  const Symbol c = rules.append_generator(1);
  const RuleId late = rules.eliminate(1, c, {{1, 1}, {2, 1}});
  const Symbol first = rules.append_generator(0);
  const auto concerned = perturbations.record(rules.size(), first, std::vector{rules.generator_in(x)});
  CHECK_FALSE(perturbations.is_behind(early));
  CHECK(perturbations.is_behind(late));
  CHECK(concerned.combinations == std::vector<std::size_t>{0});
  perturbations.extend_column(0, {{first, 7}});
  CHECK(rules.combinations()[0].column == ChainOfS<Integers>{{first, 7}});
  perturbations.undo(0, rules.size());
  CHECK(rules.combinations()[0].column.empty());
}
