// A station behind a link: what its drivers, real and simulated, have in common.
#pragma once

#include "hal/modbus/link/interface/modbus_link.hpp"
#include "hal/modbus/station/interface/modbus_station.hpp"

namespace flexrf {

/// The station's end of its exchange with the link. The thread the station lives in, but for attach() and
/// detach(): the lifecycle thread.
class StationEnd {
 public:
  ~StationEnd() { detach(); }
  StationEnd() = default;
  StationEnd(const StationEnd&) = delete;
  StationEnd& operator=(const StationEnd&) = delete;

  Status attach(ModbusLink& link, const ModbusStationSetup& setup, Duration max_age);
  void detach() noexcept;

  /// Takes what the link knows; valid until the next call.
  const ModbusImage& update(Time now) noexcept;
  ModbusValue read(std::size_t index) const noexcept;
  ModbusText read_text(std::size_t index) const noexcept;
  /// Hands the outputs over, if they are others than before or `anew`.
  void send(const StationOutputs& outputs, bool safe, bool anew = false) noexcept;
  /// What was handed over last is in the station, as its answers say.
  bool is_written() const noexcept;

 private:
  /// The words of a register, and how old they are or why nothing is known of them.
  struct Known {
    ModbusValue state;
    const ModbusRegister* meaning = nullptr;  // null: there are no words
    const std::uint16_t* words = nullptr;
  };
  Known look_up(std::size_t index) const noexcept;

  ModbusExchange* exchange_ = nullptr;
  const ModbusImage* image_ = nullptr;
  ModbusCommand command_{};
  Duration max_age_{};
  Time now_{};
};

/// `Base`: the driver's generated base.
template <class Base>
class LinkedStation : public Base {
 public:
  Status initialise() override {
    const auto& settings = this->configuration;
    ModbusStationSetup setup;
    setup.name = this->name();
    setup.map = this->registers;
    setup.unit_id = settings.unit_id;
    setup.poll_periods = {duration_of(settings.fast_period), duration_of(settings.normal_period),
                          duration_of(settings.slow_period)};
    setup.refresh_period = duration_of(settings.refresh_period);
    setup.writes_multiple = settings.writes_multiple;
    setup.most_registers = settings.most_registers;
    this->begin_outputs();
    return end_.attach(*this->bus, setup, duration_of(settings.max_age));
  }
  void stop() override { end_.detach(); }

  ModbusValue read(std::size_t index) const noexcept override { return end_.read(index); }
  ModbusText read_text(std::size_t index) const noexcept override { return end_.read_text(index); }

 private:
  void take_in(const Tick& tick) noexcept override {
    const ModbusImage& image = end_.update(tick.now);
    auto& told = this->feedback;
    told.online = image.online;
    told.requests = image.requests;
    told.timeouts = image.timeouts;
    told.exceptions = image.exceptions;
    told.bad_replies = image.bad_replies;
    told.lost = image.lost;
    told.round_trip = seconds(Duration{image.round_trip});
    told.last_error = image.last_error;
  }
  void write(bool safe) noexcept override { end_.send(this->outputs(), safe); }
  bool is_written() const noexcept override { return end_.is_written(); }

  StationEnd end_;
};

}  // namespace flexrf
