// When no bars were matched, each would pay for its way to the diagonal. Matching i to j saves
// diagonal(i) + diagonal(j) - cost(i, j), where all costs are q-th powers: what is looked for is the matching that
// saves most. As an assignment
// problem: rows are the points of the left, columns those of the right, and each row has one more column for itself,
// the diagonal, which saves nothing. Rows are assigned one after the other along shortest augmenting paths; a path ends
// at a free column, or at the diagonal of a row that it has reached. Potentials (u of rows, v of columns) keep all
// reduced costs from being negative, and v is 0 on free columns and on diagonals.
//
// Differences of powers would lose the small costs beside the large ones: for q = 5 a cost of a thousandth of the
// longest bar is nothing. So a bottleneck matching comes first. Its largest cost D is the unit; it costs at most n + m
// in units of D^q, so no match that costs more is ever wanted, and all powers can be cut off a little above.
#include <algorithm>
#include <cmath>
#include <limits>

#include "replay/distance/diagram_parts.hpp"
#include "sparse/contract.hpp"

namespace sesame::replay {
namespace {

/// Pairs whose costs are kept; beyond that each is computed when it is asked for.
constexpr std::size_t most_costs_kept = std::size_t{1} << 24;

/// x^q; the frequent exponents fast.
double power(double x, double q) { return q == 1 ? x : q == 2 ? x * x : std::pow(x, q); }

/// What matching a row to a column costs more (less, when negative) than sending both to the diagonal, in units of
/// the q-th power of `unit`.
class Costs {
 public:
  /// Requires: some matching exists whose costs are at most `unit`, which is not 0.
  Costs(std::span<const DiagramPoint> rows, std::span<const DiagramPoint> columns, double q, GroundMetric ground,
        double unit)
      : rows_{rows},
        columns_{columns},
        q_{q},
        ground_{ground},
        unit_{unit},
        never_wanted_{2 * static_cast<double>(rows.size() + columns.size())} {
    for (const DiagramPoint& point : rows) {
      of_rows_.push_back(raised(distance_to_diagonal(point, ground)));
    }
    for (const DiagramPoint& point : columns) {
      of_columns_.push_back(raised(distance_to_diagonal(point, ground)));
    }
    if (!columns.empty() && rows.size() <= most_costs_kept / columns.size()) {
      kept_.reserve(rows.size() * columns.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < columns.size(); ++j) {
          kept_.push_back(computed(i, j));
        }
      }
    }
  }

  double operator()(std::size_t i, std::size_t j) const {
    return kept_.empty() ? computed(i, j) : kept_[i * columns_.size() + j];
  }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] std::size_t columns() const { return columns_.size(); }

 private:
  [[nodiscard]] double raised(engine::Time x) const { return std::min(power(x.nearest() / unit_, q_), never_wanted_); }

  [[nodiscard]] double computed(std::size_t i, std::size_t j) const {
    return raised(ground_distance(rows_[i], columns_[j], ground_)) - of_rows_[i] - of_columns_[j];
  }

  std::span<const DiagramPoint> rows_, columns_;
  double q_;
  GroundMetric ground_;
  double unit_, never_wanted_;
  std::vector<double> of_rows_, of_columns_;  ///< of the ways to the diagonal
  std::vector<double> kept_;                  ///< row after row, or empty
};

class Assignment {
 public:
  explicit Assignment(const Costs& costs)
      : costs_{costs},
        u_(costs.rows()),
        v_(costs.columns()),
        partner_(costs.rows(), no_point),
        owner_(costs.columns(), no_point),
        length_(costs.columns()),
        before_(costs.columns()),
        to_reach_(costs.columns()) {}

