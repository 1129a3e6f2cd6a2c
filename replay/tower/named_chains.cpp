#include "replay/tower/named_chains.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ops/vocabulary/json_text.hpp"

namespace sesame::replay {

sparse::Rational smallest_residue(const sparse::Rational& n, std::uint32_t p) {
  if (p == 0) {
    return n;
  }
  const std::int64_t residue = n.numerator().modulo(p);
  return residue > p / 2 ? residue - p : residue;
}

namespace {

using Labels = std::vector<ops::Label>;

std::string line_name(const Labels& labels) { return fmt::format("{{{}}}", fmt::join(labels, " ")); }
const std::string& line_name(const std::string& name) { return name; }

std::string json_name(const Labels& labels) { return fmt::format("[{}]", fmt::join(labels, ",")); }
std::string json_name(const std::string& name) {
  std::string text;
  ops::JsonText(text).value(name);
  return text;
}

template <class Chain>
std::string line_of(const Chain& chain, std::uint64_t most_terms) {
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
    text += line_name(name);
  }
  return text.empty() ? "0" : text;
}

template <class Chain>
void add_member(TextBuffer& text, std::string_view name, const Chain& chain, std::uint64_t most_terms) {
  text.add(",\"").add(name);
  if (chain.terms.size() > most_terms) {
    text.add("_terms\":").add_integer(chain.terms.size());
    return;
  }
  text.add("\":[");
  bool is_first = true;
  for (const auto& [coefficient, generator] : chain.terms) {
    const bool is_word = coefficient.to_int64().has_value();  // other numbers are strings, as everywhere in JSON
    text.add(is_first ? "[" : ",[").add(is_word ? "" : "\"").add(coefficient.to_string()).add(is_word ? "," : "\",");
    text.add(json_name(generator)).add(']');
    is_first = false;
  }
  text.add(']');
}

}  // namespace

std::string chain_line(const NamedChain& chain, std::uint64_t most_terms) { return line_of(chain, most_terms); }
std::string chain_line(const engine::NameChain& chain, std::uint64_t most_terms) { return line_of(chain, most_terms); }

void add_chain_member(TextBuffer& text, std::string_view name, const NamedChain& chain, std::uint64_t most_terms) {
  add_member(text, name, chain, most_terms);
}
void add_chain_member(TextBuffer& text, std::string_view name, const engine::NameChain& chain,
                      std::uint64_t most_terms) {
  add_member(text, name, chain, most_terms);
}

}  // namespace sesame::replay
