// What a structure is, to and from archives.
#include <algorithm>
#include <numeric>
#include <vector>

#include "ops/cells/family_counts.hpp"
#include "ops/cells/name_reader.hpp"
#include "ops/cells/structure.hpp"

namespace sesame::ops {
namespace {

/// Whether two numbers of cells by dimension are, zeros at the end apart.
bool are_equal(CellCounts one, CellCounts other) {
  const std::size_t common = std::min(one.size(), other.size());
  const CellCounts rest = (one.size() > common ? one : other).subspan(common);
  return std::equal(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(common), other.begin()) &&
         std::all_of(rest.begin(), rest.end(), [](std::uint64_t count) { return count == 0; });
}

/// Whether nothing ties cells of different bodies: so what is frozen in one has to do with nothing else.
bool keep_to_bodies(const Structure& structure) {
  const CellStore& cells = structure.cells();
  std::vector<BodyId> roots(structure.bodies().size());
  for (BodyId b = 0; b < roots.size(); ++b) {
    roots[b] = structure.bodies().find(b);
  }
  bool is_sound = true;
  const auto tie = [&](CellId one, CellId other) {
    is_sound = is_sound && roots[cells.body(one)] == roots[cells.body(other)];
  };
  for (CellId c = 0; c < cells.size() && is_sound; ++c) {
    for (const CellId face : cells.faces(c)) {
      tie(c, face);
    }
  }
  cells.for_each_node([&](CellId c) {
    if (const CellId parent = structure.forest().parent(c); parent != none) {
      tie(c, parent);
    } else if (!is_deleted(structure.forest(), c)) {
      tie(c, structure.forest().squashed(c).cell);
    }
    if (const SplitHistory::Copy* copy = structure.splits().copy(c)) {
      tie(c, copy->source);
    }
  });
  for (std::uint32_t number = 0; number < structure.splits().moves() && is_sound; ++number) {
    tie(structure.splits().move(number).cell, structure.splits().move(number).after);
  }
  return is_sound;
}

/// Whether what comes behind its apex can be the cells of a cone.
bool is_sound(const Cone& cone, const CellStore& cells, const LazyCells& lazy) {
  if (cone.family != none) {
    const LazyFamily& family = lazy.family(cone.family);
    return family.kind == FamilyKind::cone && family.apex == cone.apex && family.by_edges == cone.by_edges;
  }
  for (CellId c = cone.apex + 1; c < cone.end; ++c) {
    if (cells.dimension(c) == 0) {
      return false;
    }
  }
  return cells.dimension(cone.apex) == 0;
}

std::uint64_t total(CellCounts counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

/// How many cells of a family are no simplices.
std::uint64_t simploids_of(const LazyFamily& family, const Bodies& bodies) {
  if (family.kind == FamilyKind::cone) {
    std::uint64_t simploids = 0;
    for (const BodyId body : family.bodies) {
      const CellCounts counts = bodies.counts(body);
      simploids += bodies.simploids(body) + (family.by_edges && !counts.empty() ? total(counts.subspan(1)) : 0);
    }
    return simploids;
  }
  if (family.kind == FamilyKind::simplicial_product) {
    return 0;
  }
  const auto vertices = [&](BodyId body) { return bodies.counts(body).empty() ? 0 : bodies.counts(body)[0]; };
  const auto simplices = [&](BodyId body) { return total(bodies.counts(body)) - bodies.simploids(body); };
  const BodyId left = family.bodies[0], right = family.bodies[1];
  return total(family.counts) -
         (simplices(left) * vertices(right) + vertices(left) * simplices(right) - vertices(left) * vertices(right));
}

}  // namespace

void Structure::save(sparse::ArchiveWriter& to) const {
  types().save(to);
  maps().save(to);
  bodies_.save(to);
  cells_.save(to);
  forest_.save(to);
  lazy_.save(to);
  splits_.save(to);
  cones_.save(to);
  directory_.save(to);
  abstract_.save(to);
  darts_.save(to);
  to.put_list(counts());
}

/// Each part is checked against those before it: what has passed is safe to ask, if not true.
void Structure::load(sparse::ArchiveReader& from) {
  const auto load = [&from](auto&& part) {
    if (from.is_good()) {
      part();
    }
  };
  load([&] { types().load(from); });
  load([&] { maps().load(from); });
  load([&] { bodies_.load(from); });
  load([&] { cells_.load(from, maps()); });
  load([&] { from.check(has_sound_bodies(), "each cell is one of a body"); });
  load([&] { forest_.load(from, cells_, maps()); });
  load([&] { lazy_.load(from, NameReader::most_nested); });
  load([&] { values_.load(from); });
  load([&] { from.check(has_sound_families(), "a family is made of other bodies"); });
  // Copies and moves, which are not known yet, are checked as they come.
  const Moment now{cells_.size(), forest_.links(), none, lazy_.families(), none, cells_.asked()};
  load([&] { splits_.load(from, now, cells_, maps()); });
  load([&] { from.check(keep_to_bodies(*this), "a cell is of the body of its faces and of what it has become"); });
  load([&] { cones_.load(from, now); });
  load([&] {
    from.check(
        std::all_of(cones_.begin(), cones_.end(), [this](const Cone& cone) { return is_sound(cone, cells_, lazy_); }),
        "a cone is one from a vertex");
  });
  load([&] { directory_.load(from); });
  load([&] {
    abstract_.load(from, [this](CellId cell, std::size_t dimension) {
      return cell < cells_.size() && is_simplex(cells_.type(cell).type) &&
             static_cast<std::size_t>(cells_.dimension(cell)) == dimension;
    });
  });
  load([&] { darts_.load(from, cells_, types()); });
  load([&] {
    for (std::uint32_t k = 0; k < darts_.maps(); ++k) {
      from.check(darts_.map(k).name < directory_.names().size(), "a map has a name");
    }
  });
  load([&] {
    counts_ = from.get_list<std::vector<std::uint64_t>>();
    from.check(counts_.size() <= largest_dimension + 1 && has_sound_counts(), "the cells are counted");
    for (CellId c = 0; c < cells_.size(); ++c) {
      if (is_current(c) && is_cone_part(cells_.type(c).type)) {
        bodies_.count_part(static_cast<std::size_t>(dimension(c)), 1);
      }
    }
  });
  journal_.clear();
}

/// Whether the lists of the cells that bodies were made of are lists of all.
bool Structure::has_sound_bodies() const {
  bool is_sound = true;
  cells_.for_each_node([&](CellId c) { is_sound = is_sound && cells_.body(c) < bodies_.size(); });
  std::uint64_t listed = 0;
  for (BodyId b = 0; b < bodies_.size() && is_sound; ++b) {
    for (const auto& [first, last] : bodies_.made(b).cells) {
      is_sound = is_sound && first < last && last <= cells_.size();
      for (CellId c = first; is_sound && c < last; ++c) {
        is_sound = cells_.body(c) == b;
      }
      listed += last - first;
      is_sound = is_sound && listed <= cells_.size();
    }
  }
  return is_sound && listed == cells_.size();
}

bool Structure::has_sound_families() const {
  const FamilyId families = lazy_.families();
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    const FamilyId made_as = bodies_.made(b).family, consumed_by = bodies_.consumed_by(b);
    if ((made_as != none && (made_as >= families || lazy_.family(made_as).body != b)) ||
        (consumed_by != none &&
         (consumed_by >= families || bodies_.nesting(b) >= bodies_.nesting(lazy_.family(consumed_by).body)))) {
      return false;
    }
  }
  return true;
}

/// Whether all cells of the factors of a product of maps can be multiplied.
bool Structure::has_sound_factors(const LazyFamily& family) const {
  for (const BodyId body : family.bodies) {
    for (const CellId cell : lazy_.cells_of(body)) {
      const TypeInfo& type = cells_.type(cell);
      bool is_sound = ProductTypes::is_factor(type);
      for (std::uint32_t k = 0; is_sound && type.dimension > 1 && k < type.faces.size(); ++k) {
        is_sound = !values_.face_of_cell(cell, k).is_degenerate();
      }
      if (!is_sound) {
        return false;
      }
    }
  }
  return true;
}

/// Whether a family has as many cells as the bodies that it is made of say.
bool Structure::has_sound_count(const LazyFamily& family) const {
  const bool needs_simplices =
      family.kind == FamilyKind::simplicial_product || (family.kind == FamilyKind::cone && !family.by_edges);
  if (needs_simplices && !std::all_of(family.bodies.begin(), family.bodies.end(),
                                      [this](BodyId body) { return bodies_.has_only_simplices(body); })) {
    return false;
  }
  if (family.kind == FamilyKind::map_product && !has_sound_factors(family)) {
    return false;
  }
  std::vector<std::uint64_t> expected;
  if (family.kind == FamilyKind::cone) {
    for (const BodyId body : family.bodies) {
      add_cells_of_cone(bodies_.counts(body), expected);
    }
  } else {
    const CellCounts lefts = bodies_.counts(family.bodies[0]), rights = bodies_.counts(family.bodies[1]);
    if (lefts.size() + rights.size() > largest_dimension + 2) {
      return false;
    }
    expected = cells_of_product(lefts, rights, family.kind == FamilyKind::simplicial_product);
  }
  return are_equal(family.counts, expected) &&
         std::all_of(expected.begin(), expected.end(), [](std::uint64_t count) { return count <= largest_count; });
}

/// Whether all cells have been counted right. Bodies are made of earlier ones, so there is an end to what is believed.
bool Structure::has_sound_counts() const {
  using Counts = std::vector<std::uint64_t>;
  std::vector<BodyId> roots(bodies_.size());
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    roots[b] = bodies_.find(b);
  }
  std::vector<Counts> found(bodies_.size());
  std::vector<std::uint64_t> simploids(bodies_.size(), 0);
  const auto add = [&](CellId c, std::uint64_t change) {
    Counts& counts = found[roots[cells_.body(c)]];
    const auto p = static_cast<std::size_t>(dimension(c));
    if (counts.size() <= p) {
      counts.resize(p + 1, 0);
    }
    counts[p] += change;
    simploids[roots[cells_.body(c)]] += is_simplex(cells_.type(c).type) ? 0 : change;
  };
  for (CellId c = 0; c < cells_.size(); ++c) {
    if (is_current(c) && !is_cone_part(cells_.type(c).type)) {
      add(c, 1);
    }
  }
  for (FamilyId f = 0; f < lazy_.families(); ++f) {
    if (!has_sound_count(lazy_.family(f))) {
      return false;
    }
    add_counts(lazy_.family(f).counts, found[roots[lazy_.family(f).body]], false);
    simploids[roots[lazy_.family(f).body]] += simploids_of(lazy_.family(f), bodies_);
  }
  for (CellId c = asked_node(0); c < cells_.asked(); ++c) {
    if (cells_.lazy(c) != none && !is_current(c)) {
      add(c, UINT64_MAX);
    }
  }
  Counts all;
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    if (roots[b] == b) {
      if (!are_equal(found[b], bodies_.counts(b)) || simploids[b] != bodies_.simploids(b)) {
        return false;
      }
      if (bodies_.consumed_by(b) == none) {
        add_counts(bodies_.counts(b), all, false);
      }
    }
  }
  return are_equal(all, counts_);
}

}  // namespace sesame::ops
