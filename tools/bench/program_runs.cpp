#include <fmt/format.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "replay/text/byte_source.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

struct Program {
  std::string name;     ///< of the executable
  std::string package;  ///< where it comes from
  /// All of these are tried, and the quickest is taken.
  std::vector<std::string> options;
};

const Program& program_of(const std::string& method) {
  static const Program sesame{"sesame", "this one", {""}};
  // Without spectral_sequence: on a torus of 1536 cells, PHAT 1.6 gave other pairs than by its other algorithms in 7 of
  // 40 runs on two processors.
  static const Program phat{"phat",
                            "Debian package phat-utils",
                            {"--twist", "--twist --dualize", "--chunk_sequential", "--chunk_sequential --dualize",
                             "--row", "--row --dualize"}};
  static const Program gudhi{"bench_gudhi", "built when libgudhi-dev is there", {""}};
  return method == "phat" ? phat : method == "gudhi" ? gudhi : sesame;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>{in}, {}};
}

/// Throws when the file cannot be read.
std::string content_of(const std::string& path) {
  Result<std::string> content = replay::read_file(path);
  if (!content) {
    throw std::runtime_error(content.error().what);
  }
  return *std::move(content);
}

/// The 64 bit integers of a file, in turn. Throws when it cannot be read or ends too early.
class Words {
 public:
  explicit Words(const std::string& path) : path_{path}, bytes_{content_of(path)} {}

  std::uint64_t next() {
    std::uint64_t word = 0;
    const std::size_t at = at_;
    skip(1);
    std::memcpy(&word, bytes_.data() + at, sizeof word);
    return word;
  }
  void skip(std::uint64_t words) {
    if (words > (bytes_.size() - at_) / sizeof words) {
      throw std::runtime_error(path_ + " ends too early");
    }
    at_ += words * sizeof words;
  }

 private:
  std::string path_, bytes_;
  std::size_t at_ = 0;
};

/// The bars of the boundary matrix and the pairs that PHAT wrote; the cells without a partner begin those without an
/// end.
BarSet bars_of_pairs(const std::string& matrix, const std::string& pairs) {
  std::vector<std::uint8_t> dimensions;
  Words columns(matrix);
  for (std::uint64_t left = columns.next(); left > 0; --left) {
    dimensions.push_back(static_cast<std::uint8_t>(columns.next()));
    columns.skip(columns.next());
  }
  BarSet bars;
  std::vector<bool> is_paired(dimensions.size());
  const auto add = [&](std::uint64_t birth, engine::Time death) { bars.add({dimensions.at(birth), birth, death}); };
  Words written(pairs);
  for (std::uint64_t left = written.next(); left > 0; --left) {
    const std::uint64_t birth = written.next(), death = written.next();
    add(birth, death);
    is_paired.at(birth) = is_paired.at(death) = true;
  }
  for (std::uint64_t cell = 0; cell < dimensions.size(); ++cell) {
    if (!is_paired[cell]) {
      add(cell, engine::never);
    }
  }
  return bars;
}

/// The bars of lines `dim birth death`. Throws when the file cannot be read.
BarSet bars_of_lines(const std::string& path) {
  BarSet bars;
  std::istringstream in(content_of(path));
  for (std::string line; std::getline(in, line);) {
    if (const std::vector<std::string> words = words_of(line); words.size() == 3) {
      bars.add({std::stoi(words[0]), std::stod(words[1]), std::stod(words[2])});
    }
  }
  return bars;
}

/// Betti numbers from a line `betti b0 b1 ...`.
std::vector<std::int64_t> betti_from_line(const std::string& text) {
  std::vector<std::int64_t> betti;
  for (const std::string& word : words_of(text)) {
    if (word != "betti") {
      betti.push_back(std::stoll(word));
    }
  }
  return betti;
}

}  // namespace

std::span<const std::string> program_methods() {
  static const std::array<std::string, 3> names{"sesame-program", "phat", "gudhi"};
  return names;
}

