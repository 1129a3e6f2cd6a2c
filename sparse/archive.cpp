#include "sparse/archive.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <utility>

namespace sesame::sparse {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 20;
constexpr std::size_t checksum_size = sizeof(std::uint64_t);

}  // namespace

struct RunningHash::State {
  XXH3_state_t of_bytes;
};

RunningHash::RunningHash() : state_{std::make_unique<State>()} { XXH3_64bits_reset(&state_->of_bytes); }
RunningHash::~RunningHash() = default;

void RunningHash::add(std::span<const char> bytes) {
  XXH3_64bits_update(&state_->of_bytes, bytes.data(), bytes.size());
}

std::uint64_t RunningHash::value() const { return XXH3_64bits_digest(&state_->of_bytes); }

// ---------------------------------------------------------------------------------------------------------- writing

ArchiveWriter::ArchiveWriter(Sink sink) : sink_{std::move(sink)} { block_.reserve(block_size); }

void ArchiveWriter::give(std::span<const char> bytes) {
  if (status_ && !bytes.empty()) {
    status_ = sink_(bytes);
  }
}

void ArchiveWriter::put_bytes(const void* from, std::size_t bytes) {
  if (bytes == 0) {
    return;
  }
  bytes_ += bytes;
  const std::span all{static_cast<const char*>(from), bytes};
  checksum_.add(all);
  if (block_.size() + bytes > block_size) {
    give(block_);
    block_.clear();
    if (bytes > block_size) {
      give(all);
      return;
    }
  }
  block_.insert(block_.end(), all.begin(), all.end());
}

Status ArchiveWriter::finish() {
  put(checksum_.value());
  give(block_);
  block_.clear();
  return status_;
}

// ---------------------------------------------------------------------------------------------------------- reading

ArchiveReader::ArchiveReader(Source source, std::uint64_t bytes)
    : source_{std::move(source)}, unread_{bytes}, left_{bytes} {
  if (check(bytes >= checksum_size, "there are bytes enough for a checksum")) {
    left_ -= checksum_size;
  }
}

void ArchiveReader::fail(const char* sentence) {
  if (is_good()) {
    status_ = Error{Errc::bad_input, std::string{"this is not as it was written: it should hold that "} + sentence};
  }
  left_ = 0;
}

/// From the source.
bool ArchiveReader::fill(std::span<char> to) {
  const Result<std::size_t> read = source_(to);
  if (!read) {
    status_ = read.error();
    left_ = 0;
    return false;
  }
  unread_ -= std::min<std::uint64_t>(unread_, *read);
  return check(*read == to.size(), "there are as many bytes as were said to be");
}

void ArchiveReader::get_bytes(void* to, std::size_t bytes) {
  if (bytes == 0 || !check(bytes <= left_, "there are bytes enough for what is said to follow")) {
    return;
  }
  left_ -= bytes;
  char* next = static_cast<char*>(to);
  std::size_t wanted = bytes;
  const auto take = [&] {
    const std::size_t taken = std::min(wanted, block_.size() - at_);
    std::copy_n(block_.data() + at_, taken, next);
    at_ += taken;
    next += taken;
    wanted -= taken;
  };
  take();
  if (wanted >= block_size && fill({next, wanted})) {
    wanted = 0;
  }
  while (wanted > 0 && is_good()) {
    block_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(block_size, unread_)));
    at_ = 0;
    if (fill(block_)) {
      take();
    }
  }
  if (is_good()) {
    checksum_.add({static_cast<const char*>(to), bytes});
  } else {
    std::memset(to, 0, bytes);
  }
}

bool ArchiveReader::get_bool() {
  const auto byte = get<std::uint8_t>();
  check(byte <= 1, "what is true or false is one of these");
  return byte == 1;
}

std::string ArchiveReader::get_text_of(std::size_t bytes) {
  std::string text;
  if (check(bytes <= left_, "there are bytes enough for what is said to follow")) {
    text.resize(bytes);
    get_bytes(text.data(), bytes);
  }
  return is_good() ? text : std::string{};
}

Integer ArchiveReader::get_integer() {
  const std::optional<Integer> integer = Integer::parse(get_text());
  check(integer.has_value(), "an integer has digits");
  return integer.value_or(Integer{});
}

std::size_t ArchiveReader::get_count(std::size_t least_bytes_each) {
  const auto count = get<std::uint64_t>();
  return check(count <= left_ / least_bytes_each, "there are bytes enough for what is said to follow")
             ? static_cast<std::size_t>(count)
             : 0;
}

Status ArchiveReader::finish() {
  if (check(left_ == 0, "nothing follows the end")) {
    const std::uint64_t checksum = checksum_.value();
    left_ = checksum_size;
    check(get<std::uint64_t>() == checksum, "the checksum is that of the bytes before it");
  }
  return status_;
}

}  // namespace sesame::sparse
