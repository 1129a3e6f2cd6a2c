#include "tools/commands/log_input.hpp"

#include <algorithm>
#include <utility>

#include "engine/durable/disk.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {

engine::ReadBytes bytes_of(std::shared_ptr<replay::ByteSource> source) {
  return [source = std::move(source)](std::span<char> to) -> Result<std::size_t> {
    if (source->window().empty()) {
      const Result<bool> got = source->more();
      if (!got) {
        return got.error();
      }
    }
    const std::size_t count = std::min(to.size(), source->window().size());
    std::copy_n(source->window().begin(), count, to.begin());
    source->consume(count);
    return count;
  };
}

Result<engine::LogReader> open_log(const std::string& path, std::size_t longest_line) {
  Result<replay::ByteSource> source = replay::ByteSource::open(path, {&stop_requested()});
  if (!source) {
    return source.error();
  }
  const std::string name = source->name();
  return engine::LogReader(name, bytes_of(std::make_shared<replay::ByteSource>(std::move(*source))), longest_line);
}

Result<std::unique_ptr<engine::Engine>> engine_for(const ops::Header& header) {
  const Result<sparse::AnyRing> ring = sparse::parse_ring(header.ring);
  if (!ring) {
    return ring.error();
  }
  return std::make_unique<engine::Engine>(*ring, ops::Limits{}, engine::RebasePolicy{},
                                          engine::HistoryPolicy{UINT64_MAX, false});
}

Status salvage(const std::string& path, const engine::LogPosition& until, const std::string& to) {
  const Result<OutputPlace> place = find_place(to, {path});
  if (!place) {
    return place.error();
  }
  if (place->kind != OutputPlace::Kind::absent) {
    return cannot_write(to, "it is there already; what is salvaged goes into a new file");
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(path);
  if (!source) {
    return source.error();
  }
  OutputFiles outputs({path});
  const Result<std::ostream*> out = outputs.open(to);
  if (!out) {
    return out.error();
  }
  std::uint64_t left = until.bytes;
  while (left > 0) {
    if (source->window().empty()) {
      const Result<bool> got = source->more();
      if (!got) {
        return got.error();
      }
      if (!*got) {
        **out << '\n';  // the last line of a script, which has no end
        break;
      }
    }
    const std::size_t count = std::min<std::uint64_t>(left, source->window().size());
    (*out)->write(source->window().data(), static_cast<std::streamsize>(count));
    source->consume(count);
    left -= count;
  }
  return outputs.commit();
}

}  // namespace sesame::tools
