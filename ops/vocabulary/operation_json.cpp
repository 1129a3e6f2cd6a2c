// The text form of operations. Every field is checked by name and by kind; what is not known is an error that names it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {
namespace {

using Json = nlohmann::ordered_json;

/// Thrown inside this file only: ends the reading of one line with a sentence.
struct Wrong {
  std::string what;
};

std::string_view kind(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return "a truth value";
    case Json::value_t::string:
      return "a string";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::number_float:
      return "a number with a fraction or too large for 64 bits";
    default:
      return "a number";
  }
}

/// Reads the fields of one object and remembers which were asked for; what is left over is unknown.
class Fields {
 public:
  Fields(const Json& object, std::string what) : object_{object}, what_{std::move(what)} {}

  [[nodiscard]] const Json* find(const std::string& field) {
    known_.insert(field);
    const auto at = object_.find(field);
    return at == object_.end() ? nullptr : &*at;
  }
  const Json& need(const std::string& field) {
    const Json* value = find(field);
    if (value == nullptr) {
      throw Wrong{fmt::format("{} needs a field \"{}\"", what_, field)};
    }
    return *value;
  }
  void finish() const {
    for (const auto& [key, value] : object_.items()) {
      if (!known_.contains(key)) {
        std::string known;
        for (const std::string& field : known_) {
          known += (known.empty() ? "" : ", ") + field;
        }
        throw Wrong{fmt::format("{} has an unknown field \"{}\"; its fields are: {}", what_, key, known)};
      }
    }
  }
  [[noreturn]] void wrong(const std::string& field, std::string_view expected, const Json& value) const {
    throw Wrong{fmt::format("field \"{}\" of {} should be {}, but is {}", field, what_, expected, kind(value))};
  }

 private:
  const Json& object_;
  std::string what_;
  std::set<std::string> known_;
};

std::string text(Fields& in, const std::string& field, const Json& value) {
  if (!value.is_string()) {
    in.wrong(field, "a string", value);
  }
  return value.get<std::string>();
}

constexpr std::uint64_t largest_word = std::numeric_limits<std::int64_t>::max();

bool truth(Fields& in, const std::string& field, const Json& value) {
  if (!value.is_boolean()) {
    in.wrong(field, "true or false", value);
  }
  return value.get<bool>();
}

/// Integers beyond 64 bits are written as strings of digits.
Integer integer(Fields& in, const std::string& field, const Json& value) {
  if (value.is_number_integer()) {
    const bool is_beyond_words = value.is_number_unsigned() && value.get<std::uint64_t>() > largest_word;
    return is_beyond_words ? *Integer::parse(std::to_string(value.get<std::uint64_t>())) : value.get<std::int64_t>();
  }
  if (value.is_string()) {
    if (auto parsed = Integer::parse(value.get<std::string>())) {
      return *parsed;
    }
    throw Wrong{fmt::format("field \"{}\": \"{}\" is not an integer", field, value.get<std::string>())};
  }
  in.wrong(field, "an integer (beyond 64 bits: a string of digits)", value);
}

int small(Fields& in, const std::string& field, const Json& value, int least) {
  const Integer n = integer(in, field, value);
  const auto word = n.to_int64();
  if (!word || *word < least || *word > 1'000'000) {
    throw Wrong{fmt::format("field \"{}\" should be an integer from {} on that is no dimension out of reach, but is {}",
                            field, least, n.to_string())};
  }
  return static_cast<int>(*word);
}

template <class Read>
auto list(Fields& in, const std::string& field, const Json& value, std::string_view expected, Read read) {
  if (!value.is_array()) {
    in.wrong(field, expected, value);
  }
  std::vector<decltype(read(value))> items;
  items.reserve(value.size());
  for (const Json& item : value) {
    items.push_back(read(item));
  }
  return items;
}

Point point(Fields& in, const Json& value) {
  if (!value.is_array() || value.size() < 2 || value.size() > 3) {
    in.wrong("at", "a point, [x,y] or [x,y,z]", value);
  }
  Point p{};
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (!value[k].is_number()) {
      in.wrong("at", "a point of numbers", value[k]);
    }
    p.at(k) = value[k].get<double>();
  }
  return p;
}

