// What a page is given: cells under numbers of its own, events, places, chains; and how it is put into HTML.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "replay/page/packed_numbers.hpp"
#include "replay/page/page_file.hpp"
#include "replay/page/page_template.hpp"
#include "replay/page/page_writer.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using nlohmann::json;

namespace {

/// With all steps as objects: one that made cells, and of which there is nothing else to say, is their number.
json with_objects(json page) {
  std::uint64_t first = 0;
  for (json& step : page["steps"]) {
    if (step.is_number()) {
      step = json{{"made", {first, step.get<std::uint64_t>()}}};
    }
    first += step.contains("made") ? step["made"][1].get<std::uint64_t>() : 0;
  }
  return page;
}

/// A replay with the page that is made of it.
struct Paged {
  explicit Paged(const std::string& script, const replay::PageLimits& limits = {}) : history{limits} {
    replay::ReplayOptions options;
    options.engine = &engine;
    options.observer = [this](const ops::Operation& operation, const engine::StepReport& report) {
      history.take(*engine, operation, report);
    };
    const Replayed replayed = replay_text(script, nullptr, options);
    CHECK(replayed.errors.empty());
    data = with_objects(json::parse(replay::page_data(history, *engine, {"", "script", ""})));
  }
  Paged(const Paged&) = delete;
  Paged& operator=(const Paged&) = delete;
  ~Paged() = default;

  [[nodiscard]] json step(std::size_t k) const { return data["steps"][k]; }
  /// The generators after so many steps.
  [[nodiscard]] std::vector<json> generators_after(std::size_t steps) const {
    json numbers;
    for (std::size_t k = 0; k < steps; ++k) {
      if (step(k).contains("generators")) {
        numbers = step(k)["generators"];
      }
    }
    std::vector<json> found;
    for (const json& number : numbers) {
      found.push_back(data["classes"][number.get<std::size_t>()]);
    }
    return found;
  }
  [[nodiscard]] std::vector<json> generators() const { return generators_after(data["steps"].size()); }
  [[nodiscard]] std::string name(std::size_t cell) const { return data["cells"]["names"][cell]; }
  [[nodiscard]] std::vector<double> place(const std::string& of) const {
    const auto& cells = data["places"]["cells"];
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (name(cells[k]) == of) {
        const auto& points = data["places"]["points"];
        return {points[3 * k], points[3 * k + 1], points[3 * k + 2]};
      }
    }
    FAIL("no place for " << of);
    return {};
  }

  std::unique_ptr<engine::Engine> engine;
  replay::PageHistory history;
  json data;
};

std::string script(const std::vector<std::string>& steps) { return joined({header_line}) + joined(steps); }

const std::string edge = R"({"op":"simplex","name":"e","dim":1,"at":[[1,2],[3,2]]})";
const std::string other_edge = R"({"op":"simplex","name":"f","dim":1,"at":[[0,0],[0,1]]})";

/// The cells that the events of a page leave, in the way in which the page carries them out.
class Player {
 public:
  explicit Player(const json& data) : data_(data) {}  // braces would make a list of it

  void go_on() {
    const json& step = data_["steps"][at_++];
    if (step.contains("undone")) {
      for (const std::size_t k : step["undone"]) {
        take(data_["steps"][k], false);
      }
    } else {
      take(step, true);
    }
  }
  /// By dimension.
  [[nodiscard]] std::vector<std::uint64_t> counts() const {
    std::vector<std::uint64_t> counts;
    for (const std::int64_t cell : there_) {
      int dimension = 0;
      const auto type = data_["cells"]["type"][static_cast<std::size_t>(cell)].get<std::size_t>();
      for (const int part : data_["cells"]["types"][type]) {
        dimension += part;
      }
      counts.resize(std::max(counts.size(), static_cast<std::size_t>(dimension) + 1));
      ++counts[static_cast<std::size_t>(dimension)];
    }
    return counts;
  }

