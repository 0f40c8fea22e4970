// The cell of apps/visual-servoing with a bad camera, in virtual time: what its operator reads, that the arm
// holds where it should, and how it goes on.
#include <array>

#include "tests/visual_servoing/trouble.hpp"

namespace flexrf::visual_servoing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct BadPictures {
  CameraFault fault = CameraFault::none;
  PickerState during = PickerState::approaching;
  PictureState told = PictureState::good;
  const char* trouble = "";       ///< told by features, in the log, and by the picker
  const char* message = nullptr;  ///< by the picker, where that says it otherwise
  Duration lasts = seconds(1);
};

void the_arm_holds_until_pictures_are_good(const BadPictures& bad) {
  Trouble trouble;
  trouble.cell.when_in(bad.during)
      .after(milliseconds(100), [&] { trouble.give_camera(bad.fault); })
      .when_in(PickerState::no_sight)
      .after(braking, [&] { trouble.begin_stillness(); })
      .after(bad.lasts,
             [&] {
               trouble.check_stillness();
               CHECK_EQUAL(trouble.picker.state, PickerState::no_sight);
               trouble.check_message("The camera tells nothing, the arm holds: ", "See to the camera");
               CHECK_CONTAINS(trouble.picker.message_view(),
                              bad.message != nullptr ? bad.message : bad.trouble);
               CHECK_EQUAL(trouble.features.state, bad.told);
               CHECK_CONTAINS(trouble.features.trouble_view(), bad.trouble);
               CHECK_CONTAINS(trouble.robot.holding_view(), "the arm holds");
               CHECK_EQUAL(trouble.camera.present, bad.fault != CameraFault::unplugged);
               if (!trouble.camera.present)
                 CHECK_CONTAINS(trouble.camera.trouble_view(), "is it plugged in?");
               trouble.remember();
               trouble.give_camera(CameraFault::none);
             })
      .when(
          "all is well", [&] { return trouble.features.state == PictureState::good; },
          [&] { CHECK_EQUAL(trouble.features.trouble_view(), ""); })
      .when("it goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), 0);
  CHECK(was_said(bad.trouble));
  CHECK(was_said("pictures are good again"));
}

// [trouble-1]
void no_camera() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::unplugged,
                                         .during = PickerState::approaching,
                                         .told = PictureState::silent,
                                         .trouble = "no picture comes"});
  CHECK(was_said("is it plugged in?"));
}

// [trouble-2]
void black_pictures_on_the_way_down() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::black,
                                         .during = PickerState::descending,
                                         .told = PictureState::black,
                                         .trouble = "is the lens covered, or the light out?"});
}

// [trouble-3]
void a_frozen_picture_with_a_part_in_hand() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::frozen,
                                         .during = PickerState::carrying,
                                         .told = PictureState::frozen,
                                         .trouble = "the camera repeats a picture"});
}

// [trouble-4]
void pictures_of_the_wrong_size() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::wrong_size,
                                         .during = PickerState::surveying,
                                         .told = PictureState::wrong_format,
                                         .trouble = "not rgb24 of 640x480"});
}

// [trouble-5]
void noise_as_a_part_is_lifted() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::noise,
                                         .during = PickerState::lifting,
                                         .told = PictureState::noise,
                                         .trouble = "the picture is noise"});
}

/// It does not go a bit with each.
// [trouble-6]
void one_picture_a_second() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::low_frame_rate,
                                         .during = PickerState::approaching,
                                         .told = PictureState::silent,
                                         .trouble = "pictures come too seldom",
                                         .message = "come too seldom",
                                         .lasts = milliseconds(2400)});
}

/// Values of the page *Table*, and what is said by them.
struct Light {
  double intensity = 1;
  double elevation = 1.1;
  std::array<double, 3> tint{};
  PictureState told = PictureState::good;
  const char* message = "";
};

