/// \file
/// A replay that pages look at while it goes on.
#pragma once

#include <string>

#include "replay/page/page_history.hpp"
#include "replay/page/page_writer.hpp"
#include "replay/script/shared_replay.hpp"

namespace sesame::tools {

/// What a server shows.
///
/// Threads: `shared` has turns, and who has one may use the rest.
struct LiveReplay {
  explicit LiveReplay(std::string source, const std::atomic<bool>* stop) : head{"", std::move(source), "", stop} {}

  replay::SharedReplay shared;
  replay::PageHistory history{replay::PageLimits{}};
  replay::PageHead head;
};

}  // namespace sesame::tools
