#include "web-ui/server/access/session_table.hpp"

#include <sodium.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/text.hpp"

namespace flexrf::panel {

static_assert(crypto_shorthash_KEYBYTES == 16 && crypto_shorthash_BYTES == 8);

SessionTable::SessionTable(const SessionLimits& limits, std::vector<Address> local, bool loopback_is_local)
    : limits_(limits),
      local_(std::move(local)),
      loopback_is_local_(loopback_is_local),
      entries_(limits.places),
      tags_(limits.places) {
  randombytes_buf(key_.data(), key_.size());
}

SessionTable::Tag SessionTable::tag_of(const unsigned char* secret) const noexcept {
  Tag tag;
  crypto_shorthash(tag.data(), secret, cookie_bytes, key_.data());
  return tag;
}

const SessionTable::Entry* SessionTable::entry(SessionIndex session) const noexcept {
  return session < entries_.size() && entries_[session].serial != 0 ? &entries_[session] : nullptr;
}

SessionTable::Entry* SessionTable::entry(SessionIndex session) noexcept {
  return const_cast<Entry*>(std::as_const(*this).entry(session));
}

SessionIndex SessionTable::find(std::string_view cookie) const noexcept {
  std::array<unsigned char, cookie_bytes> secret;
  std::size_t size = 0;
  if (cookie.size() != cookie_digits ||
      sodium_hex2bin(secret.data(), secret.size(), cookie.data(), cookie.size(), nullptr, &size, nullptr) !=
          0 ||
      size != secret.size())
    return no_session;
  const Tag tag = tag_of(secret.data());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (tags_[i] == tag && entries_[i].serial != 0 &&
        sodium_memcmp(entries_[i].secret.data(), secret.data(), secret.size()) == 0)
      return static_cast<SessionIndex>(i);
  }
  return no_session;
}

SessionIndex SessionTable::begin(std::string_view user, Role role, std::string_view address, Time now) {
  const auto free =
      std::find_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.serial == 0; });
  if (free == entries_.end()) return no_session;
  free->serial = ++last_serial_;
  free->links = 0;
  free->had_links = false;
  free->begun = free->used = free->acted = now;
  randombytes_buf(free->secret.data(), free->secret.size());
  sodium_bin2hex(free->cookie.data(), free->cookie.size(), free->secret.data(), free->secret.size());
  std::snprintf(free->name.data(), free->name.size(), "panel-%u", free->serial);
  set_text(free->user, user);
  free->info = {free->name.data(), text_view(free->user), {}, role, false, false};
  set_address(*free, address);
  const std::size_t index = static_cast<std::size_t>(free - entries_.begin());
  tags_[index] = tag_of(free->secret.data());
  ++count_;
  return static_cast<SessionIndex>(index);
}

void SessionTable::end(SessionIndex session) noexcept {
  Entry* const ended = entry(session);
  if (ended == nullptr) return;
  ended->serial = 0;
  sodium_memzero(ended->secret.data(), ended->secret.size());
  sodium_memzero(ended->cookie.data(), ended->cookie.size());
  tags_[session] = {};
  --count_;
}

void SessionTable::set_address(Entry& entry, std::string_view address) const noexcept {
  set_text(entry.address, address);
  entry.info.address = text_view(entry.address);
  entry.info.local = is_local(address);
}

bool SessionTable::is_local(std::string_view address) const noexcept {
  const std::optional<Address> parsed = Address::parse(address);
  if (!parsed) return false;
  if (std::find(local_.begin(), local_.end(), *parsed) != local_.end()) return true;
  return loopback_is_local_ && parsed->is_loopback();
}

void SessionTable::touch(SessionIndex session, std::string_view address, Time now) noexcept {
  Entry* const used = entry(session);
  if (used == nullptr) return;
  used->used = now;
  if (used->info.address != address) set_address(*used, address);
}

void SessionTable::link_opened(SessionIndex session) noexcept {
  Entry* const linked = entry(session);
  if (linked == nullptr) return;
  ++linked->links;
  linked->had_links = true;
}

void SessionTable::link_closed(SessionIndex session, Time now) noexcept {
  Entry* const linked = entry(session);
  if (linked == nullptr || linked->links == 0) return;
  --linked->links;
  linked->used = now;
}

const SessionInfo* SessionTable::info(SessionIndex session) const noexcept {
  const Entry* const known = entry(session);
  return known == nullptr ? nullptr : &known->info;
}

std::string_view SessionTable::cookie(SessionIndex session) const noexcept {
  const Entry* const known = entry(session);
  return known == nullptr ? std::string_view{} : std::string_view{known->cookie.data(), cookie_digits};
}

std::uint32_t SessionTable::serial(SessionIndex session) const noexcept {
  const Entry* const known = entry(session);
  return known == nullptr ? 0 : known->serial;
}

bool SessionTable::is_there(SessionIndex session) const noexcept {
  const Entry* const known = entry(session);
  return known != nullptr && (known->links > 0 || !known->had_links);
}

bool SessionTable::is_present(SessionIndex session, Duration span, Time now) const noexcept {
  const Entry* const known = entry(session);
  return known != nullptr && (known->links > 0 || now - known->used <= span);
}

SessionIndex SessionTable::of_user(std::string_view user) const noexcept {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].serial != 0 && entries_[i].info.user == user) return static_cast<SessionIndex>(i);
  }
  return no_session;
}

SessionIndex SessionTable::expired(Time now) const noexcept {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& known = entries_[i];
    if (known.serial == 0 || known.links > 0) continue;
    if (known.had_links && now - known.used <= limits_.return_time) continue;
    // The cookie of who did not log in is all that he has.
    const bool logged_in = !known.info.user.empty();
    if (known.info.lapsed || now - known.used > limits_.idle ||
        (logged_in && now - known.begun > limits_.absolute))
      return static_cast<SessionIndex>(i);
  }
  return no_session;
}

SessionIndex SessionTable::lapsing(Time now) const noexcept {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& known = entries_[i];
    if (known.serial == 0 || known.links == 0 || known.info.user.empty() || known.info.lapsed) continue;
    if (now - known.acted > limits_.idle || now - known.begun > limits_.absolute)
      return static_cast<SessionIndex>(i);
  }
  return no_session;
}

void SessionTable::lapse(SessionIndex session) noexcept {
  Entry* const known = entry(session);
  if (known == nullptr) return;
  known->info.lapsed = true;
  known->info.role = Role::viewer;
}

void SessionTable::acted(SessionIndex session, Time now) noexcept {
  if (Entry* const known = entry(session)) known->acted = now;
}

SessionIndex SessionTable::dispensable(SessionIndex kept) const noexcept {
  SessionIndex chosen = no_session;
  const auto rank = [this](SessionIndex index) {
    return std::pair{entries_[index].info.role != Role::viewer, entries_[index].used};
  };
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto index = static_cast<SessionIndex>(i);
    if (entries_[i].serial == 0 || entries_[i].links > 0 || index == kept) continue;
    if (chosen == no_session || rank(index) < rank(chosen)) chosen = index;
  }
  return chosen;
}

}  // namespace flexrf::panel
