// Scripts and logs: whatever a text says, it is read in one way or refused with a sentence, and the engine takes what
// was read or refuses it with a sentence.
#include "replay/script/script.hpp"

#include <memory>
#include <vector>

#include "tests/fuzz/engines.hpp"
#include "tests/support/piece_input.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t longest = 4096;

/// What a reader makes of a text: a line for each step, binding and error.
struct Reading {
  std::string text;
  std::optional<ops::Header> header;
  std::vector<ops::Operation> operations;
};

Reading read(replay::ByteSource source) {
  replay::ScriptReader reader(std::move(source), longest);
  Reading reading;
  const Result<ops::Header> header = reader.header();
  if (!went_well(header)) {
    reading.text = header.error().what;
    return reading;
  }
  reading.header = *header;
  reading.text = ops::to_text(*header) + "\n";
  while (true) {
    Result<std::optional<ops::Operation>> next = reader.next();
    if (const auto binding = reader.binding()) {
      reading.text += "bound after " + std::to_string(binding->steps) + "\n";
    }
    if (!went_well(next)) {
      reading.text += next.error().what + "\n";
      if (reader.is_broken()) {
        return reading;
      }
      continue;
    }
    if (!*next) {
      return reading;
    }
    reading.text += ops::to_text(**next) + "\n";
    reading.operations.push_back(std::move(**next));
  }
}

/// The same bytes, a few at a time.
Reading read_in_pieces(std::string_view text) {
  std::vector<std::string> pieces;
  for (std::size_t at = 0; at < text.size(); at += 5) {
    pieces.emplace_back(text.substr(at, 5));
  }
  Result<replay::ByteSource> source =
      replay::ByteSource::from(std::make_unique<PieceInput>(std::move(pieces), End::whole), "script");
  if (!went_well(source)) {
    return {source.error().what, {}, {}};
  }
  return read(std::move(*source));
}

/// Canonical text is read back as it is, by both readers.
void demand_round_trip(const ops::Operation& operation) {
  const std::string text = ops::to_text(operation);
  const Result<ops::Operation> again = ops::parse_operation(text);
  demand(went_well(again), "canonical text is read: " + text);
  demand_equal(ops::to_text(*again), text, "canonical text is read back as it is");
  ops::OperationReader reader;
  if (const auto common = reader.read_common(text)) {
    demand_equal(ops::to_text(*common), text, "the quick reader reads what the other one does");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  const Reading reading = read(replay::ByteSource::of_text(text, "script"));
  if (!text.starts_with("\x1F\x8B")) {  // a text in memory is never unpacked
    demand_equal(read_in_pieces(text).text, reading.text, "pieces say what the whole does");
  }
  if (!reading.header) {
    return 0;
  }
  const std::string header = ops::to_text(*reading.header);
  const Result<ops::Header> same = ops::parse_header(header);
  demand(went_well(same) && ops::to_text(*same) == header, "a canonical header is read back as it is");
  const Result<sparse::AnyRing> ring = sparse::parse_ring(reading.header->ring);
  if (!went_well(ring)) {
    return 0;
  }
  Engine engine(*ring, small_limits, {}, {}, few_cells);
  for (const ops::Operation& operation : reading.operations) {
    demand_round_trip(operation);
    attempt(engine, operation);
  }
  if (number_of_cells(engine) <= 120) {
    demand_laws(engine);
  }
  return 0;
}
