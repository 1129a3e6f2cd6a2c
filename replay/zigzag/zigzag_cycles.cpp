#include "replay/zigzag/zigzag_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace sesame::replay {

using engine::Bar;
using engine::never;

namespace {

void add_end(TextBuffer& text, engine::Time time) {
  if (time == never) {
    text.add("null");
  } else {
    text.add_json_number(time);
  }
}

}  // namespace

std::vector<ScriptPiece> pieces_of(const Bar& bar, std::vector<engine::NamedCycle> cycles,
                                   std::uint32_t characteristic) {
  std::vector<ScriptPiece> pieces;
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    for (auto& term : cycles[k].cycle.terms) {
      term.coefficient = smallest_residue(term.coefficient, characteristic);
    }
    const engine::Time until = k + 1 < cycles.size() ? cycles[k + 1].from : bar.death;
    pieces.push_back({cycles[k].from, until, std::move(cycles[k].cycle)});
  }
  return pieces;
}

template <class Chain>
void ZigzagCycles::add(const Bar& bar, const std::vector<PieceOf<Chain>>& pieces) {
  said_.push_back({bar, form_ == Form::json ? json(bar, pieces) : table(bar, pieces)});
}

template void ZigzagCycles::add(const Bar&, const std::vector<NamedPiece>&);
template void ZigzagCycles::add(const Bar&, const std::vector<ScriptPiece>&);

template <class Chain>
std::string ZigzagCycles::table(const Bar& bar, const std::vector<PieceOf<Chain>>& pieces) const {
  std::string text = fmt::format("H{} {}\n", bar.dimension, interval_text(bar));
  for (const PieceOf<Chain>& piece : pieces) {
    text += fmt::format("  {}  {}\n", interval_text({bar.dimension, piece.from, piece.until}),
                        chain_line(piece.cycle, options_.most_terms));
  }
  return text;
}

template <class Chain>
std::string ZigzagCycles::json(const Bar& bar, const std::vector<PieceOf<Chain>>& pieces) const {
  std::ostringstream out;
  {
    TextBuffer text(out);
    text.add(R"({"dim":)").add_integer(bar.dimension).add(R"(,"birth":)").add_json_number(bar.birth);
    text.add(R"(,"death":)");
    add_end(text, bar.death);
    text.add(R"(,"pieces":[)");
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      text.add(k == 0 ? R"({"from":)" : R"(,{"from":)").add_json_number(pieces[k].from).add(R"(,"until":)");
      add_end(text, pieces[k].until);
      add_chain_member(text, "cycle", pieces[k].cycle, options_.most_terms);
      text.add('}');
    }
    text.add("]}");
  }
  return std::move(out).str();
}

std::vector<const ZigzagCycles::Said*> ZigzagCycles::sorted() const {
  std::vector<const Said*> found;
  for (const Said& each : said_) {
    found.push_back(&each);
  }
  std::ranges::stable_sort(found, {}, [](const Said* each) { return each->bar; });
  return found;
}

void ZigzagCycles::write_table(std::ostream& out) const {
  for (const Said* each : sorted()) {
    out << each->text;
  }
}

void ZigzagCycles::add_json(TextBuffer& text) const {
  text.add('[');
  bool is_first = true;
  for (const Said* each : sorted()) {
    text.add(is_first ? "" : ",").add(each->text);
    is_first = false;
  }
  text.add(']');
}

}  // namespace sesame::replay
