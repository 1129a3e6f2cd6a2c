/// \file
/// Logs of tests: operations written by a LogWriter, and what readers find in bytes.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/durable/log_reader.hpp"
#include "engine/durable/log_writer.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/memory_disk.hpp"

namespace sesame::tests {

inline ops::Operation note(const std::string& text) { return ops::Note{text}; }

/// All that a reader finds.
struct Found {
  std::vector<std::string> steps;  ///< as texts
  std::vector<engine::Binding> bindings;
  engine::LogPosition end;
  std::uint64_t torn = 0;
  bool has_header = false;
  std::optional<engine::Damage> damage;
  std::string error;
};

inline Found read_log(const std::string& bytes) {
  MemoryDisk disk;
  disk.write("log", bytes);
  int error = 0;
  const auto file = disk.open("log", engine::Disk::Mode::read, error);
  engine::LogReader reader("log", engine::bytes_of(*file, "log"));
  Found found;
  const auto header = reader.header();
  found.has_header = header && header->has_value();
  found.error = header ? "" : header.error().what;
  while (found.has_header) {
    const auto entry = reader.next();
    if (!entry) {
      found.error = entry.error().what;
      break;
    }
    if (!*entry) {
      break;
    }
    if (const auto* binding = std::get_if<engine::Binding>(&**entry)) {
      found.bindings.push_back(*binding);
    } else {
      found.steps.push_back(ops::to_text(std::get<ops::Operation>(**entry)));
    }
  }
  found.end = reader.position();
  found.torn = reader.torn();
  found.damage = reader.damage();
  return found;
}

/// A new log on a disk.
inline std::shared_ptr<engine::LogWriter> begin_log(MemoryDisk& disk, const engine::SyncPolicy& policy) {
  int error = 0;
  auto writer = std::make_shared<engine::LogWriter>(disk.open("log", engine::Disk::Mode::create, error), "log", policy);
  REQUIRE(writer->begin(ops::Header{}));
  REQUIRE(disk.sync_folder_of("log") == 0);
  return writer;
}

/// `batch` without a thread, so that what happens does not depend on the time: so many bytes may be unsynced.
inline engine::SyncPolicy batches_of(std::uint64_t bytes) { return {bytes, std::chrono::milliseconds::zero()}; }

}  // namespace sesame::tests
