#include "replay/page/page_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "ops/vocabulary/json_text.hpp"
#include "replay/page/page_file.hpp"
#include "sesame/version.hpp"

namespace sesame::replay {
namespace {

using ops::JsonText;

/// To four digits: enough for drawing, and the same whatever the last bits are.
void write_coordinate(double x, JsonText& out) {
  const double scale = std::pow(10.0, 4 - std::ceil(std::log10(std::max(std::abs(x), 1e-3))));
  const double rounded = std::round(x * scale) / scale;
  out.value(rounded == 0 ? 0.0 : rounded);
}

/// The elements of a list from one on.
template <class T>
std::span<const T> from(const std::vector<T>& list, std::size_t first) {
  return std::span(list).subspan(first);
}

/// Those from one on; all the types.
void write_cells(const PageCells& cells, std::uint32_t first, JsonText& out) {
  out.begin_object();
  out.field("types", cells.types);
  out.field("names", from(cells.names, first));
  out.field("type", from(cells.type_of, first));
  out.field("first", from(cells.first_face, first == 0 ? 0 : first + 1));
  out.field("faces", from(cells.faces, cells.first_face[first]));
  out.end_object();
}

/// Those that are not as they were seen.
void write_places(const std::vector<VertexPlace>& places, const std::vector<VertexPlace>& seen, JsonText& out) {
  const auto is_seen = [&](std::size_t k) {
    return k < seen.size() && seen[k].cell == places[k].cell && seen[k].point == places[k].point;
  };
  out.begin_object();
  out.key("cells");
  out.begin_list();
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!is_seen(k)) {
      out.value(places[k].cell);
    }
  }
  out.end_list();
  out.key("points");
  out.begin_list();
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!is_seen(k)) {
      for (const double x : places[k].point) {
        write_coordinate(x, out);
      }
    }
  }
  out.end_list();
  out.key("counts");
  out.begin_object();
  constexpr std::pair<PlaceKind, const char*> kinds[] = {{PlaceKind::given, "given"},
                                                         {PlaceKind::sum, "sum"},
                                                         {PlaceKind::beside, "beside"},
                                                         {PlaceKind::computed, "computed"}};
  for (const auto& [kind, name] : kinds) {
    out.field(name,
              std::count_if(places.begin(), places.end(), [kind = kind](const auto& p) { return p.kind == kind; }));
  }
  out.end_object();
  out.end_object();
}

void write_chain(const PageChain& chain, JsonText& out) {
  out.begin_object();
  if (chain.length > 0) {
    out.field(chain.is_length_exact ? "length" : "length_at_most", chain.length);
  }
  out.key("terms");
  out.begin_list();
  for (const PageChain::Term& term : chain.terms) {
    out.begin_list();
    out.value(term.coefficient);
    out.value(term.cell);
    if (term.cell < 0) {
      out.value(term.name);
    }
    out.end_list();
  }
  out.end_list();
  out.end_object();
}

void write_answer(const PageAnswer& answer, JsonText& out) {
  out.begin_object();
  out.field("cycle", answer.is_cycle);
  out.field("zero", answer.is_zero);
  out.field("coefficients", answer.coefficients);
  out.key("asked");
  write_chain(answer.asked, out);
  if (answer.bounds) {
    out.key("bounds");
    write_chain(*answer.bounds, out);
  }
  out.end_object();
}

template <class List>
void write_if_any(const char* name, const List& list, JsonText& out) {
  if (!list.empty()) {
    out.field(name, list);
  }
}

const char* name_of(ClassEnd how) {
  switch (how) {
    case ClassEnd::bounds:
      return "bounds";
    case ClassEnd::cut:
      return "cut";
    case ClassEnd::removed:
      return "removed";
    case ClassEnd::consumed:
      return "consumed";
    default:
      return "undone";
  }
}

void write_events(const PageStep& step, JsonText& out) {
  if (step.made > 0) {
    out.key("made");
    out.list_of(step.first, step.made);
  }
  write_if_any("removed", step.removed, out);
  write_if_any("moved", step.moved, out);
  write_if_any("consumed", step.consumed, out);
  write_if_any("undone", step.undone, out);
  if (!step.ended.empty()) {
    out.key("ended");
    out.begin_list();
    for (const auto& [number, how] : step.ended) {
      out.list_of(number, name_of(how));
    }
    out.end_list();
  }
}

