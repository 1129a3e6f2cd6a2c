#include "tools/live/server_address.hpp"

#include <charconv>

#include "sparse/quoted.hpp"

namespace sesame::tools {

std::string ServerAddress::text() const {
  const bool is_long = host.find(':') != std::string::npos;
  return (is_long ? '[' + host + ']' : host) + ':' + std::to_string(port);
}

Result<ServerAddress> parse_server_address(std::string_view text) {
  const auto wrong = [&] {
    return Error{Errc::bad_input, sparse::quoted(text) +
                                      " should be a port, from 0 (any that is free) to 65535, or an address of this "
                                      "machine and a port: 8080, 127.0.0.1:8080, [::1]:8080"};
  };
  ServerAddress address;
  std::string_view port = text;
  if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    std::string_view host = text.substr(0, colon);
    port = text.substr(colon + 1);
    const bool is_bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
    if (is_bracketed) {
      host = host.substr(1, host.size() - 2);
    }
    constexpr std::string_view digits = "0123456789.";
    constexpr std::string_view long_digits = "0123456789abcdefABCDEF:.";
    if (host.empty() || host.find_first_not_of(is_bracketed ? long_digits : digits) != std::string_view::npos) {
      return wrong();
    }
    address.host = host;
  }
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (error != std::errc{} || end != port.data() + port.size() || port.empty() || address.port < 0 ||
      address.port > 65535) {
    return wrong();
  }
  return address;
}

}  // namespace sesame::tools
