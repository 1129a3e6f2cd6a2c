/// \file
/// Short linear fingerprints of long vectors.
#pragma once

#include <array>
#include <cstdint>

#include "sparse/chain.hpp"
#include "sparse/ring.hpp"

namespace sesame::tools {

/// Equal vectors have equal fingerprints, and sums of vectors the sums of their fingerprints; two vectors that differ
/// have the same one by chance only (2^-248 over Z, 2^-256 over Z/2, p^-8 over Z/p).
struct Fingerprint {
  std::array<std::uint32_t, 8> lanes{};
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  friend bool operator<(const Fingerprint& a, const Fingerprint& b) { return a.lanes < b.lanes; }
};

struct FingerprintHash {
  std::size_t operator()(const Fingerprint& f) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t lane : f.lanes) {
      hash = hash * 0x9e3779b97f4a7c15U + lane;
    }
    return static_cast<std::size_t>(hash ^ (hash >> 32U));
  }
};

/// Each lane is a fixed pseudo-random linear form: over Z modulo 2^31, over Z/p modulo p, over Z/2 32 forms at once.
class Fingerprinter {
 public:
  explicit Fingerprinter(const sparse::AnyRing& ring)
      : characteristic_{std::visit([](const auto& r) { return r.characteristic(); }, ring)},
        modulus_{characteristic_ == 0 ? std::uint32_t{1} << 31U : characteristic_} {}

  [[nodiscard]] Fingerprint of(const sparse::Terms<sparse::Integers>& vector) const {
    Fingerprint sum;
    for (const auto& [index, coefficient] : vector) {
      const std::uint64_t factor = coefficient.modulo(modulus_);
      for (std::uint32_t lane = 0; lane < sum.lanes.size(); ++lane) {
        const std::uint32_t random = scrambled(std::uint64_t{index} * sum.lanes.size() + lane);
        if (characteristic_ == 2) {
          sum.lanes[lane] ^= factor != 0 ? random : 0;
        } else {
          sum.lanes[lane] = static_cast<std::uint32_t>((sum.lanes[lane] + factor * (random % modulus_)) % modulus_);
        }
      }
    }
    return sum;
  }

  void add(Fingerprint& to, const Fingerprint& by) const {
    for (std::size_t lane = 0; lane < to.lanes.size(); ++lane) {
      std::uint32_t& value = to.lanes[lane];
      if (characteristic_ == 2) {
        value ^= by.lanes[lane];
      } else {
        value += by.lanes[lane];  // below 2^32: both are below 2^31
        if (value >= modulus_) {
          value -= modulus_;
        }
      }
    }
  }

  void subtract(Fingerprint& from, const Fingerprint& by) const {
    for (std::size_t lane = 0; lane < from.lanes.size(); ++lane) {
      std::uint32_t& value = from.lanes[lane];
      if (characteristic_ == 2) {
        value ^= by.lanes[lane];
      } else {
        value = value >= by.lanes[lane] ? value - by.lanes[lane] : value + (modulus_ - by.lanes[lane]);
      }
    }
  }

 private:
  /// Source: S. Vigna's splitmix64.
  static std::uint32_t scrambled(std::uint64_t n) {
    n = (n + 1) * 0x9e3779b97f4a7c15U;
    n = (n ^ (n >> 30U)) * 0xbf58476d1ce4e5b9U;
    n = (n ^ (n >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<std::uint32_t>((n ^ (n >> 31U)) >> 32U);
  }

  std::uint32_t characteristic_;
  std::uint32_t modulus_;
};

}  // namespace sesame::tools
