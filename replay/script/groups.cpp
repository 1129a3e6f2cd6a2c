#include "replay/script/groups.hpp"

#include <fmt/format.h>

#include <limits>

#include "reductions/group.hpp"

namespace sesame::replay {

std::vector<std::string> group_names(const engine::Homology& homology, const sparse::AnyRing& ring) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    names.push_back(
        reductions::AbelianGroup{static_cast<sparse::Index>(homology.betti[p]), homology.torsion[p]}.to_string(
            sparse::ring_name(ring)));
  }
  return names;
}

std::string homology_line(const engine::Homology& homology, const sparse::AnyRing& ring) {
  std::string line;
  int p = 0;
  for (const std::string& name : group_names(homology, ring)) {
    line += fmt::format("{}H{} = {}", p == 0 ? "" : ", ", p, name);
    ++p;
  }
  return line.empty() ? "nothing yet" : line;
}

std::string chain_text(const engine::CellChain& chain, const ops::Structure& structure) {
  return chain_text(chain, structure, std::numeric_limits<std::size_t>::max());
}

std::string chain_text(const engine::CellChain& chain, const ops::Structure& structure, std::size_t most) {
  if (chain.terms.empty()) {
    return "0";
  }
  std::string text;
  std::size_t written = 0;
  for (const auto& [coefficient, cell] : chain.terms) {
    if (written++ == most) {
      return text + fmt::format(" + ... ({} terms in all)", chain.terms.size());
    }
    const bool is_negative = coefficient.sign() < 0;
    const sparse::Rational size = sparse::abs(coefficient);
    text += text.empty() ? (is_negative ? "-" : "") : (is_negative ? " - " : " + ");
    text += fmt::format("{}{}", size == 1 ? "" : size.to_string() + " ", structure.name(cell));
  }
  return text;
}

}  // namespace sesame::replay
