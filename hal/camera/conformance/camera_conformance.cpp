#include "hal/camera/conformance/camera_conformance.hpp"

#include <cstring>

#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/conformance/mjpeg_cases.hpp"
#include "hal/camera/interface/camera_controls.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "tests/conformance.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

MakeCameraWorld make_world = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
void judge(Verdict (*run)(CameraWorld&)) {
  Verdict result = Verdict::failed;
  {
    const std::unique_ptr<CameraWorld> world = make_world();
    result = run(*world);
    if (result == Verdict::failed) {
      const CameraFeedback& told = world->feedback();
      print_message("trouble: %.240s; %s; %d frames, %d lost, %d damaged, away %d times and %d times back\n",
                    told.trouble.data(), told.present ? "there" : "away", static_cast<int>(told.frames),
                    static_cast<int>(told.lost_frames), static_cast<int>(told.damaged_frames),
                    static_cast<int>(told.losses), static_cast<int>(told.recoveries));
    }
    world->stop();
  }
  conclude(result);
}

bool said(const Status& status, StatusCode code, const char* part) {
  if (status.code() == code && std::strstr(status.cause(), part) != nullptr) return true;
  print_message("expected '%s' in: %s\n", part, status.cause());
  return false;
}

bool trouble_says(CameraWorld& world, std::string_view part) {
  return text_view(world.feedback().trouble).find(part) != std::string_view::npos;
}

/// The cause is gone as of the last cycle, and a picture comes in time.
std::optional<CameraImage> sees_again(CameraWorld& world, CameraEye& eye, const char* from) {
  const Time since = world.now();
  auto image = eye.next();
  if (!is_back_in_time(from, world.now() - since)) image.reset();
  return image;
}

bool is_as_asked(const CameraImage& image, const CameraRequest& request) {
  const std::uint32_t row = row_bytes(request.format, request.width);
  const std::uint32_t rows = data_rows(request.format, request.height);
  return image.width == request.width && image.height == request.height && image.format == request.format &&
         image.stride >= row && image.data.size() >= std::size_t{image.stride} * (rows - 1) + row;
}

Verdict pictures_are_as_asked(CameraWorld& world, bool into_slot) {
  for (const PixelFormat format : camera_formats) {
    if (format == PixelFormat::mjpeg) continue;  // has cases of its own
    const CameraRequest request{.format = format, .into_slot = into_slot};
    if (const Status status = world.start(request); !status) {
      print_message("%s\n", status.cause());
      return Verdict::failed;
    }
    CameraEye eye(world);
    const auto image = eye.next();
    if (!image || !is_as_asked(*image, request) || !world.feedback().present) return Verdict::failed;
  }
  return Verdict::passed;
}

// [camera-3]
Verdict a_unit_sees_pictures_as_it_asked(CameraWorld& world) {
  return pictures_are_as_asked(world, false);
}

// [camera-2]
Verdict a_slot_gets_pictures_as_asked(CameraWorld& world) {
  return pictures_are_as_asked(world, true);
}

Verdict times_and_sequences_rise(CameraWorld& world, bool into_slot) {
  // A camera may stamp the end of an exposure that it announces when it begins.
  constexpr Duration ahead = std::chrono::milliseconds(200);
  if (!world.start({.into_slot = into_slot})) return Verdict::failed;
  CameraEye eye(world);
  world.receive();
  Time before = world.now() - ahead;
  std::uint64_t sequence = 0;
  bool changes = false;
  std::uint64_t sum = 0;
  for (int i = 0; i < 10; ++i) {
    const auto image = eye.next();
    if (!image || image->time <= before || image->time > world.now() + ahead || image->sequence <= sequence)
      return Verdict::failed;
    if (into_slot && world.camera().frame()) return Verdict::failed;
    changes = changes || (i > 0 && checksum(*image) != sum);
    sum = checksum(*image);
    before = image->time;
    sequence = image->sequence;
  }
  return verdict(changes && world.feedback().frames >= 10);
}

