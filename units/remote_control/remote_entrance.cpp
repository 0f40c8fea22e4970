#include "units/remote_control/remote_entrance.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace flexrf::remote {
namespace {

constexpr const char* how = "write one with: (umask 077; openssl rand -hex 16 > FILE)";

Status refused(const char* file, const char* why) noexcept {
  return Status::error(StatusCode::not_permitted, "token_file %s %s; %s", file, why, how);
}

}  // namespace

void Token::forget() noexcept {
  sodium_memzero(text_.data(), text_.size());
  size_ = 0;
}

Status Token::load(const char* file) {
  forget();
  const int descriptor = ::open(file, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) {
    return Status::error(StatusCode::not_found, "token_file %s: %s; %s", file, std::strerror(errno), how);
  }
  std::array<char, longest + 2> bytes{};
  struct stat state {};
  const bool known = ::fstat(descriptor, &state) == 0;
  const ssize_t count = known && S_ISREG(state.st_mode) ? ::read(descriptor, bytes.data(), bytes.size()) : -1;
  ::close(descriptor);
  if (!known || count < 0) return refused(file, "cannot be read as a file");
  if (state.st_uid != ::geteuid()) return refused(file, "belongs to somebody else");
  if ((state.st_mode & 077U) != 0) return refused(file, "is open to others: its mode is to be 0600 at most");
  std::string_view text(bytes.data(), static_cast<std::size_t>(count));
  if (text.ends_with('\n')) text.remove_suffix(1);
  const bool whole = text.size() >= shortest && text.size() <= longest &&
                     std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < '\x7F'; });
  if (whole) {
    std::copy(text.begin(), text.end(), text_.begin());
    size_ = text.size();
  }
  sodium_memzero(bytes.data(), bytes.size());
  return whole ? Status{} : refused(file, "holds no token: one line of 32 to 128 characters without blanks");
}

bool Token::is(std::string_view guess) const noexcept {
  std::array<char, longest> padded{};
  const std::size_t size = std::min(guess.size(), longest);
  std::copy_n(guess.data(), size, padded.begin());
  const bool same = sodium_memcmp(padded.data(), text_.data(), longest) == 0;
  return same && is_there() && guess.size() == size_;
}

bool is_within_the_machine(std::string_view address) noexcept {
  if (address.starts_with("unix:") || address.starts_with("tcp:[::1]:")) return true;
  const std::size_t port = address.find(':', 4);
  if (!address.starts_with("tcp:127.") || port == std::string_view::npos) return false;
  // Four numbers, and not a name that begins like them.
  std::string_view rest = address.substr(4, port - 4);
  for (int place = 0; place < 4; ++place) {
    unsigned number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc{} || number > 255) return false;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (place == 3) return rest.empty();
    if (!rest.starts_with('.')) return false;
    rest.remove_prefix(1);
  }
  return false;
}

}  // namespace flexrf::remote
