#include "image/helper/helper.hpp"

#include <utility>

#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"
#include "image/helper/facts.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

constexpr Duration wait_for_health = std::chrono::seconds{5};

}  // namespace

Helper::Helper(Files files, Limits limits, const Surroundings& surroundings, MotionWord& word, Time began)
    : files_(std::move(files)),
      limits_(limits),
      surroundings_(surroundings),
      word_(word),
      began_(began),
      count_(limits.healthy) {}

void Helper::look(Time now) {
  // The word first: the panel may take its time to answer.
  word_.renew();
  const Facts known = read_facts(files_, wait_for_choice);
  remember_version(known);
  if (is_confirmed(known) && !is_fallen_back_to(known)) return note({});
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

void Helper::supervise(const Facts& facts, Time now) {
  const std::string why_not = surroundings_.ask_panel(wait_for_health).why_not_healthy;
  count_.note(why_not, now);
  note({count_.so_far(), why_not});
  say(why_not.empty() ? "the application is healthy; this version confirms itself when it has been so for " +
                            std::to_string(limits_.healthy / std::chrono::seconds{1}) + " s"
                      : "this version cannot confirm itself yet: " + why_not,
      said_health_);
  if (count_.is_enough()) {
    confirm(facts);
  } else if (has_another_turn(facts) && now - began_ >= limits_.trial) {
    began_ = now;  // should the restart fail, it is tried again after as long
    surroundings_.say("this version is on trial and has not been healthy for long enough in " +
                      std::to_string(limits_.trial / std::chrono::minutes{1}) +
                      " min: it gives up its turn, and the PC restarts");
    if (const std::string failure = surroundings_.systemctl({"reboot"}); !failure.empty())
      surroundings_.say("the PC cannot be restarted: " + failure);
  }
}

void Helper::confirm(const Facts& facts) {
  if (!facts.running.slot) return;
  const std::string slot{boot::letter_of(*facts.running.slot)};
  boot::FolderMedium medium;
  boot::Outcome outcome;
  if (const Status opened = medium.open(files_.choice, wait_for_choice); opened) {
    outcome = boot::perform({"confirm", slot}, medium, facts.running);
  } else {
    outcome = {boot::Exit::failed, {}, {opened.cause()}};
  }
  for (const std::string& line : outcome.said) say(line, said_failure_);
  if (outcome.exit == boot::Exit::done)
    surroundings_.say("the version in slot " + slot + " has confirmed itself: it boots from now on");
}

void Helper::say(const std::string& line, std::string& said) const {
  if (line == said) return;
  said = line;
  surroundings_.say(line);
}

}  // namespace flexrf::helper
