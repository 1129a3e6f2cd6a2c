#include "tools/mesh/cover_loops.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "tools/mesh/basis_selection.hpp"
#include "tools/mesh/fingerprint.hpp"

namespace sesame::tools {

namespace {

using sparse::Integers;

/// Fingerprints by numbers, which say whether they are equal.
class Sums {
 public:
  Sums(const Fingerprinter& fingerprinter, const Annotation& annotation)
      : fingerprinter_{fingerprinter}, annotation_{annotation} {
    number_of(Fingerprint{});
  }

  /// The sum beyond an edge, when it is this one before.
  std::uint32_t beyond(std::uint32_t sum, std::uint32_t from, const EdgeGraph::Way& way) {
    const auto& vector = annotation_.of_edge[way.edge];
    if (vector.empty()) {
      return sum;
    }
    Fingerprint result = sums_[sum];
    const Fingerprint change = fingerprinter_.of(vector);
    if (from < way.to) {
      fingerprinter_.add(result, change);
    } else {
      fingerprinter_.subtract(result, change);
    }
    return number_of(result);
  }
  [[nodiscard]] const Fingerprint& operator[](std::uint32_t sum) const { return sums_[sum]; }

 private:
  std::uint32_t number_of(const Fingerprint& sum) {
    const auto [at, is_new] = numbers_.try_emplace(sum, static_cast<std::uint32_t>(sums_.size()));
    if (is_new) {
      sums_.push_back(sum);
    }
    return at->second;
  }

  const Fingerprinter& fingerprinter_;
  const Annotation& annotation_;
  std::vector<Fingerprint> sums_;
  std::unordered_map<Fingerprint, std::uint32_t, FingerprintHash> numbers_;
};

/// The numbers of states, by sheet and point: in pages, since the points that a sheet has are near each other.
class StateNumbers {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  explicit StateNumbers(std::size_t points) : pages_of_sheet_{points / page_size + 1} {}

  /// `none` where nothing was put; to be written to.
  std::uint32_t& at(std::uint32_t sheet, std::uint32_t point) {
    if (sheet >= sheets_.size()) {
      sheets_.resize(sheet + 1);
    }
    auto& pages = sheets_[sheet];
    if (pages.empty()) {
      pages.resize(pages_of_sheet_);
    }
    auto& page = pages[point / page_size];
    if (!page) {
      page = std::make_unique<Page>();
      page->fill(none);
    }
    return (*page)[point % page_size];
  }

 private:
  static constexpr std::size_t page_size = 256;
  using Page = std::array<std::uint32_t, page_size>;

  std::size_t pages_of_sheet_;
  std::vector<std::vector<std::unique_ptr<Page>>> sheets_;
};

class Cover {
 public:
  Cover(const EdgeGraph& graph, const CoverSearch& search)
      : graph_{graph},
        search_{search},
        fingerprinter_{Integers{}},
        sheets_{fingerprinter_, *search.zero},
        potentials_{fingerprinter_, *search.wanted},
        longest_{search.longest},
        numbers_{graph.points()} {}

  CoverLoops from(std::uint32_t root) {
    reach({root, 0, 0, none, none, 0, false, 0}, none);
    std::size_t next_look = 4096;
    std::size_t settled = 0;
    while (!queue_.empty() && states_.size() < search_.most_states) {
      const auto [distance, here] = queue_.top();
      queue_.pop();
      if (states_[here].is_settled) {
        continue;
      }
      if (2 * distance >= longest_) {
        break;
      }
      settle(here);
      if (++settled >= next_look) {
        select();
        longest_ = found_.size() == search_.rank ? std::min(longest_, found_.back().length) : longest_;
        next_look += next_look / 4;
      }
    }
    select();
    return {std::move(found_), states_.size()};
  }

 private:
  static constexpr std::uint32_t none = StateNumbers::none;

  /// A copy of a point.
  struct State {
    std::uint32_t point;
    std::uint32_t sheet;      ///< the sum of `zero` along the way to it
    std::uint32_t potential;  ///< that of `wanted`
    std::uint32_t before;
    std::uint32_t edge;
    std::uint32_t depth;
    bool is_settled;
    double distance;
  };
  /// An edge outside the tree, between two states.
  struct Closing {
    double length;
    std::uint32_t from, to;
  };

  void reach(const State& state, std::uint32_t known) {
    if (known == none) {
      known = static_cast<std::uint32_t>(states_.size());
      numbers_.at(state.sheet, state.point) = known;
      states_.push_back(state);
    } else {
      states_[known] = state;
    }
    queue_.emplace(state.distance, known);
  }

