#include "hal/modbus/station/interface/linked_station.hpp"

#include <algorithm>

namespace flexrf {
namespace {

constexpr ModbusImage nothing_known{};

}  // namespace

Status StationEnd::attach(ModbusLink& link, const ModbusStationSetup& setup, Duration max_age) {
  detach();
  const Result<ModbusExchange*> exchange = link.attach(setup);
  if (!exchange) return exchange.status();
  exchange_ = *exchange;
  image_ = &nothing_known;
  command_ = {};
  max_age_ = max_age;
  now_ = Time{};
  return {};
}

void StationEnd::detach() noexcept {
  if (exchange_ != nullptr) ModbusLink::detach(*exchange_);
  exchange_ = nullptr;
  image_ = &nothing_known;
}

const ModbusImage& StationEnd::update(Time now) noexcept {
  now_ = now;
  if (exchange_ != nullptr && exchange_->images.newest() != nullptr)
    image_ = static_cast<const ModbusImage*>(exchange_->images.payload());
  return *image_;
}

StationEnd::Known StationEnd::look_up(std::size_t index) const noexcept {
  Known known;
  if (exchange_ == nullptr) {
    known.state.reason = NullReason::writer_stopped;
    return known;
  }
  const ModbusPlan& plan = exchange_->plan;
  if (index >= plan.places.size() || plan.places[index].input == ModbusPlace::none) {
    known.state.reason = NullReason::not_registered;
    return known;
  }
  const ModbusPlace& place = plan.places[index];
  const std::int64_t sampled_at = image_->sampled_at[place.read];
  const bool refused = image_->refused[place.read];
  if (sampled_at == 0) {
    known.state.reason = refused ? NullReason::writer_faulted : NullReason::nothing_yet;
    return known;
  }
  const ModbusRegister& meaning = exchange_->setup.map->registers[index];
  known.meaning = &meaning;
  known.words = &image_->words[place.input];
  known.state.reason = NullReason::none;
  // The link's thread may have stamped it after this cycle began.
  known.state.age = std::max(Duration{}, now_ - Time{Duration{sampled_at}});
  if (meaning.poll_group == ModbusPollGroup::once) return known;  // what was read once does not age
  const Duration period = exchange_->setup.poll_periods[static_cast<std::size_t>(meaning.poll_group)];
  if (known.state.age > period + max_age_)
    known.state.reason = refused          ? NullReason::writer_faulted
                         : image_->online ? NullReason::too_old
                                          : NullReason::writer_stopped;
  return known;
}

ModbusValue StationEnd::read(std::size_t index) const noexcept {
  const Known known = look_up(index);
  if (known.meaning == nullptr) return known.state;
  const bool is_scaled = known.meaning->scale_register != ModbusRegister::none;
  ModbusValue result = value_of_register(*known.meaning, known.words,
                                         is_scaled ? read(known.meaning->scale_register) : ModbusValue{});
  result.age = known.state.age;
  if (!known.state) result.reason = known.state.reason;
  return result;
}

ModbusText StationEnd::read_text(std::size_t index) const noexcept {
  const Known known = look_up(index);
  if (known.meaning != nullptr) return text_of_registers(*known.meaning, known.words, known.state);
  ModbusText nothing;
  nothing.reason = known.state.reason;
  return nothing;
}

void StationEnd::send(const StationOutputs& outputs, bool safe, bool anew) noexcept {
  if (exchange_ == nullptr || exchange_->plan.writes.empty()) return;
  ModbusCommand next{};
  next.sequence = command_.sequence;
  next.safe = safe;
  const ModbusRegisterMap& map = *exchange_->setup.map;
  for (std::size_t i = 0; i < map.registers.size(); ++i) {
    const std::uint16_t place = exchange_->plan.places[i].output;
    if (place != ModbusPlace::none) encode_register(map.registers[i], outputs[i], &next.words[place]);
  }
  const bool same = next.safe == command_.safe && next.words == command_.words;
  if (same && !anew && command_.sequence > 0) return;
  ++next.sequence;
  command_ = next;
  exchange_->commands.publish(command_, now_);
}

bool StationEnd::is_written() const noexcept {
  return exchange_ == nullptr || exchange_->plan.writes.empty() || image_->written == command_.sequence;
}

}  // namespace flexrf
