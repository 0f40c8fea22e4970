#include "hal/servo_drive/canopen/simulator/tests/foreign_drive.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

using canopen::Message;
using canopen::Outbox;

constexpr std::uint8_t pre_operational = 127;
constexpr std::uint8_t operational = 5;
constexpr std::uint8_t stopped = 4;
constexpr double own_speed = 5000;  // where it has no object for it

constexpr std::uint32_t key(unsigned index, unsigned subindex) {
  return index << 8 | subindex;
}

bool is_listed(const std::vector<std::uint32_t>& list, std::uint32_t wanted) {
  return std::find(list.begin(), list.end(), wanted) != list.end();
}

std::uint32_t little_endian(const std::uint8_t* from, unsigned bytes) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) value |= std::uint32_t{from[i]} << (8 * i);
  return value;
}

}  // namespace

ForeignDrive::ForeignDrive(const Nature& nature) : nature_{nature}, position_{nature.position} {
  boot();
}

void ForeignDrive::add(std::uint16_t index, std::uint8_t subindex, unsigned bytes, std::uint32_t value,
                       bool writable, bool mappable) {
  const std::uint32_t at = key(index, subindex);
  if (is_listed(nature_.lacks, at)) return;
  objects_[at] = {value, bytes, writable && !is_listed(nature_.constant, at),
                  mappable && !is_listed(nature_.unmapped, at)};
}

// As it leaves the factory: PDOs as CiA 402 predefines them, in use.
void ForeignDrive::boot() {
  objects_.clear();
  add(0x1000, 0, 4, 0x00020192, false, false);
  add(0x1001, 0, 1, 0, false, false);
  add(0x1005, 0, 4, 0x80, true, false);
  add(0x1016, 0, 1, 1, false, false);
  add(0x1016, 1, 4, 0, true, false);
  add(0x1017, 0, 2, 0, true, false);
  add(0x1018, 0, 1, 2, false, false);
  add(0x1018, 1, 4, 0x123, false, false);
  add(0x1018, 2, 4, 0x456, false, false);
  for (std::uint16_t pdo = 0; pdo < 2; ++pdo) {
    const std::uint32_t received = pdo == 0 && nature_.identifier_of_first != 0
                                       ? nature_.identifier_of_first
                                       : 0x200U + 0x100U * pdo + nature_.node;
    const std::uint32_t sent = 0x180U + 0x100U * pdo + nature_.node;
    for (const bool is_sent : {false, true}) {
      const auto communication = static_cast<std::uint16_t>((is_sent ? 0x1800 : 0x1400) + pdo);
      const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
      add(communication, 0, 1, 2, false, false);
      add(communication, 1, 4, is_sent ? sent : received, true, false);
      add(communication, 2, 1, 255, true, false);
      add(mapping, 0, 1, 1, true, false);
      for (std::uint8_t entry = 1; entry <= 4; ++entry) {
        const std::uint32_t first = is_sent ? 0x60410010 : 0x60400010;
        add(mapping, entry, 4, entry == 1 ? first : 0, true, false);
      }
    }
  }
  add(0x6007, 0, 2, 1, true, false);
  add(0x6040, 0, 2, 0, true, true);
  add(0x6041, 0, 2, 0, false, true);
  add(0x6060, 0, 1, 0, true, true);
  add(0x6061, 0, 1, 0, false, true);
  add(0x6064, 0, 4, 0, false, true);
  if (nature_.quick_stop_option) add(0x605A, 0, 2, *nature_.quick_stop_option, true, false);
  if (nature_.window) add(0x6067, 0, 4, *nature_.window, true, false);
  add(0x606C, 0, 4, 0, false, true);
  add(0x607A, 0, 4, 0, true, true);
  add(0x6081, 0, 4, 777, true, true);
  add(0x6083, 0, 4, 1, true, false);
  add(0x6084, 0, 4, 1, true, false);
  add(0x6098, 0, 1, 35, true, false);
  add(0x6099, 0, 1, 2, false, false);
  add(0x6099, 1, 4, 0, true, false);
  add(0x6099, 2, 4, 0, true, false);
  add(0x60C0, 0, 2, 0, true, false);
  add(0x60C1, 0, 1, 1, false, false);
  add(0x60C1, 1, 4, 0, true, true);
  add(0x60C2, 0, 1, 2, false, false);
  add(0x60C2, 1, 1, 1, true, false);
  add(0x60C2, 2, 1, 0xFD, true, false);
  add(0x60FF, 0, 4, 0, true, true);
  nmt_ = 0;
  boots_in_ = 20;
  starts_in_.reset();
  master_silent_ = -1;
  waiting_.clear();
  asked_.reset();
  serves_in_ = 0;
  state_ = State::off;
  word_ = 0;
  velocity_ = 0;
  interpolates_now_ = acknowledged_ = false;
}

