// Names that are told and found by arithmetic, against a plain list of all texts.
#include "ops/cells/directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "ops/cells/name_text.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Matchers::Contains;

namespace {

/// Each name that was given, as a text, in the order of the steps.
class PlainDirectory {
 public:
  struct Name {
    std::string text;
    CellId cell;
    BodyId body;
    bool is_own;  ///< the cell was created with it
  };

  /// To be called after the plan has been carried out.
  void add(const Plan& plan, const Structure& structure) {
    const std::size_t before = names_.size();
    const BodyId body = plan.new_body ? structure.bodies().size() - 1 : BodyId{none};
    CellId cell = plan.first;
    for (const std::string& text : names_of_new_cells(plan, structure.types())) {
      const bool is_of_body = text == plan.new_body;
      names_.push_back({text, cell++, is_of_body ? body : BodyId{none}, true});
    }
    if (plan.standard == structure.types().vertex()) {
      names_.push_back({*plan.new_body + ".0", names_.back().cell, none, false});
    }
    if (plan.new_body && std::none_of(names_.begin() + static_cast<std::ptrdiff_t>(before), names_.end(),
                                      [&](const Name& name) { return name.text == *plan.new_body; })) {
      names_.push_back({*plan.new_body, none, body, false});
    }
  }
  void truncate(std::size_t size) { names_.erase(names_.begin() + static_cast<std::ptrdiff_t>(size), names_.end()); }

  [[nodiscard]] const std::vector<Name>& names() const { return names_; }
  [[nodiscard]] std::size_t size() const { return names_.size(); }
  [[nodiscard]] const Name* find(std::string_view text) const {
    const auto at = std::find_if(names_.begin(), names_.end(), [&](const Name& name) { return name.text == text; });
    return at == names_.end() ? nullptr : &*at;
  }
  [[nodiscard]] bool any(const std::function<bool(const std::string&)>& holds) const {
    return std::any_of(names_.begin(), names_.end(), [&](const Name& name) { return holds(name.text); });
  }

 private:
  std::vector<Name> names_;
};

const std::vector<std::string> endings{
    "",    ".0",     ".1",   ".0-1",   ".1-0", ".0-1-2", ".2-0", ".00", ".",  ".0-", ".0x0", ".0-1x0", ".1x0-1", ".x",
    ".0x", ".0-1x1", "*t.0", ".(a|b)", ".0.0", ".0-1.1", "-1",   "0",   ".3", ".a",  ".0-2", "*",      ".0x0-1"};

const std::string& any_of(const std::vector<std::string>& texts, Random& random) {
  return texts[static_cast<std::size_t>(random.in(0, static_cast<int>(texts.size()) - 1))];
}

/// Where the directory differs from the list; empty when it does not.
std::string difference(const Structure& structure, const PlainDirectory& plain, Random& random) {
  const Directory& directory = structure.directory();
  std::vector<std::string> texts{"t", "K", "nobody.0", "t.0-1-2-3-4"};
  for (const PlainDirectory::Name& name : plain.names()) {
    if (name.is_own && directory.own_name(name.cell) != name.text) {
      return "own name " + name.text;
    }
    texts.push_back(name.text);
    texts.push_back(name.text + any_of(endings, random));
    texts.push_back(name.text.substr(0, name.text.rfind('.')) + any_of(endings, random));
    texts.push_back("t" + any_of(endings, random) + any_of(endings, random));
  }
  for (const std::string& text : texts) {
    const PlainDirectory::Name* wanted = plain.find(text);
    const auto found = directory.find(text);
    if (found.has_value() != (wanted != nullptr) ||
        (found && (found->cell != wanted->cell || found->body != wanted->body))) {
      return "look-up of " + text;
    }
    const std::string around = "x|" + text + ")";
    const auto part = directory.find(text, PartHashes(around), 2);
    if (part.has_value() != found.has_value() || (part && part->cell != found->cell)) {
      return "look-up of the part " + text;
    }
    if (directory.is_prefix_taken(text) !=
        plain.any([&](const std::string& name) { return extends_name(name, text); })) {
      return "prefix " + text;
    }
    if (!directory.may_have_faces_named(text) && plain.find(text) == nullptr && plain.any([&](const std::string& name) {
          return name.starts_with(text + ".") && split_vertices(name) && split_vertices(name)->length == text.size();
        })) {
      return "faces of " + text;
    }
  }
  const auto odd = static_cast<std::uint64_t>(
      std::count_if(plain.names().begin(), plain.names().end(),
                    [](const PlainDirectory::Name& name) { return !is_well_bracketed(name.text); }));
  return directory.count_of_odd_names() != odd || directory.odd_names().empty() != (odd == 0) ? "odd names" : "";
}

/// Why a standard cell cannot have a name, told by trying each name that it would give; nothing when it can.
std::optional<std::string> why_refused(const std::string& name, const CellType& type, bool is_simplex,
                                       const Structure& structure, const PlainDirectory& plain) {
  const auto is_taken = [&](const std::string& text) { return plain.find(text) != nullptr || structure.lookup(text); };
  if (is_taken(name)) {
    return fmt::format("the name \"{}\" is in use: names are unique, choose another", name);
  }
  const StandardCell& standard = structure.types().standard(structure.types().intern(type));
  for (std::size_t k = 0; k + 1 < standard.cells.size(); ++k) {
    if (const std::string face = name + "." + standard.cells[k].suffix; is_taken(face)) {
      return fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new {}: choose another", face, name,
                         describe(type));
    }
  }
  return type.empty() && is_simplex && is_taken(name + ".0")
             ? std::optional{fmt::format("the name \"{}.0\" is in use: names are unique, choose another", name)}
             : std::nullopt;
}

