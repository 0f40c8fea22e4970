// MockProcess: a program whose part a test plays.
#pragma once

#include "hal/interfaces/process/hosted_process.hpp"
#include "hal/mock/mock_process/mock_process_host.hpp"
#include "mock_process_driver.hpp"

namespace flexrf {

class MockProcess final : public HostedProcess<MockProcessDriver, MockProcessHost> {
 public:
  /// The far end.
  MockProcessHost& far_end() noexcept { return host(); }
};

}  // namespace flexrf
