// A server of pages: what it says to whom, and what it does for whom.
#include <httplib.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "replay/script/replay.hpp"
#include "tests/support/catch.hpp"
#include "tools/live/live_server.hpp"

namespace sesame::tools {
namespace {

using Catch::Matchers::Contains;
using nlohmann::json;

/// A replay in a thread of its own, with a server of its pages.
class Served {
 public:
  explicit Served(bool is_writable, const std::string& script = "{\"sesame\":1,\"title\":\"served\"}\n")
      : live_{std::make_shared<LiveReplay>("script", &stop_)}, server_{started(is_writable)} {
    server_->show(live_);
    options_.shared = &live_->shared;
    options_.stop = &stop_;
    options_.engine = &engine_;
    options_.header = &header_;
    options_.observer = [this](const ops::Operation& operation, const engine::StepReport& report) {
      live_->head.title = header_.title;
      live_->history.take(*engine_, operation, report);
    };
    thread_ = std::thread([this, script] {
      replay::ScriptReader reader(replay::ByteSource::of_text(script, "script"));
      std::ostringstream errors;
      (void)replay::replay(reader, options_, nullptr, errors, nullptr);
    });
    while (!live_->shared.is_open()) {
      live_->shared.wait_for_other(live_->shared.revision(), std::chrono::milliseconds(5));
    }
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() { stop(); }

  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  [[nodiscard]] std::string address() const {
    const std::string url = server_->url();
    return url.substr(0, url.rfind('/'));
  }
  [[nodiscard]] std::string token() const {
    const std::string url = server_->url();
    return url.substr(url.find('=') + 1);
  }
  [[nodiscard]] std::string host() const { return address().substr(std::string{"http://"}.size()); }
  [[nodiscard]] httplib::Client client() const { return httplib::Client(address()); }
  /// What becomes of steps that are sent with these headers.
  [[nodiscard]] httplib::Result post(const httplib::Headers& headers, const std::string& lines) const {
    return client().Post("/steps", headers, lines, "text/plain");
  }
  [[nodiscard]] LiveServer& server() { return *server_; }

 private:
  static std::unique_ptr<LiveServer> started(bool is_writable) {
    auto server = LiveServer::start({}, is_writable);
    REQUIRE(server);
    return std::move(*server);
  }

  std::atomic<bool> stop_ = false;
  ops::Header header_;
  replay::ReplayOptions options_;
  std::unique_ptr<engine::Engine> engine_;
  std::shared_ptr<LiveReplay> live_;
  std::unique_ptr<LiveServer> server_;
  std::thread thread_;
};

json data_of(const std::string& page) {
  const std::string before = R"(id="data">)";
  const std::size_t begin = page.find(before) + before.size();
  return json::parse(page.substr(begin, page.find('<', begin) - begin));
}

/// The first pieces of news behind a place, so many.
std::vector<std::pair<std::string, json>> news(const Served& served, const std::string& place, std::size_t most) {
  httplib::Client client = served.client();
  client.set_read_timeout(5);
  std::string text;
  client.Get("/events?after=" + place, [&](const char* bytes, std::size_t size) {
    text.append(bytes, size);
    std::size_t count = 0;
    for (std::size_t at = text.find("\n\n"); at != std::string::npos; at = text.find("\n\n", at + 2)) {
      ++count;
    }
    return count < most;
  });
  std::vector<std::pair<std::string, json>> found;
  std::istringstream lines(text);
  std::string name;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("id: ") || line.starts_with("event: ")) {
      name = line.substr(line.find(' ') + 1);
    } else if (line.starts_with("data: ")) {
      found.emplace_back(name, json::parse(line.substr(6), nullptr, false));
    }
  }
  return found;
}

const std::string edge = R"({"op":"simplex","name":"e","dim":1})";

}  // namespace

TEST_CASE("an address of a server is a port, with a number of this machine before it or without", "[live]") {
  CHECK(parse_server_address("8080")->host == "127.0.0.1");
  CHECK(parse_server_address("8080")->port == 8080);
  CHECK(parse_server_address("0.0.0.0:0")->host == "0.0.0.0");
  CHECK(parse_server_address("[::1]:65535")->host == "::1");
  for (const char* wrong : {"", ":", "x", "65536", "-1", "80x", "host:80", "::1:80", "[::1]", "127.0.0.1:", "[]:1"}) {
    const auto parsed = parse_server_address(wrong);
    REQUIRE_FALSE(parsed);
    CHECK_THAT(parsed.error().what, Contains("should be a port"));
  }
}

TEST_CASE("two servers do not share a port", "[live]") {
  const auto first = LiveServer::start({}, false);
  REQUIRE(first);
  const std::string url = (*first)->url();
  const auto second = LiveServer::start({"127.0.0.1", std::stoi(url.substr(url.rfind(':') + 1))}, false);
  REQUIRE_FALSE(second);
  CHECK_THAT(second.error().what, Contains("cannot listen on 127.0.0.1:") && Contains("in use"));
}

