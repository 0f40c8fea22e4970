#include "hal/servo_drive/canopen/simulator/drive_console.hpp"

#include <charconv>
#include <cstdio>

#include "hal/canopen/can_message.hpp"

namespace flexrf {
namespace {

using canopen::cia402::DriveState;

constexpr const char* obeyed = "ok";

// The first word of a text, which loses it.
std::string_view take_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r"), text.size());
  text.remove_prefix(begin);
  const std::size_t end = std::min(text.find_first_of(" \t\r"), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r"), text.size()));
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
  return word;
}

// "500", "0x2310".
std::optional<std::uint64_t> number_in(std::string_view text) {
  const bool is_hexadecimal = text.starts_with("0x");
  if (is_hexadecimal) text.remove_prefix(2);
  std::uint64_t value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, is_hexadecimal ? 16 : 10);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "6040", "1018:01"; hexadecimal, as they are written everywhere.
std::optional<canopen::ObjectAddress> object_in(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto index = number_in("0x" + std::string(text.substr(0, colon)));
  const auto subindex = colon == std::string_view::npos
                            ? std::optional<std::uint64_t>{0}
                            : number_in("0x" + std::string(text.substr(colon + 1)));
  if (!index || !subindex || *index > 0xFFFF || *subindex > 0xFF) return std::nullopt;
  return canopen::ObjectAddress{static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*subindex)};
}

// "3000", "-20".
std::optional<double> position_in(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  const auto number = number_in(text.substr(is_negative ? 1 : 0));
  if (!number || *number > 0x7FFFFFFF) return std::nullopt;
  const auto place = static_cast<double>(*number);
  return is_negative ? -place : place;
}

std::optional<DriveState> state_named(std::string_view text) {
  for (const DriveState one :
       {DriveState::not_ready, DriveState::switch_on_disabled, DriveState::ready_to_switch_on,
        DriveState::switched_on, DriveState::operation_enabled, DriveState::quick_stop_active,
        DriveState::fault_reaction, DriveState::fault}) {
    if (text == canopen::cia402::name_of(one)) return one;
  }
  return std::nullopt;
}

}  // namespace

const char* const DriveConsole::help =
    "off, on                     its supply\n"
    "reset                       it resets itself, as when its supply sags\n"
    "silence, speak              its heartbeat, or its answers to guarding\n"
    "stick STATE, free           commands no longer lead out of a state, as 'switched on'; they do\n"
    "trip CODE [stays], heal     a fault with this error code, whose cause goes by itself or not; it goes\n"
    "keep mode, take mode        it stays in the mode that it is in; it changes it\n"
    "lose home, find home        its homing fails; it does not\n"
    "block below P, block above P   something is in its way at this position; unblock\n"
    "cut motor, join motor       its motor's wires: without them it has no torque\n"
    "refuse INDEX:SUB CODE, accept   writes of this object end with this abort code; they do not\n"
    "object INDEX:SUB VALUE      what an object is from now on, and after each power-on\n"
    "lack INDEX:SUB              it has no such object\n"
    "unmap INDEX:SUB             it does not take this object into a PDO\n"
    "refuse bit 30               in the identifiers of the PDOs that it sends\n"
    "fix mapping                 its PDO mappings can no longer be written\n"
    "unplug, plug                its cable\n"
    "delay MS                    all that it says comes so much later; 0 ends it\n"
    "garbage                     truncated and foreign messages, once\n"
    "state                       what it is doing\n";

DriveConsole::DriveConsole(const SimulatedCia402Drive::Options& options, Time now)
    : node_{options.node}, drive_{options}, now_{now} {
  drive_.power_on(now);
}

std::string DriveConsole::obey(std::string_view line) {
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  const std::string answer = change(word, rest);
  collect();
  return answer;
}

