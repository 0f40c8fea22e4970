#include "tests/applications/drivers/simulated_drive/simulated_drive.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "runtime/realtime/last_gasp.hpp"

namespace flexrf::user {
namespace {

constexpr double change_per_cycle = 0.05;
constexpr std::string_view brake = "last gasp: brake\n";

}  // namespace

Status SimulatedDrive::initialise() {
  stop();
  log_ = open("drive.log", O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  last_gasp_ = last_gasp::claim_slot();
  if (log_ < 0 || last_gasp_ < 0)
    return Status::error(StatusCode::unavailable, "no drive.log, or no room for its last gasp");
  last_gasp::prepare_write(last_gasp_, log_, std::as_bytes(std::span{brake.data(), brake.size()}));
  return {};
}

void SimulatedDrive::stop() {
  last_gasp::release_slot(last_gasp_);
  last_gasp_ = -1;
  if (log_ >= 0) close(log_);
  log_ = -1;
}

void SimulatedDrive::act(const Tick& /*tick*/) noexcept {
  held_ = false;
  approach();
}

void SimulatedDrive::rest(const Tick& /*tick*/) noexcept {
  if (making_safe_) return;
  if (moves_ && !held_) write_down("inhibited\n");
  held_ = true;
  approach();
}

void SimulatedDrive::approach() noexcept {
  speed_ += std::clamp(commanded_ - speed_, -change_per_cycle, change_per_cycle);
  if (speed_ > 0.4 && !moves_) write_down("moving\n");
  moves_ = moves_ || speed_ > 0.4;
}

bool SimulatedDrive::become_safe() noexcept {
  if (!making_safe_) write_down(speed_ > 0 ? "made safe while moving\n" : "made safe at rest\n");
  making_safe_ = true;
  speed_ = std::max(0.0, speed_ - change_per_cycle);
  if (speed_ > 0) return false;
  write_down("safe\n");
  return true;
}

void SimulatedDrive::write_down(const char* text) noexcept {
  [[maybe_unused]] const ssize_t written = write(log_, text, std::strlen(text));
}

}  // namespace flexrf::user
