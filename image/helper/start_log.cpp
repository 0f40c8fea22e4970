#include "image/helper/start_log.hpp"

#include <algorithm>
#include <ctime>

#include "image/helper/facts.hpp"
#include "image/helper/named_lines.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

/// GRUB counts the starts of the primary alone, and only while the other slot is whole.
bool is_counted(const Facts& facts) noexcept {
  if (!facts.choice || !facts.running.slot || facts.running.trial != facts.choice->trial) return false;
  return is_confirmed(facts) ? has_to_come_up(facts) && facts.running.why == "confirmed"
                             : facts.running.why == "trial";
}

/// The kernel's identifier as the journal has it. Empty: it cannot be read.
std::string boot_identifier(const std::string& file) {
  const Result<std::string> text = read_file(file);
  if (!text) return {};
  std::string digits;
  for (const char one : *text)
    if (one != '-' && one != '\n') digits += one;
  return digits;
}

}  // namespace

void StartLog::begin(const Facts& facts, const std::string& reason, Time now) {
  if (record_ || !is_counted(facts)) return;
  const StartRecord before = read_start_record(files_.update, *facts.running.slot);
  const std::string boot = boot_identifier(files_.boot_id);
  if (before.trial == facts.running.trial && !before.boots.empty() && before.boots.back() == boot) {
    record_ = before;
    written_reason_ = before.reason;
    return;
  }
  record_ = new_record(facts, boot, before);
  record_->reason = reason;
  write(facts, now);
}

void StartLog::note(const Facts& facts, const std::string& reason, Time now) {
  begin(facts, reason, now);
  if (!record_ || !is_counted(facts) || record_->has_given_up) return;
  record_->reason = reason;
  if (written_reason_ == reason || (written_at_ && now - *written_at_ < between_writes)) return;
  write(facts, now);
}

void StartLog::give_up(const Facts& facts, const std::string& reason, Time now) {
  begin(facts, reason, now);
  if (!record_ || !is_counted(facts)) return;
  record_->reason = reason;
  record_->has_given_up = true;
  write(facts, now);
}

void StartLog::clear(const Facts& facts) {
  if (!facts.running.slot) return;
  record_.reset();
  for (const std::string& file : {start_record_file(files_.update, *facts.running.slot),
                                  failure_file(files_.update, *facts.running.slot)})
    if (const Status removed = remove_file(file); !removed) say(removed);
}

void StartLog::keep_failure(const Facts& facts) {
  if (!is_fallen_back_to(facts)) return;
  Failure failure;
  failure.slot = other(*facts.running.slot);
  // A version that was never written completely did not fail: GRUB has not started it.
  if (!facts.choice->of(failure.slot).is_whole) return;
  const StartRecord last = read_start_record(files_.update, failure.slot);
  failure.version = version_lines(files_.update, failure.slot).text("version");
  failure.trial = facts.running.trial;
  if (last.trial == failure.trial) failure.last = last;
  failure.starts = std::max(facts.attempts, failure.last.start);
  const std::optional<Failure> kept = read_failure(files_.update, failure.slot);
  // Another boot of the same fallback tells nothing new, and an admin may have dismissed it.
  const bool is_kept = kept && kept->trial == failure.trial && kept->starts == failure.starts;
  if (!is_kept) {
    if (const Status written = write_failure(files_.update, failure); !written) return say(written);
  }
  if (const Status removed = remove_file(start_record_file(files_.update, failure.slot)); !removed)
    say(removed);
}

StartRecord StartLog::new_record(const Facts& facts, const std::string& boot, const StartRecord& before) {
  StartRecord record;
  record.trial = facts.running.trial;
  record.start = std::max(1U, facts.attempts);
  record.began = static_cast<std::uint64_t>(std::max<std::time_t>(0, std::time(nullptr)));
  // Without a greater number the count began from the first: the record is of starts before that.
  if (before.trial == record.trial && before.start < record.start) record.boots = before.boots;
  if (!boot.empty()) record.boots.push_back(boot);
  if (record.boots.size() > most_boots) record.boots.erase(record.boots.begin());
  return record;
}

void StartLog::write(const Facts& facts, Time now) {
  written_at_ = now;
  if (const Status written = write_start_record(files_.update, *facts.running.slot, *record_); !written)
    return say(written);
  written_reason_ = record_->reason;
  said_.clear();
}

void StartLog::say(const Status& failure) {
  const std::string line = std::string{"why this start fails could not be noted: "} + failure.cause();
  if (line == said_) return;
  said_ = line;
  surroundings_.say(line);
}

}  // namespace flexrf::helper
