// The real driver over a pseudo-terminal.
#include <unistd.h>

#include <cstdlib>

#include "hal/simulated/modbus_server/pseudo_serial_line.hpp"
#include "tests/force_torque/ft300_line_cases.hpp"
#include "tests/force_torque/ft300_world.hpp"

namespace flexrf {
namespace {

class PseudoTerminalWorld final : public Ft300World {
 public:
  ~PseudoTerminalWorld() override {
    driver().stop();
    end_server();
    unlink(name_.c_str());
    rmdir(folder_);
  }

 private:
  Status plug() override {
    end_server();
    if (name_.empty()) {
      if (mkdtemp(folder_) == nullptr) return Status::error(StatusCode::unavailable, "no folder in /tmp");
      name_ = std::string{folder_} + "/line";
    }
    if (const Status status = line_.open(); !status) return status;
    // A name that stays, as /dev/serial/by-id has: the pseudo-terminal behind it is another each time.
    unlink(name_.c_str());
    if (symlink(line_.path().c_str(), name_.c_str()) != 0)
      return Status::error(StatusCode::unavailable, "no link in /tmp");
    return serve(Ft300Server::on_descriptor(line_.descriptor(), ft300::usual_unit_id));
  }
  bool unplug() override {
    end_server();
    unlink(name_.c_str());
    line_.close();
    return true;
  }
  const char* device() const override { return name_.c_str(); }

  char folder_[32] = "/tmp/flexrf-ft300-XXXXXX";
  std::string name_;
  PseudoSerialLine line_;
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
