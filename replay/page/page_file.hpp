/// \file
/// Pages as files: one program in the browser for all of them (replay/page/src), which does what its data are for.
#pragma once

#include <cstdint>
#include <ostream>
#include <string_view>

namespace sesame::replay {

/// Where a page comes from: one from a server may ask that server, and nobody else, for more.
enum class PageFrom : std::uint8_t { disk, server };

/// Writes a page: one file of HTML that needs no other and asks for none. `data`: a JSON object whose `kind` says which
/// page it is, "replay", "tower" or "mesh". What its texts contain cannot end the element that it stands in.
void write_page_file(std::ostream& out, std::string_view data, PageFrom from = PageFrom::disk);

}  // namespace sesame::replay
