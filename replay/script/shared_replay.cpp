#include "replay/script/shared_replay.hpp"

#include <utility>

#include "ops/vocabulary/operation.hpp"

namespace sesame::replay {

bool SharedReplay::is_open() const {
  const std::lock_guard lock(revised_);
  return is_open_;
}

bool SharedReplay::look(const std::function<void(engine::Engine&)>& look) {
  const std::lock_guard lock(turn_);
  if (engine_ == nullptr) {
    return false;
  }
  look(*engine_);
  return true;
}

std::optional<SharedReplay::Taken> SharedReplay::take(std::string_view lines) {
  const std::lock_guard lock(turn_);
  if (engine_ == nullptr) {
    return std::nullopt;
  }
  Taken taken;
  for (std::uint64_t line = 1; !lines.empty(); ++line) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view text = lines.substr(0, end);
    lines.remove_prefix(std::min(end + 1, lines.size()));
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || text[begin] == '#') {
      continue;
    }
    Result<ops::Operation> operation = ops::parse_operation(text);
    const Status done = operation ? taker_(std::move(*operation)) : operation.error();
    if (!done) {
      taken.refusal = {line, done.error().what};
      return taken;
    }
    ++taken.steps;
  }
  return taken;
}

std::uint64_t SharedReplay::revision() const {
  const std::lock_guard lock(revised_);
  return revision_;
}

std::uint64_t SharedReplay::wait_for_other(std::uint64_t revision, std::chrono::milliseconds most) const {
  std::unique_lock lock(revised_);
  changed_.wait_for(lock, most, [&] { return revision_ != revision; });
  return revision_;
}

void SharedReplay::open(engine::Engine& engine, Taker taker) {
  const std::lock_guard lock(turn_);
  engine_ = &engine;
  taker_ = std::move(taker);
  const std::lock_guard revised(revised_);
  is_open_ = true;
  ++revision_;
  changed_.notify_all();
}

void SharedReplay::close() {
  const std::lock_guard lock(turn_);
  engine_ = nullptr;
  taker_ = nullptr;
  const std::lock_guard revised(revised_);
  is_open_ = false;
  ++revision_;
  changed_.notify_all();
}

void SharedReplay::note_step() {
  const std::lock_guard revised(revised_);
  ++revision_;
  changed_.notify_all();
}

}  // namespace sesame::replay
