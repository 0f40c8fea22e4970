// Trouble: the cell of apps/visual-servoing, with something that goes wrong, for the tests of that.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "camera_interface.hpp"
#include "robot_control_unit.hpp"
#include "runtime/log/log.hpp"
#include "tests/visual_servoing/servoing_cell.hpp"
#include "types/camera_fault.hpp"
#include "types/joint_state.hpp"

namespace flexrf::visual_servoing {

inline constexpr int with_a_fault = 2;  // the exit code
inline constexpr Duration long_enough = std::chrono::seconds(40);
// From its greatest speed the arm is at rest within this time.
inline constexpr Duration braking = std::chrono::milliseconds(500);

/// What is read of the log once a run is over.
inline bool was_said(std::string_view part) {
  struct Search {
    std::string_view part;
    bool found = false;
  } search{part};
  visit_recent_log(0, &search, [](void* context, std::uint64_t /*number*/, std::string_view text) {
    Search& wanted = *static_cast<Search*>(context);
    wanted.found = wanted.found || text.find(wanted.part) != std::string_view::npos;
  });
  return search.found;
}

class Trouble {
 public:
  ServoingCell cell{1};
  const PartPickerFeedback& picker = cell.picker();
  const FeatureExtractionFeedback& features = cell.told_by<FeatureExtractionFeedback>("features");
  const CameraFeedback& camera = cell.told_by<CameraFeedback>("camera");
  const AttentionEvolutionFeedback& evolution = cell.told_by<AttentionEvolutionFeedback>("evolution");
  const RobotControlFeedback& robot = cell.told_by<RobotControlFeedback>("robot");

  int run() {
    const RunSummary summary = cell.run(long_enough, [this] { watch(); });
    return summary.exit_code;
  }

  void give_camera(CameraFault fault) { cell.set("camera", "injected_fault", fault); }
  /// From here on the joints are watched, and contacts.
  void begin_stillness() {
    watched_ = true;
    joints_ = cell.newest<JointState>("joints");
    largest_ = 0;
    contacts_ = cell.table().contacts;
  }
  void check_stillness() {
    constexpr double of_noise = 4e-4;  // rad: the sensors' standard deviation is 2e-5
    watched_ = false;
    CHECK(largest_ < of_noise);
    CHECK_EQUAL(cell.table().contacts, contacts_);
  }
  void remember() {
    approaches_ = picker.approaches;
    binned_ = picker.binned;
  }
  bool has_gone_on() const { return picker.approaches > approaches_ || picker.binned > binned_; }
  bool has_binned() const { return picker.binned > binned_; }
  void check_message(const char* message, const char* remedy) {
    CHECK_CONTAINS(picker.message_view(), message);
    CHECK_CONTAINS(picker.remedy_view(), remedy);
  }
  /// As an exception that leaves its step() would.
  void fault_member(int number) {
    const std::string name = "attention[" + std::to_string(number) + "]";
    Component& member = cell.executive().cell().component(cell.component(name.c_str()));
    member.set_fault(Status::error(StatusCode::internal, "as it was asked to"));
  }

 private:
  void watch() {
    if (!watched_) return;
    const auto now = cell.newest<JointState>("joints");
    largest_ = std::max(largest_, (now.position_map() - joints_.position_map()).cwiseAbs().maxCoeff());
  }

  JointState joints_{};
  double largest_ = 0;
  std::uint64_t contacts_ = 0;
  std::uint64_t approaches_ = 0;
  std::uint64_t binned_ = 0;
  bool watched_ = false;
};

}  // namespace flexrf::visual_servoing
