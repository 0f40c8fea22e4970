#pragma once

#include "publisher_unit.hpp"

namespace flexrf::user {

class Publisher final : public PublisherUnit {
 public:
  void step(const Tick& tick) override {
    Block all{};
    all.number = tick.number;
    for (auto& value : all.values) value = static_cast<std::uint32_t>(tick.number);
    block.publish(all);
    // Always as long as text: it is asked for beside a file of that size.
    reading.publish({0.125, 2.25, true});
  }
};

}  // namespace flexrf::user
