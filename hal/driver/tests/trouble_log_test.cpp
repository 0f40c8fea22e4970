// What a device's trouble leaves in the log, from the start on.
#include "hal/driver/trouble_log.hpp"

#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

constexpr Time beginning{std::chrono::seconds(1)};

Status off() {
  return Status::error(StatusCode::timeout, "nothing is heard");
}

void a_device_that_is_not_there_is_told_after_a_second(void**) {
  TroubleLog log;
  const LogEar ear;
  log.look("sensor", off(), beginning);
  log.look("sensor", off(), beginning + milliseconds(999));
  assert_false(ear.has_heard("sensor: nothing is heard"));
  log.look("sensor", off(), beginning + milliseconds(1000));
  assert_true(ear.has_heard("sensor: nothing is heard"));
  const LogEar later;
  log.look("sensor", off(), beginning + milliseconds(1100));
  assert_false(later.has_heard("sensor"));
  log.look("sensor", {}, beginning + milliseconds(1200));
  assert_true(later.has_heard("sensor: it is well again"));
}

void a_device_that_takes_its_time_is_not_told(void**) {
  TroubleLog log;
  const LogEar ear;
  log.look("sensor", off(), beginning);
  log.look("sensor", {}, beginning + milliseconds(900));
  log.look("sensor", {}, beginning + milliseconds(1900));
  assert_false(ear.has_heard("sensor"));
  log.look("sensor", off(), beginning + milliseconds(2000));
  assert_true(ear.has_heard("sensor: nothing is heard"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_device_that_is_not_there_is_told_after_a_second),
      cmocka_unit_test(a_device_that_takes_its_time_is_not_told),
  };
  return cmocka_run_group_tests_name("trouble log", tests, nullptr, nullptr);
}
