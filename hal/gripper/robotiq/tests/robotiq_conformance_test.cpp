// The real driver over a pseudo-terminal.
#include <unistd.h>

#include "hal/gripper/robotiq/tests/robotiq_world.hpp"

namespace {

using namespace flexrf;

class PseudoTerminalWorld final : public RobotiqWorld {
 public:
  ~PseudoTerminalWorld() override {
    unlink(name_.c_str());
    rmdir(folder_);
  }

 private:
  Status plug() override {
    if (mkdtemp(folder_) == nullptr) return Status::error(StatusCode::unavailable, "no folder in /tmp");
    name_ = std::string{folder_} + "/line";
    if (const Status status = begin({"--pseudo-terminal"}); !status) return status;
    return name(simulator().first_line()) ? Status{}
                                          : Status::error(StatusCode::unavailable, "no link in /tmp");
  }
  const char* device() const override { return name_.c_str(); }
  bool unplug() override {
    unlink(name_.c_str());
    return say("unplug");
  }
  bool plug_in() override { return name(simulator().ask("plug")); }
  /// A name that stays, as /dev/serial/by-id has: the pseudo-terminal behind it is another each time.
  bool name(const std::string& line) const { return symlink(line.c_str(), name_.c_str()) == 0; }

  char folder_[32] = "/tmp/flexrf-robotiq-XXXXXX";
  std::string name_;
};

}  // namespace

int main() {
  return run_gripper_conformance(
      "Robotiq gripper on a pseudo-terminal",
      []() -> std::unique_ptr<GripperWorld> { return std::make_unique<PseudoTerminalWorld>(); });
}
