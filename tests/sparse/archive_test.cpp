// Archives: what was written is read, and what was not written is told.
#include "sparse/archive.hpp"

#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/snapshots.hpp"

using namespace sesame;
using namespace sesame::sparse;
using namespace sesame::tests;

namespace {

const Integer large = Integer{INT64_MAX} * Integer{INT64_MAX} * Integer{-7};

struct Pair {
  std::uint32_t a, b;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// One of everything.
Bytes written(const std::vector<std::uint32_t>& numbers) {
  Bytes bytes;
  ArchiveWriter to(sink_into(bytes));
  to.put(std::uint64_t{7});
  to.put(true);
  to.put(std::string_view{"Möbius"});
  to.put(Integer{-3});
  to.put(large);
  to.put_list(numbers);
  to.put_list(std::deque<Pair>{{1, 2}, {3, 4}});
  to.put_map(std::unordered_map<std::uint32_t, std::uint64_t>{{5, 50}, {1, 10}, {3, 30}});
  REQUIRE(to.finish());
  CHECK(to.bytes() == bytes.size());
  return bytes;
}

/// Reads it all. Whether it is what was written.
Status read_back(const Bytes& bytes, const std::vector<std::uint32_t>& numbers, bool& is_same) {
  ArchiveReader from(source_of(bytes), bytes.size());
  is_same = from.get<std::uint64_t>() == 7;
  is_same = from.get_bool() && is_same;
  is_same = from.get_text() == "Möbius" && is_same;
  is_same = from.get_integer() == -3 && is_same;
  is_same = from.get_integer() == large && is_same;
  const auto list = from.get_list<GrowingArray<std::uint32_t>>();
  is_same = std::equal(list.begin(), list.end(), numbers.begin(), numbers.end()) && is_same;
  is_same = from.get_list<std::vector<Pair>>() == std::vector<Pair>{{1, 2}, {3, 4}} && is_same;
  std::vector<std::uint64_t> entries;
  from.get_map<std::uint32_t, std::uint64_t>([&](std::uint32_t key, std::uint64_t value) {
    entries.push_back(key);
    entries.push_back(value);
  });
  is_same = entries == std::vector<std::uint64_t>{1, 10, 3, 30, 5, 50} && is_same;
  return from.finish();
}

std::vector<std::uint32_t> numbers_up_to(std::uint32_t count) {
  std::vector<std::uint32_t> numbers(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    numbers[k] = k * k;
  }
  return numbers;
}

}  // namespace

TEST_CASE("an archive gives back what was put into it", "[sparse][archive]") {
  const auto numbers = numbers_up_to(GENERATE(0U, 3U, 262'143U, 262'144U, 1'000'000U));  // blocks have 2^20 bytes
  const Bytes bytes = written(numbers);
  bool is_same = false;
  const Status status = read_back(bytes, numbers, is_same);
  REQUIRE(status);
  CHECK(is_same);
  CHECK(written(numbers) == bytes);
}

TEST_CASE("an archive that has been cut off, or has a wrong bit or more at its end, is told", "[sparse][archive]") {
  const auto numbers = numbers_up_to(3);
  const Bytes whole = written(numbers);
  bool is_same = false;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    const Status status = read_back(part, numbers, is_same);
    REQUIRE_FALSE(status);
    CHECK(status.error().code == Errc::bad_input);
  }
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    CAPTURE(bit);
    Bytes other = whole;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    REQUIRE_FALSE(read_back(other, numbers, is_same));
  }
  Bytes longer = whole;
  longer.push_back('x');
  CHECK_FALSE(read_back(longer, numbers, is_same));
}

TEST_CASE("an archive takes no memory for what it has not got", "[sparse][archive]") {
  Bytes bytes;
  ArchiveWriter to(sink_into(bytes));
  to.put(std::uint64_t{1} << 60);
  REQUIRE(to.finish());
  ArchiveReader list(source_of(bytes), bytes.size());
  CHECK(list.get_list<std::vector<std::uint64_t>>().empty());
  CHECK_FALSE(list.status());
  ArchiveReader text(source_of(bytes), bytes.size());
  CHECK(text.get_text().empty());
  CHECK_FALSE(text.status());
}

TEST_CASE("after something that is wrong an archive reads nothing", "[sparse][archive]") {
  const Bytes bytes = written({1, 2, 3});
  ArchiveReader from(source_of(bytes), bytes.size());
  CHECK(from.check(true, "what is true is true"));
  CHECK_FALSE(from.check(false, "this is so"));
  CHECK_FALSE(from.check(false, "that is so"));
  CHECK(from.get<std::uint64_t>() == 0);
  CHECK(from.get_list<std::vector<std::uint32_t>>().empty());
  CHECK_FALSE(from.get_bool());
  const Status status = from.finish();
  REQUIRE_FALSE(status);
  CHECK(status.error().what == "this is not as it was written: it should hold that this is so");
}

TEST_CASE("keys of a table that do not increase, and truth values that are none, are told", "[sparse][archive]") {
  Bytes bytes;
  ArchiveWriter to(sink_into(bytes));
  to.put(std::uint8_t{2});
  for (const std::uint64_t word : {2U, 5U, 50U, 5U, 50U}) {
    to.put(word);
  }
  REQUIRE(to.finish());
  ArchiveReader truth(source_of(bytes), bytes.size());
  (void)truth.get_bool();
  CHECK_FALSE(truth.status());
  ArchiveReader table(source_of(bytes), bytes.size());
  (void)table.get<std::uint8_t>();
  int visited = 0;
  table.get_map<std::uint64_t, std::uint64_t>([&](std::uint64_t, std::uint64_t) { ++visited; });
  CHECK(visited == 1);
  CHECK_FALSE(table.status());
}

TEST_CASE("errors of the sink and of the source come out", "[sparse][archive]") {
  int asked = 0;
  ArchiveWriter to([&](std::span<const char>) -> Status {
    ++asked;
    return Error{Errc::io, "the disk is full"};
  });
  to.put_list(numbers_up_to(1'000'000));
  to.put_list(numbers_up_to(1'000'000));
  const Status written = to.finish();
  REQUIRE_FALSE(written);
  CHECK(written.error().what == "the disk is full");
  CHECK(asked == 1);
  ArchiveReader from([](std::span<char>) -> Result<std::size_t> { return Error{Errc::io, "the disk is gone"}; }, 100);
  CHECK(from.get<std::uint32_t>() == 0);
  REQUIRE_FALSE(from.status());
  CHECK(from.status().error().code == Errc::io);
}
