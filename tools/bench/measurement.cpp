#include "tools/bench/measurement.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "replay/text/byte_source.hpp"
#include "sparse/contract.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int report_version = 2;
constexpr std::array<std::string_view, 6> verdict_names{"right", "wrong", "cut", "absent", "refused", "failed"};

Verdict verdict_named(const std::string& name) {
  for (std::size_t k = 0; k < verdict_names.size(); ++k) {
    if (verdict_names[k] == name) {
      return static_cast<Verdict>(k);
    }
  }
  throw std::invalid_argument("there is no verdict \"" + name + "\"");
}

Json counts_json(const Counts& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) {
    json[name] = count;
  }
  return json;
}

Counts counts_from(const Json& json) {
  Counts counts;
  for (const auto& [name, count] : json.items()) {
    counts.emplace_back(name, count.get<std::uint64_t>());
  }
  return counts;
}

}  // namespace

std::string_view verdict_name(Verdict verdict) { return verdict_names.at(static_cast<std::size_t>(verdict)); }

// ---- the parts, where nlohmann::json looks for them

static void to_json(Json& json, const TimelinePoint& point) {
  json = {point.last_step, point.mean, point.median, point.max};
}

static void from_json(const Json& json, TimelinePoint& point) {
  const std::size_t median = json.size() - 2;  // version 1 had no mean before it
  point = {json.at(0).get<std::uint64_t>(), median == 2 ? json.at(1).get<double>() : 0, json.at(median).get<double>(),
           json.at(median + 1).get<double>()};
}

static void to_json(Json& json, const Latency& step) {
  json = {{"mean", step.mean}, {"p50", step.p50}, {"p99", step.p99}, {"max", step.max}};
}

static void from_json(const Json& json, Latency& step) {
  step = {json.value("mean", 0.0), json.at("p50").get<double>(), json.at("p99").get<double>(),
          json.at("max").get<double>()};
}

static void to_json(Json& json, const Memory& memory) { json = {{"resident", memory.resident}, {"heap", memory.heap}}; }

static void from_json(const Json& json, Memory& memory) {
  memory = {json.at("resident").get<std::uint64_t>(), json.at("heap").get<std::uint64_t>()};
}

static void to_json(Json& json, const Spread& spread) {
  json = {{"median", spread.median},
          {"min", spread.min},
          {"max", spread.max},
          {"deviation", spread.deviation},
          {"runs", spread.runs}};
}

static void from_json(const Json& json, Spread& spread) {
  spread = {json.at("median").get<double>(), json.at("min").get<double>(), json.at("max").get<double>(),
            json.at("deviation").get<double>(), json.at("runs").get<std::size_t>()};
}

void to_json(Json& json, const Sample& sample) {
  json = {{"verdict", verdict_name(sample.verdict)},
          {"remark", sample.remark},
          {"steps", sample.steps},
          {"checked", sample.checked},
          {"seconds", sample.seconds},
          {"busy", sample.busy},
          {"step_us", sample.step},
          {"memory", sample.memory},
          {"allocations", sample.allocations},
          {"counts", counts_json(sample.counts)},
          {"timeline", sample.timeline}};
}

void from_json(const Json& json, Sample& sample) {
  sample.verdict = verdict_named(json.at("verdict").get<std::string>());
  json.at("remark").get_to(sample.remark);
  json.at("steps").get_to(sample.steps);
  json.at("checked").get_to(sample.checked);
  json.at("seconds").get_to(sample.seconds);
  json.at("busy").get_to(sample.busy);
  json.at("step_us").get_to(sample.step);
  json.at("memory").get_to(sample.memory);
  json.at("allocations").get_to(sample.allocations);
  sample.counts = counts_from(json.at("counts"));
  json.at("timeline").get_to(sample.timeline);
}

void to_json(Json& json, const ScalingPoint& point) {
  json = {{"x", point.x}, {"step_us", point.step}, {"touched", point.touched}};
}

void from_json(const Json& json, ScalingPoint& point) {
  if (json.is_array()) {  // version 1
    point = {json.at(0).get<std::uint64_t>(), {0, json.at(1).get<double>(), 0, 0}, json.at(2).get<double>()};
    return;
  }
  json.at("x").get_to(point.x);
  json.at("step_us").get_to(point.step);
  json.at("touched").get_to(point.touched);
}