// [camera-1]
Verdict a_units_pictures_are_in_order(CameraWorld& world) {
  return times_and_sequences_rise(world, false);
}

// [camera-1] [camera-6]
Verdict a_slots_pictures_are_in_order(CameraWorld& world) {
  return times_and_sequences_rise(world, true);
}

// [camera-5]
Verdict a_picture_is_given_for_one_cycle(CameraWorld& world) {
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  const auto image = eye.next();
  const auto again = world.camera().frame();
  if (!image || !again || again->sequence != image->sequence) return Verdict::failed;
  return verdict(eye.until([&] { return !world.camera().frame(); }));
}

// [camera-2]
Verdict a_picture_that_is_held_does_not_change(CameraWorld& world) {
  if (!world.start({.into_slot = true})) return Verdict::failed;
  CameraEye eye(world);
  const auto image = eye.next();
  if (!image) return Verdict::failed;
  const std::uint64_t sum = checksum(*image);
  const std::uint64_t sequence = image->sequence;
  const std::uint64_t frames = world.feedback().frames;
  if (!eye.until([&] { return world.feedback().frames >= frames + 12; })) return Verdict::failed;
  if (checksum(*image) != sum || image->sequence != sequence) return Verdict::failed;
  const auto newer = eye.see();
  return verdict(newer && newer->sequence >= sequence + 12);
}

Verdict no_byte_is_copied(CameraWorld& world) {
  for (const bool into_slot : {false, true}) {
    if (!world.start({.into_slot = into_slot})) return Verdict::failed;
    CameraEye eye(world);
    for (int i = 0; i < 10; ++i)
      if (!eye.next()) return Verdict::failed;
    if (world.feedback().copied_bytes != 0) return Verdict::failed;
  }
  return Verdict::passed;
}

Verdict lost_pictures_are_counted(CameraWorld& world) {
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.next()) return Verdict::failed;
  const std::uint64_t before = world.feedback().lost_frames;
  if (!world.lose()) return Verdict::skipped;
  return verdict(eye.until([&] { return world.feedback().lost_frames > before; }) && eye.next() &&
                 world.feedback().losses == 0);
}

Verdict a_damaged_picture_is_counted_and_not_shown(CameraWorld& world) {
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.next()) return Verdict::failed;
  const std::uint64_t lost = world.feedback().lost_frames;
  if (!world.damage()) return Verdict::skipped;
  std::uint64_t seen = 0;
  if (!eye.until([&] {
        if (const auto image = world.camera().frame()) seen = image->sequence;
        return world.feedback().damaged_frames > 0;
      }))
    return Verdict::failed;
  const auto next = eye.next();
  return verdict(next && next->sequence >= seen + 2 && world.feedback().lost_frames >= lost &&
                 world.feedback().present);
}

Verdict a_picture_that_fits_nowhere_is_refused(CameraWorld& world) {
  return verdict(said(world.start({.width = 8192, .height = 8192, .into_slot = true}),
                      StatusCode::out_of_range, "elements = 134217728 into the row of the slot") &&
                 said(world.start({.width = 641}), StatusCode::invalid_argument, "even") &&
                 said(world.start({.height = 361, .format = PixelFormat::nv12}), StatusCode::invalid_argument,
                      "height are even") &&
                 said(world.start({.format = PixelFormat::bgr24}), StatusCode::invalid_argument, "rgb24"));
}

/// The largest picture is the slot's own; what is one byte larger is refused.
Verdict a_slot_may_have_room_for_full_hd(CameraWorld& world) {
  CameraRequest request{.width = 1920, .height = 1080, .into_slot = true, .elements = 1920 * 1080 * 2 - 1};
  if (!said(world.start(request), StatusCode::out_of_range, "elements = 4147200")) return Verdict::failed;
  ++request.elements;
  if (const Status status = world.start(request); !status) {
    print_message("%s\n", status.cause());
    return Verdict::failed;
  }
  CameraEye eye(world);
  for (int i = 0; i < 5; ++i) {
    const auto image = eye.next();
    if (!image || !is_as_asked(*image, request)) return Verdict::failed;
  }
  return verdict(world.feedback().copied_bytes == 0 && world.feedback().damaged_frames == 0);
}