std::string DriveConsole::change(std::string_view word, std::string_view rest) {
  if (word == "on") {
    drive_.power_on(now_);
  } else if (word == "off") {
    drive_.power_off();
  } else if (word == "reset") {
    drive_.reset_itself(now_);
  } else if (word == "silence" || word == "speak") {
    drive_.silence_heartbeat(word == "silence");
  } else if (word == "free") {
    drive_.stick_in(std::nullopt);
  } else if (word == "heal") {
    drive_.heal();
  } else if (word == "unplug" || word == "plug") {
    plugged_ = word == "plug";
  } else if (word == "garbage") {
    talk_garbage();
  } else if (word == "state") {
    return describe();
  } else if (word == "help") {
    return help;
  } else if ((word == "keep" || word == "take") && rest == "mode") {
    drive_.ignore_mode(word == "keep");
  } else if ((word == "lose" || word == "find") && rest == "home") {
    drive_.lose_home(word == "lose");
  } else if ((word == "cut" || word == "join") && rest == "motor") {
    drive_.cut_motor(word == "cut");
  } else if (word == "unblock") {
    drive_.block(std::nullopt, std::nullopt);
  } else if (word == "block") {
    const std::string_view side = take_word(rest);
    const auto place = position_in(rest);
    if (!place || (side != "below" && side != "above")) return "what is in its way is written as below 3000";
    const bool is_below = side == "below";
    drive_.block(is_below ? place : std::nullopt, is_below ? std::nullopt : place);
  } else if (word == "fix" && rest == "mapping") {
    drive_.objects().fix_mapping();
  } else if (word == "refuse" && rest == "bit 30") {
    drive_.objects().refuse_bit_30();
  } else if (word == "stick") {
    const auto where = state_named(rest);
    if (!where) return "there is no state '" + std::string(rest) + "'";
    drive_.stick_in(where);
  } else if (word == "trip") {
    const auto code = number_in(take_word(rest));
    if (!code || *code > 0xFFFF) return "an error code is written as 0x2310";
    drive_.trip(static_cast<std::uint16_t>(*code), rest == "stays", said_);
  } else if (word == "delay") {
    const auto time = number_in(rest);
    if (!time || *time > 60'000) return "a delay is a number of ms, at most 60000";
    delay_ = std::chrono::milliseconds(*time);
  } else {
    return change_object(word, rest);
  }
  return obeyed;
}

std::string DriveConsole::change_object(std::string_view word, std::string_view rest) {
  if (word == "accept") {
    drive_.objects().refuse({}, 0);
    return obeyed;
  }
  if (word == "lack" || word == "unmap") {
    const auto object = object_in(rest);
    if (!object) return "an object is written as 60C2:01";
    if (word == "lack") drive_.objects().lack(*object);
    if (word == "unmap") drive_.objects().unmap(*object);
    return obeyed;
  }
  if (word != "refuse" && word != "object")
    return "unknown: '" + std::string(word) + "'; help tells what is known";
  const auto address = object_in(take_word(rest));
  const auto value = number_in(rest);
  if (!address || !value) return "an object and a number are written as 1018:01 0x123";
  if (word == "refuse") {
    drive_.objects().refuse(*address, static_cast<std::uint32_t>(*value));
  } else {
    drive_.objects().set_first(*address, *value);
  }
  return obeyed;
}

std::string DriveConsole::describe() const {
  char text[160];
  std::snprintf(text, sizeof text, "node %u is %s, %s, at %.0f with %.0f/s", unsigned{node_},
                canopen::name_of(drive_.nmt_state()), canopen::cia402::name_of(drive_.state()),
                drive_.motion().position(), drive_.motion().velocity());
  return text;
}

void DriveConsole::talk_garbage() {
  using namespace std::string_view_literals;
  const auto own = [this](std::uint16_t base) { return std::uint32_t{canopen::identifier_of(base, node_)}; };
  const std::uint32_t states = canopen::transmit_pdo_identifier(1, node_);
  say(states, "");
  say(states, "\x37\x02\xFF"sv);  // a PDO that ends in the midst of its second object
  say(canopen::transmit_pdo_identifier(2, node_), "\xFF"sv);
  say(own(canopen::emergency_base), "\x10\x23"sv);
  say(own(canopen::heartbeat_base), "");
  say(own(canopen::heartbeat_base), "\x05\x7F\x04"sv);
  say(own(canopen::sdo_answer_base), "\x60\x40"sv);
  say(own(canopen::sdo_answer_base), "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"sv);
  say(own(canopen::sdo_answer_base), "\x43\x00\x20\x00\x01\x02\x03\x04"sv);  // of an object nobody asked for
  say(0x7FF, "\x01\x02\x03\x04\x05\x06\x07\x08"sv);
  say(states, "\x18\x00\x00\x00\x00\x00\x00"sv, true);  // the same number, of 29 bits
  say(states, "", false, true);
}

void DriveConsole::say(std::uint32_t identifier, std::string_view data, bool extended, bool remote) {
  CanFrame frame;
  frame.identifier = identifier;
  frame.length = static_cast<std::uint8_t>(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) frame.data[i] = static_cast<std::uint8_t>(data[i]);
  frame.extended = extended;
  frame.remote = remote;
  waiting_.push_back({now_ + delay_, frame});
}

void DriveConsole::on_frame(const CanFrame& frame, CanPort& port) noexcept {
  if (!plugged_ || frame.extended) return;
  drive_.receive(canopen::to_message(frame), frame.time, said_);
  collect();
  flush(port);
}

void DriveConsole::on_time(Time now, CanPort& port) noexcept {
  now_ = now;
  drive_.advance(now, said_);
  collect();
  flush(port);
}

void DriveConsole::collect() {
  for (; !said_.is_empty(); said_.pop()) {
    waiting_.push_back({now_ + delay_, canopen::to_frame(said_.front())});
  }
}

// What is due; what the port does not take waits.
void DriveConsole::flush(CanPort& port) {
  while (!waiting_.empty() && waiting_.front().due <= now_) {
    if (plugged_ && !port.send(waiting_.front().frame)) return;
    waiting_.pop_front();
  }
}

}  // namespace flexrf
