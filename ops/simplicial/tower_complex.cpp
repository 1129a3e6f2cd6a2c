#include "ops/simplicial/tower_complex.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

std::string in_braces(std::span<const Label> labels, std::size_t without = SIZE_MAX) {
  std::string text;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (k != without) {
      text += (text.empty() ? "{" : " ") + std::to_string(labels[k]);
    }
  }
  return text + "}";
}

Error bad(std::string what) { return {Errc::bad_input, std::move(what)}; }
Error not_there(std::string what) {
  return {Errc::unknown_name, std::move(what) + " is not there; include the faces of a simplex first"};
}
Error repeated(Label label, std::span<const Label> labels) {
  return bad("vertex " + std::to_string(label) + " is repeated in " + in_braces(labels));
}

}  // namespace

TowerComplex::Vertex TowerComplex::find_vertex(Label label) const {
  return labels_.find(sparse::spread_bits(label), [&](Vertex v) { return label_of_[v] == label; });
}

std::uint64_t TowerComplex::hash_of(const Layer& layer, Slot slot) const {
  const Vertex* vertices = vertices_of(layer, slot);
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < layer.stride; ++k) {
    hash += word(vertices[k]);
  }
  return hash;
}

TowerComplex::Slot TowerComplex::slots(int dimension) const {
  if (dimension == 0) {
    return static_cast<Slot>(label_of_.size());
  }
  const auto at = static_cast<std::size_t>(dimension - 1);
  return at < layers_.size() ? static_cast<Slot>(layers_[at].vertices.size() / layers_[at].stride) : 0;
}

// ---- inclusion

Result<TowerComplex::Slot> TowerComplex::include_vertex(Label label) {
  if (find_vertex(label) != nothing) {
    return bad("vertex " + std::to_string(label) + " is there already; a simplex is included once");
  }
  Vertex v;
  if (free_vertices_.empty()) {
    sparse::expects(label_of_.size() < nothing, "fewer than 2^32 vertices");
    v = static_cast<Vertex>(label_of_.size());
    label_of_.push_back(label);
    is_vertex_.push_back(true);
    if (has_stars_) {
      star_size_.push_back(0);
    }
  } else {
    v = free_vertices_.back();
    free_vertices_.pop_back();
    label_of_[v] = label;
    is_vertex_[v] = true;
  }
  labels_.insert(sparse::spread_bits(label), v);
  if (counts_.empty()) {
    counts_.push_back(0);
  }
  ++counts_[0];
  facets_size_ = 0;
  return v;
}

Result<TowerComplex::Slot> TowerComplex::include(std::span<const Label> labels) {
  if (labels.size() == 1) {
    return include_vertex(labels[0]);
  }
  if (labels.empty() || labels.size() > vertices_.size()) {
    return bad("a simplex has from 1 to " + std::to_string(vertices_.size()) + " vertices, not " +
               std::to_string(labels.size()));
  }
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const Vertex v = find_vertex(labels[k]);
    if (v == nothing) {
      return not_there("vertex " + std::to_string(labels[k]));
    }
    hash += word(v);
    std::size_t at = k;
    for (; at > 0 && vertices_[at - 1] > v; --at) {
      vertices_[at] = vertices_[at - 1];
    }
    vertices_[at] = v;
    if (at > 0 && vertices_[at - 1] == v) {
      return repeated(labels[k], labels);
    }
  }
  const std::size_t size = labels.size();
  const std::size_t dimension = size - 1;
  if (dimension == 1) {
    facets_[0] = vertices_[1];
    facets_[1] = vertices_[0];
  } else {
    const bool has_layer_below = layers_.size() >= dimension - 1;
    for (std::size_t k = 0; k < size; ++k) {
      const Slot facet =
          has_layer_below ? find_without(layers_[dimension - 2], vertices_.data(), k, hash) : Slot{nothing};
      if (facet == nothing) {
        const Label absent = label_of_[vertices_[k]];
        return missing(labels, static_cast<std::size_t>(std::ranges::find(labels, absent) - labels.begin()));
      }
      facets_[k] = facet;
    }
  }
  Layer& layer = layer_for(dimension);
  const auto is_it = [&](Slot slot) { return std::equal(&vertices_[0], &vertices_[size], vertices_of(layer, slot)); };
  if (layer.index.find(hash, is_it) != nothing) {
    return bad("simplex " + in_braces(labels) + " is there already; a simplex is included once");
  }
  facets_size_ = size;
  return add_simplex(layer, hash);
}

