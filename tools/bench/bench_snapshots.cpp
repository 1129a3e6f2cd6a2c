// Snapshots, measured: bench_snapshots SCENARIO [SIZE [TIMES]]. Applies the operations of a construction, writes a
// snapshot into memory, and reads it; says what each of that takes, and what reading consists of.
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include "engine/snapshot.hpp"
#include "sparse/archive_memory.hpp"
#include "tools/bench/scenarios.hpp"

namespace {

using namespace sesame;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int complain(const Error& error) {
  std::cerr << "bench_snapshots: " << error.what << '\n';
  return 1;
}

int measure(const tools::Scenario& scenario, std::uint64_t size, int times) {
  const engine::ObjectTerms terms{sparse::parse_ring(scenario.ring).value(), {}, UINT64_MAX};
  std::vector<std::string> lines;
  for (const ops::Operation& operation : std::get<tools::Construction>(scenario.input).make(size)) {
    lines.push_back(ops::to_text(operation));
  }
  const engine::LiveObject::WriteAhead is_written = [](const ops::Operation&) { return Done{}; };
  engine::LiveObject object(terms.ring, terms.limits, {}, terms.undoable);
  Clock::time_point start = Clock::now();
  for (const std::string& line : lines) {
    const auto operation = ops::parse_operation(line);
    if (!operation) {
      return complain(operation.error());
    }
    if (const auto report = object.apply(*operation, is_written); !report) {
      return complain(report.error());
    }
  }
  const double replay = seconds_since(start);
  std::vector<char> bytes;
  start = Clock::now();
  if (const Status written = write_snapshot(object, terms, {object.applied(), 0, 0}, sparse::sink_into(bytes));
      !written) {
    return complain(written.error());
  }
  const double write = seconds_since(start);
  double read = 0, state = 0, equivalence = 0;
  for (int k = 0; k < times; ++k) {
    start = Clock::now();
    auto snapshot = read_snapshot(sparse::source_of(bytes), bytes.size(), terms, {});
    const double whole = seconds_since(start);
    if (!snapshot) {
      return complain(snapshot.error());
    }
    start = Clock::now();
    engine::Equivalences again(terms.ring, snapshot->object->structure(), {});
    const auto record = again.record_afresh();
    start = Clock::now();
    again.begin_afresh(record ? &*record : nullptr);
    const double again_took = seconds_since(start);
    if (k == 0 || whole < read) {
      read = whole;
      equivalence = again_took;
      state = whole - again_took;
    }
    const engine::Homology here = object.homology(), there = snapshot->object->homology();
    if (here.betti != there.betti || here.torsion != there.torsion) {
      return complain({Errc::law_broken, "the groups differ"});
    }
  }
  std::uint64_t cells = 0;
  for (const std::uint64_t count : object.cells()) {
    cells += count;
  }
  std::cout << scenario.name << ": " << lines.size() << " steps, " << object.structure().cells().size()
            << " cells made, " << cells << " there; replay " << replay << " s, snapshot " << bytes.size()
            << " bytes, written in " << write << " s, read in " << read << " s (state " << state << " s, equivalence "
            << equivalence << " s): " << replay / read << " times as fast\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: bench_snapshots SCENARIO [SIZE [TIMES]]\n";
    return 1;
  }
  const auto found = tools::find_scenarios({argv[1]});
  if (!found) {
    return complain(found.error());
  }
  const tools::Scenario& scenario = *found->front();
  if (!std::holds_alternative<tools::Construction>(scenario.input)) {
    return complain({Errc::refused, "only constructions have steps"});
  }
  return measure(scenario, argc > 2 ? std::stoull(argv[2]) : scenario.size, argc > 3 ? std::stoi(argv[3]) : 3);
}
