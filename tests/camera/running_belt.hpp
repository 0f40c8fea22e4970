// The cell with a camera, running beside the test: what its unit and the operator see.
#pragma once

#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {

class RunningBelt {
 public:
  explicit RunningBelt(const char* driver) : running_(application::application, with(driver)) {}

  Device& camera() { return *running_.application().device_states[0].device; }
  nlohmann::json told(const char* component) { return running_.newest(std::string(component) + ".feedback"); }
  template <class Wanted>
  bool becomes(const char* component, const char* field, const Wanted& wanted) {
    return wait_until([&] {
      const nlohmann::json feedback = told(component);
      return !feedback.is_null() && feedback.at(field) == nlohmann::json(wanted);
    });
  }
  /// The unit looks at ten more.
  bool pictures_come() {
    const std::uint64_t before = looked_at();
    return wait_until([&] { return looked_at() >= before + 10; });
  }
  std::string trouble() { return told("camera").at("trouble").get<std::string>(); }
  /// Whatever happened to the camera, neither it nor the unit is in fault, and the cell ends well.
  void check_ends_well() {
    CHECK(camera().fault().is_ok());
    CHECK(running_.state("finder").unit->fault().is_ok());
    CHECK_EQUAL(running_.stop().exit_code, 0);
  }

 private:
  static Options with(const char* driver) {
    Options options;
    options.hardware.push_back({"camera", driver});
    return options;
  }
  std::uint64_t looked_at() {
    const nlohmann::json feedback = told("finder");
    return feedback.is_null() ? 0 : feedback.at("pictures").get<std::uint64_t>();
  }

  Running running_;
};

/// What the unit and the operator see of a camera that goes away and comes back.
/// @returns how long after it was plugged in the unit saw again.
template <class Unplug, class PlugIn>
Duration it_goes_away_and_comes_back(RunningBelt& belt, const Unplug& unplug, const PlugIn& plug_in) {
  CHECK(belt.pictures_come());
  unplug();
  CHECK(belt.becomes("camera", "present", false));
  CHECK(belt.becomes("finder", "sees", false));
  CHECK_CONTAINS(belt.trouble(), "plugged in");
  plug_in();
  const Time plugged = MonotonicClock::now();
  CHECK(belt.becomes("finder", "sees", true));
  const Duration took = MonotonicClock::now() - plugged;
  CHECK(belt.becomes("camera", "present", true));
  CHECK(belt.pictures_come());
  CHECK_EQUAL(belt.told("camera").at("losses").get<int>(), 1);
  CHECK_EQUAL(belt.told("camera").at("recoveries").get<int>(), 1);
  CHECK_EQUAL(belt.trouble(), "");
  belt.check_ends_well();
  return took;
}

}  // namespace flexrf::whole
