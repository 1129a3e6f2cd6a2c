// Snapshots with an honest checksum, whatever they say: they are refused with a sentence, or come to an object that can
// be looked at from all sides, and written and read again.
#include "engine/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/fuzz/draws.hpp"
#include "tests/fuzz/engines.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/snapshots.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::LiveObject;
using engine::ObjectTerms;

namespace {

const LiveObject::WriteAhead is_written = [](const ops::Operation&) { return Done{}; };
constexpr std::uint64_t largest = 3000;  ///< number of cells of an object that is looked at

ObjectTerms terms_over(int ring) {
  static const char* const names[] = {"Z", "Z/2", "Z/3", "Q"};
  return {sparse::parse_ring(names[ring]).value(), small_limits, UINT64_MAX};
}

std::unique_ptr<LiveObject> new_object(const ObjectTerms& terms) {
  auto object = std::make_unique<LiveObject>(terms.ring, terms.limits, engine::RebasePolicy{}, terms.undoable);
  object->watch(few_cells);
  return object;
}

Bytes written(const LiveObject& object, const ObjectTerms& terms) {
  Bytes bytes;
  const Status status = write_snapshot(object, terms, {object.applied(), 77, 78}, sink_into(bytes));
  demand(went_well(status), "an object can be written");
  return bytes;
}

Result<engine::Snapshot> read(const Bytes& bytes, const ObjectTerms& terms) {
  return read_snapshot(source_of(bytes), bytes.size(), terms, {});
}

/// The bytes before the mark: they depend on the version, and inputs should not.
std::size_t size_of_header(const ObjectTerms& terms) {
  const Bytes bytes = written(*new_object(terms), terms);
  constexpr std::array<std::uint64_t, 3> mark{0, 77, 78};
  const auto* const begin = reinterpret_cast<const char*>(mark.data());
  return static_cast<std::size_t>(std::search(bytes.begin(), bytes.end(), begin, begin + sizeof mark) - bytes.begin());
}

/// An object of a few steps that bytes say.
std::unique_ptr<LiveObject> made(const ObjectTerms& terms, ByteDraws draws) {
  std::unique_ptr<LiveObject> object = new_object(terms);
  DrawnSteps<ByteDraws> steps(draws, everything_and_maps(20));
  for (int k = draws.in(1, 12); k > 0; --k) {
    if (draws.one_in(4)) {
      const auto label = [&] { return std::to_string(draws.in(0, 5)); };
      const ops::Operation step = draws.one_in(3)
                                      ? ops::Operation{ops::Collapse{label(), label()}}
                                      : ops::Insert{{std::vector<std::string>{label(), label(), label()}}, true};
      (void)went_well(object->apply(step, is_written));
    } else {
      (void)went_well(object->apply(steps.next(object->structure()), is_written));
    }
  }
  return object;
}

std::string look_at(LiveObject& object) {
  object.structure().lazy().make_all();  // as an equivalence does that is begun afresh
  std::string text = "applied " + std::to_string(object.applied()) + ", undoable " + std::to_string(object.undoable());
  const engine::Homology homology = object.homology();
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += "; " + std::to_string(object.cells()[p]) + " cells, rank " + std::to_string(homology.betti[p]);
    for (const sparse::Integer& t : homology.torsion[p]) {
      text += " " + t.to_string();
    }
  }
  return text;
}

/// What it says is of no interest, as long as it says something; an engine gives up an object that throws.
void look_everywhere(LiveObject& object, const ObjectTerms& terms) {
  std::uint64_t cells = 0;
  for (const std::uint64_t count : object.cells()) {
    cells += std::min(count, largest);
  }
  if (cells > largest) {
    return;
  }
  try {
    object.watch(few_cells);
    (void)look_at(object);
    (void)written(object, terms);
    std::vector<ops::CellId> nodes;
    object.structure().cells().for_each_node([&](ops::CellId c) { nodes.push_back(c); });
    nodes.resize(std::min<std::size_t>(nodes.size(), 200));
    for (const ops::CellId c : nodes) {
      const std::string name = object.structure().directory().own_name(c);
      (void)object.structure().denoted(name);
      (void)object.plan(ops::Identify{{{name, "nobody"}}, {}});
    }
    RandomSteps steps(1, everything_and_maps(40));
    for (int k = 0; k < 4; ++k) {
      (void)object.apply(steps.next(object.structure()), is_written);
    }
    (void)object.apply(ops::Undo{2}, is_written);
  } catch (const std::exception&) {
  }
}

void take(Bytes bytes, const ObjectTerms& terms) {
  seal(bytes);
  const Result<engine::Snapshot> snapshot = read(bytes, terms);
  if (went_well(snapshot)) {
    look_everywhere(*snapshot->object, terms);
  }
}

/// What is written is read, says the same, and keeps the laws.
void demand_round_trip(LiveObject& object, const ObjectTerms& terms) {
  const std::string before = look_at(object);
  const Bytes bytes = written(object, terms);
  const Result<engine::Snapshot> snapshot = read(bytes, terms);
  demand(went_well(snapshot), "a snapshot that is written is read");
  demand_equal(look_at(*snapshot->object), before, "a snapshot that is read is of the same object");
  // Not always with the same bytes: whoever looks at an object may have nodes made for degenerate cells.
  const Result<engine::Snapshot> again = read(written(*snapshot->object, terms), terms);
  demand(went_well(again), "an object that was read is written, and read once more");
  demand_equal(look_at(*again->object), before, "and says the same");
  const auto defect = snapshot->object->first_defect();
  demand(!defect, "a law: " + defect.value_or(""));
}

/// A snapshot of an object that bytes say, in which bytes are changed.
void change(ByteDraws draws, const ObjectTerms& terms) {
  const int changes = draws.in(0, 4);
  std::array<std::uint32_t, 4> places{}, words{};
  for (int k = 0; k < changes; ++k) {
    places[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(draws.in(0, 0xFFFF));
    words[static_cast<std::size_t>(k)] = draws.one_in(2) ? draws.word() : draws.byte();
  }
  const std::unique_ptr<LiveObject> object = made(terms, draws);
  if (changes == 0) {
    demand_round_trip(*object, terms);
    return;
  }
  Bytes bytes = written(*object, terms);
  const std::size_t begin = size_of_header(terms), end = bytes.size() - sizeof(std::uint64_t);
  for (int k = 0; k < changes; ++k) {
    const std::size_t at = begin + places[static_cast<std::size_t>(k)] % (end - begin);
    std::memcpy(bytes.data() + at, &words[static_cast<std::size_t>(k)], std::min(sizeof words[0], end - at));
  }
  take(std::move(bytes), terms);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteDraws draws(text_of(data, size));
  const int kind = draws.byte();
  const ObjectTerms terms = terms_over(kind % 4);
  if (kind / 4 % 2 == 0) {
    change(draws, terms);
    return 0;
  }
  // What follows the header, as it is, and room for the checksum.
  Bytes bytes = written(*new_object(terms), terms);
  bytes.resize(size_of_header(terms));
  const std::string_view rest = draws.rest();
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  bytes.resize(bytes.size() + sizeof(std::uint64_t));
  take(std::move(bytes), terms);
  return 0;
}
