/// \file
/// What a command writes to files: nothing that is read, and nothing that somebody has, is lost by it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "sparse/result.hpp"
#include "tools/commands/file_buffer.hpp"

namespace sesame::tools {

/// "-", or "/dev/stdout".
[[nodiscard]] bool is_standard_output(const std::string& path);

/// Where an output is to go, as it is before anything is written.
struct OutputPlace {
  enum class Kind { absent, regular, device, other };
  std::string path;                                ///< as it was given
  std::filesystem::path target;                    ///< without links
  Kind kind = Kind::absent;                        ///< what is there; a device is one of characters, such as /dev/null
  std::tuple<dev_t, ino_t, std::string> identity;  ///< of what is there; or of the folder, and the name in it
};

/// Finds it. Errors, io: it is a file that is read (one of `inputs`), or one that a standard stream comes from or goes
/// to, by whichever name; a folder; a link to nothing; what may not be written.
[[nodiscard]] Result<OutputPlace> find_place(const std::string& path, const std::vector<std::string>& inputs);

/// Puts the name of a file on the disk, as its folder is; warns when that cannot be.
void settle_folder_of(const std::filesystem::path& file);

/// "cannot write PATH: REASON", io; the reason is that of errno when none is given.
[[nodiscard]] Error cannot_write(const std::string& path, const std::string& reason = "");

/// A new file beside a target, which it replaces when all is written. It is named as the target, with ".part" behind it
/// (or ".2.part" and so on, when such a file is there), and has the permissions of what it is going to replace.
class PartFile {
 public:
  /// `reserved`: names that it must not have.
  static Result<std::unique_ptr<PartFile>> make(const OutputPlace& place,
                                                const std::vector<std::filesystem::path>& reserved);
  PartFile(OutputPlace place, std::filesystem::path path, int descriptor);

  [[nodiscard]] FileBuffer& buffer() { return buffer_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Takes the target's place for good. Requires: the buffer is settled.
  Status replace();
  void remove();

 private:
  OutputPlace place_;
  std::filesystem::path path_;
  FileBuffer buffer_;
};

/// The outputs of one command, opened before the work begins. Each is written beside its target, and they take their
/// places when all are complete; otherwise, and when a signal ends the program, what was there before is as it was.
/// What is there and is no regular file, such as /dev/null or a pipe, is written at once.
class OutputFiles {
 public:
  /// `inputs`: the files that are read meanwhile.
  explicit OutputFiles(std::vector<std::string> inputs);
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  ~OutputFiles();

  /// A stream to write to. An empty path: the output is not wanted, and the stream null; "-": standard output.
  /// Errors, io: those of find_place; two outputs are one file.
  Result<std::ostream*> open(const std::string& path);
  /// To be called when all is written. Errors, io: something could not be written; nothing has been replaced then,
  /// unless it was the replacing that failed.
  Status commit();

 private:
  class File;
  [[nodiscard]] bool is_open_already(const OutputPlace& place) const;

  std::vector<std::string> inputs_;
  bool has_standard_output_ = false;
  std::vector<std::unique_ptr<File>> files_;
};

}  // namespace sesame::tools
