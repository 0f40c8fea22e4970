#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture {

RunSummary run_to_the_end(Executive& executive) {
  const Status status = executive.prepare();
  if (!status) throw CheckFailed{std::string{"prepare: "} + status.cause()};
  return executive.run();
}

RunningCell::RunningCell(TestApplication& cell, Options options)
    : executive_(cell.application(), std::move(options)) {
  const Status status = executive_.prepare();
  if (!status) throw CheckFailed{std::string{"prepare: "} + status.cause()};
  // The signals a test sends are for the supervising thread, which waits for them.
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGINT);
  sigaddset(&ending, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ending, nullptr);
}

RunningCell::~RunningCell() {
  if (thread_.joinable()) finish();
}

void RunningCell::start() {
  thread_ = std::thread([this] { summary_ = executive_.run(); });
  if (!wait_until([&] { return control().mode() != Mode::starting; })) throw CheckFailed{"does not start"};
}

ParameterAnswer RunningCell::ask(const ParameterRequest& request) {
  executive_.cell().send(request);
  ParameterAnswer answer;
  if (!wait_until([&] { return answers_.pop(answer); })) throw CheckFailed{"no answer"};
  return answer;
}

void RunningCell::stop() {
  control().set_cause(EndCause::requested);
  control().rise_to(Mode::stopping);
}

RunSummary RunningCell::join() {
  thread_.join();
  return summary_;
}

}  // namespace flexrf::fixture
