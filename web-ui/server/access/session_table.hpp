// Who has a session, until when, and by which cookie it is known.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

struct SessionLimits {
  std::size_t places = 64;                    ///< at most no_session
  Duration idle = std::chrono::hours{1};      ///< without an act, or without a page and a request
  Duration absolute = std::chrono::hours{8};  ///< of one that logged in, however busy it is
  /// For how long a session whose time is over is kept without a live connection. A page that loses its link
  /// for a moment connects again within it, and can still stop motion.
  Duration return_time = std::chrono::seconds{30};
};

/// All memory is taken by the constructor. The server's thread.
class SessionTable {
 public:
  /// Bytes of randomness in a cookie; its text is twice as long, in hexadecimal digits.
  static constexpr std::size_t cookie_bytes = 16;
  static constexpr std::size_t cookie_digits = 2 * cookie_bytes;

  /// `local`: what the application's table calls local; `loopback_is_local`: and this machine itself.
  SessionTable(const SessionLimits& limits, std::vector<Address> local, bool loopback_is_local = true);

  /// The session of a cookie's value. The time it takes tells nothing of other sessions' cookies: they are
  /// looked up by a hash with a secret key, and compared in constant time.
  SessionIndex find(std::string_view cookie) const noexcept;
  /// A new session under a fresh cookie; no_session when no place is free.
  SessionIndex begin(std::string_view user, Role role, std::string_view address, Time now);
  void end(SessionIndex session) noexcept;
  /// Somebody uses it from this address.
  void touch(SessionIndex session, std::string_view address, Time now) noexcept;
  /// Its live connections: while there is one, it is not idle.
  void link_opened(SessionIndex session) noexcept;
  void link_closed(SessionIndex session, Time now) noexcept;

  /// Null: there is no such session.
  const SessionInfo* info(SessionIndex session) const noexcept;
  /// The cookie's text, valid until the session ends.
  std::string_view cookie(SessionIndex session) const noexcept;
  /// Differs for every session that ever was: tells one from another that got its place.
  std::uint32_t serial(SessionIndex session) const noexcept;
  /// Somebody can see what it is asked: it has a live connection, or never had one and is a script.
  bool is_there(SessionIndex session) const noexcept;
  /// A live connection is open, or it was used within the last `span`.
  bool is_present(SessionIndex session, Duration span, Time now) const noexcept;
  /// One of who logged in by this name; no_session: there is none.
  SessionIndex of_user(std::string_view user) const noexcept;
  void acted(SessionIndex session, Time now) noexcept;
  /// One whose time is over, and that has no page, nor had one within the time to return; no_session: none.
  SessionIndex expired(Time now) const noexcept;
  /// One that logged in, whose time is over while its page is open; no_session: none.
  SessionIndex lapsing(Time now) const noexcept;
  /// From now on it is a viewer's, and ends when it has been without a live connection for the time to
  /// return.
  void lapse(SessionIndex session) noexcept;
  /// Who makes room for a new one: of those without a live connection and other than `kept`, the viewer that
  /// was used longest ago, or else whoever was. no_session: nobody can.
  SessionIndex dispensable(SessionIndex kept) const noexcept;

  bool is_local(std::string_view address) const noexcept;
  std::size_t count() const noexcept { return count_; }
  bool is_full() const noexcept { return count_ == entries_.size(); }
  const SessionLimits& limits() const noexcept { return limits_; }

 private:
  struct Entry {
    SessionInfo info;
    std::uint32_t serial = 0;  // 0: free
    std::uint32_t links = 0;
    bool had_links = false;
    Time begun{};
    Time used{};
    Time acted{};
    std::array<unsigned char, cookie_bytes> secret{};
    std::array<char, cookie_digits + 1> cookie{};
    std::array<char, 20> name{};
    std::array<char, 32> user{};
    std::array<char, 48> address{};
  };
  using Tag = std::array<unsigned char, 8>;

  Tag tag_of(const unsigned char* secret) const noexcept;
  const Entry* entry(SessionIndex session) const noexcept;
  Entry* entry(SessionIndex session) noexcept;
  void set_address(Entry& entry, std::string_view address) const noexcept;

  SessionLimits limits_;
  std::vector<Address> local_;
  bool loopback_is_local_;
  std::vector<Entry> entries_;
  std::vector<Tag> tags_;  // of entries_; beside them, because every request looks through all
  std::array<unsigned char, 16> key_{};
  std::size_t count_ = 0;
  std::uint32_t last_serial_ = 0;
};

}  // namespace flexrf::panel
