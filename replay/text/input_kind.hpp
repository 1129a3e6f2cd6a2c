/// \file
/// What an input is that was given to the wrong command.
#pragma once

#include <string>
#include <string_view>

namespace sesame::replay {

/// Which command an input is for, told from its first bytes or else from its name: " (it looks like a tower, which
/// `sesame tower` reads)", for the end of a sentence by which `command` refuses it. Empty when it looks like nothing
/// known, or like something for `command` itself ("sesame replay").
[[nodiscard]] std::string advice_on(std::string_view beginning, std::string_view name, std::string_view command);

}  // namespace sesame::replay
