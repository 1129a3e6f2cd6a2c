#include "replay/tower/group_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "replay/script/groups.hpp"

namespace sesame::replay {
namespace {

using Factors = std::vector<sparse::Integer>;

/// Whether two lists have the same torsion by dimension, however many dimensions without any end them.
bool is_same_torsion(std::span<const Factors> one, std::span<const Factors> other) {
  const std::size_t common = std::min(one.size(), other.size());
  const auto is_empty = [](const Factors& factors) { return factors.empty(); };
  return std::ranges::equal(one.first(common), other.first(common)) &&
         std::ranges::all_of(one.subspan(common), is_empty) && std::ranges::all_of(other.subspan(common), is_empty);
}

}  // namespace

void GroupSequence::add(engine::Time time, const engine::Homology& homology, const sparse::AnyRing& ring) {
  if (time_ != time) {
    finish();
    time_ = time;
  }
  const bool are_wanted = homology.betti.empty() || dimensions_.have(homology.betti.size() - 1);
  const std::size_t dimensions = are_wanted ? homology.betti.size() : dimensions_.last + 1;
  present_.betti.assign(homology.betti.begin(), homology.betti.begin() + static_cast<std::ptrdiff_t>(dimensions));
  present_.torsion.resize(dimensions);
  for (std::size_t p = 0; p < dimensions; ++p) {
    if (present_.torsion[p] != homology.torsion[p]) {
      present_.torsion[p] = homology.torsion[p];
    }
  }
  ring_ = ring;
}

void GroupSequence::finish() {
  if (!time_) {
    return;
  }
  const engine::Time time = *std::exchange(time_, std::nullopt);
  std::size_t dimensions = present_.betti.size();  // up to the last group that is not 0
  while (dimensions > 0 && present_.betti[dimensions - 1] == 0 && present_.torsion[dimensions - 1].empty()) {
    --dimensions;
  }
  const std::span<const std::int64_t> ranks{present_.betti.data(), dimensions};
  const std::span<const Factors> torsion{present_.torsion.data(), dimensions};
  const bool has_last_torsion = !changes_.empty() && is_same_torsion(torsion, torsions_.back());
  if (has_last_torsion && std::ranges::equal(ranks, ranks_of(changes_.size() - 1))) {
    return;
  }
  if (lines_ != nullptr) {
    *lines_ << fmt::format("{:>10}  {}\n", number_text(time), homology_line(present_, ring_));
    changes_.clear();
    ranks_.clear();
  }
  if (!has_last_torsion) {
    if (lines_ != nullptr) {
      torsions_.clear();
    }
    torsions_.emplace_back(torsion.begin(), torsion.end());
  }
  changes_.push_back({time, ranks_.size(), torsions_.size() - 1});
  ranks_.insert(ranks_.end(), ranks.begin(), ranks.end());
}

std::span<const std::int64_t> GroupSequence::ranks_of(std::size_t change) const {
  const std::size_t begin = changes_[change].first_rank;
  const std::size_t end = change + 1 < changes_.size() ? changes_[change + 1].first_rank : ranks_.size();
  return std::span{ranks_}.subspan(begin, end - begin);
}

void GroupSequence::add_json(TextBuffer& text) const {
  text.add('[');
  for (std::size_t at = 0; at < changes_.size(); ++at) {
    const std::span<const std::int64_t> ranks = ranks_of(at);
    const Torsion& torsion = torsions_[changes_[at].torsion];
    text.add(at == 0 ? "[" : ",[").add_json_number(changes_[at].time).add(",[");
    for (std::size_t p = 0; p < ranks.size(); ++p) {
      text.add(p == 0 ? R"({"rank":)" : R"(,{"rank":)").add_integer(ranks[p]).add(R"(,"torsion":[)");
      for (std::size_t k = 0; p < torsion.size() && k < torsion[p].size(); ++k) {
        text.add(k == 0 ? "" : ",").add(torsion[p][k].to_string());
      }
      text.add("]}");
    }
    text.add("]]");
  }
  text.add(']');
}

}  // namespace sesame::replay
