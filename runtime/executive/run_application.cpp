// The main function of every application.
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <memory>

#include "runtime/executive/executive.hpp"
#include "runtime/executive/report.hpp"
#include "runtime/realtime/instance_lock.hpp"

namespace flexrf {
namespace {

constexpr int exit_usage = 1;
constexpr int exit_fault = 2;
constexpr int exit_right_missing = 3;

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

Status write_file(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file != nullptr) written = std::fclose(file) == 0 && written;
  if (written) return {};
  return Status::error(StatusCode::unavailable, "--report %s: %s", path.c_str(), std::strerror(errno));
}

}  // namespace

int run_application(const Application& application, int argument_count, char** arguments, MakeObserver make) {
  Result<Options> options = parse_options(application, argument_count, arguments);
  if (!options) return refuse(application, options.status());
  if (options->help) {
    std::fputs(usage(application).c_str(), stdout);
    return 0;
  }
  if (options->descriptor) {
    std::puts(application.descriptor_json);
    return 0;
  }
  if (make == nullptr && options->panel_given) {
    return refuse(
        application,
        Status::error(StatusCode::invalid_argument,
                      "--panel %s: this application was built without the panel; leave --panel away",
                      options->panel.c_str()));
  }
  options->observed = make != nullptr && options->panel != "off" && !options->virtual_time;
  InstanceLock lock;
  // In virtual time nothing of the cell is touched: any number may run.
  if (!options->virtual_time) {
    if (const Status status = lock.acquire(application.name); !status) return refuse(application, status);
  }
  Executive executive(application, *options);
  if (const Status status = executive.prepare(); !status) return refuse(application, status);
  std::unique_ptr<Observer> observer;
  if (options->observed) {
    observer = make(executive);
    if (const Status status = observer->prepare(); !status) {
      observer->stop();
      std::fprintf(stderr, "%s: %s\n", application.name, status.cause());
      return exit_usage;
    }
    executive.set_observer(*observer);
  }
  RunSummary summary = executive.run();
  std::fputs(report_text(executive.cell(), summary).c_str(), stdout);
  if (!options->report_file.empty()) {
    if (const Status status = write_file(options->report_file, report_json(executive.cell(), summary));
        !status) {
      std::fprintf(stderr, "%s: %s\n", application.name, status.cause());
      if (summary.exit_code == 0) summary.exit_code = exit_usage;
    }
  }
  if (summary.digest) std::printf("%016" PRIx64 "\n", *summary.digest);
  std::fflush(nullptr);
  // A thread that hangs can be neither joined nor destroyed under; the process can only be left.
  if (summary.stuck) _exit(exit_fault);
  if (observer != nullptr) observer->stop();
  return summary.exit_code;
}

}  // namespace flexrf
