// CanopenGpioChip: a CiA 401 module on a CAN bus.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string_view>

#include "canopen_gpio_chip_driver.hpp"
#include "hal/can/interface/can_bus.hpp"
#include "hal/gpio/chip/canopen/io_line.hpp"
#include "hal/gpio/chip/canopen/io_module.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {

/// It is brought up in the thread that it lives in, an answer in each cycle: initialise() does not wait for
/// it, and a module that is switched on later comes up then. Its lines can be asked for at once; they are
/// away until it is there, and whenever it is not.
///
/// Outputs are told their safe values before the module is started, by the process should it die, and each
/// time that the module comes back; an output that no device has is at its safe value. A line that is asked
/// for with another safe value than the module was told has it brought up anew, with all that it is told.
///
/// An output is safe once the module, asked for its outputs, has answered that they are as they were told.
class CanopenGpioChip final : public CanopenGpioChipDriver {
 public:
  CanopenGpioChip();

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;

  Result<GpioLine*> request(const GpioLineSettings& settings) override;
  void release(GpioLine* line) noexcept override;

 private:
  static constexpr unsigned lines_of_direction = 8 * canopen::cia401::most_bytes;

  IoLine* find(std::string_view line) noexcept;
  Status check(const GpioLineSettings& settings, const IoLine& line) const;
  void pass_on(std::uint64_t changed, Time at) noexcept;
  void renew_image() noexcept;
  void confirm_outputs(Time now) noexcept;
  void tell() noexcept;
  void tell_outputs(Time now) noexcept;

  canopen::IoModulePlan plan_;
  canopen::IoModule module_;
  canopen::Outbox outbox_;
  CanInbox inbox_;
  int last_word_ = CanBus::no_last_word;  // its place
  bool began_ = false;
  std::uint64_t safe_told_ = 0;
  IoImage image_;
  std::optional<std::uint64_t> sent_;  // outputs, since the module is there
  Time sent_at_{};
  StatusCode logged_ = StatusCode::ok;
  std::uint64_t logged_emergencies_ = 0;
  LogLimit begins_;
  LogLimit ends_;
  LogLimit emergencies_;

  std::array<IoLine, lines_of_direction> inputs_;
  std::array<IoLine, lines_of_direction> outputs_;
  // Asked for and given back by the lifecycle thread, while the chip's own goes on.
  std::atomic<std::uint64_t> safe_{0};     // of the outputs
  std::atomic<std::uint64_t> renewed_{0};  // outputs that are to be at their safe values
  std::atomic<std::uint32_t> requested_{0};
  std::mutex mutex_;  // of what follows; never taken in a cycle
  bool open_ = false;
  std::uint64_t taken_inputs_ = 0;
  std::uint64_t taken_outputs_ = 0;
};

}  // namespace flexrf
