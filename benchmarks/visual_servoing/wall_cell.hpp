// WallCell: the application by the wall clock, with all rights that there are, and a thread beside it that
// measures.
#pragma once

#include <cstring>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/executive/executive.hpp"
#include "runtime/realtime/cpu_set.hpp"

namespace flexrf::bench {

/// One run, so one in each process. Everything but run(): what runs beside it.
class WallCell {
 public:
  WallCell();

  /// Runs the application until `beside` returns, which begins with the first cycle of the control thread and
  /// stays on the CPUs of what is not real-time. False: it could not be run, said why on standard error.
  bool run(const std::function<void()>& beside);

  bool is_realtime() const { return realtime_; }
  const CpuSet& control_cpus() const { return control_; }
  const CpuSet& other_cpus() const { return rest_; }

  /// Threads whose names begin so, as numbers in Application::threads.
  std::vector<std::size_t> threads(std::string_view name) const;
  const ThreadRecord& record(std::size_t thread) const { return application().threads[thread]; }
  const ThreadState& state(std::size_t thread) const { return application().thread_states[thread]; }
  /// Time on a CPU of all threads whose names begin so, as the kernel counts it.
  Duration cpu_time(std::string_view name) const;

  const SlotRecord& slot(const char* name) const;
  /// Items of all slots whose names begin so.
  std::uint64_t published(std::string_view name) const;
  /// Of a slot that is observed; false: nothing was published.
  template <class T>
  bool newest(const SlotRecord& slot, T& value) {
    const auto lock = executive_.cell().observe();
    if (slot.observer->newest() == nullptr) return false;
    std::memcpy(&value, slot.observer->payload(), sizeof(value));
    return true;
  }
  Executive& executive() { return executive_; }
  const Application& application() const { return *application_; }
  std::uint16_t unit(std::string_view name) const;

 private:
  const Application* application_;
  CpuSet control_;
  CpuSet rest_;
  Executive executive_;
  bool realtime_ = false;
};

/// Of the calling thread, in s.
void pause(double seconds);

}  // namespace flexrf::bench
