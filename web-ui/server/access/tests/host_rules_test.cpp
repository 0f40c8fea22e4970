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

/// Whether the header is allowed on a connection that arrived at 10.0.0.5.
bool is_allowed(const HostRules& some, const char* host) {
  return some.allows_host(host, *Address::parse("10.0.0.5"));
}

void what_is_declared_is_ours_until_it_is_not(void**) {
  static HostRules some(false, {"cell7"});
  some = HostRules(false, {"cell7"});
  for (const char* host : {"203.0.113.7:8443", "cell7.factory.example", "10.0.0.6"})
    assert_false(is_allowed(some, host));
  some.declare({"203.0.113.7", "cell7.factory.example"});
  for (const char* host :
       {"203.0.113.7", "203.0.113.7:8443", "CELL7.Factory.example:443", "cell7", "10.0.0.5"})
    assert_true(is_allowed(some, host));
  for (const char* host : {"203.0.113.70", "203.0.113.8", "factory.example", "x.cell7.factory.example",
                           "[::ffff:203.0.113.7]", "203.0.113.7.evil.example", "evil.example", "10.0.0.6"})
    assert_false(is_allowed(some, host));
  assert_true(some.allows_origin("http://203.0.113.7:8443", "203.0.113.7:8443"));
  assert_false(some.allows_origin("http://evil.example", "203.0.113.7"));
  some.declare({"cell8"});
  assert_true(is_allowed(some, "cell8"));
  assert_false(is_allowed(some, "203.0.113.7"));
  assert_true(is_allowed(some, "cell7"));
}

void names_are_found_in_headers(void**) {
  static std::string name;
  const auto name_in = [](const char* host) {
    name = HostRules::name_in(host).value_or("malformed");
    return name.c_str();
  };
  assert_string_equal(name_in("Cell7.example.org:8443"), "Cell7.example.org");
  assert_string_equal(name_in("203.0.113.7"), "203.0.113.7");
  assert_string_equal(name_in("[fd00::7]:8443"), "fd00::7");
  for (const char* host : {"", ":8443", "cell7:", "cell7/", "user@cell7", "cell 7", "[::1", "::1", "<b>"})
    assert_string_equal(name_in(host), "malformed");
}

void origins(void**) {
  for (const OriginCase& one : origin_cases) {
    if (rules(one.secure).allows_origin(one.origin, one.host) != one.allowed)
      fail_msg("Origin '%s' for '%s' is not to be %s", one.origin, one.host,
               one.allowed ? "refused" : "allowed");
  }
}

void names_are_checked(void**) {
  for (const char* name : {"cell7", "cell-7.example.org", "a_b", "7.example.org", "203.0.113.7"})
    assert_true(HostRules::check_name(name).is_ok());
  for (const char* name : {"", "cell7:8080", "http://cell7", "cell7/", "*.example.org", ".x", "x.",
                           "203.0.113.7:443", "203.0.113", "203.0.113.256", "203.0.113.07", "cell.7", "::1",
                           "[::1]", "::ffff:203.0.113.7", "cell 7"})
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
      cmocka_unit_test(what_is_declared_is_ours_until_it_is_not),
      cmocka_unit_test(names_are_found_in_headers),
      cmocka_unit_test(origins),
      cmocka_unit_test(names_are_checked),
      cmocka_unit_test(the_machine_has_names),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
