#include "ops/simplicial/tower_complex.hpp"

#include <algorithm>

#include "sparse/contract.hpp"

namespace sesame::ops {

TowerComplex::Vertex TowerComplex::find_vertex(Label label) const {
  return Vertex{vertices_of_labels_.find(sparse::spread_bits(label), [&](Slot v) { return label_of_[v] == label; })};
}

TowerComplex::Slot TowerComplex::slots(int dimension) const {
  return dimension == 0 ? static_cast<Slot>(label_of_.size()) : simplices_.slots(static_cast<std::size_t>(dimension));
}

/// A slot for one more simplex of a dimension: one that is free, or the next one.
TowerComplex::Slot TowerComplex::take_slot(std::size_t dimension) {
  if (counts_.size() <= dimension) {
    counts_.resize(dimension + 1, 0);
    free_.resize(std::max(free_.size(), counts_.size()));
  }
  ++counts_[dimension];
  std::vector<Slot>& free = free_[dimension];
  if (free.empty()) {
    return slots(static_cast<int>(dimension));
  }
  const Slot slot = free.back();
  free.pop_back();
  return slot;
}

void TowerComplex::free_slot(std::size_t dimension, Slot slot) {
  free_[dimension].push_back(slot);
  --counts_[dimension];
  while (!counts_.empty() && counts_.back() == 0) {
    counts_.pop_back();
  }
}

// ---- inclusion

Result<TowerComplex::Slot> TowerComplex::include_vertex(Label label) {
  if (find_vertex(label) != nothing) {
    return rules().check_inclusion({&label, 1}).error();
  }
  const Vertex v{take_slot(0)};
  if (v == label_of_.size()) {
    sparse::expects(v < nothing, "fewer than 2^32 vertices");
    label_of_.push_back(label);
  } else {
    label_of_[v] = label;
  }
  vertices_of_labels_.insert(sparse::spread_bits(label), v);
  facets_size_ = 0;
  return Slot{v};
}

Result<TowerComplex::Slot> TowerComplex::include(std::span<const Label> labels) {
  if (labels.size() == 1) {
    return include_vertex(labels[0]);
  }
  const std::optional<SimplexIndex::Key> key = find_vertices(labels);
  if (!key || !find_facets(*key) || simplices_.find(*key) != nothing) {
    return rules().check_inclusion(labels).error();
  }
  const Slot slot = take_slot(labels.size() - 1);
  simplices_.include(*key, slot);
  facets_size_ = labels.size();
  return slot;
}

/// The vertices of a simplex of dimension >= 1, into vertices_. Nothing when it has not got them.
std::optional<SimplexIndex::Key> TowerComplex::find_vertices(std::span<const Label> labels) {
  if (labels.empty() || labels.size() > vertices_.size()) {
    return std::nullopt;
  }
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const Vertex v = find_vertex(labels[k]);
    std::size_t at = k;
    for (; at > 0 && vertices_[at - 1] > v; --at) {
      vertices_[at] = vertices_[at - 1];
    }
    vertices_[at] = v;
    if (v == nothing || (at > 0 && vertices_[at - 1] == v)) {
      return std::nullopt;
    }
    hash += SimplexIndex::word(v);
  }
  return SimplexIndex::Key{{vertices_.data(), labels.size()}, hash};
}

/// Into facets_. False when one is missing.
bool TowerComplex::find_facets(const SimplexIndex::Key& key) {
  if (key.vertices.size() == 2) {
    facets_[0] = key.vertices[1];
    facets_[1] = key.vertices[0];
    return true;
  }
  for (std::size_t k = 0; k < key.vertices.size(); ++k) {
    facets_[k] = simplices_.find_facet(key, k);
    if (facets_[k] == nothing) {
      return false;
    }
  }
  return true;
}

// ---- contraction

/// What becomes of a simplex that has the moved vertex.
TowerComplex::Change TowerComplex::change_of(std::size_t dimension, Slot slot) {
  const auto [fate, moved_at, survivor] = simplices_.change_of(dimension, slot, moved_, kept_);
  std::size_t kept_at = 0;
  for (const Vertex v : simplices_.vertices(dimension, slot)) {
    kept_at += v < kept_ && v != moved_ ? 1 : 0;
  }
  return {slot, survivor, fate, fate != Fate::squashed && (kept_at + moved_at) % 2 == 1, moved_at};
}

