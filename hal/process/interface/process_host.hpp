// ProcessHost: what runs a program for a driver of Process.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"
#include "types/process_source.hpp"

namespace flexrf {

struct ProcessProgram {
  std::string executable;
  std::vector<std::string> arguments;    ///< without the program's name
  std::vector<std::string> environment;  ///< NAME=value
  std::string directory;
};

struct ProcessEvent {
  enum class Kind : std::uint8_t { started, refused, ended };
  Kind kind = Kind::started;
  int id = 0;         ///< of what started
  int code = 0;       ///< of what ended: its exit code, or
  int signal = 0;     ///< the signal that ended it; 0: it exited
  Time at{};          ///< of the end; 0: now
  Status cause;       ///< of what was refused
  bool last = false;  ///< no program can be started any more
};

/// open, wait: lifecycle thread. All else: the device's thread, or the lifecycle thread while it has the
/// device; none of it blocks or allocates. One program at a time.
class ProcessHost {
 public:
  virtual ~ProcessHost() = default;

  /// What start() runs from now on; nothing runs meanwhile.
  virtual Status open(const ProcessProgram& program) = 0;
  /// Returns when something has happened, or after this time.
  virtual void wait(Duration most) noexcept = 0;

  /// Asks for it; next_event() tells what came of it. False: it cannot even be asked for now.
  virtual bool start() noexcept = 0;
  /// Asks the program to end, or ends it.
  virtual void end(bool at_once) noexcept = 0;
  virtual bool next_event(ProcessEvent& event) noexcept = 0;
  /// Bytes that it printed: their number; 0: none now; −1: no more will come.
  virtual long read(ProcessSource source, std::span<char> bytes) noexcept = 0;
  /// How many bytes it took: 0: none now; −1: it takes none any more.
  virtual long write(std::string_view bytes) noexcept = 0;
  virtual void close_input() noexcept = 0;
  /// After the end of a run: nothing more is read or written of it.
  virtual void release() noexcept = 0;
};

}  // namespace flexrf
