// An interface's address, set by an admin: tried first, and taken back unless somebody reaches this PC by it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/status.hpp"
#include "base/time.hpp"
#include "image/helper/address_setting.hpp"
#include "image/helper/answer.hpp"
#include "image/helper/files.hpp"
#include "image/helper/surroundings.hpp"

namespace flexrf::helper {

/// A setting that is used, and that nobody has kept.
struct AddressTrial {
  std::string interface;
  Time until{};
};

/// Any thread.
std::optional<AddressTrial> read_trial(const NetworkFiles& files);
/// What is used now. Any thread.
AddressSetting setting_of(const NetworkFiles& files, const std::string& interface);

/// One thread. What is kept is on the disk; what is tried is in memory alone, so that a restart of the PC
/// takes it back, too.
class Network {
 public:
  static constexpr Duration trial = std::chrono::minutes{2};
  /// Until a new setting is used: who set it gets the answer first.
  static constexpr Duration pause = std::chrono::seconds{1};

  /// `surroundings` outlives it.
  Network(const Files& files, const Surroundings& surroundings, std::function<Time()> clock);

  /// Whether begin() is to be refused. Changes nothing.
  Answer check(const std::string& interface, const AddressSetting& setting) const;
  /// The trial begins.
  Answer begin(const std::string& interface, const AddressSetting& setting);
  /// The setting on trial is the one from now on, if this PC is reached by an address that it gave:
  /// `reached_by`, as "192.168.1.10".
  Answer keep(const std::string& reached_by);
  /// About once a second: says the addresses when they are others, has systemd-networkd use what was set, and
  /// takes back what nobody kept.
  void tick();

 private:
  /// Why it is not shown by this that the setting on trial leads here; ok: it is.
  Answer check_reached(const std::string& interface, const AddressSetting& setting,
                       const std::string& reached_by) const;
  Status use(const std::string& interface, const AddressSetting& setting) const;
  Status end_trial() const;
  void take_back(const AddressTrial& trial);
  void say_addresses();
  void tell_networkd();

  NetworkFiles files_;
  std::string notice_;
  const Surroundings& surroundings_;
  std::function<Time()> clock_;
  std::string said_addresses_;
  std::optional<Time> tells_at_;  // systemd-networkd
};

}  // namespace flexrf::helper
