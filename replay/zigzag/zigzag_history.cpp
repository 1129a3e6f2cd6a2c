#include "replay/zigzag/zigzag_history.hpp"

#include <algorithm>

namespace sesame::replay {

using engine::Time;
using engine::ZigzagChain;

/// Facet k is the one without vertex k: so vertex 0 is the first of facet 1, and the others are facet 0.
void ZigzagHistory::include(int dimension, Slot slot, std::span<const Slot> facets, engine::Moment) {
  const auto d = static_cast<std::size_t>(dimension);
  if (layers_.size() <= d) {
    layers_.resize(d + 1);
  }
  Layer& layer = layers_[d];
  if (layer.at_slots.size() <= slot) {
    layer.at_slots.resize(slot + std::size_t{1});
  }
  layer.at_slots[slot] = layer.vertices.size() / (d + 1);
  if (d == 0) {
    layer.vertices.push_back(static_cast<Vertex>(names_.size()));
    names_.emplace_back();
    return;
  }
  const auto of_facet = [&](std::size_t k) { return vertices(dimension - 1, layers_[d - 1].at_slots[facets[k]]); };
  layer.vertices.push_back(of_facet(1).front());
  const std::span<const Vertex> others = of_facet(0);
  layer.vertices.insert(layer.vertices.end(), others.begin(), others.end());
}

void ZigzagHistory::exclude(int dimension, Slot slot, engine::Moment) {
  if (dimension == 0) {
    last_excluded_ = static_cast<Vertex>(layers_[0].at_slots[slot]);
  }
}

void ZigzagHistory::end_operation(const TowerOperation& operation) {
  switch (operation.kind) {
    case TowerOperation::Kind::insert:
      if (operation.labels.size() == 1) {
        called_[operation.labels[0]] = static_cast<Vertex>(names_.size() - 1);
        names_.back().emplace_back(operation.time, operation.labels[0]);
      }
      return;
    case TowerOperation::Kind::remove:
      if (operation.labels.size() == 1) {
        called_.erase(operation.labels[0]);
      }
      return;
    case TowerOperation::Kind::contract: {
      // One of the two is there no more, whichever had the smaller star; the other one has the second label now.
      const auto from = called_.find(operation.labels[0]);
      Vertex& to = called_.at(operation.labels[1]);
      if (to == last_excluded_) {
        to = from->second;
        names_[to].emplace_back(operation.time, operation.labels[1]);
      }
      called_.erase(from);
      return;
    }
    case TowerOperation::Kind::column:
      return;
  }
}

std::span<const ZigzagHistory::Vertex> ZigzagHistory::vertices(int dimension, std::uint64_t simplex) const {
  const auto size = static_cast<std::size_t>(dimension) + 1;
  return std::span{layers_[static_cast<std::size_t>(dimension)].vertices}.subspan(size * simplex, size);
}

ops::Label ZigzagHistory::label_at(Vertex vertex, Time time) const {
  const Names& names = names_[vertex];
  const auto after = std::ranges::find_if(names, [&](const auto& name) { return name.first > time; });
  return std::prev(after)->second;
}

/// The times between two others at which a vertex of the chain is called something else, ascending.
std::vector<Time> ZigzagHistory::changes(const ZigzagChain& chain, Time after, Time before) const {
  std::vector<Time> found;
  const auto add = [&](Vertex vertex) {
    for (std::size_t k = 1; k < names_[vertex].size(); ++k) {
      if (const Time time = names_[vertex][k].first; time > after && time < before) {
        found.push_back(time);
      }
    }
  };
  for (const auto& [coefficient, simplex] : chain.terms) {
    std::ranges::for_each(vertices(chain.degree, simplex), add);
  }
  std::ranges::sort(found, [](Time a, Time b) { return a < b; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

NamedChain ZigzagHistory::named_at(const ZigzagChain& chain, Time time) const {
  NamedChain named{chain.degree, {}};
  for (const auto& [coefficient, simplex] : chain.terms) {
    std::vector<Label> name;
    bool is_reversed = false;
    for (const Vertex each : vertices(chain.degree, simplex)) {
      name.push_back(label_at(each, time));
      for (std::size_t k = name.size() - 1; k > 0 && name[k - 1] > name[k]; --k) {
        std::swap(name[k - 1], name[k]);
        is_reversed = !is_reversed;
      }
    }
    named.terms.push_back(
        {smallest_residue(is_reversed ? -coefficient : coefficient, characteristic_), std::move(name)});
  }
  std::ranges::sort(named.terms, {}, &NamedChain::Term::generator);
  return named;
}

std::vector<NamedPiece> ZigzagHistory::named(const engine::MomentBar& bar,
                                             std::span<const engine::CyclePiece> pieces) const {
  std::vector<NamedPiece> found;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Time from = pieces[k].from.time;
    const Time until = k + 1 < pieces.size() ? pieces[k + 1].from.time : bar.death.time;
    if (from == until) {
      continue;
    }
    std::vector<Time> times = changes(pieces[k].cycle, from, until);
    times.insert(times.begin(), from);
    for (const Time time : times) {
      NamedChain cycle = named_at(pieces[k].cycle, time);
      if (found.empty() || found.back().cycle != cycle) {
        found.push_back({time, until, std::move(cycle)});
      }
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    found[k].until = k + 1 < found.size() ? found[k + 1].from : bar.death.time;
  }
  return found;
}

}  // namespace sesame::replay
