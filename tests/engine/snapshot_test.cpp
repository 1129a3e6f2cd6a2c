// Snapshots: what is read is the object that was written, whatever happens to both from then on.
#include "engine/snapshot.hpp"

#include <exception>

#include "tests/support/abstract_steps.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/snapshots.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::LiveObject;
using engine::ObjectTerms;
using engine::Snapshot;

namespace {

const LiveObject::WriteAhead is_written = [](const ops::Operation&) { return Done{}; };

ObjectTerms terms_over(const std::string& ring) { return {.ring = ring_named(ring)}; }

std::unique_ptr<LiveObject> new_object(const ObjectTerms& terms) {
  return std::make_unique<LiveObject>(terms.ring, terms.limits, taking_splits_in, terms.undoable);
}

Bytes written(const LiveObject& object, const ObjectTerms& terms) {
  Bytes bytes;
  const Status status = write_snapshot(object, terms, {object.applied(), 77, 78}, sink_into(bytes));
  if (!status) {
    FAIL(status.error().what);
  }
  return bytes;
}

Result<Snapshot> read(const Bytes& bytes, const ObjectTerms& terms) {
  return read_snapshot(source_of(bytes), bytes.size(), terms, taking_splits_in);
}

std::unique_ptr<LiveObject> object_of(const Bytes& bytes, const ObjectTerms& terms) {
  Result<Snapshot> snapshot = read(bytes, terms);
  if (!snapshot) {
    FAIL(snapshot.error().what);
  }
  return std::move(snapshot.value().object);
}

/// What two objects that have come to the same by different ways have in common.
std::string look_at(LiveObject& object) {
  std::string text = dump(object.structure());
  const engine::Homology homology = object.homology();
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += "H" + std::to_string(p) + " " + std::to_string(homology.betti[p]);
    for (const Integer& t : homology.torsion[p]) {
      text += " " + t.to_string();
    }
    text += "\n";
  }
  return text + "applied " + std::to_string(object.applied()) + " undoable " + std::to_string(object.undoable()) +
         " euler " + std::to_string(object.euler_characteristic()) + "\n";
}

/// A gluing of two cells that are simplices of one dimension, by a random map of their vertices; not always legal.
std::optional<ops::Operation> random_twist(const ops::Structure& structure, Random& random) {
  const auto cells = current_cells(structure);
  for (int tries = 0; tries < 20 && !cells.empty(); ++tries) {
    const auto any = [&] { return cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))]; };
    const ops::CellId a = any(), b = any();
    const int dimension = structure.dimension(a);
    if (a == b || dimension == 0 || structure.cells().type_id(a) != structure.cells().type_id(b) ||
        !ops::is_simplex(structure.cells().type(a).type)) {
      continue;
    }
    std::vector<int> map;
    for (int v = 0; v <= dimension; ++v) {
      map.insert(map.begin() + random.in(0, static_cast<int>(map.size())), v);
    }
    return ops::Identify{{{structure.name(a), structure.name(b)}}, {{0, {map}}}};
  }
  return std::nullopt;
}

/// A stream of all there is: cells of all kinds, and beside them an abstract complex. Some of it is refused.
class AllSteps {
 public:
  explicit AllSteps(unsigned seed) : steps_{seed, everything_and_maps(40)}, abstract_{seed, 7, 2} {}

  Random& random() { return steps_.random(); }
  ops::Operation next(const ops::Structure& structure) {
    if (random().one_in(4)) {
      return abstract_.next();
    }
    if (random().one_in(5)) {
      if (auto twist = random_twist(structure, random())) {
        return *twist;
      }
    }
    if (random().one_in(10)) {  // a name of any node
      const std::vector<ops::CellId> nodes = nodes_of(structure);
      if (!nodes.empty()) {
        const auto any = [&] {
          return structure.directory().own_name(
              nodes[static_cast<std::size_t>(random().in(0, static_cast<int>(nodes.size()) - 1))]);
        };
        return ops::Identify{{{any(), any()}}};
      }
    }
    return steps_.next(structure);
  }

 private:
  RandomSteps steps_;
  RandomAbstractSteps abstract_;
};

/// Applies an operation to both: both take it or refuse it in the same words.
void apply_to_both(LiveObject& one, LiveObject& other, const ops::Operation& operation) {
  CAPTURE(ops::to_text(operation));
  const auto report = one.apply(operation, is_written);
  const auto other_report = other.apply(operation, is_written);
  REQUIRE(report.has_value() == other_report.has_value());
  if (!report) {
    REQUIRE(report.error().what == other_report.error().what);
    return;
  }
  CHECK(report->step == other_report->step);
  CHECK(report->kind == other_report->kind);
  REQUIRE(first_difference(look_at(one), look_at(other)) == "");
}

}  // namespace