Verdict a_unit_sees_full_hd_without_a_slot(CameraWorld& world) {
  const CameraRequest request{.width = 1920, .height = 1080, .format = PixelFormat::rgb24};
  if (const Status status = world.start(request); !status) {
    print_message("%s\n", status.cause());
    return Verdict::failed;
  }
  CameraEye eye(world);
  const auto image = eye.next();
  return verdict(image && is_as_asked(*image, request));
}

Verdict a_size_that_is_not_offered_is_refused_with_those_that_are(CameraWorld& world) {
  if (!world.has_sizes_of_its_own()) return Verdict::skipped;
  if (!said(world.start({.width = 642, .height = 362}), StatusCode::invalid_argument, "640x360"))
    return Verdict::failed;
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  return verdict(eye.next().has_value());
}

std::optional<std::int32_t> brightness_of(CameraWorld& world) {
  const CameraControl* const control = find_control(world.feedback().controls, "brightness");
  if (control == nullptr) return std::nullopt;
  return control->value;
}

Verdict controls_are_found_and_set(CameraWorld& world) {
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.next()) return Verdict::failed;
  const CameraControl* const found = find_control(world.feedback().controls, "brightness");
  if (found == nullptr || found->kind != CameraControlKind::integer || found->minimum >= found->maximum ||
      found->value != found->default_value)
    return Verdict::failed;
  if (!world.set_controls("brightness=77")) return Verdict::failed;
  return verdict(eye.until([&] { return brightness_of(world) == 77; }) && eye.next());
}

Verdict a_control_that_cannot_be_set_is_refused(CameraWorld& world) {
  if (!world.start({.controls = "brightness=20"})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.until([&] { return brightness_of(world) == 20; })) return Verdict::failed;
  return verdict(said(world.set_controls("brightness=30 warp=9"), StatusCode::not_found, "brightness") &&
                 said(world.set_controls("brightness=99999"), StatusCode::out_of_range, "99999") &&
                 said(world.set_controls("brightness"), StatusCode::invalid_argument, "NAME=VALUE") &&
                 eye.next() && brightness_of(world) == 20);
}

Verdict an_unknown_control_is_refused_at_the_start(CameraWorld& world) {
  return verdict(said(world.start({.controls = "warp=9"}), StatusCode::not_found, "brightness"));
}

Verdict it_comes_back(CameraWorld& world, bool into_slot) {
  if (!world.start({.controls = "brightness=20", .into_slot = into_slot})) return Verdict::failed;
  CameraEye eye(world);
  const auto first = eye.next();
  if (!first) return Verdict::failed;
  const std::uint64_t sequence = first->sequence;
  if (!world.unplug()) return Verdict::skipped;
  if (!eye.until([&] { return !world.feedback().present; })) return Verdict::failed;
  if (world.feedback().losses != 1 || world.feedback().trouble[0] == '\0' || !world.camera().fault().is_ok())
    return Verdict::failed;
  for (int i = 0; i < 20; ++i) {
    world.receive();
    if (world.camera().frame()) return Verdict::failed;
  }
  if (!world.plug_in()) return Verdict::failed;
  const auto again = sees_again(world, eye, "its absence");
  return verdict(again && again->sequence > sequence && world.feedback().present &&
                 world.feedback().recoveries == 1 && world.feedback().trouble[0] == '\0' &&
                 brightness_of(world) == 20);
}

// [camera-4]
Verdict a_camera_of_a_unit_that_went_away_comes_back(CameraWorld& world) {
  return it_comes_back(world, false);
}

// [camera-4]
Verdict a_camera_with_a_slot_that_went_away_comes_back(CameraWorld& world) {
  return it_comes_back(world, true);
}

