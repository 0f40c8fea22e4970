// In the guest: the adapter of a serial line, which can be pulled out and plugged in again.
#pragma once

#include <string>

namespace flexrf {

/// The kernel's driver of the UART is taken from it and given back to it: who has the line open is hung up,
/// as with an adapter that is gone, and until it is back nobody can use it. One thread.
class SerialAdapter {
 public:
  /// `line`: as "ttyS2"; its driver has it.
  explicit SerialAdapter(const char* line);
  /// Plugs it in.
  ~SerialAdapter() { plug_in(); }
  SerialAdapter(const SerialAdapter&) = delete;
  SerialAdapter& operator=(const SerialAdapter&) = delete;

  bool unplug();
  bool plug_in();

 private:
  std::string port_;  // as the bus of such devices calls it
  bool plugged_ = true;
};

}  // namespace flexrf
