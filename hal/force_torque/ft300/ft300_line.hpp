// Ft300Line: the thread that may wait for the line of an FT300.
#pragma once

#include <atomic>
#include <string>

#include "hal/driver/helper_thread.hpp"
#include "hal/force_torque/ft300/ft300_stream.hpp"
#include "hal/force_torque/ft300/serial_port.hpp"
#include "runtime/blackboard/ports.hpp"
#include "types/ft300_report.hpp"

namespace flexrf {

/// Opens the line, begins the sensor's stream, reads it, and does so again when either went away. What came
/// goes to the sensor's thread by a slot, and neither waits for the other.
class Ft300Line {
 public:
  Ft300Line() = default;
  Ft300Line(const Ft300Line&) = delete;
  Ft300Line& operator=(const Ft300Line&) = delete;
  ~Ft300Line() { stop(); }

  // ---- the lifecycle thread's

  /// `name`: the sensor's, which lives for ever. Error: what a person has to mend; a line that is not there
  /// or in use is waited for.
  Status start(const char* name, const std::string& device, std::uint8_t unit_id);
  /// Ends the sensor's stream, which may take half a second.
  void stop();

  // ---- the sensor's thread's

  /// What came, if anything did since it was last asked. Neither blocks nor allocates.
  const Ft300Report* take_news() noexcept;
  /// Readable when there is news.
  int descriptor() const noexcept { return news_; }

 private:
  void run();
  bool open_line();
  void ask(Time now);
  bool listen(Duration longest);
  bool read_line();
  void end_stream();
  void tell(const Status& trouble);
  void publish();

  std::string device_;
  std::uint8_t unit_id_ = ft300::usual_unit_id;
  SerialPort port_;
  ft300::Decoder decoder_;
  std::uint64_t damaged_before_ = 0;  // by decoders of lines that are gone
  Time quiet_since_{};                // no frame came since, and it was not asked
  bool asked_in_vain_ = false;
  Ft300Report report_{};
  StepContext context_;
  Output<Ft300Report> reports_;
  HelperThread thread_;

  // Between the two.
  Slot<Ft300Report, 1> slot_;
  int news_ = -1;
  std::atomic<bool> rung_{false};

  SlotReader reader_{&slot_.control()};
  std::uint64_t seen_ = 0;
};

}  // namespace flexrf
