#include "image/helper/start_record.hpp"

#include <algorithm>
#include <string_view>

#include "image/helper/facts.hpp"
#include "image/helper/named_lines.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

constexpr std::size_t boot_digits = 32;

std::string suffix_of(boot::Slot slot) {
  return slot == boot::Slot::a ? "a" : "b";
}

/// The identifiers become arguments of journalctl: anything else is dropped.
bool is_boot(std::string_view text) {
  return text.size() == boot_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::vector<std::string> boots_in(std::string_view text) {
  std::vector<std::string> boots;
  while (!text.empty() && boots.size() < most_boots) {
    const std::size_t end = text.find(' ');
    if (const std::string_view one = text.substr(0, end); is_boot(one)) boots.emplace_back(one);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return boots;
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char one) { return one == '\n' || one == '\r'; }, ' ');
  return text.substr(0, longest_start_reason);
}

StartRecord record_in(const NamedLines& lines) {
  StartRecord record;
  record.trial = lines.number("trial");
  record.start = static_cast<unsigned>(std::min<std::uint64_t>(lines.number("start"), most_boots));
  record.began = lines.number("began");
  record.reason = one_line(lines.whole("reason"));
  record.has_given_up = lines.text("gave_up") == "yes";
  record.boots = boots_in(lines.whole("boots"));
  return record;
}

std::string text_of(const StartRecord& record) {
  std::string text = "trial=" + std::to_string(record.trial) + "\nstart=" + std::to_string(record.start) +
                     "\nbegan=" + std::to_string(record.began) + "\nreason=" + one_line(record.reason) +
                     "\nboots=";
  for (std::size_t i = 0; i < record.boots.size(); ++i) text.append(i > 0 ? " " : "").append(record.boots[i]);
  return text + (record.has_given_up ? "\ngave_up=yes\n" : "\n");
}

}  // namespace

std::string start_record_file(const UpdateFiles& files, boot::Slot slot) {
  return files.folder + "/last-start-" + suffix_of(slot);
}

std::string failure_file(const UpdateFiles& files, boot::Slot slot) {
  return files.folder + "/last-failure-" + suffix_of(slot);
}

StartRecord read_start_record(const UpdateFiles& files, boot::Slot slot) {
  const Result<NamedLines> lines = NamedLines::read(start_record_file(files, slot));
  return lines ? record_in(*lines) : StartRecord{};
}

Status write_start_record(const UpdateFiles& files, boot::Slot slot, const StartRecord& record) {
  return replace_file(start_record_file(files, slot), text_of(record));
}

std::optional<Failure> read_failure(const UpdateFiles& files, boot::Slot slot) {
  const Result<NamedLines> lines = NamedLines::read(failure_file(files, slot));
  if (!lines) return std::nullopt;
  Failure failure;
  failure.slot = slot;
  failure.version = lines->text("version");
  failure.trial = lines->number("trial");
  failure.starts = static_cast<unsigned>(std::min<std::uint64_t>(lines->number("starts"), most_boots));
  failure.is_dismissed = lines->text("dismissed") == "yes";
  failure.last = record_in(*lines);
  return failure;
}

Status write_failure(const UpdateFiles& files, const Failure& failure) {
  StartRecord last = failure.last;
  last.trial = failure.trial;
  return replace_file(failure_file(files, failure.slot),
                      text_of(last) + "version=" + failure.version +
                          "\nstarts=" + std::to_string(failure.starts) +
                          (failure.is_dismissed ? "\ndismissed=yes\n" : "\n"));
}

std::string reason_of(const Failure& failure) {
  const std::string& reason = failure.last.reason;
  if (failure.last.start > 0) return reason.empty() ? "the reason was not noted" : reason;
  return "it stopped before its services ran: the kernel, the disk or the root failed, or the power was cut";
}

std::optional<Failure> failure_to_show(const UpdateFiles& files, const Facts& facts) {
  if (!facts.choice || !facts.running.slot) return std::nullopt;
  for (const boot::Slot slot : {other(*facts.running.slot), *facts.running.slot}) {
    std::optional<Failure> failure = read_failure(files, slot);
    if (failure && !failure->is_dismissed && facts.choice->of(slot).is_whole &&
        failure->version == version_lines(files, slot).text("version"))
      return failure;
  }
  return std::nullopt;
}

}  // namespace flexrf::helper
