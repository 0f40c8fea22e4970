// Who may come in: the token, and from where the door is reached.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "base/status.hpp"

namespace flexrf::remote {

/// A secret that is compared in a time that says nothing of where a guess went wrong.
class Token {
 public:
  static constexpr std::size_t shortest = 32;
  static constexpr std::size_t longest = 128;

  Token() noexcept = default;
  Token(const Token&) = delete;
  Token& operator=(const Token&) = delete;
  ~Token() { forget(); }

  /// The file is a regular one, of whoever runs the application, for nobody else to read or write, and holds
  /// the token in its only line. Blocks; a thread that is not real-time.
  Status load(const char* file);
  void forget() noexcept;
  bool is_there() const noexcept { return size_ > 0; }
  bool is(std::string_view guess) const noexcept;

 private:
  std::array<char, longest> text_{};  // zeros behind it
  std::size_t size_ = 0;
};

/// Whether only this machine reaches what listens there: 127.x.x.x, [::1], unix:. Names are not looked up.
bool is_within_the_machine(std::string_view address) noexcept;

}  // namespace flexrf::remote
