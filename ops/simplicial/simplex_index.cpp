#include "ops/simplicial/simplex_index.hpp"

#include "sparse/contract.hpp"

namespace sesame::ops {

SimplexIndex::Key SimplexIndex::key(std::span<const Vertex> vertices) {
  std::uint64_t hash = 0;
  for (const Vertex v : vertices) {
    hash += word(v);
  }
  return {vertices, hash};
}

SimplexIndex::Change SimplexIndex::change_of(std::size_t dimension, Slot slot, Vertex moved, Vertex kept) const {
  const std::span<const Vertex> old = vertices(dimension, slot);
  Change change{Fate::squashed, 0, nothing};
  std::uint64_t hash = word(kept);
  bool has_kept = false;
  for (std::size_t k = 0; k < old.size(); ++k) {
    if (old[k] == moved) {
      change.moved_at = static_cast<std::uint8_t>(k);
    } else {
      hash += word(old[k]);
      has_kept = has_kept || old[k] == kept;
    }
  }
  touched_ += old.size();
  if (has_kept) {
    return change;
  }
  change.survivor = layers_[dimension].index.find(hash, [&](Slot other) {
    return std::ranges::all_of(vertices(dimension, other), [&](Vertex v) {
      return v == kept || (v != moved && std::ranges::find(old, v) != old.end());
    });
  });
  change.fate = change.survivor == nothing ? Fate::renamed : Fate::merged;
  return change;
}

// ---- change

void SimplexIndex::include(const Key& key, Slot slot) {
  const std::size_t size = key.vertices.size();
  if (layers_.size() < size) {
    layers_.resize(size);
  }
  Layer& layer = layers_[size - 1];
  if (slot * size == layer.vertices.size()) {
    sparse::expects(layer.vertices.size() < nothing - size, "fewer than 2^32 incidences in a dimension");
    layer.vertices.insert(layer.vertices.end(), key.vertices.begin(), key.vertices.end());
    if (has_stars_) {
      layer.next.resize(layer.vertices.size());
      layer.previous.resize(layer.vertices.size());
    }
  } else {
    std::copy_n(key.vertices.data(), size, layer.vertices.data() + size * slot);
  }
  layer.index.insert(key.hash, slot);
  if (has_stars_) {
    link(size - 1, slot);
  }
}

void SimplexIndex::exclude(std::size_t dimension, Slot slot) {
  layers_[dimension].index.erase(key(vertices(dimension, slot)).hash, slot);
  if (has_stars_) {
    unlink(dimension, slot);
  }
}

void SimplexIndex::include_again(std::size_t dimension, Slot slot) {
  layers_[dimension].index.insert(key(vertices(dimension, slot)).hash, slot);
  if (has_stars_) {
    link(dimension, slot);
  }
}

void SimplexIndex::rename(std::size_t dimension, Slot slot, std::span<const Vertex> vertices) {
  exclude(dimension, slot);
  std::ranges::copy(vertices, layers_[dimension].vertices.data() + (dimension + 1) * slot);
  include_again(dimension, slot);
}

void SimplexIndex::drop_last_slot(std::size_t dimension) {
  Layer& layer = layers_[dimension];
  layer.vertices.resize(layer.vertices.size() - (dimension + 1));
  if (has_stars_) {
    layer.next.resize(layer.vertices.size());
    layer.previous.resize(layer.vertices.size());
  }
}

// ---- stars

void SimplexIndex::build_stars() {
  if (has_stars_) {
    return;
  }
  has_stars_ = true;
  for (std::size_t dimension = 0; dimension < layers_.size(); ++dimension) {
    Layer& layer = layers_[dimension];
    layer.next.resize(layer.vertices.size());
    layer.previous.resize(layer.vertices.size());
    for (Slot slot = 0; slot < slots(dimension); ++slot) {
      link(dimension, slot);
    }
  }
}

void SimplexIndex::make_room(Layer& layer, Vertex v) {
  star_size_.resize(std::max(star_size_.size(), std::size_t{v} + 1), 0);
  layer.first.resize(star_size_.size(), nothing);
}

void SimplexIndex::link(std::size_t dimension, Slot slot) {
  Layer& layer = layers_[dimension];
  for (std::size_t k = 0; k <= dimension; ++k) {
    const auto at = static_cast<std::uint32_t>((dimension + 1) * slot + k);
    const Vertex v = layer.vertices[at];
    if (v >= layer.first.size()) {
      make_room(layer, v);
    }
    layer.next[at] = layer.first[v];
    layer.previous[at] = nothing;
    if (layer.first[v] != nothing) {
      layer.previous[layer.first[v]] = at;
    }
    layer.first[v] = at;
    ++star_size_[v];
  }
}

void SimplexIndex::unlink(std::size_t dimension, Slot slot) {
  Layer& layer = layers_[dimension];
  for (std::size_t k = 0; k <= dimension; ++k) {
    const auto at = static_cast<std::uint32_t>((dimension + 1) * slot + k);
    const std::uint32_t next = layer.next[at];
    const std::uint32_t previous = layer.previous[at];
    if (next != nothing) {
      layer.previous[next] = previous;
    }
    (previous != nothing ? layer.next[previous] : layer.first[layer.vertices[at]]) = next;
    --star_size_[layer.vertices[at]];
  }
}

}  // namespace sesame::ops
