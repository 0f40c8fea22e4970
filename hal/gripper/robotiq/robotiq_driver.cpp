#include "hal/gripper/robotiq/robotiq_driver.hpp"

namespace flexrf::robotiq {

Status check(const ControlPlan& plan) noexcept {
  if (const Status status = check_widths(plan.closed_width, plan.open_width); !status) return status;
  const bool good =
      plan.slowest < plan.fastest && plan.weakest < plan.strongest && plan.open_count < plan.closed_count;
  if (good) return {};
  return Status::error(StatusCode::invalid_argument,
                       "configuration: slowest is to be less than fastest, weakest less than strongest, "
                       "open_count less than closed_count");
}

Status RobotiqEnd::attach(ModbusLink& link, const char* name, std::uint8_t unit_id, Duration max_age) {
  ModbusStationSetup setup;
  setup.name = name;
  setup.map = &register_map();
  setup.unit_id = unit_id;
  // What was written stays: repeated to one that was switched off meanwhile, it would move by itself.
  setup.refresh_period = Duration{};
  setup.listens_first = true;
  outputs_.reset(register_map());
  return end_.attach(link, setup, max_age);
}

std::optional<Words> RobotiqEnd::receive(Control& control, Time now) noexcept {
  const ModbusImage& image = end_.update(now);
  Words words{};
  bool heard = image.online;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const ModbusValue value = end_.read(words.size() + i);
    heard = heard && value;
    words[i] = static_cast<std::uint16_t>(value.value);
  }
  const std::optional<Told> told = heard ? std::optional(decode(words)) : std::nullopt;
  const std::string_view error = image.last_error_view();
  control.receive(told, end_.is_written(), now, error.empty() ? "no answer yet; is its link open?" : error);
  return heard ? std::optional(words) : std::nullopt;
}

void RobotiqEnd::send(Control& control, bool safe) noexcept {
  if (!control.action()) return;
  const Words words = encode(*control.action());
  for (std::size_t i = 0; i < words.size(); ++i) outputs_.set(i, words[i]);
  end_.send(outputs_, safe, control.take_anew());
}

}  // namespace flexrf::robotiq