/// Names that get in one another's way.
std::string clashing_name(Random& random) {
  static const std::vector<std::string> beginnings{"t", "t",   "t",   "K", "v",  "v*t",  "v*K",
                                                   "(", "a|b", "{a}", "P", "t.", "t.0-1"};
  std::string name = any_of(beginnings, random);
  for (int n = random.in(0, 2); n > 0; --n) {
    name += any_of(endings, random);
  }
  return name;
}

Operation any_step(const Structure& structure, Random& random) {
  const std::vector<BodyId> bodies = structure.bodies().current();
  const auto body = [&] {
    return std::string{structure.directory().name_of_body(
        bodies[static_cast<std::size_t>(random.in(0, static_cast<int>(bodies.size()) - 1))])};
  };
  const auto cell = [&] {
    return structure.directory().own_name(
        CellId{static_cast<std::uint32_t>(random.in(0, static_cast<int>(structure.cells().size()) - 1))});
  };
  switch (structure.cells().size() == 0 || bodies.empty() ? random.in(0, 3) : random.in(0, 9)) {
    case 0:
    case 1:
      return MakeSimplex{clashing_name(random), random.in(0, 2), {}};
    case 2: {
      static const std::vector<CellType> types{{}, {1}, {2}, {1, 1}, {2, 1}};
      return MakeSimploid{clashing_name(random), types[static_cast<std::size_t>(random.in(0, 4))], {}};
    }
    case 3: {
      static const std::vector<std::string> ids{"0", "1", "0-1", "0x0", "a", "0*t"};
      return MakeComplex{clashing_name(random), {{any_of(ids, random), {}, {}, {}}}};
    }
    case 4:
      return Identify{{{cell(), cell()}}};
    case 5:
      return Deidentify{{{cell(), clashing_name(random), {}}}};
    case 6:
      return MakeCone{clashing_name(random), std::vector<std::string>{cell()}, {}};
    case 7:
      return MakeCone{clashing_name(random), body(), {}};
    case 8:
      return MakeProduct{clashing_name(random), body(), body(), false};
    default:
      return Insert{{{"a", "b"}}, true};
  }
}

}  // namespace

