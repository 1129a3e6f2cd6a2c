/// \file
/// What a run of the program says of its work, beside its results: `--verbose` and `--log-file`, in every command.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <string>

#include "replay/text/log.hpp"
#include "sparse/result.hpp"
#include "tools/commands/file_buffer.hpp"

namespace sesame::tools {

spdlog::logger& tools_log();  ///< "sesame.tools": command lines, inputs and outputs

/// Where the loggers write. On standard error there are warnings; what SPDLOG_LEVEL in the environment asks for, of all
/// loggers or by name; and what --verbose does. A file has all from `debug` on, with times.
class ProgramLog {
 public:
  /// Makes the loggers, all of them.
  ProgramLog();
  ProgramLog(const ProgramLog&) = delete;
  ProgramLog& operator=(const ProgramLog&) = delete;
  ~ProgramLog();

  void add_options(CLI::App& command);
  /// Does what the options say, once the command line has been read and before the command begins.
  /// Errors, io: the file is named elsewhere on the command line; it is that of a standard stream; it cannot be
  /// written.
  Status start(const CLI::App& command);
  /// At the end. Errors, io: not everything could be written to the file.
  Status finish();

 private:
  Status open_file(const CLI::App& command);

  int verbosity_ = 0;
  std::string path_;
  std::unique_ptr<FileBuffer> file_;
  std::ostream stream_{nullptr};
};

}  // namespace sesame::tools
