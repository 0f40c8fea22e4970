// What the driver says where there is no camera, or none that may be opened. The rest needs a kernel with
// one: camera_guest_test.
#include "hal/camera/v4l2/v4l2_camera.hpp"

#include <cerrno>

#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

/// The kernel, but for what opening says.
class RefusingCalls final : public VideoCalls {
 public:
  explicit RefusingCalls(int error) noexcept : error_(error) {}
  int open(const char* /*path*/) noexcept override { return -error_; }

 private:
  int error_;
};

struct Outcome {
  Status status;
  CameraFeedback feedback;
};

Outcome begin(const char* device, VideoCalls* calls) {
  DeviceBench<V4l2Camera> bench(nullptr);
  set_text(bench.configuration().device, device);
  if (calls != nullptr) bench.driver().use(*calls);
  Outcome outcome;
  outcome.status = bench.driver().initialise();
  bench.receive(std::chrono::milliseconds(10));
  outcome.feedback = bench.feedback();
  bench.driver().stop();
  return outcome;
}

bool waits_and_says(const Outcome& outcome, std::string_view what) {
  return outcome.status.is_ok() && !outcome.feedback.present && outcome.feedback.losses == 0 &&
         text_view(outcome.feedback.trouble).find(what) != std::string_view::npos;
}

void a_camera_that_is_not_there_is_waited_for(void**) {
  assert_true(waits_and_says(begin("/dev/no-such-camera", nullptr), "no camera /dev/no-such-camera"));
  assert_true(waits_and_says(begin("No such camera", nullptr), "no camera No such camera"));
}

void a_camera_in_use_is_waited_for_injected(void**) {
  RefusingCalls calls(EBUSY);
  assert_true(waits_and_says(begin("/dev/video0", &calls), "in use by another program"));
}

void a_missing_right_is_refused_injected(void**) {
  RefusingCalls calls(EACCES);
  const Outcome outcome = begin("/dev/video0", &calls);
  assert_int_equal(outcome.status.code(), StatusCode::not_permitted);
  assert_non_null(std::strstr(outcome.status.cause(), "group video"));
}

void what_is_no_camera_is_refused(void**) {
  const Outcome outcome = begin("/dev/null", nullptr);
  assert_int_equal(outcome.status.code(), StatusCode::invalid_argument);
  assert_non_null(std::strstr(outcome.status.cause(), "/dev/null gives no pictures"));
}

void before_it_was_ever_seen_only_the_grammar_of_controls_is_checked(void**) {
  DeviceBench<V4l2Camera> bench(nullptr);
  CameraRuntime proposed;
  set_text(proposed.controls, "gain=3");
  const Status good = bench.driver().accept_runtime(&proposed);
  set_text(proposed.controls, "gain");
  const Status bad = bench.driver().accept_runtime(&proposed);
  assert_int_equal(good.code(), StatusCode::ok);
  assert_int_equal(bad.code(), StatusCode::invalid_argument);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_camera_that_is_not_there_is_waited_for),
      cmocka_unit_test(a_camera_in_use_is_waited_for_injected),
      cmocka_unit_test(a_missing_right_is_refused_injected),
      cmocka_unit_test(what_is_no_camera_is_refused),
      cmocka_unit_test(before_it_was_ever_seen_only_the_grammar_of_controls_is_checked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
