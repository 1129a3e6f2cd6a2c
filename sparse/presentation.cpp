#include "sparse/presentation.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sparse/smith.hpp"

namespace sesame::sparse {

namespace {

const Integers ring;

/// Fewer relations that wait than this are eliminated in no time.
constexpr std::size_t least_for_span = 24;

/// The invariant factors > 1 of a sum of cyclic groups.
void make_divide(std::vector<Integer>& orders) {
  Matrix<Integers> diagonal(ring, static_cast<Index>(orders.size()), 0);
  for (const Integer& order : orders) {
    diagonal.append_column(Terms<Integers>{{diagonal.columns(), order}});
  }
  orders = invariant_factors(diagonal);
  std::erase_if(orders, [](const Integer& factor) { return factor.is_unit(); });
}

/// A vector with `value` in the place of a coordinate. Whether it has the coordinate.
bool substitute_in(Terms<Integers>& vector, Index coordinate, const Terms<Integers>& value) {
  const Term<Integers>* entry = find_term<Integers>(vector, coordinate);
  if (entry == nullptr) {
    return false;
  }
  const Integer coefficient = entry->coefficient;
  vector.erase(vector.begin() + (entry - vector.data()));
  add_multiple<Integers>(ring, vector, coefficient, value);
  return true;
}

}  // namespace

void Presentation::add_generator(Index generator) {
  ++generators_;
  ++group_.free_rank;
  set_image(generator, {{add_coordinate(0), 1}});
}

void Presentation::add_combination(Index generator, const Vector& combination) {
  set_image(generator, image_of(combination));
}

Index Presentation::add_coordinate(Integer order) {
  free_coordinates_ += order.is_zero() ? 1 : 0;
  coordinates_.push_back({std::move(order), {}});
  return static_cast<Index>(coordinates_.size() - 1);
}

/// A combination in coordinates.
Presentation::Vector Presentation::image_of(const Vector& combination) {
  RawTerms<Integers> sum;
  for (const auto& [generator, coefficient] : combination) {
    if (!contains(generator)) {
      add_generator(generator);
    }
    for (const auto& [coordinate, entry] : images_.at(generator)) {
      sum.push_back({coordinate, coefficient * entry});
    }
  }
  Vector image = std::move(sum).normal(ring);
  reduce(image);
  return image;
}

/// Entries in coordinates of finite order are brought between 0 and the order.
void Presentation::reduce(Vector& vector) const {
  for (auto& [coordinate, entry] : vector) {
    if (const Integer& order = coordinates_[coordinate].order; !order.is_zero()) {
      entry = divide(entry, order).remainder;
    }
  }
  std::erase_if(vector, [](const Term<Integers>& term) { return term.coefficient.is_zero(); });
}

void Presentation::set_image(Index generator, Vector image) {
  reduce(image);
  Vector& old = images_[generator];
  for (const auto& [coordinate, entry] : image) {
    if (find_term<Integers>(old, coordinate) == nullptr) {
      coordinates_[coordinate].users.push_back(generator);
    }
  }
  old = std::move(image);
}

/// The generators whose images have a coordinate, which is about to be substituted.
std::vector<Index> Presentation::take_users(Index coordinate) {
  std::vector<Index> users = std::exchange(coordinates_[coordinate].users, {});
  std::sort(users.begin(), users.end());
  users.erase(std::unique(users.begin(), users.end()), users.end());
  std::erase_if(users,
                [&](Index generator) { return find_term<Integers>(images_.at(generator), coordinate) == nullptr; });
  return users;
}

/// Writes `value` in the place of a coordinate, which may be in it, in all images and in what waits.
void Presentation::substitute(Index coordinate, const Vector& value) {
  for (const Index generator : take_users(coordinate)) {
    Vector& old = images_.at(generator);
    Vector image = old;
    old.erase(old.begin() + (find_term<Integers>(old, coordinate) - old.data()));
    substitute_in(image, coordinate, value);
    set_image(generator, std::move(image));
  }
  for (Vector& relation : waiting_) {
    if (substitute_in(relation, coordinate, value)) {
      reduce(relation);
      is_current_ = false;
      implied_.reset();
    }
  }
}

void Presentation::add_relation(const Vector& relation) {
  const Vector image = image_of(relation);
  if (image.empty() || follows(image)) {
    return;
  }
  if (!settle(image)) {
    is_current_ = false;
    implied_.reset();
    waiting_.push_back(image);
    return;
  }
  // What waits may have changed: whatever can be settled now, is, until nothing can.
  for (std::size_t k = 0; k < waiting_.size();) {
    const Vector next = waiting_[k];
    if (!next.empty() && !settle(next)) {
      ++k;
      continue;
    }
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(k));
    implied_.reset();
    k = next.empty() ? k : 0;
  }
}

