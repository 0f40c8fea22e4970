// Addresses that an admin sets: what is refused, the trial, and what is left of it when somebody dies. Hosts
// that an admin declares.
#include <string>

#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::network_test {
namespace {

const std::string restart_networkd = "restart --no-block systemd-networkd.service";

Request address(const std::string& text, const std::string& gateway = "") {
  Request asked = request(Verb::network);
  asked.interface = "enp0s2";
  asked.address = text;
  asked.gateway = gateway;
  return asked;
}

std::string used(const Bench& bench) {
  return text_of_file(bench.pc.files.network.used + "/05-enp0s2.network");
}

std::string kept(const Bench& bench) {
  return text_of_file(bench.pc.files.network.kept + "/05-enp0s2.network");
}

/// An admin keeps it who reaches the PC there.
std::string keep_at(Bench& bench, const std::string& address) {
  Request asked = request(Verb::keep_network);
  asked.reached_by = address;
  return refusal(bench.ask(asked));
}

void has_address(Bench& bench, const std::string& address) {
  bench.pc.interfaces[0].addresses = {address};
}

void passes(Bench& bench, int looks) {
  for (int i = 0; i < looks; ++i) {
    bench.pc.now += seconds{1};
    bench.verbs->tick();
  }
}

void an_address_is_tried_and_kept() {
  Bench bench;
  Helper helper = bench.pc.helper();
  bench.pc.run(helper, 1);
  CHECK_CONTAINS(bench.state(),
                 R"("addresses":["10.0.2.15/24"],"setting":"image","address":"","gateway":""})");
  CHECK_CONTAINS(bench.state(), R"("network_trial":{"interface":"","remaining_s":0},"hosts":[]})");
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24", "10.0.2.2"))), "200 ");
  CHECK_CONTAINS(bench.pc.said.back(),
                 "network by 'anna' from uid 990, process 7, 'enp0s2': '10.0.2.16/24': accepted");
  CHECK_CONTAINS(used(bench), "[Match]\nName=enp0s2\n\n[Network]\nAddress=10.0.2.16/24\nGateway=10.0.2.2\n");
  // Who asked gets the answer first.
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 0);
  passes(bench, 1);
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 1);
  CHECK_CONTAINS(bench.state(), R"("setting":"fixed","address":"10.0.2.16/24","gateway":"10.0.2.2"})");
  CHECK_CONTAINS(bench.state(), R"("network_trial":{"interface":"enp0s2","remaining_s":120},"hosts":[]})");
  bench.pc.run(helper, 1);
  CHECK_CONTAINS(bench.pc.motion(), "the address of enp0s2 is on trial");
  CHECK_EQUAL(kept(bench), "");
  // A request at the former address does not prove that the new one works.
  CHECK_CONTAINS(keep_at(bench, "10.0.2.15"), "409 this PC is asked at '10.0.2.15'");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.15"), "it has none yet; is its cable in?");
  has_address(bench, "10.0.2.16/24");
  CHECK_CONTAINS(keep_at(bench, "192.168.7.1"), "open its panel at 10.0.2.16 and keep it there");
  CHECK_EQUAL(kept(bench), "");
  CHECK_EQUAL(keep_at(bench, "10.0.2.16"), "200 ");
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  CHECK_EQUAL(kept(bench), used(bench));
  CHECK_CONTAINS(bench.state(), R"("network_trial":{"interface":"","remaining_s":0},"hosts":[]})");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.16"), "409 no address is on trial");
  passes(bench, 200);
  CHECK_EQUAL(kept(bench), used(bench));
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 1);
}

void what_nobody_keeps_is_taken_back() {
  Bench bench;
  fs::create_directory(bench.pc.files.notices);
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24"))), "200 ");
  passes(bench, 120);
  CHECK_CONTAINS(used(bench), "Address=10.0.2.16/24");
  passes(bench, 1);
  CHECK_EQUAL(used(bench), "");
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 2);
  CHECK_CONTAINS(
      bench.state(),
      R"("notices":["the address of enp0s2 is as before: nobody has kept the address 10.0.2.16/24 within 2 min"])");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.16"), "409 no address is on trial; it may have been taken back");
  // With the next try it is no news any more.
  CHECK_EQUAL(refusal(bench.ask(address("dhcp"))), "200 ");
  CHECK_CONTAINS(bench.state(), R"("notices":[])");
  CHECK_CONTAINS(used(bench), "DHCP=ipv4");
  CHECK_CONTAINS(used(bench), "UseRoutes=no\nUseGateway=yes\n");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.15"), "409 the new address is not used yet");
  passes(bench, 1);
  has_address(bench, "10.0.2.20/24");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.15"), "open its panel at 10.0.2.20");
  CHECK_EQUAL(keep_at(bench, "10.0.2.20"), "200 ");
  // What was kept is what comes back.
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.17/24"))), "200 ");
  passes(bench, 125);
  CHECK_CONTAINS(bench.state(), R"("setting":"dhcp")");
  CHECK_EQUAL(used(bench), kept(bench));
  CHECK_EQUAL(refusal(bench.ask(address("image"))), "200 ");
  passes(bench, 1);
  CHECK_EQUAL(keep_at(bench, "10.0.2.20"), "200 ");
  CHECK_EQUAL(kept(bench) + used(bench), "");
}

