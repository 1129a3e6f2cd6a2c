#include "engine/right/rewriter.hpp"

#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::GeneratorId;
using engine::Rewriter;
using engine::RuleId;
using engine::Symbol;

namespace {

/// A rewriter with the complex that grows under it.
template <Ring R>
struct Live {
  Live(const R& k, unsigned seed) : ring{k}, random{seed} {}

  R ring;
  Random random;
  GrowingComplex<R> b{ring};
  Rewriter<R> rewriter{ring, b.boundary};
  using Phi = std::vector<ChainOfB<R>>;  ///< on the generators that there were
  std::vector<Phi> phis;

  /// With the boundary that it would have, had it been there when the others were perturbed.
  GeneratorId append(int degree, ChainOfB<R> boundary) {
    for (const Phi& phi : phis) {
      boundary = sum_of(ring, boundary, ring.one(), applied(phi, boundary));
    }
    const GeneratorId x = b.append(degree, boundary);
    rewriter.append(degree);
    return x;
  }
  [[nodiscard]] ChainOfB<R> applied(const Phi& phi, const ChainOfB<R>& chain) const {
    ChainOfB<R> image;
    for (const auto& [x, coefficient] : chain) {
      if (x < phi.size()) {
        sparse::add_multiple<R>(ring, image, coefficient, phi[x]);
      }
    }
    return image;
  }
  /// New generators e without boundary, and delta = phi d on the old ones for a random map phi to them; then perhaps a
  /// generator whose boundary is one of them, so that a rule rewrites it.
  void perturb() {
    const GeneratorId old = b.size();
    const RuleId time = rewriter.rules();
    Phi phi(old);
    for (int k = random.in(1, 3); k > 0; --k) {
      const int degree = random.in(0, 2);
      const GeneratorId e = append(degree, {});
      for (GeneratorId x = 0; x < old; ++x) {
        if (b.degrees[x] == degree && random.one_in(2)) {
          phi[x].push_back({e, ring.from(std::int64_t{random.in(1, 2)})});
        }
      }
    }
    std::vector<ChainOfB<R>> delta(old);
    for (GeneratorId x = 0; x < old; ++x) {
      delta[x] = applied(phi, b.boundary.column(x));
    }
    phis.push_back(std::move(phi));
    change(time, old, delta);
    if (random.one_in(2)) {
      append(b.degrees[old] + 1, {{old, ring.one()}});
    }
  }
  /// A perturbation that takes classes away: each old generator b gains f(b) at one small generator, as an e.
  void cut() {
    const GeneratorId old = b.size();
    const RuleId time = rewriter.rules();
    for (int degree = 1; degree < 4; ++degree) {
      if (const std::vector<Symbol> small = rewriter.small(degree);
          !small.empty() && rewriter.core().columns().empty()) {
        std::vector<ChainOfB<R>> delta(old);
        for (GeneratorId x = 0; x < old; ++x) {
          for (const auto& [symbol, coefficient] : rewriter.rewrite(ChainOfB<R>{{x, ring.one()}})) {
            if (symbol == small.front()) {
              delta[x].push_back({old, coefficient});
            }
          }
        }
        append(degree - 1, {});
        change(time, old, delta);
        return;
      }
    }
  }
  void change(RuleId time, GeneratorId old, const std::vector<ChainOfB<R>>& delta) {
    std::vector<GeneratorId> changed;
    for (GeneratorId x = 0; x < old; ++x) {
      if (!delta[x].empty()) {
        b.boundary.add_to_column(x, ring.one(), delta[x]);
        changed.push_back(x);
      }
    }
    if (b.size() > old) {
      rewriter.perturb(time, old, changed);
    }
  }

