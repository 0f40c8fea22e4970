// An application that runs on the wall clock beside the test, which plays the person at the machine.
#pragma once

#include <csignal>
#include <thread>

#include "runtime/executive/executive.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "runtime/executive/tests/fixture.hpp"
#include "tests/waiting.hpp"

namespace flexrf::fixture {

using test::wait_until;

/// Runs a cell from prepare() to its end on this thread: for virtual time, and for what ends by itself.
RunSummary run_to_the_end(Executive& executive);

/// Runs it on a thread of its own; ends it when the test forgets to.
class RunningCell {
 public:
  explicit RunningCell(TestApplication& cell, Options options = on_the_wall_clock());
  ~RunningCell();
  RunningCell(const RunningCell&) = delete;
  RunningCell& operator=(const RunningCell&) = delete;

  Executive& executive() { return executive_; }
  Control& control() { return executive_.control(); }
  /// Before start().
  std::uint16_t add_requester() { return executive_.cell().add_requester(answers_); }
  /// Returns when every component has been initialised, or the application has failed to start. Units begin
  /// to step before, while others are still being initialised.
  void start();
  /// Sends and waits for the answer.
  ParameterAnswer ask(const ParameterRequest& request);
  /// Requests the controlled stop.
  void stop();
  /// Waits for the end.
  RunSummary join();
  RunSummary finish() {
    stop();
    return join();
  }

 private:
  AnswerQueue answers_;
  Executive executive_;
  std::thread thread_;
  RunSummary summary_;
};

}  // namespace flexrf::fixture
