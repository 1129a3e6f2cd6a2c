/// \file
/// What is written to a standard stream.
#pragma once

#include <ostream>
#include <sstream>
#include <string>

namespace sesame::tests {

/// Sends a stream into a string while it lives.
class Captured {
 public:
  explicit Captured(std::ostream& stream) : stream_{stream}, before_{stream.rdbuf(text_.rdbuf())} {}
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  ~Captured() { stream_.rdbuf(before_); }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostream& stream_;
  std::streambuf* before_;
};

}  // namespace sesame::tests
