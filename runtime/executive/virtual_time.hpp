// Virtual time: the whole application on one thread under a simulated clock.
#pragma once

#include <chrono>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/releases.hpp"
#include "runtime/executive/supervision.hpp"

namespace flexrf {

/// Whether a unit of this thread declares no budget. Its steps last 1 us in virtual time, which is told: what
/// it publishes is seen sooner than on any machine.
bool lacks_budget(const Application& application, const ThreadRecord& thread) noexcept;

/// Logical execution time (Henzinger, Horowitz, Kirsch: "Giotto", 2003): a step reads at its release; what it
/// publishes becomes visible, and its thread goes on, when its declared budget (at least 1 us) is over.
/// Events are ordered by time, then completions before releases, then priority, then the threads' order in
/// the table. So a run depends on nothing but the tables, the seed and the input.
class VirtualTime {
 public:
  /// Where the simulated clock begins, so that no instant is "no time".
  static constexpr Time beginning{std::chrono::seconds{1}};

  /// While it lives, this thread's log messages carry its time.
  VirtualTime(Cell& cell, Lifecycle& lifecycle, Supervision& supervision);
  VirtualTime(const VirtualTime&) = delete;
  VirtualTime& operator=(const VirtualTime&) = delete;
  ~VirtualTime();

  /// Runs until the application ended; after `duration` it is told to stop. Returns the simulated time that
  /// passed.
  Duration run(Duration duration) noexcept;
  Time now() const noexcept { return now_; }

 private:
  enum class Phase : std::uint8_t { waiting, receiving, stepping };

  struct Thread {
    Thread(Cell& cell, std::uint16_t index);

    Stepper& stepper() noexcept { return releases.stepper(); }
    const ThreadRecord& record() const noexcept { return releases.stepper().record(); }

    Releases releases;
    Phase phase = Phase::waiting;
    Time next = Time::max();  // completion of what is under way, or the next release
    Due due{};
    Release release{};
    std::size_t place = 0;  // of the unit under way
    Time released_at{};
    std::uint32_t heard = 0;
    bool receives = false;  // has devices that publish
  };

  Thread* next_event() noexcept;
  void look_for_release(Thread& thread) noexcept;
  void begin(Thread& thread) noexcept;
  void complete(Thread& thread) noexcept;
  void commit_devices(const Thread& thread) noexcept;
  void go_on(Thread& thread) noexcept;
  void end(Thread& thread) noexcept;

  Cell* cell_;
  Lifecycle* lifecycle_;
  Supervision* supervision_;
  std::vector<Thread> threads_;
  Time now_{};
  std::uint32_t faults_ = 0;  // as many as restart policies have been asked about
};

}  // namespace flexrf
