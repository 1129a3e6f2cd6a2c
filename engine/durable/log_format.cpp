#include "engine/durable/log_format.hpp"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace sesame::engine {
namespace {

constexpr std::string_view before_number = ",\"seq\":";
constexpr std::string_view before_synced = ",\"synced\":";
constexpr std::string_view before_hash = ",\"xxh3\":\"";
constexpr std::string_view behind_hash = "\"}";
constexpr std::size_t hash_digits = 16;
constexpr std::size_t hash_field = before_hash.size() + hash_digits + behind_hash.size();
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::optional<std::uint64_t> number_of(std::string_view digits, int base) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  const bool is_whole = error == std::errc{} && end == digits.data() + digits.size();
  return is_whole ? std::optional{number} : std::nullopt;
}

/// A line that ends with a checksum.
struct Checked {
  std::string_view rest;              ///< what stands before it
  std::optional<std::uint64_t> hash;  ///< or none, when it is not written as one
};

std::optional<Checked> take_hash_off(std::string_view line) {
  if (line.size() < hash_field || !line.ends_with(behind_hash)) {
    return std::nullopt;
  }
  const std::string_view field = line.substr(line.size() - hash_field);
  if (!field.starts_with(before_hash)) {
    return std::nullopt;
  }
  const std::string_view digits = field.substr(before_hash.size(), hash_digits);
  const bool is_lower = std::none_of(digits.begin(), digits.end(), [](char c) { return c >= 'A' && c <= 'F'; });
  return Checked{line.substr(0, line.size() - hash_field), is_lower ? number_of(digits, 16) : std::nullopt};
}

/// What stands before a checksum, taken apart.
struct Numbered {
  std::string_view record;  ///< but for its closing brace
  std::uint64_t number;
  std::optional<std::uint64_t> synced;
};

std::optional<Numbered> take_numbers_off(std::string_view rest) {
  const std::size_t begin = rest.rfind(before_number);
  if (begin == std::string_view::npos) {
    return std::nullopt;
  }
  std::string_view numbers = rest.substr(begin + before_number.size());
  std::optional<std::uint64_t> synced;
  if (const std::size_t second = numbers.find(before_synced); second != std::string_view::npos) {
    synced = number_of(numbers.substr(second + before_synced.size()), 10);
    if (!synced) {
      return std::nullopt;
    }
    numbers = numbers.substr(0, second);
  }
  const auto number = number_of(numbers, 10);
  return number ? std::optional{Numbered{rest.substr(0, begin), *number, synced}} : std::nullopt;
}

void add_hash(std::string& line, std::uint64_t hash) {
  line += fmt::format("{}{:016x}{}\n", before_hash, hash, behind_hash);
}

constexpr const char* not_as_written =
    "its checksum does not fit: it is not as it was written, or a line before it is not";

}  // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::string digits_of(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

// ---------------------------------------------------------------------------------------------------------- writing

std::string record_line(std::string_view text, std::uint64_t synced, LogPosition& position) {
  std::string line;
  line.reserve(text.size() + 96);
  line.append(text.substr(0, text.size() - 1));
  line += fmt::format("{}{}", before_number, position.records);
  if (synced > position.synced) {
    line += fmt::format("{}{}", before_synced, synced);
    position.synced = synced;
  }
  position.chain = checksum(line, position.chain);
  add_hash(line, position.chain);
  ++position.records;
  position.bytes += line.size();
  position.is_checked = true;
  position.is_bound = false;
  return line;
}

std::string binding_line(const Binding& binding, LogPosition& position) {
  std::string line =
      fmt::format("#{{\"bound\":{},\"synced\":{},\"state\":\"{:016x}\"", binding.steps, binding.synced, binding.state);
  position.chain = checksum(line, position.chain);
  add_hash(line, position.chain);
  position.bytes += line.size();
  position.synced = std::max(position.synced, binding.synced);
  position.is_checked = position.is_bound = true;
  return line;
}

// ---------------------------------------------------------------------------------------------------------- reading

