#include "sparse/integer.hpp"

#include <gmp.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace sesame::sparse {

static_assert(sizeof(mp_limb_t) == sizeof(std::uint64_t), "a small value is read as a GMP number of one limb");
static_assert(alignof(__mpz_struct) >= 2, "the lowest bit of the address of a GMP number must be free for the tag");

/// What integer.cpp alone may do with the word of an Integer.
struct IntegerAccess {
  static mpz_ptr large(const Integer& a) { return reinterpret_cast<mpz_ptr>(a.word_ - 1); }
  static std::int64_t small(const Integer& a) { return a.word_ / 2; }
  static bool both_small(const Integer& a, const Integer& b) { return ((a.word_ | b.word_) & 1) == 0; }

  static void set_new(Integer& a) {
    auto* number = new __mpz_struct;
    mpz_init(number);
    a.word_ = reinterpret_cast<std::int64_t>(number) + 1;
  }

  /// out = value, in canonical form; `value` is left with anything.
  static void take(Integer& out, mpz_ptr value) {
    const bool fits = mpz_fits_slong_p(value) != 0;
    const std::int64_t word = fits ? mpz_get_si(value) : 0;
    if (fits && word >= Integer::min_small && word <= Integer::max_small) {
      out = Integer{word};
      return;
    }
    if (!out.is_large()) {
      set_new(out);
    }
    mpz_swap(large(out), value);
  }
};

namespace {

using Access = IntegerAccess;

/// Any Integer as a GMP number to read from. A small one becomes a number of one limb on the stack.
class View {
 public:
  explicit View(const Integer& a) {
    if (a.is_large()) {
      number_ = Access::large(a);
      return;
    }
    const std::int64_t value = Access::small(a);
    limb_ = value < 0 ? -static_cast<mp_limb_t>(value) : static_cast<mp_limb_t>(value);
    number_ = mpz_roinit_n(storage_, &limb_, (value > 0) - (value < 0));
  }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  ~View() = default;
  [[nodiscard]] mpz_srcptr get() const { return number_; }

 private:
  mp_limb_t limb_ = 0;
  mpz_t storage_;
  mpz_srcptr number_ = nullptr;
};

/// A GMP number that goes with its scope.
class Scratch {
 public:
  Scratch() { mpz_init(number_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { mpz_clear(number_); }
  mpz_ptr get() { return number_; }

 private:
  mpz_t number_;
};

Integer taken(Scratch& value) {
  Integer out;
  Access::take(out, value.get());
  return out;
}

Division divide_small(std::int64_t a, std::int64_t b) {
  std::int64_t quotient = a / b;
  std::int64_t remainder = a % b;
  if (remainder < 0) {
    quotient += b > 0 ? -1 : 1;
    remainder += b > 0 ? b : -b;
  }
  return {quotient, remainder};
}

Bezout extended_gcd_small(std::int64_t a, std::int64_t b) {
  std::int64_t r0 = a, r1 = b, x0 = 1, x1 = 0, y0 = 0, y1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    r0 = std::exchange(r1, r0 - q * r1);
    x0 = std::exchange(x1, x0 - q * x1);
    y0 = std::exchange(y1, y0 - q * y1);
  }
  if (r0 < 0) {
    return {-r0, -x0, -y0};
  }
  return {r0, x0, y0};
}

}  // namespace

void Integer::set_large(std::int64_t value) {
  Access::set_new(*this);
  mpz_set_si(Access::large(*this), value);
}

void Integer::clone_from(const Integer& other) {
  auto* number = new __mpz_struct;
  mpz_init_set(number, Access::large(other));
  word_ = reinterpret_cast<std::int64_t>(number) + 1;
}

void Integer::free_large() noexcept {
  mpz_ptr number = Access::large(*this);
  mpz_clear(number);
  delete number;
}

void Integer::add_large(const Integer& other) {
  Scratch sum;
  mpz_add(sum.get(), View{*this}.get(), View{other}.get());
  Access::take(*this, sum.get());
}

void Integer::subtract_large(const Integer& other) {
  Scratch difference;
  mpz_sub(difference.get(), View{*this}.get(), View{other}.get());
  Access::take(*this, difference.get());
}

void Integer::multiply_large(const Integer& other) {
  Scratch product;
  mpz_mul(product.get(), View{*this}.get(), View{other}.get());
  Access::take(*this, product.get());
}

int Integer::large_sign() const { return mpz_sgn(Access::large(*this)); }

std::size_t Integer::large_words() const { return mpz_size(Access::large(*this)); }

int Integer::compare_large(const Integer& a, const Integer& b) { return mpz_cmp(View{a}.get(), View{b}.get()); }

std::optional<Integer> Integer::parse(std::string_view digits) {
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) {
    digits.remove_prefix(1);
  }
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    return std::nullopt;
  }
  Scratch value;
  mpz_set_str(value.get(), std::string{digits}.c_str(), 10);
  if (negative) {
    mpz_neg(value.get(), value.get());
  }
  return taken(value);
}

std::optional<std::int64_t> Integer::to_int64() const {
  if (!is_large()) {
    return Access::small(*this);
  }
  if (mpz_fits_slong_p(Access::large(*this)) == 0) {
    return std::nullopt;
  }
  return mpz_get_si(Access::large(*this));
}

std::string Integer::to_string() const {
  if (!is_large()) {
    return std::to_string(Access::small(*this));
  }
  // mpz_sizeinbase does not count the sign and the final zero.
  std::string text(mpz_sizeinbase(Access::large(*this), 10) + 2, '\0');
  mpz_get_str(text.data(), 10, Access::large(*this));
  text.resize(std::strlen(text.c_str()));
  return text;
}

std::uint32_t Integer::modulo(std::uint32_t m) const {
  expects(m > 0, "Integer::modulo: the modulus must be positive");
  if (is_large()) {
    return static_cast<std::uint32_t>(mpz_fdiv_ui(Access::large(*this), m));
  }
  const std::int64_t remainder = Access::small(*this) % std::int64_t{m};
  return static_cast<std::uint32_t>(remainder < 0 ? remainder + std::int64_t{m} : remainder);
}

Integer abs(const Integer& a) { return a.sign() < 0 ? -a : a; }

Division divide(const Integer& a, const Integer& b) {
  expects(!b.is_zero(), "divide: the divisor must not be zero");
  if (Access::both_small(a, b)) {
    return divide_small(Access::small(a), Access::small(b));
  }
  Scratch quotient, remainder;
  if (b.sign() > 0) {
    mpz_fdiv_qr(quotient.get(), remainder.get(), View{a}.get(), View{b}.get());
  } else {
    mpz_cdiv_qr(quotient.get(), remainder.get(), View{a}.get(), View{b}.get());
  }
  return {taken(quotient), taken(remainder)};
}

Integer gcd(const Integer& a, const Integer& b) {
  if (Access::both_small(a, b)) {
    return std::gcd(Access::small(a), Access::small(b));
  }
  Scratch result;
  mpz_gcd(result.get(), View{a}.get(), View{b}.get());
  return taken(result);
}

Bezout extended_gcd(const Integer& a, const Integer& b) {
  if (Access::both_small(a, b)) {
    return extended_gcd_small(Access::small(a), Access::small(b));
  }
  Scratch g, x, y;
  mpz_gcdext(g.get(), x.get(), y.get(), View{a}.get(), View{b}.get());
  return {taken(g), taken(x), taken(y)};
}

}  // namespace sesame::sparse
