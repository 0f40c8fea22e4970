// The real driver on the kernel's virtual camera, vivid: the conformance suite, bytes that are not copied,
// and faults as far as vivid makes them; what it does not make is injected, and its test says so.
#include <linux/videodev2.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include "hal/interfaces/camera/conformance/camera_bench.hpp"
#include "hal/interfaces/camera/conformance/camera_eye.hpp"
#include "hal/linux/v4l2_camera/tests/vivid.hpp"
#include "hal/linux/v4l2_camera/v4l2_camera.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr uid_t nobody = 65534;

/// The kernel; it notes what was queued for it to fill, and refuses what it is told to, once.
class WatchedCalls final : public VideoCalls {
 public:
  int control(int descriptor, unsigned long request, void* argument) noexcept override {
    {
      const std::lock_guard lock(mutex_);
      if (request == refused_) {
        refused_ = 0;
        return -EIO;
      }
      if (request == VIDIOC_QBUF) note(*static_cast<const v4l2_buffer*>(argument));
    }
    return VideoCalls::control(descriptor, request, argument);
  }

  void refuse(unsigned long request) {
    const std::lock_guard lock(mutex_);
    refused_ = request;
  }
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return queued_.size();
  }
  bool has_queued(const std::uint8_t* address) {
    const std::lock_guard lock(mutex_);
    return std::find(queued_.begin(), queued_.end(), address) != queued_.end();
  }

 private:
  void note(const v4l2_buffer& buffer) {
    if (buffer.memory == V4L2_MEMORY_USERPTR)
      queued_.push_back(reinterpret_cast<const std::uint8_t*>(buffer.m.userptr));
  }

  std::mutex mutex_;  // the camera's thread and its keeper
  unsigned long refused_ = 0;
  std::vector<const std::uint8_t*> queued_;
};

class VividWorld final : public CameraWorld {
 public:
  VividWorld() { vivid_.restore(); }
  ~VividWorld() override {
    if (forbidden_ && seteuid(0) != 0) std::perror("seteuid");
    stop();
    vivid_.let_go();
    vivid_.plug_in();
    vivid_.restore();
  }

  Status start(const CameraRequest& request) override {
    stop();
    camera_ = std::make_unique<CameraBench<V4l2Camera>>(request);
    camera_->bench().environment().virtual_time = false;
    camera_->bench().configuration().user_pointers = user_pointers;
    set_text(camera_->bench().configuration().device, device);
    camera_->driver().use(calls);
    if (forbidden_ && seteuid(nobody) != 0) return Status::error(StatusCode::internal, "seteuid");
    return camera_->driver().initialise();
  }
  void stop() override {
    if (camera_ != nullptr) camera_->driver().stop();
  }
  Camera& camera() override { return camera_->driver(); }
  const CameraFeedback& feedback() override { return camera_->bench().feedback(); }
  SlotControl* slot() override { return camera_->slot(); }
  Status set_controls(std::string_view controls) override { return camera_->set_controls(controls); }
  void receive() override {
    pollfd wanted{camera_->driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 10);
    camera_->bench().receive(MonotonicClock::now() - camera_->bench().now());
  }
  Time now() const override { return camera_->bench().now(); }

  bool unplug() override { return vivid_.unplug(); }
  bool plug_in() override {
    vivid_.plug_in();
    return true;
  }
  bool fall_silent() override { return drop(100); }
  bool speak_again() override { return drop(0); }
  bool lose() override { return drop(40); }
  bool damage() override { return vivid_.set("Inject V4L2_BUF_FLAG_ERROR", 1); }
  bool occupy() override { return vivid_.occupy(); }
  bool let_go() override {
    vivid_.let_go();
    return true;
  }
  bool forbid() override {
    vivid_.plug_in();
    forbidden_ = true;
    return true;
  }
  bool has_sizes_of_its_own() const override { return true; }

  Vivid& vivid() { return vivid_; }

  WatchedCalls calls;
  const char* device = Vivid::path;
  bool user_pointers = true;

 private:
  bool drop(int percent) { return vivid_.set("Percentage of Dropped Buffers", percent); }

  Vivid vivid_;
  bool forbidden_ = false;
  std::unique_ptr<CameraBench<V4l2Camera>> camera_;
};

/// So many pictures one after the other; the last one, if they came.
std::optional<CameraImage> see(CameraEye& eye, int count) {
  std::optional<CameraImage> image;
  for (int i = 0; i < count; ++i)
    if (!(image = eye.next())) break;
  return image;
}

bool the_kernel_filled_what_the_reader_sees() {
  VividWorld world;
  if (!world.start({.into_slot = true})) return false;
  CameraEye eye(world);
  for (int i = 0; i < 30; ++i) {
    const auto image = eye.next();
    if (!image || !world.calls.has_queued(image->data.data())) return false;
  }
  print_message("%zu buffers queued, %llu pictures, %llu bytes copied\n", world.calls.count(),
                static_cast<unsigned long long>(world.feedback().frames),
                static_cast<unsigned long long>(world.feedback().copied_bytes));
  return world.feedback().copied_bytes == 0;
}

