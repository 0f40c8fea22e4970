// MockStreamSocket: connections whose other end a test plays.
#pragma once

#include "hal/socket/stream/interface/stream_socket_on.hpp"
#include "hal/socket/stream/mock/mock_stream_transport.hpp"
#include "mock_stream_socket_driver.hpp"

namespace flexrf {

class MockStreamSocket final : public StreamSocketOn<MockStreamSocketDriver, MockStreamTransport> {
 public:
  /// The far ends.
  MockStreamTransport& far_ends() noexcept { return transport(); }
};

}  // namespace flexrf
