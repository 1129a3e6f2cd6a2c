/// \file
/// The pages of `sesame replay`: one that is written, or those that are served.
#pragma once

#include <memory>
#include <ostream>

#include "ops/vocabulary/operation.hpp"
#include "replay/page/page_history.hpp"
#include "replay/script/replay.hpp"
#include "tools/commands/output_file.hpp"
#include "tools/commands/replay_arguments.hpp"
#include "tools/live/live_server.hpp"

namespace sesame::tools {

/// The page that is written beside the replay, if one is wanted.
class PageOutput {
 public:
  /// `arguments` outlive it.
  explicit PageOutput(const ReplayArguments& arguments);

  /// Before the replay.
  Status open(replay::ReplayOptions& options);
  /// After it, when it has come to an end.
  Status write(bool is_interrupted);

 private:
  const ReplayArguments& arguments_;
  OutputFiles files_;
  std::ostream* out_ = nullptr;
  ops::Header header_;
  replay::PageHistory history_{replay::PageLimits{}};
};

/// The pages that look at the replay, if they are wanted.
class LivePages {
 public:
  /// Once, before the first replay: begins to listen, and says where. Errors: bad_input, io.
  Status start(const ReplayArguments& arguments);
  /// Before each replay. `arguments` outlive it.
  void open(const ReplayArguments& arguments, replay::ReplayOptions& options);

 private:
  ops::Header header_;
  std::unique_ptr<LiveServer> server_;
};

}  // namespace sesame::tools
