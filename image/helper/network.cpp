#include "image/helper/network.hpp"

#include <unistd.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "image/helper/interfaces.hpp"
#include "image/helper/named_lines.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

/// Before those of the image: the first that fits an interface counts.
std::string file_of(const std::string& folder, const std::string& interface) {
  return folder + "/05-" + interface + ".network";
}

std::string file_of_trial(const NetworkFiles& files) {
  return files.used + "/trial";
}

std::string text_of(const AddressSetting& setting) {
  switch (setting.way) {
    case AddressWay::image:
      return "the address as this version says";
    case AddressWay::dhcp:
      return "the address by DHCP";
    default:
      return "the address " + setting.address;
  }
}

std::string names_of(const std::vector<Interface>& interfaces) {
  std::string names;
  for (const Interface& one : interfaces) names.append(names.empty() ? "" : ", ").append(one.name);
  return names.empty() ? "none" : names;
}

}  // namespace

std::optional<AddressTrial> read_trial(const NetworkFiles& files) {
  const Result<NamedLines> lines = NamedLines::read(file_of_trial(files));
  if (!lines || lines->text("interface").empty()) return std::nullopt;
  return AddressTrial{lines->text("interface"), Time{std::chrono::milliseconds{lines->number("until_ms")}}};
}

AddressSetting setting_of(const NetworkFiles& files, const std::string& interface) {
  const Result<std::string> text = read_file(file_of(files.used, interface));
  return text ? setting_in(*text) : AddressSetting{};
}

Network::Network(const Files& files, const Surroundings& surroundings, std::function<Time()> clock)
    : files_(files.network),
      notice_(files.notices + "/network"),
      surroundings_(surroundings),
      clock_(std::move(clock)) {
  // Whether a helper before this one has told of it is not known; to be told twice does no harm.
  if (read_trial(files_)) tells_at_ = clock_();
}

Answer Network::check(const std::string& interface, const AddressSetting& setting) const {
  const std::vector<Interface> all = surroundings_.interfaces();
  if (std::none_of(all.begin(), all.end(), [&](const Interface& one) { return one.name == interface; }))
    return refuse(400,
                  "there is no wired interface " + in_quotes(interface) + "; there is: " + names_of(all));
  if (const auto other = read_trial(files_); other && other->interface != interface)
    return refuse(
        409, "the address of " + other->interface + " is on trial; keep it, or wait until it is taken back");
  if (setting == setting_of(files_, interface)) return refuse(409, "that is set already");
  if (setting.way != AddressWay::fixed) return {};
  for (const Interface& one : all) {
    if (one.name == interface) continue;
    for (const std::string& address : one.addresses) {
      if (share_network(address, setting.address))
        return refuse(409,
                      one.name + " is in this network already, with " + address +
                          "; two interfaces in one network do not find their machines. Take another network");
    }
  }
  return {};
}

Answer Network::begin(const std::string& interface, const AddressSetting& setting) {
  const Time until = clock_() + pause + trial;
  // The trial first: what is used is never without its end.
  const std::string lines = "interface=" + interface + "\nuntil_ms=" +
                            std::to_string(until.time_since_epoch() / std::chrono::milliseconds{1}) + '\n';
  if (const Status written = replace_file(file_of_trial(files_), lines); !written) return answer_of(written);
  if (const Status used = use(interface, setting); !used) {
    take_back({interface, until});
    return answer_of(used);
  }
  unlink(notice_.c_str());
  tells_at_ = clock_() + pause;
  return {};
}

Answer Network::check_reached(const std::string& interface, const AddressSetting& setting,
                              const std::string& reached_by) const {
  if (tells_at_) return refuse(409, "the new address is not used yet; ask again in a few seconds");
  const std::vector<Interface> all = surroundings_.interfaces();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Interface& one) { return one.name == interface; });
  std::string there;
  if (found != all.end()) {
    for (const std::string& address : found->addresses) {
      if (setting.way == AddressWay::fixed && address != setting.address) continue;
      const std::string alone = address.substr(0, address.find('/'));
      if (alone == reached_by) return {};
      there.append(there.empty() ? "" : " or ").append(alone);
    }
  }
  return refuse(409, "this PC is asked at " + in_quotes(reached_by) +
                         ", which does not show that it is found by the address of " + interface +
                         " that is on trial: " +
                         (there.empty() ? "it has none yet; is its cable in?"
                                        : "open its panel at " + there + " and keep it there"));
}

Answer Network::keep(const std::string& reached_by) {
  const std::optional<AddressTrial> on_trial = read_trial(files_);
  if (!on_trial) return refuse(409, "no address is on trial; it may have been taken back");
  const AddressSetting setting = setting_of(files_, on_trial->interface);
  if (Answer reached = check_reached(on_trial->interface, setting, reached_by); !reached.is_done())
    return reached;
  const std::string kept = file_of(files_.kept, on_trial->interface);
  const Status written = setting.way == AddressWay::image
                             ? remove_file(kept)
                             : replace_file(kept, network_file(on_trial->interface, setting));
  if (!written) return answer_of(written);
  return answer_of(end_trial());
}

void Network::tick() {
  say_addresses();
  const std::optional<AddressTrial> on_trial = read_trial(files_);
  if (on_trial && clock_() >= on_trial->until) {
    const std::string line = "the address of " + on_trial->interface + " is as before: nobody has kept " +
                             text_of(setting_of(files_, on_trial->interface)) + " within 2 min";
    take_back(*on_trial);
    surroundings_.say(line);
    if (const Status written = replace_file(notice_, line + '\n'); !written)
      surroundings_.say(written.cause());
  }
  if (tells_at_ && clock_() >= *tells_at_) tell_networkd();
}

Status Network::use(const std::string& interface, const AddressSetting& setting) const {
  const std::string file = file_of(files_.used, interface);
  return setting.way == AddressWay::image ? remove_file(file)
                                          : replace_file(file, network_file(interface, setting));
}

Status Network::end_trial() const {
  return remove_file(file_of_trial(files_));
}

void Network::take_back(const AddressTrial& on_trial) {
  const Result<std::string> kept = read_file(file_of(files_.kept, on_trial.interface));
  // What cannot be read is none: this version's own files bring it back to where somebody may find it.
  const Status used = use(on_trial.interface, kept ? setting_in(*kept) : AddressSetting{});
  if (!used) surroundings_.say(used.cause());
  if (const Status ended = end_trial(); !ended) surroundings_.say(ended.cause());
  tells_at_ = clock_();
}

/// Whoever does not know any more where the panel is finds it on the PC's screen.
void Network::say_addresses() {
  std::string line;
  for (const Interface& one : surroundings_.interfaces()) {
    line.append(line.empty() ? "" : ", ").append(one.name).append(one.has_link ? "" : " (no cable)");
    if (one.addresses.empty()) line.append(" none");
    for (const std::string& address : one.addresses) line.append(" ").append(address);
  }
  if (line == said_addresses_) return;
  said_addresses_ = line;
  surroundings_.say("addresses of this PC: " + line);
}

void Network::tell_networkd() {
  tells_at_.reset();
  const std::string failure = surroundings_.systemctl({"restart", "--no-block", "systemd-networkd.service"});
  if (failure.empty()) return;
  surroundings_.say("the addresses cannot be changed now: " + failure + "; restart the PC");
}

}  // namespace flexrf::helper
