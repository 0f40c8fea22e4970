// The real driver on the kernel's virtual camera, vivid: the conformance suite, bytes that are not copied,
// and faults as far as vivid makes them; what it does not make is injected, and its test says so.
#include <linux/videodev2.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/v4l2/tests/vivid_world.hpp"
#include "tests/cmocka.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

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

/// Each row is the same as the one above it, as vivid's bars are below its text, from white to black; and
/// colour comes where it should.
bool bars_stand_upright(const CameraImage& image) {
  const std::uint8_t* const row = image.data.data() + std::size_t{image.height - 1} * image.stride;
  const std::uint8_t* const colour = row + std::size_t{image.height / 2} * image.stride;
  for (std::ptrdiff_t up = 1; up < image.height / 8; ++up) {
    if (std::memcmp(row, row - up * image.stride, image.width) != 0 ||
        std::memcmp(colour, colour - up * image.stride, image.width) != 0)
      return false;
  }
  const auto is_grey = [](const std::uint8_t* square) {
    return std::abs(square[0] - 128) < 8 && std::abs(square[1] - 128) < 8;
  };
  const std::size_t bar = image.width / 8;
  const std::uint8_t* const yellow = colour + (bar + bar / 2) / 2 * 2;
  return row[bar / 2] > 150 && row[image.width - bar / 2] < 50 && is_grey(colour + bar / 2 / 2 * 2) &&
         yellow[0] < 90 && is_grey(colour + (image.width - bar / 2) / 2 * 2);
}

bool nv12_is_right(std::uint32_t padding, bool user_pointers, bool into_slot) {
  VividWorld world;
  world.calls.padding = padding;
  world.user_pointers = user_pointers;
  if (!world.start({.format = PixelFormat::nv12, .into_slot = into_slot})) return false;
  CameraEye eye(world);
  const auto image = see(eye, 3);
  if (!image) return false;
  print_message("stride %u: %zu bytes, %llu copied\n", image->stride, image->data.size(),
                static_cast<unsigned long long>(world.feedback().copied_bytes));
  const bool is_copied = world.feedback().copied_bytes != 0;
  return image->stride == image->width + padding && bars_stand_upright(*image) &&
         is_copied == (into_slot && !user_pointers);
}

void nv12_is_right_however_far_apart_its_rows_are(void**) {
  for (const std::uint32_t padding : {0U, 7U, 64U}) {
    assert_true(nv12_is_right(padding, true, true));
    assert_true(nv12_is_right(padding, false, true));
    assert_true(nv12_is_right(padding, false, false));
  }
}

bool it_has_planes(PixelFormat format, bool user_pointers, bool into_slot) {
  VividWorld world;
  world.device = Vivid::path_with_planes;
  world.user_pointers = user_pointers;
  if (const Status status = world.start({.format = format, .into_slot = into_slot}); !status) {
    print_message("%s\n", status.cause());
    return false;
  }
  CameraEye eye(world);
  const auto image = see(eye, 10);
  const bool is_copied = world.feedback().copied_bytes != 0;
  return image && is_copied == (into_slot && !user_pointers) && world.feedback().damaged_frames == 0 &&
         (format != PixelFormat::nv12 || bars_stand_upright(*image));
}

void a_device_of_planes_gives_pictures_as_any_other(void**) {
  for (const PixelFormat format : {PixelFormat::nv12, PixelFormat::uyvy, PixelFormat::grey16}) {
    assert_true(it_has_planes(format, true, true));
    assert_true(it_has_planes(format, false, true));
    assert_true(it_has_planes(format, false, false));
  }
}

bool television_is_told_to_be_interlaced() {
  VividWorld world;
  if (!world.vivid().choose_input(1)) return false;
  if (const Status status = world.start({.width = 720, .height = 576, .into_slot = true}); !status) {
    print_message("%s\n", status.cause());
    return false;
  }
  CameraEye eye(world);
  if (!see(eye, 5)) return false;
  const std::string told(text_view(world.feedback().trouble));
  print_message("%s\n", told.c_str());
  return world.feedback().present && told.find("is interlaced") != std::string::npos;
}

void an_interlaced_input_is_told(void**) {
  assert_true(television_is_told_to_be_interlaced());
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

/// It comes back and cannot be used, until that is over: neither it nor its unit is in fault.
template <class Hinder, class Help>
bool is_told_and_taken(const Hinder& hinder, const Help& help, std::string_view trouble) {
  VividWorld world;
  if (!world.start({.into_slot = true})) return false;
  CameraEye eye(world);
  if (!eye.next() || !world.unplug() || !eye.until([&] { return !world.feedback().present; })) return false;
  hinder(world);
  if (!world.plug_in() ||
      !eye.until([&] { return text_view(world.feedback().trouble).find(trouble) != std::string_view::npos; }))
    return false;
  print_message("%s\n", std::string(text_view(world.feedback().trouble)).c_str());
  if (eye.see() || world.feedback().present || !world.camera().fault().is_ok()) return false;
  help(world);
  const Time since = world.now();
  return eye.next() && is_back_in_time("what hindered it", world.now() - since) &&
         world.feedback().trouble[0] == '\0' && world.feedback().recoveries == 1;
}

void a_right_that_is_missing_once_it_is_back_is_told(void**) {
  assert_true(is_told_and_taken([](VividWorld& world) { world.deny(); },
                                [](VividWorld& world) { world.permit(); }, "no permission"));
}

void a_format_that_it_refuses_once_it_is_back_is_told_injected_not_produced(void**) {
  assert_true(is_told_and_taken([](VividWorld& world) { world.calls.refuse(VIDIOC_S_FMT, true); },
                                [](VividWorld& world) { world.calls.refuse(0); },
                                "does not give 640x360 yuyv"));
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
      cmocka_unit_test(nv12_is_right_however_far_apart_its_rows_are),
      cmocka_unit_test(a_device_of_planes_gives_pictures_as_any_other),
      cmocka_unit_test(an_interlaced_input_is_told),
      cmocka_unit_test(a_camera_is_found_by_its_name),
      cmocka_unit_test(a_stream_that_the_driver_ends_is_begun_anew),
      cmocka_unit_test(a_stream_that_refuses_a_buffer_is_begun_anew),
      cmocka_unit_test(a_right_that_is_missing_once_it_is_back_is_told),
      cmocka_unit_test(a_format_that_it_refuses_once_it_is_back_is_told_injected_not_produced),
      cmocka_unit_test(a_stream_that_cannot_begin_is_refused),
      cmocka_unit_test(a_control_that_the_camera_refuses_injected_not_produced),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_camera_conformance("v4l2 camera on vivid", []() -> std::unique_ptr<CameraWorld> {
           return std::make_unique<VividWorld>();
         });
}
