#include "ops/simplicial/zigzag_complex.hpp"

#include <algorithm>
#include <string>

namespace sesame::ops {
namespace {

std::string listed(std::span<const Label> labels) {
  std::string text;
  for (const Label label : labels) {
    text += (text.empty() ? "" : " ") + std::to_string(label);
  }
  return "{" + text + "}";
}

std::vector<Label> with(std::vector<Label> simplex, Label vertex) {
  simplex.push_back(vertex);
  return simplex;
}

}  // namespace

Result<ZigzagComplex::Cell> ZigzagComplex::include(std::span<const Label> labels) {
  const Result<Slot> slot = complex_.include(labels);
  if (!slot) {
    return slot.error();
  }
  const std::size_t dimension = labels.size() - 1;
  if (layers_.size() <= dimension) {
    layers_.resize(dimension + 1);
  }
  Layer& layer = layers_[dimension];
  const std::span<const Slot> own = facets();
  if (*slot >= layer.cofaces.size()) {
    layer.cofaces.resize(*slot + std::size_t{1});
    layer.facets.resize(layer.facets.size() + own.size());
  }
  std::ranges::copy(own, layer.facets.begin() + static_cast<std::ptrdiff_t>(own.size() * *slot));
  layer.cofaces[*slot] = 0;
  for (const Slot facet : own) {
    ++layers_[dimension - 1].cofaces[facet];
  }
  return Cell{static_cast<int>(dimension), *slot};
}

Result<ZigzagComplex::Cell> ZigzagComplex::exclude(std::span<const Label> labels) {
  const std::optional<Slot> slot = labels.empty() ? std::nullopt : complex_.find(labels);
  if (!slot) {
    return Error{Errc::bad_input,
                 "simplex " + listed(labels) + " is not there; only a simplex of the complex can be deleted"};
  }
  const Cell cell{static_cast<int>(labels.size()) - 1, *slot};
  if (layers_[labels.size() - 1].cofaces[*slot] > 0) {
    return has_coface(labels, cell);
  }
  return take_out(cell);
}

ZigzagComplex::Cell ZigzagComplex::take_out(Cell cell) {
  const auto dimension = static_cast<std::size_t>(cell.dimension);
  complex_.exclude(cell.dimension, cell.slot);
  if (dimension > 0) {
    const std::size_t size = dimension + 1;
    for (const Slot facet : std::span{layers_[dimension].facets}.subspan(size * cell.slot, size)) {
      --layers_[dimension - 1].cofaces[facet];
    }
  }
  return cell;
}

/// A coface is looked for among all simplices of the next dimension: this is said once.
Error ZigzagComplex::has_coface(std::span<const Label> labels, Cell cell) const {
  const std::size_t above = labels.size();
  std::vector<Label> coface;
  complex_.for_each(static_cast<int>(above), [&](Slot slot) {
    const std::span<const Slot> facets = std::span{layers_[above].facets}.subspan((above + 1) * slot, above + 1);
    if (coface.empty() && std::ranges::find(facets, cell.slot) != facets.end()) {
      coface = complex_.labels(static_cast<int>(above), slot);
    }
  });
  std::ranges::sort(coface);
  return {Errc::bad_input,
          "simplex " + listed(labels) + " is a face of " + listed(coface) + ", which should be deleted before it"};
}

Status ZigzagComplex::contract(Label u, Label v, const Listener& listener) {
  if (Status legal = rules().check_contraction(u, v); !legal) {
    return legal;
  }
  const bool moves_u = complex_.star_size(u) <= complex_.star_size(v);
  const Label moved = moves_u ? u : v;
  const Label kept = moves_u ? v : u;
  const auto add = [&](const std::vector<Label>& simplex) {
    if (!complex_.find(simplex)) {
      const Cell cell = include(simplex).value();
      listener.include(cell, facets());
    }
  };
  add({moved, kept});
  for (const std::vector<Label>& others : complex_.link(moved)) {
    if (std::ranges::find(others, kept) == others.end()) {
      add(with(others, kept));
      add(with(with(others, kept), moved));
    }
  }
  const std::vector<std::vector<Label>> link = complex_.link(moved);
  std::for_each(link.rbegin(), link.rend(),
                [&](const std::vector<Label>& others) { listener.exclude(exclude(with(others, moved)).value()); });
  listener.exclude(exclude({&moved, 1}).value());
  if (!moves_u) {
    complex_.relabel(kept, v);
  }
  return Done{};
}

}  // namespace sesame::ops
