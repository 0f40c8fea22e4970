#include "image/helper/helper.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "image/boot/environment.hpp"
#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::helper {
namespace {

/// Another process has it only for as long as a change takes; the next look comes soon.
constexpr Duration wait_for_choice = std::chrono::seconds{2};

bool has_admin(const std::string& file) {
  const Result<panel::Users> users = panel::read_users(file);
  if (!users) return false;
  for (const panel::User& user : users->list) {
    if (user.role == Role::admin) return true;
  }
  return false;
}

}  // namespace

Helper::Helper(Files files, Limits limits, Surroundings surroundings, Time began)
    : files_(std::move(files)),
      limits_(limits),
      surroundings_(std::move(surroundings)),
      began_(began),
      health_(limits.healthy) {}

Facts Helper::facts() const {
  Facts facts;
  facts.is_claimed = has_admin(files_.users);
  std::ifstream file(files_.command_line);
  facts.running =
      boot::running_from(std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
  boot::FolderMedium medium;
  if (const Status opened = medium.open(files_.choice, wait_for_choice); !opened) {
    facts.choice_failure = opened.cause();
    return facts;
  }
  const boot::Environment environment(medium);
  if (environment.has_choice()) {
    facts.choice = environment.choice();
  } else {
    facts.choice_failure = environment.damages();
  }
  return facts;
}

void Helper::look(Time now) {
  // The word first: the panel may take its time to answer.
  const Facts known = facts();
  leave_word(permission_of(known));
  if (is_confirmed(known)) return;
  supervise(known, now);
  leave_word(permission_of(facts()));
}

void Helper::supervise(const Facts& facts, Time now) {
  const std::string why_not = surroundings_.why_not_healthy();
  health_.note(why_not, now);
  say(why_not.empty() ? "the application is healthy; this version confirms itself when it has been so for " +
                            std::to_string(limits_.healthy / std::chrono::seconds{1}) + " s"
                      : "this version cannot confirm itself yet: " + why_not,
      said_health_);
  if (health_.is_enough()) {
    confirm(facts);
  } else if (has_another_turn(facts) && now - began_ >= limits_.trial) {
    began_ = now;  // should the restart fail, it is tried again after as long
    surroundings_.say("this version is on trial and has not been healthy for long enough in " +
                      std::to_string(limits_.trial / std::chrono::minutes{1}) +
                      " min: it gives up its turn, and the PC restarts");
    surroundings_.restart();
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

void Helper::leave_word(const std::string& word) {
  if (word == word_) return;
  // In memory, not on a disk: to replace it is all that matters.
  if (const Status written = replace_file(files_.word, word + '\n'); !written) {
    say("the word about motion cannot be left: " + std::string{written.cause()}, said_failure_);
    return;
  }
  word_ = word;
  surroundings_.say(word == "permitted" ? "motion is permitted" : "motion is not permitted: " + word);
}

void Helper::say(const std::string& line, std::string& said) const {
  if (line == said) return;
  said = line;
  surroundings_.say(line);
}

}  // namespace flexrf::helper
