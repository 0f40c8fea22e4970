#include "image/boot/choice.hpp"

#include <algorithm>
#include <charconv>

namespace flexrf::boot {
namespace {

constexpr std::array<std::string_view, 6> reasons = {"confirmed", "trial",   "only",
                                                     "fallback",  "unknown", "manual"};

std::uint64_t number_in(std::string_view text) noexcept {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && number <= last_counter ? number : 0;
}

}  // namespace

std::optional<Slot> slot_named(std::string_view name) noexcept {
  if (name == "A") return Slot::a;
  if (name == "B") return Slot::b;
  return std::nullopt;
}

Running running_from(std::string_view kernel_command_line) {
  constexpr std::string_view blanks = " \t\r\n";
  constexpr std::string_view slot_key = "rauc.slot=";
  constexpr std::string_view why_key = "flexrf.boot=";
  constexpr std::string_view trial_key = "flexrf.trial=";
  Running running;
  while (!kernel_command_line.empty()) {
    const std::size_t length =
        std::min(kernel_command_line.find_first_of(blanks), kernel_command_line.size());
    const std::string_view word = kernel_command_line.substr(0, length);
    kernel_command_line.remove_prefix(std::min(length + 1, kernel_command_line.size()));
    if (word.starts_with(slot_key)) {
      running.slot = slot_named(word.substr(slot_key.size()));
    } else if (word.starts_with(why_key)) {
      const std::string_view why = word.substr(why_key.size());
      running.why =
          std::find(reasons.begin(), reasons.end(), why) != reasons.end() ? why : std::string_view{};
    } else if (word.starts_with(trial_key)) {
      running.trial = number_in(word.substr(trial_key.size()));
    }
  }
  return running;
}

Choice choice_of_new_disk() noexcept {
  return choice_of_running(Slot::a);
}

Choice choice_of_running(Slot slot) noexcept {
  Choice choice;
  choice.primary = slot;
  choice.of(slot).is_whole = true;
  return choice;
}

Choice with_primary(Choice choice, Slot slot) noexcept {
  choice.primary = slot;
  choice.trial = choice.counter + 1;  // the one with which it will be written
  return choice;
}

Choice with_whole_mark(Choice choice, Slot slot) noexcept {
  choice.of(slot).is_whole = true;
  return choice;
}

Result<Choice> without_whole_mark(Choice choice, Slot slot) {
  if (!choice.of(other(slot)).is_whole)
    return Status::error(StatusCode::not_permitted,
                         "slot %c keeps its mark: slot %c is not whole, so nothing would be left to boot; "
                         "install a version into slot %c first",
                         letter_of(slot), letter_of(other(slot)), letter_of(other(slot)));
  choice.of(slot) = {};
  return choice;
}

Result<Choice> with_confirmation(Choice choice, Slot slot, const Running& running) {
  if (!running.slot)
    return Status::error(StatusCode::not_permitted,
                         "slot %c is not confirmed: the kernel's command line has no rauc.slot=A or =B, so "
                         "nothing tells which slot runs",
                         letter_of(slot));
  if (*running.slot != slot)
    return Status::error(StatusCode::not_permitted,
                         "slot %c is not confirmed: slot %c runs, and only what runs can be found healthy",
                         letter_of(slot), letter_of(*running.slot));
  if (!choice.of(slot).is_whole)
    return Status::error(StatusCode::not_permitted,
                         "slot %c is not confirmed: it is not marked as whole; if all of it was written, run "
                         "'mark-whole %c' first",
                         letter_of(slot), letter_of(slot));
  choice.of(slot).is_confirmed = true;
  if (running.why == "fallback" && running.trial == choice.trial) return with_primary(choice, slot);
  return choice;
}

}  // namespace flexrf::boot
