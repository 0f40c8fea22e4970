// The cell that picks what it sees, in virtual time, with a person who acts between its cycles, always at the
// same instants.
#pragma once

#include <atomic>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "attention_evolution_unit.hpp"
#include "part_picker_unit.hpp"
#include "runtime/executive/executive.hpp"
#include "scene_interface.hpp"
#include "tests/applications/running.hpp"
#include "types/scene_state.hpp"
#include "types/track_list.hpp"
#include "visual_features_unit.hpp"

namespace flexrf::visual_servoing {

using namespace user;  // types and units of the tables

/// One run of the application, so one in each process.
class ServoingCell {
 public:
  explicit ServoingCell(std::uint64_t seed);

  /// Until what is told is over, or the time is; `look` is called once in each cycle of the control thread.
  /// Fails with the step that it waits for when it never comes true.
  RunSummary run(Duration longest, std::function<void()> look = {});

  /// What is told, in this order: each waits until its condition is true, and then acts.
  ServoingCell& when(std::string what, std::function<bool()> condition, std::function<void()> act = {});
  ServoingCell& after(Duration pause, std::function<void()> act = {});
  ServoingCell& when_in(PickerState state, std::function<void()> act = {});

  // ---- what a person does and reads

  void press(const char* component, const char* button);
  /// Fails the run unless it is accepted.
  void send(ParameterRequest request);
  ComponentIndex component(const char* name);
  std::uint16_t parameter(ComponentIndex component, const char* name);
  /// As on its page: it begins anew, and with it what stands on it.
  void initialise(const char* component);
  Control& control() { return executive_.control(); }
  template <class Value>
  void set(const char* component, const char* parameter, const Value& value) {
    change(component, parameter, &value, sizeof(value));
  }
  const PartPickerFeedback& picker() const { return *picker_; }
  std::string message() const { return std::string{picker_->message_view()}; }
  const SceneFeedback& table() const { return *table_; }
  template <class Feedback>
  const Feedback& told_by(const char* component) {
    return *static_cast<const Feedback*>(memory_of(component).feedback);
  }
  template <class Configuration>
  const Configuration& configuration_of(const char* component) {
    return *static_cast<const Configuration*>(memory_of(component).configuration);
  }

  // ---- what is so

  /// Of a slot that is observed; all zero before its first value.
  template <class T>
  T newest(const char* slot) {
    T value{};
    copy_newest(slot, &value, sizeof(value));
    return value;
  }
  Time now() const { return now_; }
  /// Since the start.
  double elapsed() const { return seconds(now_ - began_); }
  Executive& executive() { return executive_; }
  std::uint64_t digest() { return executive_.cell().digest(); }

 private:
  struct Step {
    std::string what;
    std::function<bool()> condition;
    std::function<void()> act;
  };
  ParameterMemory memory_of(const char* name);
  void copy_newest(const char* slot, void* value, std::size_t size);
  void change(const char* component, const char* parameter, const void* value, std::size_t size);
  void look();

  Executive executive_;
  AnswerQueue answers_;
  std::uint16_t requester_ = 0;
  const PartPickerFeedback* picker_ = nullptr;
  const SceneFeedback* table_ = nullptr;
  const StepContext* clock_ = nullptr;                  // of the control thread
  const std::atomic<std::uint64_t>* cycles_ = nullptr;  // likewise
  std::uint64_t cycle_ = 0;
  std::function<void()> look_;
  std::vector<Step> steps_;
  std::size_t place_ = 0;
  Time began_{};
  Time now_{};
  Time stepped_at_{};
  std::string problem_;
};

}  // namespace flexrf::visual_servoing
