#include "ops/cells/journal.hpp"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/structures.hpp"

using namespace sesame;
using ops::EventKind;
using ops::Journal;

namespace {

using Event = std::pair<EventKind, std::uint32_t>;

std::vector<Event> events_since(const Journal& journal, Journal::Position position) {
  std::vector<Event> events;
  journal.for_each_since(position, [&](const Journal::Run& run) {
    for (std::uint32_t k = 0; k < run.count; ++k) {
      events.emplace_back(run.kind, run.first + k);
    }
  });
  return events;
}

/// An event, which often goes on from the last one. `draw(n)`: a random number below n.
template <class Draw>
void append_random(Journal& journal, std::vector<Event>& plain, Draw draw) {
  const bool goes_on = draw(3) != 0 && !plain.empty();
  const auto kind = static_cast<EventKind>(draw(ops::event_kinds));
  plain.push_back(goes_on ? Event{plain.back().first, plain.back().second + 1} : Event{kind, draw(100)});
  journal.append(plain.back().first, plain.back().second);
}

}  // namespace

TEST_CASE("a journal is what a plain list of events is, from every position", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 8U)));
  const auto draw = [&](unsigned below) { return static_cast<std::uint32_t>(random() % below); };
  Journal journal;
  std::vector<Event> plain;
  for (int step = 0; step < 400; ++step) {
    if (draw(4) == 0 && !plain.empty()) {
      REQUIRE(journal.pop() == plain.back().first);
      plain.pop_back();
    } else {
      append_random(journal, plain, draw);
    }
    REQUIRE(journal.end() == plain.size());
    const std::size_t from = draw(static_cast<unsigned>(plain.size()) + 1);
    const std::vector<Event> since(plain.begin() + static_cast<std::ptrdiff_t>(from), plain.end());
    REQUIRE(events_since(journal, from) == since);
    for (std::size_t kind = 0; kind < ops::event_kinds; ++kind) {
      const auto is_it = [&](const Event& event) { return event.first == static_cast<EventKind>(kind); };
      REQUIRE(journal.counts_since(from)[static_cast<EventKind>(kind)] ==
              static_cast<std::uint64_t>(std::count_if(since.begin(), since.end(), is_it)));
    }
  }
}

TEST_CASE("a journal that forgets knows what came after", "[ops]") {
  std::mt19937 random(GENERATE(range(0U, 8U)));
  const auto draw = [&](unsigned below) { return static_cast<std::uint32_t>(random() % below); };
  Journal journal;
  std::vector<Event> plain;
  std::size_t known_from = 0;
  for (int step = 0; step < 400; ++step) {
    if (draw(4) == 0 && plain.size() > known_from) {
      REQUIRE(journal.pop() == plain.back().first);
      plain.pop_back();
    } else {
      append_random(journal, plain, draw);
    }
    if (draw(10) == 0) {
      known_from += draw(static_cast<unsigned>(plain.size() - known_from) + 1);
      journal.forget_before(known_from);
    }
    REQUIRE(journal.begin() <= known_from);
    REQUIRE(journal.end() == plain.size());
    const std::size_t from = known_from + draw(static_cast<unsigned>(plain.size() - known_from) + 1);
    REQUIRE(events_since(journal, from) ==
            std::vector<Event>(plain.begin() + static_cast<std::ptrdiff_t>(from), plain.end()));
  }
  journal.forget_before(journal.end());
  CHECK(journal.begin() == journal.end());
}

TEST_CASE("what happens while a journal is read is not read", "[ops]") {
  Journal journal;
  journal.append(EventKind::cell, 0);
  journal.append(EventKind::lazy, 1);
  std::vector<Event> seen;
  journal.for_each_since(0, [&](const Journal::Run& run) {
    seen.emplace_back(run.kind, run.first);
    CHECK(run.count == 1);
    for (std::uint32_t k = 0; k < 100; ++k) {
      journal.append(EventKind::lazy, static_cast<std::uint32_t>(journal.end()));
    }
  });
  CHECK(seen == std::vector<Event>{{EventKind::cell, 0}, {EventKind::lazy, 1}});
  CHECK(journal.end() == 202);
}

TEST_CASE("the journal of a structure says what each step did, and taking it back leaves none of it", "[ops]") {
  tests::Workshop shop;
  const auto counts_of = [&](const std::string& line) {
    const Journal::Position begin = shop.structure().journal().end();
    shop.build({line});
    return shop.structure().journal().counts_since(begin);
  };
  const ops::EventCounts made = counts_of(R"({"op":"simplex","name":"t","dim":2})");
  CHECK(made[EventKind::cell] == 7);
  CHECK(made[EventKind::body] == 1);
  shop.build({R"({"op":"simplex","name":"s","dim":2})"});
  const tests::StructureMark apart = tests::mark_of(shop.structure());
  const ops::EventCounts glued = counts_of(R"({"op":"identify","pairs":[["t.0-1","s.0-1"]]})");
  CHECK(glued[EventKind::removal] == 3);
  CHECK(glued[EventKind::cell] == 0);
  const ops::EventCounts split =
      counts_of(R"({"op":"deidentify","split":[{"cell":"t.0-1","as":"x","moves":[["s",2]]}]})");
  CHECK(split[EventKind::copy] == 1);
  CHECK(split[EventKind::move] == 1);
  CHECK(shop.steps().back().kind == ops::StepKind::split);
  shop.go_back_to(apart);
  CHECK(tests::mark_of(shop.structure()) == apart);
  shop.go_back_to({});
  CHECK(shop.structure().journal().end() == 0);
  CHECK(shop.structure().cells().size() == 0);
}
