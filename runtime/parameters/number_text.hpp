// Numbers and ranges in messages. Private to runtime/parameters.
#pragma once

#include <charconv>
#include <cmath>

#include "base/status.hpp"
#include "runtime/core/type_descriptor.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {

/// The shortest text that reads back as the same number, zero-terminated.
class NumberText {
 public:
  template <class T>
  explicit NumberText(T number) noexcept {
    *std::to_chars(text_, text_ + sizeof(text_) - 1, number).ptr = '\0';
  }
  const char* c_str() const noexcept { return text_; }

 private:
  char text_[32];
};

/// " m", or nothing for what has no unit of measure.
class UnitText {
 public:
  explicit UnitText(const FieldDescriptor& field) noexcept
      : unit_(field.unit == nullptr || field.unit[0] == '\0' ||
                      (field.unit[0] == '1' && field.unit[1] == '\0')
                  ? ""
                  : field.unit) {}
  const char* blank() const noexcept { return unit_[0] == '\0' ? "" : " "; }
  const char* c_str() const noexcept { return unit_; }

 private:
  const char* unit_;
};

/// ok, or that a number is not finite or out of range, as "0.5 m lies outside 0.001 to 0.1 m".
template <class T>
Status check_number(const FieldDescriptor& field, T number, const ValueRange* range) noexcept {
  const auto value = static_cast<double>(number);
  if (!std::isfinite(value))
    return Status::error(StatusCode::out_of_range, "%s is not a finite number", NumberText(number).c_str());
  if (range == nullptr || (value >= range->minimum && value <= range->maximum)) return {};
  const UnitText unit(field);
  return Status::error(StatusCode::out_of_range, "%s%s%s lies outside %s to %s%s%s",
                       NumberText(number).c_str(), unit.blank(), unit.c_str(),
                       NumberText(range->minimum).c_str(), NumberText(range->maximum).c_str(), unit.blank(),
                       unit.c_str());
}

/// ok, or why the bytes (up to the first zero) are not UTF-8 that a file and a page can show.
Status check_text(std::string_view text) noexcept;

}  // namespace flexrf
