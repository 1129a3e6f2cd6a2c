/// \file
/// Objects that forget: the successor of one that has known many more cells than it has.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/live_object.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::engine {

/// Cells that are gone, and that no undo can bring back, still have their numbers, faces and names in an object. Now
/// and then a *successor* is begun with the cells that there are. It does the same steps beside the object, until it
/// can take back as many; then it takes the place of the object, which goes with all that was gone in it. What the
/// successor cannot do, such as an undo of steps from before it, or a step that uses a name which it does not have,
/// ends it, and another one is begun later: so it changes nothing that the object would say.
///
/// Cost: an object has a successor for about one of nine steps, which then costs twice; beginning one, the cells made
/// since the last one, of which there are several for each that is there. Memory: that of some times the object, and of
/// some times the steps that can be undone.
///
/// Threads: one at a time, for queries too.
class Renewal {
 public:
  using Begin = std::function<std::unique_ptr<LiveObject>()>;

  /// `undoable`: so many steps can be undone. `begin` makes an empty object on the terms of the others.
  Renewal(std::uint64_t undoable, Begin begin) : undoable_{undoable}, begin_{std::move(begin)} {}

  /// To be called after each step of the object. Whether there is a successor that can take the place of the object.
  /// When memory runs out there is none, and the object is as it was, unless it has lazy cells, of which some may have
  /// been under way.
  [[nodiscard]] bool after_step(const LiveObject& object, const ops::Operation& step);
  /// The successor, when it has these groups, which are those of the object; or null. Requires: there is one.
  [[nodiscard]] std::unique_ptr<LiveObject> successor(const LiveObject& object, const Homology& groups);
  /// Another object has taken the place, or may have: there is no successor.
  void drop() { next_.reset(); }
  /// The same, and no other is begun soon.
  void end(const LiveObject& object);

 private:
  [[nodiscard]] bool is_time(const LiveObject& object) const;
  void begin(const LiveObject& object);
  /// Whether the successor has done the step as well.
  [[nodiscard]] bool follows(const LiveObject& object, const ops::Operation& step);

  std::uint64_t undoable_;
  Begin begin_;
  std::unique_ptr<LiveObject> next_;
  std::uint64_t begun_ = 0, next_time_ = 0;  ///< steps applied when that was begun, and before another one is
};

}  // namespace sesame::engine