TEST_CASE("the page has the object as it is, and says where it goes on from", "[live]") {
  const Served served(false);
  const auto page = served.client().Get("/");
  REQUIRE(page);
  CHECK(page->status == 200);
  CHECK(page->get_header_value("Cache-Control") == "no-store");
  CHECK_THAT(page->body, Contains("connect-src 'self'"));
  const json data = data_of(page->body);
  CHECK(data["live"] == json{{"place", "1/0/0/0"}, {"writable", false}});
  CHECK(data["kind"] == "replay");
  CHECK(served.post({{"X-Sesame-Token", ""}}, edge)->status == 403);
}

TEST_CASE("steps are taken from who has the token and comes from nowhere else", "[live]") {
  const Served served(true);
  const std::string token = served.token();
  CHECK(token.size() == 32);
  CHECK(served.post({}, edge)->status == 403);
  CHECK(served.post({{"X-Sesame-Token", std::string(32, '0')}}, edge)->status == 403);
  CHECK(served.post({{"X-Sesame-Token", token + "0"}}, edge)->status == 403);
  CHECK(served.post({{"X-Sesame-Token", token}, {"Origin", "http://elsewhere.example"}}, edge)->status == 403);
  CHECK(served.post({{"X-Sesame-Token", token}, {"Origin", "null"}}, edge)->status == 403);
  CHECK(served.post({{"X-Sesame-Token", token}, {"Host", "elsewhere.example"}}, edge)->status == 403);
  const auto done = served.post({{"X-Sesame-Token", token}, {"Origin", served.address()}}, edge);
  CHECK(done->status == 200);
  CHECK(json::parse(done->body) == json{{"taken", 1}});
  const auto refused = served.post({{"X-Sesame-Token", token}}, "{\"op\":\"note\",\"text\":\"x\"}\n" + edge);
  CHECK(refused->status == 422);
  const json answer = json::parse(refused->body);
  CHECK(answer["taken"] == 1);
  CHECK(answer["line"] == 2);
  CHECK_THAT(answer["error"].get<std::string>(), Contains("\"e\""));
  CHECK(data_of(served.client().Get("/")->body)["steps"].size() == 2);
}

TEST_CASE("a server that was reached by a name of somebody else says nothing", "[live]") {
  const Served served(false);
  const std::string port = served.host().substr(served.host().find(':'));
  for (const std::string host : {"elsewhere.example", "127.0.0.1.elsewhere.example", "10.0.0.1"}) {
    const auto answer = served.client().Get("/", httplib::Headers{{"Host", host + port}});
    REQUIRE(answer);
    CHECK(answer->status == 403);
    CHECK_THAT(answer->body, !Contains("served"));
  }
  CHECK(served.client().Get("/", httplib::Headers{{"Host", "localhost" + port}})->status == 200);
  CHECK(served.client().Get("/", httplib::Headers{{"Host", "localhost"}})->status == 403);  // of another port
}

TEST_CASE("news are what is behind a place, and after that what comes", "[live]") {
  const Served served(true);
  const auto send = [&](const std::string& line) { return served.post({{"X-Sesame-Token", served.token()}}, line); };
  CHECK(send(edge)->status == 200);
  const auto first = news(served, "1/0/0/0", 1);
  REQUIRE(first.size() == 1);
  CHECK(first[0].first == "1/3/1/1");
  CHECK(first[0].second["title"] == "served");
  CHECK(first[0].second["steps"].size() == 1);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(send(R"({"op":"identify","pairs":[["e.0","e.1"]]})")->status == 200);
  });
  const auto second = news(served, first[0].first, 1);
  later.join();
  REQUIRE(second.size() == 1);
  CHECK(second[0].first == "1/3/2/2");
  CHECK(second[0].second["steps"][0]["betti"] == json{1, 1});
  CHECK(second[0].second["cells"]["names"].empty());
  CHECK(second[0].second["classes"].size() == 1);
}

TEST_CASE("who is at a place that is not there is told to begin again", "[live]") {
  const Served served(false);
  for (const char* place : {"7/0/0/0", "1/9/0/0", "1/0/9/0", "1/0/0/9"}) {
    const auto told = news(served, place, 1);
    REQUIRE(told.size() == 1);
    CHECK(told[0].first == "other");
  }
  for (const char* place : {"", "x", "1", "1/2", "1/2/x", "1/2/3", "1/2/3/", "99999999999999999999/0/0/0"}) {
    CHECK(served.client().Get(std::string{"/events?after="} + place)->status == 400);
  }
}

TEST_CASE("when the replay has ended, its pages are told", "[live]") {
  Served served(true);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    served.stop();
  });
  const auto told = news(served, "1/0/0/0", 1);
  later.join();
  REQUIRE(told.size() == 1);
  CHECK(told[0].first == "ended");
  CHECK(served.client().Get("/")->status == 503);
  CHECK(served.post({{"X-Sesame-Token", served.token()}}, edge)->status == 503);
}

}  // namespace sesame::tools
