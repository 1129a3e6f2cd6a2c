#include "tools/bench/editing_scenarios.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "tools/bench/sessions.hpp"

namespace sesame::tools {
namespace {

using Size = std::uint64_t;

/// Of a graph under work, by counting, which costs as much as it is large.
template <class Session>
Answer groups_of_graph(const Session& session) {
  const std::int64_t pieces = session.components();
  return {{pieces, std::int64_t{session.edges()} - session.vertices() + pieces}};
}

template <class Session>
std::function<std::optional<Answer>(Size)> after_session(const Session& from_start) {
  return [=](Size steps) {
    Session session = from_start;
    for (Size step = 0; step < steps; ++step) {
      session.next();
    }
    return groups_of_graph(session);
  };
}

/// After some of the steps only.
template <class Session>
std::function<AnswerAfter(Size)> followed(const Session& from_start, std::size_t every) {
  return [=](Size) -> AnswerAfter {
    const auto session = std::make_shared<Session>(from_start);
    return [=](std::size_t step) -> std::optional<Answer> {
      session->next();
      return step % every == 0 ? std::optional{groups_of_graph(*session)} : std::nullopt;
    };
  };
}

struct Sizes {
  Size usual, quick;
};

template <class Session>
Scenario scenario(const char* name, const char* what, Sizes steps, const Session& session, std::size_t followed_every) {
  return {name,
          "editing",
          what,
          "steps",
          steps.usual,
          steps.quick,
          Construction{[session](Size n) { return steps_of(session, n); }, followed(session, followed_every)},
          after_session(session),
          "Z",
          true};
}

Scenario edited(const char* name, const char* what, std::uint32_t edges, bool with_undo, Sizes steps) {
  const GraphEditing editing(edges, with_undo, 1);
  return scenario(name, what, steps, editing, std::max<std::size_t>(1, edges / 1000));
}

/// After steps of which the first one makes everything.
std::int64_t triangles_away(const Operations& operations) {
  const auto removals = std::ranges::count_if(
      operations, [](const ops::Operation& operation) { return std::holds_alternative<ops::Remove>(operation); });
  return 2 * removals - static_cast<std::int64_t>(operations.size() - 1);
}

Answer torus_without(std::int64_t triangles) { return triangles == 0 ? Answer{{1, 2, 1}} : Answer{{1, 1 + triangles}}; }

}  // namespace

void add_editing(std::vector<Scenario>& list) {
  list.push_back(
      edited("graph-30", "30 edges, whose vertices are glued and split at random", 30, false, {20'000, 120}));
  list.push_back(
      edited("graph-30-undo", "the same, and hundreds of steps are undone at times", 30, true, {20'000, 120}));
  list.push_back(
      edited("graph-60", "60 edges, whose vertices are glued and split at random", 60, false, {20'000, 200}));
  list.push_back(
      edited("graph-300", "300 edges, whose vertices are glued and split at random", 300, false, {20'000, 600}));
  list.push_back(
      edited("graph-300-undo", "the same, and hundreds of steps are undone at times", 300, true, {20'000, 900}));
  list.push_back(
      edited("graph-3000", "3000 edges, whose vertices are glued and split at random", 3000, false, {20'000, 0}));
  list.push_back(edited("graph-100000", "100000 edges, made, and then vertices glued and split at random", 100'000,
                        false, {150'000, 0}));
  Scenario over_field = edited("graph-120-mod-2", "120 edges, whose vertices are glued and split at random, over Z/2",
                               120, false, {20'000, 300});
  over_field.ring = "Z/2";
  list.push_back(std::move(over_field));
  const GraphContraction contraction(2000, 1);
  list.push_back(scenario("contracted-graph",
                          "edges inserted between 2000 vertices, and one step in ten a collapse of one",
                          {20'000, 2'200}, contraction, 100));
  list.push_back({"glued-triangles", "editing",
                  "triangles with one vertex; their sides are glued and split at random, then all split apart",
                  "triangles", 32, 6,
                  Construction{[](Size n) { return glued_triangles(static_cast<std::uint32_t>(n), 1); }},
                  [](Size n) {
                    return Answer{{1, 2 * static_cast<std::int64_t>(n)}};
                  },
                  "Z", true});
  const auto edits = [](Size n) { return torus_with_triangles_edited(static_cast<std::uint32_t>(n), 2 * n * n, 1); };
  list.push_back({"edit", "editing", "a torus of triangles, of which random ones are removed and inserted again",
                  "squares of two triangles a side", 30, 8, Construction{edits},
                  [edits](Size n) { return torus_without(triangles_away(edits(n))); }, "Z", true});
}

}  // namespace sesame::tools
