#include <cmath>
#include <cstring>
#include <vector>

#include "hal/force_torque/ft300/ft300_stream.hpp"
#include "hal/force_torque/net_ft/ati_status.hpp"
#include "hal/force_torque/net_ft/net_ft_session.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

// ---- RDT

void a_record_has_its_numbers_with_the_most_significant_byte_first(void**) {
  const rdt::RecordBytes bytes{0x00, 0x00, 0x00, 0x07, 0x00, 0x01, 0x00, 0x00, 0x80, 0x00, 0x00, 0x04,
                               0x00, 0x0F, 0x42, 0x40, 0xFF, 0xF0, 0xBD, 0xC0, 0x00, 0x00, 0x00, 0x00,
                               0x7F, 0xFF, 0xFF, 0xFF, 0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01};
  const rdt::Record record = rdt::decode(bytes);
  assert_int_equal(record.sequence, 7);
  assert_int_equal(record.sample, 65536);
  assert_int_equal(record.status, 0x80000004);
  assert_int_equal(record.force[0], 1000000);
  assert_int_equal(record.force[1], -1000000);
  assert_int_equal(record.torque[0], INT32_MAX);
  assert_int_equal(record.torque[1], INT32_MIN);
  const rdt::RecordBytes again = rdt::encode(record);
  assert_memory_equal(again.data(), bytes.data(), bytes.size());
}

void a_request_is_of_eight_bytes(void**) {
  const rdt::RequestBytes bytes = rdt::encode(rdt::Request{rdt::Command::stream, 0x10203});
  const std::uint8_t expected[] = {0x12, 0x34, 0x00, 0x02, 0x00, 0x01, 0x02, 0x03};
  assert_memory_equal(bytes.data(), expected, sizeof(expected));
  const auto request = rdt::decode_request(bytes);
  assert_true(request.has_value());
  assert_int_equal(request->count, 0x10203);
  assert_false(rdt::decode_request(std::span(bytes).first<7>()).has_value());
  const std::uint8_t other[] = {0x12, 0x35, 0, 2, 0, 0, 0, 0};
  assert_false(rdt::decode_request(other).has_value());
}

void bits_of_a_status_are_told_apart(void**) {
  assert_true(check_status(0, AtiFamily::axia).is_ok());
  assert_true(check_status(0x10, AtiFamily::axia).is_ok());  // busy: only told
  assert_true(check_status(0xC0000000, AtiFamily::axia).is_ok());
  assert_true(is_saturated(0xC0000000, AtiFamily::axia));
  assert_true(is_saturated(0x88000000, AtiFamily::axia));
  assert_false(is_saturated(0x80020000, AtiFamily::axia));
  assert_true(is_saturated(0x80020000, AtiFamily::net_box));
  const Status hot = check_status(0xC0000001, AtiFamily::axia);
  assert_int_equal(hot.code(), StatusCode::device_fault);
  assert_non_null(std::strstr(hot.cause(), "0xC0000001"));
  assert_non_null(std::strstr(hot.cause(), "temperature"));
  assert_null(std::strstr(check_status(0x80000001, AtiFamily::net_box).cause(), "temperature"));
}

/// A session and what it measured, on a clock of its own.
struct Talk {
  NetFtSession session;
  WrenchMeter meter;
  ForceTorqueSensorFeedback told;
  Time now{std::chrono::seconds(1)};

  Talk() {
    const MeterPlan plan{.max_age = milliseconds(100)};
    const bool ready = session.begin({.counts_per_force = 1000, .counts_per_torque = 100000}).is_ok() &&
                       meter.begin("test", plan).is_ok();
    static_cast<void>(ready);
  }
  void hear(std::uint32_t sequence, std::uint32_t status = 0) {
    now += milliseconds(1);
    session.take(rdt::encode(rdt::Record{sequence, 0, status, {1500, 0, 0}, {0, 0, -2500}}), now, meter);
    look();
  }
  void look() {
    meter.close(now);
    meter.fill(told);
  }
};

void counts_are_scaled(void**) {
  Talk talk;
  talk.hear(1);
  assert_true(talk.meter.state().has_value());
  assert_true(talk.meter.state()->force[0] == 1.5);
  assert_true(talk.meter.state()->torque[2] == -0.025);
}

void lost_records_are_counted_by_their_number(void**) {
  Talk talk;
  talk.hear(1);
  talk.hear(2);
  talk.hear(6);
  assert_int_equal(talk.told.lost, 3);
  talk.hear(5);  // overtaken
  assert_int_equal(talk.told.damaged, 1);
  assert_int_equal(talk.told.samples, 3);
  assert_int_equal(talk.meter.state()->sequence, 6);
}

