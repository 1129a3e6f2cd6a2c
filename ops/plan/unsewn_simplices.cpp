#include "ops/plan/unsewn_simplices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ops/cells/dart_simplices.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/simplices_of_darts.hpp"

namespace sesame::ops {
namespace {

/// The simplices with the number i do not change: their orbits know nothing of alpha_i. They and others that stay may
/// get copies as faces.
class SimplexUnsewing {
 public:
  SimplexUnsewing(const Structure& structure, int dimension, int index, Plan& plan)
      : structure_{structure},
        store_{structure.darts()},
        plan_{plan},
        n_{dimension},
        index_{index},
        simplices_{structure, dimension} {}

  Status run(const Unsew& operation) {
    for (const std::string& name : operation.darts) {
      if (Status s = add_dart(name); !s) {
        return s;
      }
    }
    plan_.first = structure_.cells().size();
    for (int size = 1; size <= n_; ++size) {
      for (IndexSet set = 1; set < simplices_.all(); ++set) {
        if (std::popcount(set) != size || (set >> index_ & 1U) != 0) {
          continue;
        }
        for (const Dart d : unsewn_) {
          if (Status s = split_simplex_of(set, d); !s) {
            return s;
          }
        }
      }
    }
    for (const auto& [of, copy] : copies_) {
      if (Status s = add_moves(of.first, of.second, copy); !s) {
        return s;
      }
    }
    return Done{};
  }

 private:
  using Of = std::pair<IndexSet, Dart>;

  Status add_dart(const std::string& name) {
    const Result<NamedDart> named = dart_named(name, structure_);
    if (!named) {
      return named.error();
    }
    if (named->dimension != n_) {
      return Error{Errc::refused, fmt::format("\"{}\" is a dart of a map of dimension {}, those before it of dimension "
                                              "{}: unsew maps of one dimension in a step",
                                              name, named->dimension, n_)};
    }
    if (!store_.map_of(n_, named->dart).is_by_simplices) {
      return Error{Errc::refused, fmt::format("\"{}\" is a dart of a map by cells, those before it are of maps by "
                                              "simplices: unsew them one after the other",
                                              name)};
    }
    if (index_ > n_) {
      return Error{Errc::bad_input, fmt::format("\"{}\" is a dart of a map of dimension {}: it can be unsewn in the "
                                                "dimensions 0 to {}",
                                                name, n_, n_)};
    }
    if (unsewn_.contains(named->dart)) {
      return Done{};  // with an earlier one
    }
    if (alpha(index_, named->dart) == named->dart) {
      return Error{Errc::refused, fmt::format("\"{}\" is {}-free: there is nothing to unsew", name, index_)};
    }
    std::vector<Dart> orbit{named->dart};
    std::set<Dart> met{named->dart};
    for (std::size_t at = 0; at < orbit.size(); ++at) {
      const Dart d = orbit[at], other = alpha(index_, d);
      if (unsewn_.insert(d).second) {
        unsewn_.insert(other);
        plan_.sewings.push_back({n_, index_, d, other, true});
      }
      for (int j = 0; j <= n_; ++j) {
        if (std::abs(j - index_) >= 2 && met.insert(alpha(j, d)).second) {
          orbit.push_back(alpha(j, d));
        }
      }
    }
    return Done{};
  }

  [[nodiscard]] Dart alpha(int i, Dart d) const { return store_.alpha(n_, i, d); }

  /// The darts of a simplex as it is, or will be, ascending.
  [[nodiscard]] std::vector<Dart> orbit(IndexSet set, Dart start, bool will_be) const {
    std::vector<Dart> found{start};
    std::unordered_set<Dart> met{start};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (int j = 0; j <= n_; ++j) {
        const bool is_taken_back = will_be && j == index_ && unsewn_.contains(found[at]);
        if ((set >> j & 1U) == 0 && !is_taken_back && met.insert(alpha(j, found[at])).second) {
          found.push_back(alpha(j, found[at]));
        }
      }
    }
    std::ranges::sort(found);
    return found;
  }

  [[nodiscard]] std::string name(Dart d) const { return name_of_dart(n_, d, structure_); }

  Status split_simplex_of(IndexSet set, Dart start) {
    if (!done_.insert({set, start}).second) {
      return Done{};
    }
    const std::vector<Dart> darts = orbit(set, start, false);
    std::vector<std::vector<Dart>> parts;
    std::unordered_set<Dart> met;
    for (const Dart d : darts) {
      done_.insert({set, d});
      if (!met.contains(d)) {
        parts.push_back(orbit(set, d, true));
        met.insert(parts.back().begin(), parts.back().end());
      }
    }
    if (parts.size() == 1) {
      return Done{};
    }
    const Result<CellId> whole = whole_simplex(set, darts);
    if (!whole) {
      return whole.error();
    }
    if (Status s = check_above(set, *whole, darts); !s) {
      return s;
    }
    const auto called = simplex_named(structure_, structure_.name(*whole));
    const auto keeps = std::ranges::find_if(parts, [&](const std::vector<Dart>& part) {
      return called && called->numbers == set && std::ranges::binary_search(part, called->dart);
    });
    for (const std::vector<Dart>& part : parts) {
      const bool is_kept = keeps != parts.end() ? &part == &*keeps : &part == parts.data();
      if (Status s = is_kept ? Status{Done{}} : add_copy(set, *whole, part); !s) {
        return s;
      }
    }
    return Done{};
  }

