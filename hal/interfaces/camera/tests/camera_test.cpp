#include <cstring>
#include <string>

#include "hal/interfaces/camera/camera_controls.hpp"
#include "hal/interfaces/camera/camera_journal.hpp"
#include "hal/interfaces/camera/picture_size.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

CameraFeedback told(const CameraJournal& journal) {
  CameraFeedback feedback;
  journal.fill(feedback);
  return feedback;
}

void gaps_in_the_cameras_count_are_lost_pictures(void**) {
  CameraJournal journal;
  journal.restart("test");
  // What came before the first is not known to have been.
  assert_int_equal(journal.note_whole(7), 1);
  assert_int_equal(journal.note_whole(8), 2);
  assert_int_equal(journal.note_whole(12), 6);
  journal.note_damaged(13);
  assert_int_equal(journal.note_whole(14), 8);
  const CameraFeedback feedback = told(journal);
  assert_int_equal(feedback.frames, 4);
  assert_int_equal(feedback.lost_frames, 3);
  assert_int_equal(feedback.damaged_frames, 1);
}

void a_count_that_wraps_around_loses_nothing(void**) {
  CameraJournal journal;
  journal.restart("test");
  assert_int_equal(journal.note_whole(0xFFFF'FFFEU), 1);
  assert_int_equal(journal.note_whole(0xFFFF'FFFFU), 2);
  assert_int_equal(journal.note_whole(0), 3);
  assert_int_equal(journal.note_whole(2), 5);
  assert_int_equal(told(journal).lost_frames, 1);
}

void a_count_that_begins_anew_goes_on_for_readers(void**) {
  CameraJournal journal;
  journal.restart("test");
  journal.note_whole(100);
  journal.begin_stream();
  assert_int_equal(journal.note_whole(40), 2);
  // Also one of which nobody told.
  assert_int_equal(journal.note_whole(3), 3);
  assert_int_equal(journal.note_whole(3), 4);
  assert_int_equal(told(journal).lost_frames, 0);
}

void what_went_away_and_came_back_is_counted_once(void**) {
  CameraJournal journal;
  journal.restart("test");
  journal.note_away("not yet there");
  assert_int_equal(told(journal).losses, 0);
  journal.note_whole(0);
  assert_true(told(journal).present);
  assert_int_equal(told(journal).recoveries, 0);
  journal.note_trouble("a control was refused");
  journal.note_away("gone");
  journal.note_away("still gone");
  assert_string_equal(told(journal).trouble.data(), "still gone");
  assert_false(told(journal).present);
  journal.note_whole(0);
  const CameraFeedback feedback = told(journal);
  assert_int_equal(feedback.losses, 1);
  assert_int_equal(feedback.recoveries, 1);
  assert_string_equal(feedback.trouble.data(), "a control was refused");
}

void names_of_controls_are_words(void**) {
  assert_string_equal(control_name("White Balance, Automatic").data(), "white_balance_automatic");
  assert_string_equal(control_name("  Gain (dB) ").data(), "gain_db");
  assert_string_equal(control_name("").data(), "");
  const auto longest = control_name("A name that is by far too long for what holds it");
  assert_int_equal(text_view(longest).size(), 32);
}

bool refuses(const char* text, StatusCode code, const char* part) {
  CameraControl offered[3] = {};
  set_text(offered[0].name, "gain");
  offered[0].maximum = 10;
  set_text(offered[1].name, "temperature");
  offered[1].read_only = true;
  const Status status = check_settings(offered, text);
  if (status.code() == code && std::strstr(status.cause(), part) != nullptr) return true;
  print_message("expected '%s' in: %s\n", part, status.cause());
  return false;
}

void settings_are_checked_against_what_is_offered(void**) {
  assert_true(refuses("gain=10, gain=0", StatusCode::ok, ""));
  assert_true(refuses("  ", StatusCode::ok, ""));
  assert_true(refuses("gain=11", StatusCode::out_of_range, "takes 0 to 10, not 11"));
  assert_true(refuses("gian=1", StatusCode::not_found, "no control 'gian'; it has: gain temperature"));
  assert_true(refuses("temperature=1", StatusCode::not_permitted, "only be looked at"));
  for (const char* text : {"gain", "gain=", "=3", "gain=3x", "gain=99999999999"})
    assert_true(refuses(text, StatusCode::invalid_argument, "NAME=VALUE"));
}

void settings_keep_their_order(void**) {
  const auto settings = CameraSettings::parse("exposure_auto=1,exposure=-250");
  assert_true(static_cast<bool>(settings));
  assert_int_equal(settings->all().size(), 2);
  assert_int_equal(settings->all()[0].value, 1);
  assert_int_equal(settings->all()[1].value, -250);
}

void as_many_names_as_fit_are_told(void**) {
  std::array<CameraControl, 24> offered{};
  for (std::size_t i = 0; i < offered.size(); ++i)
    set_text(offered[i].name, "a_control_of_many_" + std::to_string(i));
  const Status status = check_settings(offered, "warp=9");
  assert_int_equal(status.code(), StatusCode::not_found);
  assert_non_null(std::strstr(status.cause(), "a_control_of_many_0 "));
  assert_non_null(std::strstr(status.cause(), " ..."));
}

void pictures_that_do_not_fit_are_refused(void**) {
  assert_int_equal(check_picture(1280, 720, PixelFormat::yuyv).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 720, PixelFormat::rgb24).code(), StatusCode::out_of_range);
  assert_int_equal(check_picture(639, 480, PixelFormat::yuyv).code(), StatusCode::invalid_argument);
  assert_int_equal(check_picture(639, 480, PixelFormat::grey8).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 960, PixelFormat::nv12).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 962, PixelFormat::nv12).code(), StatusCode::out_of_range);
  assert_int_equal(check_picture(640, 481, PixelFormat::nv12).code(), StatusCode::invalid_argument);
  assert_int_equal(check_picture(639, 480, PixelFormat::nv12).code(), StatusCode::invalid_argument);
  assert_int_equal(check_picture(640, 480, PixelFormat::bgr24).code(), StatusCode::invalid_argument);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(gaps_in_the_cameras_count_are_lost_pictures),
      cmocka_unit_test(a_count_that_wraps_around_loses_nothing),
      cmocka_unit_test(a_count_that_begins_anew_goes_on_for_readers),
      cmocka_unit_test(what_went_away_and_came_back_is_counted_once),
      cmocka_unit_test(names_of_controls_are_words),
      cmocka_unit_test(settings_are_checked_against_what_is_offered),
      cmocka_unit_test(settings_keep_their_order),
      cmocka_unit_test(as_many_names_as_fit_are_told),
      cmocka_unit_test(pictures_that_do_not_fit_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
