#include "replay/text/byte_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <new>
#include <thread>
#include <vector>

#include "engine/durable/log_format.hpp"

namespace sesame::replay {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_{number} {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (number_ > STDIN_FILENO) {
      ::close(number_);
    }
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

bool is_regular_file(int descriptor) {
  struct stat found {};
  return fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
}

class FileInput : public ByteInput {
 public:
  FileInput(std::string name, int descriptor, const std::atomic<bool>* stop)
      : name_{std::move(name)}, file_{descriptor}, stop_{stop} {}

  Result<std::size_t> read(std::span<char> to) override {
    while (!is_stopped()) {
      const ssize_t got = ::read(file_.number(), to.data(), to.size());
      if (got >= 0) {
        return static_cast<std::size_t>(got);
      }
      if (errno != EINTR) {
        return unreadable(std::strerror(errno));
      }
    }
    return std::size_t{0};
  }
  [[nodiscard]] bool is_stopped() const override { return stop_ != nullptr && stop_->load(); }

 protected:
  [[nodiscard]] int descriptor() const { return file_.number(); }
  [[nodiscard]] Error unreadable(const std::string& why) const {
    return {Errc::io, "cannot read " + name_ + ": " + why};
  }

 private:
  std::string name_;
  FileDescriptor file_;
  const std::atomic<bool>* stop_;
};

/// A file that grows. Of a regular one only whole lines are handed out, so that half a line that is cut off, and
/// written anew, has never been seen. (A whole line that is taken back has: then the file was truncated.)
class FollowedFile final : public FileInput {
 public:
  /// An empty path: standard input, which cannot be replaced.
  FollowedFile(std::string name, int descriptor, const std::atomic<bool>* stop, std::string path)
      : FileInput{std::move(name), descriptor, stop},
        path_{std::move(path)},
        position_{std::max<off_t>(lseek(descriptor, 0, SEEK_CUR), 0)} {}