Error TowerComplex::missing(std::span<const Label> labels, std::size_t without) const {
  return not_there("the face " + in_braces(labels, without) + " of " + in_braces(labels));
}

bool TowerComplex::contains(std::span<const Label> labels) const {
  if (labels.empty() || labels.size() > vertices_.size()) {
    return false;
  }
  std::array<Vertex, largest_dimension + 1> vertices;
  std::uint64_t hash = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    vertices[k] = find_vertex(labels[k]);
    if (vertices[k] == nothing) {
      return false;
    }
    hash += word(vertices[k]);
  }
  const std::size_t dimension = labels.size() - 1;
  if (dimension == 0 || dimension > layers_.size()) {
    return dimension == 0;
  }
  const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(labels.size());
  std::sort(vertices.begin(), end);
  const Layer& layer = layers_[dimension - 1];
  return layer.index.find(
             hash, [&](Slot slot) { return std::equal(vertices.begin(), end, vertices_of(layer, slot)); }) != nothing;
}

Result<std::vector<std::vector<Label>>> TowerComplex::missing_faces(std::span<const Label> labels) const {
  std::vector<Label> simplex(labels.begin(), labels.end());
  std::sort(simplex.begin(), simplex.end());
  if (const auto twice = std::adjacent_find(simplex.begin(), simplex.end()); twice != simplex.end()) {
    return repeated(*twice, labels);
  }
  // Down from the simplex: the faces of a face that is there are there.
  std::vector<std::set<std::vector<Label>>> levels{{simplex}};
  std::size_t count = 0;
  while (!levels.back().empty() && levels.back().begin()->size() > 1) {
    std::set<std::vector<Label>> below;
    for (const std::vector<Label>& above : levels.back()) {
      for (std::size_t k = 0; k < above.size(); ++k) {
        std::vector<Label> face = above;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
        if (!contains(face)) {
          below.insert(std::move(face));
        }
      }
      if (count + below.size() > most_missing) {
        return bad("the simplex " + in_braces(labels) + " lacks more than " + std::to_string(most_missing) + " faces");
      }
    }
    count += below.size();
    levels.push_back(std::move(below));
  }
  std::vector<std::vector<Label>> faces;
  for (std::size_t k = levels.size(); k-- > 1;) {
    faces.insert(faces.end(), levels[k].begin(), levels[k].end());
  }
  return faces;
}

/// The simplex of `layer` whose vertices are those given but for the one at k; `hash` is that of all of them.
TowerComplex::Slot TowerComplex::find_without(const Layer& layer, const Vertex* vertices, std::size_t k,
                                              std::uint64_t hash) const {
  return layer.index.find(hash - word(vertices[k]), [&](Slot slot) {
    const Vertex* of_slot = vertices_of(layer, slot);
    return std::equal(vertices, vertices + k, of_slot) &&
           std::equal(vertices + k + 1, vertices + layer.stride + 1, of_slot + k);
  });
}

TowerComplex::Layer& TowerComplex::layer_for(std::size_t dimension) {
  while (layers_.size() < dimension) {
    Layer layer;
    layer.stride = layers_.size() + 2;
    layers_.push_back(std::move(layer));
  }
  return layers_[dimension - 1];
}