std::vector<Point> points(Fields& in, std::size_t vertices) {
  const Json* at = in.find("at");
  if (at == nullptr) {
    return {};
  }
  auto all = list(in, "at", *at, "a list of points", [&](const Json& p) { return point(in, p); });
  if (all.size() != vertices) {
    throw Wrong{fmt::format("field \"at\" should have {} points, one per vertex, but has {}", vertices, all.size())};
  }
  return all;
}

CellType cell_type(Fields& in, const Json& value) {
  return list(in, "type", value, "a list of dimensions >= 1, such as [2,1]",
              [&](const Json& a) { return small(in, "type", a, 1); });
}

std::vector<std::string> texts(Fields& in, const std::string& field, const Json& value, std::string_view expected) {
  return list(in, field, value, expected, [&](const Json& item) { return text(in, field, item); });
}

Operation read_simplex(Fields& in) {
  MakeSimplex op;
  op.name = text(in, "name", in.need("name"));
  op.dimension = small(in, "dim", in.need("dim"), 0);
  op.at = points(in, static_cast<std::size_t>(op.dimension) + 1);
  return op;
}

Operation read_simploid(Fields& in) {
  MakeSimploid op;
  op.name = text(in, "name", in.need("name"));
  op.type = cell_type(in, in.need("type"));
  std::size_t vertices = 1;
  for (const int a : op.type) {
    if (__builtin_mul_overflow(vertices, static_cast<std::size_t>(a) + 1, &vertices)) {
      vertices = std::numeric_limits<std::size_t>::max();
      break;
    }
  }
  op.at = points(in, vertices);
  return op;
}

MakeComplex::Cell read_cell(const Json& value) {
  if (!value.is_object()) {
    throw Wrong{fmt::format("field \"cells\" should be a list of objects with an \"id\", but holds {}", kind(value))};
  }
  Fields in(value, "a cell of a complex");
  MakeComplex::Cell cell;
  cell.id = text(in, "id", in.need("id"));
  if (const Json* type = in.find("type")) {
    cell.type = cell_type(in, *type);
  }
  if (const Json* faces = in.find("faces")) {
    cell.faces = texts(in, "faces", *faces, "a list of cell ids");
  }
  if (const Json* at = in.find("at")) {
    if (!cell.faces.empty()) {
      throw Wrong{fmt::format("cell \"{}\" has a position \"at\", but only vertices have one", cell.id)};
    }
    cell.at = point(in, *at);
  }
  in.finish();
  return cell;
}

Operation read_complex(Fields& in) {
  MakeComplex op;
  op.name = text(in, "name", in.need("name"));
  op.cells = list(in, "cells", in.need("cells"), "a list of cells", read_cell);
  return op;
}

ConeBase cone_base(Fields& in) {
  const Json* over = in.find("over");
  if (over == nullptr) {
    return {};
  }
  if (over->is_string()) {
    return over->get<std::string>();
  }
  return texts(in, "over", *over, "the name of a body or a list of cells");
}

Operation read_cone(Fields& in) {
  MakeCone op;
  op.apex = text(in, "apex", in.need("apex"));
  op.over = cone_base(in);
  if (const Json* at = in.find("at")) {
    op.at = point(in, *at);
  }
  return op;
}

Operation read_suspension(Fields& in) {
  MakeSuspension op;
  constexpr std::string_view expected = "a list of two names, such as [\"n\",\"s\"]";
  const Json& apexes = in.need("apexes");
  const std::vector<std::string> names = texts(in, "apexes", apexes, expected);
  if (names.size() != op.apexes.size()) {
    throw Wrong{fmt::format("field \"apexes\" of a suspension should be {}, but lists {}", expected, names.size())};
  }
  std::copy(names.begin(), names.end(), op.apexes.begin());
  op.over = cone_base(in);
  op.at = points(in, op.apexes.size());
  return op;
}

/// [2,0,1] for a simplex, a list of such lists for a simploid: one for each component.
Identify::Map vertex_map(Fields& in, const Json& value) {
  constexpr std::string_view expected = "a vertex map, such as [2,0,1], or [[1,0],[0,1]] for a simploid";
  const auto component = [&](const Json& entries) {
    return list(in, "pairs", entries, expected, [&](const Json& n) { return small(in, "pairs", n, 0); });
  };
  if (!value.is_array() || value.empty()) {
    in.wrong("pairs", expected, value);
  }
  return value[0].is_array() ? list(in, "pairs", value, expected, component) : Identify::Map{component(value)};
}

