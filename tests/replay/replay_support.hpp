/// \file
/// Scripts as texts, replays with all that comes out of them, for the tests of replay/.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "replay/script/replay.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/memory_disk.hpp"

namespace sesame::tests {

inline const std::string header_line = R"({"sesame":1,"ring":"Z","title":""})";

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line + '\n';
  }
  return text;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream input(text);
  for (std::string line; std::getline(input, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// The whole of a file, which must be there.
inline std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    FAIL("cannot read " << path);
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::string example(const std::string& name) {
  return text_of_file(std::string{SESAME_TEST_EXAMPLES} + "/" + name + ".jsonl");
}

/// What came out of a replay.
struct Replayed {
  replay::Outcome outcome;
  std::string errors;
  std::string log;    ///< its records as a script, without numbers and checksums
  std::string bytes;  ///< all of it
};

/// The header and the operations of a log, a line each.
inline std::string script_of_log(const std::string& bytes) {
  std::string script;
  engine::LineChecker lines;
  for (const std::string& line : lines_of(bytes)) {
    const auto taken = lines.take(line).value();
    script += taken.record.empty() ? "" : std::string{taken.record} + '\n';
  }
  return script;
}

/// Replays a text that errors call "script".
inline Replayed replay_text(const std::string& text, replay::Reporter* reporter = nullptr,
                            replay::ReplayOptions options = {}) {
  replay::ScriptReader script(replay::ByteSource::of_text(text, "script"));
  std::ostringstream errors;
  MemoryDisk disk;
  int error = 0;
  options.log = std::make_shared<engine::LogWriter>(disk.open("log", engine::Disk::Mode::create, error), "log",
                                                    engine::SyncPolicy::never());
  const replay::Outcome outcome = replay::replay(script, options, reporter, errors, nullptr);
  if (options.engine != nullptr && *options.engine != nullptr) {
    (*options.engine)->write_to(nullptr);  // the engine stays, and the disk does not
  }
  options.log.reset();
  return {outcome, errors.str(), script_of_log(disk.bytes("log")), disk.bytes("log")};
}

/// What a replay writes through one of the program's reporters; the replay must be done without a word.
template <class MakeReporter>
std::string report_on(const std::string& text, MakeReporter make, const replay::ReplayOptions& options = {}) {
  std::ostringstream out;
  const auto reporter = make(out);
  const Replayed replayed = replay_text(text, reporter.get(), options);
  CHECK(replayed.errors.empty());
  CHECK(replayed.outcome == replay::Outcome::done);
  return out.str();
}

/// One vertex v, one loop e0, loops e1, ..., each twice the one before, and a disc on the last: H_1 = Z/2^doublings.
inline std::string large_torsion(int doublings) {
  std::string cells = R"({"id":"v"},{"id":"e0","faces":["v","v"]})";
  const auto loop = [](int k) { return "e" + std::to_string(k); };
  const auto add = [&](const std::string& id, const std::string& a, const std::string& b, const std::string& c) {
    cells += R"(,{"id":")" + id + R"(","faces":[")" + a + R"(",")" + b + R"(",")" + c + R"("]})";
  };
  for (int k = 1; k <= doublings; ++k) {
    cells += R"(,{"id":")" + loop(k) + R"(","faces":["v","v"]})";
    add("t" + std::to_string(k), loop(k - 1), loop(k), loop(k - 1));
  }
  cells += R"(,{"id":"c","faces":["v","v"]})";
  add("d", "c", "c", "c");
  add("w", "c", loop(doublings), "c");
  return R"({"op":"complex","name":"K","cells":[)" + cells + "]}";
}

/// A closed path of so many edges, one after the other.
inline std::string polygon(int edges) {
  std::string cells;
  for (int k = 0; k < edges; ++k) {
    const std::string number = std::to_string(k);
    const std::string next = std::to_string((k + 1) % edges);
    cells += (k == 0 ? "" : ",") + (R"({"id":"v)" + number + R"("},{"id":"e)" + number + R"(","faces":["v)" + next) +
             R"(","v)" + number + R"("]})";
  }
  return R"({"op":"complex","name":"P","cells":[)" + cells + "]}";
}

}  // namespace sesame::tests
