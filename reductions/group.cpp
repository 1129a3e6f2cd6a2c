#include "reductions/group.hpp"

#include <algorithm>

namespace sesame::reductions {

using sparse::Index;
using sparse::Integer;

namespace {

std::string power(const std::string& base, std::size_t exponent) {
  if (exponent == 1) {
    return base;
  }
  const bool simple = base.find('/') == std::string::npos;
  return (simple ? base : "(" + base + ")") + "^" + std::to_string(exponent);
}

/// Brings positive orders to a chain of divisors: Z/a + Z/b = Z/gcd + Z/lcm for each pair in turn.
void make_divisor_chain(std::vector<Integer>& orders) {
  for (std::size_t i = 0; i < orders.size(); ++i) {
    for (std::size_t j = i + 1; j < orders.size(); ++j) {
      const Integer common = gcd(orders[i], orders[j]);
      orders[j] *= divide(orders[i], common).quotient;
      orders[i] = common;
    }
  }
}

void add_gcds(std::vector<Integer>& orders, const AbelianGroup& a, const AbelianGroup& b) {
  for (const Integer& s : a.torsion) {
    for (const Integer& t : b.torsion) {
      orders.push_back(gcd(s, t));
    }
  }
}

Index torsion_rank(const AbelianGroup& group, std::uint32_t p) {
  return static_cast<Index>(
      std::count_if(group.torsion.begin(), group.torsion.end(), [p](const Integer& t) { return t.modulo(p) == 0; }));
}

}  // namespace

std::string AbelianGroup::to_string(const std::string& ring) const {
  std::string text = rank == 0 ? "" : power(ring, rank);
  for (auto from = torsion.begin(); from != torsion.end();) {
    const auto to = std::find_if(from, torsion.end(), [&](const Integer& t) { return t != *from; });
    text += text.empty() ? "" : " + ";
    text += power("Z/" + from->to_string(), static_cast<std::size_t>(to - from));
    from = to;
  }
  return text.empty() ? "0" : text;
}

AbelianGroup group_of(std::span<const Integer> orders) {
  AbelianGroup group;
  for (const Integer& order : orders) {
    if (order.is_zero()) {
      ++group.rank;
    } else if (!order.is_unit()) {
      group.torsion.push_back(abs(order));
    }
  }
  make_divisor_chain(group.torsion);
  std::erase_if(group.torsion, [](const Integer& t) { return t.is_unit(); });
  return group;
}

AbelianGroup direct_sum(const AbelianGroup& a, const AbelianGroup& b) {
  std::vector<Integer> orders = a.torsion;
  orders.insert(orders.end(), b.torsion.begin(), b.torsion.end());
  AbelianGroup sum = group_of(orders);
  sum.rank = a.rank + b.rank;
  return sum;
}

AbelianGroup tensor(const AbelianGroup& a, const AbelianGroup& b) {
  std::vector<Integer> orders;
  for (Index k = 0; k < a.rank; ++k) {
    orders.insert(orders.end(), b.torsion.begin(), b.torsion.end());
  }
  for (Index k = 0; k < b.rank; ++k) {
    orders.insert(orders.end(), a.torsion.begin(), a.torsion.end());
  }
  add_gcds(orders, a, b);
  AbelianGroup product = group_of(orders);
  product.rank = a.rank * b.rank;
  return product;
}

AbelianGroup tor(const AbelianGroup& a, const AbelianGroup& b) {
  std::vector<Integer> orders;
  add_gcds(orders, a, b);
  return group_of(orders);
}

std::vector<AbelianGroup> kunneth(std::span<const AbelianGroup> a, std::span<const AbelianGroup> b) {
  if (a.empty() || b.empty()) {
    return {};
  }
  std::vector<AbelianGroup> product(a.size() + b.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (std::size_t q = 0; q < b.size(); ++q) {
      product[p + q] = direct_sum(product[p + q], tensor(a[p], b[q]));
      product[p + q + 1] = direct_sum(product[p + q + 1], tor(a[p], b[q]));
    }
  }
  if (product.back().is_trivial()) {
    product.pop_back();
  }
  return product;
}

std::vector<Index> betti_numbers_modulo(std::span<const AbelianGroup> groups, std::uint32_t p) {
  std::vector<Index> betti(groups.size() + 1, 0);
  for (std::size_t n = 0; n < groups.size(); ++n) {
    const Index torsion = torsion_rank(groups[n], p);
    betti[n] += groups[n].rank + torsion;
    betti[n + 1] += torsion;
  }
  if (betti.back() == 0) {
    betti.pop_back();
  }
  return betti;
}

}  // namespace sesame::reductions
