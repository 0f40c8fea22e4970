#pragma once

#include <vector>

#include "hal/socket/datagram/interface/datagram_transport.hpp"

namespace flexrf {

struct DatagramSettings {
  DatagramPeer remote;  ///< size 0: none
  bool only_remote = true;
  std::size_t size = 0;     ///< bytes of the longest
  std::size_t waiting = 0;  ///< datagrams, each way
};

/// The datagrams of a DatagramSocket that wait, each way. begin: lifecycle thread; allocates. All else: the
/// device's thread.
class DatagramExchange {
 public:
  /// `told`: of the device, where all is counted; outlives this.
  explicit DatagramExchange(DatagramSocketFeedback& told) noexcept : told_(told) {}

  /// `name`: the device's; it and the transport outlive this.
  void begin(const char* name, DatagramTransport& transport, const DatagramSettings& settings);

  void receive(Time now) noexcept;
  void send() noexcept;

  std::optional<Datagram> read() noexcept;
  bool write_to(const DatagramPeer& peer, std::span<const std::byte> bytes) noexcept;
  const DatagramPeer& remote() const noexcept { return settings_.remote; }

 private:
  struct Entry {
    DatagramPeer peer;
    Time at{};
    std::size_t size = 0;
  };
  /// A ring of datagrams. What was taken from it stays as it is until `settle`.
  struct Box {
    std::vector<Entry> entries;
    std::vector<std::byte> bytes;
    std::size_t each = 0;
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t taken = 0;  // of the first, read and not settled

    void make(std::size_t entry_count, std::size_t size);
    bool is_full() const noexcept { return count == entries.size(); }
    std::size_t at(std::size_t index) const noexcept { return (first + index) % entries.size(); }
    std::span<std::byte> room(std::size_t index) noexcept {
      return std::span(bytes).subspan(at(index) * each, each);
    }
    void settle() noexcept;
  };

  DatagramSocketFeedback& told_;
  const char* name_ = "";
  DatagramTransport* transport_ = nullptr;
  DatagramSettings settings_;
  Box inbox_;
  Box outbox_;
  std::vector<std::byte> spare_;  // for what is dropped
};

}  // namespace flexrf
