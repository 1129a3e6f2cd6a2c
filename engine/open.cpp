#include "engine/open.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

#include "engine/answer_hash.hpp"

namespace sesame::engine {
namespace {

/// A log while its steps are taken: nothing is written, but what was taken can be read once more.
class LogBeingTaken final : public StepLog {
 public:
  LogBeingTaken(std::shared_ptr<LogWriter> log, std::uint64_t steps) : log_{std::move(log)}, steps_{steps} {}

  Status append(const ops::Operation& /*operation*/) override {
    ++steps_;
    return Done{};
  }
  void confirm() noexcept override {}
  Status take_back() override {
    --steps_;
    return Done{};
  }
  Status bind(std::uint64_t /*state*/, bool /*syncs*/) override { return Done{}; }
  [[nodiscard]] bool can_be_read_back() const override { return true; }
  Status read_back(const std::function<Status(ops::Operation)>& accept) override {
    return read_steps(log_->file(), log_->name(), steps_, accept);
  }

 private:
  std::shared_ptr<LogWriter> log_;
  std::uint64_t steps_;
};

}  // namespace

Status check_binding(Engine& engine, const Binding& binding) {
  if (binding.state == answer_hash(engine.cells(), engine.homology())) {
    return Done{};
  }
  return Error{Errc::law_broken,
               fmt::format("the homology after step {} is not the one that the log was bound to: it was "
                           "written by another version, or one of the two is wrong",
                           binding.steps)};
}

Result<std::unique_ptr<LogSnapshots>> resume_from_snapshot(Engine& engine, LogReader& reader,
                                                           std::shared_ptr<LogWriter> log, const ObjectTerms& terms,
                                                           const RebasePolicy& rebases) {
  const std::string name = log->name();
  auto snapshots = std::make_unique<LogSnapshots>(log, terms);
  Result<std::unique_ptr<LiveObject>> object = read_log_snapshot(name, reader, terms, rebases);
  if (!object) {
    return object.error();
  }
  if (*object != nullptr) {
    const std::uint64_t snapshots_steps = (*object)->applied();
    snapshots->begin_with(snapshots_steps);
    engine.resume(std::move(*object));
    engine.write_to(std::make_shared<LogBeingTaken>(std::move(log), snapshots_steps));
  }
  return snapshots;
}

Status take_steps(Engine& engine, LogReader& reader, const std::function<bool()>& goes_on) {
  while (true) {
    Result<std::optional<LogReader::Entry>> entry = reader.next();
    if (!entry) {
      return entry.error();
    }
    if (!*entry) {
      return Done{};
    }
    if (const auto* binding = std::get_if<Binding>(&**entry)) {
      if (const Status bound = check_binding(engine, *binding); !bound) {
        return Error{bound.error().code, reader.place() + bound.error().what};
      }
      continue;
    }
    if (const auto report = engine.apply(std::get<ops::Operation>(std::move(**entry))); !report) {
      return Error{report.error().code, reader.place() + report.error().what};
    }
    if (!goes_on()) {
      return Done{};
    }
  }
}

Result<OpenedLog> Engine::open(const std::string& path, const OpenOptions& options) {
  int error = 0;
  std::unique_ptr<File> file = options.disk->open(path, Disk::Mode::write, error);
  const bool is_new = file == nullptr && error == ENOENT;
  if (is_new) {
    file = options.disk->open(path, Disk::Mode::create, error);
  }
  if (file == nullptr) {
    return cannot_write_file(path, error);
  }
  if (const Status locked = lock_log(*file, path); !locked) {
    return locked.error();
  }
  OpenedLog opened;
  opened.log = std::make_shared<LogWriter>(std::move(file), path, options.sync);
  LogReader reader(path, opened.log->file());
  const Result<std::optional<ops::Header>> found = reader.header();
  if (!found) {
    return found.error();
  }
  opened.header = found->value_or(options.header);
  const Result<sparse::AnyRing> ring = sparse::parse_ring(opened.header.ring);
  if (!ring) {
    return Error{ring.error().code, reader.place() + ring.error().what};
  }
  opened.engine = std::make_unique<Engine>(*ring, options.limits, options.rebases, options.history, options.resources);
  std::unique_ptr<LogSnapshots> snapshots;
  if (*found && options.has_snapshots && options.disk == &real_disk()) {
    Result<std::unique_ptr<LogSnapshots>> resumed = resume_from_snapshot(
        *opened.engine, reader, opened.log, {*ring, options.limits, options.history.undoable}, options.rebases);
    if (!resumed) {
      return resumed.error();
    }
    snapshots = std::move(*resumed);
  } else if (options.has_snapshots && options.disk == &real_disk()) {
    snapshots =
        std::make_unique<LogSnapshots>(opened.log, ObjectTerms{*ring, options.limits, options.history.undoable});
  }
  if (*found) {
    if (Status taken = take_steps(*opened.engine, reader, [] { return true; }); !taken) {
      return taken.error();
    }
  }
  opened.steps = reader.position().steps();
  opened.torn = reader.torn();
  Status ready = opened.log->go_on(reader.position());
  if (ready && !*found) {
    ready = opened.log->begin(opened.header);
  }
  if (const int folder = is_new ? options.disk->sync_folder_of(path) : 0; ready && folder != 0) {
    ready = cannot_write_file(path, folder);
  }
  if (!ready) {
    return ready.error();
  }
  opened.engine->write_to(opened.log, std::move(snapshots));
  return opened;
}

}  // namespace sesame::engine