std::optional<std::uint64_t> claimed_sync(std::string_view bytes) {
  std::optional<std::uint64_t> last;
  for (std::size_t at = bytes.find(before_synced); at != std::string_view::npos; at = bytes.find(before_synced, at)) {
    at += before_synced.size();
    const std::size_t end = std::min(bytes.find_first_not_of("0123456789", at), bytes.size());
    last = std::max(last, number_of(bytes.substr(at, end - at), 10));
  }
  return last;
}

bool LineChecker::is_checked(std::string_view line) { return take_hash_off(line).has_value(); }

Result<LogLine> LineChecker::take(std::string_view line) {
  const std::size_t size = line.size() + 1;
  if (position_.bytes == 0 && line.starts_with(byte_order_mark)) {
    line.remove_prefix(byte_order_mark.size());
  }
  const bool is_comment = line.starts_with('#');
  const bool is_blank = line.find_first_not_of(" \t\r") == std::string_view::npos;
  Result<LogLine> taken = LogLine{};
  if (is_comment && (is_checked(line) || line.starts_with("#{\"bound\":"))) {
    taken = take_binding(line);
  } else if (is_comment || is_blank) {
    position_.chain = checksum(line, position_.chain);
  } else {
    taken = take_record(line);
  }
  if (taken) {
    position_.bytes += size;
  }
  return taken;
}

void LineChecker::shrink() {
  constexpr std::size_t large = std::size_t{1} << 20;
  if (text_.capacity() >= large) {
    text_ = {};
  }
}

Result<LogLine> LineChecker::take_record(std::string_view line) {
  position_.is_bound = false;
  const std::optional<Checked> checked = take_hash_off(line);
  if (!checked) {
    position_.chain = checksum(line, position_.chain);
    ++position_.records;
    return LogLine{line, {}};
  }
  const auto numbered = take_numbers_off(checked->rest);
  if (!numbered || !checked->hash) {
    return Error{Errc::bad_input, not_as_written};
  }
  const Chain chain = checksum(checked->rest, position_.chain);
  if (chain != *checked->hash) {
    return Error{Errc::bad_input, numbered->number == position_.records
                                      ? std::string{not_as_written}
                                      : fmt::format("it says that it is record {}: records are missing, doubled or out "
                                                    "of order before it, or it is not as it was written",
                                                    numbered->number)};
  }
  if (numbered->number != position_.records) {
    return Error{Errc::bad_input, fmt::format("it says that it is record {}", numbered->number)};
  }
  text_.assign(numbered->record);
  text_ += '}';
  position_.chain = chain;
  position_.is_checked = true;
  position_.synced = numbered->synced.value_or(position_.synced);
  ++position_.records;
  return LogLine{text_, {}};
}

Result<LogLine> LineChecker::take_binding(std::string_view line) {
  const Error broken{Errc::bad_input, std::string{"this line binds what comes before it, but "} + not_as_written};
  const std::optional<Checked> checked = take_hash_off(line);
  if (!checked || !checked->hash || checksum(checked->rest, position_.chain) != *checked->hash) {
    return broken;
  }
  // Its checksum is right, so it is as binding_line writes it, or somebody means ill.
  std::string_view rest = checked->rest;
  const auto next = [&rest](std::string_view name, std::string_view end, int base) -> std::optional<std::uint64_t> {
    if (!rest.starts_with(name)) {
      return std::nullopt;
    }
    rest.remove_prefix(name.size());
    const std::size_t size = std::min(rest.find(end), rest.size());
    const std::string_view digits = rest.substr(0, size);
    rest.remove_prefix(std::min(size + end.size(), rest.size()));
    return number_of(digits, base);
  };
  const auto steps = next("#{\"bound\":", ",", 10);
  const auto synced = next("\"synced\":", ",", 10);
  const auto state = next("\"state\":\"", "\"", 16);
  if (!steps || !synced || !state || !rest.empty()) {
    return broken;
  }
  if (*steps != position_.steps() || position_.records == 0) {
    return Error{Errc::bad_input, fmt::format("this line says that {} steps come before it, but there are {}", *steps,
                                              position_.steps())};
  }
  position_.chain = *checked->hash;
  position_.synced = *synced;
  position_.is_checked = position_.is_bound = true;
  return LogLine{{}, Binding{*steps, *synced, *state}};
}

}  // namespace sesame::engine
