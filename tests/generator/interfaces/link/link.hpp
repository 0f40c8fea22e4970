#pragma once

#include "link_interface.hpp"

namespace flexrf::user {

class Link : public LinkInterface {
 public:
  /// How often a station was reached through it.
  virtual void transfer() noexcept = 0;
};

}  // namespace flexrf::user
