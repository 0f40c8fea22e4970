#include "web-ui/server/access/login_limits.hpp"

#include <cstdio>
#include <optional>

#include "tests/cmocka.hpp"

namespace flexrf::panel::login_limits_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

std::optional<LoginLimits> limits;
Time now;

int begin(void**) {
  limits.emplace();
  now = Time{seconds{1000}};
  return 0;
}

Duration admit(const char* address, bool at_machine = false) {
  return limits->admit(*Address::parse(address), at_machine, now);
}
bool is_admitted(const char* address, bool at_machine = false) {
  return admit(address, at_machine) == Duration::zero();
}

void some_failures_are_free_then_delays_grow(void**) {
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("10.0.0.1"));
  Duration expected = seconds{1};
  for (int i = 0; i < 12; ++i) {
    assert_int_equal(admit("10.0.0.1").count(), expected.count());
    assert_int_equal(admit("10.0.0.1").count(), expected.count());  // what is refused does not count
    now += expected;
    assert_true(is_admitted("10.0.0.1"));
    expected = std::min(2 * expected, LoginLimits::longest);
  }
  assert_false(is_admitted("10.0.0.2"));  // the delay that all share
  now += LoginLimits::longest_shared;
  assert_true(is_admitted("10.0.0.2"));
}

void success_forgives(void**) {
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("10.0.0.1"));
  limits->succeeded(*Address::parse("::ffff:10.0.0.1"));
  assert_true(is_admitted("10.0.0.1"));
}

/// A machine without time or memory for the check does not lock out a person with the right password.
void an_attempt_that_could_not_be_checked_is_no_failure(void**) {
  for (int i = 0; i < 100; ++i) {
    assert_true(is_admitted("127.0.0.1", true));
    limits->could_not_be_checked(*Address::parse("127.0.0.1"), now);
  }
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("127.0.0.1", true));
  assert_false(is_admitted("127.0.0.1", true));
  limits->could_not_be_checked(*Address::parse("127.0.0.1"), now);
  assert_true(is_admitted("127.0.0.1", true));
}

void a_success_meanwhile_has_forgiven_it_already(void**) {
  assert_true(is_admitted("10.0.0.1"));
  limits->succeeded(*Address::parse("10.0.0.1"));
  limits->could_not_be_checked(*Address::parse("10.0.0.1"), now);
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("10.0.0.1"));
  assert_false(is_admitted("10.0.0.1"));
}

void an_attempt_that_could_not_be_checked_delays_all_addresses(void**) {
  for (unsigned i = 0; i <= LoginLimits::shared_free_failures; ++i) {
    assert_true(is_admitted("10.0.0.1"));
    limits->could_not_be_checked(*Address::parse("10.0.0.1"), now);
  }
  assert_false(is_admitted("10.0.0.2"));
}

void time_forgets(void**) {
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("10.0.0.1"));
  now += LoginLimits::forgotten + seconds{2};
  for (int i = 0; i < 4; ++i) assert_true(is_admitted("10.0.0.1"));
  assert_false(is_admitted("10.0.0.1"));
}

void a_network_of_64_bits_is_one_party(void**) {
  for (const char* address : {"2001:db8::1", "2001:db8::2", "2001:db8::3", "2001:db8::4"})
    assert_true(is_admitted(address));
  assert_false(is_admitted("2001:db8::5"));
  assert_true(is_admitted("2001:db8:0:1::5"));
}

void many_addresses_share_a_delay(void**) {
  char address[32];
  int admitted = 0;
  // Ten seconds of an attack from 10000 addresses.
  for (int i = 0; i < 10000; ++i) {
    std::snprintf(address, sizeof(address), "10.1.%d.%d", i / 250, i % 250 + 1);
    if (is_admitted(address)) ++admitted;
    now += milliseconds{1};
  }
  assert_in_range(admitted, 11, 17);
}

void an_attack_from_afar_does_not_lock_out_who_is_at_the_machine(void**) {
  char address[32];
  for (int i = 0; i < 1000; ++i) {
    std::snprintf(address, sizeof(address), "10.1.%d.%d", i / 250, i % 250 + 1);
    admit(address);
    assert_true(i > 2 || is_admitted("127.0.0.1", true));
    now += milliseconds{10};
  }
  assert_true(is_admitted("127.0.0.1", true));
}

void at_the_machine_nobody_waits_long(void**) {
  for (int i = 0; i < 1000; ++i) {
    const Duration wait = admit("::1", true);
    assert_true(wait <= LoginLimits::longest_at_machine);
    now += wait;
  }
  now += LoginLimits::longest_at_machine;
  assert_true(is_admitted("::1", true));
}

}  // namespace
}  // namespace flexrf::panel::login_limits_test

int main() {
  using namespace flexrf::panel::login_limits_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(some_failures_are_free_then_delays_grow, begin),
      cmocka_unit_test_setup(success_forgives, begin),
      cmocka_unit_test_setup(an_attempt_that_could_not_be_checked_is_no_failure, begin),
      cmocka_unit_test_setup(a_success_meanwhile_has_forgiven_it_already, begin),
      cmocka_unit_test_setup(an_attempt_that_could_not_be_checked_delays_all_addresses, begin),
      cmocka_unit_test_setup(time_forgets, begin),
      cmocka_unit_test_setup(a_network_of_64_bits_is_one_party, begin),
      cmocka_unit_test_setup(many_addresses_share_a_delay, begin),
      cmocka_unit_test_setup(an_attack_from_afar_does_not_lock_out_who_is_at_the_machine, begin),
      cmocka_unit_test_setup(at_the_machine_nobody_waits_long, begin),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
