/// \file
/// What has happened to a cell structure: elementary events, one after the other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace sesame::ops {

/// The kinds of elementary events. What an event did stands in the structure, under its number: that of a node is its
/// id, everything else is numbered in a list of its own.
enum class EventKind : std::uint8_t {
  cell,        ///< a node: a cell was made, with its faces and its name
  copy,        ///< a node: a cell was made, with its name, as a copy of another
  degenerate,  ///< a node was made for a degenerate cell
  lazy,        ///< a node: a cell of a lazy family was asked for
  expansion,   ///< the faces of one were asked for
  removal,     ///< a cell became another one, or degenerate
  deletion,    ///< a cell was taken away; numbered among the removals
  move,        ///< an incidence went to a copy
  family,      ///< bodies became a product or a lazy cone
  cone,        ///< a cone was written out
  name,        ///< a name of a body that is none of a cell
  body,        ///< a body was made
  union_of_bodies,
  body_kind,   ///< a body became less of an abstract complex than it was
  simplicial,  ///< a change in the abstract simplicial complexes
  darts,       ///< something happened to darts of maps: see DartStore
};
inline constexpr std::size_t event_kinds = 16;

/// How many events there were, by kind.
struct EventCounts {
  std::array<std::uint64_t, event_kinds> of{};

  [[nodiscard]] std::uint64_t operator[](EventKind kind) const { return of[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] std::uint64_t& operator[](EventKind kind) { return of[static_cast<std::size_t>(kind)]; }
};

/// The events in their order, those of a kind that follow one another as one run of 8 bytes.
///
/// This is the one record of what a step did: undo pops events, and who follows the structure reads them from where it
/// has come to.
class Journal {
 public:
  /// How many events there had been.
  using Position = std::uint64_t;

  /// Events of one kind, one after the other, with numbers that go up by one.
  struct Run {
    EventKind kind;
    std::uint32_t first;  ///< number
    std::uint32_t count;
  };

  [[nodiscard]] Position end() const { return end_; }
  /// From here on events are known: those before are forgotten.
  [[nodiscard]] Position begin() const { return begin_; }
  /// Forgets events before a position, whole runs of them. They can not be undone any more. Cost: their runs.
  void forget_before(Position position) {
    while (!runs_.empty() && begin_ + runs_.front().count() <= position) {
      begin_ += runs_.front().count();
      runs_.pop_front();
    }
  }
  void append(EventKind kind, std::uint32_t number) {
    ++end_;
    if (!runs_.empty()) {
      Packed& last = runs_.back();
      if (last.kind() == kind && last.first + last.count() == number && last.count() < longest_run) {
        last.kind_and_count += 1U;
        return;
      }
    }
    runs_.push_back({number, static_cast<std::uint32_t>(kind) << count_bits | 1U});
  }
  /// Forgets them all, and begins again.
  void clear() {
    runs_.clear();
    begin_ = end_ = 0;
  }
  /// Removes the last event. Returns its kind. Requires: there is one that is not forgotten.
  EventKind pop() {
    --end_;
    const EventKind kind = runs_.back().kind();
    runs_.back().kind_and_count -= 1U;
    if (runs_.back().count() == 0) {
      runs_.pop_back();
    }
    return kind;
  }

  /// Calls visit(run) for the events from a position on, in their order, but not for those that visit itself makes
  /// happen. Requires: none of them is forgotten. Cost: the runs since then.
  template <class Visit>
  void for_each_since(Position position, Visit&& visit) const {
    const Position last = end_;
    std::size_t at = runs_.size();
    Position begin = last;  // of the runs from `at` on
    while (begin > position) {
      --at;
      begin -= runs_[at].count();
    }
    for (; position < last; ++at) {
      const Packed run = runs_[at];
      const auto passed = static_cast<std::uint32_t>(position - begin);
      const auto count = static_cast<std::uint32_t>(std::min<Position>(run.count() - passed, last - position));
      visit(Run{run.kind(), run.first + passed, count});
      position += count;
      begin = position;
    }
  }
  /// The events from a position on. Cost: the runs since then.
  [[nodiscard]] EventCounts counts_since(Position position) const {
    EventCounts counts;
    for_each_since(position, [&](const Run& run) { counts[run.kind] += run.count; });
    return counts;
  }

 private:
  static constexpr std::uint32_t count_bits = 28;
  static constexpr std::uint32_t longest_run = (1U << count_bits) - 1;
  struct Packed {
    std::uint32_t first, kind_and_count;

    [[nodiscard]] EventKind kind() const { return static_cast<EventKind>(kind_and_count >> count_bits); }
    [[nodiscard]] std::uint32_t count() const { return kind_and_count & longest_run; }
  };
  static_assert(event_kinds <= 1U << (32 - count_bits));

  std::deque<Packed> runs_;
  Position begin_ = 0;  ///< of the first of these
  Position end_ = 0;
};

}  // namespace sesame::ops