std::uint32_t ForeignDrive::object(std::uint16_t index, std::uint8_t subindex) const {
  const auto found = objects_.find(key(index, subindex));
  return found == objects_.end() ? 0 : found->second.value;
}

void ForeignDrive::receive(const Message& frame, Outbox& answers) {
  if (nmt_ == 0) return;
  const std::uint8_t node = nature_.node;
  if (frame.identifier == 0 && frame.size == 2 && (frame.data[1] == 0 || frame.data[1] == node)) {
    obey(frame.data[0]);
  } else if (nmt_ != stopped && frame.identifier == 0x600 + node && frame.size == 8) {
    asked_ = frame;
    serves_in_ = nature_.serves_after;
    if (serves_in_ == 0) serve(*asked_, answers);
  } else if (const std::uint32_t peer = object(0x1016, 1);
             peer != 0 && frame.identifier == 0x700 + (peer >> 16 & 0x7F)) {
    master_silent_ = 0;
  } else if (nmt_ == operational && frame.identifier == (object(0x1005) & 0x7FF)) {
    synchronise(answers);
  } else if (nmt_ == operational) {
    for (std::uint16_t pdo = 0; pdo < 2; ++pdo) {
      if (object(static_cast<std::uint16_t>(0x1400 + pdo), 1) != frame.identifier) continue;
      if (object(static_cast<std::uint16_t>(0x1400 + pdo), 2) <= 240) {
        waiting_[pdo] = frame;
      } else {
        unpack(pdo, frame);
      }
    }
  }
}

void ForeignDrive::obey(std::uint8_t command) {
  if (command == 0x01) nmt_ = operational;
  if (command == 0x02) nmt_ = stopped;
  if (command == 0x80) {
    nmt_ = pre_operational;
    if (!nature_.starts_again) starts_in_.reset();
  }
  if (command == 0x81 || command == 0x82) boot();
}

void ForeignDrive::serve(const Message& request, Outbox& answers) {
  const std::uint8_t command = request.data[0];
  if (command == 0x80) return;  // an abort of the client's
  const auto index = static_cast<std::uint16_t>(little_endian(&request.data[1], 2));
  const std::uint8_t subindex = request.data[3];
  Message answer = request;
  answer.identifier = static_cast<std::uint16_t>(0x580 + nature_.node);
  std::uint32_t abort = 0;
  const auto found = objects_.find(key(index, subindex));
  if (found == objects_.end()) {
    const auto any = objects_.lower_bound(key(index, 0));
    abort = any != objects_.end() && any->first >> 8 == index ? 0x06090011 : 0x06020000;
  } else if (command == 0x40) {
    const std::uint32_t value = found->second.value;
    answer.data[0] = static_cast<std::uint8_t>(0x43 | (4 - found->second.bytes) << 2);
    for (unsigned i = 0; i < 4; ++i) answer.data[4 + i] = static_cast<std::uint8_t>(value >> (8 * i));
  } else if ((command & 0xE3) == 0x23) {
    const unsigned bytes = 4U - (command >> 2 & 3U);
    abort = write(index, subindex, bytes, little_endian(&request.data[4], bytes));
    answer.data = {0x60, request.data[1], request.data[2], subindex};
  } else {
    abort = 0x05040001;
  }
  if (abort != 0) {
    aborts_.push_back(abort);
    answer.data[0] = 0x80;
    for (unsigned i = 0; i < 4; ++i) answer.data[4 + i] = static_cast<std::uint8_t>(abort >> (8 * i));
  }
  answers.push(answer);
}

