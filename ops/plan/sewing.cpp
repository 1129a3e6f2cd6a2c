// Sewing maps along cells, and what this glues.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ops/plan/sewing.hpp"

#include "ops/cells/lineage.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// The images of darts that a step sews: of a few, as in most steps, in a list that is gone through.
class NewImages {
 public:
  /// Of a dart; no_dart: it has none.
  [[nodiscard]] Dart of(Dart d) const {
    if (!index_.empty()) {
      const auto met = index_.find(d);
      return met != index_.end() ? met->second : no_dart;
    }
    const auto met = std::ranges::find(few_, d, &std::pair<Dart, Dart>::first);
    return met != few_.end() ? met->second : no_dart;
  }
  [[nodiscard]] bool contains(Dart d) const { return of(d) != no_dart; }
  void add(Dart d, Dart image) {
    constexpr std::size_t most_in_list = 16;
    if (index_.empty() && few_.size() < most_in_list) {
      few_.emplace_back(d, image);
      return;
    }
    index_.insert(few_.begin(), few_.end());
    few_.clear();
    index_.emplace(d, image);
  }

 private:
  std::vector<std::pair<Dart, Dart>> few_;
  std::unordered_map<Dart, Dart> index_;
};

/// Works out which darts are sewn to which, each pair with its whole orbit.
class SewingPlanner {
 public:
  SewingPlanner(const Sew& operation, const Structure& structure, Plan& plan)
      : operation_{operation}, structure_{structure}, store_{structure.darts()}, plan_{plan} {}

  Result<std::vector<Equation>> run() {
    for (const auto& [one, other] : operation_.pairs) {
      const Result<NamedDart> a = dart_named(one, structure_);
      const Result<NamedDart> b = a ? dart_named(other, structure_) : a;
      if (!b) {
        return b.error();
      }
      if (Status s = check(*a, *b, one, other); !s) {
        return s.error();
      }
      dimension_ = a->dimension;
      if (sewn_.of(a->dart) == b->dart) {
        continue;  // by an earlier pair
      }
      if (Status s = sew_orbits(a->dart, b->dart); !s) {
        return s.error();
      }
    }
    return std::move(equations_);
  }

 private:
  [[nodiscard]] int index() const { return operation_.dimension; }
  [[nodiscard]] Dart alpha(int i, Dart d) const { return store_.alpha(dimension_, i, d); }
  [[nodiscard]] std::string name(Dart d) const { return name_of_dart(dimension_, d, structure_); }

  Status check(const NamedDart& a, const NamedDart& b, const std::string& one, const std::string& other) const {
    if (a.dimension != b.dimension) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a dart of a map of dimension {} and \"{}\" one of dimension {}: only maps of "
                               "the same dimension can be sewn",
                               one, a.dimension, other, b.dimension)};
    }
    if (!plan_.sewings.empty() && a.dimension != dimension_) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a dart of a map of dimension {}, those before it of dimension {}: "
                               "sew maps of one dimension in a step",
                               one, a.dimension, dimension_)};
    }
    if (index() > a.dimension) {
      return Error{Errc::bad_input, fmt::format("\"{}\" is a dart of a map of dimension {}: it can be sewn in the "
                                                "dimensions 0 to {}",
                                                one, a.dimension, a.dimension)};
    }
    if (index() < a.dimension && !is_by_simplices(a.dart, a.dimension)) {
      return Error{Errc::refused,
                   fmt::format("to sew \"{}\" in dimension {} would change what the cells of its map are, "
                               "which has dimension {}: make it \"as\":\"simplices\", or sewn",
                               one, index(), a.dimension)};
    }
    return Done{};
  }

  /// Free, and not met by an earlier pair.
  Status check_free(Dart d) const {
    const Dart met = sewn_.of(d);
    const Dart image = met != no_dart ? met : alpha(index(), d);
    if (image != d) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is {}-sewn to \"{}\" already: only free darts can be sewn{}", name(d), index(),
                               name(image), index() == dimension_ ? "; unsew it first" : "")};
    }
    return Done{};
  }

  /// The isomorphism of orbits that takes the one dart to the other, which sends what is met in the other orbit back.
  Status sew_orbits(Dart one, Dart other) {
    if (one == other) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" cannot be sewn to itself: a dart that has no neighbour is free", name(one))};
    }
    orbit_.assign(1, {one, other});
    if (Status s = meet(one, other); !s) {
      return s;
    }
    for (std::size_t at = 0; at < orbit_.size(); ++at) {
      for (int j = 0; j <= dimension_; ++j) {
        if (std::abs(j - index()) < 2) {
          continue;
        }
        const auto [a, b] = orbit_[at];
        const Dart next = alpha(j, a), image = alpha(j, b);
        if (sewn_.of(next) == image) {
          continue;
        }
        if (is_of_orbit(next) || is_of_orbit(image)) {
          return no_isomorphism(one, other, next, image);
        }
        if (Status s = meet(next, image); !s) {
          return s;
        }
        orbit_.emplace_back(next, image);
      }
    }
    return add_equations(one, other);
  }

  [[nodiscard]] bool is_of_orbit(Dart d) const {
    return sewn_.contains(d) &&
           std::ranges::any_of(orbit_, [&](const auto& pair) { return pair.first == d || pair.second == d; });
  }

  Error no_isomorphism(Dart one, Dart other, Dart next, Dart image) const {
    const bool is_next = is_of_orbit(next);
    return {Errc::refused,
            fmt::format("\"{}\" and \"{}\" cannot be {}-sewn: what belongs to them is not alike, as \"{}\" would be "
                        "sewn to \"{}\" and to \"{}\"",
                        name(one), name(other), index(), name(is_next ? next : image),
                        name(sewn_.of(is_next ? next : image)), name(is_next ? image : next))};
  }

  Status meet(Dart a, Dart b) {
    for (const Dart d : {a, b}) {
      if (Status s = check_free(d); !s) {
        return s;
      }
    }
    sewn_.add(a, b);
    sewn_.add(b, a);
    plan_.sewings.push_back({dimension_, index(), a, b});
    return Done{};
  }

  /// Cells are glued as seen from one pair of darts; the simplices of an analogue one by one.
  Status add_equations(Dart one, Dart other) {
    const bool by_simplices = is_by_simplices(one);
    if (by_simplices != is_by_simplices(other)) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is a dart of a map by {}, \"{}\" of one by {}: make both the same "
                               "way",
                               name(one), by_simplices ? "simplices" : "cells", name(other),
                               by_simplices ? "cells" : "simplices")};
    }
    const std::size_t pairs = by_simplices ? orbit_.size() : 1;
    for (std::size_t k = 0; k < pairs && dimension_ > 0; ++k) {
      const Result<Value> a = glued(orbit_[k].first);
      const Result<Value> b = a ? glued(orbit_[k].second) : a;
      if (!b) {
        return b.error();
      }
      equations_.emplace_back(*a, *b);
    }
    return Done{};
  }

  [[nodiscard]] bool is_by_simplices(Dart d) const { return is_by_simplices(d, dimension_); }
  [[nodiscard]] bool is_by_simplices(Dart d, int dimension) const {
    return store_.map_of(dimension, d).is_by_simplices;
  }
  /// What is glued when a dart is sewn, as the dart sees it.
  [[nodiscard]] Result<Value> glued(Dart d) const {
    const int of = is_by_simplices(d) ? index() : index() - 1;
    return seen_now(dimension_, of, d, structure_);
  }

  const Sew& operation_;
  const Structure& structure_;
  const DartStore& store_;
  Plan& plan_;
  int dimension_ = 0;
  std::vector<Equation> equations_;
  NewImages sewn_;                            // by this step
  std::vector<std::pair<Dart, Dart>> orbit_;  // memory
};

}  // namespace

