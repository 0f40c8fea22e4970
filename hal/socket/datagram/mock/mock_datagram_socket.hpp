// MockDatagramSocket: datagrams whose other ends a test plays.
#pragma once

#include "hal/socket/datagram/interface/datagram_socket_on.hpp"
#include "hal/socket/datagram/mock/mock_datagram_transport.hpp"
#include "mock_datagram_socket_driver.hpp"

namespace flexrf {

class MockDatagramSocket final : public DatagramSocketOn<MockDatagramSocketDriver, MockDatagramTransport> {
 public:
  /// The far ends.
  MockDatagramTransport& far_ends() noexcept { return transport(); }
};

}  // namespace flexrf
