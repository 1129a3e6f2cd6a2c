/// \file
/// An input that comes in pieces.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "replay/text/byte_input.hpp"
#include "sparse/result.hpp"

namespace sesame::tests {

/// How an input ends.
enum class End { whole, stopped, failed };

/// Yields the pieces one by one, and then ends as it should.
class PieceInput final : public replay::ByteInput {
 public:
  PieceInput(std::vector<std::string> pieces, End end) : pieces_{std::move(pieces)}, end_{end} {}

  Result<std::size_t> read(std::span<char> to) override {
    while (next_ < pieces_.size() && pieces_[next_].empty()) {
      ++next_;
    }
    if (next_ == pieces_.size()) {
      if (end_ == End::failed) {
        return Error{Errc::io, "cannot read the input: it broke"};
      }
      return std::size_t{0};
    }
    std::string& piece = pieces_[next_];
    const std::size_t size = std::min(piece.size(), to.size());
    std::memcpy(to.data(), piece.data(), size);
    piece.erase(0, size);
    return size;
  }
  [[nodiscard]] bool is_stopped() const override { return end_ == End::stopped && next_ == pieces_.size(); }

 private:
  std::vector<std::string> pieces_;
  End end_;
  std::size_t next_ = 0;
};

}  // namespace sesame::tests
