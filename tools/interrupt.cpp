#include "tools/interrupt.hpp"

#include <csignal>

namespace sesame::tools {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void request_stop(int) {
  stop.store(true);
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

std::atomic<bool>& stop_requested() { return stop; }

void catch_interrupt() {
  struct sigaction action {};  // without SA_RESTART, so that a read ends too
  action.sa_handler = request_stop;
  sigaction(SIGINT, &action, nullptr);
}

}  // namespace sesame::tools
