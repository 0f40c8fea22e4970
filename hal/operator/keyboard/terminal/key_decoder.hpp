#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "types/key_event.hpp"

namespace flexrf {

/// Turns the bytes that a terminal sends into key presses: characters are themselves, the escape sequences of
/// ECMA-48 and of application mode (ESC [ A, ESC O A, ESC [ 3 ~) are their keys, unknown sequences are
/// nothing.
class KeyDecoder {
 public:
  /// Take every event before the next byte.
  void put(std::uint8_t byte) noexcept;
  std::optional<KeyEvent> take() noexcept;
  bool has_event() const noexcept { return count_ > 0; }

  /// An escape has come and may be the key of that name or begin a sequence: only time tells.
  bool is_undecided() const noexcept { return state_ != State::ground; }
  /// No more came: it was the escape key. A sequence that was cut is nothing.
  void decide() noexcept;

 private:
  enum class State : std::uint8_t { ground, escape, sequence, application };

  void emit(Key key, std::uint32_t character = 0) noexcept;
  void put_ground(std::uint8_t byte) noexcept;
  void end_sequence(std::uint8_t final_byte) noexcept;

  State state_ = State::ground;
  std::uint32_t parameter_ = 0;  // the sequence's first
  bool first_parameter_ = true;
  std::array<KeyEvent, 2> events_{};
  std::size_t count_ = 0;
};

}  // namespace flexrf
