#include "web-ui/server/listen_address.hpp"

#include <cstring>
#include <string>

#include "tests/cmocka.hpp"

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

}  // namespace
}  // namespace flexrf::panel::listen_address_test

int main() {
  using namespace flexrf::panel::listen_address_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(addresses_are_understood),
      cmocka_unit_test(a_refusal_says_what_is_wanted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
