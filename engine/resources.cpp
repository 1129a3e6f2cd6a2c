#include "engine/resources.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace sesame::engine {
namespace {

constexpr std::uint64_t large = std::uint64_t{64} << 20;  ///< what is worth a look at what there is

/// Of the process: the pages of its address space, and those that are in memory.
struct Pages {
  std::uint64_t all = 0, resident = 0;
};
Pages pages() {
  Pages found;
  std::ifstream("/proc/self/statm") >> found.all >> found.resident;
  return found;
}

std::uint64_t in_bytes(std::uint64_t page_count) {
  return page_count * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::uint64_t memory_in_use() { return in_bytes(pages().resident); }

std::uint64_t memory_available() {
  std::uint64_t available = UINT64_MAX;
  std::ifstream machine("/proc/meminfo");
  std::string what, unit;
  for (std::uint64_t kilobytes = 0; machine >> what >> kilobytes >> unit;) {
    if (what == "MemAvailable:") {
      available = kilobytes << 10;
      break;
    }
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t taken = in_bytes(pages().all);
    available = std::min<std::uint64_t>(available, limit.rlim_cur > taken ? limit.rlim_cur - taken : 0);
  }
  return available;
}

std::string size_text(std::uint64_t bytes) {
  constexpr const char* units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 1000 && unit + 1 < std::size(units); size /= 1000) {
    ++unit;
  }
  return fmt::format("{:.{}f} {}", size, size < 10 && unit > 0 ? 1 : 0, units[unit]);
}

std::optional<std::string> ResourceCheck::objection(std::uint64_t cells, std::uint64_t bytes) {
  if (cells > resources_.most_cells) {
    return fmt::format("would bring the object to {} cells; the limit that was set is {}", cells,
                       resources_.most_cells);
  }
  if (bytes >= large) {
    if (const std::uint64_t available = memory_available(); bytes > available) {
      return fmt::format("would take about {} of memory; there are {}", size_text(bytes), size_text(available));
    }
  }
  if (resources_.most_bytes == UINT64_MAX) {
    return std::nullopt;
  }
  constexpr std::uint64_t at_least = 4096;
  since_then_ += std::max(bytes, at_least);
  const std::uint64_t room = resources_.most_bytes > in_use_ ? resources_.most_bytes - in_use_ : 0;
  if (since_then_ > room / 8) {
    in_use_ = memory_in_use();
    since_then_ = bytes;
    if (in_use_ > resources_.most_bytes || bytes > resources_.most_bytes - in_use_) {
      return fmt::format("would take about {} of memory, and {} are in use; the limit that was set is {}",
                         size_text(bytes), size_text(in_use_), size_text(resources_.most_bytes));
    }
  }
  return std::nullopt;
}

}  // namespace sesame::engine
