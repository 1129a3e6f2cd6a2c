#include "tools/commands/interrupt.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

namespace sesame::tools {
namespace {

std::atomic<bool> stop{false};

// More files than any command has outputs; one that found no place would merely be left behind.
std::array<std::atomic<const char*>, 16> removed;
std::atomic<pid_t> owner = 0;  // a process that is forked off has no business with them
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free &&
                  std::atomic<pid_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

void handle(int signal, void (*handler)(int)) {
  // Without SA_RESTART, so that a read that waits ends too.
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

extern "C" void end_at_once(int signal) {
  if (getpid() == owner) {
    for (const std::atomic<const char*>& each : removed) {
      if (const char* path = each.load(); path != nullptr) {
        unlink(path);
      }
    }
  }
  handle(signal, SIG_DFL);
  raise(signal);  // as soon as this handler returns
}

extern "C" void request_stop(int) {
  stop.store(true);
  handle(SIGINT, end_at_once);
}

void replace_in_table(const char* from, const char* to) {
  const auto at = std::find(removed.begin(), removed.end(), from);
  if (at != removed.end()) {
    at->store(to);
  }
}

}  // namespace

std::atomic<bool>& stop_requested() { return stop; }

void catch_interrupt() { handle(SIGINT, request_stop); }

RemovedBySignals::RemovedBySignals(std::string path) : path_{std::move(path)} {
  if (owner != getpid()) {
    owner = getpid();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
      struct sigaction present {};
      sigaction(signal, nullptr, &present);
      if (present.sa_handler == SIG_DFL) {  // not when it is ignored, as under nohup, or caught
        handle(signal, end_at_once);
      }
    }
  }
  replace_in_table(nullptr, path_.c_str());
}

RemovedBySignals::~RemovedBySignals() { replace_in_table(path_.c_str(), nullptr); }

HeldSignals::HeldSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    sigaddset(&held, signal);
  }
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

HeldSignals::~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace sesame::tools
