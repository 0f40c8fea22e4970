#include "hal/canopen/sdo_stop.hpp"

#include <array>

#include "hal/canopen/cia402.hpp"

namespace flexrf::canopen::cia402 {

std::optional<std::uint16_t> SdoStop::advance(Duration stop, SdoClient& client, Time now,
                                              Outbox& outbox) noexcept {
  if (client.state() == SdoClient::State::busy) return std::nullopt;  // also with what was asked before
  if (!since_) since_ = now;
  if (asked_ == Asked::write) {
    asked_ = Asked::read;
    client.read(objects::statusword, now, outbox);
    return std::nullopt;
  }
  const bool is_answered = asked_ == Asked::read && client.state() == SdoClient::State::done;
  const auto statusword = static_cast<std::uint16_t>(client.number());
  asked_ = Asked::write;
  std::array<std::uint8_t, 2> word{};
  write_number(word.data(), word.size(),
               now - *since_ > stop ? command::disable_voltage : command::quick_stop);
  client.write(objects::controlword, word, now, outbox);
  return is_answered ? std::optional(statusword) : std::nullopt;
}

}  // namespace flexrf::canopen::cia402
