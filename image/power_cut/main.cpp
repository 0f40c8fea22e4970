// flexrf-power-cut: makes of a recording of a disk's writes what is on the disk when the power goes
// (docs/image.md).

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "image/power_cut/disk_image.hpp"
#include "image/power_cut/power_cut.hpp"

namespace {

using namespace flexrf::power_cut;

constexpr const char* usage =
    "flexrf-power-cut describe --log LOG --base IMAGE\n"
    "flexrf-power-cut points   --log LOG --base IMAGE --count N --seed S\n"
    "flexrf-power-cut build    --log LOG --base IMAGE --point P --seed S --output FILE\n"
    "Makes of a recording of a disk's writes what is on the disk when the power goes.\n"
    "  --log LOG      what QEMU's blklogwrites recorded\n"
    "  --base IMAGE   the disk as it was before the first write; is not changed\n"
    "  --point P      the power goes when the entry with this number, from 0, is on its way\n"
    "  --seed S       decides which of the writes that no flush had made sure are there; the same gives the "
    "same\n"
    "  --output FILE  the disk; must not be there yet\n"
    "'points' prints that many points, each in a line. Exit code: 0; 1 wrong usage; 2 a file is not as it "
    "should be.\n";

int misuse(const std::string& what) {
  std::fprintf(stderr, "flexrf-power-cut: %s\n%s", what.c_str(), usage);
  return 1;
}

int fail(const flexrf::Status& status) {
  std::fprintf(stderr, "flexrf-power-cut: %s\n", status.cause());
  return 2;
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

using Options = std::map<std::string, std::string>;

int describe(const WriteLog& log, const OpenFile& base) {
  std::uint64_t writes = 0;
  std::uint64_t bytes = 0;
  std::uint64_t flushes = 0;
  std::uint64_t forced = 0;
  for (const LogEntry& entry : log.entries) {
    writes += entry.size > 0 ? 1 : 0;
    bytes += entry.size;
    flushes += entry.is_flush ? 1 : 0;
    forced += entry.size > 0 && entry.is_fua ? 1 : 0;
  }
  std::printf("%zu entries: %llu writes of %llu bytes in all, %llu of them with FUA; %llu flushes\n",
              log.entries.size(), static_cast<unsigned long long>(writes),
              static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(forced),
              static_cast<unsigned long long>(flushes));
  std::printf("sectors of %u bytes; disk of %llu bytes; points 0 to %zu\n", log.sector_size,
              static_cast<unsigned long long>(base.size()), log.entries.size());
  return 0;
}

int print_points(const WriteLog& log, std::uint64_t count, std::uint64_t seed) {
  for (const std::size_t point : chosen_points(log, static_cast<std::size_t>(count), seed))
    std::printf("%zu\n", point);
  return 0;
}

int build(const WriteLog& log, const OpenFile& log_file, const OpenFile& base, std::uint64_t point,
          std::uint64_t seed, const std::string& output) {
  if (point > log.entries.size())
    return misuse("there is no point " + std::to_string(point) + "; the log's points are 0 to " +
                  std::to_string(log.entries.size()));
  const Remains remains = remains_after(log, static_cast<std::size_t>(point), seed);
  if (const flexrf::Status made = make_image(output, base, log_file, remains); !made) return fail(made);
  std::printf("point %llu, seed %llu: %zu writes for certain, %zu of %zu others",
              static_cast<unsigned long long>(point), static_cast<unsigned long long>(seed), remains.durable,
              remains.kept, remains.possible);
  if (remains.torn_of > 0)
    std::printf(", of the last one %llu of %llu bytes", static_cast<unsigned long long>(remains.torn),
                static_cast<unsigned long long>(remains.torn_of));
  std::printf("\n");
  return 0;
}

const std::map<std::string, std::vector<std::string>> options_of_command = {
    {"describe", {"--log", "--base"}},
    {"points", {"--log", "--base", "--count", "--seed"}},
    {"build", {"--log", "--base", "--point", "--seed", "--output"}}};

// What is wrong about them.
std::optional<std::string> read_options(const std::vector<std::string>& words, Options& options) {
  const std::vector<std::string>& known = options_of_command.at(words[0]);
  for (std::size_t i = 1; i < words.size(); i += 2) {
    if (std::find(known.begin(), known.end(), words[i]) == known.end())
      return "'" + words[0] + "' has no option '" + words[i] + "'";
    if (i + 1 == words.size()) return words[i] + " needs a value";
    if (!options.emplace(words[i], words[i + 1]).second) return words[i] + " is given twice";
  }
  for (const std::string& option : known)
    if (options.count(option) == 0) return "'" + words[0] + "' needs " + option;
  for (const char* option : {"--count", "--seed", "--point"})
    if (options.count(option) != 0 && !number_in(options[option]))
      return std::string(option) + " takes a whole number from 0, not '" + options[option] + "'";
  return std::nullopt;
}

int run(const std::string& command, Options& options) {
  const OpenFile base(options["--base"]);
  if (!base.status()) return fail(base.status());
  const OpenFile log_file(options["--log"]);
  if (!log_file.status()) return fail(log_file.status());
  const flexrf::Result<WriteLog> log = read_log(log_file.descriptor(), base.size());
  if (!log) return fail(log.status());
  if (command == "describe") return describe(*log, base);
  const std::uint64_t seed = *number_in(options["--seed"]);
  if (command == "points") return print_points(*log, *number_in(options["--count"]), seed);
  return build(*log, log_file, base, *number_in(options["--point"]), seed, options["--output"]);
}

}  // namespace

int main(int argument_count, char** arguments) {
  flexrf::hold_standard_descriptors();
  const std::vector<std::string> words(arguments + 1, arguments + argument_count);
  if (words.empty()) return misuse("a command is missing");
  if (words[0] == "--help" || words[0] == "-h") {
    std::fputs(usage, stdout);
    return 0;
  }
  if (options_of_command.count(words[0]) == 0) return misuse("there is no command '" + words[0] + "'");
  Options options;
  if (const auto wrong = read_options(words, options)) return misuse(*wrong);
  return run(words[0], options);
}