  Result<std::size_t> read(std::span<char> to) override {
    while (true) {
      // Before the read, so that nothing is taken from a file that is another by now.
      const char* const loss = what_was_lost();
      if (loss != nullptr && !is_superseded_log()) {
        return unreadable(std::string{"it was "} + loss + " while it was followed");
      }
      Result<std::size_t> got = is_regular_file(descriptor()) ? read_lines(to) : FileInput::read(to);
      if (!got || *got > 0 || is_stopped()) {
        if (got) {
          remember(to.first(*got));
        }
        return got;
      }
      if (loss != nullptr) {
        return std::size_t{0};  // the end of this log
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

 private:
  /// What became of the bytes that were read, or nothing when they are still there.
  [[nodiscard]] const char* what_was_lost() const {
    struct stat now {};
    if (fstat(descriptor(), &now) != 0 || !S_ISREG(now.st_mode)) {  // a pipe only ever grows
      return nullptr;
    }
    if (now.st_size < position_) {
      return "truncated";
    }
    if (!still_has_tail()) {
      return "written over";
    }
    return what_its_name_lost(now);
  }

  [[nodiscard]] const char* what_its_name_lost(const struct stat& now) const {
    struct stat named {};
    if (now.st_nlink == 0) {
      return "removed";
    }
    if (!path_.empty() && stat(path_.c_str(), &named) != 0) {
      struct stat since {};  // it may have been there when `now` was asked for
      return fstat(descriptor(), &since) == 0 && since.st_nlink == 0 ? "removed" : "moved away";
    }
    const bool is_other = !path_.empty() && (named.st_dev != now.st_dev || named.st_ino != now.st_ino);
    return is_other ? "replaced" : nullptr;
  }

  /// Whether all that was read is there, in a log that has only lost its name: what follows stands in another one.
  [[nodiscard]] bool is_superseded_log() const {
    struct stat now {};
    if (fstat(descriptor(), &now) != 0 || now.st_size < position_ || !still_has_tail()) {
      return false;
    }
    std::array<char, 4096> beginning{};
    const ssize_t got = pread(descriptor(), beginning.data(), beginning.size(), 0);
    const std::string_view bytes(beginning.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
    return engine::LineChecker::is_checked(bytes.substr(0, bytes.find('\n')));
  }

  /// A file that was truncated and has grown since is as long as before, but not the same.
  [[nodiscard]] bool still_has_tail() const {
    std::array<char, longest_tail> found{};
    const ssize_t got = pread(descriptor(), found.data(), tail_size_, position_ - static_cast<off_t>(tail_size_));
    return got == static_cast<ssize_t>(tail_size_) && std::equal(tail_.begin(), tail_.begin() + got, found.begin());
  }

  /// Up to the last line feed that there is, or nothing; of data that are packed, all.
  Result<std::size_t> read_lines(std::span<char> to) {
    const ssize_t got = pread(descriptor(), to.data(), to.size(), position_);
    if (got < 0) {
      return errno == EINTR ? Result<std::size_t>{std::size_t{0}} : unreadable(std::strerror(errno));
    }
    const std::string_view bytes(to.data(), static_cast<std::size_t>(got));
    is_packed_ = is_packed_ || (position_ == 0 && bytes.starts_with("\x1F\x8B"));
    std::size_t whole = is_packed_ ? bytes.size() : bytes.rfind('\n') + 1;
    if (whole == 0 && bytes.size() == to.size() && has_line_end_from(position_ + got)) {
      whole = bytes.size();  // of a line for which there is no room
    }
    position_ += static_cast<off_t>(whole);
    return whole;
  }

  [[nodiscard]] bool has_line_end_from(off_t at) const {
    std::vector<char> piece(std::size_t{1} << 16);
    while (true) {
      const ssize_t got = pread(descriptor(), piece.data(), piece.size(), at);
      if (got <= 0) {
        return false;
      }
      if (std::find(piece.begin(), piece.begin() + got, '\n') != piece.begin() + got) {
        return true;
      }
      at += got;
    }
  }

  void remember(std::span<const char> piece) {
    const std::size_t fresh = std::min(piece.size(), longest_tail);
    const std::size_t kept = std::min(tail_size_, longest_tail - fresh);
    std::copy_n(tail_.begin() + static_cast<std::ptrdiff_t>(tail_size_ - kept), kept, tail_.begin());
    std::copy_n(piece.end() - static_cast<std::ptrdiff_t>(fresh), fresh,
                tail_.begin() + static_cast<std::ptrdiff_t>(kept));
    tail_size_ = kept + fresh;
  }

  static constexpr std::size_t longest_tail = 64;

  std::string path_;
  off_t position_;                         ///< behind what was read, in a regular file
  std::array<char, longest_tail> tail_{};  ///< the bytes read last
  std::size_t tail_size_ = 0;
  bool is_packed_ = false;
};

class GzipInput final : public ByteInput {
 public:
  GzipInput(std::unique_ptr<ByteInput> input, std::string_view packed, std::string name)
      : name_{std::move(name)}, input_{std::move(input)}, packed_(std::max(packed.size(), packed_room)) {
    std::copy(packed.begin(), packed.end(), packed_.begin());
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(packed.size());
    if (inflateInit2(&stream_, gzip_only) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  GzipInput(const GzipInput&) = delete;
  GzipInput& operator=(const GzipInput&) = delete;
  ~GzipInput() override { inflateEnd(&stream_); }

  Result<std::size_t> read(std::span<char> to) override {
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(std::min(to.size(), std::size_t{1} << 30));
    const uInt room = stream_.avail_out;
    while (stream_.avail_out == room) {
      if (is_damaged_) {
        return damaged("the gzip data are damaged");
      }
      if (stream_.avail_in == 0) {
        const Result<std::size_t> got = refill();
        if (!got) {
          return got;
        }
        if (*got == 0 && (is_between_members_ || is_stopped())) {
          return std::size_t{0};
        }
        if (*got == 0) {
          return damaged("the gzip data end in the middle: the file is cut off");
        }
      }
      const int outcome = inflate(&stream_, Z_NO_FLUSH);
      is_between_members_ = outcome == Z_STREAM_END;
      if (outcome == Z_MEM_ERROR) {
        throw std::bad_alloc();
      }
      is_damaged_ = outcome != Z_OK && outcome != Z_STREAM_END;  // behind what it has unpacked, which is told first
      if (is_between_members_) {
        inflateReset(&stream_);
      }
    }
    return std::size_t{room - stream_.avail_out};
  }
  [[nodiscard]] bool is_stopped() const override { return input_->is_stopped(); }

 private:
  static constexpr int gzip_only = 16 + MAX_WBITS;
  static constexpr std::size_t packed_room = std::size_t{1} << 18;

  Result<std::size_t> refill() {
    const Result<std::size_t> got = input_->read(packed_);
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = got ? static_cast<uInt>(*got) : 0;
    return got;
  }
  [[nodiscard]] Error damaged(const std::string& what) const { return {Errc::bad_input, name_ + ": " + what}; }

  std::string name_;
  std::unique_ptr<ByteInput> input_;
  std::vector<char> packed_;
  z_stream stream_{};
  bool is_between_members_ = false, is_damaged_ = false;
};

}  // namespace

Result<std::unique_ptr<ByteInput>> open_input(const std::string& path, const std::string& name,
                                              const InputOptions& options) {
  const bool is_standard_input = path == "-";
  const int descriptor = is_standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return Error{Errc::io, "cannot read " + name + ": " + std::strerror(errno)};
  }
  if (options.follow && (!is_standard_input || is_regular_file(descriptor))) {
    return std::unique_ptr<ByteInput>(
        new FollowedFile(name, descriptor, options.stop, is_standard_input ? std::string{} : path));
  }
  return std::unique_ptr<ByteInput>(new FileInput(name, descriptor, options.stop));
}

std::unique_ptr<ByteInput> unpacked(std::unique_ptr<ByteInput> input, std::string_view packed,
                                    const std::string& name) {
  return std::make_unique<GzipInput>(std::move(input), packed, name);
}

}  // namespace sesame::replay
