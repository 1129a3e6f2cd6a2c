#include "replay/tower/named_chains.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sesame::replay {

sparse::Rational smallest_residue(const sparse::Rational& n, std::uint32_t p) {
  if (p == 0) {
    return n;
  }
  const std::int64_t residue = n.numerator().modulo(p);
  return residue > p / 2 ? residue - p : residue;
}

std::string chain_line(const NamedChain& chain, std::uint64_t most_terms) {
  if (chain.terms.size() > most_terms) {
    return fmt::format("a chain of {} terms", chain.terms.size());
  }
  std::string text;
  for (const auto& [coefficient, name] : chain.terms) {
    const bool is_negative = coefficient < 0;
    text += text.empty() ? (is_negative ? "-" : "") : (is_negative ? " - " : " + ");
    const sparse::Rational size = sparse::abs(coefficient);
    if (size != 1) {
      text += size.to_string() + " ";
    }
    text += fmt::format("{{{}}}", fmt::join(name, " "));
  }
  return text.empty() ? "0" : text;
}

namespace {

void add_chain(TextBuffer& text, const NamedChain& chain) {
  text.add('[');
  bool is_first = true;
  for (const auto& [coefficient, name] : chain.terms) {
    const bool is_word = coefficient.to_int64().has_value();  // other numbers are strings, as everywhere in JSON
    text.add(is_first ? "[" : ",[").add(is_word ? "" : "\"").add(coefficient.to_string()).add(is_word ? ",[" : "\",[");
    is_first = false;
    for (std::size_t k = 0; k < name.size(); ++k) {
      text.add(k == 0 ? "" : ",").add_integer(name[k]);
    }
    text.add("]]");
  }
  text.add(']');
}

}  // namespace

void add_chain_member(TextBuffer& text, std::string_view name, const NamedChain& chain, std::uint64_t most_terms) {
  text.add(",\"").add(name);
  if (chain.terms.size() > most_terms) {
    text.add("_terms\":").add_integer(chain.terms.size());
  } else {
    text.add("\":");
    add_chain(text, chain);
  }
}

}  // namespace sesame::replay
