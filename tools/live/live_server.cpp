#include "tools/live/live_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <mutex>
#include <new>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

#include "ops/vocabulary/json_text.hpp"
#include "replay/page/page_file.hpp"
#include "tools/live/live_gate.hpp"

namespace sesame::tools {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t most_bytes_of_steps = std::size_t{1} << 26;
constexpr std::size_t threads = 24;
/// Each has a thread; the others are for who comes next.
constexpr int most_listeners = 16;
constexpr milliseconds step_of_waiting{100};
constexpr std::chrono::seconds time_of_silence{10};
/// Between two pieces of news: so often at most, and so many times as long as the last one took.
constexpr milliseconds least_pause{80};
constexpr int share_of_pause = 4;

std::string error_json(std::string_view what) {
  std::string text;
  ops::JsonText out(text);
  out.begin_object();
  out.field("error", what);
  out.end_object();
  return text;
}

constexpr std::string_view waiting_page =
    "<!DOCTYPE html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"1\"><title>sesame</title>"
    "<p>There is no object yet: the script has not begun. This page looks again each second.</p>";

}  // namespace

/// What is done with requests. Its threads may be anywhere in it, but for `show`, at the same time.
class LiveServer::Handlers {
 public:
  Handlers(ServerAddress address, bool is_writable) : gate_{std::move(address), is_writable} {
    server_.new_task_queue = [] { return new httplib::ThreadPool(threads); };  // which the library deletes
    server_.set_keep_alive_timeout(1);
    server_.set_payload_max_length(most_bytes_of_steps);
    // Not the library's own, with which two servers can share a port, each with some of the requests.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"Content-Security-Policy", "frame-ancestors 'none'"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Referrer-Policy", "no-referrer"},  // the address has the token in it
                                 {"X-Content-Type-Options", "nosniff"}});
    using httplib::Request;
    using httplib::Response;
    server_.set_pre_routing_handler([this](const Request& request, Response& response) {
      return is_for_us(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                          : httplib::Server::HandlerResponse::Handled;
    });
    server_.Get("/", [this](const Request&, Response& response) { answer_with_page(response); });
    server_.Get("/events", [this](const Request& request, Response& response) { answer_with_news(request, response); });
    server_.Post("/steps", [this](const Request& request, Response& response) { take_steps(request, response); });
  }

  ~Handlers() {
    is_ending_ = true;
    server_.stop();
    if (listener_.joinable()) {
      listener_.join();
    }
  }

  Status listen() {
    const ServerAddress& address = gate_.address();
    errno = 0;
    const int port = address.port == 0                                  ? server_.bind_to_any_port(address.host)
                     : server_.bind_to_port(address.host, address.port) ? address.port
                                                                        : -1;
    if (port < 0) {
      const std::string why = errno != 0 ? std::string{": "} + std::strerror(errno) : "";
      return Error{Errc::io, "cannot listen on " + address.text() + why};
    }
    gate_.set_port(port);
    listener_ = std::thread([this] {
      server_.listen_after_bind();
      has_ended_ = true;
    });
    while (!server_.is_running() && !has_ended_) {  // one that does not run yet cannot be stopped
      std::this_thread::sleep_for(milliseconds(1));
    }
    return Done{};
  }

  void show(std::shared_ptr<LiveReplay> replay) {
    const std::lock_guard lock(shown_);
    replay_ = std::move(replay);
    ++session_;
  }

  [[nodiscard]] const LiveGate& gate() const { return gate_; }

 private:
  /// How far a page is that asks for news: "session/cells/steps/classes".
  struct Place {
    std::uint64_t session = 0;
    replay::PagePart seen;

    static std::optional<Place> parse(std::string_view text) {
      std::array<std::uint64_t, 4> numbers{};
      for (std::uint64_t& number : numbers) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc{}) {
          return std::nullopt;
        }
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (!text.empty()) {
          text.remove_prefix(1);
        }
      }
      Place place;
      place.session = numbers[0];
      place.seen.cells = static_cast<std::uint32_t>(numbers[1]);
      place.seen.steps = numbers[2];
      place.seen.classes = numbers[3];
      return place;
    }
    [[nodiscard]] std::string text() const {
      return fmt::format("{}/{}/{}/{}", session, seen.cells, seen.steps, seen.classes);
    }
  };

  struct Shown {
    std::shared_ptr<LiveReplay> replay;
    std::uint64_t session;
  };

  [[nodiscard]] Shown shown() {
    const std::lock_guard lock(shown_);
    return {replay_, session_};
  }

  bool is_for_us(const httplib::Request& request, httplib::Response& response) const {
    const std::optional<std::string> refusal =
        gate_.refusal(request.get_header_value("Host"), request.get_header_value("Origin"));
    if (refusal) {
      refuse(response, 403, *refusal);
    }
    return !refusal;
  }

  static void refuse(httplib::Response& response, int status, const std::string& what) {
    response.status = status;
    response.set_content(error_json(what), "application/json");
  }

  void answer_with_page(httplib::Response& response) {
    const Shown now = shown();
    std::string data;
    const bool is_there = now.replay != nullptr && now.replay->shared.look([&](engine::Engine& engine) {
      replay::PageHistory& history = now.replay->history;
      data = replay::page_data(history, engine, now.replay->head);
      std::string live;
      ops::JsonText out(live);
      out.begin_object();
      out.key("live");
      out.begin_object();
      out.field("writable", gate_.is_writable());
      const Place place{now.session,
                        {history.cells().size(), history.steps().size(), history.generators().classes().size(), {}}};
      out.field("place", place.text());
      out.end_object();
      out.end_object();
      live.back() = ',';
      data.replace(0, 1, live);  // the two objects become one
    });
    if (!is_there) {
      response.status = 503;
      response.set_content(std::string{waiting_page}, "text/html; charset=utf-8");
      return;
    }
    std::ostringstream page;
    replay::write_page_file(page, data, replay::PageFrom::server);
    response.set_content(std::move(page).str(), "text/html; charset=utf-8");
  }

  void answer_with_news(const httplib::Request& request, httplib::Response& response) {
    // A browser that lost the connection says how far it came.
    const std::string last = request.get_header_value("Last-Event-ID");
    const std::optional<Place> place = Place::parse(last.empty() ? request.get_param_value("after") : last);
    if (!place) {
      refuse(response, 400, "/events wants after=SESSION/CELLS/STEPS/CLASSES, as the page has it");
      return;
    }
    if (listeners_.fetch_add(1) >= most_listeners) {
      --listeners_;
      refuse(response, 503, "too many pages of this replay are open");
      return;
    }
    const auto teller = std::make_shared<Teller>(*this, *place);
    response.set_chunked_content_provider(
        "text/event-stream", [teller](std::size_t, httplib::DataSink& sink) { return teller->tell(sink); },
        [this](bool) { --listeners_; });
  }

  /// Tells one page what is new, again and again.
  class Teller {
   public:
    Teller(Handlers& server, Place place) : server_{server}, place_{std::move(place)} {}

    /// One piece of news, or a sign of life. False ends the connection.
    bool tell(httplib::DataSink& sink) {
      try {
        return tell_next(sink);
      } catch (const std::bad_alloc&) {
        return false;  // the page comes again
      }
    }

   private:
    bool tell_next(httplib::DataSink& sink) {
      const auto start = Clock::now();
      while (!server_.is_ending_ && sink.is_writable()) {
        if (Clock::now() >= next_) {
          if (const std::string news = this->news(); !news.empty()) {
            return sink.write(news.data(), news.size());
          }
        }
        if (Clock::now() - start > time_of_silence) {
          constexpr std::string_view sign_of_life = ": still here\n\n";
          return sink.write(sign_of_life.data(), sign_of_life.size());
        }
        wait();
      }
      return false;
    }

    void wait() {
      if (Clock::now() < next_ || replay_ == nullptr) {
        std::this_thread::sleep_for(step_of_waiting / 4);
      } else {
        (void)replay_->shared.wait_for_other(revision_, step_of_waiting);
      }
    }

    std::string news() {
      const Shown now = server_.shown();
      if (now.session != place_.session) {
        return other();
      }
      replay_ = now.replay;
      const std::uint64_t revision = replay_->shared.revision();
      if (revision == revision_) {
        return "";
      }
      const auto start = Clock::now();
      std::string data;
      const bool is_there = replay_->shared.look([&](engine::Engine& engine) {
        replay::PageHistory& history = replay_->history;
        if (place_.seen.cells > history.cells().size() || place_.seen.steps > history.steps().size() ||
            place_.seen.classes > history.generators().classes().size()) {
          data = "other";
        } else if (place_.seen.steps < history.steps().size()) {
          data = replay::page_news(history, engine, replay_->head, place_.seen);
        }
      });
      revision_ = revision;
      next_ = Clock::now() + std::max<Clock::duration>(least_pause, (Clock::now() - start) * share_of_pause);
      if (!is_there) {
        return "event: ended\ndata: the replay has ended\n\n";
      }
      if (data == "other") {
        return other();
      }
      return data.empty() ? "" : fmt::format("id: {}\ndata: {}\n\n", place_.text(), data);
    }

    /// The page loads again.
    std::string other() {
      next_ = Clock::now() + std::chrono::seconds(1);
      return "event: other\ndata: another replay\n\n";
    }

    Handlers& server_;
    Place place_;
    std::shared_ptr<LiveReplay> replay_;
    std::uint64_t revision_ = 0;  // of no replay: there is one from its beginning on
    Clock::time_point next_ = Clock::now();
  };

  void take_steps(const httplib::Request& request, httplib::Response& response) {
    if (!gate_.is_writable()) {
      refuse(response, 403, "this replay takes no steps from pages: it was started without --writable");
      return;
    }
    // A header of its own: no page of another site can send one without being asked first.
    if (!gate_.has_token(request.get_header_value("X-Sesame-Token"))) {
      refuse(response, 403, "steps are taken from who has the token of the address that sesame printed");
      return;
    }
    const Shown now = shown();
    const std::optional<replay::SharedReplay::Taken> taken =
        now.replay != nullptr ? now.replay->shared.take(request.body) : std::nullopt;
    if (!taken) {
      refuse(response, 503, "there is no object: the script has not begun, or has ended");
      return;
    }
    std::string text;
    ops::JsonText out(text);
    out.begin_object();
    out.field("taken", taken->steps);
    if (taken->refusal) {
      out.field("line", taken->refusal->line);
      out.field("error", taken->refusal->what);
      response.status = 422;
    }
    out.end_object();
    response.set_content(text, "application/json");
  }

  LiveGate gate_;
  httplib::Server server_;
  std::thread listener_;
  std::atomic<bool> is_ending_ = false, has_ended_ = false;
  std::atomic<int> listeners_ = 0;
  std::mutex shown_;
  std::shared_ptr<LiveReplay> replay_;  ///< guarded by shown_, as the next one is
  std::uint64_t session_ = 0;
};

LiveServer::LiveServer(std::unique_ptr<Handlers> handlers) : handlers_{std::move(handlers)} {}
LiveServer::~LiveServer() = default;

Result<std::unique_ptr<LiveServer>> LiveServer::start(const ServerAddress& address, bool is_writable) {
  auto handlers = std::make_unique<Handlers>(address, is_writable);
  if (const Status listening = handlers->listen(); !listening) {
    return listening.error();
  }
  return std::unique_ptr<LiveServer>(new LiveServer(std::move(handlers)));
}

void LiveServer::show(std::shared_ptr<LiveReplay> replay) { handlers_->show(std::move(replay)); }
std::string LiveServer::url() const { return handlers_->gate().url(); }
bool LiveServer::is_local() const { return handlers_->gate().is_local(); }

}  // namespace sesame::tools
