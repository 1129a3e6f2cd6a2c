#include "replay/tower/group_sequence.hpp"

#include <fmt/format.h>

#include <utility>

#include "replay/script/groups.hpp"

namespace sesame::replay {

void GroupSequence::add(engine::Time time, const engine::Homology& homology, const sparse::AnyRing& ring) {
  if (present_ && present_->time != time) {
    finish();
  }
  if (!homology.betti.empty() && !dimensions_.have(homology.betti.size() - 1)) {
    engine::Homology kept = homology;
    kept.betti.resize(dimensions_.last + 1);
    kept.torsion.resize(dimensions_.last + 1);
    add(time, kept, ring);
    return;
  }
  Change& change = present_.emplace(Change{time, {homology.betti.begin(), homology.betti.end()}, homology.torsion});
  while (!change.ranks.empty() && change.ranks.back() == 0 && change.torsion.back().empty()) {
    change.ranks.pop_back();
    change.torsion.pop_back();
  }
  if (lines_ != nullptr) {
    line_ = fmt::format("{:>10}  {}\n", number_text(time), homology_line(homology, ring));
  }
}

void GroupSequence::finish() {
  const std::optional<Change> change = std::exchange(present_, std::nullopt);
  if (!change ||
      (!changes_.empty() && changes_.back().ranks == change->ranks && changes_.back().torsion == change->torsion)) {
    return;
  }
  if (lines_ != nullptr) {
    *lines_ << line_;
    changes_.clear();
  }
  changes_.push_back(*change);
}

void GroupSequence::add_json(TextBuffer& text) const {
  text.add('[');
  for (std::size_t at = 0; at < changes_.size(); ++at) {
    const Change& change = changes_[at];
    text.add(at == 0 ? "[" : ",[").add_json_number(change.time).add(",[");
    for (std::size_t p = 0; p < change.ranks.size(); ++p) {
      text.add(p == 0 ? R"({"rank":)" : R"(,{"rank":)").add_integer(change.ranks[p]).add(R"(,"torsion":[)");
      for (std::size_t k = 0; k < change.torsion[p].size(); ++k) {
        text.add(k == 0 ? "" : ",").add(change.torsion[p][k].to_string());
      }
      text.add("]}");
    }
    text.add("]]");
  }
  text.add(']');
}

std::string EngineTower::name(std::uint64_t label) const {
  const std::uint64_t uses = uses_.at(label);
  return uses == 1 ? std::to_string(label) : fmt::format("{}#{}", label, uses);
}

ops::VertexId EngineTower::vertex(std::uint64_t label) const {
  if (!uses_.contains(label)) {
    return ops::none;
  }
  const ops::AbstractComplex& complex = engine_.structure().abstract();
  const ops::LabelId known = complex.label(name(label));
  return known == ops::none || complex.is_contracted(known) ? ops::none : complex.vertex(known);
}

ops::TowerRules EngineTower::rules() const {
  return {engine_.structure().abstract().simplices(), [this](std::uint64_t label) { return vertex(label); }};
}

Status EngineTower::apply(const TowerOperation& operation) {
  const bool is_inclusion = operation.kind == TowerOperation::Kind::insert;
  if (const Status status = is_inclusion ? rules().check_inclusion(operation.labels)
                                         : rules().check_contraction(operation.labels[0], operation.labels[1]);
      !status) {
    return told(status.error());
  }
  ops::Operation step;
  if (is_inclusion) {
    if (operation.dimension == 0) {
      ++uses_[operation.labels[0]];
    }
    std::vector<std::string> simplex;
    for (const std::uint64_t label : operation.labels) {
      simplex.push_back(name(label));
    }
    step = ops::Insert{{std::move(simplex)}};
  } else {
    step = ops::Collapse{name(operation.labels[0]), name(operation.labels[1])};
  }
  const Result<engine::StepReport> report = engine_.apply(std::move(step));
  return report ? Status{Done{}} : Status{report.error()};
}

}  // namespace sesame::replay
