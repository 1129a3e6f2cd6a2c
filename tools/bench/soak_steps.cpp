#include "tools/bench/soak_steps.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <numeric>

#include "ops/cells/lazy_cells.hpp"

namespace sesame::tools {
namespace {

/// Every eighth, and never the first.
bool is_abstract(std::uint32_t patch) { return patch % 8 == 7; }

}  // namespace

std::uint64_t sum_of(std::span<const std::uint64_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double processor_seconds() {
  timespec time{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

SoakSteps::SoakSteps(engine::Engine& engine, std::uint64_t cells, std::uint64_t seed)
    : engine_{engine},
      cells_{cells},
      draws_{seed},
      patches_(std::max<std::uint64_t>(1, cells / cells_of_patch)),
      removed_(patches_.size()) {}

template <class Call>
auto SoakSteps::timed(Call&& call) {
  const double start = processor_seconds();
  auto result = call();
  engine_seconds_ += processor_seconds() - start;
  return result;
}

bool SoakSteps::step() {
  patch_ = draws_.below(patches_.size());
  bounds_ = false;
  std::optional<ops::Operation> operation = draw();
  if (!operation) {
    return false;
  }
  const ops::Moment before = structure().now();
  const auto* undo = std::get_if<ops::Undo>(&*operation);
  std::optional<Returning> returning;
  if (undo != nullptr && undo->steps > 0 && undo->steps <= engine_.undoable()) {
    const ops::Moment target = engine_.before_step(engine_.undoable() - undo->steps + 1);
    returning = before_undo(target);
    drop_undone(target, before);
  }
  Count& count = counts_.try_emplace(std::string{ops::keyword(*operation)}).first->second;
  const auto report = timed([&] { return engine_.apply(*std::move(operation)); });
  if (!report) {
    ++count.refused;
    return false;
  }
  ++count.accepted;
  ++accepted_;
  if (bounds_ && !(report->answer && report->answer->is_zero && report->answer->bounds)) {
    defect_ = "a boundary was said to bound nothing";
  }
  if (report->renewed) {
    ++renewals_;
    find_all_cells();
  } else if (returning) {
    after_undo(*returning);
  } else {
    follow(before);
  }
  return true;
}

// ------------------------------------------------------------------------------------------ what becomes of the cells

bool SoakSteps::is_there(CellId cell) const {
  return cell < (ops::is_asked_for(cell) ? structure().cells().asked() : structure().cells().size()) &&
         structure().is_current(cell) && !structure().lazy().is_consumed(cell);
}

void SoakSteps::add(CellId cell, PatchId patch) {
  if (is_there(cell) &&
      place_.try_emplace(cell, Place{patch, static_cast<std::uint32_t>(patches_[patch].size())}).second) {
    patches_[patch].push_back(cell);
  }
}

void SoakSteps::remove(CellId cell) {
  const auto at = place_.find(cell);
  if (at == place_.end()) {
    return;
  }
  const auto [patch, position] = at->second;
  std::vector<CellId>& cells = patches_[patch];
  const CellId last = cells.back();
  cells[position] = last;
  cells.pop_back();
  place_.erase(at);
  if (last != cell) {
    place_[last].position = position;
  }
}

void SoakSteps::add_body(ops::BodyId body, PatchId patch) {
  for (const CellId cell : structure().lazy().cells_of(body)) {
    add(cell, patch);
  }
}

/// After cells have got other ids: bodies are put into patches anew.
void SoakSteps::find_all_cells() {
  place_.clear();
  for (std::vector<CellId>& cells : patches_) {
    cells.clear();
  }
  for (const ops::BodyId body : structure().bodies().current()) {
    const bool wants_abstract = structure().bodies().kind(body).is_abstract;
    std::optional<PatchId> best;
    for (PatchId patch = 0; patch < patches_.size(); ++patch) {
      if (is_abstract(patch) == wants_abstract && (!best || patches_[patch].size() < patches_[*best].size())) {
        best = patch;
      }
    }
    add_body(body, best.value_or(0));
  }
}

/// The patch of the cell that it is now. A cell of a factor is in none: then it is one that is no abstract complex.
SoakSteps::PatchId SoakSteps::patch_of(CellId cell) const {
  const auto at = place_.find(structure().values().of(cell).cell);
  return at != place_.end() ? at->second.patch : is_abstract(patch_) ? patch_ - 1 : patch_;
}

/// What a step has made and removed since a moment.
void SoakSteps::follow(const ops::Moment& before) {
  for (ops::LinkId link = before.links; link < structure().forest().links(); ++link) {
    const CellId removed = structure().forest().removed(link);
    remove(removed);
    if (!ops::is_asked_for(removed) && !structure().forest().deletions().contains(link)) {
      removed_[patch_] = {structure().directory().own_name(removed), accepted_};
    }
  }
  for (CellId cell = before.created; cell < structure().cells().size(); ++cell) {
    add(cell, patch_);
  }
  for (ops::FamilyId family = before.families; family < structure().lazy().families(); ++family) {
    drop_stale(patch_);
    add_body(structure().lazy().family(family).body, patch_);
  }
}

/// The cells of bodies that became factors.
void SoakSteps::drop_stale(PatchId patch) {
  const std::vector<CellId> cells = patches_[patch];
  for (const CellId cell : cells) {
    if (!is_there(cell)) {
      remove(cell);
    }
  }
}

SoakSteps::Returning SoakSteps::before_undo(const ops::Moment& target) const {
  Returning returning;
  for (ops::LinkId link = target.links; link < structure().forest().links(); ++link) {
    const CellId removed = structure().forest().removed(link);
    returning.cells.emplace_back(removed, patch_of(removed));
  }
  for (ops::FamilyId family = target.families; family < structure().lazy().families(); ++family) {
    const ops::LazyFamily& made = structure().lazy().family(family);
    const auto cells = structure().lazy().cells_of(made.body);
    for (const ops::BodyId body : made.bodies) {
      returning.bodies.emplace_back(body, patch_of(cells.front()));
    }
  }
  // Cells of older families that were asked for since then have to be asked for again.
  ops::FamilyId last = ops::none;
  for (CellId cell = target.asked; cell < structure().cells().asked(); ++cell) {
    if (const ops::LazyCell* lazy = structure().lazy().of(cell);
        lazy != nullptr && lazy->key.family < target.families && lazy->key.family != last) {
      last = lazy->key.family;
      returning.bodies.emplace_back(structure().lazy().family(last).body, patch_of(cell));
    }
  }
  return returning;
}

/// Before they go.
void SoakSteps::drop_undone(const ops::Moment& target, const ops::Moment& before) {
  for (CellId cell = target.created; cell < before.created; ++cell) {
    remove(cell);
  }
  for (CellId cell = target.asked; cell < structure().cells().asked(); ++cell) {
    remove(cell);
  }
}

void SoakSteps::after_undo(const Returning& returning) {
  for (const auto& [cell, patch] : returning.cells) {
    add(cell, patch);
  }
  for (const auto& [body, patch] : returning.bodies) {
    if (body < structure().bodies().size() && structure().bodies().consumed_by(body) == ops::none) {
      add_body(body, patch);
    }
  }
}

// --------------------------------------------------------------------------------------------------------------- draws

std::string SoakSteps::fresh(std::string_view prefix) { return std::string{prefix} + std::to_string(++names_); }

/// A cell of the patch, or none.
ops::CellId SoakSteps::pick() {
  while (!patches_[patch_].empty()) {
    const CellId cell = patches_[patch_][draws_.below(patches_[patch_].size())];
    if (is_there(cell)) {
      return cell;
    }
    remove(cell);
  }
  return ops::none;
}

std::optional<ops::Operation> SoakSteps::draw() {
  const std::size_t here = patches_[patch_].size();
  const bool is_large = sum_of(engine_.cells()) >= cells_ || here >= 2 * cells_of_patch;
  const std::uint32_t kind = draws_.below(1000);
  if (kind < 15) {
    return undo();
  }
  if (kind < 20) {
    return expectation();
  }
  if (kind < 35) {
    return question();
  }
  if (kind < 45) {
    return ops::Note{"patch " + std::to_string(patch_)};
  }
  if (is_abstract(patch_)) {
    return abstract_step(is_large);
  }
  if (here == 0 || (!is_large && here < cells_of_patch / 4)) {
    return growth();
  }
  if (kind < 100) {
    return split();
  }
  if (kind < 120) {
    return tear();
  }
  if (kind < 130) {
    return product();
  }
  return is_large || one_in(3) ? reduction() : growth();
}

std::optional<ops::Operation> SoakSteps::growth() {
  const std::uint32_t kind = draws_.below(20);
  if (kind < 8) {
    return ops::MakeSimplex{fresh(), static_cast<int>(draws_.below(4)), {}};
  }
  if (kind < 12) {
    const std::array<ops::CellType, 4> types{ops::CellType{1, 1}, {2, 1}, {1, 2}, {1, 1, 1}};
    return ops::MakeSimploid{fresh(), types[draws_.below(types.size())], {}};
  }
  if (kind < 15) {
    return listed();
  }
  return cone(kind == 19);
}

std::optional<ops::Operation> SoakSteps::reduction() {
  if (one_in(8)) {
    return one_in(2) ? replacement() : removal();
  }
  return one_in(3) ? degeneration() : identification();
}

/// A vertex, loops, and triangles on loops drawn at random, any three: its H1 is a random group, often with torsion.
ops::MakeComplex SoakSteps::listed() {
  ops::MakeComplex complex{fresh(), {{"v", {}, {}, {}}}};
  const std::uint32_t loops = 1 + draws_.below(3);
  for (std::uint32_t k = 0; k < loops; ++k) {
    complex.cells.push_back({"e" + std::to_string(k), {}, {"v", "v"}, {}});
  }
  const auto loop = [&] { return "e" + std::to_string(draws_.below(loops)); };
  for (std::uint32_t k = 1 + draws_.below(4); k > 0; --k) {
    std::string first = loop(), second = loop(), third = loop();
    complex.cells.push_back({"t" + std::to_string(k), {}, {std::move(first), std::move(second), std::move(third)}, {}});
  }
  return complex;
}

std::optional<ops::Operation> SoakSteps::question() {
  const CellId cell = pick();
  if (cell == ops::none) {
    return std::nullopt;
  }
  ops::AskClass question;
  const auto& directory = structure().directory();
  if (structure().dimension(cell) > 0 && !one_in(3)) {
    structure().faces().for_each_now(cell, [&](CellId face, int sign) {
      question.chain.emplace_back(sign * directory.sign_of_name(face), structure().name(face));
    });
    bounds_ = !question.chain.empty();
  }
  if (question.chain.empty()) {
    question.chain.emplace_back(1, structure().name(cell));
  }
  return question;
}

ops::Operation SoakSteps::expectation() {
  const engine::Homology homology = timed([&] { return engine_.homology(); });
  ops::Expect expected;
  expected.betti.emplace(homology.betti.begin(), homology.betti.end());
  expected.torsion = homology.torsion;
  expected.euler = engine_.euler_characteristic();
  return expected;
}

/// Few steps most of the time, at times many, seldom all that there are.
ops::Operation SoakSteps::undo() {
  const std::uint64_t most = engine_.undoable();
  if (one_in(100)) {
    return ops::Undo{most + 1};  // which is refused
  }
  const std::uint64_t wanted = one_in(20'000) ? most : one_in(200) ? 1000 : one_in(10) ? 50 : 5;
  return ops::Undo{most == 0 ? 1 : 1 + draws_.below(std::min(most, wanted))};
}

}  // namespace sesame::tools
