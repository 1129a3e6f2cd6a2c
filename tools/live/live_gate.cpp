#include "tools/live/live_gate.hpp"

#include <fmt/format.h>

#include <random>
#include <utility>

namespace sesame::tools {
namespace {

/// 128 random bits, which nobody guesses.
std::string make_token() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 4; ++k) {
    token += fmt::format("{:08x}", random());
  }
  return token;
}

}  // namespace

LiveGate::LiveGate(ServerAddress address, bool is_writable)
    : address_{std::move(address)}, token_{is_writable ? make_token() : ""} {}

std::string LiveGate::url() const {
  return "http://" + address_.text() + "/" + (is_writable() ? "?token=" + token_ : "");
}

std::optional<std::string> LiveGate::refusal(std::string_view host, std::string_view origin) const {
  if (!is_our_name(host)) {
    return "this server is reached by its address only, such as http://" + address_.text() + "/";
  }
  if (!origin.empty() && origin != fmt::format("http://{}", host)) {
    return "only pages of this server may ask it for anything";
  }
  return std::nullopt;
}

bool LiveGate::has_token(std::string_view text) const {
  if (!is_writable() || text.size() != token_.size()) {
    return false;
  }
  unsigned difference = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    difference |= static_cast<unsigned char>(text[k]) ^ static_cast<unsigned char>(token_[k]);
  }
  return difference == 0;
}

bool LiveGate::is_our_name(std::string_view name) const {
  const std::string port = fmt::format(":{}", address_.port);
  const bool has_port = name.ends_with(port);
  if (!has_port && address_.port != 80) {
    return false;
  }
  const std::string_view host = has_port ? name.substr(0, name.size() - port.size()) : name;
  const std::string own = address_.text();
  if (host == std::string_view{own}.substr(0, own.size() - port.size()) ||
      (is_local() && (host == "localhost" || host == "127.0.0.1"))) {
    return true;
  }
  // Where it listens on all addresses of the machine, any that is a number: no number is somebody's name.
  const bool is_everywhere = address_.host == "0.0.0.0" || address_.host == "::";
  return is_everywhere && (host == "localhost" || host.starts_with('[') ||
                           host.find_first_not_of("0123456789.") == std::string_view::npos);
}

}  // namespace sesame::tools
