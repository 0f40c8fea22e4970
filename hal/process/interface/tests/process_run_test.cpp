// A run whose own thread is held up while somebody else goes on.
#include "hal/process/interface/process_run.hpp"

#include <csignal>
#include <ctime>
#include <memory>

#include "hal/process/interface/process_host.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

/// Its program ends only when it is killed, and tells nothing else.
class SlowHost final : public ProcessHost {
 public:
  Duration wait_lasts{};
  Duration ahead{};  ///< of the device's cycle, when its end is told
  bool killed = false;

  Status open(const ProcessProgram& /*program*/) override { return {}; }
  void wait(Duration /*most*/) noexcept override {
    const timespec pause{static_cast<time_t>(wait_lasts.count() / 1'000'000'000),
                         static_cast<long>(wait_lasts.count() % 1'000'000'000)};
    nanosleep(&pause, nullptr);
  }
  bool start() noexcept override {
    event_ = ProcessEvent{};
    event_->id = 1;
    return true;
  }
  void end(bool at_once) noexcept override {
    if (!at_once) return;
    killed = true;
    event_ = ProcessEvent{};
    event_->kind = ProcessEvent::Kind::ended;
    event_->signal = SIGKILL;
    event_->at = MonotonicClock::now() + ahead;
  }
  bool next_event(ProcessEvent& event) noexcept override {
    if (!event_) return false;
    event = *event_;
    event_.reset();
    return true;
  }
  long read(ProcessSource /*source*/, std::span<char> /*bytes*/) noexcept override { return killed ? -1 : 0; }
  long write(std::string_view /*bytes*/) noexcept override { return 0; }
  void close_input() noexcept override {}
  void release() noexcept override {}

 private:
  std::optional<ProcessEvent> event_;
};

struct Begun {
  SlowHost host;  // outlives the run
  ProcessRun run;

  Begun() {
    ProcessSettings settings;
    settings.start_timeout = std::chrono::seconds(30);
    settings.stop_timeout = milliseconds(50);
    good = run.begin("program", host, settings).is_ok();
  }
  bool good = false;
};

/// Held up for longer than all that it would wait for, it kills the program all the same, and hears of its
/// end.
bool who_is_held_up_still_kills() {
  const auto begun = std::make_unique<Begun>();
  begun->host.wait_lasts = milliseconds(1200);
  begun->run.stop();
  return begun->good && begun->host.killed && begun->run.state().end == ProcessEnd::signalled;
}

/// It ended while this thread was held up between the clock and the news.
bool an_end_is_no_later_than_the_cycle_that_tells_it() {
  const auto begun = std::make_unique<Begun>();
  begun->host.ahead = milliseconds(20);
  begun->host.end(true);
  begun->run.receive(MonotonicClock::now());
  const ProcessState& state = begun->run.state();
  return begun->good && state.phase == ProcessPhase::idle && state.ended_at > 0 &&
         state.ended_at <= state.since;
}

template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<who_is_held_up_still_kills>),
      cmocka_unit_test(judged<an_end_is_no_later_than_the_cycle_that_tells_it>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