  /// The simplex that all darts of an orbit see, of which they are all that it stands for.
  Result<CellId> whole_simplex(IndexSet set, const std::vector<Dart>& darts) {
    const auto [known, is_new] = whole_.try_emplace(Of{set, darts.front()}, none);
    if (!is_new) {
      return known->second;
    }
    CellId whole = none;
    for (const Dart d : darts) {
      const Result<Value> value = simplices_.seen(set, d);
      if (!value) {
        return value.error();
      }
      whole = d == darts.front() ? value->cell : whole;
      if (!value->is_plain() || value->cell != whole) {
        return Error{Errc::refused,
                     fmt::format("\"{}\" cannot be unsewn: the simplex {} of \"{}\" has been split, and not by "
                                 "unsewing, was glued to itself, or became degenerate: undo that first",
                                 name(*unsewn_.begin()), text_of_numbers(set), name(d))};
      }
    }
    bool is_alone = true;
    structure_.forest().for_each_member(
        whole, [&](CellId node) { is_alone = is_alone && stands_for(node, set, darts, whole); });
    if (!is_alone) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" cannot be unsewn: the simplex \"{}\" is glued to other cells, and "
                               "not only by sewing",
                               name(darts.front()), structure_.name(whole))};
    }
    known->second = whole;
    return whole;
  }

  /// Was a node made for a dart that is one of some, or sees another simplex by now?
  bool stands_for(CellId node, IndexSet set, const std::vector<Dart>& darts, CellId whole) {
    const auto made = simplex_named(structure_, structure_.directory().own_name(node));
    if (!made || made->numbers != set || made->map->dimension != n_) {
      return false;
    }
    if (std::ranges::binary_search(darts, made->dart)) {
      return true;
    }
    const Result<Value> value = simplices_.seen(set, made->dart);
    return value && value->cell != whole;
  }

  /// Are all cofaces of a simplex those that its darts see?
  Status check_above(IndexSet set, CellId whole, const std::vector<Dart>& darts) {
    std::unordered_set<CellId> above;
    for (int j = 0; j <= n_; ++j) {
      for (std::size_t k = 0; k < darts.size() && (set >> j & 1U) == 0; ++k) {
        const Result<Value> value = simplices_.seen(set | IndexSet{1} << j, darts[k]);
        if (!value) {
          return value.error();
        }
        above.insert(value->cell);
      }
    }
    return check_cofaces(whole, above, "unsewing", structure_);
  }

  /// For some darts of a simplex; its faces are those that they will see.
  Status add_copy(IndexSet set, CellId source, const std::vector<Dart>& part) {
    const std::string called = simplices_.name(set, part.front());
    const auto taken = structure_.lookup(called);
    if (structure_.is_name_taken(called) && (!taken || structure_.find(*taken) != source)) {
      return Error{Errc::bad_input,
                   fmt::format("the name \"{}\" is in use, and would be one of a new simplex", called)};
    }
    const auto position = static_cast<std::uint32_t>(plan_.cells.size());
    const std::size_t first_face = plan_.faces.size();
    std::uint32_t k = 0;
    for (IndexSet rest = set; rest != 0 && std::popcount(set) > 1; rest &= rest - 1, ++k) {
      const IndexSet without = set & ~(rest & ~(rest - 1));
      const auto copy = copies_.find({without, part.front()});
      add_face(copy != copies_.end() ? Incidence{plan_.first + copy->second}
                                     : structure_.values().incidence_of(structure_.values().face_of_cell(source, k)),
               plan_);
    }
    for (const Dart d : part) {
      copies_.emplace(Of{set, d}, position);
      plan_.newly_seen.push_back({n_, seen_index(n_, set), d, {std::uint32_t{plan_.first + position}, 0}});
    }
    plan_.names += called;
    plan_.sources.push_back(source);
    add_cell(structure_.cells().type_id(source), first_face, plan_);
    return Done{};
  }

  /// Incidences of simplices that stay with one that a dart sees as a copy.
  Status add_moves(IndexSet set, Dart d, std::uint32_t copy) {
    for (int j = 0; j <= n_; ++j) {
      const IndexSet above = set | IndexSet{1} << j;
      if (above == set || copies_.contains({above, d})) {
        continue;
      }
      const Result<CellId> cell = whole_simplex(above, orbit(above, d, false));
      if (!cell) {
        return cell.error();
      }
      const auto slot = static_cast<std::uint32_t>(std::popcount(above & ((IndexSet{1} << j) - 1)));
      if (moved_.insert({*cell, slot}).second) {
        plan_.moves.push_back({*cell, slot, plan_.first + copy, same_order});
      }
    }
    return Done{};
  }

  const Structure& structure_;
  const DartStore& store_;
  Plan& plan_;
  int n_, index_;
  SimplicesOfDarts simplices_;
  std::set<Dart> unsewn_;
  std::set<Of> done_;
  std::map<Of, CellId> whole_;          // per set of numbers and least dart of an orbit
  std::map<Of, std::uint32_t> copies_;  // by their positions among the new cells
  std::set<std::pair<CellId, std::uint32_t>> moved_;
};

}  // namespace

bool unsews_simplices(const Unsew& operation, const Structure& structure) {
  const auto first = operation.darts.empty() ? Result<NamedDart>(Error{Errc::bad_input, ""})
                                             : dart_named(operation.darts.front(), structure);
  return first && structure.darts().map_of(first->dimension, first->dart).is_by_simplices;
}

Status plan_unsewn_simplices(const Unsew& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<NamedDart> first = dart_named(operation.darts.front(), structure);
  if (!first) {
    return first.error();
  }
  if (Status s = SimplexUnsewing(structure, first->dimension, operation.dimension, plan).run(operation); !s) {
    return s;
  }
  return check_room(static_cast<std::int64_t>(plan.cells.size()), structure, limits);
}

}  // namespace sesame::ops
