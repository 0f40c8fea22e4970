// The driver on a real (pseudo) terminal: a child process has it as its controlling terminal.
#include "hal/operator/keyboard/terminal/terminal_keyboard.hpp"

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr int patience = 10000;  // ms, for what happens at once unless it never does

/// The child: reads keys until it reads 'x' or the keyboard closes, and writes each to the terminal as "<w>".
[[noreturn]] void read_keys() {
  {
    DeviceBench<TerminalKeyboard> bench(nullptr);
    if (!bench.driver().initialise()) _exit(1);
    dprintf(STDOUT_FILENO, "ready\n");
    bool leave = false;
    while (!leave && !bench.driver().is_closed()) {
      pollfd wait{bench.driver().descriptor(), POLLIN, 0};
      if (poll(&wait, 1, patience) == 0) _exit(2);
      bench.receive(std::chrono::milliseconds(1));
      while (const auto event = bench.driver().read()) {
        if (event->key == Key::character) {
          dprintf(STDOUT_FILENO, "<%c>", static_cast<int>(event->character));
        } else {
          dprintf(STDOUT_FILENO, "<key %d>", static_cast<int>(event->key));
        }
        if (event->character == 'c') std::exit(7);  // without stop()
        leave = leave || event->character == 'x';
      }
    }
    bench.driver().stop();
  }
  dprintf(STDOUT_FILENO, "left");
  pause();  // the terminal lives as long as somebody has it
  _exit(0);
}

class Terminal {
 public:
  Terminal() {
    child_ = forkpty(&descriptor_, nullptr, nullptr, nullptr);
    if (child_ == 0) read_keys();
  }
  ~Terminal() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
    if (descriptor_ >= 0) close(descriptor_);
  }

  void type(const std::string& keys) { good_ = write(descriptor_, keys.data(), keys.size()) > 0 && good_; }

  /// Waits until the terminal shows this text.
  bool shows(const std::string& text) {
    while (shown_.find(text) == std::string::npos) {
      pollfd wait{descriptor_, POLLIN, 0};
      char bytes[256];
      if (poll(&wait, 1, patience) <= 0) return false;
      const ssize_t count = read(descriptor_, bytes, sizeof(bytes));
      if (count <= 0) return false;
      shown_.append(bytes, static_cast<std::size_t>(count));
    }
    return good_;
  }
  bool is_raw() const {
    termios settings{};
    return tcgetattr(descriptor_, &settings) == 0 && (settings.c_lflag & (ICANON | ECHO)) == 0 &&
           (settings.c_lflag & ISIG) != 0;
  }
  bool is_as_before() const {
    termios settings{};
    return tcgetattr(descriptor_, &settings) == 0 && (settings.c_lflag & (ICANON | ECHO)) == (ICANON | ECHO);
  }
  /// Waits until the child stopped or ended; its status.
  int wait() {
    int status = 0;
    if (waitpid(child_, &status, WUNTRACED) == child_ && !WIFSTOPPED(status)) child_ = -1;
    return status;
  }
  void cook() const {
    termios settings{};
    tcgetattr(descriptor_, &settings);
    settings.c_lflag |= ICANON | ECHO;
    tcsetattr(descriptor_, TCSANOW, &settings);
  }
  void signal(int number) { kill(child_, number); }
  const std::string& shown() const { return shown_; }

 private:
  int descriptor_ = -1;
  pid_t child_ = -1;
  std::string shown_;
  bool good_ = true;
};

bool run_keys_come_one_by_one() {
  Terminal terminal;
  if (!terminal.shows("ready") || !terminal.is_raw()) return false;
  terminal.type("w");
  if (!terminal.shows("<w>")) return false;
  terminal.type("\x1B[A");
  if (!terminal.shows("<key " + std::to_string(static_cast<int>(Key::up)) + ">")) return false;
  terminal.type("\x1B");  // alone: the escape key, once nothing follows
  if (!terminal.shows("<key " + std::to_string(static_cast<int>(Key::escape)) + ">")) return false;
  terminal.type("x");
  return terminal.shows("left") && terminal.is_as_before() &&
         terminal.shown().find("^[") == std::string::npos;
}

bool run_control_d_closes() {
  Terminal terminal;
  if (!terminal.shows("ready")) return false;
  terminal.type("w\x04");
  return terminal.shows("<w>") && terminal.shows("left") && terminal.is_as_before();
}

bool run_fg_takes_the_terminal_back() {
  Terminal terminal;
  if (!terminal.shows("ready")) return false;
  terminal.signal(SIGSTOP);
  if (!WIFSTOPPED(terminal.wait())) return false;
  // As a shell does, which wants to be typed to.
  terminal.cook();
  terminal.signal(SIGCONT);
  terminal.type("w");
  // The key is read only once the terminal is raw again: a cooked one would wait for the line's end.
  return terminal.shows("<w>") && terminal.is_raw();
}

bool run_control_c_still_ends() {
  Terminal terminal;
  if (!terminal.shows("ready")) return false;
  terminal.type("\x03");
  const int status = terminal.wait();
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGINT;
}

bool run_exit_restores() {
  Terminal terminal;
  if (!terminal.shows("ready")) return false;
  terminal.type("c");
  const int status = terminal.wait();
  return WIFEXITED(status) && WEXITSTATUS(status) == 7 && terminal.is_as_before();
}

void keys_come_one_by_one(void**) {
  assert_true(run_keys_come_one_by_one());
}
void control_d_closes(void**) {
  assert_true(run_control_d_closes());
}
void fg_takes_the_terminal_back(void**) {
  assert_true(run_fg_takes_the_terminal_back());
}
void control_c_still_ends(void**) {
  assert_true(run_control_c_still_ends());
}
void exit_restores(void**) {
  assert_true(run_exit_restores());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(keys_come_one_by_one),
      cmocka_unit_test(control_d_closes),
      cmocka_unit_test(fg_takes_the_terminal_back),
      cmocka_unit_test(control_c_still_ends),
      cmocka_unit_test(exit_restores),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
