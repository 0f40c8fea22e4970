#include "image/helper/failure_lines.hpp"

#include <algorithm>
#include <utility>

namespace flexrf::helper {
namespace {

constexpr const char* is_being_read = "The journal is being read.";
constexpr const char* no_boot = "No start left a line: none came as far as its services.";
constexpr const char* no_line = "The journal has no line of these starts any more, or none reached the disk.";

}  // namespace

std::vector<std::string> journal_arguments(const std::vector<std::string>& boots) {
  std::vector<std::string> arguments{"--quiet",
                                     "--no-pager",
                                     "--no-hostname",
                                     "--output=short-monotonic",
                                     "--lines=" + std::to_string(most_journal_lines),
                                     "--unit=flexrf.service"};
  // Matches of the same field are alternatives.
  for (const std::string& boot : boots) arguments.push_back("_BOOT_ID=" + boot);
  return arguments;
}

std::vector<std::string> last_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string line{text.substr(0, std::min(end, longest_journal_line))};
    std::replace_if(
        line.begin(), line.end(), [](char one) { return one < ' ' || one > '~'; }, '?');
    if (!line.empty()) lines.push_back(std::move(line));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  std::size_t first = lines.size();
  std::size_t bytes = 0;
  while (first > 0 && lines.size() - first < most_journal_lines &&
         bytes + lines[first - 1].size() <= most_journal_bytes)
    bytes += lines[--first].size();
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
  return lines;
}

FailureLines::FailureLines(Read read)
    : reading_([read = std::move(read)](const Boots& boots) -> Lines {
        const Result<std::string> text = read(journal_arguments(boots));
        if (!text) return text.status();
        return last_lines(*text);
      }) {}

FailureLines::Answer FailureLines::of(const std::vector<std::string>& boots, Time now) {
  if (boots.empty()) return {{}, no_boot};
  const auto found = reading_.found();
  const bool is_read = found && found->number == number_ && boots == boots_;
  const bool has_failed = is_read && !found->value;
  if (boots != boots_ || (has_failed && now - asked_at_ >= retry_interval)) {
    boots_ = boots;
    asked_at_ = now;
    number_ = reading_.ask(boots);
    return {{}, is_being_read};
  }
  if (!is_read) return {{}, is_being_read};
  if (has_failed) return {{}, std::string{"The journal cannot be read: "} + found->value.status().cause()};
  return {*found->value, found->value->empty() ? no_line : ""};
}

}  // namespace flexrf::helper
