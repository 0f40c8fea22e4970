#pragma once

#include "hal/process/interface/process_host.hpp"
#include "hal/process/linux/spawn_helper.hpp"
#include "hal/process/linux/spawn_order.hpp"

namespace flexrf {

/// One system call in a cycle for news of the program, one more for each of its two outputs while it runs,
/// and one when it is fed.
class LinuxProcessHost final : public ProcessHost {
 public:
  ~LinuxProcessHost() override { release(); }

  Status open(const ProcessProgram& program) override;
  void wait(Duration most) noexcept override;
  bool start() noexcept override;
  void end(bool at_once) noexcept override;
  bool next_event(ProcessEvent& event) noexcept override;
  long read(ProcessSource source, std::span<char> bytes) noexcept override;
  long write(std::string_view bytes) noexcept override;
  void close_input() noexcept override { close_descriptor(input_); }
  void release() noexcept override;

  pid_t helper() const noexcept { return helper_.id(); }

 private:
  static void close_descriptor(int& descriptor) noexcept;
  bool order(const SpawnOrder& what, std::size_t size) const noexcept;
  bool lose(ProcessEvent& event) noexcept;

  SpawnHelper helper_;  // made with the driver, before there is any thread
  SpawnOrder start_;
  std::string executable_;
  bool runs_ = false;
  bool lost_ = false;
  int input_ = -1;
  int outputs_[2] = {-1, -1};  // by source
};

}  // namespace flexrf
