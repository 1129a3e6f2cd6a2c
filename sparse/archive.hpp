/// \file
/// Archives: plain numbers and lists of them, written to a stream of bytes with a checksum, and read back from a stream
/// that nobody vouches for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sparse/integer.hpp"
#include "sparse/result.hpp"

namespace sesame::sparse {

/// What is its bytes, and whose bytes follow from what it is: numbers, and structures of them without gaps. A bool is
/// not: it has bytes that are none.
template <class T>
concept Plain =
    std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T> && !std::is_pointer_v<T> &&
    !std::is_same_v<T, bool>;

/// The XXH3 hash of 64 bits of all bytes so far. Source: Y. Collet, xxHash.
class RunningHash {
 public:
  RunningHash();
  RunningHash(const RunningHash&) = delete;
  RunningHash& operator=(const RunningHash&) = delete;
  ~RunningHash();

  void add(std::span<const char> bytes);
  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes in the byte order of the machine. The first error of the sink is kept, and nothing is written after it.
class ArchiveWriter {
 public:
  /// Takes the next bytes, many at a time.
  using Sink = std::function<Status(std::span<const char>)>;

  explicit ArchiveWriter(Sink sink);
  ArchiveWriter(const ArchiveWriter&) = delete;
  ArchiveWriter& operator=(const ArchiveWriter&) = delete;
  ~ArchiveWriter() = default;

  template <Plain T>
  void put(const T& plain) {
    put_bytes(&plain, sizeof(T));
  }
  void put(bool is) { put(static_cast<std::uint8_t>(is ? 1 : 0)); }
  void put(std::string_view text) { put_list(std::span{text.data(), text.size()}); }
  void put(const Integer& integer) { put(std::string_view{integer.to_string()}); }
  /// A list of plain elements, and how many they are.
  template <std::ranges::sized_range Range>
  void put_list(const Range& elements) {
    using Element = std::ranges::range_value_t<Range>;
    static_assert(Plain<Element>);
    put(static_cast<std::uint64_t>(std::ranges::size(elements)));
    if constexpr (std::ranges::contiguous_range<Range>) {
      put_bytes(std::ranges::data(elements), std::ranges::size(elements) * sizeof(Element));
    } else {
      std::ranges::for_each(elements, [this](const Element& element) { put(element); });
    }
  }
  /// A map from plain keys to plain values, by increasing keys.
  template <class Map>
  void put_map(const Map& map) {
    std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> sorted(map.begin(), map.end());
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    put(static_cast<std::uint64_t>(sorted.size()));
    for (const auto& [key, value] : sorted) {
      put(key);
      put(value);
    }
  }

  /// As they are, without their number.
  void put_bytes(const void* from, std::size_t bytes);

  /// Writes the checksum of all, and whatever the sink has not got yet. Errors: those of the sink. To be called once.
  Status finish();
  /// What has been put so far.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void give(std::span<const char> bytes);

  Sink sink_;
  RunningHash checksum_;
  std::vector<char> block_;  ///< that the sink has not got yet
  std::uint64_t bytes_ = 0;
  Status status_ = Done{};
};

/// Reads what an ArchiveWriter has written. The first thing that is wrong *fails* the reader: from then on numbers are
/// 0 and lists empty, and `status` says what it was. Memory is taken for bytes that there are, whatever they say.
class ArchiveReader {
 public:
  /// Puts the next bytes into a span, and says how many these are: fewer than it has room for only when there are no
  /// more.
  using Source = std::function<Result<std::size_t>(std::span<char>)>;

  /// `bytes`: how many there are in all, the checksum among them.
  ArchiveReader(Source source, std::uint64_t bytes);
  ArchiveReader(const ArchiveReader&) = delete;
  ArchiveReader& operator=(const ArchiveReader&) = delete;
  ~ArchiveReader() = default;

  template <Plain T>
  [[nodiscard]] T get() {
    T plain{};
    get_bytes(&plain, sizeof(T));
    return plain;
  }
  [[nodiscard]] bool get_bool();
  [[nodiscard]] std::string get_text() { return get_list<std::string>(); }
  /// So many bytes.
  [[nodiscard]] std::string get_text_of(std::size_t bytes);
  [[nodiscard]] Integer get_integer();
  /// A number that says how many things follow, which take at least so many bytes each.
  [[nodiscard]] std::size_t get_count(std::size_t least_bytes_each);
  /// A list of plain elements: a std::vector, a GrowingArray, a std::string.
  template <class List>
  [[nodiscard]] List get_list() {
    using Element = typename List::value_type;
    static_assert(Plain<Element>);
    List list;
    if constexpr (requires { list.resize_for_overwrite(std::size_t{}); }) {
      list.resize_for_overwrite(get_count(sizeof(Element)));
    } else {
      list.resize(get_count(sizeof(Element)));
    }
    get_bytes(list.data(), list.size() * sizeof(Element));
    if (!is_good()) {
      list.resize(0);
    }
    return list;
  }
  /// Calls visit(key, value) for each entry of a map. Fails unless keys increase.
  template <Plain Key, Plain Value, class Visit>
  void get_map(Visit&& visit) {
    std::optional<Key> before;
    for (std::size_t left = get_count(sizeof(Key) + sizeof(Value)); left > 0 && is_good(); --left) {
      const Key key = get<Key>();
      const Value value = get<Value>();
      check(!before || *before < key, "the keys of a table increase");
      before = key;
      if (is_good()) {
        visit(key, value);
      }
    }
  }

  /// The bytes that are left, without the checksum.
  [[nodiscard]] std::uint64_t left() const { return left_; }
  [[nodiscard]] bool is_good() const { return status_.has_value(); }
  [[nodiscard]] const Status& status() const { return status_; }
  /// Fails unless something holds that is true of all that was written; `sentence` says what. Returns whether the
  /// reader is good.
  bool check(bool holds, const char* sentence) {
    if (!holds) [[unlikely]] {
      fail(sentence);
    }
    return is_good();
  }
  /// Reads the checksum. Fails when it is not that of what was read, or when something is left.
  Status finish();

 private:
  void fail(const char* sentence);
  void get_bytes(void* to, std::size_t bytes);
  [[nodiscard]] bool fill(std::span<char> to);

  Source source_;
  RunningHash checksum_;
  std::vector<char> block_;  ///< bytes from the source
  std::size_t at_ = 0;       ///< of these, the ones that were read
  std::uint64_t unread_;     ///< bytes that the source has
  std::uint64_t left_;
  Status status_ = Done{};
};

}  // namespace sesame::sparse