void numbers_wrap_around(void**) {
  Talk talk;
  talk.hear(0xFFFF'FFFEU);
  talk.hear(0xFFFF'FFFFU);
  talk.hear(1);
  assert_int_equal(talk.told.lost, 1);
  assert_int_equal(talk.meter.state()->sequence, 4);
}

void it_is_asked_again_until_it_sends(void**) {
  Talk talk;
  assert_true(talk.session.request(talk.now).has_value());
  assert_false(talk.session.request(talk.now + milliseconds(50)).has_value());
  talk.now += milliseconds(100);
  assert_true(talk.session.request(talk.now).has_value());
  talk.hear(1);
  assert_false(talk.session.request(talk.now + milliseconds(90)).has_value());
  // The first request was late only: the stream begins anew, and nothing was lost.
  talk.hear(2);
  talk.hear(1);
  talk.hear(2);
  assert_int_equal(talk.told.lost, 0);
  assert_int_equal(talk.told.damaged, 0);
  // But once: from here on it is an old one.
  talk.hear(1);
  assert_int_equal(talk.told.damaged, 1);
}

void a_silent_one_is_asked_to_begin_anew(void**) {
  Talk talk;
  assert_true(talk.session.request(talk.now).has_value());
  talk.hear(40);
  talk.now += milliseconds(150);
  talk.look();
  assert_false(talk.meter.state().has_value());
  assert_true(talk.session.request(talk.now).has_value());
  talk.hear(1);
  assert_true(talk.meter.state().has_value());
  assert_int_equal(talk.told.lost, 0);
  assert_int_equal(talk.told.recoveries, 1);
}

void datagrams_of_another_size_are_damaged(void**) {
  Talk talk;
  const std::uint8_t bytes[rdt::record_bytes + 1] = {};
  talk.session.take(std::span(bytes).first(35), talk.now, talk.meter);
  talk.session.take(bytes, talk.now, talk.meter);
  talk.session.take({}, talk.now, talk.meter);
  talk.look();
  assert_int_equal(talk.told.damaged, 3);
  assert_int_equal(talk.told.samples, 0);
}

void scales_that_make_no_sense_are_refused(void**) {
  NetFtSession session;
  for (const double counts : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    assert_int_equal(session.begin({.counts_per_force = counts}).code(), StatusCode::invalid_argument);
    assert_int_equal(session.begin({.counts_per_torque = counts}).code(), StatusCode::invalid_argument);
  }
}

// ---- FT300

void the_crc_is_that_of_modbus(void**) {
  // The usual check value.
  assert_int_equal(ft300::crc16(std::span(reinterpret_cast<const std::uint8_t*>("123456789"), 9)), 0x4B37);
}

void the_stream_is_asked_for_by_register_410(void**) {
  const ft300::RequestBytes bytes = ft300::stream_request(9);
  const std::uint8_t expected[] = {9, 0x10, 0x01, 0x9A, 0x00, 0x01, 0x02, 0x02, 0x00};
  assert_memory_equal(bytes.data(), expected, sizeof(expected));
  assert_int_equal(ft300::crc16(bytes), 0);  // with its own CRC
}

constexpr ft300::Frame some_frame{{12345, -12345, 0x4E20}, {1, -1, 0x204E}};

std::vector<ft300::Frame> found_in(ft300::Decoder& decoder, std::span<const std::uint8_t> bytes) {
  std::vector<ft300::Frame> frames;
  for (const std::uint8_t byte : bytes) {
    decoder.put(byte);
    if (const auto frame = decoder.take()) frames.push_back(*frame);
  }
  return frames;
}

bool frames_are_found() {
  const ft300::FrameBytes bytes = ft300::encode(some_frame);
  ft300::Decoder decoder;
  const auto frames = found_in(decoder, bytes);
  if (bytes[0] != 0x20 || bytes[1] != 0x4E || bytes[2] != 0x39 || bytes[3] != 0x30 || frames.size() != 1)
    return false;
  const RawWrench raw = ft300::measured(frames[0]);
  return raw.force[0] == 123.45 && raw.force[1] == -123.45 && raw.torque[0] == 0.001 &&
         raw.torque[1] == -0.001 && decoder.damaged() == 0;
}

/// It begins in the middle, has the mark of a beginning in its values, loses bytes and is garbled.
bool frames_are_found_again() {
  const ft300::FrameBytes whole = ft300::encode(some_frame);
  std::vector<std::uint8_t> bytes(whole.begin() + 3, whole.end());
  bytes.insert(bytes.end(), whole.begin(), whole.end());        // 1
  bytes.insert(bytes.end(), whole.begin(), whole.begin() + 7);  // cut
  bytes.insert(bytes.end(), whole.begin(), whole.end());        // 2
  ft300::FrameBytes bent = whole;
  bent[5] ^= 0x10;
  bytes.insert(bytes.end(), bent.begin(), bent.end());
  for (int i = 0; i < 3; ++i) bytes.insert(bytes.end(), whole.begin(), whole.end());  // 3, 4, 5
  ft300::Decoder decoder;
  return found_in(decoder, bytes).size() == 5 && decoder.damaged() == 2;
}

void frames(void**) {
  assert_true(frames_are_found());
  assert_true(frames_are_found_again());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_record_has_its_numbers_with_the_most_significant_byte_first),
      cmocka_unit_test(a_request_is_of_eight_bytes),
      cmocka_unit_test(bits_of_a_status_are_told_apart),
      cmocka_unit_test(counts_are_scaled),
      cmocka_unit_test(lost_records_are_counted_by_their_number),
      cmocka_unit_test(numbers_wrap_around),
      cmocka_unit_test(it_is_asked_again_until_it_sends),
      cmocka_unit_test(a_silent_one_is_asked_to_begin_anew),
      cmocka_unit_test(datagrams_of_another_size_are_damaged),
      cmocka_unit_test(scales_that_make_no_sense_are_refused),
      cmocka_unit_test(the_crc_is_that_of_modbus),
      cmocka_unit_test(the_stream_is_asked_for_by_register_410),
      cmocka_unit_test(frames),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