 private:
  void take(const json& step, bool forwards) {
    const auto put = [&](std::int64_t cell, bool there) {
      const bool changed = there == forwards ? there_.insert(cell).second : there_.erase(cell) > 0;
      CHECK(changed);
    };
    if (!forwards) {  // the last event first
      for_each_gone(step, [&](std::int64_t cell) { put(cell, false); });
    }
    if (step.contains("made")) {
      for (std::int64_t k = 0; k < step["made"][1]; ++k) {
        put(step["made"][0].get<std::int64_t>() + k, true);
      }
    }
    if (forwards) {
      for_each_gone(step, [&](std::int64_t cell) { put(cell, false); });
    }
  }
  template <class Visit>
  static void for_each_gone(const json& step, Visit visit) {
    for (std::size_t k = 0; step.contains("removed") && k < step["removed"].size(); k += 2) {
      visit(step["removed"][k]);
    }
    for (std::size_t k = 0; step.contains("consumed") && k < step["consumed"].size(); ++k) {
      visit(step["consumed"][k]);
    }
  }

  const json& data_;
  std::set<std::int64_t> there_;
  std::size_t at_ = 0;
};

}  // namespace

TEST_CASE("the events of a page lead to the cells that there are after each step", "[page]") {
  for (const char* name :
       {"torus", "undo", "undo_of_everything", "product_of_circles", "cutting_a_torus", "ungluing_in_any_order",
        "squashed_boundaries", "projective_plane_contracted", "suspensions", "face_pairings", "figure_2_45"}) {
    CAPTURE(name);
    const Paged paged(example(name));
    Player player(paged.data);
    json cells;
    for (const json& step : paged.data["steps"]) {
      player.go_on();
      cells = step.contains("cells") ? step["cells"] : cells;
      CHECK(json(player.counts()) == cells);
    }
  }
}

TEST_CASE("a step has the numbers of the object after it where they differ from those before", "[page]") {
  const Paged paged(example("torus"));
  CHECK(paged.step(0)["cells"] == json({4, 4, 1}));
  CHECK(!paged.step(1).contains("cells"));
  CHECK(paged.step(5)["betti"] == json({1, 2, 1}));
  CHECK(paged.step(5)["op"] == "identify");
}

TEST_CASE("an edge has its ends as faces, and what is glued becomes the other with its orientation", "[page]") {
  const Paged paged(script({edge, other_edge, R"({"op":"identify","pairs":[["e","f",[1,0]]]})"}));
  const json& faces = paged.data["cells"]["faces"];
  CHECK(faces == json({2, 0, 8, 6}));
  const json removed = paged.step(2)["removed"];
  REQUIRE(removed.size() == 6);
  std::set<std::string> became;
  for (std::size_t k = 0; k < removed.size(); k += 2) {
    const std::int64_t to = removed[k + 1];
    became.insert(paged.name(removed[k]) + (to % 2 == 1 ? " -" : " ") + paged.name(static_cast<std::size_t>(to / 2)));
  }
  CHECK(became == std::set<std::string>{"f.0 e.1", "f.1 e.0", "f -e"});
}

TEST_CASE("a cell that is squashed lies on a smaller one", "[page]") {
  const Paged paged(script({edge, R"({"op":"degenerate","cell":"e","along":0})"}));
  const json removed = paged.step(1)["removed"];
  bool is_squashed = false;
  for (std::size_t k = 0; k < removed.size(); k += 2) {
    is_squashed = is_squashed || (paged.name(removed[k]) == "e" && removed[k + 1].get<int>() <= -2);
  }
  CHECK(is_squashed);
}

TEST_CASE("vertices have the places of the script, products their sums", "[page]") {
  const Paged paged(script({edge, other_edge, R"({"op":"product","name":"P","left":"e","right":"f"})"}));
  CHECK(paged.place("e.0") == std::vector<double>{1, 2, 0});
  CHECK(paged.place("P.(e.1|f.1)") == std::vector<double>{3, 3, 0});
  CHECK(paged.data["places"]["counts"] == json({{"given", 4}, {"sum", 4}, {"beside", 0}, {"computed", 0}}));
  CHECK(paged.step(2)["consumed"].size() == 6);
}

TEST_CASE("a product whose places would fall together is laid out by its edges", "[page]") {
  const Paged paged(script({edge, R"({"op":"product","name":"P","left":"e","right":"e"})"}));
  CHECK(paged.data["places"]["counts"]["sum"] == 0);
  std::set<std::vector<double>> places;
  for (const char* name : {"P.(e.0|e.0)", "P.(e.0|e.1)", "P.(e.1|e.0)", "P.(e.1|e.1)"}) {
    places.insert(paged.place(name));
  }
  CHECK(places.size() == 4);
}

