#include "hal/can/interface/can_bus.hpp"

#include <algorithm>
#include <bit>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr std::size_t standard_identifiers = 0x800;

/// What a person can do about a bus that is not usable.
const char* hint_for(CanBusState state) noexcept {
  switch (state) {
    case CanBusState::gone:
      return "is its adapter plugged in? `ip link` lists the interfaces";
    case CanBusState::down:
      return "`ip link` shows why its interface is not up";
    default:
      return "look at cable, termination and bit rate";
  }
}

}  // namespace

Status CanBus::open(CanInbox& inbox, std::span<const CanIdentifier> identifiers, std::uint32_t capacity) {
  if (identifiers.empty())
    return Status::error(StatusCode::invalid_argument, "a device on %s asked for no identifier", name());
  for (const CanIdentifier& identifier : identifiers) {
    if (!identifier.is_valid()) {
      return Status::error(StatusCode::invalid_argument,
                           "a device on %s asked for identifier 0x%X, which has more than %s bits", name(),
                           identifier.value, identifier.extended ? "29" : "11");
    }
  }
  registry_.take();
  forget(inbox);
  inbox.reset(std::bit_ceil(std::max(capacity, 1U)));
  for (const CanIdentifier& identifier : identifiers) wishes_.push_back({identifier, &inbox, nobody});
  index_wishes();
  registry_.give_back();
  listen_to(wanted());
  return {};
}

Status CanBus::claim_node(std::uint8_t node, const char* owner) {
  const char*& holder = nodes_[node % nodes_.size()];
  if (holder != nullptr && holder != owner) {
    return Status::error(
        StatusCode::invalid_argument,
        "node %u on the bus %s is that of `%s` already: give each device its own number, as it is set on "
        "the device",
        unsigned{node}, name(), holder);
  }
  release_node(owner);
  holder = owner;
  return {};
}

void CanBus::release_node(const char* owner) noexcept {
  for (const char*& holder : nodes_)
    if (holder == owner) holder = nullptr;
}

void CanBus::close(CanInbox& inbox) {
  registry_.take();
  forget(inbox);
  index_wishes();
  registry_.give_back();
  listen_to(wanted());
}

void CanBus::restart() noexcept {
  feedback = {};
  waiting_.clear();
  was_usable_ = false;
}

std::vector<CanIdentifier> CanBus::wanted() const {
  std::vector<CanIdentifier> identifiers;
  for (std::size_t i = 1; i < wishes_.size(); ++i) {
    const CanIdentifier& identifier = wishes_[i].identifier;
    if (std::find(identifiers.begin(), identifiers.end(), identifier) == identifiers.end())
      identifiers.push_back(identifier);
  }
  return identifiers;
}

void CanBus::forget(const CanInbox& inbox) {
  std::erase_if(wishes_, [&](const Wish& wish) { return wish.inbox == &inbox; });
}

void CanBus::index_wishes() {
  if (wishes_.empty() || wishes_.front().inbox != nullptr) wishes_.insert(wishes_.begin(), Wish{});
  standard_.assign(standard_identifiers, nobody);
  extended_.clear();
  // From the last, so that each list is in the order of opening.
  for (std::size_t i = wishes_.size(); i-- > 1;) {
    Wish& wish = wishes_[i];
    std::uint16_t* first = nullptr;
    if (!wish.identifier.extended) {
      first = &standard_[wish.identifier.value];
    } else {
      const auto place = std::lower_bound(
          extended_.begin(), extended_.end(), wish.identifier.value,
          [&](std::uint16_t entry, std::uint32_t value) { return wishes_[entry].identifier.value < value; });
      const bool known = place != extended_.end() && wishes_[*place].identifier == wish.identifier;
      first = known ? &*place : &*extended_.insert(place, nobody);
    }
    wish.next = *first;
    *first = static_cast<std::uint16_t>(i);
  }
}

void CanBus::deliver(const CanFrame& frame) noexcept {
  if (!frame.extended) {
    if (!standard_.empty()) deliver_to(standard_[frame.identifier], frame);
    return;
  }
  const auto place = std::lower_bound(
      extended_.begin(), extended_.end(), frame.identifier,
      [&](std::uint16_t entry, std::uint32_t value) { return wishes_[entry].identifier.value < value; });
  if (place != extended_.end() && wishes_[*place].identifier.value == frame.identifier)
    deliver_to(*place, frame);
}

void CanBus::deliver_to(std::uint16_t wish, const CanFrame& frame) noexcept {
  if (wish == nobody) return;
  ++feedback.frames_received;
  for (; wish != nobody; wish = wishes_[wish].next) {
    if (!wishes_[wish].inbox->push(frame)) ++feedback.frames_missed;
  }
}

bool CanBus::put(const CanFrame& frame, bool replaces) noexcept {
  const bool taken = is_usable() && frame.is_valid() && waiting_.put(frame, replaces);
  if (!taken) ++feedback.frames_refused;
  return taken;
}

void CanBus::enter(CanBusState state) noexcept {
  if (state == feedback.state) return;
  const CanBusState before = feedback.state;
  feedback.state = state;
  if (state == CanBusState::bus_off) ++feedback.bus_offs;
  if (is_usable() && before < CanBusState::error_passive) {
    // The first time is no recovery.
    if (was_usable_) ++feedback.recoveries;
    was_usable_ = true;
    log_info(name(), "the bus is usable: {}", StaticText{name_of(state)});
    return;
  }
  if (is_usable()) return;
  feedback.frames_discarded += waiting_.size();
  waiting_.clear();
  log_warning(name(), "the bus is not usable: {}; {}", StaticText{name_of(state)},
              StaticText{hint_for(state)});
}

}  // namespace flexrf
