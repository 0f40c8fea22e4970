// Notes how late each step began, where the benchmark that runs the application can read it.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "lateness_probe_unit.hpp"

namespace flexrf::user {

/// Set before the start, in memory that outlives the application.
struct LatenessRecord {
  std::span<std::int64_t> nanoseconds;
  std::atomic<std::size_t>* count = nullptr;
};
inline LatenessRecord lateness_record;

class LatenessProbe final : public LatenessProbeUnit {
 public:
  void step(const Tick& tick) override {
    const std::size_t count = lateness_record.count->load(std::memory_order_relaxed);
    if (count == lateness_record.nanoseconds.size()) return;
    lateness_record.nanoseconds[count] = tick.lateness.count();
    lateness_record.count->store(count + 1, std::memory_order_release);
  }
};

}  // namespace flexrf::user
