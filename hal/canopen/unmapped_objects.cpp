#include "hal/canopen/unmapped_objects.hpp"

#include <array>
#include <utility>

#include "hal/canopen/pdo.hpp"

namespace flexrf::canopen::cia402 {

Status UnmappedObjects::advance(const Wanted& wanted, Node& node, Time now, Outbox& outbox) noexcept {
  SdoClient& client = node.client();
  if (client.state() == SdoClient::State::busy) return {};
  if (const Status refusal = take_answer(client); !refusal.is_ok()) return refusal;
  if (wanted.mode && ask_for_mode(*wanted.mode, client, now, outbox)) return {};
  if (wanted.speed) ask_for_speed(*wanted.speed, client, now, outbox);
  return {};
}

// True: it was asked for.
bool UnmappedObjects::ask_for_mode(Mode wanted, SdoClient& client, Time now, Outbox& outbox) noexcept {
  if (refused_mode_ == wanted || (told_mode_ == wanted && shown_ == wanted)) return false;
  asked_mode_ = wanted;
  if (told_mode_ == wanted) {
    asked_ = Asked::read_mode;
    client.read(objects::mode_display, now, outbox);
    return true;
  }
  const auto value = static_cast<std::uint8_t>(wanted);
  asked_ = Asked::write_mode;
  client.write(objects::mode, {&value, 1}, now, outbox);
  return true;
}

void UnmappedObjects::ask_for_speed(std::uint32_t wanted, SdoClient& client, Time now,
                                    Outbox& outbox) noexcept {
  if (told_speed_ == wanted || refused_speed_ == wanted) return;
  asked_speed_ = wanted;
  told_speed_.reset();
  asked_ = Asked::write_speed;
  std::array<std::uint8_t, 4> value{};
  write_number(value.data(), value.size(), wanted);
  client.write(objects::profile_velocity, value, now, outbox);
}

Status UnmappedObjects::take_answer(const SdoClient& client) noexcept {
  const Asked asked = std::exchange(asked_, Asked::nothing);
  if (asked == Asked::nothing) return {};
  if (client.state() == SdoClient::State::failed) {
    if (client.status().code() == StatusCode::timeout) return {};
    if (asked == Asked::write_speed) {
      refused_speed_ = asked_speed_;
    } else {
      refused_mode_ = asked_mode_;
    }
    return client.status();
  }
  switch (asked) {
    case Asked::write_mode:
      told_mode_ = asked_mode_;
      refused_mode_.reset();
      break;
    case Asked::write_speed:
      told_speed_ = asked_speed_;
      refused_speed_.reset();
      break;
    default:
      shown_ = static_cast<Mode>(with_sign(client.number() & 0xFF, 8));
      break;
  }
  return {};
}

}  // namespace flexrf::canopen::cia402
