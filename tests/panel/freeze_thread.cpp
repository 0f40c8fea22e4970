// freeze_thread PROCESS NAME: holds the threads of this name still until the end of standard input, so that
// tests see what becomes of a cell whose panel hangs. Prints "frozen" and when it began (ns, monotonic clock)
// when they are. Exit code 1: there is none, or no right to.
#include <dirent.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace {

std::vector<pid_t> threads_of(const std::string& tasks, const std::string& name) {
  std::vector<pid_t> found;
  DIR* const folder = opendir(tasks.c_str());
  if (folder == nullptr) return found;
  while (const dirent* entry = readdir(folder)) {
    std::ifstream file(tasks + "/" + entry->d_name + "/comm");
    std::string comm;
    if (std::getline(file, comm) && comm == name)
      found.push_back(static_cast<pid_t>(std::atol(entry->d_name)));
  }
  closedir(folder);
  return found;
}

bool freeze(pid_t thread) {
  if (ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0 ||
      ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0) {
    std::fprintf(stderr, "thread %d: %s\n", static_cast<int>(thread), std::strerror(errno));
    return false;
  }
  int status = 0;
  return waitpid(thread, &status, __WALL) == thread && WIFSTOPPED(status);
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 1;
  const std::vector<pid_t> threads = threads_of(std::string("/proc/") + arguments[1] + "/task", arguments[2]);
  if (threads.empty()) {
    std::fprintf(stderr, "process %s has no thread '%s'\n", arguments[1], arguments[2]);
    return 1;
  }
  timespec began{};
  clock_gettime(CLOCK_MONOTONIC, &began);
  for (const pid_t thread : threads)
    if (!freeze(thread)) return 1;
  std::printf("frozen %lld\n", static_cast<long long>(began.tv_sec) * 1'000'000'000 + began.tv_nsec);
  std::fflush(stdout);
  char byte = 0;
  while (read(STDIN_FILENO, &byte, 1) > 0) continue;
  for (const pid_t thread : threads) ptrace(PTRACE_DETACH, thread, nullptr, nullptr);
  return 0;
}
