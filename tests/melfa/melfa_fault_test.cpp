#include "tests/melfa/loopback_world.hpp"
#include "tests/melfa/melfa_faults.hpp"

int main() {
  return flexrf::run_melfa_faults(
      "faults of a MELFA arm over UDP",
      []() -> std::unique_ptr<flexrf::MelfaWorld> { return std::make_unique<flexrf::LoopbackWorld>(); });
}
