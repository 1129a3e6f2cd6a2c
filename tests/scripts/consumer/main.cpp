/// \file
/// A user's program: 25! over Z, where it does not fit a machine word, over a field, and over what is no field.
#include <cstdint>
#include <iostream>
#include <sesame/sparse/integer.hpp>
#include <sesame/sparse/ring.hpp>
#include <sesame/version.hpp>
#include <string>
#include <variant>

namespace {

template <sesame::sparse::Ring R>
sesame::sparse::Integer factorial(const R& ring, std::int64_t n) {
  auto product = ring.one();
  for (std::int64_t k = 2; k <= n; ++k) {
    product = ring.multiply(product, ring.from(k));
  }
  return ring.to_integer(product);
}

}  // namespace

int main() {
  for (const std::string name : {"Z", "Z/101", "Z/100"}) {
    const auto ring = sesame::sparse::parse_ring(name);
    if (!ring) {
      std::cout << name << " is refused\n";
      continue;
    }
    const auto answer = std::visit([](const auto& r) { return factorial(r, 25); }, *ring);
    std::cout << "25! in " << name << " = " << answer.to_string() << "\n";
  }
  std::cout << "sesame " << SESAME_VERSION << "\n";
}
