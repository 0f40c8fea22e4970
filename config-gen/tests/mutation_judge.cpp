#include "config-gen/tests/mutation_judge.hpp"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <sstream>

namespace flexrf::config_gen::tests {
namespace {

constexpr std::size_t most_lines = 1000;         // of messages, hints and notes
constexpr std::size_t most_bytes = 512 * 1024;   // of them
constexpr rlim_t most_memory = rlim_t{3} << 30;  // of the process
constexpr int most_seconds = 2;

std::array<char, 8192> under_way{};
std::array<char, 64 * 1024> stack_of_handler{};

void report(int signal) {
  const char* const what =
      signal == SIGPROF ? "config-gen takes more than 2 s of\n" : "config-gen crashes on\n";
  const auto print = [](const char* text) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(4);
  };
  print(what);
  print(under_way.data());
  _exit(3);
}

bool is_message(const std::string& line) {
  return line.find(": error: ") != std::string::npos || line.find(": warning: ") != std::string::npos;
}

// A message says where, in which line, and what to do.
std::string wrong_in(const std::string& messages) {
  std::istringstream stream(messages);
  std::string before;
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line); ++lines) {
    if (is_message(before) && line.find(": hint: ") == std::string::npos)
      return "a message has no hint: " + before.substr(0, 400);
    if (is_message(line)) {
      const std::string place = line.substr(0, line.find(": "));
      if (place.find_first_of("0123456789", place.rfind(':') + 1) != place.rfind(':') + 1)
        return "a message has no place: " + line.substr(0, 400);
    }
    before = line;
  }
  if (is_message(before)) return "a message has no hint: " + before.substr(0, 400);
  if (lines > most_lines) return std::to_string(lines) + " lines of messages";
  if (messages.size() > most_bytes) return std::to_string(messages.size()) + " bytes of messages";
  return "";
}

}  // namespace

Judgement judge(const Cell& cell) {
  Judgement judgement;
  try {
    const Target target{Target::Kind::application, cell.table};
    Diagnostics diagnostics;
    judgement.model = read(target, cell.paths, diagnostics);
    check(judgement.model, diagnostics);
    if (!diagnostics.failed()) judgement.files = emit(judgement.model, target, diagnostics);
    judgement.accepted = !diagnostics.failed();
    std::ostringstream text;
    diagnostics.print(text);
    judgement.wrong = wrong_in(text.str());
  } catch (const std::exception& error) {
    judgement.wrong = std::string("an exception: ") + error.what();
  }
  return judgement;
}

void watch_for_crashes() {
  const rlimit memory{most_memory, most_memory};
  setrlimit(RLIMIT_AS, &memory);
  stack_t stack{};
  stack.ss_sp = stack_of_handler.data();
  stack.ss_size = stack_of_handler.size();
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = report;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGPROF})
    sigaction(signal, &action, nullptr);
}

void watch(std::uint64_t number, const std::string& description) {
  std::snprintf(under_way.data(), under_way.size(), "mutation %llu:\n%s",
                static_cast<unsigned long long>(number), description.c_str());
  const itimerval limit{{0, 0}, {most_seconds, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

}  // namespace flexrf::config_gen::tests