  void settle(std::uint32_t here) {
    states_[here].is_settled = true;
    const State state = states_[here];
    for (const EdgeGraph::Way& way : graph_.ways(state.point)) {
      if (way.edge == state.edge) {
        continue;
      }
      const State next{way.to,
                       sheets_.beyond(state.sheet, state.point, way),
                       potentials_.beyond(state.potential, state.point, way),
                       here,
                       way.edge,
                       state.depth + 1,
                       false,
                       state.distance + way.length};
      const std::uint32_t there = numbers_.at(next.sheet, next.point);
      if (there != none && states_[there].is_settled) {
        close(here, there, next);
      } else if (there == none || next.distance < states_[there].distance) {
        reach(next, there);
      }
    }
  }

  /// Keeps the shortest loop of each class.
  void close(std::uint32_t from, std::uint32_t to, const State& end) {
    if (end.potential == states_[to].potential) {
      return;
    }
    Fingerprint around = potentials_[end.potential];
    fingerprinter_.subtract(around, potentials_[states_[to].potential]);
    Fingerprint back{};
    fingerprinter_.subtract(back, around);
    const double length = end.distance + states_[to].distance - 2 * distance_of_meeting(from, to);
    if (length >= longest_) {
      return;
    }
    const auto [kept, is_new] = closings_.try_emplace(std::min(around, back), Closing{length, from, to});
    if (!is_new && length < kept->second.length) {
      kept->second = {length, from, to};
    }
  }
  /// Walks from two states towards the root until their paths meet, and returns where.
  template <class Visit>
  std::uint32_t walk_to_meeting(std::uint32_t a, std::uint32_t b, Visit&& visit) const {
    while (a != b) {
      const bool is_first = states_[a].depth >= states_[b].depth;
      std::uint32_t& deeper = is_first ? a : b;
      visit(is_first, deeper);
      deeper = states_[deeper].before;
    }
    return a;
  }
  [[nodiscard]] double distance_of_meeting(std::uint32_t a, std::uint32_t b) const {
    return states_[walk_to_meeting(a, b, [](bool, std::uint32_t) {})].distance;
  }

  [[nodiscard]] Loop loop_of(const Closing& closing) const {
    Loop loop;
    loop.length = closing.length;
    std::vector<std::uint32_t> back;
    const std::uint32_t meeting = walk_to_meeting(closing.from, closing.to, [&](bool is_first, std::uint32_t state) {
      (is_first ? loop.points : back).push_back(states_[state].point);
    });
    loop.points.push_back(states_[meeting].point);
    loop.points.insert(loop.points.end(), back.rbegin(), back.rend());
    return loop;
  }

  /// The shortest loops that can be part of a basis.
  void select() {
    constexpr std::size_t most_compared = 4096;
    std::vector<Closing> closings;
    closings.reserve(closings_.size());
    for (const auto& [fingerprint, closing] : closings_) {
      closings.push_back(closing);
    }
    std::sort(closings.begin(), closings.end(), [](const Closing& a, const Closing& b) {
      return std::tie(a.length, a.from, a.to) < std::tie(b.length, b.from, b.to);
    });
    closings.resize(std::min(closings.size(), most_compared));
    BasisSelection<Integers> selection{Integers{}, search_.wanted->rank};
    found_.clear();
    for (const Closing& closing : closings) {
      if (found_.size() == search_.rank) {
        break;
      }
      Loop loop = loop_of(closing);
      if (class_of(graph_, *search_.zero, loop).empty() && selection.take(class_of(graph_, *search_.wanted, loop))) {
        found_.push_back(std::move(loop));
      }
    }
  }

  const EdgeGraph& graph_;
  const CoverSearch& search_;
  Fingerprinter fingerprinter_;
  Sums sheets_;
  Sums potentials_;
  double longest_;
  StateNumbers numbers_;
  std::vector<State> states_;
  std::unordered_map<Fingerprint, Closing, FingerprintHash> closings_;
  std::priority_queue<std::pair<double, std::uint32_t>, std::vector<std::pair<double, std::uint32_t>>, std::greater<>>
      queue_;
  std::vector<Loop> found_;
};

}  // namespace

CoverLoops loops_in_cover(const EdgeGraph& graph, const CoverSearch& search, std::uint32_t root) {
  return Cover{graph, search}.from(root);
}

}  // namespace sesame::tools
