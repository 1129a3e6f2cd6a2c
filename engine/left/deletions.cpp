#include "engine/left/deletions.hpp"

#include <algorithm>

namespace sesame::engine {

std::span<const Deletions::Face> Deletions::boundary(GeneratorId e) const {
  const auto is_before = [](const Entry& entry, GeneratorId generator) { return entry.generator < generator; };
  const auto first = std::lower_bound(entries_.begin(), entries_.end(), e, is_before);
  const auto last = std::find_if(first, entries_.end(), [e](const Entry& entry) { return entry.generator != e; });
  return {faces_.data() + (first - entries_.begin()), static_cast<std::size_t>(last - first)};
}

void Deletions::add(GeneratorId e, LinkId link) {
  const CellId deleted = structure_.forest().removed(link);
  const auto nodes = structure_.faces().of(deleted);
  const std::size_t begin = faces_.size();
  for (std::uint32_t k = 0; k < nodes.size(); ++k) {
    const auto [node, sign] = structure_.forest().find_oriented_at(nodes[k], link);
    if (node == ops::none) {
      continue;
    }
    const int coefficient = sign * structure_.faces().sign(deleted, k);
    const auto known = std::find_if(faces_.begin() + static_cast<std::ptrdiff_t>(begin), faces_.end(),
                                    [cell = node](const Face& face) { return face.node == cell; });
    if (known == faces_.end()) {
      faces_.push_back({node, coefficient});
    } else {
      known->coefficient += coefficient;
    }
  }
  const auto is_zero = [](const Face& face) { return face.coefficient == 0; };
  const auto end = std::remove_if(faces_.begin() + static_cast<std::ptrdiff_t>(begin), faces_.end(), is_zero);
  faces_.resize(static_cast<std::size_t>(end - faces_.begin()));
  for (std::size_t at = begin; at < faces_.size(); ++at) {
    const std::uint32_t before = last_over(faces_[at].node);
    if (before != ops::none) {
      last_over_.erase(hash_of(faces_[at].node), before);
    }
    last_over_.insert(hash_of(faces_[at].node), static_cast<std::uint32_t>(at));
    entries_.push_back({e, before});
  }
}

void Deletions::truncate(GeneratorId first) {
  while (!entries_.empty() && entries_.back().generator >= first) {
    const auto at = static_cast<std::uint32_t>(entries_.size() - 1);
    const std::uint64_t hash = hash_of(faces_.back().node);
    last_over_.erase(hash, at);
    if (entries_.back().previous_over != ops::none) {
      last_over_.insert(hash, entries_.back().previous_over);
    }
    entries_.pop_back();
    faces_.pop_back();
  }
}

}  // namespace sesame::engine
