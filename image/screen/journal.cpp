#include "image/screen/journal.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace flexrf::screen {
namespace {

// The units whose lines a person has to read. journalctl adds what systemd says of them.
constexpr const char* arguments[] = {"journalctl",
                                     "--quiet",
                                     "--follow",
                                     "--lines=60",
                                     "--output=cat",
                                     "--unit=flexrf.service",
                                     "--unit=flexrf-claim.service",
                                     "--unit=flexrf-helper.service",
                                     "--unit=flexrf-first-boot.service",
                                     "--unit=flexrf-data-repair.service",
                                     "--unit=flexrf-boot-repair.service",
                                     "--unit=flexrf-grow-data.service",
                                     "--unit=flexrf-update@verify.service",
                                     "--unit=flexrf-update@install.service",
                                     nullptr};

constexpr std::size_t longest_line = 400;

}  // namespace

Journal::~Journal() {
  end();
}

void Journal::start() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  const int error =
      posix_spawnp(&child_, arguments[0], &actions, nullptr, const_cast<char* const*>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error != 0) {
    child_ = -1;
    close(ends[0]);
    return;
  }
  pipe_ = ends[0];
  lines_.clear();  // it says the last ones again
}

void Journal::end() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  if (child_ > 0) {
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  child_ = -1;
  begun_.clear();
}

bool Journal::take() {
  if (pipe_ < 0) start();
  if (pipe_ < 0) return false;
  bool has_come = false;
  std::array<char, 4096> bytes{};
  for (;;) {
    const ssize_t count = read(pipe_, bytes.data(), bytes.size());
    if (count < 0) return has_come;  // nothing more now
    if (count == 0) {
      end();
      return has_come;
    }
    for (ssize_t i = 0; i < count; ++i) {
      const char one = bytes[static_cast<std::size_t>(i)];
      if (one != '\n') {
        if (begun_.size() < longest_line) begun_ += one;
        continue;
      }
      lines_.push_back(std::move(begun_));
      begun_.clear();
      if (lines_.size() > most_lines) lines_.pop_front();
      has_come = true;
    }
  }
}

}  // namespace flexrf::screen
