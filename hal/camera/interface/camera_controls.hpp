// Controls of a camera: what it was found to offer, and what a person wrote that they shall be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/status.hpp"
#include "types/camera_control.hpp"

namespace flexrf {

struct CameraSetting {
  std::string_view name{};  ///< within the text that it was written in
  std::int32_t value = 0;
};

/// What a text as "brightness=100 gain=3" sets, in its order [camera-controls-2]. Any thread; never
/// allocates.
class CameraSettings {
 public:
  static constexpr std::size_t capacity = 32;

  /// `text` outlives what is read of it. Blanks and commas separate.
  static Result<CameraSettings> parse(std::string_view text) noexcept;
  std::span<const CameraSetting> all() const noexcept { return {settings_.data(), count_}; }

 private:
  std::array<CameraSetting, capacity> settings_{};
  std::size_t count_ = 0;
};

/// Ok, or why the camera cannot be set so: the cause names what it offers instead [camera-controls-1].
Status check_setting(std::span<const CameraControl> offered, const CameraSetting& setting) noexcept;
/// All of a text.
Status check_settings(std::span<const CameraControl> offered, std::string_view text) noexcept;

/// The one of this name, else null. Those behind the first without a name do not exist.
const CameraControl* find_control(std::span<const CameraControl> offered, std::string_view name) noexcept;

/// "White Balance, Automatic" is white_balance_automatic [camera-controls-3].
std::array<char, 32> control_name(std::string_view shown) noexcept;

}  // namespace flexrf