// [camera-4]
Verdict a_camera_that_is_missing_at_the_start_may_come_later(CameraWorld& world) {
  if (!world.unplug()) return Verdict::skipped;
  if (!world.start({.into_slot = true})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.until([&] { return world.feedback().trouble[0] != '\0'; }) || world.feedback().present)
    return Verdict::failed;
  if (!world.plug_in() || !sees_again(world, eye, "its absence at the start")) return Verdict::failed;
  return verdict(world.feedback().present && world.feedback().losses == 0);
}

Verdict a_camera_in_use_is_told_and_taken_once_it_is_free(CameraWorld& world) {
  if (!world.occupy()) return Verdict::skipped;
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.until([&] { return trouble_says(world, "in use"); })) return Verdict::failed;
  return verdict(world.let_go() && sees_again(world, eye, "another user's time") &&
                 world.feedback().trouble[0] == '\0');
}

Verdict a_missing_right_is_told(CameraWorld& world) {
  if (!world.forbid()) return Verdict::skipped;
  if (!said(world.start({}), StatusCode::not_permitted, "")) return Verdict::failed;
  world.permit();
  if (!world.start({})) return Verdict::failed;
  CameraEye eye(world);
  return verdict(eye.next().has_value());
}

// [camera-4]
Verdict a_silent_camera_is_told_and_begun_anew(CameraWorld& world) {
  if (!world.start({.silence = 1})) return Verdict::failed;
  CameraEye eye(world);
  if (!eye.next()) return Verdict::failed;
  if (!world.fall_silent()) return Verdict::skipped;
  if (!eye.until([&] { return !world.feedback().present; }) || !trouble_says(world, "no pictures"))
    return Verdict::failed;
  return verdict(world.speak_again() && sees_again(world, eye, "its silence") &&
                 world.feedback().losses == 1 && world.feedback().recoveries == 1);
}

Verdict it_can_be_stopped_and_started_again(CameraWorld& world) {
  for (int i = 0; i < 3; ++i) {
    if (!world.start({.into_slot = i % 2 == 0})) return Verdict::failed;
    CameraEye eye(world);
    const auto image = eye.next();
    if (!image || world.feedback().losses != 0) return Verdict::failed;
    world.stop();
  }
  return Verdict::passed;
}

template <Verdict (*Run)(CameraWorld&)>
void judged(void**) {
  judge(Run);
}

}  // namespace

int run_camera_conformance(const char* driver, MakeCameraWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(a_unit_sees_pictures_as_it_asked),
      CASE(a_slot_gets_pictures_as_asked),
      CASE(a_unit_sees_compressed_pictures),
      CASE(a_slot_gets_compressed_pictures),
      CASE(half_a_compressed_picture_is_counted_and_not_shown),
      CASE(a_units_pictures_are_in_order),
      CASE(a_slots_pictures_are_in_order),
      CASE(a_picture_is_given_for_one_cycle),
      CASE(a_picture_that_is_held_does_not_change),
      CASE(no_byte_is_copied),
      CASE(lost_pictures_are_counted),
      CASE(a_damaged_picture_is_counted_and_not_shown),
      CASE(a_picture_that_fits_nowhere_is_refused),
      CASE(a_slot_may_have_room_for_full_hd),
      CASE(a_unit_sees_full_hd_without_a_slot),
      CASE(a_size_that_is_not_offered_is_refused_with_those_that_are),
      CASE(controls_are_found_and_set),
      CASE(a_control_that_cannot_be_set_is_refused),
      CASE(an_unknown_control_is_refused_at_the_start),
      CASE(a_camera_of_a_unit_that_went_away_comes_back),
      CASE(a_camera_with_a_slot_that_went_away_comes_back),
      CASE(a_camera_that_is_missing_at_the_start_may_come_later),
      CASE(a_camera_in_use_is_told_and_taken_once_it_is_free),
      CASE(a_missing_right_is_told),
      CASE(a_silent_camera_is_told_and_begun_anew),
      CASE(it_can_be_stopped_and_started_again),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