/// Whether nothing is to be said of a step but how many cells it made. Of long histories that is most of the steps.
bool has_made_only(const PageStep& step) {
  return step.op.empty() && step.removed.empty() && step.moved.empty() && step.consumed.empty() &&
         step.undone.empty() && step.ended.empty();
}

/// What is the same as where the page stopped before is left out.
void write_state(const PageStep& step, const PageStep* before, JsonText& out) {
  out.field("op", step.op);
  out.field("text", step.text);
  if (before == nullptr || step.cells != before->cells) {
    out.field("cells", step.cells);
    out.field("euler", step.euler);
  }
  if (before == nullptr || step.betti != before->betti || step.torsion != before->torsion) {
    out.field("betti", step.betti);
    out.field("torsion", step.torsion);
  }
  if (before == nullptr || step.generators != before->generators) {
    out.key("generators");
    if (step.generators) {
      out.value(*step.generators);
    } else {
      out.null();  // it is not known
    }
  }
  if (step.answer) {
    out.key("answer");
    write_answer(*step.answer, out);
  }
}

void write_class(const PageClass& each, JsonText& out) {
  out.begin_object();
  out.field("dim", each.degree);
  out.field("order", each.order.to_string());
  if (each.since) {
    out.field("since", *each.since);
  }
  out.key("chain");
  write_chain(each.cycle, out);
  if (each.bounding) {
    out.key("bounds");
    write_chain(*each.bounding, out);
  }
  out.end_object();
}

/// What is said of a page as a whole, and may change as it grows.
void write_head(const PageHistory& history, const PageHead& head, JsonText& out) {
  out.field("title", head.title);
  out.field("notes", head.notes);
  out.field("stride", history.stride());
  out.field("left_out", history.left_out());
  out.field("families_left_out", history.families_left_out());
  if (history.generators().given_up()) {
    out.field("generators_until", *history.generators().given_up());
  }
}

/// What is not in `seen`, which becomes all.
void write_content(PageHistory& history, engine::Engine& engine, const PageHead& head, PagePart& seen, JsonText& out) {
  history.take_last_generators(engine, head.stop);
  out.key("cells");
  write_cells(history.cells(), seen.cells, out);
  seen.cells = history.cells().size();
  std::vector<VertexPlace> places = history.places().places(history.cells());
  out.key("places");
  write_places(places, seen.places, out);
  seen.places = std::move(places);
  out.key("steps");
  out.begin_list();
  const PageStep* before = nullptr;
  for (const PageStep& step : from(history.steps(), seen.steps)) {
    if (has_made_only(step)) {
      out.value(step.made);
      continue;
    }
    out.begin_object();
    write_events(step, out);
    if (!step.op.empty()) {  // the page stops there
      write_state(step, before, out);
      before = &step;
    }
    out.end_object();
  }
  out.end_list();
  seen.steps = history.steps().size();
  out.key("classes");
  out.begin_list();
  for (const PageClass& each : from(history.generators().classes(), seen.classes)) {
    write_class(each, out);
  }
  out.end_list();
  seen.classes = history.generators().classes().size();
}

}  // namespace

std::string page_data(PageHistory& history, engine::Engine& engine, const PageHead& head) {
  std::string text;
  JsonText out(text);
  out.begin_object();
  out.field("kind", "replay");
  out.field("format", 1);
  out.field("version", SESAME_VERSION);
  out.field("source", head.source);
  out.field("ring", sparse::ring_name(engine.ring()));
  out.key("limits");
  out.begin_object();
  out.field("cells", history.limits().cells);
  out.field("cells_of_family", history.limits().cells_of_family);
  out.field("steps", history.limits().steps);
  out.field("generators", history.limits().generators);
  out.field("terms", history.limits().terms);
  out.end_object();
  write_head(history, head, out);
  PagePart nothing;
  write_content(history, engine, head, nothing, out);
  out.end_object();
  return text;
}

std::string page_news(PageHistory& history, engine::Engine& engine, const PageHead& head, PagePart& seen) {
  std::string text;
  JsonText out(text);
  out.begin_object();
  write_head(history, head, out);
  write_content(history, engine, head, seen, out);
  out.end_object();
  return text;
}

void write_page(std::ostream& out, PageHistory& history, engine::Engine& engine, const PageHead& head) {
  write_page_file(out, page_data(history, engine, head));
}

}  // namespace sesame::replay
