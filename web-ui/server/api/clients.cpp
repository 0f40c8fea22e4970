#include "web-ui/server/api/clients.hpp"

#include <cstring>

namespace flexrf::panel {

std::string Outbox::begin_message() {
  if (is_empty()) clear();
  begun_ = bytes_.size();
  bytes_.append(sizeof(std::uint32_t), '\0');
  return std::move(bytes_);
}

void Outbox::end_message(std::string memory) {
  bytes_ = std::move(memory);
  const auto size = static_cast<std::uint32_t>(bytes_.size() - begun_ - sizeof(std::uint32_t));
  std::memcpy(bytes_.data() + begun_, &size, sizeof(size));
}

void Outbox::take(std::string& to) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes_.data() + taken_, sizeof(size));
  taken_ += sizeof(size);
  to.append(bytes_, taken_, size);
  taken_ += size;
  if (is_empty()) clear();
}

Client& Clients::open(LiveLink& link, Time now) {
  Client& client = clients_[link.place()];
  // Its memory stays from one connection to the next.
  client.outbox.prepare();
  client.outbox.clear();
  client.slots.clear();
  client.topics = {};
  client.link = &link;
  client.opening = ++openings_;
  client.session = link.session();
  client.closing = client.greeted = client.told_of_end = client.told_of_lapse = client.pumping = false;
  client.last_frame = now;
  client.frames = 0;
  client.left_out = 0;
  client.state_seen = 0;
  return client;
}

void Clients::close(Client& client) noexcept {
  client.link = nullptr;
  client.slots.clear();
  client.topics = {};
  client.outbox.clear();
}

Client* Clients::find(const Caller& caller) noexcept {
  if (caller.kind != Caller::Kind::live) return nullptr;
  Client& client = clients_[caller.place];
  return client.is_open() && client.opening == caller.opening ? &client : nullptr;
}

}  // namespace flexrf::panel