static void to_json(Json& json, const Measurement& m) {
  json = {{"scenario", m.scenario}, {"family", m.family},
          {"size", m.size},         {"ring", m.ring},
          {"method", m.method},     {"verdict", verdict_name(m.verdict)},
          {"remark", m.remark},     {"steps", m.steps},
          {"checked", m.checked},   {"seconds", m.seconds},
          {"busy", m.busy},         {"step_us", m.step},
          {"memory", m.memory},     {"counts", counts_json(m.counts)},
          {"timeline", m.timeline}};
}

static void from_json(const Json& json, Measurement& m) {
  json.at("scenario").get_to(m.scenario);
  json.at("family").get_to(m.family);
  json.at("size").get_to(m.size);
  json.at("ring").get_to(m.ring);
  json.at("method").get_to(m.method);
  m.verdict = verdict_named(json.at("verdict").get<std::string>());
  json.at("remark").get_to(m.remark);
  json.at("steps").get_to(m.steps);
  m.checked = json.value("checked", std::uint64_t{0});
  json.at("seconds").get_to(m.seconds);
  json.at("busy").get_to(m.busy);
  json.at("step_us").get_to(m.step);
  json.at("memory").get_to(m.memory);
  m.counts = counts_from(json.at("counts"));
  json.at("timeline").get_to(m.timeline);
}

static void to_json(Json& json, const Scaling& scaling) {
  json = {{"experiment", scaling.experiment},
          {"what", scaling.what},
          {"method", scaling.method},
          {"x", scaling.x_name},
          {"expected_exponent", scaling.expected},
          {"remark", scaling.remark},
          {"is_wrong", scaling.is_wrong},
          {"points", scaling.points}};
}

static void from_json(const Json& json, Scaling& scaling) {
  json.at("experiment").get_to(scaling.experiment);
  json.at("what").get_to(scaling.what);
  json.at("method").get_to(scaling.method);
  json.at("x").get_to(scaling.x_name);
  json.at("expected_exponent").get_to(scaling.expected);
  json.at("remark").get_to(scaling.remark);
  scaling.is_wrong = json.value("is_wrong", false);
  json.at("points").get_to(scaling.points);
}

static void to_json(Json& json, const Machine& machine) {
  json = {{"cpu", machine.cpu},
          {"cores", machine.cores},
          {"memory_bytes", machine.memory_bytes},
          {"system", machine.system}};
}

static void from_json(const Json& json, Machine& machine) {
  json.at("cpu").get_to(machine.cpu);
  json.at("cores").get_to(machine.cores);
  json.at("memory_bytes").get_to(machine.memory_bytes);
  json.at("system").get_to(machine.system);
}

static void to_json(Json& json, const Build& build) {
  json = {{"version", build.version}, {"commit", build.commit}, {"compiler", build.compiler}, {"flags", build.flags}};
}

static void from_json(const Json& json, Build& build) {
  json.at("version").get_to(build.version);
  json.at("commit").get_to(build.commit);
  json.at("compiler").get_to(build.compiler);
  json.at("flags").get_to(build.flags);
}

// ---- the whole

std::string to_text(const Report& report) {
  const Json head{
      {"sesame_bench", report_version}, {"date", report.date}, {"build", report.build}, {"machine", report.machine}};
  std::string text = head.dump();
  text.pop_back();
  const auto add_list = [&text](const char* name, const auto& list) {
    text += std::string{",\n\""} + name + "\":[";
    for (const auto& element : list) {
      // The remark of a program may be no UTF-8.
      text += (text.back() == '[' ? "\n" : ",\n") + Json(element).dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    text += "]";
  };
  add_list("measurements", report.measurements);
  add_list("scalings", report.scalings);
  return text + "}\n";
}

Result<Report> parse_report(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("sesame_bench") != 1 && json.at("sesame_bench") != report_version) {
      return Error{Errc::bad_input, "\"sesame_bench\" should be 1 or " + std::to_string(report_version)};
    }
    Report report;
    json.at("date").get_to(report.date);
    json.at("build").get_to(report.build);
    json.at("machine").get_to(report.machine);
    json.at("measurements").get_to(report.measurements);
    json.at("scalings").get_to(report.scalings);
    return report;
  } catch (const std::exception& e) {  // of the JSON library, which has no other way to say it
    return Error{Errc::bad_input, std::string{"not a report of sesame bench: "} + e.what()};
  }
}

Result<Report> read_report(const std::string& path) {
  const Result<std::string> text = replay::read_file(path);
  if (!text) {
    return text.error();
  }
  Result<Report> report = parse_report(*text);
  if (!report) {
    return Error{report.error().code, path + ": " + report.error().what};
  }
  return report;
}

}  // namespace sesame::tools
