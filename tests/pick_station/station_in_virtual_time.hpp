// The pick station in virtual time, with a person and a world that act between its cycles, always at the same
// instants.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "apps/pick-station/units/pick_sequence/pick_sequence.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::pick_station {

using namespace user;  // types and units of the tables

/// One run of the application, so one in each process.
class StationInVirtualTime {
 public:
  explicit StationInVirtualTime(const char* hardware);

  /// Runs until told() is over or the time is. `world` acts once in each cycle of the control thread, before
  /// what is told. Fails with the step that it waits for when it never comes true.
  RunSummary run(Duration longest, std::function<void(Time)> world = {});

  // ---- what is told, in this order: each waits until its condition is true, and then acts

  StationInVirtualTime& when(std::string what, std::function<bool()> condition,
                             std::function<void()> act = {});
  StationInVirtualTime& when_in(PickState state, std::function<void()> act = {});
  /// So long after the step before.
  StationInVirtualTime& after(Duration pause, std::function<void()> act = {});
  /// A person clears a stop and gives Start until it is accepted.
  StationInVirtualTime& clear_and_start();
  /// From off, once a drive or axis that faulted works again: Start, Reset, Home.
  StationInVirtualTime& leave_fault_and_home();
  /// From power-on to ready: Start, Home.
  StationInVirtualTime& make_ready();

  // ---- what a person does and reads

  void press(const char* button);
  /// It could do nothing: the unit's table says so, and who presses is told.
  void press_in_vain(const char* button, const char* reason);
  template <class Value>
  void set(const char* parameter, const Value& value) {
    change("pick", parameter, &value, sizeof(value));
  }
  /// Of another unit.
  template <class Value>
  void set_of(const char* unit, const char* parameter, const Value& value) {
    change(unit, parameter, &value, sizeof(value));
  }
  const PickSequenceFeedback& seen() const { return *feedback_; }
  /// What another unit or a device tells, by its name.
  template <class Feedback>
  const Feedback& told_by(const char* component) {
    return *static_cast<const Feedback*>(feedback_of(component));
  }
  std::string message() const { return std::string{feedback_->message_view()}; }
  std::string remedy() const { return std::string{feedback_->remedy_view()}; }
  /// How often devices, all together, did less than they were commanded, as the report counts it.
  std::uint64_t restraints();
  /// A lamp, by the name of its line; one that blinks is lit or dark.
  bool is_lit(const char* line);
  /// A person initialises a device on its page; the outcome must be good.
  void initialise(const char* device);

  // ---- what the world is made of

  template <class Driver>
  Driver& device(const char* name) {
    return dynamic_cast<Driver&>(find(name));
  }
  /// Of the newest cycle.
  Time now() const { return looked_at_; }
  Control& control() { return executive_.control(); }
  void press_emergency_stop(bool pressed);
  /// The whole chip of the operator's box, as an adapter that is pulled out.
  void plug_box(bool in);

 private:
  static constexpr std::uint64_t in_vain_number = 1;
  void send_press(const char* button, std::uint64_t correlation);

  std::string in_vain_;
  struct Step {
    std::string what;
    std::function<bool()> condition;
    std::function<void()> act;
  };
  void change(const char* unit, const char* parameter, const void* value, std::size_t size);
  std::uint16_t parameter(std::uint16_t unit, const char* name);
  const void* feedback_of(const char* component);
  Device& find(const char* name);
  void look();
  void go_on(Time now);

  Executive executive_;
  AnswerQueue answers_;
  std::uint16_t requester_ = 0;
  std::uint16_t pick_ = 0;
  const StepContext* clock_ = nullptr;                  // of the control thread
  const std::atomic<std::uint64_t>* cycles_ = nullptr;  // likewise
  std::uint64_t cycle_ = 0;
  const PickSequenceFeedback* feedback_ = nullptr;
  std::function<void(Time)> world_;
  std::vector<Step> steps_;
  std::size_t place_ = 0;
  Time looked_at_{};
  Time stepped_at_{};
  std::string problem_;
};

}  // namespace flexrf::pick_station
