// Logs whatever became of them: as they are, with honest checksums, cut, overwritten, and on a disk that fails.
#include "engine/durable/log_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <random>
#include <vector>

#include "engine/open.hpp"
#include "tests/fuzz/draws.hpp"
#include "tests/fuzz/engines.hpp"
#include "tests/support/memory_disk.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t longest = 4096;

struct Found {
  std::vector<std::string> steps;  ///< as texts
  std::optional<engine::Damage> damage;
  std::string error;
  std::uint64_t whole = 0, torn = 0;  ///< bytes
  bool has_header = false;
};

Found read(engine::LogReader reader) {
  Found found;
  const auto header = reader.header();
  if (went_well(header)) {
    found.has_header = header->has_value();
  } else {
    found.error = header.error().what;
  }
  while (found.has_header) {
    const auto entry = reader.next();
    if (!went_well(entry)) {
      found.error = entry.error().what;
      break;
    }
    if (!*entry) {
      break;
    }
    if (const auto* operation = std::get_if<ops::Operation>(&**entry)) {
      found.steps.push_back(ops::to_text(*operation));
    }
  }
  found.damage = reader.damage();
  found.whole = reader.position().bytes;
  found.torn = reader.torn();
  return found;
}

/// By a file in which the reader can go back, and as a stream: both find the same.
Found read(const std::string& bytes) {
  MemoryDisk disk;
  disk.write("log", bytes);
  int error = 0;
  const auto file = disk.open("log", engine::Disk::Mode::read, error);
  const Found found = read(engine::LogReader("log", *file, longest));
  const Found streamed = read(engine::LogReader("log", engine::bytes_of(*file, "log"), longest));
  demand(found.steps == streamed.steps && found.error == streamed.error && found.whole == streamed.whole &&
             found.torn == streamed.torn && found.damage.has_value() == streamed.damage.has_value(),
         "a log that is a stream says what it says as a file");
  if (found.error.empty() && !found.damage) {
    const bool has_no_end = !bytes.empty() && bytes.back() != '\n';  // the last line of a script needs none
    demand(found.whole + found.torn == bytes.size() || (has_no_end && found.whole == bytes.size() + 1),
           "every byte of a log is of a whole line, or torn");
  }
  demand(found.damage || found.error.empty() || !found.has_header, "an error of a log is damage");
  return found;
}

engine::OpenOptions on(MemoryDisk& disk) {
  engine::OpenOptions options;
  options.disk = &disk;
  options.sync = engine::SyncPolicy{400, std::chrono::milliseconds::zero()};  // without a thread
  options.limits = small_limits;
  options.resources = few_cells;
  return options;
}

/// Opens a log, goes on from it, and opens it again.
void go_on(const std::string& bytes) {
  const Found found = read(bytes);
  MemoryDisk disk;
  disk.write("log", bytes);
  {
    auto opened = engine::Engine::open("log", on(disk));
    if (!went_well(opened)) {
      demand(disk.bytes("log") == bytes, "a log that is refused stays as it was");
      return;
    }
    demand(found.error.empty(), "a log that can be opened can be read: " + found.error);
    demand(opened->steps == found.steps.size() && opened->torn == found.torn, "a log has the steps that are read");
    demand(opened->engine->apply(ops::Note{"one more"}).has_value(), "a log that was opened can be gone on from");
    demand(opened->engine->bind_log().has_value() && opened->log->close().has_value(), "and closed");
  }
  const std::string longer = disk.bytes("log");
  demand(longer.starts_with(bytes.substr(0, std::min<std::size_t>(found.whole, bytes.size()))), "what was whole stays");
  const Found now = read(longer);
  demand(now.error.empty() && !now.damage && now.torn == 0, "what was closed is whole");
  demand(now.steps.size() == found.steps.size() + 1 &&
             std::equal(found.steps.begin(), found.steps.end(), now.steps.begin()),
         "what was closed has all steps");
  demand(engine::Engine::open("log", on(disk)).has_value(), "what was closed can be opened");
}

