#include <gmp.h>

#include <cstdlib>
#include <new>

#include "sparse/matrix.hpp"
#include "tests/support/catch.hpp"

namespace {
std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc{};
}
void* counted_again(void* old, std::size_t, std::size_t size) {
  ++allocations;
  return std::realloc(old, size);
}
void released(void* memory, std::size_t) { std::free(memory); }

/// GMP's memory goes through the counter while this lives.
struct CountGmp {
  CountGmp() {
    mp_get_memory_functions(&allocate, &reallocate, &release);
    mp_set_memory_functions(counted, counted_again, released);
  }
  CountGmp(const CountGmp&) = delete;
  CountGmp& operator=(const CountGmp&) = delete;
  ~CountGmp() { mp_set_memory_functions(allocate, reallocate, release); }
  void* (*allocate)(std::size_t) = nullptr;
  void* (*reallocate)(void*, std::size_t, std::size_t) = nullptr;
  void (*release)(void*, std::size_t) = nullptr;
};
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace sesame::sparse;

TEST_CASE("small arithmetic allocates nothing", "[sparse]") {
  const CountGmp gmp;
  std::vector<Integer> values;
  for (std::int64_t n = -40; n <= 40; ++n) {
    values.emplace_back(n * n * n * 12);
  }
  const std::size_t before = allocations;
  Integer checksum;
  for (const Integer& a : values) {
    for (const Integer& b : values) {
      checksum += a * b - a + b;
      checksum -= gcd(a, b) + extended_gcd(a, b).x + abs(a);
      if (!b.is_zero()) {
        checksum += divide(a, b).remainder;
      }
      Integer copy = b;
      copy = a;
      checksum = std::move(copy) + checksum + (a < b ? 1 : 0);
    }
  }
  CHECK(allocations == before);
  CHECK_FALSE(checksum.is_large());

  Integer large{std::int64_t{1} << 61};
  large *= 8;
  CHECK(large.is_large());
  CHECK(allocations > before);  // the counter does count
}

TEST_CASE("appending a column allocates nothing in the common case", "[sparse]") {
  Matrix<Integers> matrix(Integers{}, 1000, 0);
  const Terms<Integers> column{{3, 1}, {10, -1}, {500, 1}};
  const std::size_t before = allocations;
  for (int i = 0; i < 100'000; ++i) {
    matrix.append_column(column);
  }
  CHECK(allocations - before < 300);  // one per 4096 entries, and the doublings of the directory
}

TEST_CASE("a large matrix that stores little costs little", "[sparse]") {
  const std::size_t before = allocations;
  Matrix<Integers> matrix = Matrix<Integers>::identity(Integers{}, 4'000'000'000u);
  CHECK(allocations == before);
  const Terms<Integers> column{{3, 1}};
  for (Index j = 0; j < 10; ++j) {
    matrix.set_column(j * 100'000'000u, column);
  }
  CHECK(matrix.nonzeros() == 4'000'000'000u);
  CHECK(allocations - before < 40);
}