Operation read_identify(Fields& in) {
  Identify op;
  constexpr std::string_view expected = "a list of pairs of cells, [[\"a\",\"b\"],...] or [[\"a\",\"b\",[1,0]],...]";
  std::size_t position = 0;
  op.pairs = list(in, "pairs", in.need("pairs"), expected, [&](const Json& pair) {
    if (!pair.is_array() || pair.size() < 2 || pair.size() > 3) {
      in.wrong("pairs", expected, pair);
    }
    if (pair.size() == 3) {
      op.maps.emplace(position, vertex_map(in, pair[2]));
    }
    ++position;
    return std::pair{text(in, "pairs", pair[0]), text(in, "pairs", pair[1])};
  });
  return op;
}

Operation read_degenerate(Fields& in) {
  Degenerate op;
  op.cell = text(in, "cell", in.need("cell"));
  const Json& along = in.need("along");
  if (along.is_array() && along.size() == 2) {
    op.component = small(in, "along", along[0], 1);
    op.index = small(in, "along", along[1], 0);
  } else if (along.is_array()) {
    in.wrong("along", "an index i for a simplex, or [i,j] for a simploid", along);
  } else {
    op.index = small(in, "along", along, 0);
  }
  return op;
}

Operation read_deidentify(Fields& in) {
  Deidentify op;
  op.splits = list(
      in, "split", in.need("split"), "a list of objects with \"cell\", \"as\" and \"moves\"", [&](const Json& item) {
        if (!item.is_object()) {
          in.wrong("split", "a list of objects with \"cell\", \"as\" and \"moves\"", item);
        }
        Fields fields(item, "a split");
        Deidentify::Split split;
        split.cell = text(fields, "cell", fields.need("cell"));
        split.copy = text(fields, "as", fields.need("as"));
        constexpr std::string_view expected = "a list of incidences, [[\"cell\",face number],...]";
        split.moves = list(fields, "moves", fields.need("moves"), expected, [&](const Json& move) {
          if (!move.is_array() || move.size() != 2) {
            fields.wrong("moves", expected, move);
          }
          return std::pair{text(fields, "moves", move[0]), std::int64_t{small(fields, "moves", move[1], 0)}};
        });
        fields.finish();
        return split;
      });
  return op;
}

Operation read_product(Fields& in) {
  MakeProduct op;
  op.name = text(in, "name", in.need("name"));
  op.left = text(in, "left", in.need("left"));
  op.right = text(in, "right", in.need("right"));
  if (const Json* kind_of_product = in.find("kind")) {
    const std::string word = text(in, "kind", *kind_of_product);
    if (word != "simploidal" && word != "simplicial") {
      throw Wrong{
          fmt::format("field \"kind\" of a product should be \"simploidal\" or \"simplicial\", but is \"{}\"", word)};
    }
    op.simplicial = word == "simplicial";
  }
  return op;
}

/// A label as a text: integers in decimal.
std::string label(Fields& in, const std::string& field, const Json& value) {
  if (value.is_string()) {
    return value.get<std::string>();
  }
  if (!value.is_number_unsigned()) {
    in.wrong(field, "made of labels, which are strings or integers from 0 on", value);
  }
  return std::to_string(value.get<std::uint64_t>());
}

/// Of a list of simplices one expects that some are there already; of one simplex, unless it is said, that it is not.
Operation read_insert(Fields& in) {
  const auto simplex = [&](const std::string& field, const Json& value) {
    return list(in, field, value, "a list of vertex labels", [&](const Json& item) { return label(in, field, item); });
  };
  Insert op;
  const Json* one = in.find("simplex");
  const Json* many = in.find("simplices");
  if ((one == nullptr) == (many == nullptr)) {
    throw Wrong{R"("insert" needs a field "simplex" or a field "simplices", one of the two)"};
  }
  if (one != nullptr) {
    op.simplices.push_back(simplex("simplex", *one));
  } else {
    op.simplices = list(in, "simplices", *many, "a list of simplices, [[\"a\",\"b\"],...]",
                        [&](const Json& item) { return simplex("simplices", item); });
  }
  const Json* exist_ok = in.find("exist_ok");
  op.exist_ok = exist_ok != nullptr ? truth(in, "exist_ok", *exist_ok) : many != nullptr;
  return op;
}