/// Whether a relation is a combination of those that wait and of the orders of coordinates. Where these leave no
/// torsion, all that is in their span over Q is one.
bool Presentation::follows(const Vector& relation) {
  if (waiting_.size() < least_for_span || leaves_torsion_ || (!implied_ && !is_current_)) {
    return false;
  }
  if (!implied_) {
    find_implied();
  }
  if (!implied_->span) {
    return false;
  }
  RawTerms<Integers> on_rows;
  for (const auto& [coordinate, entry] : relation) {
    const auto row = implied_->rows.find(coordinate);
    if (row == implied_->rows.end()) {
      return false;
    }
    on_rows.push_back({row->second, entry});
  }
  return implied_->span->contains(std::move(on_rows).normal(ring));
}

void Presentation::find_implied() {
  Waiting& waiting = implied_.emplace();
  const Matrix<Integers> matrix = matrix_of_waiting(waiting.rows);
  std::vector<Vector> columns;
  for (Index j = 0; j < matrix.columns(); ++j) {
    columns.push_back(matrix.column(j));
  }
  waiting.span = RationalSpan::of(matrix.rows(), columns);
}

/// Makes a relation, which is not 0, hold; false when it has to wait. Of the coordinates that can be expressed it takes
/// the one that the fewest images have.
bool Presentation::settle(const Vector& relation) {
  Integer divisor = 0;
  bool is_finite = true;
  for (const auto& [coordinate, entry] : relation) {
    divisor = gcd(divisor, entry);
    is_finite = is_finite && !coordinates_[coordinate].order.is_zero();
  }
  if (is_finite) {
    relate_finite(relation);
    return true;
  }
  const Term<Integers>* best = nullptr;
  for (const Term<Integers>& term : relation) {
    const Coordinate& coordinate = coordinates_[term.index];
    if (coordinate.order.is_zero() && abs(term.coefficient) == divisor &&
        (best == nullptr || coordinate.users.size() < coordinates_[best->index].users.size())) {
      best = &term;
    }
  }
  if (best != nullptr) {
    substitute_divisor(relation, best->index, best->coefficient);
  }
  return best != nullptr;
}

/// The relation is `divisor` times a sum in which the free coordinate has the coefficient 1: the sum becomes a
/// coordinate in its place, of that order, and there is none when that is 1.
void Presentation::substitute_divisor(const Vector& relation, Index coordinate, const Integer& divisor) {
  RawTerms<Integers> value;
  for (const auto& [index, entry] : relation) {
    if (index != coordinate) {
      value.push_back({index, -divide(entry, divisor).quotient});
    }
  }
  --free_coordinates_;
  --group_.free_rank;  // unless what waits or a finite coordinate changes, that is all
  if (!divisor.is_unit()) {
    is_current_ = false;
    value.push_back({add_coordinate(abs(divisor)), 1});
  }
  substitute(coordinate, std::move(value).normal(ring));
  coordinates_[coordinate].order = 1;
}

