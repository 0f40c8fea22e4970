#include "runtime/run/run_application.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/quantity_text.hpp"
#include "base/standard_descriptors.hpp"
#include "runtime/executive/driver_choice.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/executive/file_options.hpp"
#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/realtime/instance_lock.hpp"
#include "runtime/realtime/signals.hpp"
#include "runtime/run/report.hpp"
#include "runtime/run/status_view.hpp"

namespace flexrf {
namespace {

constexpr int exit_usage = 1;
constexpr int exit_fault = 2;
constexpr int exit_right_missing = 3;
/// Bytes of stack of the main thread. It uses less than 128 KiB of its own; in virtual time units step on it,
/// which have 256 KiB unless their tables say otherwise.
constexpr rlim_t least_stack = 512 << 10;

int exit_code_of(const Status& status) noexcept {
  switch (status.code()) {
    case StatusCode::not_permitted:
      return exit_right_missing;
    case StatusCode::device_fault:
    case StatusCode::internal:
    case StatusCode::busy:
      return exit_fault;
    default:
      return exit_usage;
  }
}

int refuse(const Application& application, const Status& status) {
  std::fprintf(stderr, "%s: %s\n", application.name, status.cause());
  return exit_code_of(status);
}

void complain(const Application& application, const Status& status) {
  tell_at_once(std::string{application.name} + ": " + status.cause() + "\n");
}

std::string version_line(const Application& application) {
  return std::string{application.name} + ", descriptor " + hexadecimal_text(application.descriptor_hash) +
         ", FlexRF " FLEXRF_VERSION "\n";
}

/// On a disk that is full the report of the run before stays.
Status write_report(const std::string& path, const std::string& text) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  struct stat found {};
  if (stat(path.c_str(), &found) != 0 || S_ISREG(found.st_mode)) {
    const Status status = replace_file(path, text, 0644, largest);
    return status ? status : Status::error(status.code(), "--report %s: %s", path.c_str(), status.cause());
  }
  // A device, as /dev/null, is not replaced.
  std::FILE* file = std::fopen(path.c_str(), "w");
  bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file != nullptr) written = std::fclose(file) == 0 && written;
  if (written) return {};
  return Status::error(StatusCode::unavailable, "--report %s: %s", path.c_str(), cause_of(errno).c_str());
}

/// What somebody asked for instead of a run.
int answer(const Application& application, const std::string& text) {
  if (std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return 0;
  std::fprintf(stderr, "%s: standard output: %s\n", application.name, cause_of(errno).c_str());
  return exit_usage;
}

/// Before anything of the cell is touched. In virtual time nothing is: any number may run.
Status lock_cell(const Cell& cell, const Options& options, InstanceLock& lock) {
  if (options.virtual_time) return {};
  char directory[lock_directory_size];
  const LockScope scope = cell.real_actuator() != nullptr ? LockScope::machine : LockScope::user;
  if (const Status status = find_lock_directory(scope, directory); !status) return status;
  if (const Status status = lock.acquire(cell.application().name, directory); !status) return status;
  if (scope == LockScope::user) {
    log_info(cell.application().name,
             "no real actuator is chosen: this cell runs once per user (lock file {})",
             std::string_view(lock.path()));
  }
  return {};
}

Status check_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      limit.rlim_cur >= least_stack)
    return {};
  return Status::error(
      StatusCode::invalid_argument,
      "the limit of the stack (RLIMIT_STACK) is %llu KiB, at least %llu KiB are needed; set it "
      "by ulimit -s, or LimitSTACK of a service",
      static_cast<unsigned long long>(limit.rlim_cur >> 10),
      static_cast<unsigned long long>(least_stack >> 10));
}

/// In a frame of its own, as a stack that is too small is found out before.
[[gnu::noinline]] int run_checked(const Application& application, int argument_count, char** arguments,
                                  const ObserverPart* part) {
  Result<Options> options = parse_options(application, part, argument_count, arguments);
  if (!options) return refuse(application, options.status());
  const OptionValues asked = options->values();
  if (asked.has("--help")) return answer(application, usage(application, part));
  if (asked.has("--version")) return answer(application, version_line(application));
  if (asked.has("--descriptor")) return answer(application, std::string{application.descriptor_json} + "\n");
  if (asked.has("--drivers")) {
    const auto drivers = choose_drivers(application, *options);
    return drivers ? answer(application, hardware_text(application, *drivers) + "\n")
                   : refuse(application, drivers.status());
  }
  if (const Status status = check_file_options(*options); !status) return refuse(application, status);
  InstanceLock lock;
  Executive executive(application, *options);
  if (const Status status = executive.prepare(); !status) return refuse(application, status);
  if (const Status status = lock_cell(executive.cell(), *options, lock); !status)
    return refuse(application, status);
  std::unique_ptr<Observer> observer;
  if (options->observed) {
    // From here on somebody may know that it runs: who ends it gets a report, as later.
    const sigset_t awaited = signals::supervised_set();
    pthread_sigmask(SIG_BLOCK, &awaited, nullptr);
    observer = part->make(executive);
    if (const Status status = observer->prepare(); !status) {
      observer->stop();
      std::fprintf(stderr, "%s: %s\n", application.name, status.cause());
      return exit_usage;
    }
    executive.set_observer(*observer);
  }
  if (options->status_view && !options->virtual_time) executive.set_view(&StatusView::make);
  // What is thrown while threads run must not take away what they use: it ends the process as a crash does.
  RunSummary summary = [&executive]() noexcept { return executive.run(); }();
  // Whatever is left to be said may wait for its reader: nobody else does by then.
  if (!summary.stuck && observer != nullptr) observer->stop();
  const auto note_failure = [&](const Status& status) {
    if (status) return;
    complain(application, status);
    // Whoever ended it by a signal is told as well, if he was not the one who did not read.
    const bool is_hidden = summary.exit_code > 128 && status.code() != StatusCode::timeout;
    if (summary.exit_code == 0 || is_hidden) summary.exit_code = exit_usage;
  };
  if (!options->report_file.empty())
    note_failure(write_report(options->report_file, report_json(executive.cell(), summary)));
  std::vector<std::string> texts{report_text(executive.cell(), summary)};
  if (summary.digest) texts.push_back(hexadecimal_text(*summary.digest) + "\n");
  for (const Status& failure : executive.say_last(std::move(texts))) note_failure(failure);
  // A thread that hangs can be neither joined nor destroyed under; the process can only be left.
  if (summary.stuck || executive.is_still_saying() || executive.is_still_saving()) _exit(summary.exit_code);
  return summary.exit_code;
}

}  // namespace

int run_application(const Application& application, int argument_count, char** arguments,
                    const ObserverPart* part) {
  hold_standard_descriptors();
  // Before the first write: a limit of file sizes would end the process without a word.
  signals::ignore_what_writes_tell();
  if (const Status status = check_stack(); !status) return refuse(application, status);
  try {
    return run_checked(application, argument_count, arguments, part);
  } catch (const std::exception& error) {
    // As by a library that gets no descriptor or no memory.
    return refuse(application, Status::error(StatusCode::unavailable,
                                             "not started: %s; look at the limits of the process (ulimit -n, "
                                             "ulimit -v)",
                                             error.what()));
  }
}

}  // namespace flexrf