std::uint32_t ForeignDrive::write(std::uint16_t index, std::uint8_t subindex, unsigned bytes,
                                  std::uint32_t value) {
  Entry& entry = objects_[key(index, subindex)];
  if (!entry.writable) return 0x06010002;
  if (bytes != entry.bytes) return 0x06070010;
  if (nature_.refuses_what_is_so && entry.value == value) return 0x08000022;
  if (const std::uint32_t abort = refusal_of(index, subindex, value); abort != 0) return abort;
  entry.value = value;
  act_on(index, subindex);
  return 0;
}

// CiA 301: identifiers and mappings are changed in pre-operational, a mapping while it is out of use.
std::uint32_t ForeignDrive::refusal_of(std::uint16_t index, std::uint8_t subindex,
                                       std::uint32_t value) const {
  const bool is_communication = (index & 0xFFFE) == 0x1400 || (index & 0xFFFE) == 0x1800;
  const bool is_mapping = (index & 0xFFFE) == 0x1600 || (index & 0xFFFE) == 0x1A00;
  if ((is_communication || is_mapping) && nmt_ != pre_operational) return 0x08000022;
  if (!is_mapping) return 0;
  const auto identifier = objects_.find(key(index - 0x200U, 1));
  if (identifier->second.writable && (identifier->second.value & 0x80000000) == 0) return 0x06010000;
  if (subindex == 0) return value <= 4 ? 0 : 0x06040042;
  if (object(index) != 0) return 0x06010000;
  const auto mapped = objects_.find(value >> 8);
  if (mapped == objects_.end()) return 0x06020000;
  return mapped->second.mappable && mapped->second.bytes * 8 == (value & 0xFF) ? 0 : 0x06040041;
}

void ForeignDrive::unpack(std::uint16_t number, const Message& frame) {
  const auto mapping = static_cast<std::uint16_t>(0x1600 + number);
  unsigned at = 0;
  for (unsigned entry = 1; entry <= object(mapping); ++entry) {
    const std::uint32_t word = object(mapping, static_cast<std::uint8_t>(entry));
    const unsigned bytes = (word & 0xFF) / 8;
    if (at + bytes > frame.size) return;
    objects_[word >> 8].value = little_endian(&frame.data[at], bytes);
    at += bytes;
    act_on(static_cast<std::uint16_t>(word >> 16), static_cast<std::uint8_t>(word >> 8));
  }
}

void ForeignDrive::act_on(std::uint16_t index, std::uint8_t subindex) {
  if (index == 0x6060) {
    const auto mode = static_cast<std::int8_t>(object(0x6060));
    const bool has_it =
        mode == 6 || (nature_.interpolates ? mode == 7 : mode == 1 || mode == 3 || mode == 8 || mode == 9);
    const bool is_another = object(0x6060) != object(0x6061);
    if (nature_.changes_mode_off && is_another && state_ == State::operation_enabled) {
      ++modes_refused_;
    } else if (has_it) {
      objects_[key(0x6061, 0)].value = object(0x6060);
    }
  }
  if (index == 0x6040 && nature_.acts_at_last)
    word_came_ = true;
  else if (index == 0x6040)
    take_controlword();
  if (index == 0x60C1 && subindex == 1) point_came_ = true;
}

