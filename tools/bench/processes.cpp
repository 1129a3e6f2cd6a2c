#include "tools/bench/processes.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sesame::tools {
namespace {

namespace fs = std::filesystem;

struct Ended {
  int status = 0;
  rusage usage{};
  std::string output;
};

void write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      _exit(2);
    }
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
}

/// Forks; the child calls `child` with the file to write to, and must not return. Reads all that it writes.
template <class Child>
Result<Ended> fork_and_read(Child&& child) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return Error{Errc::io, std::string{"cannot make a pipe: "} + std::strerror(errno)};
  }
  const pid_t process = fork();
  if (process < 0) {
    close(ends[0]);
    close(ends[1]);
    return Error{Errc::io, std::string{"cannot start a process: "} + std::strerror(errno)};
  }
  if (process == 0) {
    close(ends[0]);
    child(ends[1]);
    _exit(2);
  }
  close(ends[1]);
  Ended ended;
  std::array<char, 1 << 16> piece;
  for (ssize_t got = 1; got != 0;) {
    got = read(ends[0], piece.data(), piece.size());
    if (got < 0 && errno != EINTR) {
      break;
    }
    ended.output.append(piece.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  }
  close(ends[0]);
  while (wait4(process, &ended.status, 0, &ended.usage) < 0 && errno == EINTR) {
  }
  return ended;
}

/// Whether a process was ended since it took too long.
bool was_late(const Ended& ended) {
  return WIFSIGNALED(ended.status) && (WTERMSIG(ended.status) == SIGALRM || WTERMSIG(ended.status) == SIGPROF);
}

/// Why a process did not end as it should, or nothing.
std::optional<Error> trouble(const Ended& ended, unsigned most_seconds) {
  if (WIFSIGNALED(ended.status)) {
    const int signal = WTERMSIG(ended.status);
    return Error{Errc::refused, signal == SIGALRM   ? "took longer than " + std::to_string(most_seconds) + " s"
                                : signal == SIGPROF ? "took longer than it was allowed to"
                                                    : "was ended by signal " + std::to_string(signal)};
  }
  if (WEXITSTATUS(ended.status) != 0) {
    const bool says_why = WEXITSTATUS(ended.status) == 1 && !ended.output.empty();
    return Error{Errc::refused,
                 says_why ? ended.output : "ended with exit status " + std::to_string(WEXITSTATUS(ended.status))};
  }
  return std::nullopt;
}

std::string sentence_of_current_exception() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "ran out of memory";
  } catch (const std::exception& e) {
    return e.what();
  }
}

/// The number of a line `NAME: NUMBER kB` in a file of the proc file system.
std::uint64_t kilobytes_in(const char* file, std::string_view name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(name)) {
      return std::strtoull(line.c_str() + name.size(), nullptr, 10);
    }
  }
  return 0;
}

}  // namespace

Result<std::string> in_child(const std::function<std::string()>& work, unsigned most_seconds,
                             const std::function<std::string()>& when_late) {
  const Result<Ended> ended = fork_and_read([&](int file) {
    std::signal(SIGALRM, SIG_DFL);
    alarm(most_seconds);
    int status = 0;
    std::string text;
    try {
      text = work();
    } catch (...) {
      status = 1;
      text = sentence_of_current_exception();
    }
    write_all(file, text);
    _exit(status);
  });
  if (!ended) {
    return ended.error();
  }
  if (when_late && was_late(*ended)) {
    return when_late();
  }
  if (std::optional<Error> error = trouble(*ended, most_seconds)) {
    return *std::move(error);
  }
  return ended->output;
}

Result<ProgramRun> run_program(const std::vector<std::string>& command, unsigned most_seconds) {
  std::vector<char*> arguments;
  for (const std::string& word : command) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const Result<Ended> ended = fork_and_read([&](int file) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDERR_FILENO);
    dup2(file, STDOUT_FILENO);
    alarm(most_seconds);  // which exec keeps
    execv(arguments[0], arguments.data());
    _exit(127);
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (!ended) {
    return ended.error();
  }
  if (std::optional<Error> error = trouble(*ended, most_seconds)) {
    return *std::move(error);
  }
  const auto in_seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return ProgramRun{seconds.count(), in_seconds(ended->usage.ru_utime) + in_seconds(ended->usage.ru_stime),
                    static_cast<std::uint64_t>(ended->usage.ru_maxrss) * 1024, ended->output};
}

std::optional<std::string> find_program(const std::string& name) {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / name;
  if (access(beside.c_str(), X_OK) == 0) {
    return beside.string();
  }
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const fs::path candidate = fs::path{rest.substr(0, colon)} / name;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate.string();
    }
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return std::nullopt;
}

ResidentMemory resident_memory() {
  return {kilobytes_in("/proc/self/status", "VmRSS:") * 1024, kilobytes_in("/proc/self/status", "VmHWM:") * 1024};
}

void forget_peak_memory() {
  malloc_trim(0);
  std::ofstream{"/proc/self/clear_refs"} << 5 << std::flush;
}

ScratchDirectory::ScratchDirectory() {
  std::string pattern = (fs::temp_directory_path() / "sesame-bench-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("cannot make a directory like " + pattern);
  }
  path_ = pattern;
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code error;  // what cannot be removed stays: nothing to be done about it here
  fs::remove_all(path_, error);
}

}  // namespace sesame::tools
