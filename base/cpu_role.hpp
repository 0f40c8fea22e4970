// What a thread's CPU is to be good for, as tables say it; the machine's file says which CPUs that are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace flexrf {

enum class CpuRole : std::uint8_t {
  any,
  control,
  io,
  rest  ///< of threads that are not real-time: what the real-time ones leave over
};

/// By CpuRole.
inline constexpr std::array<const char*, 4> cpu_role_names = {"any", "control", "io", "rest"};
constexpr const char* name_of(CpuRole role) noexcept {
  return cpu_role_names[static_cast<std::size_t>(role)];
}

}  // namespace flexrf
