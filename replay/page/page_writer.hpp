/// \file
/// A replay as one page: the object in space after each step, its groups, its generators.
#pragma once

#include <atomic>
#include <ostream>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "replay/page/page_history.hpp"
#include "replay/page/vertex_places.hpp"

namespace sesame::replay {

/// What a page says of where it comes from.
struct PageHead {
  std::string title;
  std::string source;                       ///< the name of the script
  std::string notes;                        ///< what else is to be said of the replay, if anything
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: no more generators after the one at hand
};

/// The data of a page, as JSON. Generators are those of the engine as it is now, after the last step of the history.
/// Cost: what the page shows, and that of the generators, both within the limits of the history.
[[nodiscard]] std::string page_data(PageHistory& history, engine::Engine& engine, const PageHead& head);

/// How much of a history a page has already.
struct PagePart {
  std::uint32_t cells = 0;
  std::size_t steps = 0;
  std::size_t classes = 0;
  std::vector<VertexPlace> places;
};

/// What a page that has `seen` lacks, as JSON: the cells and steps behind those, places that are new or other ones, the
/// generators of the object now, and what is said of it all. `seen` is all of the history then.
[[nodiscard]] std::string page_news(PageHistory& history, engine::Engine& engine, const PageHead& head, PagePart& seen);

/// The page: one file of HTML that needs no other and asks for none.
void write_page(std::ostream& out, PageHistory& history, engine::Engine& engine, const PageHead& head);

}  // namespace sesame::replay
