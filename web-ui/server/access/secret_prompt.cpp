#include "web-ui/server/access/secret_prompt.hpp"

#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace flexrf::panel {
namespace {

constexpr char interrupt = 3;  // Ctrl-C

/// The terminal does not show what is typed while it lives. Whatever would end the program before the
/// terminal is itself again waits: signals, and Ctrl-C, which comes as a character.
class Silence {
 public:
  Silence() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int number : {SIGTERM, SIGHUP}) sigaddset(&signals, number);
    sigprocmask(SIG_BLOCK, &signals, &mask_);
    tcgetattr(STDIN_FILENO, &settings_);
    termios silent = settings_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO | ISIG);
    silent.c_cc[VEOL] = interrupt;
    tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  ~Silence() {
    tcsetattr(STDIN_FILENO, TCSAFLUSH, &settings_);
    sigprocmask(SIG_SETMASK, &mask_, nullptr);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  termios settings_{};
  sigset_t mask_{};
};

/// Up to a line feed, which is left out. False: there was none.
bool read_line(std::string& line) {
  char character = 0;
  while (read(STDIN_FILENO, &character, 1) == 1 && character != interrupt) {
    if (character == '\n') return true;
    line += character;
  }
  return false;
}

Result<std::string> ask(const char* question, const std::string& user) {
  std::string line;
  bool is_read = false;
  {
    const Silence silence;
    std::fprintf(stderr, "%s for %s: ", question, user.c_str());
    is_read = read_line(line);
  }
  std::fputc('\n', stderr);
  if (is_read) return line;
  return Status::error(StatusCode::closed, "no password was given; nothing has changed");
}

}  // namespace

Result<std::string> read_new_secret(const std::string& user) {
  if (isatty(STDIN_FILENO) == 0) {
    std::string line;
    if (read_line(line) || !line.empty()) return line;
    return Status::error(StatusCode::closed, "no password came on standard input; nothing has changed");
  }
  Result<std::string> first = ask("New password", user);
  if (!first) return first;
  const Result<std::string> second = ask("Once more, the password", user);
  if (!second) return second;
  if (*first != *second)
    return Status::error(StatusCode::invalid_argument, "the two passwords differ; nothing has changed");
  return first;
}

}  // namespace flexrf::panel
