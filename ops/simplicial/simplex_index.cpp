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

void SimplexIndex::build_stars(std::span<const std::vector<Slot>> gone) {
  if (has_stars_) {
    return;
  }
  has_stars_ = true;
  for (std::size_t dimension = 0; dimension < layers_.size(); ++dimension) {
    Layer& layer = layers_[dimension];
    layer.next.resize(layer.vertices.size());
    layer.previous.resize(layer.vertices.size());
    std::vector<bool> is_gone(slots(dimension), false);
    if (dimension < gone.size()) {
      for (const Slot slot : gone[dimension]) {
        if (slot < is_gone.size()) {  // vertices are often the matter of somebody else
          is_gone[slot] = true;
        }
      }
    }
    for (Slot slot = 0; slot < slots(dimension); ++slot) {
      if (!is_gone[slot]) {
        link(dimension, slot);
      }
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

// ---- archives

/// Of each dimension the vertices of the slots, and the links of the stars, one list after the other: those of
/// simplices that are gone are in none.
void SimplexIndex::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(layers_.size()));
  for (const Layer& layer : layers_) {
    to.put_list(layer.vertices);
    std::vector<std::uint32_t> links;
    links.reserve(layer.vertices.size());
    for (std::uint32_t where : layer.first) {
      for (; where != nothing; where = layer.next[where]) {
        links.push_back(where);
      }
    }
    to.put_list(links);
  }
}

void SimplexIndex::load(sparse::ArchiveReader& from, std::size_t vertices) {
  has_stars_ = true;
  const std::size_t dimensions = from.get_count(2 * sizeof(std::uint64_t));
  if (!from.check(dimensions <= largest_dimension + 1, "no simplex has a dimension above 62")) {
    return;
  }
  layers_.resize(dimensions);
  star_size_.assign(vertices, 0);
  for (std::size_t dimension = 0; dimension < dimensions && from.is_good(); ++dimension) {
    load_simplices(from, dimension, vertices);
    load_stars(from, dimension);
  }
}

void SimplexIndex::load_simplices(sparse::ArchiveReader& from, std::size_t dimension, std::size_t vertices) {
  Layer& layer = layers_[dimension];
  layer.vertices = from.get_list<std::vector<Vertex>>();
  bool is_sound = layer.vertices.size() % (dimension + 1) == 0 && layer.vertices.size() < nothing;
  for (std::size_t at = 0; at < layer.vertices.size() && is_sound; ++at) {
    const auto begin = layer.vertices.begin() + static_cast<std::ptrdiff_t>(at - at % (dimension + 1));
    const auto here = layer.vertices.begin() + static_cast<std::ptrdiff_t>(at);
    is_sound = *here < vertices && std::find(begin, here, *here) == here;
  }
  from.check(is_sound, "a simplex has different vertices");
}

void SimplexIndex::load_stars(sparse::ArchiveReader& from, std::size_t dimension) {
  Layer& layer = layers_[dimension];
  const auto links = from.get_list<std::vector<std::uint32_t>>();
  layer.first.assign(star_size_.size(), nothing);
  layer.next.assign(layer.vertices.size(), nothing);
  layer.previous.assign(layer.vertices.size(), nothing);
  std::vector<bool> is_linked(layer.vertices.size());
  std::uint32_t before = nothing;
  for (const std::uint32_t where : links) {
    if (!from.check(where < layer.vertices.size() && !is_linked[where] &&
                        (before == nothing || layer.vertices[before] <= layer.vertices[where]),
                    "the simplices that have a vertex are listed by this")) {
      return;
    }
    const Vertex v = layer.vertices[where];
    if (before != nothing && layer.vertices[before] == v) {
      layer.next[before] = where;
      layer.previous[where] = before;
    } else {
      layer.first[v] = where;
    }
    is_linked[where] = true;
    ++star_size_[v];
    before = where;
  }
  for (Slot slot = 0; slot < slots(dimension) && from.is_good(); ++slot) {
    const auto begin = is_linked.begin() + static_cast<std::ptrdiff_t>(slot * (dimension + 1));
    const auto linked =
        static_cast<std::size_t>(std::count(begin, begin + static_cast<std::ptrdiff_t>(dimension + 1), true));
    if (linked == 0) {
      continue;  // it is gone
    }
    const auto own = vertices(dimension, slot);
    const auto is_same = [&](Slot other) {
      const auto others = vertices(dimension, other);
      return std::is_permutation(own.begin(), own.end(), others.begin());
    };
    from.check(linked == dimension + 1 && layer.index.insert_new(key(own).hash, slot, is_same),
               "a simplex is in the stars of its vertices, once");
  }
}

}  // namespace sesame::ops