TEST_CASE("vertices without a position are apart, and the same ones each time", "[page]") {
  for (const char* name : {"insert_cycle", "cone", "torus"}) {
    const std::string text =
        name == std::string{"cone"}
            ? script({R"({"op":"simplex","name":"t","dim":2,"at":[[0,0],[1,0],[0,1]]})", R"({"op":"cone","apex":"v"})"})
        : name == std::string{"torus"}
            ? script({R"({"op":"simploid","name":"q","type":[1,1]})",
                      R"({"op":"identify","pairs":[["q.0-1x0","q.0-1x1"],["q.0x0-1","q.1x0-1"]]})"})
            : script({R"({"op":"insert","simplices":[[1,2],[2,3],[3,4],[4,5],[5,1],[7]]})"});
    const Paged paged(text);
    CHECK(paged.data == Paged(text).data);
    const json& points = paged.data["places"]["points"];
    for (std::size_t a = 0; a + 3 < points.size(); a += 3) {
      for (std::size_t b = a + 3; b < points.size(); b += 3) {
        double squares = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double difference = points[a + axis].get<double>() - points[b + axis].get<double>();
          squares += difference * difference;
        }
        CHECK(squares > 0.01);
      }
    }
  }
}

TEST_CASE("what is too much for a page is counted", "[page]") {
  replay::PageLimits limits;
  limits.cells = 10;
  limits.steps = 2;
  const Paged paged(script({edge, other_edge, R"({"op":"simploid","name":"q","type":[1,1]})"}), limits);
  CHECK(paged.data["left_out"] == 5);
  CHECK(paged.data["cells"]["names"].size() == 10);
  CHECK(paged.data["stride"] == 2);
  CHECK(!paged.step(0).contains("op"));
  CHECK(paged.step(0).contains("made"));
  CHECK(paged.step(1)["op"] == "simplex");
  CHECK(paged.step(2)["op"] == "simploid");
  limits = {};
  limits.cells_of_family = 8;
  const Paged product(script({edge, other_edge, R"({"op":"product","name":"P","left":"e","right":"f"})",
                              R"x({"op":"identify","pairs":[["P.(e|f.0)","P.(e|f.1)"]]})x"}),
                      limits);
  CHECK(product.data["families_left_out"] == 1);
  CHECK(product.step(3)["cells"] == json({2, 3, 1}));
  CHECK(!product.step(3).contains("removed"));
}

TEST_CASE("generators and answers are chains of cells of the page", "[page]") {
  const Paged paged(example("projective_plane"));
  json found;
  for (const json& generator : paged.generators()) {
    if (generator["order"] == "2") {
      found = generator;
    }
  }
  REQUIRE(!found.is_null());
  CHECK(paged.name(found["chain"]["terms"][0][1]) == "a.0-1");
  CHECK(found["bounds"]["terms"].size() == 2);
  const json answer = paged.step(11)["answer"];
  CHECK(answer["zero"] == true);
  CHECK(answer["bounds"]["terms"].size() == 2);
  replay::PageLimits limits;
  limits.terms = 1;
  limits.terms_of_generators = 1;
  const Paged shorter(example("projective_plane"), limits);
  CHECK(shorter.step(11)["answer"]["bounds"]["length"] == 2);
  CHECK(shorter.generators()[0]["chain"]["terms"].size() == 1);
  CHECK(shorter.generators()[1]["chain"]["length"] == 1);
}

TEST_CASE("no text of a script can end the element that it stands in", "[page]") {
  Paged paged(script({R"({"op":"note","text":"</script><!--"})"}));
  const std::string text = replay::page_data(paged.history, *paged.engine, {"<b>", "<i>", ""});
  CHECK(json::parse(text)["title"] == "<b>");
  std::ostringstream out;
  replay::write_page(out, paged.history, *paged.engine, {"<b>", "<i>", ""});
  const std::string page = out.str();
  CHECK_THAT(page, Contains("Content-Security-Policy"));
  CHECK(page.find(replay::page_data_mark) == std::string::npos);
  const std::string before = R"(<script type="application/json" id="data">)";
  const std::size_t begin = page.find(before) + before.size();
  const std::string written = page.substr(begin, page.find('<', begin) - begin);
  CHECK(json::parse(written) == json::parse(text));
}

TEST_CASE("a long operation is cut for the list, not within a character", "[page]") {
  std::string word;
  for (int k = 0; k < 200; ++k) {
    word += "ä";
  }
  const Paged paged(script({R"({"op":"note","text":")" + word + "\"}"}));
  const std::string text = paged.step(0)["text"];
  CHECK(text.size() < 320);
  CHECK_THAT(text, Contains("ä …"));
}