void user_pointers_copy_nothing(void**) {
  assert_true(the_kernel_filled_what_the_reader_sees());
}

/// Of a world in which the kernel does not fill the slot.
bool copies_each_picture_once(VividWorld& world) {
  if (!world.start({.into_slot = true})) return false;
  CameraEye eye(world);
  const auto image = see(eye, 10);
  const CameraFeedback& told = world.feedback();
  return image && told.copied_bytes == told.frames * image->data.size() && told.losses == 0;
}

bool mapped_buffers_cost_a_copy() {
  VividWorld world;
  world.user_pointers = false;
  return copies_each_picture_once(world);
}

bool refused_buffers_cost_a_copy(const char* control) {
  VividWorld world;
  return world.vivid().set(control, 1) && copies_each_picture_once(world);
}

void without_user_pointers_each_picture_is_copied_once(void**) {
  assert_true(mapped_buffers_cost_a_copy());
}

void where_user_pointers_are_refused_each_picture_is_copied_once(void**) {
  assert_true(refused_buffers_cost_a_copy("Inject VIDIOC_REQBUFS Error"));
  assert_true(refused_buffers_cost_a_copy("Inject VIDIOC_QBUF Error"));
}

bool it_is_found_by_its_name() {
  VividWorld world;
  world.device = Vivid::name;
  if (!world.start({})) return false;
  CameraEye eye(world);
  return eye.next().has_value();
}

void a_camera_is_found_by_its_name(void**) {
  assert_true(it_is_found_by_its_name());
}

/// After `failing` no pictures come, until it is begun anew.
template <class Failing>
bool it_is_begun_anew(const Failing& failing, std::string_view trouble) {
  VividWorld world;
  if (!world.start({.into_slot = true})) return false;
  CameraEye eye(world);
  if (!eye.next() || !failing(world)) return false;
  std::string told;
  if (!eye.until([&] {
        if (world.feedback().trouble[0] != '\0' && told.empty())
          told = std::string(text_view(world.feedback().trouble));
        return world.feedback().recoveries == 1;
      }))
    return false;
  print_message("%s\n", told.c_str());
  return told.find(trouble) != std::string::npos && eye.next() && world.feedback().losses == 1 &&
         world.camera().fault().is_ok();
}

void a_stream_that_the_driver_ends_is_begun_anew(void**) {
  assert_true(
      it_is_begun_anew([](VividWorld& world) { return world.vivid().set("Inject Fatal Streaming Error", 1); },
                       "failed (Input/output error); it is begun anew"));
}

void a_stream_that_refuses_a_buffer_is_begun_anew(void**) {
  assert_true(
      it_is_begun_anew([](VividWorld& world) { return world.vivid().set("Inject VIDIOC_QBUF Error", 1); },
                       "failed (Invalid argument); it is begun anew"));
}

bool a_stream_that_cannot_begin_is_refused_in_words() {
  VividWorld world;
  if (!world.vivid().set("Inject VIDIOC_STREAMON Error", 1)) return false;
  const Status status = world.start({.into_slot = true});
  print_message("%s\n", status.cause());
  if (status.code() != StatusCode::device_fault || std::strstr(status.cause(), "cannot stream") == nullptr)
    return false;
  if (!world.start({.into_slot = true})) return false;  // it refused but once
  CameraEye eye(world);
  return eye.next().has_value();
}

void a_stream_that_cannot_begin_is_refused(void**) {
  assert_true(a_stream_that_cannot_begin_is_refused_in_words());
}

bool a_control_refused_later_is_told_while_pictures_come() {
  VividWorld world;
  if (!world.start({})) return false;
  CameraEye eye(world);
  if (!eye.next()) return false;
  world.calls.refuse(VIDIOC_S_CTRL);
  if (!world.set_controls("brightness=50")) return false;
  if (!eye.until([&] { return world.feedback().trouble[0] != '\0'; })) return false;
  const std::string told(text_view(world.feedback().trouble));
  print_message("%s\n", told.c_str());
  if (told.find("refuses brightness=50") == std::string::npos || !world.feedback().present) return false;
  if (!world.set_controls("brightness=51")) return false;
  return eye.until([&] { return world.feedback().trouble[0] == '\0'; }) && eye.next();
}

void a_control_that_the_camera_refuses_injected_not_produced(void**) {
  assert_true(a_control_refused_later_is_told_while_pictures_come());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(user_pointers_copy_nothing),
      cmocka_unit_test(without_user_pointers_each_picture_is_copied_once),
      cmocka_unit_test(where_user_pointers_are_refused_each_picture_is_copied_once),
      cmocka_unit_test(a_camera_is_found_by_its_name),
      cmocka_unit_test(a_stream_that_the_driver_ends_is_begun_anew),
      cmocka_unit_test(a_stream_that_refuses_a_buffer_is_begun_anew),
      cmocka_unit_test(a_stream_that_cannot_begin_is_refused),
      cmocka_unit_test(a_control_that_the_camera_refuses_injected_not_produced),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_camera_conformance("v4l2 camera on vivid", []() -> std::unique_ptr<CameraWorld> {
           return std::make_unique<VividWorld>();
         });
}
