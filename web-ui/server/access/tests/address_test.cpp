#include "web-ui/server/access/address.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::panel::address_test {
namespace {

bool is_same(const char* one, const char* other) {
  return Address::parse(one) == Address::parse(other);
}

void one_address_however_it_is_written(void**) {
  assert_true(is_same("192.168.0.7", "::ffff:192.168.0.7"));
  assert_true(is_same("192.168.0.7", "::FFFF:c0a8:7"));
  assert_true(is_same("fe80::1", "fe80:0:0::1%eth0"));
  assert_false(is_same("192.168.0.7", "192.168.0.8"));
  assert_false(is_same("192.168.0.7", "::192.168.0.7"));
}

void what_is_no_address(void**) {
  for (const char* text :
       {"", "localhost", "192.168.0", "192.168.0.256", "0x7f.0.0.1", "192.168.0.7%eth0", "[::1]", "::1 ",
        "1.2.3.4:80", "::ffff:1.2.3.4.5", "11111111111111111111111111111111111111111111111111"})
    assert_false(Address::parse(text).has_value());
}

void loopback_is_this_machine(void**) {
  for (const char* text : {"127.0.0.1", "127.255.0.3", "::1", "::ffff:127.0.0.1"})
    assert_true(Address::parse(text)->is_loopback());
  for (const char* text : {"128.0.0.1", "0.0.0.0", "::", "::2", "fe80::1", "::127.0.0.1"})
    assert_false(Address::parse(text)->is_loopback());
}

void a_neighbourhood_is_what_one_party_can_choose_from(void**) {
  assert_string_equal(Address::parse("::ffff:192.168.0.7")->text().c_str(), "192.168.0.7");
  assert_string_equal(Address::parse("FE80::0:1%eth0")->text().c_str(), "fe80::1");
  assert_true(Address::parse("2001:db8::1")->neighbourhood() ==
              Address::parse("2001:db8::ffff:2")->neighbourhood());
  assert_false(Address::parse("2001:db8::1")->neighbourhood() ==
               Address::parse("2001:db8:0:1::1")->neighbourhood());
  assert_false(Address::parse("10.0.0.1")->neighbourhood() == Address::parse("10.0.0.2")->neighbourhood());
}

}  // namespace
}  // namespace flexrf::panel::address_test

int main() {
  using namespace flexrf::panel::address_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_address_however_it_is_written),
      cmocka_unit_test(what_is_no_address),
      cmocka_unit_test(loopback_is_this_machine),
      cmocka_unit_test(a_neighbourhood_is_what_one_party_can_choose_from),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