  [[nodiscard]] std::vector<Symbol> small() const {
    std::vector<Symbol> all;
    for (int p = 0; p < 5; ++p) {
      const std::vector<Symbol> of_degree = rewriter.small(p);
      all.insert(all.end(), of_degree.begin(), of_degree.end());
    }
    return all;
  }
  ChainOfS<R> f(const ChainOfB<R>& chain) { return rewriter.rewrite(chain); }
  ChainOfB<R> g(const ChainOfS<R>& symbols) { return rewriter.lift(symbols); }
  ChainOfB<R> h(const ChainOfB<R>& chain) { return rewriter.lift({}, rewriter.trace(chain)); }
  [[nodiscard]] ChainOfS<R> small_boundary(Symbol x) const {
    const ChainOfS<R>* column = rewriter.core().find(x);
    return column == nullptr ? ChainOfS<R>{} : *column;
  }
  std::string broken_law() {
    return tests::broken_law(
        b, small(), [this](const ChainOfB<R>& v) { return f(v); }, [this](const ChainOfS<R>& v) { return g(v); },
        [this](const ChainOfB<R>& v) { return h(v); }, [this](Symbol x) { return small_boundary(x); });
  }
  /// All maps and the core: chains of S, then of B.
  using Everything = std::pair<std::vector<ChainOfS<R>>, std::vector<ChainOfB<R>>>;
  Everything everything() {
    Everything all;
    for (GeneratorId x = 0; x < b.size(); ++x) {
      all.first.push_back(f({{x, ring.one()}}));
      all.second.push_back(h({{x, ring.one()}}));
    }
    for (const Symbol x : small()) {
      all.second.push_back(g({{x, ring.one()}}));
      all.first.push_back(small_boundary(x));
    }
    return all;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("Rewriter: it is a reduction after every generator and every perturbation", "[engine][law]",
                   Integers, Z2, Zp) {
  using R = TestType;
  const unsigned seed = GENERATE(range(0U, 24U));
  Live<R> live{test_ring<R>(), seed};
  const bool is_read_at_once = seed % 2 == 0;  // else what rules lack is taken in late
  const GrowingComplex<R> all = in_random_order(live.random, random_complex(live.ring, live.random).complex);
  std::vector<GeneratorId> place;  // of the generators of `all`
  for (GeneratorId x = 0; x < all.size(); ++x) {
    ChainOfB<R> boundary = all.boundary.column(x);
    for (auto& term : boundary) {
      term.index = place[term.index];
    }
    place.push_back(live.append(all.degrees[x], boundary));
    if (live.random.one_in(5)) {
      live.perturb();
    }
    if (is_read_at_once) {
      REQUIRE(live.broken_law() == "");
    }
  }
  live.cut();
  if (is_read_at_once) {
    REQUIRE(live.broken_law() == "");
  }
  live.cut();
  live.perturb();
  CHECK(live.broken_law() == "");
}

TEMPLATE_TEST_CASE("Rewriter: S has the homology that B had from the start", "[engine][law]", Integers, Z2, Zp) {
  using R = TestType;
  Live<R> live{test_ring<R>(), GENERATE(range(20U, 30U))};
  const Sample<R> sample = random_complex(live.ring, live.random);
  const GrowingComplex<R> all = in_random_order(live.random, sample.complex);
  for (GeneratorId x = 0; x < all.size(); ++x) {
    live.append(all.degrees[x], all.boundary.column(x));
  }
  Sizes sizes;
  std::vector<std::vector<Symbol>> small;
  for (int p = 0; p <= sample.complex.top(); ++p) {
    small.push_back(live.rewriter.small(p));
    sizes.push_back(static_cast<Index>(small.back().size()));
  }
  std::vector<Matrix<R>> boundaries;
  for (std::size_t p = 0; p < small.size(); ++p) {
    Matrix<R> d(live.ring, p == 0 ? 0 : sizes[p - 1], 0);
    for (const Symbol x : small[p]) {
      Terms<R> column;
      for (const auto& [y, coefficient] : live.small_boundary(x)) {
        const auto at = std::find(small[p - 1].begin(), small[p - 1].end(), y);
        REQUIRE(at != small[p - 1].end());
        column.push_back({static_cast<Index>(at - small[p - 1].begin()), coefficient});
      }
      d.append_column(column);
    }
    boundaries.push_back(std::move(d));
  }
  std::vector<AbelianGroup> groups =
      reductions::homology_groups(ChainComplex<R>(live.ring, sizes, std::move(boundaries)));
  groups.resize(sample.groups.size());
  CHECK(groups == sample.groups);
}

TEMPLATE_TEST_CASE("Rewriter: undo goes back to every map as it was, whatever was read or perturbed in between",
                   "[engine]", Integers, Z2, Zp) {
  using R = TestType;
  Live<R> live{test_ring<R>(), GENERATE(range(40U, 52U))};
  const GrowingComplex<R> all = in_random_order(live.random, random_complex(live.ring, live.random).complex);
  struct Moment {
    typename Rewriter<R>::Mark mark;
    GrowingComplex<R> b;
    std::size_t phis;
    std::vector<GeneratorId> place;
    typename Live<R>::Everything everything;
  };
  std::vector<Moment> moments;
  std::vector<GeneratorId> place;
  for (int step = 0; step < 40; ++step) {
    switch (live.random.in(0, 6)) {
      case 0:
        live.perturb();
        break;
      case 1:
        moments.push_back({{}, live.b, live.phis.size(), place, live.everything()});
        moments.back().mark = live.rewriter.mark();
        break;
      case 2:
        if (!moments.empty()) {
          Moment& moment = moments.back();
          live.rewriter.undo(moment.mark);
          live.b = moment.b;
          live.phis.resize(moment.phis);
          place = moment.place;
          REQUIRE(live.everything() == moment.everything);
          moments.pop_back();
        }
        break;
      case 3:
        (void)live.everything();
        break;
      default:
        if (place.size() < all.degrees.size()) {
          ChainOfB<R> boundary = all.boundary.column(GeneratorId{place.size()});
          for (auto& term : boundary) {
            term.index = place[term.index];
          }
          place.push_back(live.append(all.degrees[place.size()], boundary));
        }
    }
  }
  CHECK(live.broken_law() == "");
}

TEST_CASE("Rewriter: when a budget breaks a perturbation off, undo restores what was before it", "[engine]") {
  int broken_off = 0;
  for (unsigned seed = 60; seed < 70; ++seed) {
    Live<Integers> live{Integers{}, seed};
    const Parts parts{.free = 4, .pairs = 8};
    const GrowingComplex<Integers> all =
        in_random_order(live.random, random_complex(live.ring, live.random, 3, parts).complex);
    for (GeneratorId x = 0; x < all.size(); ++x) {
      live.append(all.degrees[x], all.boundary.column(x));
    }
    live.perturb();
    const auto before = live.everything();
    const GrowingComplex<Integers> complex = live.b;
    for (std::uint64_t budget = 0; budget < 40; ++budget) {
      const auto mark = live.rewriter.mark();
      live.rewriter.set_budget(budget);
      try {
        live.perturb();
      } catch (const engine::OverBudget&) {
        ++broken_off;
        live.rewriter.drop_work();
      }
      live.rewriter.set_budget(UINT64_MAX);
      live.rewriter.undo(mark);
      live.b = complex;
      live.phis.resize(1);
      REQUIRE(live.everything() == before);
    }
  }
  CHECK(broken_off > 50);
}

TEST_CASE("Rewriter: what was consumed leaves S and stays what chains are rewritten to", "[engine]") {
  Live<Integers> live{Integers{}, 0};
  const GeneratorId v = live.append(0, {}), w = live.append(0, {});
  live.append(1, {{v, -1}, {w, 1}});
  const auto mark = live.rewriter.mark();
  live.rewriter.consume(live.rewriter.small(0));
  CHECK(live.rewriter.small(0).empty());
  CHECK(live.rewriter.small_counts()[0] == 0);
  CHECK(live.rewriter.rewrite(ChainOfB<Integers>{{w, 3}}) == ChainOfS<Integers>{{0, 3}});
  live.rewriter.undo(mark);
  CHECK(live.rewriter.small(0) == std::vector<Symbol>{0});
}
