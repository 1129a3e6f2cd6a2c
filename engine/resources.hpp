/// \file
/// What a session may take of the machine, and what there is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sesame::engine {

/// Beyond these a step is refused (Errc::limit), and nothing of it happens.
struct Resources {
  std::uint64_t most_cells = UINT64_MAX;  ///< of the object
  std::uint64_t most_bytes = UINT64_MAX;  ///< of memory that the process has in use
};

/// Tells whether a step fits before it is taken.
class ResourceCheck {
 public:
  explicit ResourceCheck(const Resources& resources) : resources_{resources} {}

  /// `cells`: that the object would have. `bytes`: about as many as the step would take, at least; when they are few,
  /// how much is in use is looked up now and then only, as steps come. Nothing when the step fits; or what it would do
  /// and may not, as the end of a sentence.
  std::optional<std::string> objection(std::uint64_t cells, std::uint64_t bytes);

 private:
  Resources resources_;
  std::uint64_t in_use_ = 0;      ///< when that was looked up last
  std::uint64_t since_then_ = 0;  ///< reckoned, with something for steps that seem to take nothing
};

/// The memory that the process has in use, in bytes; 0 when the system does not tell.
[[nodiscard]] std::uint64_t memory_in_use();
/// How much more it could have: by what the machine has, and by the limit on its address space (`ulimit -v`).
[[nodiscard]] std::uint64_t memory_available();
/// "300 GB", "1.5 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

}  // namespace sesame::engine
