/// \file
/// Snapshots: what a log of operations has come to, so that whoever opens the log again need not do all of it again.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/live_object.hpp"
#include "sparse/archive.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// How far the log had come. A snapshot is of use with a log that has the same bytes up to there only, which is for the
/// caller to see to.
struct SnapshotMark {
  std::uint64_t operations = 0;     ///< that were applied, undos included
  std::uint64_t log_bytes = 0;      ///< that they take
  std::uint64_t hash_of_bytes = 0;  ///< of these
  friend bool operator==(const SnapshotMark&, const SnapshotMark&) = default;
};

/// What an object was made with. A snapshot of one that was made with something else is refused.
struct ObjectTerms {
  sparse::AnyRing ring = sparse::Integers{};
  ops::Limits limits = {};
  std::uint64_t undoable = UINT64_MAX;
};

/// Threads: one at a time, for queries too.
struct Snapshot {
  SnapshotMark mark;
  std::unique_ptr<LiveObject> object;
};

/// Refused when most cells of the object are in lazy families, which an equivalence that is begun afresh would have to
/// write out: doing the steps again is quicker.
Status check_worth(const LiveObject& object);

/// Writes a snapshot of an object, which stays as it is: cells, names, what can be undone, but not how it came about.
/// The same object gives the same bytes. Requires: `mark.operations` is what the object has applied.
/// Errors    those of the sink, and of check_worth.
/// Cost      the cells ever made, with their faces and names.
Status write_snapshot(const LiveObject& object, const ObjectTerms& terms, const SnapshotMark& mark,
                      const sparse::ArchiveWriter::Sink& sink);

/// Reads one of so many bytes. Its steps up to the mark can be undone by an object only that does them again: see
/// LiveObject::needs_earlier_steps.
/// Errors    those of the source; refused when it was written by another version of this program, or of an object made
///           on other terms; bad_input when it is no snapshot, or damaged. Nothing that it says is believed before it
///           has been looked at, so what has an honest checksum and is nonsense is told, too, as far as it would do
///           harm.
/// Cost      the cells ever made, with their faces and names, and reducing the object.
Result<Snapshot> read_snapshot(sparse::ArchiveReader::Source source, std::uint64_t bytes, const ObjectTerms& terms,
                               const RebasePolicy& rebases);

}  // namespace sesame::engine