TEST_CASE("what is read from a snapshot is the object that was written, in all that follows",
          "[engine][snapshot][stream]") {
  const unsigned seed = GENERATE(range(0U, 24U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3", "Q");
  CAPTURE(seed, ring);
  const ObjectTerms terms = terms_over(ring);
  const std::unique_ptr<LiveObject> object = new_object(terms);
  std::unique_ptr<LiveObject> twin;
  AllSteps steps(seed);
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    if (steps.random().one_in(6)) {
      const std::string before = look_at(*object);
      const Bytes bytes = written(*object, terms);
      CHECK(written(*object, terms) == bytes);
      CHECK(look_at(*object) == before);
      twin = object_of(bytes, terms);
      REQUIRE(first_difference(look_at(*twin), before) == "");
      REQUIRE(twin->first_defect().value_or("") == "");
      CHECK(twin->undoable_here() == 0);
    }
    if (twin != nullptr && twin->undoable_here() > 0 && steps.random().one_in(6)) {
      const ops::Undo undo{static_cast<std::uint64_t>(steps.random().in(1, static_cast<int>(twin->undoable_here())))};
      CHECK_FALSE(twin->needs_earlier_steps(undo));
      apply_to_both(*object, *twin, undo);
      continue;
    }
    const ops::Operation operation = steps.next(object->structure());
    if (twin != nullptr) {
      apply_to_both(*object, *twin, operation);
      REQUIRE(twin->first_defect().value_or("") == "");
    } else {
      (void)object->apply(operation, is_written);
    }
  }
}

TEST_CASE("a snapshot that was read is written with the same bytes", "[engine][snapshot][stream]") {
  const unsigned seed = GENERATE(range(100U, 130U));
  CAPTURE(seed);
  const ObjectTerms terms = terms_over("Z");
  const std::unique_ptr<LiveObject> object = new_object(terms);
  AllSteps steps(seed);
  for (int k = 0; k < 30; ++k) {
    (void)object->apply(steps.next(object->structure()), is_written);
    if (steps.random().one_in(9) && object->undoable() > 2) {
      REQUIRE(object->apply(ops::Undo{2}, is_written));
    }
  }
  (void)look_at(*object);  // which makes all lazy cells, as the equivalence of the other does
  const Bytes bytes = written(*object, terms);
  CHECK(written(*object_of(bytes, terms), terms) == bytes);
}

TEST_CASE("steps from before a snapshot are counted, and taken back by whoever does them again", "[engine][snapshot]") {
  const ObjectTerms terms{ring_named("Z/2"), {}, 5};
  const std::unique_ptr<LiveObject> object = new_object(terms);
  for (const char* name : {"a", "b", "c"}) {
    REQUIRE(object->apply(ops::MakeSimplex{name, 1, {}}, is_written));
  }
  const std::unique_ptr<LiveObject> twin = object_of(written(*object, terms), terms);
  REQUIRE(twin->apply(ops::MakeSimplex{"d", 1, {}}, is_written));
  CHECK(twin->undoable() == 4);
  CHECK(twin->undoable_here() == 1);
  CHECK(twin->needs_earlier_steps(ops::Undo{2}));
  CHECK(twin->needs_earlier_steps(ops::Undo{4}));
  CHECK_FALSE(twin->needs_earlier_steps(ops::Undo{5}));  // nobody can
  CHECK_FALSE(twin->needs_earlier_steps(ops::Note{"x"}));
  CHECK_FALSE(twin->apply(ops::Undo{2}, is_written));
  const auto too_many = twin->apply(ops::Undo{5}, is_written);
  REQUIRE_FALSE(too_many);
  CHECK(too_many.error().what == "cannot undo 5 steps: only 4 can be undone");
  CHECK(twin->barcode_needs_earlier_steps());
  CHECK_FALSE(twin->barcode());
  // The limit forgets what is below first.
  for (const char* name : {"e", "f", "g", "h", "i"}) {
    REQUIRE(twin->apply(ops::MakeSimplex{name, 1, {}}, is_written));
    CHECK(twin->undoable() == 5);
  }
  CHECK(twin->undoable_here() == 5);
  CHECK_FALSE(twin->barcode_needs_earlier_steps());  // no barcode anyhow
  CHECK(twin->barcode().error().what == "there is no barcode: only the last 5 steps are kept");
  REQUIRE(twin->apply(ops::Undo{5}, is_written));
  CHECK(twin->cells()[1] == 4);
  CHECK(twin->apply(ops::Undo{1}, is_written).error().what ==
        "cannot undo 1 steps: only 0 can be undone, as older ones are not kept");
}

TEST_CASE("a snapshot of nothing is one", "[engine][snapshot]") {
  const ObjectTerms terms = terms_over("Q");
  const std::unique_ptr<LiveObject> object = new_object(terms);
  Result<Snapshot> snapshot = read(written(*object, terms), terms);
  REQUIRE(snapshot);
  CHECK(snapshot->mark == engine::SnapshotMark{0, 77, 78});
  LiveObject& twin = *snapshot->object;
  REQUIRE(twin.apply(ops::MakeSimplex{"a", 2, {}}, is_written));
  CHECK(twin.barcode().has_value());
}

TEST_CASE("a snapshot of an object on other terms is refused", "[engine][snapshot]") {
  const ObjectTerms terms = terms_over("Z");
  const std::unique_ptr<LiveObject> object = new_object(terms);
  REQUIRE(object->apply(ops::MakeSimplex{"a", 2, {}}, is_written));
  const Bytes bytes = written(*object, terms);
  const auto refusal = [&](const ObjectTerms& other) {
    const Result<Snapshot> snapshot = read(bytes, other);
    REQUIRE_FALSE(snapshot);
    CHECK(snapshot.error().code == Errc::refused);
    return snapshot.error().what;
  };
  CHECK(refusal(terms_over("Q")) == "this snapshot is not of the object that is wanted: it is one over Z, not over Q");
  ObjectTerms limited = terms;
  limited.limits.cells = 7;
  CHECK(refusal(limited) ==
        "this snapshot is not of the object that is wanted: it was made under a limit of 1000000000 cells, not of 7");
  ObjectTerms forgetful = terms;
  forgetful.undoable = 3;
  CHECK(refusal(forgetful).find("could be undone") != std::string::npos);
  Bytes newer = bytes;
  newer[16] = 99;  // behind "sesame snapshot\n"
  const Result<Snapshot> snapshot = read(newer, terms);
  REQUIRE_FALSE(snapshot);
  CHECK(snapshot.error().what == "this snapshot has format 99, and this program reads 3");
  const Bytes text{'{',  '"', 'o', 'p', '"', ':', '"', 'n', 'o', 't', 'e', '"', '}',
                   '\n', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' '};
  CHECK(read(text, terms).error().what == "this is no snapshot: one begins with \"sesame snapshot\"");
}

namespace {

/// An object that has some of everything.
std::unique_ptr<LiveObject> some_object(unsigned seed, const ObjectTerms& terms) {
  std::unique_ptr<LiveObject> object = new_object(terms);
  AllSteps steps(seed);
  for (int k = 0; k < 30; ++k) {
    (void)object->apply(steps.next(object->structure()), is_written);
  }
  return object;
}

/// Whatever can be read is looked at from all sides; what it says is of no interest, as long as it says something.
void look_everywhere(LiveObject& object, const ObjectTerms& terms) {
  try {
    (void)look_at(object);
    (void)written(object, terms);
    for (const ops::CellId c : nodes_of(object.structure())) {
      const std::string name = object.structure().directory().own_name(c);
      (void)object.structure().denoted(name);
      (void)object.plan(ops::Identify{{{name, "nobody"}}});
    }
    AllSteps steps(1);
    for (int k = 0; k < 6; ++k) {
      (void)object.apply(steps.next(object.structure()), is_written);
    }
    (void)object.apply(ops::Undo{2}, is_written);
  } catch (const std::exception&) {
    // an engine gives such an object up
  }
}

}  // namespace

TEST_CASE("a snapshot that has been cut off anywhere is told", "[engine][snapshot]") {
  const ObjectTerms terms = terms_over("Z");
  const Bytes whole = written(*some_object(1, terms), terms);
  for (std::size_t size = 0; size < whole.size(); size += size < 500 ? 1 : 7) {
    CAPTURE(size);
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    const Result<Snapshot> snapshot = read(part, terms);
    REQUIRE_FALSE(snapshot);
    REQUIRE(snapshot.error().code == Errc::bad_input);
  }
}

TEST_CASE("a snapshot with a wrong bit is told", "[engine][snapshot]") {
  const ObjectTerms terms = terms_over("Z");
  const Bytes whole = written(*some_object(GENERATE(2U, 3U), terms), terms);
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += 37) {
    CAPTURE(bit);
    Bytes other = whole;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    REQUIRE_FALSE(read(other, terms));
  }
}

