// played_pc SOCKET PASSWORD: plays the helper of an industrial PC, as docs/panel-protocol.md has its state,
// for tests of the panel. It takes an upload, verifies and installs it within a second or two each, and has
// nothing behind it. Each line of standard input is a JSON object: its members replace those of the state;
// `verified` is what the next upload is found to be, `bad` why it is not. Prints a line for each request,
// without the password.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "web-ui/server/machine/tests/played_helper.hpp"

namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr const char* token = "00112233445566778899aabbccddeeff";
constexpr const char* running = "20261128T001500Z-4fb48992";
constexpr int milliseconds_per_percent = 20;

class Pc {
 public:
  explicit Pc(std::string password) : password_(std::move(password)) {}

  json answer(const json& request, std::size_t size) {
    const std::lock_guard lock(mutex_);
    go_on();
    const std::string verb = request.at("verb");
    if (verb == "state") {
      json state = state_;
      state["ok"] = true;
      return state;
    }
    if (verb == "part") return take(request, size);
    if (request.at("password") != password_) return refusal(403, "User or password is wrong.");
    json& update = state_["update"];
    if (verb == "upload") {
      update = {{"phase", "receiving"}, {"received", 0}, {"size", request.at("size")}};
      return {{"ok", true}, {"upload", token}};
    }
    if (verb == "hosts") {
      std::istringstream words(request.at("hosts").get<std::string>());
      state_["hosts"] = json::array();
      for (std::string host; words >> host;) state_["hosts"].push_back(host);
      return {{"ok", true}};
    }
    if (state_.value("moves", false)) return refusal(409, "The cell may move: give Stop motion first.");
    if (verb == "install") {
      if (update["phase"] != "verified") return refusal(409, "Nothing is verified: upload an update first.");
      if (update.value("older", false) && !request.at("older").get<bool>())
        return refusal(409, "It is older than what runs: say that it may be.");
      if (!update["driver_changes"].empty() && !request.at("other_drivers").get<bool>())
        return refusal(409, "It has other drivers: say that it may.");
      begin("installing");
    } else if (verb == "choose") {
      make_primary(request.at("slot"));
    } else if (verb == "restart") {
      restart();
    } else if (verb == "network") {
      const bool is_fixed = request.at("address") != "image" && request.at("address") != "dhcp";
      json& interface = state_["network"][0];
      interface["setting"] = is_fixed ? json("fixed") : request.at("address");
      interface["address"] = is_fixed ? request.at("address") : json("");
      interface["gateway"] = request.at("gateway");
      if (is_fixed) interface["addresses"] = {request.at("address")};
      state_["network_trial"] = {{"interface", request.at("interface")}, {"remaining_s", 120}};
    } else if (verb == "make-room") {
      json& data = state_["data"];
      const json freed = data["old_logs"];
      for (const char* const part : {"used", "journal"})
        data[part] = data[part].get<long>() - freed.get<long>();
      data["free"] = data["free"].get<long>() + freed.get<long>();
      data["old_logs"] = 0;
      return {{"ok", true}, {"freed", freed}};
    } else if (verb == "dismiss-failure") {
      state_.erase("last_failure");
    } else if (verb == "keep-network") {
      state_["network_trial"] = {{"interface", ""}, {"remaining_s", 0}};
    }
    return {{"ok", true}};
  }

  void change(const json& with) {
    const std::lock_guard lock(mutex_);
    state_.merge_patch(with);
  }

 private:
  static json refusal(int status, const char* why) {
    return {{"ok", false}, {"status", status}, {"why", why}};
  }

  json take(const json& request, std::size_t size) {
    json& update = state_["update"];
    if (request.at("upload") != token || update["phase"] != "receiving")
      return refusal(404, "There is no such upload: begin anew.");
    const std::size_t received = update["received"];
    if (request.at("offset") != received) {
      json resume = refusal(409, "That is not what comes next.");
      resume["received"] = received;
      return resume;
    }
    update["received"] = received + size;
    if (update["received"] == update["size"]) begin("verifying");
    return {{"ok", true}, {"received", received + size}};
  }

  void begin(const char* phase) {
    state_["update"]["phase"] = phase;
    state_["update"]["percent"] = 0;
    since_ = Clock::now();
  }