Result<const TowerComplex::Changes*> TowerComplex::plan_contraction(Label u, Label v) {
  const Vertex from = find_vertex(u);
  const Vertex to = find_vertex(v);
  if (from == nothing || to == nothing || from == to) {
    return rules().check_contraction(u, v).error();
  }
  simplices_.build_stars(free_);
  moved_ = from;
  kept_ = to;
  if (simplices_.star_size(moved_) > simplices_.star_size(kept_)) {
    std::swap(moved_, kept_);
  }
  merged_label_ = v;
  changes_.resize(std::max<std::size_t>(1, simplices_.dimensions()));
  for (std::vector<Change>& each : changes_) {
    each.clear();
  }
  changes_[0].push_back({moved_, kept_, Fate::merged, false, 0});
  simplices_.for_each_in_star(
      moved_, [this](std::size_t dimension, Slot slot) { changes_[dimension].push_back(change_of(dimension, slot)); });
  return &changes_;
}

void TowerComplex::carry_out(std::size_t dimension, const Change& change) {
  if (change.fate == Fate::renamed) {
    const std::span<Vertex> vertices{vertices_.data(), dimension + 1};
    std::ranges::copy(simplices_.vertices(dimension, change.slot), vertices.begin());
    vertices[change.moved_at] = kept_;
    std::ranges::sort(vertices);
    simplices_.rename(dimension, change.slot, vertices);
  } else {
    simplices_.exclude(dimension, change.slot);
    free_slot(dimension, change.slot);
  }
}

void TowerComplex::contract() {
  sparse::expects(moved_ != nothing, "a contraction has been worked out");
  for (std::size_t dimension = 1; dimension < changes_.size(); ++dimension) {
    for (const Change& change : changes_[dimension]) {
      carry_out(dimension, change);
    }
  }
  vertices_of_labels_.erase(sparse::spread_bits(label_of_[moved_]), moved_);
  if (label_of_[kept_] != merged_label_) {
    set_label(kept_, merged_label_);
  }
  free_slot(0, moved_);
  moved_ = none;
}

void TowerComplex::set_label(Vertex vertex, Label label) {
  vertices_of_labels_.erase(sparse::spread_bits(label_of_[vertex]), vertex);
  label_of_[vertex] = label;
  vertices_of_labels_.insert(sparse::spread_bits(label), vertex);
}

// ---- of zigzags

std::optional<TowerComplex::Slot> TowerComplex::find(std::span<const Label> labels) {
  if (labels.size() == 1) {
    const Vertex v = find_vertex(labels[0]);
    return v == nothing ? std::nullopt : std::optional{Slot{v}};
  }
  const std::optional<SimplexIndex::Key> key = find_vertices(labels);
  const Slot slot = key ? simplices_.find(*key) : nothing;
  return slot == nothing ? std::nullopt : std::optional{slot};
}

void TowerComplex::exclude(int dimension, Slot slot) {
  if (dimension == 0) {
    vertices_of_labels_.erase(sparse::spread_bits(label_of_[slot]), slot);
  } else {
    simplices_.exclude(static_cast<std::size_t>(dimension), slot);
  }
  free_slot(static_cast<std::size_t>(dimension), slot);
}

std::size_t TowerComplex::star_size(Label label) {
  simplices_.build_stars(free_);
  return std::size_t{1} + simplices_.star_size(find_vertex(label));
}

std::vector<std::vector<Label>> TowerComplex::link(Label label) {
  simplices_.build_stars(free_);
  std::vector<std::vector<Label>> found;
  simplices_.for_each_in_star(find_vertex(label), [&](std::size_t dimension, Slot slot) {
    std::vector<Label>& others = found.emplace_back(labels(static_cast<int>(dimension), slot));
    std::erase(others, label);
    std::ranges::sort(others);
  });
  std::ranges::sort(found,
                    [](const auto& x, const auto& y) { return x.size() != y.size() ? x.size() < y.size() : x < y; });
  return found;
}

void TowerComplex::relabel(Label label, Label into) { set_label(find_vertex(label), into); }

// ---- questions

std::vector<Label> TowerComplex::labels(int dimension, Slot slot) const {
  if (dimension == 0) {
    return {label_of_[slot]};
  }
  const std::span<const Vertex> vertices = simplices_.vertices(static_cast<std::size_t>(dimension), slot);
  std::vector<Label> found(vertices.size());
  std::ranges::transform(vertices, found.begin(), [&](Vertex v) { return label_of_[v]; });
  return found;
}

}  // namespace sesame::ops