/// The lines of a text as a log with honest numbers and checksums. A line of one character `b` binds. No writer writes
/// zeros.
std::string sealed(std::string_view text, std::vector<std::size_t>& ends) {
  engine::LogPosition position;
  std::string log;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line == "b") {
      log += engine::binding_line({position.steps(), position.synced, 7}, position);
    } else if (line.size() > 4 && line.front() == '{' && line.back() == '}' &&
               line.find('\0') == std::string_view::npos) {
      log += engine::record_line(line, position.records > 2 ? position.records - 2 : 0, position);
    }
    if (log.size() != (ends.empty() ? 0 : ends.back())) {
      ends.push_back(log.size());
    }
  }
  return log;
}

bool is_beginning(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

/// A log that is sound, and what becomes of it when its bytes change.
void damage(ByteDraws draws) {
  const int kind = draws.in(0, 3);
  const std::uint32_t where = draws.word(), what = draws.byte();
  std::vector<std::size_t> ends;
  const std::string whole = sealed(draws.rest(), ends);
  const Found before = read(whole);
  go_on(whole);
  if (whole.empty() || !before.error.empty()) {
    return;  // nonsense with honest checksums
  }
  demand(!before.damage && before.torn == 0, "a log that is written is whole");
  std::string bytes = whole;
  const std::size_t at = where % bytes.size();
  if (kind == 0) {  // cut off
    bytes.resize(at);
    const Found cut = read(bytes);
    demand(!cut.damage && cut.error.empty(), "what is cut off is no damage");
    const auto end = std::upper_bound(ends.begin(), ends.end(), at);
    demand(cut.whole == (end == ends.begin() ? 0 : *std::prev(end)), "what is cut off ends with the last whole line");
    demand(is_beginning(cut.steps, before.steps), "what is cut off has a beginning of the steps");
  } else if (kind == 1) {  // one byte is another
    bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (what == 0 ? 1U : what));
    const Found changed = read(bytes);
    demand(is_beginning(changed.steps, before.steps), "no step is read that is not as it was written");
    demand(changed.damage || changed.torn > 0 || changed.steps.size() == before.steps.size(), "what is lost is told");
    demand(changed.whole <= at || changed.damage || changed.torn > 0, "what is changed is told");
  } else {  // zeros, as power cuts leave them
    const std::size_t size = std::min<std::size_t>(1 + what, bytes.size() - at);
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), size, '\0');
    const Found changed = read(bytes);
    demand(is_beginning(changed.steps, before.steps), "no step is read that is not as it was written");
    demand(changed.damage || changed.torn > 0, "zeros are told");
  }
  go_on(bytes);
}

/// Sessions on a disk that fails as the bytes say: what was acknowledged is there afterwards, and nothing else.
void fail(ByteDraws draws) {
  MemoryDisk disk;
  std::vector<std::string> acknowledged;
  std::mt19937 random(draws.byte());
  for (int session = 0; session < 4 && !draws.is_done(); ++session) {
    disk.fault = [](std::string_view) { return 0; };
    engine::OpenOptions options = on(disk);
    options.sync = engine::SyncPolicy::always();
    auto opened = engine::Engine::open("log", options);
    demand(went_well(opened), "a log on a disk that works is opened");
    demand(opened->steps == acknowledged.size(), "all steps that were acknowledged are there");
    disk.fault = [&](std::string_view call) {
      return call != "truncate" && draws.in(0, 11) == 7 ? static_cast<int>(EIO) : 0;
    };
    disk.short_write = [&](std::size_t size) { return size == 0 ? 0 : draws.byte() % size; };
    for (int k = draws.in(1, 8); k > 0; --k) {
      const ops::Operation step = draws.one_in(5)
                                      ? ops::Operation{ops::Undo{1}}
                                      : ops::MakeSimplex{"s" + std::to_string(draws.in(0, 40)), draws.in(0, 2), {}};
      if (went_well(opened->engine->apply(step))) {
        acknowledged.push_back(ops::to_text(step));
      }
    }
    if (draws.one_in(2)) {
      (void)opened->engine->bind_log();
    }
    disk.fault = [](std::string_view) { return 0; };
    disk.cut_power(random);
  }
  const Found found = read(disk.has("log") ? disk.bytes("log") : "");
  demand(!found.damage && found.steps == acknowledged, "a log has the steps that were acknowledged, and no other");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteDraws draws(text_of(data, size));
  switch (draws.byte()) {  // characters, so that seeds are texts
    case 's':
      damage(draws);
      break;
    case 'f':
      fail(draws);
      break;
    default:
      go_on(std::string{text_of(data, size)});
  }
  return 0;
}
