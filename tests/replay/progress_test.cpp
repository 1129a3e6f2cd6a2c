#include "replay/script/progress.hpp"

#include <regex>
#include <thread>

#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using replay::Progress;

namespace {

using Clock = std::chrono::steady_clock;
const std::string wipe = "\r\033[K";

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// Updates until a line is there.
void wait_for_line(Progress& progress, const std::ostringstream& out, std::uint64_t done) {
  const std::string before = out.str();
  while (out.str() == before) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    progress.update(done);
  }
}

}  // namespace

TEST_CASE("progress is written at most ten times a second", "[replay]") {
  std::ostringstream out;
  const auto start = Clock::now();
  Progress progress(out, std::nullopt);
  std::uint64_t updates = 0;
  while (occurrences(out.str(), "step") < 2) {
    progress.update(++updates);
  }
  const auto tenths = (Clock::now() - start) / std::chrono::milliseconds(100);
  CHECK(static_cast<std::int64_t>(occurrences(out.str(), "step")) <= static_cast<std::int64_t>(tenths));
  CHECK(updates > 2);
}

TEST_CASE("progress says what is done, how fast, and what is left when that is known", "[replay]") {
  std::ostringstream unknown;
  {
    Progress progress(unknown, std::nullopt);
    wait_for_line(progress, unknown, 5);
    CHECK(std::regex_match(unknown.str(), std::regex("\r\033\\[Kstep 5, \\d+ a second")));
  }
  std::ostringstream known;
  {
    Progress progress(known, 1000000);
    wait_for_line(progress, known, 5);
    CHECK(std::regex_match(known.str(), std::regex("\r\033\\[Kstep 5 of 1000000, \\d+ a second, \\d+ s left")));
  }
  std::ostringstream last;
  {
    Progress progress(last, 5);
    wait_for_line(progress, last, 5);
    CHECK(std::regex_match(last.str(), std::regex("\r\033\\[Kstep 5 of 5, \\d+ a second")));
  }
}

TEST_CASE("a line of progress is wiped once, by clear or at the end", "[replay]") {
  std::ostringstream out;
  {
    Progress progress(out, 10);
    progress.clear();
    CHECK(out.str().empty());
    wait_for_line(progress, out, 1);
    const std::string line = out.str();
    progress.clear();
    CHECK(out.str() == line + wipe);
    progress.clear();
    CHECK(out.str() == line + wipe);
    out.str("");
    wait_for_line(progress, out, 2);
    CHECK(out.str().starts_with(wipe + "step 2 of 10"));
    out.str("");
  }
  CHECK(out.str() == wipe);
}

TEST_CASE("progress that never wrote wipes nothing", "[replay]") {
  std::ostringstream out;
  { const Progress progress(out, 10); }
  CHECK(out.str().empty());
}
