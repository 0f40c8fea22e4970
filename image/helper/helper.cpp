#include "image/helper/helper.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "image/boot/blocks.hpp"
#include "image/boot/folder_medium.hpp"
#include "image/helper/facts.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

constexpr Duration wait_for_health = std::chrono::seconds{5};

/// The reason of a start that has answered nothing yet.
constexpr const char* no_answer_yet = "its application had not answered yet when it stopped";

std::string minutes_text(Duration duration) {
  return std::to_string(duration / std::chrono::minutes{1}) + " min";
}

/// Why a start came to nothing if it ends now.
std::string reason_now(const PanelAnswer& panel, const std::string& why_not, Duration needed) {
  if (why_not.empty())
    return "it was well, but not yet for " + std::to_string(needed / std::chrono::seconds{1}) +
           " s: the PC was restarted or switched off";
  return panel.has_answered ? why_not : "its application did not answer: " + why_not;
}

}  // namespace

Helper::Helper(Files files, Limits limits, const Surroundings& surroundings, MotionWord& word, Time began)
    : files_(std::move(files)),
      limits_(limits),
      surroundings_(surroundings),
      word_(word),
      began_(began),
      count_(limits.healthy),
      up_(limits.healthy),
      start_log_(files_, surroundings) {}

void Helper::look(Time now) {
  // The word first: the panel may take its time to answer.
  word_.renew();
  const Facts known = read_facts(files_, wait_for_choice);
  remember_version(known);
  tell_of_fallback(known);
  if (is_confirmed(known) && !is_fallen_back_to(known)) {
    note({});
    if (has_to_come_up(known)) await_start(known, now);
    return;
  }
  supervise(known, now);
  word_.renew();
}

Health Helper::health() const {
  const std::lock_guard lock(reading_);
  return health_;
}

void Helper::note(const Health& health) {
  const std::lock_guard lock(reading_);
  health_ = health;
}

/// Nobody else does for the version that the disk was made with.
void Helper::remember_version(const Facts& facts) {
  if (has_remembered_version_ || !facts.running.slot) return;
  has_remembered_version_ = true;
  const Result<std::string> version = read_file(files_.version);
  if (!version) return;  // `state` has none, either
  const std::string file = version_file(files_.update, *facts.running.slot);
  if (const Result<std::string> known = read_file(file); known && *known == *version) return;
  if (const Status written = replace_file(file, *version); !written)
    surroundings_.say(std::string{"the version in the other slot will not know what this one is called: "} +
                      written.cause());
}

/// For the panel and the screen, for as long as this version runs.
void Helper::tell_of_fallback(const Facts& facts) {
  if (has_told_of_fallback_ || facts.running.why != "fallback" || !facts.running.slot || !facts.choice)
    return;
  has_told_of_fallback_ = true;
  start_log_.keep_failure(facts);
  const std::string notice = files_.notices + "/fallback";
  std::error_code error;
  // The helper before this one told it, when the starts were still those that failed.
  if (std::filesystem::exists(notice, error)) return;
  const boot::Slot given_up = other(*facts.running.slot);
  const std::string slot{boot::letter_of(given_up)};
  const std::string version = version_lines(files_.update, given_up).text("version");
  std::string line = "slot " + slot + (version.empty() ? "" : ", version " + version + ",");
  line += !facts.choice->of(given_up).is_whole    ? " is not whole"
          : facts.attempts == boot::most_attempts ? " was started three times and did not come up"
                                                  : " could not be started";
  const Result<NamedLines> here = NamedLines::read(files_.version);
  line += "; version " + (here ? here->text("version") : std::string{"unknown"}) + " in slot " +
          boot::letter_of(*facts.running.slot) + " runs in its place";
  std::filesystem::create_directories(files_.notices, error);
  if (const Status written = replace_file(notice, line + '\n'); !written) surroundings_.say(written.cause());
  surroundings_.say(line);
}

void Helper::supervise(const Facts& facts, Time now) {
  // A version that was well for long enough and could not be confirmed has its record cleared already.
  if (!count_.is_enough()) start_log_.begin(facts, no_answer_yet, now);
  const PanelAnswer panel = surroundings_.ask_panel(wait_for_health);
  const std::string& why_not = panel.why_not_healthy;
  count_.note(why_not, now);
  note({count_.so_far(), why_not});
  say(why_not.empty() ? "the application is healthy; this version confirms itself when it has been so for " +
                            std::to_string(limits_.healthy / std::chrono::seconds{1}) + " s"
                      : "this version cannot confirm itself yet: " + why_not,
      said_health_);
  if (count_.is_enough()) {
    start_log_.clear(facts);
    confirm(facts);
  } else {
    note_reason(facts, panel, why_not, now);
    give_up_turn(facts, now, "this version is on trial and has not been healthy for long enough");
  }
}

/// A confirmed version has come up when its panel answers. A device in fault does not count: another version
/// would not mend it.
void Helper::await_start(const Facts& facts, Time now) {
  if (!up_.is_enough()) start_log_.begin(facts, no_answer_yet, now);
  const PanelAnswer panel = surroundings_.ask_panel(wait_for_health);
  const std::string why_not = panel.has_answered ? "" : panel.why_not_healthy;
  up_.note(why_not, now);
  if (up_.is_enough()) {
    start_log_.clear(facts);
    for (const std::string& line : perform(facts, "came-up").said) say(line, said_failure_);
  } else {
    note_reason(facts, panel, why_not, now);
    give_up_turn(facts, now, "the application of this version does not answer");
  }
}

void Helper::note_reason(const Facts& facts, const PanelAnswer& panel, const std::string& why_not, Time now) {
  const std::string reason = reason_now(panel, why_not, limits_.healthy);
  if (!why_not.empty()) last_trouble_ = reason;
  start_log_.note(facts, reason, now);
}

void Helper::give_up_turn(const Facts& facts, Time now, const std::string& why) {
  if (!has_another_turn(facts) || now - began_ < limits_.trial) return;
  began_ = now;  // should the restart fail, it is tried again after as long
  surroundings_.say(why + ", in " + minutes_text(limits_.trial) +
                    ": it gives up its turn, and the PC restarts");
  start_log_.give_up(facts,
                     "it was not well for long enough within " + minutes_text(limits_.trial) +
                         ", and gave up its turn" +
                         (last_trouble_.empty() ? "" : "; at last: " + last_trouble_),
                     now);
  if (const std::string failure = surroundings_.systemctl({"reboot"}); !failure.empty())
    surroundings_.say("the PC cannot be restarted: " + failure);
}

void Helper::confirm(const Facts& facts) {
  if (!facts.running.slot) return;
  const boot::Outcome outcome = perform(facts, "confirm");
  for (const std::string& line : outcome.said) say(line, said_failure_);
  if (outcome.exit != boot::Exit::done) return;
  const std::string slot{boot::letter_of(*facts.running.slot)};
  surroundings_.say("the version in slot " + slot + " has confirmed itself: it boots from now on");
}

boot::Outcome Helper::perform(const Facts& facts, const char* verb) {
  boot::FolderMedium medium;
  if (const Status opened = medium.open(files_.choice, wait_for_choice); !opened)
    return {boot::Exit::failed, {}, {opened.cause()}};
  const std::string slot{boot::letter_of(*facts.running.slot)};
  return boot::perform({verb, slot}, medium, facts.running);
}

void Helper::say(const std::string& line, std::string& said) const {
  if (line == said) return;
  said = line;
  surroundings_.say(line);
}

}  // namespace flexrf::helper