Operation read_collapse(Fields& in) {
  Collapse op;
  op.from = label(in, "from", in.need("from"));
  op.to = label(in, "to", in.need("to"));
  return op;
}

std::vector<Integer> integers(Fields& in, const std::string& field, const Json& value) {
  return list(in, field, value, "a list of integers", [&](const Json& n) { return integer(in, field, n); });
}

Operation read_expect(Fields& in) {
  Expect op;
  if (const Json* betti = in.find("betti")) {
    op.betti = integers(in, "betti", *betti);
  }
  if (const Json* torsion = in.find("torsion")) {
    op.torsion = list(in, "torsion", *torsion, "a list of lists of integers",
                      [&](const Json& t) { return integers(in, "torsion", t); });
  }
  if (const Json* euler = in.find("euler")) {
    op.euler = integer(in, "euler", *euler);
  }
  if (const Json* cells = in.find("cells")) {
    op.cells = integers(in, "cells", *cells);
  }
  return op;
}

Operation read_class(Fields& in) {
  AskClass op;
  constexpr std::string_view expected = "a list of terms, [[coefficient,\"cell\"],...]";
  op.chain = list(in, "chain", in.need("chain"), expected, [&](const Json& term) {
    if (!term.is_array() || term.size() != 2) {
      in.wrong("chain", expected, term);
    }
    return std::pair{integer(in, "chain", term[0]), text(in, "chain", term[1])};
  });
  return op;
}

Operation read_undo(Fields& in) {
  Undo op;
  if (const Json* steps = in.find("steps")) {
    const Integer n = integer(in, "steps", *steps);
    const auto word = n.to_int64();
    if (!word || *word < 1) {
      throw Wrong{fmt::format("field \"steps\" of an undo should be a positive integer, but is {}", n.to_string())};
    }
    op.steps = static_cast<std::uint64_t>(*word);
  }
  return op;
}

Operation read_note(Fields& in) { return Note{text(in, "text", in.need("text"))}; }

struct Reader {
  std::string_view keyword;
  Operation (*read)(Fields&);
};
constexpr Reader readers[] = {{"simplex", read_simplex},
                              {"simploid", read_simploid},
                              {"complex", read_complex},
                              {"cone", read_cone},
                              {"suspend", read_suspension},
                              {"product", read_product},
                              {"identify", read_identify},
                              {"degenerate", read_degenerate},
                              {"deidentify", read_deidentify},
                              {"insert", read_insert},
                              {"collapse", read_collapse},
                              {"expect", read_expect},
                              {"class", read_class},
                              {"undo", read_undo},
                              {"note", read_note}};

Operation read_operation(const Json& object) {
  const auto op = object.find("op");
  if (op == object.end() || !op->is_string()) {
    throw Wrong{object.contains("sesame") ? "a script has one header, and this is another"
                                          : "a step needs a field \"op\" that says which operation it is"};
  }
  const std::string word = op->get<std::string>();
  for (const Reader& reader : readers) {
    if (reader.keyword == word) {
      Fields in(object, "\"" + word + "\"");
      (void)in.find("op");
      Operation operation = reader.read(in);
      in.finish();
      return operation;
    }
  }
  std::string known;
  for (const Reader& reader : readers) {
    known += (known.empty() ? "" : ", ") + std::string{reader.keyword};
  }
  throw Wrong{fmt::format("there is no op \"{}\"; the ops are: {}", word, known)};
}

Header read_header(const Json& object) {
  Fields in(object, "the header");
  const Json* version = in.find("sesame");
  if (version == nullptr) {
    throw Wrong{"the first object should be the header, such as {\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus\"}"};
  }
  Header header;
  if (!version->is_number_integer() || *version != 1) {
    throw Wrong{fmt::format("this program reads version 1 of the format, but the header says {}",
                            version->is_number() ? version->dump() : std::string{kind(*version)})};
  }
  if (const Json* ring = in.find("ring")) {
    header.ring = text(in, "ring", *ring);
  }
  if (const Json* title = in.find("title")) {
    header.title = text(in, "title", *title);
  }
  in.finish();
  return header;
}

