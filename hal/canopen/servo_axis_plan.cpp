// What a drive is asked and told before it is started, from the plan of its axis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/canopen/servo_axis.hpp"

namespace flexrf::canopen::cia402 {
namespace {

constexpr std::uint32_t milliseconds_exponent = 0xFD;  // ten to the power of -3, as i8
constexpr std::uint32_t no_window = 0xFFFFFFFF;        // of object 6065: it is not looked at
constexpr double largest_increments = std::numeric_limits<std::int32_t>::max();

bool is_above_zero(double value) {
  return value > 0 && std::isfinite(value);
}

}  // namespace

std::uint32_t ServoAxis::to_amount(double value) noexcept {
  return static_cast<std::uint32_t>(std::clamp(std::round(std::abs(value)), 1.0, largest_increments));
}

Status ServoAxis::check(const AxisPlan& plan) const noexcept {
  const auto wrong = [&plan](const char* what) {
    return Status::error(StatusCode::invalid_argument, "the axis with node %u: %s", unsigned{plan.node},
                         what);
  };
  if (plan.mode == Mode::none || plan.mode == Mode::homing) {
    return wrong("its mode is none that it could be commanded in");
  }
  if (plan.period < std::chrono::milliseconds(1) || plan.period > std::chrono::milliseconds(255) ||
      plan.period % std::chrono::milliseconds(1) != Duration{}) {
    return wrong("its period is not a whole number of ms from 1 to 255, as the drive counts it");
  }
  if (!std::isfinite(plan.increments_per_unit) || plan.increments_per_unit == 0) {
    return wrong("its increments per unit are 0 or not finite");
  }
  if (plan.limits_torque && plan.mode != Mode::profile_position) {
    return wrong("its torque can be limited in mode profile position alone");
  }
  if (!(plan.modulo >= 0) || !std::isfinite(plan.modulo) || (plan.modulo > 0 && !plan.endless)) {
    return wrong("its modulo is below 0, or it is not endless");
  }
  if (!(plan.modulo * std::abs(plan.increments_per_unit) <= largest_increments)) {
    return wrong("its modulo has more increments than the drive can count");
  }
  if (!plan.endless && !(plan.lowest < plan.highest))
    return wrong("its lowest position is not below its highest");
  if (!is_above_zero(plan.fastest)) return wrong("its greatest velocity is not above 0");
  if (!is_above_zero(plan.acceleration)) return wrong("its acceleration is not above 0");
  if (!(plan.quick_stop_deceleration >= 0) || !std::isfinite(plan.quick_stop_deceleration)) {
    return wrong("the deceleration of its quick stop is below 0");
  }
  if (!is_above_zero(plan.velocity_factor) || !is_above_zero(plan.acceleration_factor)) {
    return wrong("the factor of its velocity or of its acceleration is not above 0");
  }
  if (!is_above_zero(plan.homing_speed) || !is_above_zero(plan.homing_creep_speed)) {
    return wrong("a speed of its homing is not above 0");
  }
  const double farthest = std::max(std::abs(plan.lowest), std::abs(plan.highest));
  if (!plan.endless && !(farthest * std::abs(plan.increments_per_unit) <= largest_increments)) {
    return wrong("its range has more increments than the drive can count");
  }
  return {};
}

NodePlan ServoAxis::node_plan() noexcept {
  commands_ = {.direction = PdoDirection::received_by_node,
               .identifier = receive_pdo_identifier(1, plan_.node)};
  commands_.add(objects::controlword, 16);
  if (plan_.mode == Mode::interpolated_position) {
    commands_.add(objects::interpolation_point, 32);
  } else {
    const bool takes_positions = is_led_in(Mode::cyclic_position, Mode::profile_position);
    commands_.add(takes_positions ? objects::target_position : objects::target_velocity, 32);
  }
  if (plan_.maps_mode) commands_.add(objects::mode, 8, "maps_mode = false");
  states_ = {.direction = PdoDirection::sent_by_node, .identifier = transmit_pdo_identifier(1, plan_.node)};
  states_.add(objects::statusword, 16);
  states_.add(objects::actual_position, 32);
  if (plan_.maps_mode) states_.add(objects::mode_display, 8, "maps_mode = false");
  motion_ = {.direction = PdoDirection::sent_by_node,
             .number = 2,
             .identifier = transmit_pdo_identifier(2, plan_.node)};
  if (plan_.maps_velocity) motion_.add(objects::actual_velocity, 32, "maps_velocity = false");
  if (plan_.tells_torque) motion_.add(objects::actual_torque, 16, "tells_torque = false");
  states_.forbids_remote = motion_.forbids_remote = plan_.forbids_remote;
  if (plan_.forbids_remote) states_.helps = motion_.helps = "forbids_remote = false";
  profile_ = {.direction = PdoDirection::received_by_node,
              .number = 2,
              .identifier = receive_pdo_identifier(2, plan_.node)};
  if (plan_.mode == Mode::profile_position && plan_.tells_speed && plan_.maps_speed) {
    constexpr const char* helps = "maps_speed = false";
    profile_.add(objects::profile_velocity, 32, helps);
    profile_.helps = helps;
  }
  if (plan_.limits_torque) profile_.add(objects::most_torque, 16, "limits_torque = false");

  NodePlan node{.node = plan_.node,
                .master = plan_.master,
                .boot_timeout = plan_.boot_timeout,
                .sdo_timeout = plan_.sdo_timeout,
                .heartbeat_period = plan_.heartbeat_period,
                .heartbeat_limit = plan_.heartbeat_limit,
                .grace = std::chrono::seconds(1),
                .is_guarded = plan_.is_guarded,
                .master_heartbeat_limit = plan_.is_supervised_by_it ? plan_.heartbeat_limit : Duration{}};
  Configuration& list = node.configuration;
  list.expect(canopen::objects::device_type, profile_number, 0xFFFF, "device profile");
  if (plan_.vendor != 0) list.expect(canopen::objects::vendor, plan_.vendor, 0xFFFFFFFF, "vendor");
  if (plan_.product != 0) list.expect(canopen::objects::product, plan_.product, 0xFFFFFFFF, "product");
  if (plan_.tells_abort_connection) {
    list.write(objects::abort_connection, 2, static_cast<std::uint16_t>(plan_.abort_connection),
               "tells_abort_connection = false");
  }
  if (plan_.tells_period) {
    constexpr const char* helps = "tells_period = false";
    list.write(objects::period_value, 1,
               static_cast<std::uint32_t>(plan_.period / std::chrono::milliseconds(1)), helps);
    list.write(objects::period_exponent, 1, milliseconds_exponent, helps);
  }
  plan_motion(list);
  for (const PdoPlan& pdo : {commands_, states_, motion_, profile_}) {
    if (pdo.count > 0) list.configure_pdo(pdo);
  }
  return node;
}

// What its own profiles go by; a drive need not have the objects of modes that it is not used in.
void ServoAxis::plan_motion(Configuration& list) const noexcept {
  const double scale = plan_.increments_per_unit * plan_.acceleration_factor;
  const double acceleration = plan_.acceleration * scale;
  if (plan_.quick_stop_option != 0) {
    list.write(objects::quick_stop_option, 2, static_cast<std::uint16_t>(plan_.quick_stop_option),
               "quick_stop_option = 0");
  } else {
    list.ask(objects::quick_stop_option);
  }
  if (plan_.quick_stop_deceleration > 0) {
    list.write(objects::quick_stop_deceleration, 4, to_amount(plan_.quick_stop_deceleration * scale),
               "quick_stop_deceleration = 0");
  }
  if (is_led_in(Mode::profile_position, Mode::profile_velocity)) {
    // A drive may have ramps of its own; see has_own_ramps().
    list.write_if_there(objects::profile_acceleration, 4, to_amount(acceleration));
    // Where it is missing, the acceleration serves for both (CiA 402).
    list.write_if_there(objects::profile_deceleration, 4, to_amount(acceleration));
  }
  if (plan_.mode == Mode::profile_position) list.ask(objects::position_window);
  if (plan_.mode == Mode::interpolated_position) {
    constexpr std::uint32_t linear = 0;
    constexpr std::uint32_t points_come_in = 1;
    list.write_if_there(objects::interpolation_kind, 2, linear);
    list.write_if_there(objects::interpolation_buffer, 1, points_come_in);
  }
  // One that has no window does not look.
  if (plan_.may_be_blocked) list.write_if_there(objects::following_window, 4, no_window);
  if (plan_.homing_method == 0) return;
  constexpr const char* helps = "homing_method = 0";
  list.write(objects::homing_method, 1, static_cast<std::uint8_t>(plan_.homing_method), helps);
  list.write(objects::homing_search_speed, 4, to_amount(to_velocity_object(plan_.homing_speed)), helps);
  list.write(objects::homing_creep_speed, 4, to_amount(to_velocity_object(plan_.homing_creep_speed)), helps);
}

}  // namespace flexrf::canopen::cia402
