#include <cstring>
#include <string>
#include <vector>

#include "hal/camera/interface/camera_controls.hpp"
#include "hal/camera/interface/camera_journal.hpp"
#include "hal/camera/interface/jpeg_check.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

CameraFeedback told(const CameraJournal& journal) {
  CameraFeedback feedback;
  journal.fill(feedback);
  return feedback;
}

// [camera-1]
void gaps_in_the_cameras_count_are_lost_pictures(void**) {
  CameraJournal journal;
  journal.restart("test");
  // What came before the first is not known to have been.
  assert_int_equal(journal.note_whole(7), 1);
  assert_int_equal(journal.note_whole(8), 2);
  assert_int_equal(journal.note_whole(12), 6);
  journal.note_damaged(13, "too short");
  assert_int_equal(journal.note_whole(14), 8);
  const CameraFeedback feedback = told(journal);
  assert_int_equal(feedback.frames, 4);
  assert_int_equal(feedback.lost_frames, 3);
  assert_int_equal(feedback.damaged_frames, 1);
  assert_string_equal(feedback.damage.data(), "too short");
}

// [camera-journal-1]
void a_count_that_wraps_around_loses_nothing(void**) {
  CameraJournal journal;
  journal.restart("test");
  assert_int_equal(journal.note_whole(0xFFFF'FFFEU), 1);
  assert_int_equal(journal.note_whole(0xFFFF'FFFFU), 2);
  assert_int_equal(journal.note_whole(0), 3);
  assert_int_equal(journal.note_whole(2), 5);
  assert_int_equal(told(journal).lost_frames, 1);
}

// [camera-1]
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

// [camera-journal-2]
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

// [camera-controls-3]
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

// [camera-controls-1]
void settings_are_checked_against_what_is_offered(void**) {
  assert_true(refuses("gain=10, gain=0", StatusCode::ok, ""));
  assert_true(refuses("  ", StatusCode::ok, ""));
  assert_true(refuses("gain=11", StatusCode::out_of_range, "takes 0 to 10, not 11"));
  assert_true(refuses("gian=1", StatusCode::not_found, "no control 'gian'; it has: gain temperature"));
  assert_true(refuses("temperature=1", StatusCode::not_permitted, "only be looked at"));
  for (const char* text : {"gain", "gain=", "=3", "gain=3x", "gain=99999999999"})
    assert_true(refuses(text, StatusCode::invalid_argument, "NAME=VALUE"));
}

// [camera-controls-2]
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

// [picture-size-1]
void pictures_that_do_not_fit_are_refused(void**) {
  assert_int_equal(check_picture(1280, 720, PixelFormat::yuyv, usual_picture_bytes).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 720, PixelFormat::rgb24, usual_picture_bytes).code(),
                   StatusCode::out_of_range);
  assert_int_equal(check_picture(639, 480, PixelFormat::yuyv, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  assert_int_equal(check_picture(639, 480, PixelFormat::grey8, usual_picture_bytes).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 960, PixelFormat::nv12, usual_picture_bytes).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 962, PixelFormat::nv12, usual_picture_bytes).code(),
                   StatusCode::out_of_range);
  assert_int_equal(check_picture(640, 481, PixelFormat::nv12, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  assert_int_equal(check_picture(639, 480, PixelFormat::nv12, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  assert_int_equal(check_picture(640, 480, PixelFormat::bgr24, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  assert_int_equal(check_picture(1280, 720, PixelFormat::uyvy, usual_picture_bytes).code(), StatusCode::ok);
  assert_int_equal(check_picture(639, 480, PixelFormat::uyvy, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  assert_int_equal(check_picture(639, 480, PixelFormat::grey16, usual_picture_bytes).code(), StatusCode::ok);
  assert_int_equal(check_picture(1280, 960, PixelFormat::grey16, usual_picture_bytes).code(),
                   StatusCode::out_of_range);
  assert_int_equal(check_picture(1280, 960, PixelFormat::bayer_bggr8, usual_picture_bytes).code(),
                   StatusCode::ok);
  assert_int_equal(check_picture(640, 481, PixelFormat::bayer_rggb8, usual_picture_bytes).code(),
                   StatusCode::invalid_argument);
  // Of a slot with room for it, and without one.
  assert_int_equal(check_picture(1920, 1080, PixelFormat::yuyv, 4'147'200).code(), StatusCode::ok);
  assert_int_equal(check_picture(2048, 1536, PixelFormat::rgb24, 0).code(), StatusCode::ok);
  const Status status = check_picture(1920, 1080, PixelFormat::yuyv, 4'147'199);
  assert_int_equal(status.code(), StatusCode::out_of_range);
  assert_non_null(std::strstr(status.cause(), "write elements = 4147200 into the row of the slot"));
  for (const PixelFormat format : camera_formats) {
    assert_int_equal(check_picture(64, 48, format, usual_picture_bytes).code(), StatusCode::ok);
    assert_non_null(std::strstr(camera_formats_text, name_of(format)));
  }
}

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t jpeg_width = 320;
constexpr std::uint32_t jpeg_height = 200;

/// As its markers have it, and around them nothing that could be decoded.
Bytes jpeg_around(const Bytes& scan, std::uint8_t restart_interval = 1) {
  Bytes bytes{0xFF, 0xD8, 0xFF, 0xDD, 0, 4,    0, restart_interval, 0xFF, 0xC0, 0, 11, 8, 0,
              200,  1,    64,   1,    1, 0x11, 0};
  bytes.insert(bytes.end(), {0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0});
  bytes.insert(bytes.end(), scan.begin(), scan.end());
  return bytes;
}

bool finds(const Bytes& bytes, const char* damage) {
  const CheckedJpeg found = check_jpeg(bytes, jpeg_width, jpeg_height);
  if (found.damage != nullptr && std::strstr(found.damage, damage) != nullptr) return found.size == 0;
  print_message("expected '%s', not: %s\n", damage, found.damage == nullptr ? "nothing" : found.damage);
  return false;
}

std::size_t whole_size_of(const Bytes& bytes) {
  return check_jpeg(bytes, jpeg_width, jpeg_height).size;
}

void whole_jpegs_end_at_their_end(void**) {
  const Bytes plain = jpeg_around({1, 2, 3, 0xFF, 0xD9});
  assert_int_equal(whole_size_of(plain), plain.size());
  Bytes padded = plain;
  padded.resize(plain.size() + 100, 0);
  assert_int_equal(whole_size_of(padded), plain.size());
  // Bytes that look like markers and are none, restarts in their order, a marker with fill bytes.
  Bytes scan{1, 0xFF, 0, 2};
  for (std::uint8_t restart = 0; restart < 20; ++restart)
    scan.insert(scan.end(), {0xFF, static_cast<std::uint8_t>(0xD0 + restart % 8), 7});
  scan.insert(scan.end(), {0xFF, 0xFF, 0xD9});
  assert_int_equal(whole_size_of(jpeg_around(scan)), jpeg_around(scan).size());
}

// [jpeg-check-1] [jpeg-check-2] [jpeg-check-3]
void damage_shows_at_the_markers(void**) {
  const Bytes whole = jpeg_around({1, 0xFF, 0xD0, 2, 3, 0xFF, 0xD9});
  for (std::size_t size = 2; size < whole.size(); ++size)
    assert_true(
        finds(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), "ends before"));
  assert_true(finds({}, "no JPEG"));
  assert_true(finds({0xFF}, "no JPEG"));
  assert_true(finds(jpeg_around({1, 0xFF, 0xD1, 2, 0xFF, 0xD9}), "a part of the JPEG is missing"));
  assert_true(finds(jpeg_around({1, 0xFF, 0xD0, 2, 0xFF, 0xD9}, 0), "a part of the JPEG is missing"));
  assert_true(finds({0xFF, 0xD8, 0xFF, 0xD9}, "holds no picture"));
  assert_true(finds({0xFF, 0xD8, 0xFF, 0xDA, 0, 2, 1, 0xFF, 0xD9}, "does not say its size"));
  assert_true(finds({0xFF, 0xD8, 0xFF, 0xE0, 0, 1, 0xFF, 0xD9}, "within a marker"));
  assert_true(finds({0xFF, 0xD8, 0xFF, 0xC0, 0, 4, 8, 0, 0xFF, 0xD9}, "within a marker"));
  assert_true(finds({0xFF, 0xD8, 0xFF, 0xD0, 0xFF, 0xD9}, "where none may be"));
  assert_true(finds({0xFF, 0xD8, 0x12, 0xFF, 0xD9}, "between two markers"));
  assert_string_equal(check_jpeg(whole, jpeg_width, jpeg_height + 1).damage, "the JPEG is of another size");
  assert_string_equal(check_jpeg(whole, jpeg_width + 1, jpeg_height).damage, "the JPEG is of another size");
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
      cmocka_unit_test(whole_jpegs_end_at_their_end),
      cmocka_unit_test(damage_shows_at_the_markers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
