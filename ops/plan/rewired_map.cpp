#include "ops/plan/rewired_map.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

template <class Next>
std::vector<Dart> cell(int dimension, int i, Dart start, Next next) {
  std::vector<Dart> found{start};
  std::unordered_set<Dart> met{start};
  for (std::size_t at = 0; at < found.size(); ++at) {
    for (int k = 0; k <= dimension; ++k) {
      if (const Dart reached = k == i ? start : next(k, found[at]); met.insert(reached).second) {
        found.push_back(reached);
      }
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

RewiredMap::RewiredMap(const DartStore& store, int dimension, const CellSurgery& surgery)
    : store_{store},
      dimension_{dimension},
      surgery_{surgery},
      first_made_{store.darts(dimension)},
      gone_(surgery.gone.begin(), surgery.gone.end()) {
  for (const auto& [i, dart, image] : surgery.images) {
    images_.emplace(key(i, dart), image);
  }
}

Dart RewiredMap::after(int i, Dart d) const {
  const auto at = images_.find(key(i, d));
  return at != images_.end() ? at->second : is_made(d) ? d : before(i, d);
}

std::set<Dart> RewiredMap::rewired_but_for(int i) const {
  std::set<Dart> rewired(gone_.begin(), gone_.end());
  for (const auto& [k, dart, image] : surgery_.images) {
    if (k != i) {
      rewired.insert(dart);
    }
  }
  for (Dart d = first_made_; d < first_made_ + surgery_.made; ++d) {
    rewired.insert(d);
  }
  return rewired;
}

std::vector<Dart> RewiredMap::cell_before(int i, Dart d) const {
  return cell(dimension_, i, d, [this](int k, Dart of) { return before(k, of); });
}

std::vector<Dart> RewiredMap::cell_after(int i, Dart d) const {
  return cell(dimension_, i, d, [this](int k, Dart of) { return after(k, of); });
}

GMap RewiredMap::map_of_cell(int i, const std::vector<Dart>& darts) const {
  std::unordered_map<Dart, Dart> number;
  for (Dart k = 0; k < darts.size(); ++k) {
    number.emplace(darts[k], k);
  }
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(dimension_) + 1);
  for (int k = 0; k <= dimension_; ++k) {
    for (const Dart d : darts) {
      alpha[static_cast<std::size_t>(k)].push_back(number.at(k == i ? d : after(k, d)));
    }
  }
  Result<GMap> map = GMap::make(std::move(alpha));
  sparse::expects(map.has_value(), "local operations lead from map to map");
  return std::move(*map);
}

/// First all comes apart that will not be together, then the rest is sewn.
void RewiredMap::write(int with, Plan& plan) const {
  std::unordered_set<Key> apart;
  const auto unsew = [&](int i, Dart d) {
    const Dart image = before(i, d);
    if (image != d && apart.insert(key(i, std::min(d, image))).second) {
      plan.sewings.push_back({dimension_, i, d, image, true});
    }
  };
  for (const Dart d : surgery_.gone) {
    for (int i = 0; i <= dimension_; ++i) {
      unsew(i, d);
    }
  }
  for (const auto& [i, dart, image] : surgery_.images) {
    if (!is_made(dart) && before(i, dart) != image) {
      unsew(i, dart);
    }
  }
  for (const auto& [i, dart, image] : surgery_.images) {
    const bool is_new = is_made(image) ? !is_made(dart) : !is_made(dart) && before(i, dart) != image && dart < image;
    if (is_new) {
      plan.sewings.push_back({dimension_, i, dart, image});
    }
  }
  for (const Dart d : surgery_.gone) {
    plan.darts_taken_out.push_back({dimension_, with, d});
  }
  if (surgery_.made > 0) {
    write_new_map(plan);
  }
}

/// As it is by itself, before it is sewn to what is there.
void RewiredMap::write_new_map(Plan& plan) const {
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(dimension_) + 1);
  auto cells = std::make_shared<DartCells>();
  cells->of.assign(alpha.size(), std::vector<DartCells::Seen>(surgery_.made, {UINT32_MAX, 0}));
  for (int i = 0; i <= dimension_; ++i) {
    for (Dart d = 0; d < surgery_.made; ++d) {
      const Dart image = after(i, first_made_ + d);
      alpha[static_cast<std::size_t>(i)].push_back(is_made(image) ? image - first_made_ : d);
    }
  }
  Result<GMap> map = GMap::make(std::move(alpha));
  sparse::expects(map.has_value(), "new darts by themselves are a map");
  plan.map = NewMap{std::move(*map), std::move(cells), false, 0};
}

}  // namespace sesame::ops
