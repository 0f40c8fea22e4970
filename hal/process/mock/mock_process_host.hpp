#pragma once

#include <array>
#include <optional>

#include "hal/process/interface/process_host.hpp"

namespace flexrf {

/// The program is the test: it prints, reads and ends as it is called, between cycles, from the thread that
/// the process lives in. By itself it starts at once, reads all that it is fed and ends when it is asked to.
class MockProcessHost final : public ProcessHost {
 public:
  /// Bytes that wait in each direction, as in a pipe.
  static constexpr std::size_t pipe_capacity = 65536;

  MockProcessHost();

  // The far end.
  bool runs() const noexcept { return runs_; }
  const ProcessProgram& program() const noexcept { return program_; }  ///< as it was opened
  /// False, and nothing is printed: it does not run, or its output is full.
  bool print(ProcessSource source, std::string_view bytes) noexcept;
  void exit(int code) noexcept { finish(code, 0); }
  void die(int signal) noexcept { finish(0, signal); }
  /// What it was fed since the start, as far as it read; that its input has ended.
  std::string_view fed() const noexcept { return fed_; }
  bool input_ended() const noexcept { return input_ended_; }
  void set_reads(bool on) noexcept { reads_ = on; }
  /// Whether it ends when it is asked to; a kill ends it in any case.
  void set_obeys(bool on) noexcept { obeys_ = on; }
  /// Its children have its output open after it has ended.
  void set_leaves_output_open(bool on) noexcept { leaves_open_ = on; }
  /// How starts go from now on: ok: as they should.
  void refuse(const Status& cause) noexcept { refusal_ = cause; }
  /// Whatever starts programs is gone, and the program with it.
  void lose(const Status& cause) noexcept;

  Status open(const ProcessProgram& program) override;
  void wait(Duration most) noexcept override;
  bool start() noexcept override;
  void end(bool at_once) noexcept override;
  bool next_event(ProcessEvent& event) noexcept override;
  long read(ProcessSource source, std::span<char> bytes) noexcept override;
  long write(std::string_view bytes) noexcept override;
  void close_input() noexcept override { input_ended_ = true; }
  void release() noexcept override;

 private:
  void finish(int code, int signal) noexcept;
  void tell(const ProcessEvent& event) noexcept;

  ProcessProgram program_;
  std::array<std::string, 2> printed_;  // by source
  std::array<std::size_t, 2> read_{};
  std::string fed_;
  std::array<ProcessEvent, 2> events_{};
  std::size_t event_count_ = 0;
  Status refusal_;
  int next_id_ = 1000;
  bool runs_ = false;
  bool obeys_ = true;
  bool reads_ = true;
  bool leaves_open_ = false;
  bool input_ended_ = false;
};

}  // namespace flexrf