void the_arm_holds_until_the_light_is_good(const Light& light) {
  Trouble trouble;
  const auto give = [&](const Light& given) {
    trouble.cell.set("table", "light_intensity", given.intensity);
    trouble.cell.set("table", "light_elevation", given.elevation);
    trouble.cell.set("table", "light_tint", given.tint);
  };
  trouble.cell.when_in(PickerState::approaching, [&] { give(light); })
      .when_in(PickerState::no_sight)
      .after(braking, [&] { trouble.begin_stillness(); })
      .after(seconds(1),
             [&] {
               trouble.check_stillness();
               CHECK_EQUAL(trouble.picker.state, PickerState::no_sight);
               trouble.check_message("The camera tells nothing, the arm holds: ", "See to the camera");
               CHECK_CONTAINS(trouble.picker.message_view(), light.message);
               CHECK_EQUAL(trouble.features.state, light.told);
               trouble.remember();
               give({});
             })
      .when("it goes on", [&] { return trouble.has_gone_on(); });
  CHECK_EQUAL(trouble.run(), 0);
}

// [trouble-14]
void light_that_is_too_dark() {
  the_arm_holds_until_the_light_is_good(
      {.intensity = 0.2, .elevation = 0.5, .told = PictureState::too_dark, .message = "too dark to tell"});
}

// [trouble-14]
void light_that_is_too_bright() {
  the_arm_holds_until_the_light_is_good({.intensity = 2,
                                         .elevation = 1.57,
                                         .told = PictureState::too_bright,
                                         .message = "colours are saturated"});
}

// [trouble-14]
void coloured_light() {
  the_arm_holds_until_the_light_is_good(
      {.tint = {0.5, -0.5, -0.5}, .told = PictureState::colour_cast, .message = "light is coloured"});
}

// [trouble-15]
void blurred_pictures() {
  the_arm_holds_until_pictures_are_good({.fault = CameraFault::blurred,
                                         .during = PickerState::descending,
                                         .told = PictureState::blurred,
                                         .trouble = "the picture is blurred: look at the lens"});
}

/// Each second one is used.
// [trouble-7]
void pictures_out_of_order() {
  Trouble trouble;
  std::uint64_t used = 0;
  std::uint64_t refused = 0;
  const auto is_told = [&] {
    CHECK_EQUAL(trouble.features.state, PictureState::out_of_order);
    CHECK_CONTAINS(trouble.features.trouble_view(), "older than one that came before it");
  };
  trouble.cell.when_in(PickerState::approaching)
      .after(milliseconds(100), [&] { trouble.give_camera(CameraFault::out_of_order); })
      .after(milliseconds(200),
             [&] {
               is_told();
               used = trouble.features.pictures;
               refused = trouble.features.refused;
               trouble.remember();
             })
      .after(seconds(1),
             [&] {
               is_told();
               CHECK(trouble.features.pictures > used + 10);
               CHECK(trouble.features.refused > refused + 10);
             })
      .when(
          "it has brought a part away", [&] { return trouble.has_binned(); },
          [&] {
            is_told();
            trouble.give_camera(CameraFault::none);
          })
      .when("all is well", [&] { return trouble.features.state == PictureState::good; });
  CHECK_EQUAL(trouble.run(), 0);
  CHECK(was_said("older than one that came before it"));
}

}  // namespace
}  // namespace flexrf::visual_servoing

int main() {
  using namespace flexrf::visual_servoing;
  const CMUnitTest tests[] = {
      TEST_APART(no_camera),
      TEST_APART(black_pictures_on_the_way_down),
      TEST_APART(a_frozen_picture_with_a_part_in_hand),
      TEST_APART(pictures_of_the_wrong_size),
      TEST_APART(noise_as_a_part_is_lifted),
      TEST_APART(one_picture_a_second),
      TEST_APART(light_that_is_too_dark),
      TEST_APART(light_that_is_too_bright),
      TEST_APART(coloured_light),
      TEST_APART(blurred_pictures),
      TEST_APART(pictures_out_of_order),
  };
  return cmocka_run_group_tests_name("visual servoing with a bad camera", tests, nullptr, nullptr);
}
