#include "replay/tower/tower_history.hpp"

#include <algorithm>
#include <array>

namespace sesame::replay {
void TowerHistory::include(std::span<const Label> labels) {
  if (labels.size() == 1) {
    current_[labels[0]] = static_cast<Vertex>(vertices_.size());
    vertices_.emplace_back().names.emplace_back(operations_, labels[0]);
  }
  ++operations_;
  for (const Label label : labels) {
    simplices_.push_back(current_.at(label));
  }
  first_.push_back(simplices_.size());
}

void TowerHistory::include_cell() {
  ++operations_;
  has_cells_ = true;
}

void TowerHistory::contract(Label u, Label v) {
  const auto from = current_.find(u);
  const auto to = current_.find(v);
  const bool is_from_larger = vertices_[from->second].size > vertices_[to->second].size;
  const Vertex root = is_from_larger ? from->second : to->second;
  const Vertex other = is_from_larger ? to->second : from->second;
  vertices_[other].parent = root;
  vertices_[other].linked_by = operations_;
  vertices_[root].size += vertices_[other].size;
  if (is_from_larger) {
    vertices_[root].names.emplace_back(operations_, v);
    to->second = root;
  }
  current_.erase(from);
  ++operations_;
}

ops::Label TowerHistory::label_at(Vertex v, std::uint64_t operation) const {
  while (vertices_[v].parent != none && vertices_[v].linked_by <= operation) {
    v = vertices_[v].parent;
  }
  const auto& names = vertices_[v].names;
  const auto after = std::ranges::upper_bound(names, operation, {}, &std::pair<std::uint64_t, Label>::first);
  return std::prev(after)->second;
}

TowerHistory::NamedChain TowerHistory::image(const engine::InclusionChain& chain, std::uint64_t operation,
                                             std::uint32_t p) const {
  // Most simplices of long histories are squashed by then, so nothing is allocated before that is known.
  std::vector<NamedChain::Term> terms;
  std::array<Label, ops::TowerComplex::largest_dimension + 1> name;
  for (const auto& [coefficient, inclusion] : chain.terms) {
    std::size_t size = 0;
    bool is_reversed = false;
    if (has_cells_) {
      name[size++] = inclusion;
    }
    for (std::uint64_t at = has_cells_ ? 0 : first_[inclusion]; !has_cells_ && at < first_[inclusion + 1]; ++at) {
      name[size++] = label_at(simplices_[at], operation);
      for (std::size_t k = size - 1; k > 0 && name[k - 1] > name[k]; --k) {
        std::swap(name[k - 1], name[k]);
        is_reversed = !is_reversed;
      }
    }
    if (std::adjacent_find(name.begin(), name.begin() + size) == name.begin() + size) {
      terms.push_back({is_reversed ? -coefficient : coefficient, {name.begin(), name.begin() + size}});
    }
  }
  std::ranges::sort(terms, {}, &NamedChain::Term::generator);
  NamedChain image{chain.degree, {}};
  for (std::size_t at = 0; at < terms.size();) {
    sparse::Rational sum;
    std::size_t next = at;
    for (; next < terms.size() && terms[next].generator == terms[at].generator; ++next) {
      sum += terms[next].coefficient;
    }
    sum = smallest_residue(sum, p);
    if (!sum.is_zero()) {
      image.terms.push_back({std::move(sum), std::move(terms[at].generator)});
    }
    at = next;
  }
  return image;
}

}  // namespace sesame::replay