/// A relation of coordinates of finite order: their sum modulo the relation is finite, and its Smith form says what it
/// is.
void Presentation::relate_finite(const Vector& relation) {
  is_current_ = false;
  const auto count = static_cast<Index>(relation.size());
  Matrix<Integers> relations(ring, count, 0);
  Vector first;
  for (Index k = 0; k < count; ++k) {
    first.push_back({k, relation[k].coefficient});
  }
  relations.append_column(first);
  for (Index k = 0; k < count; ++k) {
    relations.append_column(Vector{{k, coordinates_[relation[k].index].order}});
  }
  const SmithForm<Integers> form = smith_form(relations);
  // The new coordinates, each with its order, and the old ones in them.
  std::vector<Index> made(count);
  for (Index k = 0; k < count; ++k) {
    made[k] = form.factors[k].is_unit() ? count : add_coordinate(form.factors[k]);
  }
  for (Index k = 0; k < count; ++k) {
    Vector value;
    form.left.for_each_in_column(k, [&](const Term<Integers>& term) {
      if (made[term.index] != count) {
        value.push_back({made[term.index], term.coefficient});
      }
    });
    substitute(relation[k].index, value);
    coordinates_[relation[k].index].order = 1;
  }
}

const Presentation::Group& Presentation::group() {
  if (!is_current_) {
    compute_group();
    is_current_ = true;
  }
  return group_;
}

/// The relations that wait, and the orders of their coordinates, as columns; `rows` are these coordinates, by number.
Matrix<Integers> Presentation::matrix_of_waiting(std::unordered_map<Index, Index>& rows) const {
  Matrix<Integers> matrix(ring, 0, 0);
  for (const Vector& relation : waiting_) {
    RawTerms<Integers> column;
    for (const auto& [coordinate, entry] : relation) {
      const auto [row, is_new] = rows.try_emplace(coordinate, matrix.rows());
      if (is_new) {
        matrix.append_rows(1);
      }
      column.push_back({row->second, entry});
    }
    matrix.append_column(std::move(column).normal(ring));
  }
  for (Index k = 0; k < coordinates_.size(); ++k) {
    const Integer& order = coordinates_[k].order;
    const auto row = rows.find(k);
    if (row != rows.end() && !order.is_zero()) {
      matrix.append_column(Vector{{row->second, order}});
    }
  }
  return matrix;
}

void Presentation::compute_group() {
  group_ = {free_coordinates_, {}};
  std::unordered_map<Index, Index> rows;  // of the coordinates that wait
  const Matrix<Integers> matrix = matrix_of_waiting(rows);
  const std::size_t finite = matrix.columns() - waiting_.size();
  for (Index k = 0; k < coordinates_.size(); ++k) {
    const Integer& order = coordinates_[k].order;
    if (!order.is_zero() && !order.is_unit() && !rows.contains(k)) {
      group_.torsion.push_back(order);
    }
  }
  const std::vector<Integer> factors = invariant_factors(matrix);
  leaves_torsion_ = !factors.empty() && !factors.back().is_unit();
  if (factors.size() == matrix.rows() && !leaves_torsion_) {
    // What waits leaves nothing of the coordinates that it has.
    waiting_.clear();
    implied_.reset();
    for (const auto& [coordinate, row] : rows) {
      free_coordinates_ -= coordinates_[coordinate].order.is_zero() ? 1 : 0;
      substitute(coordinate, {});
      coordinates_[coordinate].order = 1;
    }
  }
  group_.free_rank -= factors.size() - finite;
  std::copy_if(factors.begin(), factors.end(), std::back_inserter(group_.torsion),
               [](const Integer& factor) { return !factor.is_unit(); });
  std::sort(group_.torsion.begin(), group_.torsion.end());
  const auto fails = [](const Integer& a, const Integer& b) { return !divide(b, a).remainder.is_zero(); };
  if (std::adjacent_find(group_.torsion.begin(), group_.torsion.end(), fails) != group_.torsion.end()) {
    make_divide(group_.torsion);
  }
}

}  // namespace sesame::sparse
