#include "sparse/rational.hpp"

namespace sesame::sparse {

Rational::Rational(Integer numerator, Integer denominator)
    : numerator_{std::move(numerator)}, denominator_{std::move(denominator)} {
  expects(!denominator_.is_zero(), "a fraction has a denominator other than 0");
  reduce();
}

void Rational::reduce() {
  if (is_integer()) {
    return;
  }
  const Integer divisor = denominator_.sign() < 0 ? -gcd(numerator_, denominator_) : gcd(numerator_, denominator_);
  numerator_ = divide(numerator_, divisor).quotient;
  denominator_ = divide(denominator_, divisor).quotient;
}

std::string Rational::to_string() const {
  return is_integer() ? numerator_.to_string() : numerator_.to_string() + "/" + denominator_.to_string();
}

Rational& Rational::operator+=(const Rational& other) {
  if (is_integer() && other.is_integer()) {
    numerator_ += other.numerator_;
    return *this;
  }
  // By value: the other may be this one.
  Integer numerator = numerator_ * other.denominator_ + other.numerator_ * denominator_;
  denominator_ *= Integer{other.denominator_};
  numerator_ = std::move(numerator);
  reduce();
  return *this;
}

Rational& Rational::operator*=(const Rational& other) {
  if (is_integer() && other.is_integer()) {
    numerator_ *= Integer{other.numerator_};
    return *this;
  }
  const Rational factor = other;  // which may be this one
  numerator_ *= factor.numerator_;
  denominator_ *= factor.denominator_;
  reduce();
  return *this;
}

Rational abs(const Rational& a) { return a.sign() < 0 ? -a : a; }

}  // namespace sesame::sparse