/// Adds the simplex on vertices_.
TowerComplex::Slot TowerComplex::add_simplex(Layer& layer, std::uint64_t hash) {
  Slot slot;
  if (layer.free.empty()) {
    sparse::expects(layer.vertices.size() < nothing - layer.stride, "fewer than 2^32 incidences in a dimension");
    slot = static_cast<Slot>(layer.vertices.size() / layer.stride);
    layer.vertices.insert(layer.vertices.end(), vertices_.begin(),
                          vertices_.begin() + static_cast<std::ptrdiff_t>(layer.stride));
    if (has_stars_) {
      layer.next.resize(layer.vertices.size());
      layer.previous.resize(layer.vertices.size());
    }
  } else {
    slot = layer.free.back();
    layer.free.pop_back();
    std::copy_n(vertices_.data(), layer.stride, layer.vertices.data() + layer.stride * slot);
  }
  layer.index.insert(hash, slot);
  if (has_stars_) {
    link(layer, slot);
  }
  if (counts_.size() < layer.stride) {
    counts_.resize(layer.stride, 0);
  }
  ++counts_[layer.stride - 1];
  return slot;
}

// ---- stars

void TowerComplex::build_stars() {
  has_stars_ = true;
  star_size_.assign(label_of_.size(), 0);
  for (Layer& layer : layers_) {
    layer.next.resize(layer.vertices.size());
    layer.previous.resize(layer.vertices.size());
    layer.first.assign(label_of_.size(), nothing);
    const auto slots = static_cast<Slot>(layer.vertices.size() / layer.stride);
    for (Slot slot = 0; slot < slots; ++slot) {
      link(layer, slot);
    }
  }
}

