#include "hal/camera/interface/camera_controls.hpp"

#include <charconv>
#include <system_error>

#include "base/ascii.hpp"
#include "base/text.hpp"

namespace flexrf {
namespace {

constexpr std::string_view separators = " ,\t\n";
constexpr std::size_t most_text = 160;  // bytes of a list in a cause

Status not_offered(std::span<const CameraControl> offered, std::string_view name) noexcept {
  std::array<char, most_text> names{};
  std::size_t size = 0;
  for (const CameraControl& control : offered) {
    const std::string_view one = text_view(control.name);
    if (one.empty() || size + one.size() + 6 > names.size()) {
      if (!one.empty()) size += static_cast<std::size_t>(std::copy_n(" ...", 4, &names[size]) - &names[size]);
      break;
    }
    if (size > 0) names[size++] = ' ';
    size += one.copy(&names[size], one.size());
  }
  return Status::error(StatusCode::not_found, "the camera has no control '%.*s'; it has: %.*s",
                       static_cast<int>(std::min<std::size_t>(name.size(), 32)), name.data(),
                       static_cast<int>(size), names.data());
}

bool is_letter(char character) noexcept {
  return (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9');
}

}  // namespace

Result<CameraSettings> CameraSettings::parse(std::string_view text) noexcept {
  CameraSettings settings;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    if (text.empty()) return settings;
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(word.size());
    CameraSetting setting;
    const std::size_t equals = word.find('=');
    setting.name = word.substr(0, equals);
    const std::string_view value = equals == std::string_view::npos ? "" : word.substr(equals + 1);
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), setting.value);
    if (setting.name.empty() || error != std::errc() || end != value.data() + value.size()) {
      return Status::error(StatusCode::invalid_argument,
                           "'%.*s' sets no control; write NAME=VALUE, as brightness=100",
                           static_cast<int>(std::min<std::size_t>(word.size(), 64)), word.data());
    }
    if (settings.count_ == capacity) {
      return Status::error(StatusCode::out_of_range, "more than %zu controls are set at once", capacity);
    }
    settings.settings_[settings.count_++] = setting;
  }
}

Status check_setting(std::span<const CameraControl> offered, const CameraSetting& setting) noexcept {
  const CameraControl* const control = find_control(offered, setting.name);
  if (control == nullptr) return not_offered(offered, setting.name);
  if (control->read_only) {
    return Status::error(StatusCode::not_permitted, "the control '%.32s' can only be looked at",
                         control->name.data());
  }
  if (control->kind != CameraControlKind::button &&
      (setting.value < control->minimum || setting.value > control->maximum)) {
    return Status::error(StatusCode::out_of_range, "the control '%.32s' takes %d to %d, not %d",
                         control->name.data(), control->minimum, control->maximum, setting.value);
  }
  return {};
}

Status check_settings(std::span<const CameraControl> offered, std::string_view text) noexcept {
  const Result<CameraSettings> settings = CameraSettings::parse(text);
  if (!settings) return settings.status();
  for (const CameraSetting& setting : settings->all()) {
    if (Status status = check_setting(offered, setting); !status) return status;
  }
  return {};
}

const CameraControl* find_control(std::span<const CameraControl> offered, std::string_view name) noexcept {
  for (const CameraControl& control : offered) {
    if (control.name[0] == '\0') return nullptr;
    if (text_view(control.name) == name) return &control;
  }
  return nullptr;
}

std::array<char, 32> control_name(std::string_view shown) noexcept {
  std::array<char, 32> name{};
  std::size_t size = 0;
  for (const char shown_character : shown) {
    const char character = lower_case(shown_character);
    if (size == name.size()) break;
    if (is_letter(character)) {
      name[size++] = character;
    } else if (size > 0 && name[size - 1] != '_') {
      name[size++] = '_';
    }
  }
  if (size > 0 && name[size - 1] == '_') name[size - 1] = '\0';
  return name;
}

}  // namespace flexrf
