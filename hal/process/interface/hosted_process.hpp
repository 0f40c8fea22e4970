// HostedProcess: a driver of Process over a generated base. What differs between drivers is what runs the
// program.
#pragma once

#include "hal/process/interface/process_run.hpp"

namespace flexrf {

/// What the tables say of a program, checked. Lifecycle thread.
Result<ProcessProgram> process_program(std::string_view executable, std::string_view arguments,
                                       std::string_view environment, std::string_view directory);

template <class Base, class Host>
class HostedProcess : public Base {
 public:
  ~HostedProcess() override { run_.stop(); }

  Status initialise() override {
    const auto& set = this->configuration;
    run_.stop();
    const Result<ProcessProgram> program = process_program(
        set.executable_view(), set.arguments_view(), set.environment_view(), set.working_directory_view());
    if (!program) return program.status();
    if (const Status status = host_.open(*program); !status) return status;
    return run_.begin(this->name(), host_,
                      {.start = set.start,
                       .restart = set.restart,
                       .restart_shortest = duration_of(set.restart_shortest),
                       .restart_longest = duration_of(set.restart_longest),
                       .start_timeout = duration_of(set.start_timeout),
                       .stop_timeout = duration_of(set.stop_timeout)});
  }
  void stop() override { run_.stop(); }

  void receive(const Tick& tick) noexcept override {
    run_.receive(tick.now);
    ProcessLine line;
    while (this->lines.is_connected() && this->lines.has_room() && run_.read_line(line)) {
      this->lines.push(line, Time{Duration{line.at}});
    }
    run_.fill(this->feedback);
  }
  void send(const Tick& tick) noexcept override {
    run_.send(tick.now);
    run_.fill(this->feedback);
    if (run_.is_lost()) {
      this->fail(Status::error(StatusCode::unavailable, "%.*s", static_cast<int>(run_.trouble().size()),
                               run_.trouble().data()));
    }
  }

  ProcessState state() const noexcept override { return run_.state(); }
  void request_start() noexcept override { run_.request_start(); }
  void request_stop() noexcept override { run_.request_stop(); }
  bool write_line(std::string_view line) noexcept override { return run_.write(line, true); }
  bool write(std::string_view bytes) noexcept override { return run_.write(bytes, false); }
  void close_input() noexcept override { run_.close_input(); }
  bool read_line(ProcessLine& line) noexcept override { return run_.read_line(line); }

 protected:
  Host& host() noexcept { return host_; }

 private:
  Host host_;
  ProcessRun run_;
};

}  // namespace flexrf
