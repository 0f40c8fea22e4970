// Errors as values: a status carries a code for the program and a cause for the person.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

namespace flexrf {

enum class StatusCode : std::uint8_t {
  ok,
  invalid_argument,  ///< the caller asked for something that makes no sense
  out_of_range,      ///< a value lies outside its declared range
  not_found,         ///< no such name, file, device
  busy,              ///< try again later; nothing was done
  timeout,           ///< no answer in time
  unavailable,       ///< the other side is gone or not ready
  not_permitted,     ///< a right is missing, or the state does not allow it
  device_fault,      ///< the hardware reports a fault
  closed,            ///< no more will come
  internal,          ///< a defect in FlexRF or in a unit
};

const char* name_of(StatusCode code) noexcept;

/// The outcome of an operation. Never allocates: the cause lives inside (at most 239 bytes, cut beyond).
/// Any thread may make and copy one.
class [[nodiscard]] Status {
 public:
  static constexpr std::size_t cause_capacity = 240;

  constexpr Status() noexcept = default;

  /// A failure with its cause: what went wrong, where, and what a person can do about it.
  [[gnu::format(printf, 2, 3)]] static Status error(StatusCode code, const char* format, ...) noexcept {
    Status status;
    status.code_ = code;
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(status.cause_, sizeof(status.cause_), format, arguments);
    va_end(arguments);
    return status;
  }

  constexpr bool is_ok() const noexcept { return code_ == StatusCode::ok; }
  constexpr explicit operator bool() const noexcept { return is_ok(); }
  constexpr StatusCode code() const noexcept { return code_; }
  constexpr const char* cause() const noexcept { return cause_; }

 private:
  StatusCode code_ = StatusCode::ok;
  char cause_[cause_capacity] = {};
};

/// A value, or the status that says why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status status) : status_(status) {}

  explicit operator bool() const noexcept { return value_.has_value(); }
  T& operator*() noexcept { return *value_; }
  const T& operator*() const noexcept { return *value_; }
  T* operator->() noexcept { return &*value_; }
  const T* operator->() const noexcept { return &*value_; }
  const Status& status() const noexcept { return status_; }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace flexrf
