#include "replay/text/byte_source.hpp"

#include <algorithm>
#include <cstring>

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
  if (!bytes.starts_with(gzip_magic)) {
    return false;
  }
  if (bytes.size() > flags_at && (static_cast<unsigned char>(bytes[flags_at]) & reserved_flags) != 0) {
    return false;
  }
  return bytes.size() < gzip_head ||
         bytes.substr(dimension_at, gzip_head - dimension_at).find_first_not_of('\0') != std::string_view::npos;
}

/// Nothing more than what is in the window already.
class NoInput final : public ByteInput {
 public:
  Result<std::size_t> read(std::span<char> /*to*/) override { return std::size_t{0}; }
};

}  // namespace

ByteSource::ByteSource(std::string name, std::unique_ptr<ByteInput> input)
    : name_{std::move(name)}, input_{std::move(input)}, words_(first_window / sizeof(std::uint64_t)) {}
ByteSource::ByteSource(ByteSource&&) noexcept = default;
ByteSource& ByteSource::operator=(ByteSource&&) noexcept = default;
ByteSource::~ByteSource() = default;

Result<ByteSource> ByteSource::open(const std::string& path, const InputOptions& options) {
  const std::string name = path == "-" ? "standard input" : path;
  Result<std::unique_ptr<ByteInput>> input = open_input(path, name, options);
  if (!input) {
    return input.error();
  }
  return from(std::move(*input), name);
}

Result<ByteSource> ByteSource::from(std::unique_ptr<ByteInput> input, std::string name) {
  ByteSource source(std::move(name), std::move(input));
  while (may_become_gzip(source.window())) {
    const Result<bool> got = source.more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      break;
    }
  }
  if (is_gzip(source.window())) {
    source.input_ = unpacked(std::move(source.input_), source.window(), source.name_);
    source.begin_ = source.end_ = 0;
  }
  return source;
}

ByteSource ByteSource::of_text(std::string_view text, std::string name) {
  ByteSource source(std::move(name), std::make_unique<NoInput>());
  source.words_.resize(text.size() / sizeof(std::uint64_t) + 1);
  std::memcpy(source.bytes(), text.data(), text.size());
  source.end_ = text.size();
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
  if (end_ > capacity / 2) {
    words_.resize(2 * words_.size());
  }
}

void ByteSource::shrink() {
  constexpr std::size_t large = std::size_t{1} << 20;
  if (words_.size() * sizeof(std::uint64_t) < large || end_ - begin_ >= large / 2) {
    return;
  }
  make_room();
  std::vector<std::uint64_t> words(std::max(first_window, end_ + sizeof(std::uint64_t)) / sizeof(std::uint64_t));
  std::memcpy(words.data(), words_.data(), end_);
  words_.swap(words);
}

Result<bool> ByteSource::more() {
  if (begin_ >= sizeof(std::uint64_t) || end_ == words_.size() * sizeof(std::uint64_t)) {
    make_room();
  }
  const Result<std::size_t> got = input_->read({bytes() + end_, words_.size() * sizeof(std::uint64_t) - end_});
  if (!got) {
    return got.error();
  }
  end_ += *got;
  return *got > 0;
}

Result<std::string> read_file(const std::string& path) {
  Result<ByteSource> source = ByteSource::open(path);
  if (!source) {
    return source.error();
  }
  std::string bytes;
  while (true) {
    bytes += source->window();
    source->consume(source->window().size());
    const Result<bool> got = source->more();
    if (!got) {
      return got.error();
    }
    if (!*got) {
      return bytes;
    }
  }
}

}  // namespace sesame::replay
