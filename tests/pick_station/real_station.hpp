// RealStation: the pick station on its real drivers in the guest, with programs at the far ends.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hal/camera/v4l2/tests/vivid.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"
#include "tests/pick_station/station_box.hpp"

namespace flexrf::whole {

/// The application runs in this process, configured as its table says, with the priorities that it asks for.
/// Drives, gripper and feeder are other programs, on the other CAN controller, the other end of the serial
/// line and a TCP port. Whatever is waited for in vain fails the test with what the operator reads.
class RealStation {
 public:
  static constexpr const char* declared_vendor = "0x123";  // as in apps/pick-station/pick_station.toml

  /// `vendor`: what the drives say of themselves, as it is declared unless said otherwise.
  explicit RealStation(const char* vendor = declared_vendor);
  /// Whatever is out is in again.
  ~RealStation();
  RealStation(const RealStation&) = delete;
  RealStation& operator=(const RealStation&) = delete;

  // ---- what a person does and reads

  void press(const char* button);
  template <class Value>
  void set(const char* name, const Value& value) {
    change(name, &value, sizeof(value));
  }
  /// A person initialises a device on its page; the outcome must be good.
  void initialise(const char* device);
  /// Clears a stop and gives Start until it is accepted.
  void give_start();
  /// From power-on to ready: Start, Home.
  void make_ready();

  /// What a unit or device tells, by its name.
  nlohmann::json told(const std::string& component) { return running_.newest(component + ".feedback"); }
  std::string text(const char* field) { return told("pick").at(field).get<std::string>(); }
  std::uint64_t count(const char* field) { return told("pick").at(field).get<std::uint64_t>(); }
  std::string state();
  double position_of(const char* axis) { return told(axis).at("position").get<double>(); }

  void wait_for(const char* what, const std::function<bool()>& condition);
  void wait_for_state(const char* state);
  /// Until the operator reads it.
  void wait_for_message(const char* part);
  /// On the way from feeder to tray, with a part in the gripper.
  void wait_until_it_carries();
  void wait_for_parts(std::uint64_t parts);

  // ---- what is around it

  StationBox& box() { return box_; }
  Vivid& camera() { return camera_; }
  /// What the camera looks at is as bright, or as dark, as can be.
  void light_feeder(bool bright);
  /// The drives' end of the CAN bus.
  void set_can_cable(bool in);
  /// The network between this and the IO station.
  void set_network_cable(bool in);
  /// A line to the drives' program, as "1 trip 0x2310"; to the gripper's, as "silent".
  void tell_drives(const std::string& line) { drives_.type(line + "\n"); }
  void tell_gripper(const std::string& line) { gripper_.type(line + "\n"); }

  Control& control() { return running_.control(); }
  /// The exit code. No real-time thread may have allocated or freed anything until then, whatever happened.
  int stop();

 private:
  void change(const char* name, const void* value, std::size_t size);
  ParameterRequest to_pick(RequestKind kind);
  std::uint16_t parameter(const char* name);
  void accept(const ParameterRequest& request);
  void check_nothing_was_allocated();

  Folder folder_;
  StationBox box_;
  Vivid camera_;
  Process drives_;
  Process gripper_;
  Process feeder_;
  Running running_;
};

}  // namespace flexrf::whole