void TowerComplex::link(Layer& layer, Slot slot) {
  for (std::size_t k = 0; k < layer.stride; ++k) {
    const auto at = static_cast<std::uint32_t>(layer.stride * slot + k);
    const Vertex v = layer.vertices[at];
    if (v >= layer.first.size()) {
      layer.first.resize(label_of_.size(), nothing);
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

void TowerComplex::unlink(Layer& layer, Slot slot) {
  for (std::size_t k = 0; k < layer.stride; ++k) {
    const auto at = static_cast<std::uint32_t>(layer.stride * slot + k);
    const std::uint32_t next = layer.next[at];
    const std::uint32_t previous = layer.previous[at];
    if (next != nothing) {
      layer.previous[next] = previous;
    }
    if (previous != nothing) {
      layer.next[previous] = next;
    } else {
      layer.first[layer.vertices[at]] = next;
    }
    --star_size_[layer.vertices[at]];
  }
}

// ---- contraction

/// What becomes of a simplex that has the moved vertex. Leaves its vertices after the move in vertices_, when renamed.
TowerComplex::Change TowerComplex::change_of(const Layer& layer, Slot slot) {
  const Vertex* old = vertices_of(layer, slot);
  std::size_t moved_at = 0;
  std::uint64_t hash = word(kept_);
  bool has_kept = false;
  for (std::size_t k = 0; k < layer.stride; ++k) {
    if (old[k] == moved_) {
      moved_at = k;
    } else {
      hash += word(old[k]);
      has_kept = has_kept || old[k] == kept_;
    }
  }
  touched_ += layer.stride;
  Change change{slot, nothing, Fate::squashed, false, static_cast<std::uint8_t>(moved_at)};
  if (has_kept) {
    return change;
  }
  std::size_t size = 0;
  std::size_t kept_at = SIZE_MAX;
  for (std::size_t k = 0; k < layer.stride; ++k) {
    if (k == moved_at) {
      continue;
    }
    if (kept_at == SIZE_MAX && old[k] > kept_) {
      kept_at = size;
      vertices_[size++] = kept_;
    }
    vertices_[size++] = old[k];
  }
  if (kept_at == SIZE_MAX) {
    kept_at = size;
    vertices_[size] = kept_;
  }
  change.survivor = layer.index.find(hash, [&](Slot other) {
    return std::equal(vertices_.data(), vertices_.data() + layer.stride, vertices_of(layer, other));
  });
  change.fate = change.survivor == nothing ? Fate::renamed : Fate::merged;
  change.is_reversed = (kept_at + moved_at) % 2 == 1;
  return change;
}

Result<const TowerComplex::Changes*> TowerComplex::plan_contraction(Label u, Label v) {
  const Vertex from = find_vertex(u);
  const Vertex to = find_vertex(v);
  if (from == nothing || to == nothing) {
    return bad("vertex " + std::to_string(from == nothing ? u : v) +
               " is not there; only two vertices of the complex " + "can be contracted");
  }
  if (from == to) {
    return bad("vertex " + std::to_string(u) + " cannot be contracted into itself");
  }
  if (!has_stars_) {
    build_stars();
  }
  const bool moves_from = star_size_[from] <= star_size_[to];
  moved_ = moves_from ? from : to;
  kept_ = moves_from ? to : from;
  merged_label_ = v;
  changes_.resize(layers_.size() + 1);
  changes_[0].assign(1, Change{moved_, kept_, Fate::merged, false, 0});
  for (std::size_t at = 0; at < layers_.size(); ++at) {
    const Layer& layer = layers_[at];
    changes_[at + 1].clear();
    if (moved_ >= layer.first.size()) {
      continue;
    }
    for (std::uint32_t where = layer.first[moved_]; where != nothing; where = layer.next[where]) {
      changes_[at + 1].push_back(change_of(layer, static_cast<Slot>(where / layer.stride)));
    }
  }
  return &changes_;
}

void TowerComplex::count_down(std::size_t dimension) {
  --counts_[dimension];
  while (!counts_.empty() && counts_.back() == 0) {
    counts_.pop_back();
  }
}

void TowerComplex::carry_out(Layer& layer, const Change& change) {
  layer.index.erase(hash_of(layer, change.slot), change.slot);
  unlink(layer, change.slot);
  Vertex* vertices = layer.vertices.data() + layer.stride * change.slot;
  if (change.fate != Fate::renamed) {
    vertices[0] = nothing;
    layer.free.push_back(change.slot);
    count_down(layer.stride - 1);
    return;
  }
  vertices[change.moved_at] = kept_;
  std::sort(vertices, vertices + layer.stride);
  layer.index.insert(hash_of(layer, change.slot), change.slot);
  link(layer, change.slot);
}

void TowerComplex::contract() {
  sparse::expects(moved_ != nothing, "a contraction has been worked out");
  for (std::size_t at = 0; at < layers_.size(); ++at) {
    for (const Change& change : changes_[at + 1]) {
      carry_out(layers_[at], change);
    }
  }
  labels_.erase(sparse::spread_bits(label_of_[moved_]), moved_);
  if (label_of_[kept_] != merged_label_) {
    labels_.erase(sparse::spread_bits(label_of_[kept_]), kept_);
    label_of_[kept_] = merged_label_;
    labels_.insert(sparse::spread_bits(merged_label_), kept_);
  }
  is_vertex_[moved_] = false;
  free_vertices_.push_back(moved_);
  count_down(0);
  moved_ = nothing;
}

// ---- questions

TowerComplex::Slot TowerComplex::facet(int dimension, Slot slot, std::size_t k) const {
  const auto d = static_cast<std::size_t>(dimension);
  const Vertex* vertices = vertices_of(layers_[d - 1], slot);
  if (d == 1) {
    return vertices[1 - k];
  }
  return find_without(layers_[d - 2], vertices, k, hash_of(layers_[d - 1], slot));
}

std::vector<Label> TowerComplex::labels(int dimension, Slot slot) const {
  if (dimension == 0) {
    return {label_of_[slot]};
  }
  const Layer& layer = layers_[static_cast<std::size_t>(dimension - 1)];
  std::vector<Label> found(layer.stride);
  std::transform(vertices_of(layer, slot), vertices_of(layer, slot) + layer.stride, found.begin(),
                 [&](Vertex v) { return label_of_[v]; });
  return found;
}

}  // namespace sesame::ops
