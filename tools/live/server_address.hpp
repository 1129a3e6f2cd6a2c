/// \file
/// Where a server listens.
#pragma once

#include <string>
#include <string_view>

#include "sparse/result.hpp"

namespace sesame::tools {

struct ServerAddress {
  std::string host = "127.0.0.1";  ///< a number, of IPv4 or of IPv6 without brackets
  int port = 0;                    ///< 0: any that is free

  /// The host as it stands in an address, and the port.
  [[nodiscard]] std::string text() const;
};

/// "8080", "127.0.0.1:8080", "[::1]:8080". Errors: bad_input.
[[nodiscard]] Result<ServerAddress> parse_server_address(std::string_view text);

}  // namespace sesame::tools
