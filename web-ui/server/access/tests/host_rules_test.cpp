#include "web-ui/server/access/host_rules.hpp"

#include <algorithm>

#include "tests/cmocka.hpp"

namespace flexrf::panel::host_rules_test {
namespace {

struct HostCase {
  const char* host;
  const char* local_end;
  bool allowed;
};

constexpr HostCase host_cases[] = {
    {"localhost", "127.0.0.1", true},
    {"localhost:8080", "127.0.0.1", true},
    {"LocalHost:9000", "::1", true},  // a tunnel's other end
    {"127.0.0.1:8080", "127.0.0.1", true},
    {"127.0.0.1:8080", "::ffff:127.0.0.1", true},
    {"[::1]:8080", "::1", true},
    {"[::1]", "::1", true},
    {"10.0.0.5:8080", "10.0.0.5", true},
    {"cell7", "10.0.0.5", true},
    {"CELL7.example.org:443", "10.0.0.5", true},
    // Foreign names and addresses
    {"evil.example", "127.0.0.1", false},
    {"localhost.evil.example", "127.0.0.1", false},
    {"evil.localhost", "127.0.0.1", false},
    {"10.0.0.6:8080", "10.0.0.5", false},
    {"127.0.0.1", "10.0.0.5", false},
    {"cell7.example.org.evil.example", "10.0.0.5", false},
    {"cell", "10.0.0.5", false},
    {"cell77", "10.0.0.5", false},
    // What is no host
    {"", "127.0.0.1", false},
    {":8080", "127.0.0.1", false},
    {"localhost:", "127.0.0.1", false},
    {"localhost:0", "127.0.0.1", false},
    {"localhost:65536", "127.0.0.1", false},
    {"localhost:-1", "127.0.0.1", false},
    {"localhost:+80", "127.0.0.1", false},
    {"localhost:80 ", "127.0.0.1", false},
    {"localhost:8080:8080", "127.0.0.1", false},
    {" localhost", "127.0.0.1", false},
    {"localhost.", "127.0.0.1", false},
    {".localhost", "127.0.0.1", false},
    {"local..host", "127.0.0.1", false},
    {"localhost/", "127.0.0.1", false},
    {"user@localhost", "127.0.0.1", false},
    {"localhost#", "127.0.0.1", false},
    {"localhost\\", "127.0.0.1", false},
    {"::1", "::1", false},
    {"[::1", "::1", false},
    {"[::1]x", "::1", false},
    {"[::1]:", "::1", false},
    {"[fe80::1%eth0]", "fe80::1", false},
    {"[127.0.0.1]", "127.0.0.1", false},
    {"[]", "::1", false},
    {"[localhost]", "::1", false},
};

struct OriginCase {
  bool secure;
  const char* origin;
  const char* host;
  bool allowed;
};

constexpr OriginCase origin_cases[] = {
    {false, "", "localhost:8080", true},  // no page
    {false, "http://localhost:8080", "localhost:8080", true},
    {false, "http://LOCALHOST:8080", "localhost:8080", true},
    {false, "http://[::1]:8080", "[::1]:8080", true},
    {false, "http://localhost", "localhost:80", true},
    {true, "https://cell7", "cell7:443", true},
    {true, "https://cell7:8443", "cell7:8443", true},
    {false, "null", "localhost:8080", false},
    {false, "http://localhost:8081", "localhost:8080", false},  // another application of this machine
    {false, "http://localhost", "localhost:8080", false},
    {false, "https://localhost:8080", "localhost:8080", false},
    {true, "http://cell7:8443", "cell7:8443", false},
    {false, "http://127.0.0.1:8080", "localhost:8080", false},
    {false, "http://evil.example", "localhost:8080", false},
    {false, "http://localhost:8080.evil.example", "localhost:8080", false},
    {false, "http://localhost:8080/", "localhost:8080", false},
    {false, "http://user@localhost:8080", "localhost:8080", false},
    {false, "http://localhost:8080 http://evil.example", "localhost:8080", false},
    {false, "http://", "localhost:8080", false},
    {false, "localhost:8080", "localhost:8080", false},
    {false, "file://", "localhost:8080", false},
};

const HostRules& rules(bool secure) {
  static const HostRules plain(false, {"cell7", "cell7.example.org"});
  static const HostRules tls(true, {"cell7", "cell7.example.org"});
  return secure ? tls : plain;
}

void hosts(void**) {
  for (const HostCase& one : host_cases) {
    if (rules(false).allows_host(one.host, *Address::parse(one.local_end)) != one.allowed)
      fail_msg("Host '%s' at %s is not to be %s", one.host, one.local_end,
               one.allowed ? "refused" : "allowed");
  }
}

void long_hosts_are_refused(void**) {
  static const std::string text(5000, 'a');
  assert_false(rules(false).allows_host(text, *Address::parse("127.0.0.1")));
}

void origins(void**) {
  for (const OriginCase& one : origin_cases) {
    if (rules(one.secure).allows_origin(one.origin, one.host) != one.allowed)
      fail_msg("Origin '%s' for '%s' is not to be %s", one.origin, one.host,
               one.allowed ? "refused" : "allowed");
  }
}

void names_are_checked(void**) {
  for (const char* name : {"cell7", "cell-7.example.org", "a_b"})
    assert_true(HostRules::check_name(name).is_ok());
  for (const char* name : {"", "cell7:8080", "http://cell7", "cell7/", "*.example.org", ".x", "x."})
    assert_int_equal(HostRules::check_name(name).code(), StatusCode::invalid_argument);
}

void the_machine_has_names(void**) {
  static std::vector<std::string> names;
  names = HostRules::names_of_machine();
  for (const std::string& name : names) assert_true(HostRules::check_name(name).is_ok());
  const bool has_local =
      std::any_of(names.begin(), names.end(), [](const auto& name) { return name.ends_with(".local"); });
  assert_true(names.empty() || has_local);
}

}  // namespace
}  // namespace flexrf::panel::host_rules_test

int main() {
  using namespace flexrf::panel::host_rules_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(hosts),
      cmocka_unit_test(long_hosts_are_refused),
      cmocka_unit_test(origins),
      cmocka_unit_test(names_are_checked),
      cmocka_unit_test(the_machine_has_names),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
