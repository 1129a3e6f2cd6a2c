// The text form of replacements: one field says which move it is.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "ops/vocabulary/field_values.hpp"
#include "ops/vocabulary/operation_form.hpp"

namespace sesame::ops {
namespace {

Replace::Flip read_flip(Fields& in) {
  Replace::Flip flip{in.text("flip"), {}, {}};
  if (const Json* by = in.find("by")) {
    flip.by = read_label(in, "by", *by);
    if (flip.by.empty()) {
      in.wrong("by", "the name of what is new, or left out", *by);
    }
  }
  flip.at = read_point(in);
  return flip;
}

Replace::Subdivision read_subdivision(Fields& in) {
  Replace::Subdivision subdivision{in.text("subdivide"), read_label(in, "by", in.need("by")), {}};
  subdivision.at = read_point(in);
  return subdivision;
}

Replace::Contraction read_contraction(Fields& in) {
  constexpr std::string_view expected = "a list of two labels, such as [\"a\",\"b\"]: the first becomes the second";
  const Json& value = in.need("contract");
  const auto labels = read_each(in.items("contract", value, expected),
                                [&](const Json& item) { return read_label(in, "contract", item); });
  if (labels.size() != 2) {
    in.wrong("contract", expected, value);
  }
  Replace::Contraction contraction{labels[0], labels[1]};
  if (const Json* link_condition = in.find("link_condition")) {
    contraction.link_condition = in.truth("link_condition", *link_condition);
  }
  return contraction;
}

Replace read_replace(Fields& in) {
  const std::array<bool, 3> has{in.find("flip") != nullptr, in.find("subdivide") != nullptr,
                                in.find("contract") != nullptr};
  if (std::count(has.begin(), has.end(), true) != 1) {
    throw Wrong{R"("replace" needs a field "flip", "subdivide" or "contract", one of the three)"};
  }
  if (has[2]) {
    return {read_contraction(in)};
  }
  Replace op;
  if (has[0]) {
    op.move = read_flip(in);
  } else {
    op.move = read_subdivision(in);
  }
  if (const Json* fills = in.find("fills")) {
    op.fills = in.truth("fills", *fills);
  }
  return op;
}

class MoveWriter {
 public:
  explicit MoveWriter(JsonText& out) : out_{out} {}

  void operator()(const Replace::Flip& flip) {
    out_.field("flip", flip.cell);
    write_new(flip.by, flip.at);
  }
  void operator()(const Replace::Subdivision& subdivision) {
    out_.field("subdivide", subdivision.cell);
    write_new(subdivision.by, subdivision.at);
  }
  void operator()(const Replace::Contraction& contraction) {
    out_.key("contract");
    out_.begin_list();
    write_label(contraction.from, out_);
    write_label(contraction.to, out_);
    out_.end_list();
    if (!contraction.link_condition) {
      out_.field("link_condition", false);
    }
  }

 private:
  void write_new(const std::string& by, const std::optional<Point>& at) {
    if (!by.empty()) {
      out_.key("by");
      write_label(by, out_);
    }
    if (at) {
      out_.field("at", *at);
    }
  }

  JsonText& out_;
};

void write_replace(const Replace& op, JsonText& out) {
  std::visit(MoveWriter(out), op.move);
  if (op.fills) {
    out.field("fills", true);
  }
}

}  // namespace

constinit const Form<Replace> replace_form{"replace", read_replace, write_replace};

}  // namespace sesame::ops
