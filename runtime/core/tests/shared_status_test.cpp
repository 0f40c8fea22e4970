#include "runtime/core/shared_status.hpp"

#include <atomic>
#include <cstring>
#include <string>
#include <thread>

#include "tests/cmocka.hpp"

namespace flexrf::shared_status_test {
namespace {

void is_ok_before_the_first(void**) {
  const SharedStatus shared;
  assert_true(shared.read().is_ok());
  assert_string_equal(shared.read().cause(), "");
}

void the_last_one_is_read(void**) {
  SharedStatus shared;
  shared.publish(Status::error(StatusCode::timeout, "no answer from %s", "axis 3"));
  assert_int_equal(shared.read().code(), StatusCode::timeout);
  assert_string_equal(shared.read().cause(), "no answer from axis 3");
  shared.publish({});
  assert_true(shared.read().is_ok());
  assert_string_equal(shared.read().cause(), "");
}

/// Two statuses that differ in every byte are published in turn: a torn copy would have something of both.
bool copies_are_whole() {
  SharedStatus shared;
  const Status first = Status::error(StatusCode::timeout, "%s", std::string(500, 'a').c_str());
  const Status second = Status::error(StatusCode::closed, "%s", std::string(500, 'b').c_str());
  shared.publish(first);
  std::atomic<bool> ends{false};
  std::thread writer([&] {
    for (int i = 0; i < 200'000; ++i) shared.publish(i % 2 == 0 ? second : first);
    ends = true;
  });
  bool whole = true;
  while (!ends && whole) {
    const Status seen = shared.read();
    const Status& expected = seen.code() == first.code() ? first : second;
    whole = seen.code() == expected.code() && std::strcmp(seen.cause(), expected.cause()) == 0;
  }
  writer.join();
  return whole;
}

void a_copy_is_never_torn(void**) {
  assert_true(copies_are_whole());
}

}  // namespace
}  // namespace flexrf::shared_status_test

int main() {
  using namespace flexrf::shared_status_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(is_ok_before_the_first),
      cmocka_unit_test(the_last_one_is_read),
      cmocka_unit_test(a_copy_is_never_torn),
  };
  return cmocka_run_group_tests_name("shared status", tests, nullptr, nullptr);
}
