/// \file
/// `Result<T>`: a value, or an error that the caller may well meet. Member names follow std::expected (C++23).
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace sesame {

/// What kind of thing went wrong; the program turns it into an exit status.
enum class Errc {
  bad_input,      ///< text or data that does not say something legal
  unknown_name,   ///< a name that denotes nothing
  refused,        ///< a legal request that cannot be carried out in the present state
  not_nilpotent,  ///< a perturbation series that does not stop
  not_a_unit,     ///< a coefficient that has no inverse in the ring
  law_broken,     ///< an algebraic identity that should hold does not
  expectation,    ///< a stated expectation differs from the state
  io,             ///< the outside world: files, streams
  limit,          ///< it would take more memory, cells or time than there is, or than was allowed
};

/// An error: its kind, and one sentence that says where, what, and what would be right.
struct Error {
  Errc code;
  std::string what;
};

/// A value or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_{std::in_place_index<0>, std::move(value)} {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_{std::in_place_index<1>, std::move(error)} {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// Each throws std::bad_variant_access when the other alternative is held.
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T& value() & { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  [[nodiscard]] const Error& error() const& { return std::get<1>(state_); }
  [[nodiscard]] Error&& error() && { return std::get<1>(std::move(state_)); }

  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

 private:
  std::variant<T, Error> state_;
};

/// The value of a Result that carries none: success, or an Error.
struct Done {};
using Status = Result<Done>;

}  // namespace sesame
