// A station, its link and what they are given, for worlds whose far end is one of several.
#pragma once

#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/modbus/station/conformance/modbus_station_conformance.hpp"

namespace flexrf {

template <class Link, class Station>
class LinkedWorld : public ModbusStationWorld {
 public:
  void set_response_timeout(double seconds) override { response_timeout_ = seconds; }
  Status start(const ModbusRegisterMap& map) override {
    map_ = &map;
    link_.emplace(nullptr);
    auto& link = link_->configuration();  // its pauses are the table's
    link.response_timeout = response_timeout_;
    prepare(map, link);
    if (const Status status = link_->driver().initialise(); !status) return status;
    station_.emplace(&map, std::span<QueueSink* const>{}, &link_->driver());
    station_->driver().set_inhibited(true);
    auto& station = station_->configuration();
    station.unit_id = unit_id_;
    station.normal_period = 0;
    station.slow_period = 3600;
    station.max_age = 0.2;
    return station_->driver().initialise();
  }
  ModbusStation& station() override { return station_->driver(); }
  void receive() override {
    const Duration elapsed = pass_time();
    link_->receive(elapsed);
    station_->receive(elapsed);
  }
  void send() override {
    station_->send();
    link_->send();
  }
  Time now() const override { return link_->now(); }

  void put(std::size_t index, double value) override {
    const ModbusRegister& entry = map_->registers[index];
    std::array<std::uint16_t, ModbusRegister::most_words> words = words_of(entry);
    encode_register(entry, value, words.data(), factor_of(entry));
    for (std::uint16_t i = 0; i < entry.words(); ++i)
      put_word(entry.area, static_cast<std::uint16_t>(entry.address + i), words[i]);
  }
  void put_text(std::size_t index, std::string_view text) override {
    const ModbusRegister& entry = map_->registers[index];
    std::array<std::uint16_t, ModbusRegister::most_words> words{};
    encode_text(entry, text, words.data());
    for (std::uint16_t i = 0; i < entry.words(); ++i)
      put_word(entry.area, static_cast<std::uint16_t>(entry.address + i), words[i]);
  }
  double held(std::size_t index) override {
    const ModbusRegister& entry = map_->registers[index];
    return decode_register(entry, words_of(entry).data(), factor_of(entry));
  }

  Link& link() { return link_->driver(); }
  void set_unit_id(std::uint8_t unit_id) { unit_id_ = unit_id; }

 protected:
  /// The far end begins, and the link is told where it is.
  virtual void prepare(const ModbusRegisterMap& map, typename Link::Configuration& link) = 0;
  virtual Duration pass_time() = 0;
  virtual void put_word(ModbusArea area, std::uint16_t address, std::uint16_t value) = 0;
  virtual std::uint16_t word(ModbusArea area, std::uint16_t address) = 0;

 private:
  double factor_of(const ModbusRegister& entry) {
    return entry.scale_register == ModbusRegister::none ? 1 : factor_of_exponent(held(entry.scale_register));
  }
  std::array<std::uint16_t, ModbusRegister::most_words> words_of(const ModbusRegister& entry) {
    std::array<std::uint16_t, ModbusRegister::most_words> words{};
    for (std::uint16_t i = 0; i < entry.words(); ++i)
      words[i] = word(entry.area, static_cast<std::uint16_t>(entry.address + i));
    return words;
  }

  const ModbusRegisterMap* map_ = nullptr;
  std::uint8_t unit_id_ = 1;
  double response_timeout_ = 8;
  std::optional<DeviceBench<Link>> link_;
  std::optional<DeviceBench<Station>> station_;  // goes before its link
};

}  // namespace flexrf