void a_helper_that_dies_changes_nothing_about_a_trial() {
  Bench bench;
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24"))), "200 ");
  bench.starts_anew();
  passes(bench, 1);
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 1);
  bench.starts_anew();
  passes(bench, 119);
  CHECK_EQUAL(bench.pc.asked_systemd(restart_networkd), 2);
  CHECK_CONTAINS(used(bench), "Address=10.0.2.16/24");
  passes(bench, 2);
  CHECK_EQUAL(used(bench), "");
}

void one_interface_is_on_trial_at_a_time() {
  Bench bench;
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24"))), "200 ");
  Request other = address("172.16.0.5/16");
  other.interface = "enp0s3";
  CHECK_CONTAINS(refusal(bench.ask(other)), "409 the address of enp0s2 is on trial; keep it, or wait");
  // A slip is mended at once, and has its own two minutes.
  passes(bench, 60);
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.61/24"))), "200 ");
  passes(bench, 119);
  CHECK_CONTAINS(used(bench), "Address=10.0.2.61/24");
}

void nothing_is_set_while_the_cell_may_move() {
  Bench bench;
  bench.pc.panel.may_move = true;
  CHECK_CONTAINS(refusal(bench.ask(address("10.0.2.16/24"))), "409 the cell may move; stop motion first");
  bench.pc.panel.has_answered = false;
  CHECK_CONTAINS(refusal(bench.ask(address("10.0.2.16/24"))), "503 whether the cell may move cannot be told");
  CHECK_EQUAL(used(bench), "");
}

void what_no_machine_could_have_is_refused() {
  Bench bench;
  const auto refused = [&](const Request& asked) {
    bench.pc.now += minutes{1};
    return refusal(bench.ask(asked));
  };
  for (const char* const text :
       {"", "10.0.2.16", "10.0.2.16/", "10.0.2.16/7", "10.0.2.16/31", "10.0.2.16/24x", "10.0.2/24",
        "10.0.2.256/24", "fe80::1/64", "10.0.2.16/24\nDNS=1.2.3.4", "10.0.2.16\n/24", "DHCP", "/24",
        "10.0.2.16/-1"})
    CHECK_CONTAINS(refused(address(text)), "400 'address' is '");
  for (const char* const text :
       {"0.0.0.1/8", "127.0.0.1/8", "224.0.0.1/24", "255.255.255.254/24", "169.254.1.1/16"})
    CHECK_CONTAINS(refused(address(text)), "is no address for a machine");
  for (const char* const text : {"10.0.2.0/24", "10.0.2.255/24", "10.0.2.19/30"})
    CHECK_CONTAINS(refused(address(text)), "stands for the whole network");
  for (const char* const gateway : {"10.0.3.1", "10.0.2.16", "10.0.2.0", "10.0.2.255"})
    CHECK_CONTAINS(refused(address("10.0.2.16/24", gateway)), "is none of the other machines");
  CHECK_CONTAINS(refused(address("10.0.2.16/24", "gw")), "400 'gateway' is 'gw'; it is as 192.168.1.1");
  CHECK_CONTAINS(refused(address("dhcp", "10.0.2.2")), "400 a gateway is set with a fixed address alone");
  for (const char* const text : {"192.168.7.2/24", "192.168.0.9/16", "192.168.7.2/30"})
    CHECK_CONTAINS(refused(address(text)), "409 enp0s3 is in this network already, with 192.168.7.1/24");
  for (const char* const name : {"", "lo", "can0", "../../x", "enp0s2\n"}) {
    Request foreign = address("10.0.2.16/24");
    foreign.interface = name;
    CHECK_CONTAINS(refused(foreign), "400 there is no wired interface");
  }
  CHECK_CONTAINS(refused(address("image")), "409 that is set already");
  CHECK(fs::is_empty(bench.pc.files.network.used));
}

