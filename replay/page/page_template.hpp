/// \file
/// The page without data: replay/page/bundle/page.html, which is made from replay/page/src by build.mjs.
#pragma once

#include <span>
#include <string_view>

namespace sesame::replay {

/// Its text, in pieces, one after the other. One of them, or two, have the mark in them where the data go.
[[nodiscard]] std::span<const std::string_view> page_template();

/// The mark.
inline constexpr std::string_view page_data_mark = "@SESAME_PAGE_DATA@";

}  // namespace sesame::replay
