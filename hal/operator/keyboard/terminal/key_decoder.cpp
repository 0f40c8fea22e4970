#include "hal/operator/keyboard/terminal/key_decoder.hpp"

namespace flexrf {
namespace {

constexpr std::uint8_t escape = 0x1B;

Key key_of_letter(std::uint8_t letter) {
  switch (letter) {
    case 'A':
      return Key::up;
    case 'B':
      return Key::down;
    case 'C':
      return Key::right;
    case 'D':
      return Key::left;
    case 'H':
      return Key::home;
    case 'F':
      return Key::end;
    default:
      return Key::none;
  }
}

Key key_of_number(std::uint32_t number) {
  switch (number) {
    case 1:
    case 7:
      return Key::home;
    case 2:
      return Key::insert;
    case 3:
      return Key::delete_key;
    case 4:
    case 8:
      return Key::end;
    case 5:
      return Key::page_up;
    case 6:
      return Key::page_down;
    default:
      return Key::none;
  }
}

}  // namespace

void KeyDecoder::put(std::uint8_t byte) noexcept {
  switch (state_) {
    case State::ground:
      put_ground(byte);
      break;
    case State::escape:
      if (byte == '[' || byte == 'O') {
        state_ = byte == '[' ? State::sequence : State::application;
        parameter_ = 0;
        first_parameter_ = true;
      } else {
        decide();
        put_ground(byte);
      }
      break;
    case State::application:
      state_ = State::ground;
      emit(key_of_letter(byte));
      break;
    case State::sequence:
      if (byte >= '0' && byte <= '9') {
        if (first_parameter_ && parameter_ < 1000) parameter_ = parameter_ * 10 + (byte - std::uint32_t{'0'});
      } else if (byte >= 0x40 && byte <= 0x7E) {
        end_sequence(byte);
      } else if (byte < 0x20 || byte > 0x3F) {  // no sequence after all
        state_ = State::ground;
        put_ground(byte);
      } else {
        first_parameter_ = false;
      }
      break;
  }
}

std::optional<KeyEvent> KeyDecoder::take() noexcept {
  if (count_ == 0) return std::nullopt;
  const KeyEvent event = events_[0];
  events_[0] = events_[1];
  --count_;
  return event;
}

void KeyDecoder::decide() noexcept {
  if (state_ == State::escape) emit(Key::escape);
  state_ = State::ground;
}

void KeyDecoder::emit(Key key, std::uint32_t character) noexcept {
  if (key != Key::none && count_ < events_.size()) events_[count_++] = {key, character};
}

void KeyDecoder::put_ground(std::uint8_t byte) noexcept {
  switch (byte) {
    case escape:
      state_ = State::escape;
      break;
    case '\r':
    case '\n':
      emit(Key::enter);
      break;
    case '\t':
      emit(Key::tab);
      break;
    case 0x08:
    case 0x7F:
      emit(Key::backspace);
      break;
    default:
      if (byte >= 0x20) emit(Key::character, byte);
  }
}

void KeyDecoder::end_sequence(std::uint8_t final_byte) noexcept {
  state_ = State::ground;
  emit(final_byte == '~' ? key_of_number(parameter_) : key_of_letter(final_byte));
}

}  // namespace flexrf
