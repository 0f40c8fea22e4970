#include "image/boot/verbs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "image/boot/environment.hpp"
#include "image/boot/repair.hpp"

namespace flexrf::boot {
namespace {

using Words = std::vector<std::string>;

Outcome failed(Exit code, std::string why) {
  return {code, {}, {std::move(why)}};
}

// A change of the choice, or the reason against it, for the slot that the arguments begin with.
using Change = Result<Choice> (*)(const Choice& choice, Slot slot, const Running& running);

Outcome change(Environment& environment, Slot slot, const Running& running, Change make) {
  const Result<Choice> next = make(environment.choice(), slot, running);
  if (!next) return failed(Exit::refused, next.status().cause());
  if (const Status written = environment.write(*next); !written) return failed(Exit::failed, written.cause());
  return {};
}

Result<Choice> choose(const Choice& choice, Slot slot, const Running&) {
  return with_primary(choice, slot);
}
Result<Choice> mark(const Choice& choice, Slot slot, const Running&) {
  return with_whole_mark(choice, slot);
}
Result<Choice> unmark(const Choice& choice, Slot slot, const Running&) {
  return without_whole_mark(choice, slot);
}
Result<Choice> confirm(const Choice& choice, Slot slot, const Running& running) {
  return with_confirmation(choice, slot, running);
}

const char* text_of(Marks marks) noexcept {
  return marks.is_confirmed ? "whole,confirmed" : marks.is_whole ? "whole,unconfirmed" : "not-whole";
}

std::string status_text(const Environment& environment, const Running& running) {
  const Choice& choice = environment.choice();
  const bool is_counted = environment.attempts().trial == choice.trial;
  char text[512];
  const int size = std::snprintf(
      text, sizeof(text),
      "primary=%c\nA=%s\nB=%s\ntrial=%010llu\nattempts=%u\nrunning=%c\nboot=%s\nconfirmed=%s\ncopies=%s\n",
      letter_of(choice.primary), text_of(choice.of(Slot::a)), text_of(choice.of(Slot::b)),
      static_cast<unsigned long long>(choice.trial), is_counted ? environment.attempts().count : 0,
      running.slot ? letter_of(*running.slot) : '-', running.why.empty() ? "-" : running.why.c_str(),
      running.slot && choice.of(*running.slot).is_confirmed ? "yes" : "no",
      environment.has_two_equal_copies() ? "equal" : "unequal");
  return {text, static_cast<std::size_t>(size)};
}

// Nothing may be there already: whoever has a disk with a choice on it wants another command.
Outcome create(Medium& medium) {
  for (const char* name : {copy_names[0], copy_names[1], attempts_name}) {
    const Result<std::string> block = medium.read(name);
    if (block || block.status().code() != StatusCode::not_found)
      return failed(Exit::refused, std::string(name) + " is there already, and 'create' is for a new disk");
  }
  Environment environment(medium);
  Status written = environment.write(Attempts{});
  if (written) written = environment.write(choice_of_new_disk());
  return written ? Outcome{} : failed(Exit::failed, written.cause());
}

Outcome mark_whole(Environment& environment, Medium& medium, Slot slot, const Words& words,
                   const Running& running) {
  // The mark must not reach the disk before what it speaks of.
  for (std::size_t i = 2; i < words.size(); ++i)
    if (const Status flushed = medium.flush_device(words[i]); !flushed)
      return failed(Exit::failed, flushed.cause());
  return change(environment, slot, running, mark);
}

/// Resets the count of attempts, and keeps what else GRUB has noted in the file. Refused for a version that
/// is not confirmed: its trial would never end.
Outcome give_attempts_back(Environment& environment, Slot slot, const Running& running) {
  const bool runs = running.slot == slot;
  if (!runs || !environment.choice().of(slot).is_confirmed) {
    std::string why = "the attempts stay counted: slot ";
    why += letter_of(slot);
    why += runs ? " has not been confirmed" : " does not run, and only what runs can have come up";
    return failed(Exit::refused, std::move(why));
  }
  Attempts attempts = environment.attempts();
  if (attempts.count == 0) return {};
  attempts.trial = 0;
  attempts.count = 0;
  const Status written = environment.write(attempts);
  return written ? Outcome{} : failed(Exit::failed, written.cause());
}

Outcome confirm_and_give_back(Environment& environment, Slot slot, const Running& running) {
  Outcome outcome = change(environment, slot, running, confirm);
  if (outcome.exit == Exit::done) outcome = give_attempts_back(environment, slot, running);
  return outcome;
}

Outcome with_choice(Environment& environment, Medium& medium, const Words& words, const Running& running) {
  const std::string& verb = words[0];
  if (verb == "get-primary")
    return {Exit::done, std::string(1, letter_of(environment.choice().primary)) + '\n', {}};
  if (verb == "status") return {Exit::done, status_text(environment, running), {}};
  const Slot slot = *slot_named(words[1]);
  if (verb == "get-state")
    return {Exit::done, environment.choice().of(slot).is_whole ? "good\n" : "bad\n", {}};
  if (verb == "set-primary") return change(environment, slot, running, choose);
  if (verb == "mark-whole") return mark_whole(environment, medium, slot, words, running);
  if (verb == "confirm" || (verb == "set-state" && words[2] == "good"))
    return confirm_and_give_back(environment, slot, running);
  if (verb == "came-up") return give_attempts_back(environment, slot, running);
  return change(environment, slot, running, unmark);
}

struct Verb {
  std::string_view name;
  std::size_t least_arguments;
  std::size_t most_arguments;
};

constexpr std::size_t any_number = 64;
constexpr std::array<Verb, 11> known_verbs = {{{"get-primary", 0, 0},
                                               {"set-primary", 1, 1},
                                               {"get-state", 1, 1},
                                               {"set-state", 2, 2},
                                               {"mark-whole", 2, any_number},
                                               {"unmark-whole", 1, 1},
                                               {"confirm", 1, 1},
                                               {"came-up", 1, 1},
                                               {"status", 0, 0},
                                               {"repair", 0, 0},
                                               {"create", 0, 0}}};

}  // namespace

std::optional<std::string> misuse_of(const std::vector<std::string>& words) {
  if (words.empty()) return "a verb is missing";
  const auto* const verb = std::find_if(known_verbs.begin(), known_verbs.end(),
                                        [&](const Verb& known) { return known.name == words[0]; });
  if (verb == known_verbs.end()) return "there is no verb '" + words[0] + "'";
  const std::size_t arguments = words.size() - 1;
  if (arguments < verb->least_arguments) return "'" + words[0] + "' lacks an argument";
  if (arguments > verb->most_arguments) return "'" + words[0] + "' has an argument too many";
  if (arguments > 0 && !slot_named(words[1]))
    return "there is no slot '" + words[1] + "'; the slots are A and B";
  if (words[0] == "set-state" && words[2] != "good" && words[2] != "bad")
    return "there is no state '" + words[2] + "'; the states are good and bad";
  return std::nullopt;
}

const char* const verbs_help =
    "RAUC's, as its custom backend for boot loaders:\n"
    "  get-primary                the slot that is meant to boot: A or B\n"
    "  set-primary SLOT           means this one; unless it is confirmed, a trial of three attempts begins\n"
    "  get-state SLOT             good if it is whole, else bad\n"
    "  set-state SLOT good|bad    good: confirm; bad: unmark-whole\n"
    "others:\n"
    "  unmark-whole SLOT          it is about to be written over: it does not boot from now on\n"
    "  mark-whole SLOT DEVICE...  all of it is written: flushes its partitions, then it may boot\n"
    "  confirm SLOT               the slot that runs found itself healthy\n"
    "  came-up SLOT               the slot that runs, and is confirmed, has come up: its attempts do not "
    "count\n"
    "  status                     all that is known, as lines NAME=VALUE\n"
    "  repair                     makes damaged files whole again\n"
    "  create                     makes the files for a new disk, on which slot A alone has a version\n";

Outcome perform(const std::vector<std::string>& words, Medium& medium, const Running& running) {
  if (const auto wrong = misuse_of(words)) return failed(Exit::usage, *wrong);
  if (words[0] == "create") return create(medium);
  Environment environment(medium);
  if (words[0] == "repair") return repair(environment, running);
  std::string damages = environment.damages();
  if (!environment.has_choice())
    return failed(Exit::failed,
                  damages.insert(0, "no copy of the boot choice can be read: ").append("; run 'repair'"));
  Outcome outcome = with_choice(environment, medium, words, running);
  if (!damages.empty()) outcome.said.insert(outcome.said.begin(), damages.append("; the other copy counts"));
  return outcome;
}

}  // namespace flexrf::boot
