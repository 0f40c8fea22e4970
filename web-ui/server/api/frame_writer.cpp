#include "web-ui/server/api/frame_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace flexrf::panel {
namespace {

static_assert(std::endian::native == std::endian::little, "values are sent as they lie in memory");

struct MessageHeader {
  std::uint64_t descriptor;
  std::int64_t server_time;
  std::uint32_t items;
  std::uint32_t left_out;
  std::uint64_t number;
};
static_assert(sizeof(MessageHeader) == 32);

struct ItemHead {
  std::uint32_t slot;
  std::uint32_t size;
  std::uint64_t sequence;
  std::int64_t sampled_at;
  std::uint8_t reason;
  std::uint8_t kind;
  std::uint16_t zero;
  std::uint32_t missed;
};
static_assert(sizeof(ItemHead) == 32);

enum : std::uint8_t { kind_value = 0, kind_jpeg = 1 };

std::uint32_t missed(const SlotSubscription& subscription, std::uint64_t sequence) noexcept {
  if (subscription.seen == 0 || sequence == subscription.seen) return 0;
  const std::uint64_t between = sequences_between(subscription.seen, sequence);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(between, std::numeric_limits<std::uint32_t>::max()));
}

ItemHead head_of(const SlotSubscription& subscription, const ItemHeader& header, NullReason reason,
                 std::size_t size, std::uint8_t kind) noexcept {
  return {subscription.slot,
          static_cast<std::uint32_t>(size),
          header.sequence,
          nanoseconds(header.sampled_at),
          static_cast<std::uint8_t>(reason),
          kind,
          0,
          missed(subscription, header.sequence)};
}

template <class Head>
void append(std::string& to, const Head& head) {
  to.append(reinterpret_cast<const char*>(&head), sizeof(head));
}

void pad(std::string& to) {
  to.append((8 - to.size() % 8) % 8, '\0');
}

bool is_known(const SlotSubscription& subscription, std::uint64_t sequence, NullReason reason) noexcept {
  return subscription.seen_any && subscription.seen == sequence && subscription.seen_reason == reason;
}

void see(SlotSubscription& subscription, std::uint64_t sequence, NullReason reason) noexcept {
  subscription.seen_any = true;
  subscription.seen = sequence;
  subscription.seen_reason = reason;
}

}  // namespace

Time FrameWriter::next(const Client& client) noexcept {
  Time next = client.last_frame + heartbeat;
  for (const SlotSubscription& subscription : client.slots) next = std::min(next, subscription.next);
  return next;
}

bool FrameWriter::write(Client& client, Time now, std::string& to) {
  const std::size_t begin = to.size();
  append(to, MessageHeader{});
  std::uint32_t items = 0;
  std::int64_t left_out = 0;
  for (SlotSubscription& subscription : client.slots) {
    if (now < subscription.next) continue;
    // All clients look at the same instants, so that one waking serves them all.
    const std::int64_t late = (now - subscription.next).count() / subscription.interval.count();
    left_out = std::max(left_out, subscription.seen_any ? late : 0);
    const std::int64_t turns = now.time_since_epoch().count() / subscription.interval.count() + 1;
    subscription.next = Time{turns * subscription.interval};
    const bool is_picture = images_->is_image(subscription.slot);
    if (is_picture ? write_picture(subscription, to) : write_item(subscription, to)) ++items;
  }
  if (items == 0 && now < client.last_frame + heartbeat) {
    to.resize(begin);
    return false;
  }
  client.left_out += static_cast<std::uint32_t>(left_out);
  client.last_frame = now;
  const MessageHeader header{descriptor_, nanoseconds(now), items, client.left_out, ++client.frames};
  std::memcpy(to.data() + begin, &header, sizeof(header));
  return true;
}

bool FrameWriter::write_item(SlotSubscription& subscription, std::string& to) {
  const ObservedSlot& newest = slots_->read(subscription.slot);
  if (is_known(subscription, newest.header.sequence, newest.reason)) return false;
  const std::size_t size = newest.value == nullptr ? 0 : slots_->size(subscription.slot);
  append(to, head_of(subscription, newest.header, newest.reason, size, kind_value));
  if (size != 0) to.append(static_cast<const char*>(newest.value), size);
  pad(to);
  see(subscription, newest.header.sequence, newest.reason);
  return true;
}

bool FrameWriter::write_picture(SlotSubscription& subscription, std::string& to) {
  ImageWorker::Newest newest = images_->newest(subscription.slot);
  if (newest.version == 0 || is_known(subscription, newest.header.sequence, newest.reason)) return false;
  const std::size_t begin = to.size();
  append(to, ItemHead{});
  const char* cause = "";
  images_->copy(subscription.slot, to, newest, cause);
  const std::size_t size = to.size() - begin - sizeof(ItemHead);
  const ItemHead head = head_of(subscription, newest.header, newest.reason, size, kind_jpeg);
  std::memcpy(to.data() + begin, &head, sizeof(head));
  pad(to);
  see(subscription, newest.header.sequence, newest.reason);
  return true;
}

}  // namespace flexrf::panel
