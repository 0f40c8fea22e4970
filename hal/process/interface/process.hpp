// Process: a program that is run beside the application, fed and listened to by lines.
#pragma once

#include <string_view>

#include "process_interface.hpp"
#include "types/process_line.hpp"
#include "types/process_state.hpp"

namespace flexrf {

/// Everything: the thread the process lives in; nothing blocks. What a program moves by itself is not made
/// safe with the cell: it is no actuator, and runs on [process-12].
class Process : public ProcessInterface {
 public:
  using ProcessInterface::ProcessInterface;

  /// As of this cycle. A run has ended when its last line has been read [process-1].
  virtual ProcessState state() const noexcept = 0;

  /// Has it run, from the end of the cycle. Nothing where it does; what is ending is started again
  /// after [process-2].
  virtual void request_start() noexcept = 0;
  /// Has it end: asked first, killed after `stop_timeout` [process-3]. It is not started again by itself
  /// then [process-11].
  virtual void request_stop() noexcept = 0;

  /// For its standard input, with an end of line [process-4]. False, and nothing is written: it does not run,
  /// or has not read what it was given before (the bound is `input_capacity`) [process-5].
  virtual bool write_line(std::string_view line) noexcept = 0;
  /// The same, with the bytes as they are [process-6].
  virtual bool write(std::string_view bytes) noexcept = 0;
  /// Its input ends after what was written [process-7].
  virtual void close_input() noexcept = 0;
  static constexpr std::size_t input_capacity = 16384;  ///< bytes

  /// The next line that it printed, oldest first [process-8]; false: none now. With the queue `lines`
  /// connected they go there instead [process-9]. At most `line_capacity` wait; what comes then is dropped
  /// and counted [process-10].
  virtual bool read_line(ProcessLine& line) noexcept = 0;
  static constexpr std::size_t line_capacity = 64;
};

}  // namespace flexrf
