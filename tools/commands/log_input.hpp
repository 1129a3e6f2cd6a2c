/// \file
/// Logs as inputs of commands: files, packed or not, and standard input.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "engine/durable/log_reader.hpp"
#include "engine/engine.hpp"
#include "replay/text/byte_source.hpp"
#include "sparse/result.hpp"

namespace sesame::tools {

/// What a reader of logs reads from a source of bytes.
[[nodiscard]] engine::ReadBytes bytes_of(std::shared_ptr<replay::ByteSource> source);

/// Opens a log; "-" is standard input. Errors: those of ByteSource.
Result<engine::LogReader> open_log(const std::string& path, std::size_t longest_line);

/// A new engine for the steps of a log, which are not kept in memory. Errors: bad_input, of a ring that there is not.
Result<std::unique_ptr<engine::Engine>> engine_for(const ops::Header& header);

/// Writes the first bytes of a log into a new file, which is on the disk then. Errors: io, also when there is one.
Status salvage(const std::string& path, const engine::LogPosition& until, const std::string& to);

}  // namespace sesame::tools
