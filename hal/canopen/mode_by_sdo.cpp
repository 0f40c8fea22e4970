#include "hal/canopen/mode_by_sdo.hpp"

#include <utility>

#include "hal/canopen/pdo.hpp"

namespace flexrf::canopen::cia402 {

Status ModeBySdo::advance(Mode wanted, Node& node, Time now, Outbox& outbox) noexcept {
  SdoClient& client = node.client();
  if (client.state() == SdoClient::State::busy) return {};
  if (const Status refusal = take_answer(client); !refusal.is_ok()) return refusal;
  if (refused_ == wanted || (told_ == wanted && shown_ == wanted)) return {};
  asked_for_ = wanted;
  if (told_ == wanted) {
    asked_ = Asked::read;
    client.read(objects::mode_display, now, outbox);
    return {};
  }
  const auto value = static_cast<std::uint8_t>(wanted);
  asked_ = Asked::write;
  client.write(objects::mode, {&value, 1}, now, outbox);
  return {};
}

Status ModeBySdo::take_answer(const SdoClient& client) noexcept {
  const Asked asked = std::exchange(asked_, Asked::nothing);
  if (asked == Asked::nothing) return {};
  if (client.state() == SdoClient::State::failed) {
    if (client.status().code() == StatusCode::timeout) return {};
    refused_ = asked_for_;
    return client.status();
  }
  if (asked == Asked::write) {
    told_ = asked_for_;
    refused_.reset();
  } else {
    shown_ = static_cast<Mode>(with_sign(client.number() & 0xFF, 8));
  }
  return {};
}

}  // namespace flexrf::canopen::cia402
