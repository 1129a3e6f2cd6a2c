// Records and their checksums: whatever is changed, lost, doubled or moved in a log is found.
#include "engine/durable/log_format.hpp"

#include "tests/support/logs.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// A log of some steps, bound in the middle and at its end, closed.
std::string small_log() {
  MemoryDisk disk;
  {
    const auto writer = begin_log(disk, batches_of(150));
    for (int k = 1; k <= 6; ++k) {
      REQUIRE(writer->append(note("step " + std::to_string(k))));
      if (k == 3) {
        REQUIRE(writer->bind(17, false));
      }
    }
    REQUIRE(writer->bind(18, false));
    REQUIRE(writer->close());
  }
  return disk.bytes("log");
}

std::vector<std::string> lines_with_ends(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line;
  }
  return text;
}

}  // namespace

TEST_CASE("a log is a script with a number and a checksum in each record", "[engine][log]") {
  engine::LogPosition position;
  const std::string header = engine::record_line(R"({"sesame":1,"ring":"Z","title":""})", 0, position);
  const std::string step = engine::record_line(R"({"op":"note","text":"a"})", 0, position);
  CHECK_THAT(header, Catch::Matchers::StartsWith(R"({"sesame":1,"ring":"Z","title":"","seq":0,"xxh3":")"));
  CHECK_THAT(step, Catch::Matchers::StartsWith(R"({"op":"note","text":"a","seq":1,"xxh3":")"));
  CHECK(position.records == 2);
  CHECK(position.bytes == header.size() + step.size());
  engine::LineChecker lines;
  CHECK(lines.take(header.substr(0, header.size() - 1)).value().record == R"({"sesame":1,"ring":"Z","title":""})");
  CHECK(lines.take(step.substr(0, step.size() - 1)).value().record == R"({"op":"note","text":"a"})");
  CHECK(lines.position().chain == position.chain);
  CHECK(lines.position().bytes == position.bytes);
}

TEST_CASE("a log says what it was bound to, and what was known to be on the disk", "[engine][log]") {
  const Found found = read_log(small_log());
  CHECK(found.error.empty());
  CHECK(found.steps.size() == 6);
  REQUIRE(found.bindings.size() == 2);
  CHECK(found.bindings[0].steps == 3);
  CHECK(found.bindings[0].state == 17);
  CHECK(found.bindings[1].steps == 6);
  CHECK(found.end.is_bound);
  CHECK(found.end.synced >= 3);
}

TEST_CASE("a script without checksums is a log, and may go on with checksums or without", "[engine][log]") {
  const std::string script = "# by hand\n{\"sesame\":1}\n\n{\"op\":\"note\",\"text\":\"a\"}\n";
  CHECK(read_log(script).steps.size() == 1);
  CHECK(!read_log(script).end.is_checked);
  engine::LogPosition position = read_log(script).end;
  const std::string checked = engine::record_line(R"({"op":"note","text":"b"})", 0, position);
  const std::string by_hand = "{\"op\":\"note\",\"text\":\"c\"}\n";
  const Found found = read_log(script + checked + by_hand);
  CHECK(found.error.empty());
  CHECK(found.steps.size() == 3);
  SECTION("a change of what was written without a checksum is found at the next one") {
    std::string changed = script;
    changed[4] = 'x';  // in a comment
    const Found after = read_log(changed + checked);
    REQUIRE(after.damage);
    CHECK(after.damage->record == 2);
    CHECK(after.damage->byte == script.size());
  }
  SECTION("its last line needs no end") {
    CHECK(read_log(script + by_hand.substr(0, by_hand.size() - 1)).steps.size() == 2);
    const Found torn = read_log(script + by_hand.substr(0, 10));
    CHECK(torn.steps.size() == 1);
    CHECK(torn.torn == 10);
    CHECK(!torn.damage);
  }
}

TEST_CASE("a byte that is changed anywhere in a log is found, in the record where it is", "[engine][log]") {
  const std::string log = small_log();
  const std::vector<std::string> lines = lines_with_ends(log);
  std::size_t begin = 0;
  for (const std::string& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      for (const char other :
           {' ', 'x', '0', '7', '"', '\n', '#', static_cast<char>(line[k] ^ 1), static_cast<char>(line[k] ^ 32)}) {
        std::string changed = log;
        if (changed[begin + k] == other || other == '\0') {  // zeros are another matter
          continue;
        }
        changed[begin + k] = other;
        CAPTURE(begin, k, other);
        const Found found = read_log(changed);
        const bool is_last_end = begin + k + 1 == log.size();
        REQUIRE((found.damage || (is_last_end && found.torn > 0)));
        if (found.damage) {
          REQUIRE(found.damage->byte >= begin);
          REQUIRE(found.damage->byte <= begin + k + 1);
        }
      }
    }
    begin += line.size();
  }
}

TEST_CASE("a line that is lost, doubled or out of order is found", "[engine][log]") {
  const std::vector<std::string> lines = lines_with_ends(small_log());
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    CAPTURE(k);
    std::vector<std::string> lost = lines;
    lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(k));
    CHECK(read_log(joined_lines(lost)).damage);
    std::vector<std::string> doubled = lines;
    doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(k), lines[k]);
    CHECK(read_log(joined_lines(doubled)).damage);
    std::vector<std::string> swapped = lines;
    std::swap(swapped[k], swapped[k + 1]);
    CHECK(read_log(joined_lines(swapped)).damage);
  }
}

TEST_CASE("a log that is cut at any byte has the records before it, and the rest is torn", "[engine][log]") {
  const std::string log = small_log();
  for (std::size_t size = 0; size <= log.size(); ++size) {
    CAPTURE(size);
    const Found found = read_log(log.substr(0, size));
    const std::size_t whole = size == 0                                        ? 0
                              : log.rfind('\n', size - 1) == std::string::npos ? 0
                                                                               : log.rfind('\n', size - 1) + 1;
    REQUIRE(!found.damage);
    REQUIRE(found.error.empty());
    REQUIRE(found.end.bytes == whole);
    REQUIRE(found.torn == size - whole);
    std::size_t records = 0;
    for (const std::string& line : lines_with_ends(log.substr(0, whole))) {
      records += line.starts_with('{') ? 1 : 0;
    }
    REQUIRE(found.end.records == records);
    REQUIRE(found.has_header == (records > 0));
  }
}

TEST_CASE("zeros where a power cut came first are torn off, those where data had been synced are damage",
          "[engine][log]") {
  MemoryDisk disk;
  const auto writer = begin_log(disk, engine::SyncPolicy::always());
  for (int k = 1; k <= 4; ++k) {
    REQUIRE(writer->append(note(std::to_string(k))));
  }
  const std::string log = disk.bytes("log");
  const std::vector<std::string> lines = lines_with_ends(log);
  std::size_t begin = 0;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    CAPTURE(line);
    std::string zeroed = log;
    std::fill_n(zeroed.begin() + static_cast<std::ptrdiff_t>(begin) + 3, 20, '\0');
    const Found found = read_log(zeroed);
    // Step 4 says that 3 was on the disk; nothing says so of 4 itself.
    const bool is_damage = line + 1 < lines.size();
    CHECK(found.damage.has_value() == is_damage);
    CHECK((found.torn > 0) == !is_damage);
    CHECK(found.end.records == line);
    begin += lines[line].size();
  }
}
