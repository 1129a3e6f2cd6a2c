// The text form of what changes no cell by itself: questions, undo, notes, and the header of a log.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

std::vector<Integer> read_integers(Fields& in, const std::string& field, const Json& value) {
  return read_each(in.items(field, value, "a list of integers"), [&](const Json& n) { return in.integer(field, n); });
}

Expect read_expect(Fields& in) {
  Expect op;
  if (const Json* betti = in.find("betti")) {
    op.betti = read_integers(in, "betti", *betti);
  }
  if (const Json* torsion = in.find("torsion")) {
    op.torsion = read_each(in.items("torsion", *torsion, "a list of lists of integers"),
                           [&](const Json& factors) { return read_integers(in, "torsion", factors); });
  }
  if (const Json* euler = in.find("euler")) {
    op.euler = in.integer("euler", *euler);
  }
  if (const Json* cells = in.find("cells")) {
    op.cells = read_integers(in, "cells", *cells);
  }
  return op;
}

void write_expect(const Expect& op, JsonText& out) {
  const auto write = [&](std::string_view field, const auto& expected) {
    if (expected) {
      out.field(field, *expected);
    }
  };
  write("betti", op.betti);
  write("torsion", op.torsion);
  write("euler", op.euler);
  write("cells", op.cells);
}

AskClass read_class(Fields& in) {
  AskClass op;
  constexpr std::string_view expected = "a list of terms, [[coefficient,\"cell\"],...]";
  op.chain = read_each(in.items("chain", in.need("chain"), expected), [&](const Json& term) {
    if (!term.is_array() || term.size() != 2) {
      in.wrong("chain", expected, term);
    }
    return std::pair{in.integer("chain", term[0]), in.text("chain", term[1])};
  });
  return op;
}

void write_class(const AskClass& op, JsonText& out) {
  out.key("chain");
  out.begin_list();
  for (const auto& [coefficient, cell] : op.chain) {
    out.list_of(coefficient, cell);
  }
  out.end_list();
}

Undo read_undo(Fields& in) {
  Undo op;
  if (const Json* steps = in.find("steps")) {
    const Integer n = in.integer("steps", *steps);
    const auto word = n.to_int64();
    if (!word || *word < 1) {
      throw Wrong{fmt::format("field \"steps\" of an undo should be a positive integer, but is {}", n.to_string())};
    }
    op.steps = static_cast<std::uint64_t>(*word);
  }
  return op;
}

void write_undo(const Undo& op, JsonText& out) { out.field("steps", op.steps); }

Note read_note(Fields& in) { return {in.text("text")}; }

void write_note(const Note& op, JsonText& out) { out.field("text", op.text); }

}  // namespace

constinit const Form<Expect> expect_form{"expect", read_expect, write_expect};
constinit const Form<AskClass> class_form{"class", read_class, write_class};
constinit const Form<Undo> undo_form{"undo", read_undo, write_undo};
constinit const Form<Note> note_form{"note", read_note, write_note};

Header read_header(const Json& object) {
  Fields in(object, "the header");
  const Json* version = in.find("sesame");
  if (version == nullptr) {
    throw Wrong{"the first object should be the header, such as {\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus\"}"};
  }
  Header header;
  if (!version->is_number_integer() || *version != 1) {
    throw Wrong{fmt::format("this program reads version 1 of the format, but the header says {}",
                            version->is_number() ? version->dump() : std::string{json_kind(*version)})};
  }
  if (const Json* ring = in.find("ring")) {
    header.ring = in.text("ring", *ring);
  }
  if (const Json* title = in.find("title")) {
    header.title = in.text("title", *title);
  }
  in.finish();
  return header;
}

void write_header(const Header& header, JsonText& out) {
  out.field("sesame", header.version);
  out.field("ring", header.ring);
  out.field("title", header.title);
}

}  // namespace sesame::ops
