#include "tools/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include "tools/commands.hpp"

namespace sesame::tools {
namespace {

/// Whether standard input comes from this file.
bool is_standard_input(const std::string& path) {
  struct stat input {};
  struct stat file {};
  return fstat(STDIN_FILENO, &input) == 0 && stat(path.c_str(), &file) == 0 && S_ISREG(input.st_mode) &&
         input.st_dev == file.st_dev && input.st_ino == file.st_ino;
}

}  // namespace

OutputFile::~OutputFile() {
  if (file_.is_open() && part_ != target_) {
    file_.close();
    std::error_code ignored;  // there is nobody to tell
    std::filesystem::remove(part_, ignored);
  }
}

std::string OutputFile::open(const std::string& path, const std::string& input) {
  if (path.empty()) {
    return "";
  }
  if (input == "-" ? is_standard_input(path) : is_same_file(path, input)) {
    return path + " is the input; give the output another name";
  }
  std::error_code missing;  // and other reasons, that opening the file will tell
  const bool exists = std::filesystem::exists(path, missing);
  if (exists && access(path.c_str(), W_OK) != 0) {
    return "cannot write " + path;
  }
  path_ = path;
  target_ = std::filesystem::weakly_canonical(path, missing);
  if (missing) {
    target_ = path;
  }
  part_ = target_;
  if (!exists || std::filesystem::is_regular_file(path, missing)) {
    part_ += ".part";
  }
  if (is_same_file(part_.string(), input)) {
    return part_.string() + " is the input; give the output another name";
  }
  file_.open(part_, std::ios::out | std::ios::trunc);
  if (!file_) {
    return "cannot write " + path;
  }
  if (exists && part_ != target_) {
    std::filesystem::permissions(part_, std::filesystem::status(target_).permissions(), missing);
  }
  return "";
}

bool OutputFile::clashes_with(const OutputFile& other) const {
  return is_wanted() && other.is_wanted() &&
         (target_ == other.target_ || target_ == other.part_ || part_ == other.target_);
}

std::string OutputFile::commit() {
  if (!is_wanted()) {
    return "";
  }
  file_.flush();
  std::error_code failed;
  if (file_ && part_ != target_) {
    std::filesystem::rename(part_, target_, failed);
  }
  if (!file_ || failed) {
    return "cannot write " + path_;
  }
  file_.close();
  return file_ ? "" : "cannot write " + path_;
}

}  // namespace sesame::tools
