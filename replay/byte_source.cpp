#include "replay/byte_source.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <span>
#include <streambuf>

namespace sesame::replay {
namespace {

constexpr std::size_t first_window = std::size_t{1} << 18;
constexpr std::string_view gzip_magic = "\x1F\x8B\x08";
constexpr std::size_t gzip_head = 16;

/// Whether more bytes are needed to know what these are the beginning of.
bool may_become_gzip(std::string_view bytes) {
  return bytes.size() < gzip_head && bytes.substr(0, gzip_magic.size()) == gzip_magic.substr(0, bytes.size());
}

/// A binary boundary matrix of 559903 columns, or of some larger numbers, has this magic too. It goes on with the
/// dimension of its first column, whose upper bytes are 0; gzip data do not, as no deflate block begins so.
bool is_gzip(std::string_view bytes) {
  constexpr std::size_t flags_at = 3, dimension_at = 10;
  constexpr unsigned reserved_flags = 0xE0;
  if (!bytes.starts_with(gzip_magic)) return false;
  if (bytes.size() > flags_at && (static_cast<unsigned char>(bytes[flags_at]) & reserved_flags) != 0) return false;
  return bytes.size() < gzip_head ||
         bytes.substr(dimension_at, gzip_head - dimension_at).find_first_not_of('\0') != std::string_view::npos;
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_{number} {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (number_ > STDIN_FILENO) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

/// Where bytes come from.
class ByteSource::Input {
 public:
  Input(std::string name, int descriptor, const std::atomic<bool>* stop)
      : name_{std::move(name)}, file_{descriptor}, stop_{stop} {}
  virtual ~Input() = default;
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// Fills the front of `to`, which has room; the number of bytes, 0 at the end of the input.
  virtual Result<std::size_t> read(std::span<char> to) {
    while (true) {
      if (is_stopped()) return std::size_t{0};
      const ssize_t got = ::read(file_.number(), to.data(), to.size());
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) return Error{Errc::io, "cannot read " + name_ + ": " + std::strerror(errno)};
    }
  }

 protected:
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_stopped() const { return stop_ != nullptr && stop_->load(); }

 private:
  std::string name_;
  FileDescriptor file_;
  const std::atomic<bool>* stop_;
};

/// Unpacks what another input yields: gzip members, one after another, as the gzip program does.
class ByteSource::GzipInput final : public ByteSource::Input {
 public:
  /// `packed` are the first bytes of `input`, read already.
  GzipInput(std::string name, std::unique_ptr<Input> input, std::string_view packed, const std::atomic<bool>* stop)
      : Input{std::move(name), -1, stop}, input_{std::move(input)}, packed_(first_window) {
    std::copy(packed.begin(), packed.end(), packed_.begin());
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(packed.size());
    if (inflateInit2(&stream_, gzip_only) != Z_OK) throw std::bad_alloc();
  }
  GzipInput(const GzipInput&) = delete;
  GzipInput& operator=(const GzipInput&) = delete;
  ~GzipInput() override { inflateEnd(&stream_); }

  Result<std::size_t> read(std::span<char> to) override {
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(std::min(to.size(), std::size_t{1} << 30));
    const uInt room = stream_.avail_out;
    while (stream_.avail_out == room) {
      if (stream_.avail_in == 0) {
        const Result<std::size_t> got = refill();
        if (!got) return got;
        if (*got == 0 && (is_between_members_ || is_stopped())) return std::size_t{0};
        if (*got == 0) return damaged("the gzip data end in the middle: the file is cut off");
      }
      const int outcome = inflate(&stream_, Z_NO_FLUSH);
      is_between_members_ = outcome == Z_STREAM_END;
      if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
      if (outcome != Z_OK && outcome != Z_STREAM_END) return damaged("the gzip data are damaged");
      if (is_between_members_) inflateReset(&stream_);
    }
    return std::size_t{room - stream_.avail_out};
  }

 private:
  static constexpr int gzip_only = 16 + MAX_WBITS;

  Result<std::size_t> refill() {
    const Result<std::size_t> got = input_->read(packed_);
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = got ? static_cast<uInt>(*got) : 0;
    return got;
  }
  [[nodiscard]] Error damaged(const std::string& what) const { return {Errc::bad_input, name() + ": " + what}; }

  std::unique_ptr<Input> input_;
  std::vector<char> packed_;
  z_stream stream_{};
  bool is_between_members_ = false;
};

ByteSource::ByteSource(std::string name, std::unique_ptr<Input> input)
    : name_{std::move(name)}, input_{std::move(input)}, words_(first_window / sizeof(std::uint64_t)) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

Result<ByteSource> ByteSource::open(const std::string& path, const std::atomic<bool>* stop) {
  const bool is_standard_input = path == "-";
  const std::string name = is_standard_input ? "standard input" : path;
  const int descriptor = is_standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return Error{Errc::io, "cannot read " + name + ": " + std::strerror(errno)};
  ByteSource source(name, std::make_unique<Input>(name, descriptor, stop));
  while (may_become_gzip(source.window())) {
    const Result<bool> got = source.more();
    if (!got) return got.error();
    if (!*got) break;
  }
  if (is_gzip(source.window())) {
    source.input_ = std::make_unique<GzipInput>(name, std::move(source.input_), source.window(), stop);
    source.begin_ = source.end_ = 0;
  }
  return source;
}

/// Moves the window to the front; when it takes more than half, the room is doubled.
void ByteSource::make_room() {
  const std::size_t size = end_ - begin_;
  const std::size_t capacity = words_.size() * sizeof(std::uint64_t);
  // What is consumed is a multiple of 8 at every word of the input exactly when the front is.
  const std::size_t front = begin_ % sizeof(std::uint64_t);
  std::memmove(bytes() + front, bytes() + begin_, size);
  begin_ = front;
  end_ = front + size;
  if (end_ > capacity / 2) words_.resize(2 * words_.size());
}

Result<bool> ByteSource::more() {
  if (begin_ >= sizeof(std::uint64_t) || end_ == words_.size() * sizeof(std::uint64_t)) make_room();
  const Result<std::size_t> got = input_->read({bytes() + end_, words_.size() * sizeof(std::uint64_t) - end_});
  if (!got) return got.error();
  end_ += *got;
  return *got > 0;
}

class SourceStream::Buffer final : public std::streambuf {
 public:
  Buffer(ByteSource source, std::ios& stream) : source_{std::move(source)}, stream_{stream} {}
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 protected:
  int_type underflow() override {
    source_.consume(handed_out_);
    handed_out_ = 0;
    if (source_.window().empty()) {
      const Result<bool> got = source_.more();
      if (!got) {
        error_ = got.error();
        stream_.setstate(std::ios::badbit);
      }
      if (!got || !*got) return traits_type::eof();
    }
    piece_ = source_.window();
    handed_out_ = piece_.size();
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
    return traits_type::to_int_type(*gptr());
  }

 private:
  ByteSource source_;
  std::ios& stream_;
  std::optional<Error> error_;
  std::string piece_;  ///< a copy, since a stream buffer may be written to
  std::size_t handed_out_ = 0;
};

SourceStream::SourceStream(ByteSource source)
    : std::istream{nullptr}, buffer_{std::make_unique<Buffer>(std::move(source), *this)} {
  rdbuf(buffer_.get());
}
SourceStream::~SourceStream() = default;

const std::optional<Error>& SourceStream::error() const { return buffer_->error(); }

}  // namespace sesame::replay
