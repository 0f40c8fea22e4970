#include "hal/force_torque/net_ft/ati_status.hpp"

namespace flexrf {
namespace {

constexpr std::uint32_t any_error = 1U << 31U;

struct Meaning {
  std::uint32_t bits;
  const char* words;
};

// After ATI's manual of Ethernet Axia, 9610-05, table of the status code.
constexpr Meaning axia[] = {
    {1U << 0U, "its temperature is out of range: let it cool down or warm up"},
    {1U << 1U, "its supply voltage is out of range"},
    {1U << 2U, "a gauge is broken: send it in"},
    {1U << 29U, "its calibration is damaged: send it in"},
};
constexpr std::uint32_t axia_saturated = 1U << 30U | 1U << 27U;
constexpr std::uint32_t box_saturated = 1U << 17U;

}  // namespace

bool is_saturated(std::uint32_t status, AtiFamily family) noexcept {
  return (status & (family == AtiFamily::axia ? axia_saturated : box_saturated)) != 0;
}

Status check_status(std::uint32_t status, AtiFamily family) noexcept {
  if ((status & any_error) == 0) return {};
  const char* words = "see the status code in its manual, and its web page";
  if (family == AtiFamily::axia) {
    for (const Meaning& one : axia) {
      if ((status & one.bits) == 0) continue;
      words = one.words;
      break;
    }
  }
  // An overload alone is told as one.
  const std::uint32_t saturated = family == AtiFamily::axia ? axia_saturated : box_saturated;
  if ((status & saturated) != 0 && (status & ~(saturated | any_error)) == 0) return {};
  return Status::error(StatusCode::device_fault, "the sensor reports status 0x%08X: %s", status, words);
}

}  // namespace flexrf
