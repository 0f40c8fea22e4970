// MockProcess: a program whose part a test plays.
#pragma once

#include "hal/process/interface/hosted_process.hpp"
#include "hal/process/mock/mock_process_host.hpp"
#include "mock_process_driver.hpp"

namespace flexrf {

class MockProcess final : public HostedProcess<MockProcessDriver, MockProcessHost> {
 public:
  /// The far end.
  MockProcessHost& far_end() noexcept { return host(); }
};

}  // namespace flexrf