// The state machine of CiA 402, and what the bits of the mode ask for when they rise.
void ForeignDrive::take_controlword() {
  const auto word = static_cast<std::uint16_t>(object(0x6040));
  const bool bit_4_rises = (word & 0x10) != 0 && (word_ & 0x10) == 0;
  const bool reset_rises = (word & 0x80) != 0 && (word_ & 0x80) == 0;
  word_ = word;
  const State before = state_;
  if (state_ == State::fault) {
    if (reset_rises) state_ = State::off;
  } else if ((word & 0x02) == 0) {
    state_ = State::off;  // disable voltage
  } else if ((word & 0x04) == 0) {
    if (state_ == State::operation_enabled)
      state_ = State::quick_stop;
    else if (state_ != State::quick_stop)
      state_ = State::off;
  } else if (state_ == State::quick_stop) {
    // Left by disable voltage alone.
  } else if ((word & 0x0F) == 0x06) {
    state_ = State::ready;
  } else if ((word & 0x0F) == 0x07) {
    if (state_ != State::off) state_ = State::switched_on;
  } else if ((word & 0x0F) == 0x0F) {
    if (state_ == State::switched_on) state_ = State::operation_enabled;
  }
  if (state_ != State::operation_enabled) {
    interpolates_now_ = acknowledged_ = false;
    return;
  }
  if (before != State::operation_enabled) {
    goal_ = position_;
    reached_ = true;
  }
  const std::uint32_t mode = object(0x6061);
  if (mode == 1) {
    const bool may_take = !nature_.finishes_targets || reached_;
    if (bit_4_rises && may_take) {
      const auto target = static_cast<std::int32_t>(object(0x607A));
      const bool has_speed = objects_.contains(key(0x6081, 0));
      set_points_.push_back({target, object(0x6081)});
      goal_ = target;
      goal_speed_ = has_speed ? object(0x6081) : own_speed;
      reached_ = false;
      acknowledged_ = true;
    } else if ((word & 0x10) == 0 && may_take) {
      acknowledged_ = false;
    }
  }
  if (mode == 6) {
    if (bit_4_rises) {
      homed_ = reached_ = false;
      goal_ = 0;
    }
  }
  if (mode == 7) {
    if (bit_4_rises) {
      interpolates_now_ = true;
    }
    if ((word & 0x10) == 0) interpolates_now_ = false;
  }
}

std::uint16_t ForeignDrive::statusword() const {
  std::uint16_t word = 0;
  switch (state_) {
    case State::off:
      word = 0x0240;
      break;
    case State::ready:
      word = 0x0231;
      break;
    case State::switched_on:
      word = 0x0233;
      break;
    case State::operation_enabled:
      word = 0x0237;
      break;
    case State::quick_stop:
      word = 0x0217;
      break;
    case State::fault:
      word = 0x0208;
      break;
  }
  if (reached_) word |= 0x0400;
  const std::uint32_t mode = object(0x6061);
  if (state_ != State::operation_enabled) return word;
  if (mode == 6 && homed_) word |= 0x1000;
  if (mode == 6 && nature_.homes_without_bit_10) word &= 0xFBFF;
  if ((mode == 1 && acknowledged_) || (mode == 7 && interpolates_now_) ||
      (mode == 8 && !nature_.leaves_bit_12))
    word |= 0x1000;
  return static_cast<std::uint16_t>((word | beside_) & ~never_);
}

