// How soon a command begins to fall after what ends a hold, and after Stop motion. The unit notes it in the
// clock of this machine, so nothing of the panel is in the measurement but what it is about.
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <random>
#include <thread>

#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/live_client.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

constexpr Duration refresh_interval = 100ms;
constexpr double period_ms = 1;  // of the unit that is held
constexpr double lease_ms = 250;

std::int64_t now_ns() {
  return MonotonicClock::now().time_since_epoch().count();
}

/// A hold of the mover's, as a page has it.
class Hold {
 public:
  /// False: the command did not rise.
  bool begin(const Cell& cell, Recording& recording) {
    const std::int64_t before = now_ns();
    if (!link_.connect(cell.port(), cell.session())) return false;
    const std::string answer =
        link_.answer_to(link_.send("hold", R"("component":"mover","parameter":"forward")"));
    const std::string_view member = R"("lease":")";
    const std::size_t at = answer.find(member);
    if (at == std::string::npos) return false;
    const std::size_t begin = at + member.size();
    lease_ = R"("lease":")" + answer.substr(begin, answer.find('"', begin) - begin) + "\"";
    for (int tries = 0; tries < 100 && recording.began_at < before; ++tries) std::this_thread::sleep_for(1ms);
    return recording.began_at >= before;
  }
  /// Refreshes as a page does.
  void keep(Duration duration) {
    for (const Time end = MonotonicClock::now() + duration; MonotonicClock::now() < end;) {
      link_.send("refresh", lease_);
      link_.receive([](bool, std::string_view) {});
      std::this_thread::sleep_for(std::min(refresh_interval, end - MonotonicClock::now()));
    }
  }
  void release() { link_.send("release", lease_); }
  void close() { link_.close(); }

 private:
  LiveClient link_;
  std::string lease_;
};

/// When the command fell after that instant, ms; less than 0: it did not within 3 s.
double fall_after(const Recording& recording, std::int64_t instant) {
  for (int tries = 0; tries < 3000; ++tries) {
    const std::int64_t fell = recording.fell_at;
    if (fell > instant) return static_cast<double>(fell - instant) * 1e-6;
    std::this_thread::sleep_for(1ms);
  }
  return -1;
}

/// Another process keeps the hold until a signal ends or stops it.
double after_signal(const Recording& recording, Hold& hold, Duration keeping, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    for (;;) hold.keep(1s);
  }
  hold.close();
  std::this_thread::sleep_for(keeping);
  const std::int64_t instant = now_ns();
  kill(child, signal);
  const double milliseconds = fall_after(recording, instant);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return milliseconds;
}

/// The server's thread does nothing any more, as if it hung.
double after_frozen_server(Cell& cell, Hold& hold) {
  const std::vector<pid_t> threads = cell.process().threads("panel");
  const std::int64_t instant = now_ns();
  if (threads.size() != 1 || ptrace(PTRACE_SEIZE, threads[0], nullptr, nullptr) != 0) return -1;
  ptrace(PTRACE_INTERRUPT, threads[0], nullptr, nullptr);
  waitpid(threads[0], nullptr, __WALL);
  hold.keep(500ms);  // in vain
  const double milliseconds = fall_after(cell.recording(), instant);
  ptrace(PTRACE_DETACH, threads[0], nullptr, nullptr);
  return milliseconds;
}

double after_stop_motion(Cell& cell, LiveClient& link, Duration keeping) {
  Recording& recording = cell.recording();
  const std::int64_t before = now_ns();
  cell.ask("PUT", "components/mover/parameters", R"({"run":true})");
  for (int tries = 0; tries < 1000 && recording.began_at < before; ++tries) std::this_thread::sleep_for(1ms);
  if (recording.began_at < before) return -1;
  std::this_thread::sleep_for(keeping);
  link.send("ping", "\"sent\":0");
  const std::int64_t instant = now_ns();
  link.send("stop_motion");
  const double milliseconds = fall_after(recording, instant);
  cell.ask("PUT", "components/mover/parameters", R"({"run":false})");
  cell.ask("POST", "clear-stop-motion");
  cell.ask("POST", "start-motion");
  return milliseconds;
}

/// It cannot be started before everything runs.
bool start_motion(const Cell& cell) {
  for (int tries = 0; tries < 500; ++tries) {
    if (cell.ask("POST", "start-motion").status == 200) return true;
    std::this_thread::sleep_for(10ms);
  }
  std::fputs("panel: motion was not started\n", stderr);
  return false;
}

using Trial = std::function<double(Duration keeping)>;

bool add_row(Report& report, const char* cause, double goal_ms, int trials, const Trial& trial) {
  std::mt19937 random{1};
  std::uniform_int_distribution<int> milliseconds{150, 350};
  std::vector<double> all;
  for (int i = 0; i < trials; ++i) {
    // When the cause comes has nothing to do with when it was refreshed.
    all.push_back(trial(std::chrono::milliseconds{milliseconds(random)}));
    if (all.back() >= 0) continue;
    std::fprintf(stderr, "panel: %s: the command did not rise, or not fall again\n", cause);
    return false;
  }
  const double worst = quantile(all, 1);
  report.add({text("command begins to fall after %s, the latest of all", cause),
              "ms",
              {worst, worst, worst},
              goal_ms,
              true,
              text("%d times, p50 %.1f ms", trials, quantile(all, 0.5))});
  return true;
}

}  // namespace

bool measure_holds(Report& report, const Machine& /*machine*/) {
  Cell cell{{place::panel_load}};
  if (!cell.begin()) return false;
  if (!start_motion(cell)) return false;
  Recording& recording = cell.recording();
  const int trials = report.choose(20, 3);
  const auto held = [&](auto&& end) {
    return [&cell, &recording, end](Duration keeping) {
      Hold hold;
      return hold.begin(cell, recording) ? end(hold, keeping) : -1.0;
    };
  };
  const auto at_once = [&](void (Hold::*end)()) {
    return held([&recording, end](Hold& hold, Duration keeping) {
      hold.keep(keeping);
      const std::int64_t instant = now_ns();
      (hold.*end)();
      return fall_after(recording, instant);
    });
  };
  const auto by_signal = [&](int signal) {
    return held([&recording, signal](Hold& hold, Duration keeping) {
      return after_signal(recording, hold, keeping, signal);
    });
  };
  const double goal = lease_ms + period_ms;
  bool good = add_row(report, "release", goal, trials, at_once(&Hold::release)) &&
              add_row(report, "the connection's end", goal, trials, at_once(&Hold::close)) &&
              add_row(report, "SIGSTOP of the client", goal, trials, by_signal(SIGSTOP)) &&
              add_row(report, "SIGKILL of the client", goal, trials, by_signal(SIGKILL)) &&
              add_row(report, "freezing the server's thread", goal, trials,
                      held([&cell](Hold& hold, Duration keeping) {
                        hold.keep(keeping);
                        return after_frozen_server(cell, hold);
                      }));
  good = good && add_row(report, "Stop motion", 20, trials, [&](Duration keeping) {
           LiveClient link;
           if (!link.connect(cell.port(), cell.session())) return -1.0;
           return after_stop_motion(cell, link, keeping);
         });
  return good;
}

}  // namespace flexrf::bench