FiltrationProgram::FiltrationProgram(const Scenario& scenario, std::uint64_t size, std::string method)
    : scenario_{scenario}, size_{size}, method_{std::move(method)}, options_{program_of(method_).options} {
  const Program& program = program_of(method_);
  const std::optional<std::string> path = find_program(program.name);
  if (!path) {
    trouble_.verdict = Verdict::absent;
    trouble_.remark = program.name + " is not here (" + program.package + ")";
    return;
  }
  program_ = *path;
  const Result<std::string> cells = in_child(
      [&] {
        const Filtration filtration = std::get<CellFiltration>(scenario_.input).make(size_);
        if (method_ == "gudhi" && !filtration.is_simplicial()) {
          return std::string{"0"};
        }
        std::ofstream file(directory_.path("cells"), std::ios::binary);
        method_ == "gudhi" ? write_gudhi(file, filtration) : write_phat_binary(file, filtration);
        sparse::expects(file.flush().good(), "there is room for the files of a benchmark");
        const BarSet bars = bars_of(scenario_, size_);
        return fmt::format("{} {} {}", filtration.size(), bars.size, bars.digest);
      },
      3600);
  if (!cells || *cells == "0") {
    trouble_.verdict = cells ? Verdict::refused : Verdict::failed;
    trouble_.remark = cells ? "the cells are no simplices" : cells.error().what;
    return;
  }
  std::istringstream(*cells) >> cells_ >> bars_.size >> bars_.digest;
}

std::vector<std::string> FiltrationProgram::command(const std::string& options) const {
  std::vector<std::string> words{program_};
  if (method_ == "sesame-program") {
    return {program_,
            "tower",
            "--quiet",
            "--format",
            "phat-binary",
            "--pers",
            directory_.path("out"),
            directory_.path("cells")};
  }
  if (method_ == "phat") {
    const std::vector<std::string> more = words_of(options);
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--binary", directory_.path("cells"), directory_.path("out")});
    return words;
  }
  return {program_, directory_.path("cells")};
}

Status FiltrationProgram::check_answer(const std::string& printed) const {
  const std::optional<Answer> answer = scenario_.answer(size_);
  if (method_ == "gudhi") {
    return answer ? check({betti_from_line(printed), {}, {}, {}}, *answer) : Done{};
  }
  const Result<std::string> wrong = in_child(  // so that what the files need is not memory of this process
      [&]() -> std::string {
        const std::string out = directory_.path("out");
        const BarSet bars = method_ == "phat" ? bars_of_pairs(directory_.path("cells"), out) : bars_of_lines(out);
        if (!(bars == bars_)) {
          return fmt::format("found {} other bars than the {} of sesame", bars.size, bars_.size);
        }
        const Status right = answer ? check({bars.betti, {}, {}, {}}, *answer) : Done{};
        return right ? "" : right.error().what;
      },
      3600);
  if (!wrong) {
    return wrong.error();
  }
  return wrong->empty() ? Status{Done{}} : Error{Errc::expectation, *wrong};
}

Sample FiltrationProgram::run_with(const std::string& options, unsigned most_seconds) {
  const Result<ProgramRun> run = run_program(command(options), most_seconds);
  Sample sample;
  if (!run) {
    sample.verdict = Verdict::failed;
    sample.remark = run.error().what;
    return sample;
  }
  sample.steps = cells_;
  sample.seconds = run->seconds;
  sample.busy = run->processor_seconds / run->seconds;
  sample.memory.resident = run->peak_bytes;
  if (const Status right = check_answer(run->output); !right) {
    sample.verdict = right.error().code == Errc::expectation ? Verdict::wrong : Verdict::failed;
    sample.remark = right.error().what;
    return sample;
  }
  sample.remark = options;
  return sample;
}

Sample FiltrationProgram::run(unsigned most_seconds) {
  if (trouble_.verdict != Verdict::right) {
    return trouble_;
  }
  std::optional<Sample> best;
  std::string chosen;
  for (const std::string& options : options_) {
    Sample sample = run_with(options, most_seconds);
    if (sample.verdict == Verdict::wrong) {
      return sample;
    }
    const bool is_better = !best || (sample.verdict == Verdict::right &&
                                     (best->verdict != Verdict::right || sample.seconds < best->seconds));
    if (is_better) {
      best = std::move(sample);
      chosen = options;
    }
  }
  options_ = {chosen};
  return *best;
}

}  // namespace sesame::tools
