#include "hal/modbus/link/simulated/simulated_registers.hpp"

#include <algorithm>

namespace flexrf {

SimulatedRegisters::Station& SimulatedRegisters::station(std::uint8_t unit_id) {
  const auto found = std::find_if(stations_.begin(), stations_.end(),
                                  [&](const Station& one) { return one.unit_id == unit_id; });
  if (found != stations_.end()) return *found;
  stations_.emplace_back().unit_id = unit_id;
  return stations_.back();
}

void SimulatedRegisters::set_model(std::uint8_t unit_id, std::shared_ptr<ModbusStationModel> model) {
  const std::lock_guard lock(mutex_);
  station(unit_id).model = std::move(model);
}

void SimulatedRegisters::follow(std::uint8_t unit_id) noexcept {
  for (Station& one : stations_) {
    if (one.unit_id == unit_id && one.model != nullptr)
      one.model->follow(now_, one.areas[static_cast<std::size_t>(ModbusArea::holding_register)]);
  }
}

void SimulatedRegisters::add(std::uint8_t unit_id, const ModbusRegisterMap& map) {
  const std::lock_guard lock(mutex_);
  Station& added = station(unit_id);
  for (const ModbusRegister& entry : map.registers) {
    std::vector<std::uint16_t>& words = added.areas[static_cast<std::size_t>(entry.area)];
    words.resize(std::max(words.size(), std::size_t{entry.address} + entry.words()));
  }
}

std::uint16_t* SimulatedRegisters::find(std::uint8_t unit_id, ModbusArea area,
                                        std::uint16_t address) noexcept {
  for (Station& one : stations_) {
    if (one.unit_id != unit_id) continue;
    std::vector<std::uint16_t>& words = one.areas[static_cast<std::size_t>(area)];
    return address < words.size() ? &words[address] : nullptr;
  }
  return nullptr;
}

void SimulatedRegisters::clear() noexcept {
  for (Station& one : stations_)
    for (std::vector<std::uint16_t>& words : one.areas)
      std::fill(words.begin(), words.end(), std::uint16_t{0});
}

bool SimulatedRegisters::advance(Time now) noexcept {
  if (now < now_) return false;
  now_ = now;
  return true;
}

Status SimulatedRegisters::open() noexcept {
  if (fault_ == ModbusWireFault::disconnected) {
    return Status::error(StatusCode::unavailable,
                         "the simulated link cannot be opened: it is cut, as it was asked to be");
  }
  open_ = true;
  return {};
}

std::uint16_t* SimulatedRegisters::answer(std::uint8_t unit_id, const ModbusBlock& block,
                                          ModbusReply& reply) noexcept {
  const bool is_there = std::any_of(stations_.begin(), stations_.end(),
                                    [&](const Station& one) { return one.unit_id == unit_id; });
  if (fault_ == ModbusWireFault::disconnected) {
    reply = {ModbusOutcome::lost, "the simulated link was cut", 0};
    return nullptr;
  }
  if (fault_ == ModbusWireFault::silent || !is_there || delay_ > response_timeout_) {
    now_ += response_timeout_;
    reply = {ModbusOutcome::timeout, "no answer in time; is the station on, and its unit id right?", 0};
    return nullptr;
  }
  now_ += delay_;
  if (fault_ == ModbusWireFault::damaged) {
    reply = {ModbusOutcome::bad_reply, "the answer is damaged, as it was asked to be", 0};
    return nullptr;
  }
  const auto last = static_cast<std::uint16_t>(block.address + block.count - 1);
  if (fault_ == ModbusWireFault::refused || find(unit_id, block.area, last) == nullptr) {
    reply = {ModbusOutcome::exception, "the station refuses: illegal data address", 2};
    return nullptr;
  }
  return find(unit_id, block.area, block.address);
}

ModbusReply SimulatedRegisters::read(std::uint8_t unit_id, const ModbusBlock& block,
                                     std::uint16_t* words) noexcept {
  const std::lock_guard lock(mutex_);
  ModbusReply reply;
  const std::uint16_t* source = answer(unit_id, block, reply);
  if (source == nullptr) return reply;
  follow(unit_id);
  std::copy_n(source, block.count, words);
  return reply;
}

ModbusReply SimulatedRegisters::write(std::uint8_t unit_id, const ModbusBlock& block,
                                      const std::uint16_t* words, bool /*multiple*/) noexcept {
  const std::lock_guard lock(mutex_);
  ModbusReply reply;
  std::uint16_t* target = answer(unit_id, block, reply);
  if (target == nullptr) return reply;
  follow(unit_id);
  std::copy_n(words, block.count, target);
  follow(unit_id);
  return reply;
}

}  // namespace flexrf