TEST_CASE("nonsense with an honest checksum does no harm", "[engine][snapshot][hostile]") {
  const unsigned seed = GENERATE(range(0U, 12U));
  const ObjectTerms terms = terms_over(seed % 2 == 0 ? "Z" : "Z/3");
  const Bytes whole = written(*some_object(seed, terms), terms);
  Random random{seed};
  int read_all_the_same = 0;
  for (int k = 0; k < 1500; ++k) {
    Bytes other = whole;
    const int changes = random.one_in(3) ? random.in(2, 5) : 1;
    for (int change = 0; change < changes; ++change) {
      const auto at = static_cast<std::size_t>(random.in(150, static_cast<int>(whole.size()) - 12));
      const std::uint32_t words[] = {
          0, 1, 2, 3, 7, UINT32_MAX, 0x8000'0000U, 0x8000'0001U, static_cast<std::uint32_t>(random.in(0, 200))};
      if (random.one_in(3)) {
        other[at] = static_cast<char>(random.in(0, 255));
      } else if (random.one_in(2)) {
        other[at] = static_cast<char>(other[at] ^ (1 << random.in(0, 7)));
      } else {
        std::memcpy(other.data() + at, &words[random.in(0, 8)], sizeof(std::uint32_t));
      }
    }
    seal(other);
    const Result<Snapshot> snapshot = read(other, terms);
    if (snapshot) {
      ++read_all_the_same;
      look_everywhere(*snapshot->object, terms);
    }
  }
  UNSCOPED_INFO(read_all_the_same);
  CHECK(read_all_the_same > 20);  // or else nothing is looked at
  CHECK(read_all_the_same < 1500);
}
