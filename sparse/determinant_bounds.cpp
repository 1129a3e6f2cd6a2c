#include "sparse/determinant_bounds.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace sesame::sparse {
namespace {

using Dense = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The largest entry of |A| |B| 1, or of |A| |B| |C| 1: each a row sum of what bounds a product.
double largest(const Vector& vector) { return vector.cwiseAbs().maxCoeff(); }

}  // namespace

std::optional<LogDeterminant> log_determinant(const ApproximateMatrix& matrix) {
  const auto n = static_cast<Eigen::Index>(matrix.size);
  if (n == 0) {
    return LogDeterminant{0, 0};
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Dense a = Eigen::Map<const RowMajor>(matrix.entries.data(), n, n);
  const Eigen::PartialPivLU<Dense> lu(a);
  const Dense permuted = lu.permutationP() * a;
  const Dense one = Dense::Identity(n, n);
  Dense x = lu.matrixLU().triangularView<Eigen::Upper>().solve(one);
  Dense y = lu.matrixLU().triangularView<Eigen::UnitLower>().solve(one);
  x.triangularView<Eigen::StrictlyLower>().setZero();
  y.triangularView<Eigen::StrictlyUpper>().setZero();
  y.diagonal().setOnes();

  const Dense inner = y * permuted;
  const Dense error = x * inner - one;
  // What rounding may have done: `gamma` for each product, twice as much as must be, for the row sums as well.
  const double u = std::numeric_limits<double>::epsilon();
  const double gamma = 2 * static_cast<double>(n + 4) * u;
  const Vector ones = Vector::Ones(n);
  const Vector rows = x.cwiseAbs() * (y.cwiseAbs() * (permuted.cwiseAbs() * ones));
  const Vector outer = x.cwiseAbs() * (inner.cwiseAbs() * ones);
  const double tiny = std::numeric_limits<double>::min() * 1e16;  // products that underflow
  const double underflow =
      tiny * static_cast<double>(n) * (1 + largest(x.cwiseAbs() * ones)) * (1 + largest(y.cwiseAbs() * ones));
  const double bound = 1.001 * (largest(error.cwiseAbs() * ones) + gamma * largest(outer) +
                                (gamma + 2 * matrix.relative_error) * largest(rows) + underflow);
  if (!(bound < 0.5)) {  // not a number is no bound either
    return std::nullopt;
  }
  double logarithm = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    logarithm -= std::log(std::abs(x(i, i)));
  }
  // The logarithms are of numbers between 1e-308 and 1e308: each is less than 710 and has an error of less than 1e-12.
  const double slack = static_cast<double>(n) * (-std::log1p(-bound) * 1.001 + static_cast<double>(n) * 1e-12);
  if (!std::isfinite(logarithm) || !std::isfinite(slack)) {
    return std::nullopt;
  }
  return LogDeterminant{logarithm - slack, logarithm + slack};
}

}  // namespace sesame::sparse
