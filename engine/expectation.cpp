#include "engine/expectation.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sesame::engine {
namespace {

std::string to_text(const std::vector<Integer>& numbers) {
  std::string text = "[";
  for (const Integer& n : numbers) {
    text += (text.size() > 1 ? "," : "") + n.to_string();
  }
  return text + "]";
}

std::string to_text(const std::vector<std::vector<Integer>>& lists) {
  std::string text = "[";
  for (const auto& list : lists) {
    text += (text.size() > 1 ? "," : "") + to_text(list);
  }
  return text + "]";
}

std::string to_text(const Integer& n) { return n.to_string(); }

bool is_void(const Integer& n) { return n.is_zero(); }
bool is_void(const std::vector<Integer>& list) { return list.empty(); }

/// Without trailing zeros or empty lists: they may be left out of an expectation.
template <class T>
std::vector<T> trimmed(std::vector<T> list) {
  while (!list.empty() && is_void(list.back())) {
    list.pop_back();
  }
  return list;
}
Integer trimmed(const Integer& n) { return n; }

/// Adds "betti should be [1,2,1] but is [1,1]" to `differences` when the two differ.
template <class T>
void compare(const char* what, const std::optional<T>& expected, const T& found, std::string& differences) {
  if (expected && trimmed(*expected) != trimmed(found)) {
    differences += std::string{differences.empty() ? "" : "; "} + what + " should be " + to_text(*expected) +
                   " but is " + to_text(found);
  }
}

template <class From>
std::vector<Integer> integers(const From& numbers) {
  std::vector<Integer> out;
  for (const auto n : numbers) {
    out.emplace_back(static_cast<std::int64_t>(n));
  }
  return out;
}

}  // namespace

Status check_expectation(const ops::Expect& expected, std::span<const std::uint64_t> cells, std::int64_t euler,
                         const std::function<Homology()>& homology) {
  std::string differences;
  compare("cells", expected.cells, integers(cells), differences);
  compare("euler", expected.euler, Integer{euler}, differences);
  if (expected.betti || expected.torsion) {
    const Homology found = homology();
    compare("betti", expected.betti, integers(found.betti), differences);
    compare("torsion", expected.torsion, found.torsion, differences);
  }
  if (!differences.empty()) {
    return Error{Errc::expectation, differences};
  }
  return Done{};
}

}  // namespace sesame::engine
