#include "replay/barcode/barcode_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "replay/barcode/betti_curves.hpp"
#include "replay/text/text_buffer.hpp"
#include "sesame/version.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;
using Json = nlohmann::json;

/// As JSON, with U+FFFD for what is not UTF-8: the name of a file may be anything.
std::string quoted(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

/// On one line, whatever the name.
std::string one_line(const std::string& text) {
  auto line = Json::parse(quoted(text)).get<std::string>();
  for (char& c : line) {
    if ((c >= '\0' && c < ' ') || c == '\x7f') {
      c = '?';
    }
  }
  return line;
}

std::string operation_counts(std::uint64_t operations, std::uint64_t hidden) {
  return fmt::format("{} operation{}, {} bar{} of length 0 left out", operations, operations == 1 ? "" : "s", hidden,
                     hidden == 1 ? "" : "s");
}

}  // namespace

std::string provenance_line(const Barcode& barcode, const Provenance& provenance) {
  return fmt::format("sesame {}, coefficients {}, {}{}{}", SESAME_VERSION, provenance.ring,
                     operation_counts(provenance.operations, barcode.hidden),
                     provenance.source.empty() ? "" : ", from ", one_line(provenance.source));
}

PersWriter::PersWriter(std::ostream& out, const std::string& ring, const std::string& source) : text_{out} {
  text_.add("# sesame " SESAME_VERSION ", coefficients ").add(ring);
  if (!source.empty()) {
    text_.add(", from ").add(one_line(source));
  }
  text_.add("\n");
}

void PersWriter::add(const Bar& bar) {
  text_.add_integer(bar.dimension).add(' ').add_number(bar.birth).add(' ').add_number(bar.death).add('\n');
}

void PersWriter::finish(std::uint64_t operations, std::uint64_t hidden) {
  text_.add("# ").add(operation_counts(operations, hidden)).add("\n");
  text_.flush();
}

void write_pers(std::ostream& out, const Barcode& barcode, const Provenance& provenance) {
  PersWriter writer(out, provenance.ring, provenance.source);
  for (const Bar& bar : barcode.bars) {
    writer.add(bar);
  }
  writer.finish(provenance.operations, barcode.hidden);
}

void add_barcode_fields(TextBuffer& text, const Barcode& barcode, const Provenance& provenance) {
  text.add(R"("ring":)").add(quoted(provenance.ring)).add(R"(,"ops":)").add_integer(provenance.operations);
  text.add(R"(,"bars":[)");
  bool is_first = true;
  for (const Bar& bar : barcode.bars) {
    text.add(is_first ? "[" : ",[").add_integer(bar.dimension).add(',').add_json_number(bar.birth).add(',');
    if (bar.death == engine::never) {
      text.add("null]");
    } else {
      text.add_json_number(bar.death).add(']');
    }
    is_first = false;
  }
  text.add(R"(],"hidden":)").add_integer(barcode.hidden).add(R"(,"source":)").add(quoted(provenance.source));
  add_reading_fields(text, provenance);
  text.add(R"(,"version":")" SESAME_VERSION "\"");
}

void add_reading_fields(TextBuffer& text, const Provenance& provenance) {
  if (!provenance.format.empty()) {
    text.add(R"(,"format":)").add(quoted(provenance.format));
  }
  if (provenance.added_faces > 0) {
    text.add(R"(,"added_faces":)").add_integer(provenance.added_faces);
  }
  if (provenance.already > 0) {
    text.add(R"(,"already":)").add_integer(provenance.already);
  }
  if (provenance.max_dimension) {
    text.add(R"(,"max_dim":)").add_integer(*provenance.max_dimension);
  }
}

void write_betti_csv(std::ostream& out, const Barcode& barcode) {
  TextBuffer text(out);
  text.add("time");
  for (std::size_t p = 0; p < dimensions(barcode); ++p) {
    text.add(",b").add_integer(p);
  }
  text.add('\n');
  for_each_betti_change(barcode, [&text](engine::Time time, std::span<const std::uint64_t> betti) {
    text.add_number(time);
    for (const std::uint64_t b : betti) {
      text.add(',').add_integer(b);
    }
    text.add('\n');
  });
}

}  // namespace sesame::replay