void what_cannot_be_kept_stays_on_trial() {
  Bench bench;
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24"))), "200 ");
  fs::remove_all(bench.pc.files.network.kept);
  passes(bench, 1);
  has_address(bench, "10.0.2.16/24");
  CHECK_CONTAINS(keep_at(bench, "10.0.2.16"), "503 ");
  CHECK_CONTAINS(bench.state(), R"("network_trial":{"interface":"enp0s2")");
  passes(bench, 125);
  CHECK_EQUAL(used(bench), "");
  fs::remove_all(bench.pc.files.network.used);
  CHECK_CONTAINS(refusal(bench.ask(address("10.0.2.16/24"))), "503 ");
}

void who_stands_before_the_pc_is_told_its_addresses() {
  Bench bench;
  passes(bench, 2);
  CHECK_EQUAL(bench.pc.said.back(),
              "addresses of this PC: enp0s2 10.0.2.15/24, enp0s3 (no cable) 192.168.7.1/24");
  const std::size_t lines = bench.pc.said.size();
  passes(bench, 2);
  CHECK_EQUAL(bench.pc.said.size(), lines);
  bench.pc.interfaces = {{"enp0s2", "", true, {}}};
  passes(bench, 1);
  CHECK_EQUAL(bench.pc.said.back(), "addresses of this PC: enp0s2 none");
}

void networkd_that_is_not_told_is_said() {
  Bench bench;
  CHECK_EQUAL(refusal(bench.ask(address("10.0.2.16/24"))), "200 ");
  bench.pc.systemd_failure = "systemctl ended with 1";
  passes(bench, 1);
  CHECK_CONTAINS(bench.pc.said.back(),
                 "the addresses cannot be changed now: systemctl ended with 1; restart the PC");
}

// ---- declared hosts

std::string declare(Bench& bench, const std::string& hosts) {
  Request asked = request(Verb::hosts);
  asked.hosts = hosts;
  return refusal(bench.ask(asked));
}

void hosts_are_declared_while_the_cell_moves() {
  Bench bench;
  bench.pc.panel.may_move = true;
  CHECK_EQUAL(declare(bench, "Cell7.example.org  203.0.113.7 cell7.example.org"), "200 ");
  CHECK_CONTAINS(bench.pc.said.back(),
                 "hosts by 'anna' from uid 990, process 7, cell7.example.org 203.0.113.7: accepted");
  CHECK_CONTAINS(bench.state(), R"("hosts":["cell7.example.org","203.0.113.7"]})");
  CHECK_CONTAINS(text_of_file(bench.pc.files.network.kept + "/panel-hosts"),
                 "\ncell7.example.org\n203.0.113.7\n");
  CHECK_EQUAL(declare(bench, "cell8"), "200 ");
  CHECK_CONTAINS(bench.state(), R"("hosts":["cell8"]})");
  CHECK_EQUAL(declare(bench, ""), "200 ");
  CHECK_CONTAINS(bench.pc.said.back(), ", none: accepted");
  CHECK_CONTAINS(bench.state(), R"("hosts":[]})");
  CHECK(bench.pc.systemd.empty());
}

void a_wrong_host_is_named_and_changes_nothing() {
  Bench bench;
  CHECK_EQUAL(declare(bench, "cell7"), "200 ");
  for (const char* const wrong : {"https://cell8/", "cell8:8443", "203.0.113.300", "fd00::7", "cell8\\"})
    CHECK_CONTAINS(declare(bench, std::string{"cell8 "} + wrong + " cell9"),
                   "400 'hosts': '" + std::string{wrong} + "' is no host: ");
  CHECK_CONTAINS(declare(bench, "a b c d e f g h i"), "400 'hosts': 'i' is one too many: at most 8");
  CHECK_CONTAINS(bench.state(), R"("hosts":["cell7"]})");
  fs::remove_all(bench.pc.files.network.kept);
  CHECK_CONTAINS(declare(bench, "cell8"), "503 ");
  CHECK_CONTAINS(bench.state(), R"("hosts":[]})");
}

}  // namespace
}  // namespace flexrf::helper::network_test

int main() {
  using namespace flexrf::helper::network_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(an_address_is_tried_and_kept),
      CONTAINED_TEST(what_nobody_keeps_is_taken_back),
      CONTAINED_TEST(a_helper_that_dies_changes_nothing_about_a_trial),
      CONTAINED_TEST(one_interface_is_on_trial_at_a_time),
      CONTAINED_TEST(nothing_is_set_while_the_cell_may_move),
      CONTAINED_TEST(what_no_machine_could_have_is_refused),
      CONTAINED_TEST(what_cannot_be_kept_stays_on_trial),
      CONTAINED_TEST(who_stands_before_the_pc_is_told_its_addresses),
      CONTAINED_TEST(networkd_that_is_not_told_is_said),
      CONTAINED_TEST(hosts_are_declared_while_the_cell_moves),
      CONTAINED_TEST(a_wrong_host_is_named_and_changes_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