/// Builds the value that a line says, and refuses a field that stands twice in one object: one of the two would be lost
/// without a word. Its cost is that of the text, n log n for an object with n fields.
class LineParser final : public nlohmann::json_sax<Json> {
 public:
  LineParser(const LineParser&) = delete;
  LineParser& operator=(const LineParser&) = delete;
  ~LineParser() override = default;

  /// Throws Wrong.
  static Json parse(std::string_view line) {
    LineParser parser;
    Json::sax_parse(line, &parser);
    return std::move(parser.root_);
  }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& /*value*/) override { return false; }  // no text has one
  bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
  bool end_array() override { return close(); }
  bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
  bool end_object() override {
    refuse_doubled_fields(*open_.back()->get_ptr<const Json::object_t*>());
    return close();
  }
  bool key(string_t& field) override {
    // Not by operator[], which would look through all the fields before it.
    open_.back()->get_ptr<Json::object_t*>()->emplace_back(std::move(field), nullptr);
    return true;
  }
  bool parse_error(std::size_t column, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    // The only other complaint of the reader is about numbers beyond all machine numbers.
    throw Wrong{dynamic_cast<const Json::parse_error*>(&error) != nullptr
                    ? fmt::format("this is not a JSON object (at column {}): a line is one object, {{...}}", column)
                    : "this object cannot be read: a number in it is out of range; write integers beyond 64 bits as "
                      "strings"};
  }

 private:
  LineParser() = default;

  /// Puts a value at the end of what is open.
  Json& place(Json value) {
    if (open_.empty()) {
      return root_ = std::move(value);
    }
    if (auto* list = open_.back()->get_ptr<Json::array_t*>()) {
      return list->emplace_back(std::move(value));
    }
    return open_.back()->get_ptr<Json::object_t*>()->back().second = std::move(value);
  }
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json value) {
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  void refuse_doubled_fields(const Json::object_t& object) {
    fields_.clear();
    for (const auto& [field, value] : object) {
      fields_.push_back(field);
    }
    std::sort(fields_.begin(), fields_.end());
    if (const auto twice = std::adjacent_find(fields_.begin(), fields_.end()); twice != fields_.end()) {
      throw Wrong{fmt::format("the field \"{}\" stands twice in one object", *twice)};
    }
  }

  Json root_;
  std::vector<Json*> open_;               ///< each the last in the one before it, so that none moves while it is open
  std::vector<std::string_view> fields_;  ///< of the object that ends; kept for the next one
};

template <class Read>
auto parse_line(std::string_view line, Read read) -> Result<decltype(read(Json{}))> {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos || line[begin] != '{') {
    return Error{Errc::bad_input, "a line should be one JSON object, {...}"};
  }
  try {
    return read(LineParser::parse(line));
  } catch (Wrong& wrong) {
    return Error{Errc::bad_input, std::move(wrong.what)};
  }
}

/// Text that is not UTF-8 can only come from a program; what is illegal in it is replaced.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json json_integer(const Integer& n) {
  const auto word = n.to_int64();
  return word ? Json(*word) : Json(n.to_string());
}

/// An integer that 64 bits can say as a number, any other label as a string.
Json json_label(const std::string& label) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
  return error == std::errc{} && std::to_string(number) == label ? Json(number) : Json(label);
}

Json json_integers(const std::vector<Integer>& numbers) {
  Json out = Json::array();
  for (const Integer& n : numbers) {
    out.push_back(json_integer(n));
  }
  return out;
}

struct Writer {
  Json& out;

