#include "engine/towers/time.hpp"

#include <limits>

#include "engine/towers/time_list.hpp"

namespace sesame::engine {
namespace {

/// Holds the differences of all 64-bit numbers, signed or not.
__extension__ using Wide = __int128;

Wide wide(Time t) { return t.nearest() < 0 ? Wide{static_cast<std::int64_t>(t.modulo_2_64())} : Wide{t.modulo_2_64()}; }

Time narrow(Wide x) {
  if (x >= std::numeric_limits<std::int64_t>::min() && x <= std::numeric_limits<std::int64_t>::max()) {
    return Time{static_cast<std::int64_t>(x)};
  }
  if (x > 0 && x <= std::numeric_limits<std::uint64_t>::max()) {
    return Time{static_cast<std::uint64_t>(x)};
  }
  return Time{static_cast<double>(x)};
}

}  // namespace

Time Time::exact_difference(Time a, Time b) {
  if (a.is_whole() && b.is_whole()) {
    return narrow(wide(a) - wide(b));
  }
  return Time{(a.nearest_ - b.nearest_) + (a.rest_ - b.rest_)};
}

Time Time::half() const {
  return is_large_ && modulo_2_64() % 2 == 0 ? narrow(wide(*this) / 2) : Time{nearest_ / 2 + rest_ / 2.0};
}

void TimeList::push_back_exact(Time time) {
  if (are_doubles_) {
    exact_.assign(doubles_.begin(), doubles_.end());
    doubles_ = {};
    are_doubles_ = false;
  }
  exact_.push_back(time);
}

}  // namespace sesame::engine
