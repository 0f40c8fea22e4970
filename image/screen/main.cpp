// flexrf-screen: draws the screen of an industrial PC (docs/image.md). There is no log-in; keys are ignored.

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>

#include "base/standard_descriptors.hpp"
#include "base/time.hpp"
#include "image/boot/choice.hpp"
#include "image/helper/facts.hpp"
#include "image/helper/files.hpp"
#include "image/helper/interfaces.hpp"
#include "image/helper/named_lines.hpp"
#include "image/helper/panel_health.hpp"
#include "image/helper/state_answer.hpp"
#include "image/screen/certificate.hpp"
#include "image/screen/journal.hpp"
#include "image/screen/picture.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::screen;

constexpr const char* usage =
    "flexrf-screen\n"
    "Shows on standard output, which is a console, what this PC is, its claim code, addresses and state.\n"
    "Runs until it is ended. Exit code: 1 wrong usage.\n";

constexpr const char* code_file = "/run/flexrf-claim/code";
constexpr std::uint16_t panel_port = 8443;
constexpr Duration look_interval = std::chrono::seconds{2};  // each look is a TLS connection to the panel
constexpr Duration wait_for_panel = std::chrono::seconds{2};
/// The kernel writes on the same console, and what it says of a fault is worth reading for a while.
constexpr Duration redraw_interval = std::chrono::seconds{10};

Size size_of_console() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

/// Keys neither appear on the screen nor stop it, as Ctrl-S would.
void ignore_keys() {
  termios settings{};
  if (tcgetattr(STDOUT_FILENO, &settings) != 0) return;  // no console, as in a pipe
  settings.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON | ISIG);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXON);
  tcsetattr(STDOUT_FILENO, TCSANOW, &settings);
}

/// Link-local ones only where there are no others.
void add_addresses(Facts& facts) {
  std::vector<std::string> of_the_link;
  for (const helper::Interface& interface : helper::wired_interfaces()) {
    facts.has_cable = facts.has_cable || interface.has_link;
    for (const std::string& address : interface.addresses) {
      std::string alone = address.substr(0, address.find('/'));
      (alone.starts_with("169.254.") ? of_the_link : facts.addresses).push_back(std::move(alone));
    }
  }
  if (facts.addresses.empty()) facts.addresses = std::move(of_the_link);
}

std::string first_line_of(const std::string& file) {
  const Result<std::string> text = read_file(file);
  return text ? text->substr(0, text->find('\n')) : std::string{};
}

void add_state(const helper::Files& files, Facts& facts) {
  if (access(files.users.c_str(), F_OK) != 0) {
    facts.state = "This PC is starting.";
    facts.is_well = true;
    return;
  }
  const helper::PanelAnswer panel = helper::ask_panel(panel_port, files.certificate, wait_for_panel);
  if (!panel.has_answered) {
    facts.state = "The cell does not answer, or not yet: " + panel.why_not_healthy;
    return;
  }
  facts.is_well = panel.why_not_healthy.empty();
  facts.state = facts.is_well ? "The cell runs, and all is well." : panel.why_not_healthy + '.';
  const std::string word = first_line_of(files.word);
  if (panel.may_move) {
    facts.motion = "Actuators may move.";
  } else if (word == "permitted") {
    facts.motion = "Nothing may move before Start is given at the panel.";
  } else {
    facts.motion = "Nothing may move: " + (word.empty() ? "the helper has not said so yet" : word) + ".";
  }
}

Facts facts_now(const helper::Files& files, const Journal& journal) {
  Facts facts;
  if (const Result<helper::NamedLines> version = helper::NamedLines::read(files.version)) {
    facts.application = version->text("application");
    facts.version = version->text("version");
  }
  if (const auto slot = helper::read_running(files).slot) facts.slot = std::string(1, boot::letter_of(*slot));
  facts.claim_code = first_line_of(code_file);
  facts.fingerprint = fingerprint_of(files.certificate);
  facts.notices = helper::notices_of(files);
  facts.log = journal.lines();
  add_addresses(facts);
  if (facts.claim_code.empty()) add_state(files, facts);
  return facts;
}

/// Over what stands there, without a moment in which nothing does.
std::string steps_for(const std::vector<std::string>& lines) {
  std::string text = "\033[?25l\033[H";
  for (std::size_t i = 0; i < lines.size(); ++i)
    text.append(i > 0 ? "\r\n" : "").append(lines[i]).append("\033[K");
  return text.append("\033[J");
}

void write_all(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (count <= 0) return;  // the console has gone: the next picture is tried anew
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace

int main(int argument_count, char**) {
  hold_standard_descriptors();
  if (argument_count > 1) {
    std::fputs(usage, stderr);
    return 1;
  }
  std::signal(SIGPIPE, SIG_IGN);
  ignore_keys();
  const helper::Files files;
  Journal journal;
  std::string shown;
  Time shown_at{};
  for (;;) {
    journal.take();
    const std::string picture = steps_for(draw(facts_now(files, journal), size_of_console()));
    const Time now = MonotonicClock::now();
    if (picture != shown || now - shown_at >= redraw_interval) {
      write_all(picture);
      shown = picture;
      shown_at = now;
    }
    constexpr timespec pause{look_interval / std::chrono::seconds{1}, 0};
    nanosleep(&pause, nullptr);
  }
}