  void operator()(const MakeSimplex& op) const {
    out["name"] = op.name;
    out["dim"] = op.dimension;
    if (!op.at.empty()) {
      out["at"] = op.at;
    }
  }
  void operator()(const MakeSimploid& op) const {
    out["name"] = op.name;
    out["type"] = op.type;
    if (!op.at.empty()) {
      out["at"] = op.at;
    }
  }
  void operator()(const MakeComplex& op) const {
    out["name"] = op.name;
    Json& cells = out["cells"] = Json::array();
    for (const MakeComplex::Cell& cell : op.cells) {
      Json item{{"id", cell.id}};
      if (cell.type) {
        item["type"] = *cell.type;
      }
      if (!cell.faces.empty()) {
        item["faces"] = cell.faces;
      }
      if (cell.at) {
        item["at"] = *cell.at;
      }
      cells.push_back(std::move(item));
    }
  }
  void write(const ConeBase& over) const {
    if (const auto* body = std::get_if<std::string>(&over)) {
      out["over"] = *body;
    } else if (const auto* cells = std::get_if<std::vector<std::string>>(&over)) {
      out["over"] = *cells;
    }
  }
  void operator()(const MakeCone& op) const {
    out["apex"] = op.apex;
    write(op.over);
    if (op.at) {
      out["at"] = *op.at;
    }
  }
  void operator()(const MakeSuspension& op) const {
    out["apexes"] = op.apexes;
    write(op.over);
    if (!op.at.empty()) {
      out["at"] = op.at;
    }
  }
  void operator()(const Identify& op) const {
    Json& pairs = out["pairs"] = Json::array();
    for (std::size_t k = 0; k < op.pairs.size(); ++k) {
      Json pair = Json::array({op.pairs[k].first, op.pairs[k].second});
      if (const auto map = op.maps.find(k); map != op.maps.end()) {
        pair.push_back(map->second.size() == 1 ? Json(map->second[0]) : Json(map->second));
      }
      pairs.push_back(std::move(pair));
    }
  }
  void operator()(const MakeProduct& op) const {
    out["name"] = op.name;
    out["left"] = op.left;
    out["right"] = op.right;
    if (op.simplicial) {
      out["kind"] = "simplicial";
    }
  }
  void operator()(const Degenerate& op) const {
    out["cell"] = op.cell;
    if (op.component) {
      out["along"] = {*op.component, op.index};
    } else {
      out["along"] = op.index;
    }
  }
  void operator()(const Deidentify& op) const {
    Json& splits = out["split"] = Json::array();
    for (const Deidentify::Split& split : op.splits) {
      Json moves = Json::array();
      for (const auto& [cell, face] : split.moves) {
        moves.push_back(Json::array({cell, face}));
      }
      splits.push_back(Json{{"cell", split.cell}, {"as", split.copy}, {"moves", std::move(moves)}});
    }
  }
  void operator()(const Insert& op) const {
    const bool is_one = op.simplices.size() == 1;
    Json simplices = Json::array();
    for (const auto& labels : op.simplices) {
      Json& simplex = simplices.emplace_back(Json::array());
      for (const std::string& label : labels) {
        simplex.push_back(json_label(label));
      }
    }
    out[is_one ? "simplex" : "simplices"] = std::move(is_one ? simplices[0] : simplices);
    if (op.exist_ok == is_one) {
      out["exist_ok"] = op.exist_ok;
    }
  }
  void operator()(const Collapse& op) const {
    out["from"] = json_label(op.from);
    out["to"] = json_label(op.to);
  }
  void operator()(const Expect& op) const {
    if (op.betti) {
      out["betti"] = json_integers(*op.betti);
    }
    if (op.torsion) {
      Json& torsion = out["torsion"] = Json::array();
      for (const auto& factors : *op.torsion) {
        torsion.push_back(json_integers(factors));
      }
    }
    if (op.euler) {
      out["euler"] = json_integer(*op.euler);
    }
    if (op.cells) {
      out["cells"] = json_integers(*op.cells);
    }
  }
  void operator()(const AskClass& op) const {
    Json& chain = out["chain"] = Json::array();
    for (const auto& [coefficient, cell] : op.chain) {
      chain.push_back(Json::array({json_integer(coefficient), cell}));
    }
  }
  void operator()(const Undo& op) const { out["steps"] = op.steps; }
  void operator()(const Note& op) const { out["text"] = op.text; }
};

}  // namespace

Result<Operation> parse_operation(std::string_view line) { return parse_line(line, read_operation); }

Result<Header> parse_header(std::string_view line) { return parse_line(line, read_header); }

std::string to_text(const Operation& operation) {
  Json out;
  out["op"] = keyword(operation);
  std::visit(Writer{out}, operation);
  return dump(out);
}

std::string to_text(const Header& header) {
  return dump(Json{{"sesame", header.version}, {"ring", header.ring}, {"title", header.title}});
}

}  // namespace sesame::ops
