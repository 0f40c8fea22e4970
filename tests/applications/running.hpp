// An application that runs beside the test, in a process of the case's own: it can run only once in each.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "runtime/executive/executive.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::whole {

/// Runs the body in a forked process and fails the CMocka test when a check in it failed, or it crashed.
void in_a_process(void (*body)());
template <void (*body)()>
void apart(void**) {
  in_a_process(body);
}

/// Real-time priorities are for the guest, where they disturb nobody.
enum class RightsOfATest : std::uint8_t { ordinary, real_time };

/// Keys through a pipe; the test plays the person at the machine and the panel.
class Running {
 public:
  explicit Running(const Application& application, Options options = {},
                   RightsOfATest rights = RightsOfATest::ordinary);
  ~Running();  // ends it when the test forgot to
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  Executive& executive() { return executive_; }
  Control& control() { return executive_.control(); }
  const Application& application() { return executive_.cell().application(); }
  void type(const std::string& keys);

  std::uint16_t unit(const std::string& name);
  UnitState& state(const std::string& unit_name) {
    return executive_.cell().application().unit_states[unit(unit_name)];
  }
  /// What a slot holds now, as in the report; null while nothing was published.
  nlohmann::json newest(const std::string& slot);
  /// One field of it; null while nothing was published, as before a unit's first step and its first after a
  /// restart.
  nlohmann::json newest(const std::string& slot, const std::string& field);
  /// Sends, and waits for the answer.
  ParameterAnswer ask(ParameterRequest request);
  /// A person's Start, given until it is accepted: each thread looks first.
  void start_motion();
  /// Asks for the controlled stop and waits for the end.
  RunSummary stop();

 private:
  Executive executive_;
  AnswerQueue answers_;
  std::uint16_t requester_ = 0;
  int keys_ = -1;
  RunSummary summary_;
  std::thread thread_;
};

}  // namespace flexrf::whole

#define TEST_APART(body) \
  { #body, flexrf::whole::apart < body>, nullptr, nullptr, nullptr }