void ForeignDrive::synchronise(Outbox& says) {
  for (std::uint16_t pdo = 0; pdo < 2; ++pdo) {
    const auto found = waiting_.find(pdo);
    if (found == waiting_.end()) continue;
    unpack(pdo, found->second);
    waiting_.erase(found);
  }
  if (word_came_) take_controlword();
  word_came_ = false;
  objects_[key(0x6041, 0)].value = statusword();
  objects_[key(0x6064, 0)].value = static_cast<std::uint32_t>(std::llround(position_));
  objects_[key(0x606C, 0)].value = static_cast<std::uint32_t>(std::llround(velocity_));
  for (std::uint16_t pdo = 0; pdo < 2; ++pdo) {
    const std::uint32_t identifier = object(static_cast<std::uint16_t>(0x1800 + pdo), 1);
    if ((identifier & 0x80000000) != 0 || object(static_cast<std::uint16_t>(0x1800 + pdo), 2) > 240) continue;
    const auto mapping = static_cast<std::uint16_t>(0x1A00 + pdo);
    Message frame;
    frame.identifier = static_cast<std::uint16_t>(identifier & 0x7FF);
    for (unsigned entry = 1; entry <= object(mapping); ++entry) {
      const std::uint32_t word = object(mapping, static_cast<std::uint8_t>(entry));
      const std::uint32_t value = object(static_cast<std::uint16_t>(word >> 16), word >> 8 & 0xFF);
      for (unsigned i = 0; i < (word & 0xFF) / 8; ++i)
        frame.data[frame.size++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    says.push(frame);
  }
}

void ForeignDrive::step(Outbox& says) {
  const auto say_state = [this, &says] {
    Message frame;
    frame.identifier = static_cast<std::uint16_t>(0x700 + nature_.node);
    frame.size = 1;
    frame.data[0] = nmt_;
    says.push(frame);
  };
  if (nmt_ == 0) {
    if (--boots_in_ > 0) return;
    say_state();
    nmt_ = pre_operational;
    starts_in_ = nature_.starts_itself;
    if (starts_in_ == 0) nmt_ = operational;
  }
  if (starts_in_ && (*starts_in_)-- == 0) {
    nmt_ = operational;
    starts_in_.reset();
  }
  if (serves_in_ > 0 && --serves_in_ == 0) serve(*asked_, says);
  if (const auto period = static_cast<int>(object(0x1017)); period > 0 && --beats_in_ <= 0) {
    beats_in_ = period;
    say_state();
  }
  if (master_silent_ >= 0 && ++master_silent_ > static_cast<int>(object(0x1016, 1) & 0xFFFF)) {
    master_silent_ = -1;
    if (state_ == State::operation_enabled && object(0x6007) == 3) state_ = State::quick_stop;
  }
  move();
}

void ForeignDrive::move() {
  constexpr double step_s = 0.001;
  const double before = position_;
  const auto towards = [this](double place, double speed) {
    const double most = speed * step_s;
    position_ += std::clamp(place - position_, -most, most);
  };
  const std::uint32_t mode = object(0x6061);
  if (state_ == State::operation_enabled && (word_ & 0x100) == 0 && !sticks_) {
    if (mode == 1) {
      const double place = goal_ > position_ ? goal_ - nature_.stops_short : goal_ + nature_.stops_short;
      if (std::abs(goal_ - position_) > nature_.stops_short) towards(place, goal_speed_);
      if (std::abs(position_ - goal_) <= std::max<double>(0.5, nature_.window.value_or(0))) reached_ = true;
    }
    if (mode == 6 && (word_ & 0x10) != 0) {
      towards(goal_, 2000);
      homed_ = reached_ = std::abs(position_) < 0.5;
    }
    if (mode == 9) position_ += static_cast<std::int32_t>(object(0x60FF)) * step_s;
    if (mode == 3) {
      constexpr double ramp = 10000;  // increments/s^2
      const double asked = static_cast<std::int32_t>(object(0x60FF));
      ramped_ += std::clamp(asked - ramped_, -ramp * step_s, ramp * step_s);
      position_ += ramped_ * step_s;
    }
    if (mode == 8) towards(static_cast<std::int32_t>(object(0x607A)), 30000);
    if (mode == 7 && interpolates_now_) {
      const auto point = static_cast<std::int32_t>(object(0x60C1, 1));
      if (point_came_) longest_jump_ = std::max(longest_jump_, std::abs(point - position_));
      towards(point, 30000);
    }
  }
  point_came_ = false;
  velocity_ = (position_ - before) / step_s;
}

}  // namespace flexrf
