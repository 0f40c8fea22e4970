// What every driver of Process must do. A driver's test makes a world, which is the driver and the program
// that it runs, and runs the cases in it.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "hal/driver/device_bench.hpp"
#include "hal/process/interface/process.hpp"
#include "types/process_restart.hpp"

namespace flexrf {

/// What the world's program does.
enum class ProgramPart : std::uint8_t {
  echoes,            ///< prints each line that it is fed; exits with 0 when its input ends
  speaks_and_exits,  ///< prints `one`, `two`, on its standard error `three`, then `rest` without an end;
                     ///< exits with 3
  dies,              ///< is ended by signal 9 at once
  tells_itself,      ///< prints its first argument, then its variable GREETING, and exits with 0
  disobeys,          ///< prints `ready`, and goes on when it is asked to end
  floods,            ///< prints 1000 lines and exits with 0
  reads_nothing,     ///< prints `ready` and does not read
  leaves_children,   ///< prints `ready` and exits with 0; what it started has its output open
  is_missing,        ///< there is no such program
};

struct ProcessWishes {
  ProcessRestart restart = ProcessRestart::never;
  bool start = true;
  Duration stop_timeout = std::chrono::seconds(30);
  Duration restart_longest = std::chrono::milliseconds(50);
};

class ProcessWorld {
 public:
  virtual ~ProcessWorld() = default;

  /// Configures and initialises the driver. `sinks`: where its lines go; empty: not connected.
  virtual Status start(ProgramPart part, const ProcessWishes& wishes,
                       std::span<QueueSink* const> sinks = {}) = 0;
  virtual Process& process() = 0;
  virtual const ProcessFeedback& feedback() = 0;
  /// The thread's cycle, some milliseconds after the last one: receive, then what the unit does, then send.
  virtual void receive() = 0;
  virtual void send() = 0;
  /// Whether a process of this number is there.
  virtual bool is_there(int id) = 0;
  /// Ends what starts programs. False: cannot be made to happen here.
  virtual bool lose_helper() { return false; }
};

using MakeProcessWorld = std::unique_ptr<ProcessWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_process_conformance(const char* driver, MakeProcessWorld make);

}  // namespace flexrf
