#include "replay/zigzag/zigzag_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

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

void ZigzagCycles::add(const engine::MomentBar& moments, const engine::ZigzagBarcode::Pieces& pieces) {
  const Bar bar{moments.dimension, moments.birth.time, moments.death.time};
  if (bar.birth == bar.death || !selection_.has(bar) || !wants(bar.dimension)) {
    return;
  }
  const std::vector<NamedPiece> named = history_.named(moments, pieces());
  said_.push_back({bar, form_ == Form::json ? json(bar, named) : table(bar, named)});
}

std::string ZigzagCycles::table(const Bar& bar, const std::vector<NamedPiece>& pieces) const {
  std::string text = fmt::format("H{} {}\n", bar.dimension, interval_text(bar));
  for (const NamedPiece& piece : pieces) {
    text += fmt::format("  {}  {}\n", interval_text({bar.dimension, piece.from, piece.until}),
                        chain_line(piece.cycle, options_.most_terms));
  }
  return text;
}

std::string ZigzagCycles::json(const Bar& bar, const std::vector<NamedPiece>& pieces) const {
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