TEST_CASE("names that are told by arithmetic are those in a plain list of all texts", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Random random(seed);
  Workshop shop(Limits{.cells_of_explicit_cone = seed % 3 == 0 ? 0 : 100});
  PlainDirectory plain;
  std::vector<std::pair<StructureMark, std::size_t>> marks;
  for (int k = 0; k < 60; ++k) {
    if (!marks.empty() && random.one_in(8)) {
      const auto at =
          static_cast<std::size_t>(random.in(static_cast<int>(marks.size()) / 2, static_cast<int>(marks.size()) - 1));
      shop.go_back_to(marks[at].first);
      plain.truncate(marks[at].second);
      marks.resize(at);
    } else {
      const StructureMark mark = mark_of(shop.structure());
      if (shop.plan(any_step(shop.structure(), random))) {
        shop.carry_out();
        marks.emplace_back(mark, plain.size());
        plain.add(shop.last_plan(), shop.structure());
      }
    }
    REQUIRE(difference(shop.structure(), plain, random) == "");
  }
}

TEST_CASE("a standard cell is refused exactly when a name in a plain list is one that it would give", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Random random(seed);
  Workshop shop(Limits{.cells_of_explicit_cone = seed % 3 == 0 ? 0 : 100});
  PlainDirectory plain;
  const std::vector<CellType> types{{}, {1}, {2}, {1, 1}, {2, 1}};
  for (int k = 0; k < 40; ++k) {
    const std::string name = clashing_name(random);
    const CellType& type = types[static_cast<std::size_t>(random.in(0, 4))];
    const bool is_simplex = type.size() <= 1 && random.one_in(2);
    CAPTURE(name, type, is_simplex);
    const auto why = why_refused(name, type, is_simplex, shop.structure(), plain);
    const Status planned = is_simplex ? shop.plan(MakeSimplex{name, type.empty() ? 0 : type[0], {}})
                                      : shop.plan(MakeSimploid{name, type, {}});
    REQUIRE(planned.has_value() == !why);
    if (why) {
      REQUIRE(planned.error().what == *why);
    }
    if (planned && random.one_in(3)) {
      shop.carry_out();
      plain.add(shop.last_plan(), shop.structure());
    } else if (shop.plan(any_step(shop.structure(), random))) {
      shop.carry_out();
      plain.add(shop.last_plan(), shop.structure());
    }
  }
}

TEST_CASE("names given to others are not given to faces, nor the other way round", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"complex","name":"t","cells":[{"id":"0-1"}]})", R"({"op":"simplex","name":"s","dim":2})",
              R"({"op":"simplex","name":"p","dim":0})", R"({"op":"simploid","name":"q","type":[]})"});
  CHECK_THAT(shop.plan(operation(R"({"op":"complex","name":"s","cells":[{"id":"a"}]})")).error().what,
             Contains("the name \"s\" is in use"));
  for (const std::string name : {"s.0", "s.0-2", "s", "s.0-1-2", "p.0", "t.0-1"}) {
    CAPTURE(name);
    CHECK(shop.structure().is_name_taken(name));
    CHECK(!shop.plan(MakeSimplex{name, 1, {}}));
  }
  CHECK(shop.plan(MakeSimplex{"s.3", 1, {}}));
  CHECK(shop.plan(MakeSimplex{"q.0", 1, {}}));  // a simploid without components has no vertex with a name of its own
  CHECK(shop.structure().lookup("s.2-0") == shop.structure().lookup("s.0-2"));
  CHECK(!shop.structure().directory().find("s.2-0"));
  CHECK(!shop.structure().directory().find("s.0-1-2"));
  CHECK(shop.structure().directory().own_name(*shop.structure().lookup("p.0")) == "p");
}

TEST_CASE("a face is not given the name of a cell of a cone or a product that nobody wrote out", "[ops]") {
  Workshop shop(Limits{.cells_of_explicit_cone = 0});
  shop.build({R"({"op":"complex","name":"K","cells":[{"id":"0"},{"id":"a"}]})",
              R"({"op":"identify","pairs":[["K.0","K.a"]]})", R"({"op":"cone","apex":"v","over":"K"})"});
  REQUIRE(!shop.structure().is_name_taken("v*K"));
  CHECK_THAT(shop.plan(operation(R"({"op":"simplex","name":"v*K","dim":1})")).error().what,
             Contains("the name \"v*K.0\" is in use, so \"v*K\" cannot name a new simplex of dimension 1"));
  CHECK(shop.plan(operation(R"({"op":"simplex","name":"v*L","dim":1})")));
}
