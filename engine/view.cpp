#include "engine/view.hpp"

#include <stdexcept>

#include "engine/engine.hpp"
#include "sparse/archive_memory.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

View::View(std::uint64_t steps, const ObjectTerms& terms, const RebasePolicy& rebases, std::vector<std::uint64_t> cells)
    : steps_{steps}, terms_{terms}, rebases_{rebases}, cells_{std::move(cells)} {}

View::~View() = default;

Result<std::shared_ptr<const View>> View::of(const Engine& engine) {
  const LiveObject& object = engine.object();
  const auto counts = object.cells();
  const std::shared_ptr<View> view{new View(object.applied(), {engine.ring_, engine.limits_, engine.history_.undoable},
                                            engine.rebases_, {counts.begin(), counts.end()})};
  if (const Status worth = check_worth(object); worth) {
    sparse::ArchiveWriter to(sparse::sink_into(view->archive_));
    object.save(to, LiveObject::Reduction::left_out);
    if (Status written = to.finish(); !written) {
      return written.error();
    }
  } else if (engine.history_.keeps_log) {
    view->its_steps_.assign(engine.log_.begin(), engine.log_.end());
  } else {
    return Error{Errc::refused,
                 "there is no view of an object most of whose cells are in products and cones that "
                 "are not written out, without its log in memory"};
  }
  return std::shared_ptr<const View>{view};
}

std::unique_ptr<LiveObject> View::made() const {
  auto object = std::make_unique<LiveObject>(terms_.ring, terms_.limits, rebases_, terms_.undoable);
  if (archive_.empty()) {
    for (const ops::Operation& step : its_steps_) {
      const Result<StepReport> report = object->apply(step, [](const ops::Operation&) { return Done{}; });
      sparse::expects(report.has_value(), "a step that happened once happens again");
    }
    return object;
  }
  sparse::ArchiveReader from(sparse::source_of(archive_), archive_.size());
  object->load(from);
  if (const Status whole = from.finish(); !whole) {
    throw std::logic_error("a view cannot read its own object: " + whole.error().what);
  }
  object->begin_equivalence();
  return object;
}

/// Asks the object, which is made when it is not there; what is cut off by an exception gives it up.
template <class Question>
auto View::ask(Question&& question) const {
  const std::lock_guard lock(asking_);
  sparse::expects(!is_asked_, "a view is asked nothing from within an answer of its own");
  struct Asking {
    explicit Asking(bool& is_asked) : is_asked_{is_asked} { is_asked_ = true; }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;
    ~Asking() { is_asked_ = false; }
    bool& is_asked_;
  };
  const Asking asking(is_asked_);
  try {
    if (object_ == nullptr) {
      object_ = made();
    }
    return question(*object_);
  } catch (...) {
    object_.reset();
    throw;
  }
}

Homology View::homology() const {
  return ask([](LiveObject& object) { return object.homology(); });
}

Result<CellChain> View::chain(const std::vector<std::pair<Integer, std::string>>& terms) const {
  return ask([&](LiveObject& object) { return object.chain(terms); });
}

std::vector<Generator> View::generators(int degree) const {
  return ask([&](LiveObject& object) { return object.tracker().generators(degree); });
}

void View::visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) const {
  ask([&](LiveObject& object) { object.visit_generators(degree, most_terms, visit); });
}

ClassAnswer View::classify(const CellChain& chain) const {
  return ask([&](LiveObject& object) { return object.tracker().classify(chain); });
}

void View::look_at_cells(const std::function<void(const ops::Structure&)>& look) const {
  ask([&](LiveObject& object) { look(object.structure()); });
}

std::optional<std::string> View::first_defect() const {
  return ask([](LiveObject& object) { return object.first_defect(); });
}

}  // namespace sesame::engine