namespace {

/// What a page is after news.
void add_news(json& page, const json& news) {
  for (const char* list : {"names", "type", "first", "faces"}) {
    for (const json& item : news["cells"][list]) {
      page["cells"][list].push_back(item);
    }
  }
  page["cells"]["types"] = news["cells"]["types"];
  json& places = page["places"];
  for (std::size_t k = 0; k < news["places"]["cells"].size(); ++k) {
    const json& cell = news["places"]["cells"][k];
    const auto found = std::find(places["cells"].begin(), places["cells"].end(), cell);
    const auto at = static_cast<std::size_t>(found - places["cells"].begin());
    if (found == places["cells"].end()) {
      places["cells"].push_back(cell);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places["points"][3 * at + axis] = news["places"]["points"][3 * k + axis];
    }
  }
  places["counts"] = news["places"]["counts"];
  for (const json& step : news["steps"]) {
    page["steps"].push_back(step);
  }
  for (const char* field : {"title", "notes", "stride", "left_out", "families_left_out"}) {
    page[field] = news[field];
  }
  for (const json& each : news["classes"]) {
    page["classes"].push_back(each);
  }
}

/// Fields that are the same as in the step before, which a page may be told again, are put into each step.
json with_all_numbers(json page) {
  json before;
  for (json& step : page["steps"]) {
    for (const char* field : {"cells", "euler", "betti", "torsion", "generators"}) {
      if (!step.contains(field) && before.contains(field)) {
        step[field] = before[field];
      }
    }
    before = step;
  }
  return page;
}

}  // namespace

TEST_CASE("news, piece by piece, make the page that is written at the end", "[page]") {
  for (const std::string name : {"undo", "cutting_a_torus", "product_of_circles", "projective_plane"}) {
    std::unique_ptr<engine::Engine> engine;
    replay::PageHistory history{replay::PageLimits{}};
    replay::PagePart seen;
    json page;
    std::size_t pieces = 0;
    replay::ReplayOptions options;
    options.engine = &engine;
    const replay::PageHead head{"", "script", ""};
    options.observer = [&](const ops::Operation& operation, const engine::StepReport& report) {
      history.take(*engine, operation, report);
      if (page.is_null()) {
        page = json::parse(replay::page_data(history, *engine, head));
        seen = {history.cells().size(), history.steps().size(), history.generators().classes().size(), {}};
      } else if (history.steps().size() % 3 == 0) {
        const json news = json::parse(replay::page_news(history, *engine, head, seen));
        CHECK(news["steps"].size() <= 3);
        add_news(page, news);
        ++pieces;
      }
    };
    CHECK(replay_text(example(name), nullptr, options).errors.empty());
    add_news(page, json::parse(replay::page_news(history, *engine, head, seen)));
    CHECK(pieces > 1);
    CHECK(with_all_numbers(page) == with_all_numbers(json::parse(replay::page_data(history, *engine, head))));
  }
}

TEST_CASE("a page may ask the server that it comes from, and one from a disk nobody", "[page]") {
  std::ostringstream disk, server;
  replay::write_page_file(disk, "{}");
  replay::write_page_file(server, "{}", replay::PageFrom::server);
  CHECK_THAT(disk.str(), !Contains("connect-src"));
  CHECK_THAT(server.str(), Contains("default-src 'none'; connect-src 'self'; script-src 'sha256-"));
}

TEST_CASE("long lists of numbers are packed as the bytes that they are") {
  const auto packed = [](const auto& numbers) {
    std::string text;
    ops::JsonText out(text);
    replay::write_packed(std::span{numbers}, out);
    return text;
  };
  // In TypeScript: replay/page/test/picking.test.ts.
  CHECK(packed(std::vector<float>{1, -2.5F}) == R"({"kind":"f32","data":"AACAPwAAIMA="})");
  CHECK(packed(std::vector<std::uint32_t>{1, 65535, 256}) == R"({"kind":"u16","data":"AQD//wAB"})");
  CHECK(packed(std::vector<std::uint32_t>{1, 65536}) == R"({"kind":"u32","data":"AQAAAAAAAQA="})");
  CHECK(packed(std::vector<std::uint32_t>{}) == R"({"kind":"u16","data":""})");
}
