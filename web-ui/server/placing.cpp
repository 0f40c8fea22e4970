// Of Server: which client gets a place, which waits for one, and who has to make room.
#include <algorithm>
#include <tuple>

#include "runtime/log/log.hpp"
#include "web-ui/server/server.hpp"

namespace flexrf::panel {
namespace {

/// A client waits so long for a place: requests that are under way are done by then.
constexpr Duration patience = std::chrono::seconds{3};
/// A client waits so long where others get places meanwhile; a browser waits longer.
constexpr Duration longest_patience = std::chrono::seconds{30};
/// Clients in the queue: two for each address of a network of 256, all of which one host may have.
constexpr std::size_t most_waiting = 512;

}  // namespace

bool Server::is_local(const Address& address) const noexcept {
  if (std::find(settings_.local.begin(), settings_.local.end(), address) != settings_.local.end())
    return true;
  return settings_.loopback_is_local && address.is_loopback();
}

/// What keeps this client from a place, even where one is free.
Server::Bound Server::bound_of(const Address& address) const noexcept {
  if (is_local(address)) return Bound::none;
  const Address party = address.neighbourhood();
  std::uint32_t remote = 0;
  std::uint32_t same = 0;
  for (const Connection& connection : connections_) {
    if (connection.is_free() || is_local(connection.remote_end())) continue;
    ++remote;
    if (connection.remote_end().neighbourhood() == party) ++same;
  }
  const std::uint32_t reserved = settings_.places / 4;
  const std::uint32_t most_remote = settings_.places - reserved;
  if (same >= std::max<std::uint32_t>(1, most_remote * 3 / 4)) return Bound::of_address;
  return remote >= most_remote ? Bound::of_remote : Bound::none;
}

bool Server::may_have_place_of(const Address& address, Bound bound, const Connection& other) const noexcept {
  switch (bound) {
    case Bound::of_address:
      return other.remote_end().neighbourhood() == address.neighbourhood();
    case Bound::of_remote:
      return !is_local(other.remote_end());
    case Bound::none:
      break;
  }
  return true;
}

/// Whoever has said nothing for longest: between two requests, or not yet done with the first. Of those, one
/// whose address has the most places.
Connection* Server::dispensable(const Address& address, Bound bound) noexcept {
  Connection* chosen = nullptr;
  std::size_t chosen_count = 0;
  for (Connection& connection : connections_) {
    if (!connection.is_dispensable(surroundings_.now) || !may_have_place_of(address, bound, connection))
      continue;
    const Address party = connection.remote_end().neighbourhood();
    const auto count = static_cast<std::size_t>(
        std::count_if(connections_.begin(), connections_.end(), [&](const Connection& other) {
          return !other.is_free() && other.remote_end().neighbourhood() == party;
        }));
    const auto rank = [](std::size_t places, const Connection& one) {
      return std::tuple{places, one.is_used(), nanoseconds(Time{}) - nanoseconds(one.silent_since())};
    };
    const bool better = chosen == nullptr || rank(count, connection) > rank(chosen_count, *chosen);
    if (better) chosen = &connection, chosen_count = count;
  }
  return chosen;
}

bool Server::place(Newcomer& newcomer) {
  const Bound bound = bound_of(newcomer.address);
  if (bound == Bound::none) {
    const auto free = std::find_if(connections_.begin(), connections_.end(),
                                   [](const Connection& connection) { return connection.is_free(); });
    if (free != connections_.end()) {
      free->open(std::move(newcomer.socket));
      return true;
    }
  }
  // One that is on its way out already makes room for one.
  const auto leaving = static_cast<std::size_t>(
      std::count_if(connections_.begin(), connections_.end(),
                    [](const Connection& connection) { return connection.is_leaving(); }));
  if (leaving >= newcomers_.size() && leaving > 0) return false;
  Connection* const other = dispensable(newcomer.address, bound);
  if (other == nullptr) return false;
  other->shut();
  if (!other->is_free()) return false;
  other->open(std::move(newcomer.socket));
  return true;
}

void Server::welcome(Socket socket) {
  error_code error;
  const tcp::endpoint remote = socket.remote_endpoint(error);
  if (error) return;
  Newcomer newcomer{std::move(socket), remote_address_of(remote), surroundings_.now};
  if (newcomers_.empty() && place(newcomer)) return;
  if (newcomers_.size() == most_waiting) {
    // Of the address that has most of those who wait, so that one that floods sends itself away.
    const auto crowd = [this](const Newcomer& one) {
      return std::count_if(newcomers_.begin(), newcomers_.end(), [&](const Newcomer& other) {
        return other.address.neighbourhood() == one.address.neighbourhood();
      });
    };
    const auto last =
        std::max_element(newcomers_.begin(), newcomers_.end(),
                         [&](const Newcomer& a, const Newcomer& b) { return crowd(a) < crowd(b); });
    turn_away(last->socket, Bound::none);
    newcomers_.erase(last);
  }
  newcomers_.push_back(std::move(newcomer));
}

/// Gives places in the order in which clients came, so that a crowd delays others, and does not keep them
/// out.
void Server::place_newcomers() {
  bool none_is_left = false;
  bool none_for_remote = false;
  for (auto newcomer = newcomers_.begin(); newcomer != newcomers_.end();) {
    const bool is_hopeless = none_is_left || (none_for_remote && !is_local(newcomer->address));
    if (!is_hopeless && place(*newcomer)) {
      placed_at_ = surroundings_.now;
      newcomer = newcomers_.erase(newcomer);
      continue;
    }
    const Bound bound = bound_of(newcomer->address);
    none_is_left = none_is_left || bound == Bound::none;
    none_for_remote = none_for_remote || bound == Bound::of_remote;
    newcomer = turn_away_in_time(*newcomer, bound) ? newcomers_.erase(newcomer) : newcomer + 1;
  }
}

/// When the client has waited long enough. False: it stays in the queue.
bool Server::turn_away_in_time(Newcomer& newcomer, Bound bound) {
  const bool others_get_places = bound != Bound::of_address && surroundings_.now - placed_at_ < patience;
  const Duration enough = others_get_places ? longest_patience : patience;
  const Duration waited = surroundings_.now - newcomer.since;
  // Without an answer only if all porters stay busy.
  return waited >= enough && (turn_away(newcomer.socket, bound) || waited >= enough + patience);
}

/// Who is turned away is heard, and told: he may not begin to speak before (TLS), and closing with something
/// unread would take the answer away again. False: all who tell it are busy with others.
bool Server::turn_away(Socket& socket, Bound bound) {
  const auto older = [](const Connection& a, const Connection& b) {
    return a.is_free() != b.is_free() ? a.is_free() : a.silent_since() < b.silent_since();
  };
  Connection& porter = *std::min_element(porters_.begin(), porters_.end(), older);
  porter.shut();
  if (!porter.is_free()) return false;
  ++refused_;
  log_warning(full_, "panel", "a browser or script found no place: {} of {} are in use",
              surroundings_.connections, settings_.places);
  porter.turn_away(
      std::move(socket),
      bound == Bound::of_address
          ? "this address has all the connections to the panel that one address may have; close a page "
            "there"
          : "all of the panel's connections are in use; close a page that is not needed");
  return true;
}

}  // namespace flexrf::panel
