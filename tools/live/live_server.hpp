/// \file
/// Pages of a replay that goes on, over HTTP.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "sparse/result.hpp"
#include "tools/live/live_replay.hpp"
#include "tools/live/server_address.hpp"

namespace sesame::tools {

/// Serves one page at `/`, which grows with the replay by server-sent events from `/events`, and takes steps at
/// `/steps` from who knows the token. Nobody but pages of its own may have it do anything: a request has to name this
/// server as its host, so no name that was made to point here will do, and come from a page of this server or from
/// none.
///
/// Threads: any. It has threads of its own, which end with it.
class LiveServer {
 public:
  /// Begins to listen. Errors: io when that cannot be.
  [[nodiscard]] static Result<std::unique_ptr<LiveServer>> start(const ServerAddress& address, bool is_writable);
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;
  ~LiveServer();

  /// From now on it shows this one; pages of another one begin anew.
  void show(std::shared_ptr<LiveReplay> replay);
  /// What to open in a browser, with the token when the page may write.
  [[nodiscard]] std::string url() const;
  /// Whether it can be reached from this machine only.
  [[nodiscard]] bool is_local() const;

 private:
  class Handlers;
  explicit LiveServer(std::unique_ptr<Handlers> handlers);

  std::unique_ptr<Handlers> handlers_;
};

}  // namespace sesame::tools
