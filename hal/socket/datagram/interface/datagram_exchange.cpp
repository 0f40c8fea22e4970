#include "hal/socket/datagram/interface/datagram_exchange.hpp"

#include <algorithm>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// Who sends faster than this thread reads must not hold it for ever.
constexpr int datagrams_per_cycle = 256;

}  // namespace

void DatagramExchange::Box::make(std::size_t entry_count, std::size_t size) {
  entries.assign(entry_count, {});
  bytes.assign(entry_count * size, {});
  each = size;
  first = count = taken = 0;
}

void DatagramExchange::Box::settle() noexcept {
  first = at(taken);
  count -= taken;
  taken = 0;
}

void DatagramExchange::begin(const char* name, DatagramTransport& transport,
                             const DatagramSettings& settings) {
  name_ = name;
  transport_ = &transport;
  settings_ = settings;
  inbox_.make(settings.waiting, settings.size);
  outbox_.make(settings.waiting, settings.size);
  spare_.assign(settings.size, {});
  told_ = {};
}

/// All that came is taken in, so that what is kept is what came first, and not what the kernel had room for.
void DatagramExchange::receive(Time now) noexcept {
  inbox_.settle();
  for (int n = 0; n < datagrams_per_cycle; ++n) {
    const bool full = inbox_.is_full();
    DatagramPeer from;
    const long size = transport_->receive(full ? std::span(spare_) : inbox_.room(inbox_.count), from);
    if (size < 0) return;
    if (settings_.only_remote && settings_.remote.size > 0 && !(from == settings_.remote)) {
      ++told_.foreign;
    } else if (static_cast<std::size_t>(size) > settings_.size) {
      ++told_.long_datagrams;
    } else if (full) {
      ++told_.dropped;
    } else {
      inbox_.entries[inbox_.at(inbox_.count++)] = {from, now, static_cast<std::size_t>(size)};
      ++told_.received;
    }
  }
}

void DatagramExchange::send() noexcept {
  while (outbox_.taken < outbox_.count) {
    const Entry& entry = outbox_.entries[outbox_.at(outbox_.taken)];
    const DatagramTransport::Sent sent =
        transport_->send(entry.peer, outbox_.room(outbox_.taken).first(entry.size));
    if (sent == DatagramTransport::Sent::later) break;
    ++outbox_.taken;
    if (sent == DatagramTransport::Sent::done) {
      ++told_.sent;
      told_.trouble = {};
      continue;
    }
    // What cannot be sent now is too old later.
    ++told_.failures;
    const std::array<char, sizeof(told_.trouble)> before = told_.trouble;
    set_text(told_.trouble, transport_->error().cause());
    if (told_.trouble != before) log_warning(name_, "{}", text_view(told_.trouble));
  }
  outbox_.settle();
}

std::optional<Datagram> DatagramExchange::read() noexcept {
  if (inbox_.taken == inbox_.count) return std::nullopt;
  const Entry& entry = inbox_.entries[inbox_.at(inbox_.taken)];
  const std::span<const std::byte> bytes = inbox_.room(inbox_.taken).first(entry.size);
  ++inbox_.taken;
  return Datagram{bytes, entry.peer, entry.at};
}

bool DatagramExchange::write_to(const DatagramPeer& peer, std::span<const std::byte> bytes) noexcept {
  if (peer.size == 0 || bytes.size() > settings_.size || outbox_.is_full()) {
    ++told_.refused_writes;
    return false;
  }
  std::copy(bytes.begin(), bytes.end(), outbox_.room(outbox_.count).begin());
  outbox_.entries[outbox_.at(outbox_.count++)] = {peer, Time{}, bytes.size()};
  return true;
}

}  // namespace flexrf
