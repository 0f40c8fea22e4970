// A drive whose process data do not work is stopped, and asked for its state, by SDO.
#pragma once

#include <optional>

#include "base/time.hpp"
#include "hal/canopen/sdo_client.hpp"

namespace flexrf::canopen::cia402 {

/// Writes *quick stop* to the controlword (object 6040) and reads the statusword (6041), one request at a
/// time, again and again. A drive may refuse to be written an object that is in a PDO; what it answers when
/// it is read counts all the same. One thread; never blocks, never allocates.
class SdoStop {
 public:
  /// The next request is the first one.
  void forget() noexcept { *this = SdoStop{}; }
  /// Once for each cycle. `stop`: a drive that has been asked for longer than this is written *disable
  /// voltage*. Returns the statusword, in the cycle in which it was answered.
  std::optional<std::uint16_t> advance(Duration stop, SdoClient& client, Time now, Outbox& outbox) noexcept;

 private:
  enum class Asked : std::uint8_t { nothing, write, read };

  Asked asked_ = Asked::nothing;
  std::optional<Time> since_;
};

}  // namespace flexrf::canopen::cia402
