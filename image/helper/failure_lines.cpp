#include "image/helper/failure_lines.hpp"

#include <algorithm>
#include <utility>

namespace flexrf::helper {
namespace {

constexpr const char* is_read = "The journal is being read.";
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

FailureLines::FailureLines(Read read) : read_(std::move(read)), thread_([this] { work(); }) {}

FailureLines::~FailureLines() {
  {
    const std::lock_guard lock(mutex_);
    has_to_end_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

FailureLines::Answer FailureLines::of(const std::vector<std::string>& boots, Time now) {
  if (boots.empty()) return {{}, no_boot};
  const std::lock_guard lock(mutex_);
  if (boots != boots_ || (has_failed_ && now - asked_at_ >= retry_interval)) {
    boots_ = boots;
    wanted_ = boots;
    asked_at_ = now;
    has_failed_ = false;
    answer_ = {{}, is_read};
    changed_.notify_one();
  }
  return answer_;
}

void FailureLines::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return has_to_end_ || !wanted_.empty(); });
    if (has_to_end_) return;
    const std::vector<std::string> boots = std::exchange(wanted_, {});
    lock.unlock();
    const Result<std::string> text = read_(journal_arguments(boots));
    Answer answer{text ? last_lines(*text) : std::vector<std::string>{}, {}};
    if (!text) {
      answer.why_none = std::string{"The journal cannot be read: "} + text.status().cause();
    } else if (answer.lines.empty()) {
      answer.why_none = no_line;
    }
    lock.lock();
    if (boots_ != boots) continue;  // others are wanted by now
    has_failed_ = !text;
    answer_ = std::move(answer);
  }
}

}  // namespace flexrf::helper
