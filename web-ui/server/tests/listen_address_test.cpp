#include "web-ui/server/listen_address.hpp"

#include <cstring>
#include <string>

#include "tests/cmocka.hpp"
#include "web-ui/server/own_addresses.hpp"

namespace flexrf::panel::listen_address_test {
namespace {

struct Case {
  const char* text;
  const char* normal;  ///< null: refused
  bool loopback;
  bool any;
};

void addresses_are_understood(void**) {
  const Case cases[] = {
      {"127.0.0.1:8080", "127.0.0.1:8080", true, false},
      {"localhost:0", "127.0.0.1:0", true, false},
      {"[::1]:443", "[::1]:443", true, false},
      {"0.0.0.0:80", "0.0.0.0:80", false, true},
      {"[::]:65535", "[::]:65535", false, true},
      {"192.168.0.7:8080", "192.168.0.7:8080", false, false},
      {"127.0.0.1", nullptr, false, false},
      {"127.0.0.1:", nullptr, false, false},
      {"127.0.0.1:65536", nullptr, false, false},
      {"127.0.0.1:-1", nullptr, false, false},
      {"127.0.0.1:80x", nullptr, false, false},
      {"127.0.0:80", nullptr, false, false},
      {"robot:80", nullptr, false, false},
      {":80", nullptr, false, false},
  };
  for (const Case& one : cases) {
    static ListenAddress address;
    bool is_understood = false;
    {
      const Result<ListenAddress> result = parse_listen_address(one.text);
      is_understood = static_cast<bool>(result);
      if (result) address = *result;
    }
    if (is_understood != (one.normal != nullptr)) print_error("%s\n", one.text);
    assert_int_equal(is_understood, one.normal != nullptr);
    if (!is_understood) continue;
    static std::string text;
    text = address.text();
    assert_string_equal(text.c_str(), one.normal);
    assert_int_equal(address.is_loopback(), one.loopback);
    assert_int_equal(address.is_any(), one.any);
  }
}

void a_refusal_says_what_is_wanted(void**) {
  const Result<ListenAddress> result = parse_listen_address("robot:80");
  assert_non_null(
      strstr(result.status().cause(), "--panel robot:80: this is no numeric address; give ADDRESS:PORT"));
}

/// Each host behind a blank.
std::string hosts(const char* listen, const std::vector<std::string>& declared,
                  const std::vector<std::string>& own) {
  std::string all;
  for (const std::string& host : reachable_hosts(*parse_listen_address(listen), declared, own))
    all += ' ' + host;
  return all;
}

void others_are_told_addresses_and_declared_names_but_no_host_name(void**) {
  static std::string all;
  const auto check = [](std::string found, const char* expected) {
    all = std::move(found);
    assert_string_equal(all.c_str(), expected);
  };
  check(hosts("10.0.0.5:8443", {"cell7"}, {"10.0.0.5", "10.0.0.6"}), " 10.0.0.5");
  check(hosts("0.0.0.0:8443", {}, {"169.254.3.4", "10.0.0.5", "10.0.0.6"}), " 10.0.0.5 10.0.0.6");
  check(hosts("0.0.0.0:8443", {"cell7"}, {"10.0.0.5"}), " cell7 10.0.0.5");
  check(hosts("[::]:8443", {}, {"169.254.3.4"}), " 169.254.3.4");
  check(hosts("0.0.0.0:8443", {}, {}), "");
  for (const std::string& address : own_addresses()) {
    assert_true(Address::parse(address).has_value());
    assert_false(Address::parse(address)->is_loopback());
  }
}

}  // namespace
}  // namespace flexrf::panel::listen_address_test

int main() {
  using namespace flexrf::panel::listen_address_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(addresses_are_understood),
      cmocka_unit_test(a_refusal_says_what_is_wanted),
      cmocka_unit_test(others_are_told_addresses_and_declared_names_but_no_host_name),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
