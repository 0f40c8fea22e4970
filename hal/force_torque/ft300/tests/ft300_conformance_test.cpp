// The real driver over a pseudo-terminal.
#include <unistd.h>

#include <cstdlib>

#include "hal/force_torque/ft300/tests/ft300_line_cases.hpp"
#include "hal/force_torque/ft300/tests/ft300_world.hpp"

namespace flexrf {
namespace {

class PseudoTerminalWorld final : public Ft300World {
 public:
  ~PseudoTerminalWorld() override {
    driver().stop();
    unlink(name_.c_str());
    rmdir(folder_);
  }

 private:
  Status plug() override {
    if (name_.empty()) {
      if (mkdtemp(folder_) == nullptr) return Status::error(StatusCode::unavailable, "no folder in /tmp");
      name_ = std::string{folder_} + "/line";
    }
    if (const Status status = begin({"--pseudo-terminal"}); !status) return status;
    return name(simulator().first_line()) ? Status{}
                                          : Status::error(StatusCode::unavailable, "no link in /tmp");
  }
  bool unplug() override {
    unlink(name_.c_str());
    return say("unplug");
  }
  bool plug_in() override { return name(simulator().ask("plug")); }
  const char* device() const override { return name_.c_str(); }
  /// A name that stays, as /dev/serial/by-id has: the pseudo-terminal behind it is another each time.
  bool name(const std::string& line) const {
    unlink(name_.c_str());
    return symlink(line.c_str(), name_.c_str()) == 0;
  }

  char folder_[32] = "/tmp/flexrf-ft300-XXXXXX";
  std::string name_;
};

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  return run_ft300_line_cases() +
         run_force_torque_conformance(
             "FT300 on a pseudo-terminal",
             []() -> std::unique_ptr<ForceTorqueWorld> { return std::make_unique<PseudoTerminalWorld>(); });
}
