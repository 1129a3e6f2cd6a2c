#include "engine/snapshot.hpp"

#include <array>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "sesame/version.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

constexpr std::string_view magic = "sesame snapshot\n";
constexpr std::uint32_t format = 3;  ///< to go up with every change of what is written

/// Differs between machines that would read the same bytes as something else.
constexpr std::array<std::uint32_t, 6> layouts{0x0102'0304,
                                               sizeof(std::size_t),
                                               sizeof(ops::Value),
                                               sizeof(ops::Moment),
                                               sizeof(ops::SplitHistory::Copy),
                                               sizeof(ops::SplitHistory::MadeMove)};

/// With more cells for each that steps made, and more than a few, a snapshot is of no use.
constexpr std::uint64_t most_lazy = 4, few = 100'000;

void put_terms(const ObjectTerms& terms, sparse::ArchiveWriter& to) {
  to.put(std::string_view{sparse::ring_name(terms.ring)});
  to.put(terms.limits.cells_of_standard);
  to.put(terms.limits.cells_per_step);
  to.put(terms.limits.cells_of_explicit_cone);
  to.put(terms.limits.cells);
  to.put(terms.undoable);
}

/// The sentence that says what is other than it is here; empty when nothing is.
std::string what_differs(const ObjectTerms& terms, sparse::ArchiveReader& from) {
  const std::string ring = from.get_text(), here{sparse::ring_name(terms.ring)};
  if (ring != here) {
    return "it is one over " + ring + ", not over " + here;
  }
  const ops::Limits& limits = terms.limits;
  for (const std::int64_t limit :
       {limits.cells_of_standard, limits.cells_per_step, limits.cells_of_explicit_cone, limits.cells}) {
    if (const auto there = from.get<std::int64_t>(); there != limit) {
      return "it was made under a limit of " + std::to_string(there) + " cells, not of " + std::to_string(limit);
    }
  }
  if (const auto undoable = from.get<std::uint64_t>(); undoable != terms.undoable) {
    return "at most " + std::to_string(undoable) + " of its steps could be undone, not " +
           std::to_string(terms.undoable);
  }
  return {};
}

/// Up to the mark.
Status read_header(const ObjectTerms& terms, sparse::ArchiveReader& from) {
  if (from.get_text_of(magic.size()) != magic) {
    return from.is_good() || from.status().error().code == Errc::bad_input
               ? Status{Error{Errc::bad_input, "this is no snapshot: one begins with \"sesame snapshot\""}}
               : from.status();
  }
  const auto its_format = from.get<std::uint32_t>();
  if (from.is_good() && its_format != format) {
    return Error{Errc::refused, "this snapshot has format " + std::to_string(its_format) + ", and this program reads " +
                                    std::to_string(format)};
  }
  const std::string version = from.get_text();
  if (from.is_good() && version != SESAME_VERSION) {
    return Error{Errc::refused, "this snapshot is of sesame " + version + ", and this is " SESAME_VERSION};
  }
  if (from.get<std::array<std::uint32_t, layouts.size()>>() != layouts && from.is_good()) {
    return Error{Errc::refused, "this snapshot was written on another kind of machine"};
  }
  if (const std::string difference = what_differs(terms, from); from.is_good() && !difference.empty()) {
    return Error{Errc::refused, "this snapshot is not of the object that is wanted: " + difference};
  }
  return from.status();
}

Result<Snapshot> read(const ObjectTerms& terms, const RebasePolicy& rebases, sparse::ArchiveReader& from) {
  if (Status header = read_header(terms, from); !header) {
    return header.error();
  }
  Snapshot snapshot;
  snapshot.mark = from.get<SnapshotMark>();
  snapshot.object = std::make_unique<LiveObject>(terms.ring, terms.limits, rebases, terms.undoable);
  snapshot.object->load(from);
  from.check(snapshot.object->applied() == snapshot.mark.operations && check_worth(*snapshot.object).has_value(),
             "it is of an object that has applied the operations of its log");
  if (Status status = from.finish(); !status) {
    return status.error();
  }
  snapshot.object->begin_equivalence();
  return snapshot;
}

}  // namespace

Status check_worth(const LiveObject& object) {
  const auto counts = object.cells();
  const std::uint64_t cells = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (object.structure().lazy().families() > 0 && cells > few &&
      cells / most_lazy > object.structure().cells().size()) {
    return Error{Errc::refused, "no snapshot is written of an object most of whose " + std::to_string(cells) +
                                    " cells are in products and cones that are not written out"};
  }
  return Done{};
}

Status write_snapshot(const LiveObject& object, const ObjectTerms& terms, const SnapshotMark& mark,
                      const sparse::ArchiveWriter::Sink& sink) {
  sparse::expects(mark.operations == object.applied(), "a snapshot is one of the present");
  if (Status worth = check_worth(object); !worth) {
    return worth;
  }
  sparse::ArchiveWriter to(sink);
  to.put_bytes(magic.data(), magic.size());
  to.put(format);
  to.put(std::string_view{SESAME_VERSION});
  to.put(layouts);
  put_terms(terms, to);
  to.put(mark);
  object.save(to);
  return to.finish();
}

Result<Snapshot> read_snapshot(sparse::ArchiveReader::Source source, std::uint64_t bytes, const ObjectTerms& terms,
                               const RebasePolicy& rebases) {
  sparse::ArchiveReader from(std::move(source), bytes);
  try {
    return read(terms, rebases, from);
  } catch (const sparse::ContractViolation& broken) {
    return Error{Errc::bad_input, std::string{"this snapshot is of no object that there can be: "} + broken.what()};
  } catch (const std::bad_alloc&) {
    return Error{Errc::limit, "out of memory while a snapshot was read"};
  }
}

}  // namespace sesame::engine
