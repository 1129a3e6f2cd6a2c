#include "replay/script/progress.hpp"

#include <fmt/format.h>

namespace sesame::replay {

Progress::Progress(std::ostream& out, std::optional<std::uint64_t> total)
    : out_{out}, total_{total}, start_{Clock::now()}, last_{start_} {}

Progress::~Progress() { clear(); }

void Progress::update(std::uint64_t done) {
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) {
    return;
  }
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / seconds;
  std::string line = fmt::format("step {}", done);
  if (total_) {
    line += fmt::format(" of {}", *total_);
  }
  line += fmt::format(", {:.0f} a second", rate);
  if (total_ && rate > 0 && *total_ > done) {
    line += fmt::format(", {:.0f} s left", static_cast<double>(*total_ - done) / rate);
  }
  out_ << "\r\033[K" << line << std::flush;
  visible_ = true;
}

void Progress::clear() {
  if (visible_) {
    out_ << "\r\033[K" << std::flush;
    visible_ = false;
  }
}

}  // namespace sesame::replay