Result<NamedDart> dart_named(const std::string& name, const Structure& structure) {
  const std::size_t colon = name.rfind(':');
  const auto wrong = [&](std::string_view what) {
    return Error{Errc::unknown_name, fmt::format("there is no dart {}: {}", sparse::quoted(name), what)};
  };
  if (colon == std::string::npos) {
    return wrong("dart k of the map m is called m:k");
  }
  const DartStore::Made* map = map_named(structure, std::string_view{name}.substr(0, colon));
  if (map == nullptr) {
    const std::string before = name.substr(0, colon);
    return wrong(structure.lookup_body(before)
                     ? fmt::format("{} is no map with darts that are sewn; its cells are glued by identify",
                                   sparse::quoted(before))
                     : fmt::format("no map is called {}", sparse::quoted(before)));
  }
  if (map->has_levels()) {
    return Error{Errc::refused,
                 fmt::format("{} is no dart that can be sewn: the darts of {} are those of its levels, and name its "
                             "cells, m.i:k; identify glues these as their darts see them, [[\"m.2:0\",\"m.2:7\"]]",
                             sparse::quoted(name), sparse::quoted(name.substr(0, colon)))};
  }
  const Dart dart = dart_of_text(*map, std::string_view{name}.substr(colon + 1));
  if (dart == no_dart) {
    return wrong(fmt::format("its darts are numbered from 0 to {}{}", (map->halves != 0 ? map->halves : map->count) - 1,
                             map->halves != 0 ? ", and each k has another one, k'" : ""));
  }
  if (const auto with = structure.darts().taken_out_with(map->dimension, map->first + dart)) {
    return wrong(fmt::format("it went out of its map with the cell \"{}.{}:{}\"", name.substr(0, colon), *with,
                             dart_text(*map, dart)));
  }
  return NamedDart{map->dimension, map->first + dart};
}

std::string name_of_dart(int dimension, Dart dart, const Structure& structure) {
  const DartStore::Made& map = structure.darts().map_of(dimension, dart);
  return fmt::format("{}:{}", structure.directory().names()[map.name].text, dart_text(map, dart - map.first));
}

Result<Value> seen_now(int dimension, int i, Dart dart, const Structure& structure) {
  auto value = seen_from_dart(structure, structure.darts().map_of(dimension, dart), i, dart);
  if (value) {
    Lineage(structure).advance_to_now(*value);
    if (structure.lazy().consumed_by(value->cell) == none && !is_deleted(structure.forest(), value->cell)) {
      return *value;
    }
  }
  const std::string name = name_of_dart(dimension, dart, structure);
  return value ? what_is_now(*value, name, structure)
               : Error{Errc::unknown_name, fmt::format("the cell of \"{}\" was removed", name)};
}

Result<std::vector<Equation>> equations_of(const Sew& operation, const Structure& structure, Plan& plan) {
  return SewingPlanner(operation, structure, plan).run();
}

}  // namespace sesame::ops
