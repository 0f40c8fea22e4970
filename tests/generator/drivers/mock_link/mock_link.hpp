#pragma once

#include "mock_link_driver.hpp"

namespace flexrf::user {

class MockLink final : public MockLinkDriver {
 public:
  void transfer() noexcept override { ++transfers_; }

 private:
  unsigned transfers_ = 0;
};

}  // namespace flexrf::user