  std::vector<PointId> partners() && {
    for (PointId row = 0; row < costs_.rows(); ++row) {
      assign(row);
    }
    return std::move(partner_);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Dijkstra's algorithm over the columns, from a row that has none, then the exchange along the path found.
  void assign(PointId start) {
    std::fill(length_.begin(), length_.end(), infinity);
    for (PointId j = 0; j < to_reach_.size(); ++j) {
      to_reach_[j] = j;
    }
    std::size_t left = to_reach_.size();
    PointId row = start, end_row = start, end_column = no_point;
    double length = 0, to_diagonal = infinity;
    while (true) {
      if (length - u_[row] < to_diagonal) {
        to_diagonal = length - u_[row];
        end_row = row;
      }
      const std::size_t nearest = relax(row, length, left);
      if (nearest == left || !(length_[to_reach_[nearest]] < to_diagonal)) {
        length = to_diagonal;
        break;
      }
      const PointId column = to_reach_[nearest];
      length = length_[column];
      std::swap(to_reach_[nearest], to_reach_[--left]);
      if (owner_[column] == no_point) {
        end_row = before_[column];
        end_column = column;
        break;
      }
      row = owner_[column];
    }
    update_potentials(start, length, left);
    exchange(start, end_row, end_column);
  }

  /// Shortens the ways to the first `left` columns of to_reach_ through a row at the given length; returns the place of
  /// the nearest of them, `left` when there is none.
  std::size_t relax(PointId row, double length, std::size_t left) {
    const double offset = length - u_[row];
    std::size_t nearest = left;
    double least = infinity;
    for (std::size_t k = 0; k < left; ++k) {
      const PointId column = to_reach_[k];
      const double through = offset + costs_(row, column) - v_[column];
      if (through < length_[column]) {
        length_[column] = through;
        before_[column] = row;
      }
      if (length_[column] < least) {
        least = length_[column];
        nearest = k;
      }
    }
    return nearest;
  }

  /// So that no reduced cost is negative and those along the path are 0. Columns from place `left` on were reached.
  void update_potentials(PointId start, double length, std::size_t left) {
    u_[start] += length;
    for (std::size_t k = left; k < to_reach_.size(); ++k) {
      const PointId column = to_reach_[k];
      const double nearer = length - length_[column];
      if (owner_[column] != no_point) {
        u_[owner_[column]] += nearer;
      }
      v_[column] -= nearer;
    }
  }

  /// The row at the end takes the column at the end, or goes to the diagonal, and leaves its own to the row before it.
  void exchange(PointId start, PointId row, PointId column) {
    while (true) {
      const PointId freed = partner_[row];
      partner_[row] = column;
      if (column != no_point) {
        owner_[column] = row;
      }
      if (row == start) {
        return;
      }
      column = freed;
      row = before_[column];
    }
  }

  const Costs& costs_;
  std::vector<double> u_, v_;
  std::vector<PointId> partner_, owner_;  ///< the assignment so far, from both sides
  std::vector<double> length_;            ///< of the shortest way to a column known
  std::vector<PointId> before_;           ///< the row from which that way reaches it
  std::vector<PointId> to_reach_;         ///< the columns not reached yet, then those that were
};

/// The largest cost of a match of points.
double largest_cost(const DiagramParts& left, const DiagramParts& right, std::span<const PointId> partners,
                    GroundMetric ground) {
  engine::Time largest;
  std::vector<bool> is_matched(right.points.size());
  for (std::size_t i = 0; i < partners.size(); ++i) {
    const bool has_partner = partners[i] != no_point;
    largest = std::max(largest, has_partner ? ground_distance(left.points[i], right.points[partners[i]], ground)
                                            : distance_to_diagonal(left.points[i], ground));
    if (has_partner) {
      is_matched[partners[i]] = true;
    }
  }
  for (std::size_t j = 0; j < right.points.size(); ++j) {
    largest = std::max(largest, is_matched[j] ? 0 : distance_to_diagonal(right.points[j], ground));
  }
  return largest.nearest();
}

/// (sum of cost^q)^(1/q).
double norm(const std::vector<Match>& matching, double q) {
  double largest = 0;
  for (const Match& match : matching) {
    largest = std::max(largest, match.cost.nearest());
  }
  if (largest == 0 || std::isinf(largest)) {
    return largest;
  }
  const double unit = q == 1 ? 1 : largest;  // powers may be too large for a double, sums are not
  double sum = 0;
  for (const Match& match : matching) {
    sum += power(match.cost.nearest() / unit, q);
  }
  return q == 1 ? sum : unit * std::pow(sum, 1 / q);
}

}  // namespace

DiagramDistance wasserstein_distance(std::span<const engine::Bar> left, std::span<const engine::Bar> right, double q,
                                     GroundMetric ground) {
  sparse::expects(std::isfinite(q) && q >= 1, "q is finite and at least 1");
  const DiagramParts left_parts(left), right_parts(right);
  std::vector<PointId> partners = bottleneck_partners(left_parts.points, right_parts.points);
  const double unit = largest_cost(left_parts, right_parts, partners, ground);
  if (unit > 0) {
    const Costs costs(left_parts.points, right_parts.points, q, ground, unit);
    partners = Assignment(costs).partners();
  }
  std::vector<Match> matching = whole_matching(left, right, left_parts, right_parts, partners, ground);
  const double value = norm(matching, q);
  return {value, std::move(matching)};
}

}  // namespace sesame::replay
