/// \file
/// Who may ask a server of pages for what.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/live/server_address.hpp"

namespace sesame::tools {

/// A page of another site can make a browser ask us, also under a name of its own that leads here. So a request has to
/// name this server as its host, by number, and to come from a page of this server or from none; and steps are taken
/// from who has the token, which no other site knows.
class LiveGate {
 public:
  LiveGate(ServerAddress address, bool is_writable);

  [[nodiscard]] const ServerAddress& address() const { return address_; }
  /// The port that it got.
  void set_port(int port) { address_.port = port; }
  [[nodiscard]] bool is_writable() const { return !token_.empty(); }
  /// Whether it can be reached from this machine only.
  [[nodiscard]] bool is_local() const { return address_.host.starts_with("127.") || address_.host == "::1"; }
  /// What to open in a browser, with the token if there is one.
  [[nodiscard]] std::string url() const;
  /// Why a request with these headers is none for us, if it is not; `origin` may be empty.
  [[nodiscard]] std::optional<std::string> refusal(std::string_view host, std::string_view origin) const;
  /// Whether this is the token. It takes as long for any text of its length.
  [[nodiscard]] bool has_token(std::string_view text) const;

 private:
  [[nodiscard]] bool is_our_name(std::string_view host) const;

  ServerAddress address_;
  std::string token_;
};

}  // namespace sesame::tools