  /// What is under way has come as far as this.
  void go_on() {
    json& update = state_["update"];
    const bool verifies = update.value("phase", "") == "verifying";
    if (!verifies && update.value("phase", "") != "installing") return;
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - since_);
    const auto percent = passed.count() / milliseconds_per_percent;
    update["percent"] = std::min<long>(percent, 100);
    if (percent < 100) return;
    if (verifies && state_.contains("bad")) {
      update["phase"] = "failed";
      update["why"] = state_["bad"];
    } else if (verifies) {
      update["phase"] = "verified";
      update.merge_patch(state_["verified"]);
    } else {
      update["phase"] = "installed";
      const std::string other = state_["slot"] == "A" ? "B" : "A";
      state_["slots"][other] = {
          {"version", update["version"]}, {"whole", true}, {"driver_changes", json::array()}};
      make_primary(other);
    }
  }

  void make_primary(const std::string& slot) {
    state_["slots"]["A"]["primary"] = slot == "A";
    state_["slots"]["B"]["primary"] = slot == "B";
  }

  void restart() {
    const std::string slot = state_["slots"]["A"]["primary"].get<bool>() ? "A" : "B";
    if (slot != state_["slot"])
      state_.merge_patch({{"boot", "trial"}, {"confirmed", false}, {"healthy_for_s", 0}});
    state_["slot"] = slot;
    state_["version"] = state_["slots"][slot]["version"];
    state_["update"] = {{"phase", "none"}};
  }

  std::string password_;
  std::mutex mutex_;
  Clock::time_point since_;
  json state_ = {
      {"application", "pick-station"},
      {"version", running},
      {"built", 1795824900},
      {"slot", "A"},
      {"boot", "confirmed"},
      {"confirmed", true},
      {"slots",
       {{"A", {{"version", running}, {"whole", true}, {"primary", true}, {"driver_changes", json::array()}}},
        {"B", {{"version", ""}, {"whole", false}, {"primary", false}, {"driver_changes", json::array()}}}}},
      {"claimed", true},
      {"motion", "permitted"},
      {"development_key", false},
      {"notices", json::array()},
      {"healthy_for_s", 60},
      {"healthy_needed_s", 60},
      {"why_not_healthy", ""},
      {"update", {{"phase", "none"}}},
      {"data",
       {{"size", 250000000},
        {"used", 120000000},
        {"free", 80000000},
        {"configuration", 40000},
        {"audit", 3900000},
        {"journal", 64000000},
        {"old_logs", 56000000},
        {"updates", 12000},
        {"other", 200000},
        {"complete", true}}},
      {"network",
       {{{"interface", "enp0s2"},
         {"mac", "52:54:00:12:34:56"},
         {"link", true},
         {"addresses", {"192.168.1.17/24"}},
         {"setting", "image"},
         {"address", ""},
         {"gateway", ""}},
        {{"interface", "enp3s0"},
         {"mac", "52:54:00:12:34:57"},
         {"link", false},
         {"addresses", json::array()},
         {"setting", "fixed"},
         {"address", "10.0.0.1/24"},
         {"gateway", ""}}}},
      {"network_trial", {{"interface", ""}, {"remaining_s", 0}}},
      {"hosts", json::array()},
      {"verified",
       {{"application", "pick-station"}, {"version", "20261201T080000Z-0a1b2c3d"}, {"older", false}}},
  };
};

}  // namespace

int main(int argument_count, char** arguments) {
  using flexrf::panel::PlayedHelper;
  if (argument_count != 3) return 1;
  Pc pc(arguments[2]);
  const PlayedHelper helper(arguments[1], [&pc](const std::string& line, const std::string& bytes) {
    json request = json::parse(line);
    const json answer = pc.answer(request, bytes.size());
    request.erase("password");
    if (request.at("verb") != "state") {
      std::printf("%s\n", request.dump().c_str());
      std::fflush(stdout);
    }
    // A state has all its members, also those of an update that there is not.
    json whole = answer;
    if (whole.contains("update")) {
      json update = {{"phase", "none"}, {"received", 0}, {"size", 0},
                     {"percent", 0},    {"version", ""}, {"application", ""},
                     {"older", false},  {"why", ""},     {"driver_changes", json::array()}};
      update.merge_patch(whole["update"]);
      whole["update"] = update;
    }
    return PlayedHelper::Reaction{PlayedHelper::How::answers, whole.dump()};
  });
  std::printf("ready\n");
  std::fflush(stdout);
  for (std::string line; std::getline(std::cin, line);) pc.change(json::parse(line));
  return 0;
}
