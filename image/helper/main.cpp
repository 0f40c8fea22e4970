// flexrf-helper: says on an industrial PC whether anything may move, confirms the version that runs, and does
// for an admin what only root may (docs/image.md). Runs as root, beside the application, which has no rights.

#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "image/helper/data_use.hpp"
#include "image/helper/facts.hpp"
#include "image/helper/failure_lines.hpp"
#include "image/helper/helper.hpp"
#include "image/helper/interfaces.hpp"
#include "image/helper/motion_word.hpp"
#include "image/helper/options.hpp"
#include "image/helper/socket_server.hpp"
#include "image/helper/start_record.hpp"
#include "image/helper/state_answer.hpp"
#include "image/helper/system.hpp"
#include "image/helper/verbs.hpp"
#include "web-ui/server/access/panel_access.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::helper;

constexpr Duration interval = std::chrono::seconds{1};
/// So that who asks again and again keeps nobody from the boot choice.
constexpr Duration between_readings = std::chrono::milliseconds{250};
constexpr Duration wait_for_journal = std::chrono::seconds{10};
constexpr std::size_t most_of_journal = std::size_t{1} << 20;  // 20 lines have at most 48 KiB each

void say(const std::string& line) {
  std::fprintf(stderr, "flexrf-helper: %s\n", line.c_str());
}

int misuse(const std::string& what) {
  say(what);
  std::fputs(usage, stderr);
  return 1;
}

/// The facts for who asks for the state: read anew now and then. One thread.
class RecentFacts {
 public:
  explicit RecentFacts(const Files& files) : files_(files) {}
  const Facts& now() {
    const Time now = MonotonicClock::now();
    if (!is_read_ || now - read_at_ >= between_readings) {
      facts_ = read_facts(files_, std::chrono::milliseconds{100});
      read_at_ = now;
      is_read_ = true;
    }
    return facts_;
  }

 private:
  const Files& files_;
  Facts facts_;
  Time read_at_{};
  bool is_read_ = false;
};

SocketSettings socket_settings(const Options& options) {
  SocketSettings settings{options.socket, {0}};
  if (const auto peer = id_of_user(options.peer)) {
    settings.peers.push_back(*peer);
  } else {
    say("there is no user '" + options.peer + "': only root may ask");
  }
  return settings;
}

int run(const Options& options) {
  const Files& files = options.files;
  const Surroundings surroundings{
      [&](Duration wait) { return ask_panel(options.port, files.certificate, wait); }, &say,
      [&](const std::vector<std::string>& arguments) { return run_program(options.systemctl, arguments); },
      &free_bytes, &wired_interfaces};
  // Also before a thread is made: each of them leaves these signals to this one.
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGTERM);
  sigaddset(&ending, SIGINT);
  sigprocmask(SIG_BLOCK, &ending, nullptr);

  MotionWord word(
      files.word, [&] { return permission_of(read_facts(files, wait_for_choice)); }, &say);
  Helper helper(files, options.limits, surroundings, word, MonotonicClock::now());
  Verbs verbs(files, surroundings, word);
  RecentFacts facts(files);
  DataWatch data([&] { return measure_data(files.data); });
  FailureLines failure_lines([&](const std::vector<std::string>& arguments) {
    return output_of(options.journalctl, arguments, wait_for_journal, most_of_journal);
  });
  SocketServer server(socket_settings(options),
                      {[&] {
                         const Time now = MonotonicClock::now();
                         OfThisMoment moment{word.text(),      helper.health(),    options.limits.healthy,
                                             verbs.received(), wired_interfaces(), now};
                         moment.data = data.use(now);
                         moment.failure = failure_to_show(files.update, facts.now());
                         if (moment.failure)
                           moment.failure_lines = failure_lines.of(moment.failure->last.boots, now);
                         return state_answer(files, facts.now(), moment);
                       },
                       [&](const Request& request, const std::string& peer) {
                         Answer answer = verbs.perform(request, peer);
                         if (request.verb == Verb::make_room) data.measure_again();
                         return answer;
                       },
                       [&] { verbs.tick(); }, &say});
  std::thread serving([&] { server.run(); });
  constexpr timespec pause{interval / std::chrono::seconds{1}, 0};
  do helper.look(MonotonicClock::now());
  while (sigtimedwait(&ending, nullptr, &pause) < 0);
  server.stop();
  serving.join();
  return 0;
}

}  // namespace

int main(int argument_count, char** words) {
  hold_standard_descriptors();
  const auto options = parse_options({words + 1, words + argument_count});
  if (const auto* const wrong = std::get_if<std::string>(&options)) return misuse(*wrong);
  if (std::get<Options>(options).wants_help) {
    std::fputs(usage, stdout);
    return 0;
  }
  if (!panel::prepare_cryptography()) return misuse("this system has no source of randomness");
  return run(std::get<Options>(options));
}
