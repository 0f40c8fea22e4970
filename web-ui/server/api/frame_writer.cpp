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
  std::uint16_t scaled_by;  // of a JPEG
  std::uint32_t missed;
};
static_assert(sizeof(ItemHead) == 32);

enum : std::uint8_t { kind_value = 0, kind_jpeg = 1 };

std::uint32_t missed(const Seen& seen, std::uint64_t sequence) noexcept {
  if (seen.sequence == 0 || sequence == seen.sequence) return 0;
  const std::uint64_t between = sequences_between(seen.sequence, sequence);
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(between, std::numeric_limits<std::uint32_t>::max()));
}

ItemHead head_of(const SlotSubscription& subscription, const ItemHeader& header, NullReason reason,
                 std::size_t size, std::uint8_t kind, std::uint16_t scaled_by) noexcept {
  return {subscription.slot,
          static_cast<std::uint32_t>(size),
          header.sequence,
          nanoseconds(header.sampled_at),
          static_cast<std::uint8_t>(reason),
          kind,
          scaled_by,
          missed(subscription.seen, header.sequence)};
}

template <class Head>
void append(std::string& to, const Head& head) {
  to.append(reinterpret_cast<const char*>(&head), sizeof(head));
}

/// What stands before a message keeps to the same multiple.
static_assert(LiveLink::head_room % 8 == 0);

void pad(std::string& to) {
  to.append((8 - to.size() % 8) % 8, '\0');
}

bool is_known(const Seen& seen, std::uint64_t sequence, NullReason reason) noexcept {
  return seen == Seen{sequence, reason, true};
}

}  // namespace

Time FrameWriter::next(const Client& client) noexcept {
  Time next = client.last_frame + heartbeat;
  for (const SlotSubscription& subscription : client.slots) next = std::min(next, subscription.next);
  return next;
}

std::span<char> FrameWriter::write(Client& client, Time now) {
  const std::int64_t left_out = find_due(client, now);
  const bool beats = now >= client.last_frame + heartbeat;
  if (due_.empty() && !beats) return {};
  if (is_for_due()) {
    for (std::size_t i = 0; i < parts_.size(); ++i) due_[i]->seen = parts_[i].after;
  } else {
    put_together();
  }
  if (items_ == 0 && !beats) return {};
  client.left_out += static_cast<std::uint32_t>(left_out);
  client.last_frame = now;
  const MessageHeader header{descriptor_, nanoseconds(now), items_, client.left_out, ++client.frames};
  std::memcpy(message_.data() + LiveLink::head_room, &header, sizeof(header));
  return message_;
}

std::int64_t FrameWriter::find_due(Client& client, Time now) {
  due_.clear();
  std::int64_t left_out = 0;
  for (SlotSubscription& subscription : client.slots) {
    if (now < subscription.next) continue;
    // All clients look at the same instants, so that one waking serves them all.
    const std::int64_t late = (now - subscription.next).count() / subscription.interval.count();
    left_out = std::max(left_out, subscription.seen.any ? late : 0);
    const std::int64_t turns = now.time_since_epoch().count() / subscription.interval.count() + 1;
    subscription.next = Time{turns * subscription.interval};
    due_.push_back(&subscription);
  }
  return left_out;
}

bool FrameWriter::is_for_due() const noexcept {
  return turn_ == slots_->turn() && std::equal(due_.begin(), due_.end(), parts_.begin(), parts_.end(),
                                               [](const SlotSubscription* due, const Part& part) {
                                                 return due->slot == part.slot && due->seen == part.before;
                                               });
}

void FrameWriter::put_together() {
  turn_ = slots_->turn();
  items_ = 0;
  parts_.clear();
  message_.assign(LiveLink::head_room + sizeof(MessageHeader), '\0');
  for (SlotSubscription* const subscription : due_) {
    Part part{subscription->slot, subscription->seen, {}};
    const bool is_picture = images_->is_image(subscription->slot);
    if (is_picture ? write_picture(*subscription) : write_item(*subscription)) ++items_;
    part.after = subscription->seen;
    parts_.push_back(part);
  }
}

bool FrameWriter::write_item(SlotSubscription& subscription) {
  const ObservedSlot& newest = slots_->read(subscription.slot);
  if (is_known(subscription.seen, newest.header.sequence, newest.reason)) return false;
  const std::size_t size = newest.value == nullptr ? 0 : slots_->size(subscription.slot);
  append(message_, head_of(subscription, newest.header, newest.reason, size, kind_value, 0));
  if (size != 0) message_.append(static_cast<const char*>(newest.value), size);
  pad(message_);
  subscription.seen = {newest.header.sequence, newest.reason, true};
  return true;
}

bool FrameWriter::write_picture(SlotSubscription& subscription) {
  ImageWorker::Newest newest = images_->newest(subscription.slot);
  if (newest.version == 0 || is_known(subscription.seen, newest.header.sequence, newest.reason)) return false;
  const std::size_t begin = message_.size();
  append(message_, ItemHead{});
  const char* cause = "";
  images_->copy(subscription.slot, message_, newest, cause);
  const std::size_t size = message_.size() - begin - sizeof(ItemHead);
  const ItemHead head = head_of(subscription, newest.header, newest.reason, size, kind_jpeg,
                                size == 0 ? std::uint16_t{0} : newest.scaled_by);
  std::memcpy(message_.data() + begin, &head, sizeof(head));
  pad(message_);
  subscription.seen = {newest.header.sequence, newest.reason, true};
  return true;
}

}  // namespace flexrf::panel
