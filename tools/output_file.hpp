/// \file
/// A file that takes the place of an older one only when it is complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace sesame::tools {

/// An output that is opened before the work begins. It is written beside its target, under the name of the target with
/// ".part" behind it, and takes the target's place when it is committed; without that it leaves nothing behind. A
/// target that is there and is no regular file, such as /dev/stdout, is written at once.
class OutputFile {
 public:
  OutputFile() = default;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Opens it; an empty path means that it is not wanted. `input` is what is read at the same time ("-": standard
  /// input), and is not written over. Says what is wrong, or nothing.
  std::string open(const std::string& path, const std::string& input);
  [[nodiscard]] bool is_wanted() const { return !target_.empty(); }
  /// True when both are wanted, and one would write over the other.
  [[nodiscard]] bool clashes_with(const OutputFile& other) const;
  std::ostream& stream() { return file_; }
  /// To be called when all is written. Says what went wrong, or nothing.
  std::string commit();

 private:
  std::string path_;                     ///< as it was given
  std::filesystem::path target_, part_;  ///< the same when the target is written at once
  std::ofstream file_;
};

}  // namespace sesame::tools
