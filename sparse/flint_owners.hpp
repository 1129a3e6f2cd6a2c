/// \file
/// FLINT's numbers and matrices, with an owner. Part of the p-adic .cpp files, which alone include it.
#pragma once

#include <flint/fmpz.h>
#include <flint/fmpz_mat.h>
#include <flint/nmod_mat.h>

#include <string>

#include "sparse/integer.hpp"

namespace sesame::sparse {

class Number {
 public:
  Number() { fmpz_init(value_); }
  explicit Number(ulong value) { fmpz_init_set_ui(value_, value); }
  Number(const Number& other) { fmpz_init_set(value_, other.value_); }
  Number& operator=(const Number& other) {
    fmpz_set(value_, other.value_);
    return *this;
  }
  ~Number() { fmpz_clear(value_); }
  operator fmpz*() { return value_; }              // NOLINT(google-explicit-constructor): as FLINT's own type
  operator const fmpz*() const { return value_; }  // NOLINT(google-explicit-constructor)

 private:
  fmpz_t value_;
};

class Block {
 public:
  Block(std::size_t rows, std::size_t columns) {
    fmpz_mat_init(matrix_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  Block(Block&& other) noexcept {
    fmpz_mat_init(matrix_, 0, 0);
    fmpz_mat_swap(matrix_, other.matrix_);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  Block& operator=(Block&&) = delete;
  ~Block() { fmpz_mat_clear(matrix_); }
  operator fmpz_mat_struct*() { return matrix_; }              // NOLINT(google-explicit-constructor)
  operator const fmpz_mat_struct*() const { return matrix_; }  // NOLINT(google-explicit-constructor)
  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(fmpz_mat_nrows(matrix_)); }
  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(fmpz_mat_ncols(matrix_)); }
  [[nodiscard]] fmpz* at(std::size_t i, std::size_t j) {
    return fmpz_mat_entry(matrix_, static_cast<slong>(i), static_cast<slong>(j));
  }
  [[nodiscard]] const fmpz* at(std::size_t i, std::size_t j) const {
    return fmpz_mat_entry(matrix_, static_cast<slong>(i), static_cast<slong>(j));
  }

 private:
  fmpz_mat_t matrix_;
};

class ModularMatrix {
 public:
  ModularMatrix(const Block& block, ulong modulus) {
    nmod_mat_init(matrix_, static_cast<slong>(block.rows()), static_cast<slong>(block.columns()), modulus);
    fmpz_mat_get_nmod_mat(matrix_, block);
  }
  ModularMatrix(const ModularMatrix&) = delete;
  ModularMatrix& operator=(const ModularMatrix&) = delete;
  ~ModularMatrix() { nmod_mat_clear(matrix_); }
  operator nmod_mat_struct*() { return matrix_; }  // NOLINT(google-explicit-constructor)
  [[nodiscard]] ulong* row(std::size_t i) { return matrix_->rows[i]; }

 private:
  nmod_mat_t matrix_;
};

inline void set(fmpz* out, const Integer& value) {
  if (const auto word = value.to_int64()) {
    fmpz_set_si(out, *word);
  } else {
    fmpz_set_str(out, value.to_string().c_str(), 10);
  }
}

inline Integer to_integer(const fmpz* value) {
  if (fmpz_fits_si(value) != 0) {
    return std::int64_t{fmpz_get_si(value)};
  }
  std::string digits(fmpz_sizeinbase(value, 10) + 2, '\0');
  fmpz_get_str(digits.data(), 10, value);
  return *Integer::parse(digits.c_str());
}

}  // namespace sesame::sparse
