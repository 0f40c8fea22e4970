// What ForeignModule says and does, against frames written by hand from CiA 301 and CiA 401. A frame is its
// CAN-ID and its bytes in hexadecimal, as candump shows them; the module is node 5.
#include "hal/gpio/lines/canopen/tests/foreign_module.hpp"

#include <deque>
#include <sstream>
#include <string>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;
using Settings = ForeignModule::Settings;
using State = ForeignModule::State;

CanFrame frame_of(const std::string& text) {
  std::istringstream in(text);
  in >> std::hex;
  CanFrame frame;
  in >> frame.identifier;
  for (unsigned byte = 0; in >> byte; ++frame.length) {
    frame.data.at(frame.length) = static_cast<std::uint8_t>(byte);
  }
  return frame;
}

std::string text_of(const CanFrame& frame) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const unsigned shift : {8U, 4U, 0U}) text += digits[frame.identifier >> shift & 0xFU];
  for (std::size_t i = 0; i < frame.length; ++i) {
    text += ' ';
    text += digits[frame.data[i] >> 4U];
    text += digits[frame.data[i] & 0xFU];
  }
  return text;
}

/// A module that has booted, and whoever is at the other end of its bus.
struct Bench {
  explicit Bench(const Settings& settings = {}) : module(settings) {
    module.power_on(now);
    pass(settings.boot_time);
    heard.clear();
  }

  void pass(Duration time) {
    now += time;
    collect();
  }
  void say(const std::string& text) {
    module.hear(frame_of(text), now);
    collect();
  }
  void collect() {
    for (const CanFrame& frame : module.step(now)) heard.push_back(frame);
  }

  /// That this is what it said next.
  bool hears(const std::string& text) {
    const std::string next = heard.empty() ? "silence" : text_of(heard.front());
    if (!heard.empty()) heard.pop_front();
    if (next != text) print_error("ERROR: %s was expected, and came: %s\n", text.c_str(), next.c_str());
    return next == text;
  }
  bool is_silent() const {
    if (!heard.empty()) print_error("ERROR: came: %s\n", text_of(heard.front()).c_str());
    return heard.empty();
  }

  /// An SDO download of `request`, without its zeros at the end: the module confirms it.
  bool accepts(const std::string& request) {
    say_request(request);
    return hears("585 60 " + multiplexer(request) + " 00 00 00 00");
  }
  /// `code`: its four bytes.
  bool refuses(const std::string& request, const std::string& code) {
    say_request(request);
    return hears("585 80 " + multiplexer(request) + " " + code);
  }
  /// `object`: index and sub-index as in a frame; `answer`: the command specifier, `data`: four bytes.
  bool reads(const std::string& object, const std::string& answer, const std::string& data) {
    say("605 40 " + object + " 00 00 00 00");
    return hears("585 " + answer + " " + object + " " + data);
  }

  /// To operational; what it says at once is heard and forgotten.
  void start() {
    say("000 01 05");
    heard.clear();
  }

  ForeignModule module;
  Time now{std::chrono::seconds{1}};
  std::deque<CanFrame> heard;

 private:
  void say_request(std::string request) {
    while (request.size() < 8 * 3 - 1) request += " 00";
    say("605 " + request);
  }
  static std::string multiplexer(const std::string& request) { return request.substr(3, 8); }
};

// ---- NMT and error control

void boots_up(void**) {
  Bench bench;
  bench.module.power_on(bench.now);
  bench.say("000 01 05");
  bench.pass(milliseconds{19});
  bench.say("605 40 00 10 00 00 00 00 00");
  assert_true(bench.is_silent());
  assert_true(bench.module.state() == State::initialising);
  assert_true(bench.module.next_event() == bench.now + milliseconds{1});
  bench.pass(milliseconds{1});
  assert_true(bench.hears("705 00"));
  assert_true(bench.is_silent());
  assert_true(bench.module.state() == State::pre_operational);
  assert_int_equal(bench.module.outputs(), 0);
}

void follows_nmt(void**) {
  Bench bench;
  assert_true(bench.accepts("2B 17 10 00 64"));  // producer heartbeat time 100 ms
  assert_true(bench.hears("705 7F"));
  bench.pass(milliseconds{99});
  assert_true(bench.is_silent());
  bench.pass(milliseconds{1});
  assert_true(bench.hears("705 7F"));

  bench.say("000 01 06");  // another node
  bench.pass(milliseconds{100});
  assert_true(bench.hears("705 7F"));

  bench.say("000 01 00");  // all nodes
  assert_true(bench.hears("185 00 00"));
  bench.pass(milliseconds{100});
  assert_true(bench.hears("705 05"));

  bench.say("000 02 05");
  bench.say("605 40 00 10 00 00 00 00 00");  // no SDO in stopped
  bench.pass(milliseconds{100});
  assert_true(bench.hears("705 04"));

  bench.say("000 80 05");
  bench.pass(milliseconds{100});
  assert_true(bench.hears("705 7F"));
  assert_true(bench.reads("17 10 00", "4B", "64 00 00 00"));

  assert_true(bench.accepts("2B 17 10 00 00"));
  bench.pass(std::chrono::seconds{10});
  assert_true(bench.is_silent());
}

void resets_communication_and_node(void**) {
  Bench bench;
  assert_true(bench.accepts("23 00 14 01 05 02 00 80"));
  assert_true(bench.accepts("2F 06 62 01 0F"));
  bench.say("000 82 05");
  assert_true(bench.is_silent());
  bench.pass(milliseconds{20});
  assert_true(bench.hears("705 00"));
  assert_true(bench.reads("00 14 01", "43", "05 02 00 00"));
  assert_true(bench.reads("06 62 01", "4F", "0F 00 00 00"));  // application

  bench.start();
  bench.say("205 F0");
  assert_int_equal(bench.module.outputs(), 0xF0);
  bench.say("000 81 05");
  assert_int_equal(bench.module.outputs(), 0);
  bench.pass(milliseconds{20});
  assert_true(bench.hears("705 00"));
  assert_true(bench.reads("06 62 01", "4F", "FF 00 00 00"));
  assert_true(bench.reads("00 62 01", "4F", "00 00 00 00"));
  assert_true(bench.module.state() == State::pre_operational);
}

// ---- SDO

void describes_itself(void**) {
  Bench bench;
  assert_true(bench.reads("00 10 00", "43", "91 01 03 00"));  // CiA 401, digital inputs and outputs
  assert_true(bench.reads("01 10 00", "4F", "00 00 00 00"));
  assert_true(bench.reads("03 10 00", "4F", "00 00 00 00"));
  assert_true(bench.reads("05 10 00", "43", "80 00 00 00"));
  assert_true(bench.reads("14 10 00", "43", "85 00 00 00"));
  assert_true(bench.reads("18 10 00", "4F", "04 00 00 00"));
  assert_true(bench.reads("18 10 01", "43", "C1 04 00 00"));
  assert_true(bench.reads("29 10 01", "4F", "00 00 00 00"));
  assert_true(bench.reads("00 14 01", "43", "05 02 00 00"));
  assert_true(bench.reads("00 14 02", "4F", "FF 00 00 00"));
  assert_true(bench.reads("00 16 00", "4F", "01 00 00 00"));
  assert_true(bench.reads("00 16 01", "43", "08 01 00 62"));
  assert_true(bench.reads("00 18 01", "43", "85 01 00 40"));
  assert_true(bench.reads("00 1A 00", "4F", "02 00 00 00"));
  assert_true(bench.reads("00 1A 01", "43", "08 01 00 60"));
  assert_true(bench.reads("00 1A 02", "43", "08 02 00 60"));
  assert_true(bench.reads("00 60 00", "4F", "02 00 00 00"));
  assert_true(bench.reads("05 60 00", "4F", "00 00 00 00"));
  assert_true(bench.reads("06 60 02", "4F", "FF 00 00 00"));
  assert_true(bench.reads("07 60 01", "4F", "00 00 00 00"));
  assert_true(bench.reads("06 62 01", "4F", "FF 00 00 00"));
  assert_true(bench.reads("07 62 01", "4F", "00 00 00 00"));
  assert_true(bench.reads("08 62 01", "4F", "FF 00 00 00"));
}

void name_comes_in_segments(void**) {
  Bench bench;
  assert_true(bench.reads("08 10 00", "41", "10 00 00 00"));
  bench.say("605 60 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 00 46 6F 72 65 69 67 6E"));  // Foreign
  bench.say("605 70 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 10 20 44 49 4F 20 31 36"));  //  DIO 16
  bench.say("605 60 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 0B 2F 38 00 00 00 00 00"));  // /8: five bytes unused, the last
  bench.say("605 70 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 80 00 00 00 01 00 04 05"));
}

void segments_alternate(void**) {
  Bench bench;
  assert_true(bench.reads("08 10 00", "41", "10 00 00 00"));
  bench.say("605 70 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 80 08 10 00 00 00 03 05"));

  assert_true(bench.reads("08 10 00", "41", "10 00 00 00"));
  bench.say("605 80 08 10 00 00 00 04 05");  // the client gives up
  assert_true(bench.is_silent());
  bench.say("605 60 00 00 00 00 00 00 00");
  assert_true(bench.hears("585 80 00 00 00 01 00 04 05"));
}

void refuses_what_it_cannot_do(void**) {
  Bench bench;
  assert_true(bench.reads("10 10 00", "80", "00 00 02 06"));    // no such object
  assert_true(bench.reads("18 10 05", "80", "11 00 09 06"));    // no such sub-index
  assert_true(bench.reads("00 18 04", "80", "11 00 09 06"));    // reserved
  assert_true(bench.reads("03 10 01", "80", "24 00 00 08"));    // no error is in the history
  assert_true(bench.refuses("23 00 10 00 91", "02 00 01 06"));  // read only
  assert_true(bench.refuses("2F 00 60 01 01", "02 00 01 06"));
  assert_true(bench.refuses("2F 17 10 00 64", "10 00 07 06"));  // one byte into two
  assert_true(bench.refuses("23 06 62 01 FF", "10 00 07 06"));  // four bytes into one
  assert_true(bench.refuses("2F 03 10 00 01", "30 00 09 06"));  // only 0 clears the history
  assert_true(bench.refuses("2F 29 10 01 03", "30 00 09 06"));
  assert_true(bench.refuses("2F 00 18 02 F1", "30 00 09 06"));  // a reserved transmission type
  assert_true(bench.refuses("21 06 62 01 01", "01 00 04 05"));  // a download in segments
  assert_true(bench.refuses("C2 06 62 01 01", "01 00 04 05"));  // a block
  assert_true(bench.accepts("22 06 62 01 F0"));                 // of a size that is not said
  assert_true(bench.reads("06 62 01", "4F", "F0 00 00 00"));
  bench.say("606 40 00 10 00 00 00 00 00");  // another node's
  bench.say("605 40 00 10 00");              // not eight bytes
  assert_true(bench.is_silent());
}

void answers_one_request_at_a_time(void**) {
  Bench bench({.sdo_answer_time = milliseconds{4}});
  bench.say("605 40 00 10 00 00 00 00 00");
  bench.pass(milliseconds{3});
  assert_true(bench.is_silent());
  bench.say("605 40 01 10 00 00 00 00 00");
  bench.pass(milliseconds{1});
  assert_true(bench.hears("585 43 00 10 00 91 01 03 00"));
  bench.pass(milliseconds{100});
  assert_true(bench.is_silent());
}

// ---- PDO parameters

void mapping_is_changed_in_its_order(void**) {
  Bench bench;
  assert_true(bench.refuses("2F 00 1A 00 00", "22 00 00 08"));           // the PDO is valid
  assert_true(bench.accepts("23 00 18 01 85 01 00 C0"));                 // now it is not
  assert_true(bench.refuses("23 00 1A 01 08 02 00 60", "22 00 00 08"));  // sub-index 0 is not 0
  assert_true(bench.accepts("2F 00 1A 00 00"));
  assert_true(bench.refuses("23 00 1A 01 08 01 00 61", "00 00 02 06"));  // 6100h: not here
  assert_true(bench.refuses("23 00 1A 01 08 03 00 60", "00 00 02 06"));  // 6000h:03: not here
  assert_true(bench.refuses("23 00 1A 01 08 00 05 60", "41 00 04 06"));  // 6005h: no process data
  assert_true(bench.refuses("23 00 1A 01 08 01 00 62", "41 00 04 06"));  // 6200h: only received
  assert_true(bench.refuses("23 00 1A 01 10 01 00 60", "41 00 04 06"));  // sixteen bits of eight
  assert_true(bench.accepts("23 00 1A 01 08 02 00 60"));
  assert_true(bench.refuses("2F 00 1A 00 09", "42 00 04 06"));
  assert_true(bench.refuses("2F 00 1A 00 03", "00 00 02 06"));  // the third entry is empty
  assert_true(bench.accepts("2F 00 1A 00 01"));
  assert_true(bench.accepts("23 00 18 01 85 01 00 40"));
  bench.module.set_inputs(0xA512);
  bench.say("000 01 05");
  assert_true(bench.hears("185 A5"));
}

void outputs_may_lie_behind_dummies(void**) {
  Bench bench;
  assert_true(bench.accepts("23 00 14 01 05 02 00 80"));
  assert_true(bench.accepts("2F 00 16 00 00"));
  assert_true(bench.accepts("23 00 16 01 20 00 07 00"));
  assert_true(bench.accepts("23 00 16 02 08 01 00 62"));
  assert_true(bench.accepts("23 00 16 03 20 00 07 00"));
  assert_true(bench.refuses("2F 00 16 00 03", "42 00 04 06"));  // 72 bits
  assert_true(bench.accepts("2F 00 16 00 02"));
  assert_true(bench.accepts("23 00 14 01 05 02 00 00"));
  bench.start();
  bench.say("205 01 02 03 04 99");
  assert_int_equal(bench.module.outputs(), 0x99);
}

void a_valid_pdo_keeps_its_can_id(void**) {
  Bench bench;
  assert_true(bench.refuses("23 00 14 01 06 03 00 00", "22 00 00 08"));
  assert_true(bench.accepts("23 00 14 01 05 02 00 80"));
  assert_true(bench.refuses("23 00 14 01 81 05 00 00", "30 00 09 06"));  // of SDO
  assert_true(bench.refuses("23 00 14 01 06 03 00 20", "30 00 09 06"));  // 29 bits
  assert_true(bench.accepts("23 00 14 01 06 03 00 00"));
  bench.start();
  bench.say("205 01");
  assert_int_equal(bench.module.outputs(), 0);
  bench.say("306 02");
  assert_int_equal(bench.module.outputs(), 2);
  assert_true(bench.refuses("2B 00 18 03 64", "22 00 00 08"));  // the inhibit time of a valid TPDO
}

// ---- Outputs

void rpdo_acts_at_once_when_operational(void**) {
  Bench bench;
  bench.say("205 FF");
  assert_int_equal(bench.module.outputs(), 0);
  bench.start();
  assert_int_equal(bench.module.outputs(), 0);
  bench.say("205 5A");
  assert_int_equal(bench.module.outputs(), 0x5A);
  bench.say("205 A5 FF FF");  // longer than mapped
  assert_int_equal(bench.module.outputs(), 0xA5);
  assert_true(bench.reads("00 62 01", "4F", "A5 00 00 00"));
  assert_true(bench.accepts("2F 00 62 01 11"));
  assert_int_equal(bench.module.outputs(), 0x11);
}

void rpdo_that_is_too_short_is_an_error(void**) {
  Bench bench;
  bench.start();
  bench.say("205 5A");
  bench.say("205");
  assert_true(bench.hears("085 10 82 11 00 00 00 00 00"));
  bench.say("205");
  assert_true(bench.is_silent());
  assert_int_equal(bench.module.outputs(), 0x5A);
  bench.say("205 01");
  assert_true(bench.hears("085 00 00 00 00 00 00 00 00"));
  assert_int_equal(bench.module.outputs(), 1);
}

void synchronous_rpdo_waits_for_sync(void**) {
  Bench bench;
  assert_true(bench.accepts("2F 00 14 02 01"));
  bench.start();
  bench.say("205 5A");
  assert_int_equal(bench.module.outputs(), 0);
  bench.say("080");
  assert_int_equal(bench.module.outputs(), 0x5A);
}

void polarity_and_mask_of_outputs(void**) {
  Bench bench;
  assert_true(bench.accepts("2F 02 62 01 01"));
  assert_int_equal(bench.module.outputs(), 0x01);
  assert_true(bench.accepts("2F 08 62 01 0F"));
  bench.start();
  bench.say("205 FF");
  assert_int_equal(bench.module.outputs(), 0x0E);
}

// ---- Inputs

void inputs_are_told_by_interrupts(void**) {
  Bench bench;
  bench.say("000 01 05");
  assert_true(bench.hears("185 00 00"));
  bench.module.set_input(1, true);
  bench.pass(milliseconds{10});
  assert_true(bench.is_silent());  // 6005h is false
  assert_true(bench.reads("00 60 01", "4F", "01 00 00 00"));

  assert_true(bench.accepts("2F 05 60 00 01"));
  assert_true(bench.is_silent());
  bench.module.set_input(2, true);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 03 00"));
  bench.module.set_input(9, true);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 03 01"));
  bench.pass(milliseconds{100});
  assert_true(bench.is_silent());

  bench.say("000 80 05");
  bench.module.set_input(9, false);
  bench.pass(milliseconds{1});
  assert_true(bench.is_silent());  // not operational
}

void interrupts_have_masks_for_each_edge(void**) {
  Bench bench({.enables_interrupts = true});
  assert_true(bench.accepts("2F 06 60 01 00"));
  assert_true(bench.accepts("2F 07 60 01 01"));  // low to high
  assert_true(bench.accepts("2F 08 60 01 02"));  // high to low
  bench.start();
  bench.module.set_inputs(0x02);
  bench.pass(milliseconds{1});
  assert_true(bench.is_silent());
  bench.module.set_inputs(0x03);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 03 00"));
  bench.module.set_inputs(0x02);
  bench.pass(milliseconds{1});
  assert_true(bench.is_silent());
  bench.module.set_inputs(0x00);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 00 00"));
}

void polarity_of_inputs(void**) {
  Bench bench;
  assert_true(bench.accepts("2F 02 60 02 F0"));
  bench.module.set_inputs(0x8001);
  assert_true(bench.reads("00 60 01", "4F", "01 00 00 00"));
  assert_true(bench.reads("00 60 02", "4F", "70 00 00 00"));
}

void filtered_inputs_last(void**) {
  Bench bench({.has_input_filter = true, .enables_interrupts = true});
  assert_true(bench.accepts("2F 03 60 01 01"));
  bench.start();
  bench.module.set_input(1, true);
  bench.pass(milliseconds{1});
  bench.module.set_input(1, false);
  bench.pass(milliseconds{5});
  assert_true(bench.is_silent());
  bench.module.set_input(1, true);
  bench.pass(milliseconds{1});
  bench.pass(milliseconds{1});
  assert_true(bench.is_silent());
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 01 00"));
  bench.module.set_input(2, true);  // has no filter
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 03 00"));
}

void inhibit_time_keeps_tpdos_apart(void**) {
  Bench bench({.enables_interrupts = true});
  assert_true(bench.accepts("23 00 18 01 85 01 00 C0"));
  assert_true(bench.accepts("2B 00 18 03 64"));  // 10 ms
  assert_true(bench.accepts("23 00 18 01 85 01 00 40"));
  bench.start();
  bench.module.set_inputs(1);
  bench.pass(milliseconds{2});
  assert_true(bench.is_silent());
  bench.module.set_inputs(3);
  bench.pass(milliseconds{7});
  assert_true(bench.is_silent());
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 03 00"));  // the newest
  bench.pass(milliseconds{100});
  assert_true(bench.is_silent());
}

void event_timer_repeats_the_tpdo(void**) {
  Bench bench;
  assert_true(bench.accepts("2B 00 18 05 32"));  // 50 ms
  bench.pass(milliseconds{200});
  assert_true(bench.is_silent());  // not operational
  bench.say("000 01 05");
  assert_true(bench.hears("185 00 00"));
  bench.module.set_inputs(1);  // 6005h is false: told by the timer only
  bench.pass(milliseconds{49});
  assert_true(bench.is_silent());
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 01 00"));
  bench.pass(milliseconds{150});
  for (int i = 0; i < 3; ++i) assert_true(bench.hears("185 01 00"));
  assert_true(bench.is_silent());
}

void synchronous_tpdos(void**) {
  Bench bench({.enables_interrupts = true, .sends_tpdo_at_start = false});
  assert_true(bench.accepts("2F 00 18 02 02"));  // with every second SYNC
  bench.start();
  bench.module.set_inputs(1);
  bench.pass(milliseconds{1});
  bench.say("080");
  assert_true(bench.is_silent());
  bench.say("080");
  assert_true(bench.hears("185 01 00"));

  assert_true(bench.accepts("2F 00 18 02 00"));  // with SYNC, after a change
  bench.say("080");
  assert_true(bench.is_silent());
  bench.module.set_inputs(2);
  bench.pass(milliseconds{1});
  assert_true(bench.is_silent());
  bench.say("080");
  assert_true(bench.hears("185 02 00"));
  bench.say("080");
  assert_true(bench.is_silent());
}

void tpdo_on_request(void**) {
  Bench bench({.sends_tpdo_at_start = false});
  CanFrame request = frame_of("185");
  request.remote = true;
  bench.start();
  bench.module.hear(request, bench.now);
  bench.collect();
  assert_true(bench.is_silent());  // bit 30: no remote request
  assert_true(bench.accepts("23 00 18 01 85 01 00 00"));
  bench.module.hear(request, bench.now);
  bench.collect();
  assert_true(bench.hears("185 00 00"));
}

// ---- Faults

/// Watches node 127 for 100 ms, operational, outputs A5h.
void watch(Bench& bench) {
  assert_true(bench.accepts("23 16 10 01 64 00 7F 00"));
  bench.start();
  bench.say("205 A5");
}

void lost_heartbeat_sets_error_values(void**) {
  Bench bench;
  watch(bench);
  bench.pass(std::chrono::seconds{1});
  assert_true(bench.is_silent());  // watched from the first heartbeat on
  bench.say("77F 05");
  bench.pass(milliseconds{99});
  bench.say("77F 05");
  bench.pass(milliseconds{99});
  assert_true(bench.is_silent());
  assert_int_equal(bench.module.outputs(), 0xA5);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("085 30 81 11 7F 00 00 00 00"));
  assert_int_equal(bench.module.outputs(), 0);
  assert_true(bench.module.state() == State::pre_operational);
  assert_true(bench.reads("01 10 00", "4F", "11 00 00 00"));
  assert_true(bench.reads("03 10 00", "4F", "01 00 00 00"));
  assert_true(bench.reads("03 10 01", "43", "30 81 7F 00"));

  bench.say("77F 05");
  assert_true(bench.hears("085 00 00 00 00 00 00 00 00"));
  assert_true(bench.reads("01 10 00", "4F", "00 00 00 00"));
  bench.start();
  assert_int_equal(bench.module.outputs(), 0);
  bench.say("205 01");
  assert_int_equal(bench.module.outputs(), 1);
  assert_true(bench.accepts("2F 03 10 00 00"));
  assert_true(bench.reads("03 10 01", "80", "24 00 00 08"));
}

void error_values_are_per_output(void**) {
  Bench bench;
  assert_true(bench.accepts("2F 06 62 01 0F"));
  assert_true(bench.accepts("2F 07 62 01 33"));
  watch(bench);
  bench.say("77F 05");
  bench.pass(milliseconds{100});
  assert_int_equal(bench.module.outputs(), 0xA3);
}

void error_behaviour_chooses_the_state(void**) {
  Bench stays;
  assert_true(stays.accepts("2F 29 10 01 01"));
  watch(stays);
  stays.say("77F 05");
  stays.pass(milliseconds{100});
  assert_true(stays.hears("085 30 81 11 7F 00 00 00 00"));
  assert_true(stays.module.state() == State::operational);
  assert_int_equal(stays.module.outputs(), 0);
  stays.say("205 01");
  assert_int_equal(stays.module.outputs(), 1);

  Bench stops;
  assert_true(stops.accepts("2F 29 10 01 02"));
  watch(stops);
  stops.say("77F 05");
  stops.pass(milliseconds{100});
  assert_true(stops.hears("085 30 81 11 7F 00 00 00 00"));
  assert_true(stops.module.state() == State::stopped);
  assert_int_equal(stops.module.outputs(), 0);
}

void a_node_is_watched_once(void**) {
  Bench bench({.heartbeat_consumers = 2});
  assert_true(bench.accepts("23 16 10 01 64 00 7F 00"));
  assert_true(bench.refuses("23 16 10 02 C8 00 7F 00", "43 00 04 06"));
  assert_true(bench.accepts("23 16 10 02 C8 00 01 00"));
}

void leaving_operational_sets_error_values(void**) {
  for (const char* command : {"000 02 05", "000 80 05", "000 82 05"}) {
    Bench bench;
    assert_true(bench.accepts("2F 07 62 01 01"));
    bench.start();
    bench.say("205 A0");
    bench.say(command);
    assert_int_equal(bench.module.outputs(), 1);
    assert_true(bench.is_silent());
  }
}

// ---- What is optional, and what vendors do differently

void without_optional_objects(void**) {
  Bench bench({.heartbeat_consumers = 0,
               .has_error_behaviour = false,
               .has_interrupt_masks = false,
               .has_polarity = false,
               .has_error_values = false,
               .has_output_filter = false});
  for (const char* object : {"16 10 01", "29 10 01", "02 60 01", "03 60 01", "05 60 00", "06 60 01",
                             "07 60 01", "08 60 01", "02 62 01", "06 62 01", "07 62 01", "08 62 01"}) {
    assert_true(bench.reads(object, "80", "00 00 02 06"));
  }
  bench.start();
  bench.module.set_input(16, true);
  bench.pass(milliseconds{1});
  assert_true(bench.hears("185 00 80"));
  bench.say("205 A5");
  assert_int_equal(bench.module.outputs(), 0xA5);
  bench.say("000 02 05");
  assert_int_equal(bench.module.outputs(), 0);
}

void silent_without_interrupts(void**) {
  Bench bench({.is_silent_without_them = true});
  assert_true(bench.accepts("2B 00 18 05 0A"));
  bench.say("000 01 05");
  bench.pass(milliseconds{100});
  assert_true(bench.is_silent());
  assert_true(bench.accepts("2F 05 60 00 01"));
  bench.pass(milliseconds{10});
  assert_true(bench.hears("185 00 00"));
}

void tells_a_tpdo_that_becomes_valid(void**) {
  Bench bench;
  assert_true(bench.accepts("23 00 18 01 85 01 00 C0"));
  bench.say("000 01 05");
  assert_true(bench.is_silent());
  assert_true(bench.accepts("23 00 18 01 85 01 00 40"));
  assert_true(bench.hears("185 00 00"));
}

void silent_at_start(void**) {
  Bench bench({.sends_tpdo_at_start = false});
  bench.say("000 01 05");
  bench.pass(milliseconds{100});
  assert_true(bench.is_silent());
}

void starts_itself(void**) {
  Bench bench({.starts_itself = true, .says_no_error_after_boot = true});
  assert_true(bench.module.state() == State::operational);
  bench.module.power_on(bench.now);
  bench.pass(milliseconds{20});
  assert_true(bench.hears("705 00"));
  assert_true(bench.hears("085 00 00 00 00 00 00 00 00"));
  assert_true(bench.hears("185 00 00"));
  bench.say("205 01");
  assert_int_equal(bench.module.outputs(), 1);
}

void fixed_mapping(void**) {
  Bench bench({.has_fixed_mapping = true});
  assert_true(bench.accepts("23 00 14 01 05 02 00 80"));
  assert_true(bench.refuses("2F 00 16 00 00", "02 00 01 06"));
  assert_true(bench.refuses("23 00 16 01 08 01 00 62", "02 00 01 06"));
}

void cob_ids_that_are_kept(void**) {
  Bench locked({.locks_cob_ids = true});
  locked.start();
  assert_true(locked.refuses("23 00 14 01 05 02 00 80", "22 00 00 08"));
  locked.say("000 80 05");
  assert_true(locked.accepts("23 00 14 01 05 02 00 80"));

  Bench lenient;
  assert_true(lenient.accepts("23 00 14 01 00 00 00 80"));
  Bench strict({.keeps_disabled_cob_ids = true});
  assert_true(strict.refuses("23 00 14 01 00 00 00 80", "22 00 00 08"));
  assert_true(strict.accepts("23 00 14 01 05 02 00 80"));
  assert_true(strict.accepts("23 00 14 01 00 00 00 80"));

  Bench without_remote({.refuses_remote_requests = true});
  assert_true(without_remote.refuses("23 00 18 01 85 01 00 80", "30 00 09 06"));
  assert_true(without_remote.accepts("23 00 18 01 85 01 00 C0"));
}

void least_event_timer(void**) {
  Bench refuses({.least_event_timer = 20});
  assert_true(refuses.refuses("2B 00 18 05 13", "32 00 09 06"));
  assert_true(refuses.accepts("2B 00 18 05 14"));
  assert_true(refuses.accepts("2B 00 18 05 00"));

  Bench raises({.least_event_timer = 20, .raises_event_timer = true});
  assert_true(raises.accepts("2B 00 18 05 01"));
  assert_true(raises.reads("00 18 05", "4B", "14 00 00 00"));
}

void outputs_that_are_kept(void**) {
  Bench reset({.keeps_outputs_on_reset = true});
  reset.start();
  reset.say("205 A5");
  reset.say("000 81 05");
  reset.pass(milliseconds{20});
  assert_int_equal(reset.module.outputs(), 0xA5);
  reset.module.power_on(reset.now);
  assert_int_equal(reset.module.outputs(), 0);

  Bench paused({.keeps_outputs_when_paused = true});
  paused.start();
  paused.say("205 A5");
  paused.say("000 80 05");
  assert_int_equal(paused.module.outputs(), 0xA5);
  paused.say("000 02 05");
  assert_int_equal(paused.module.outputs(), 0);

  Bench stopped({.keeps_outputs_when_stopped = true});
  watch(stopped);
  stopped.say("000 02 05");
  assert_int_equal(stopped.module.outputs(), 0xA5);
  stopped.say("77F 05");
  stopped.pass(milliseconds{100});
  assert_true(stopped.is_silent());  // no EMCY in stopped
  assert_int_equal(stopped.module.outputs(), 0);

  Bench returns({.returns_to_old_outputs = true});
  returns.start();
  returns.say("205 A5");
  returns.say("000 80 05");
  assert_int_equal(returns.module.outputs(), 0);
  returns.start();
  assert_int_equal(returns.module.outputs(), 0xA5);
}

void power(void**) {
  Bench bench;
  bench.start();
  bench.say("205 A5");
  bench.module.power_off();
  assert_int_equal(bench.module.outputs(), 0);
  assert_true(bench.module.next_event() == Time::max());
  bench.say("605 40 00 10 00 00 00 00 00");
  bench.pass(std::chrono::seconds{1});
  assert_true(bench.is_silent());
}

// ---- On a wire

struct Port final : CanPort {
  bool send(const CanFrame& frame) noexcept override {
    sent.push_back(frame);
    return true;
  }
  std::vector<CanFrame> sent;
};

void is_a_node_on_a_wire(void**) {
  ForeignModule module({.enables_interrupts = true, .sends_tpdo_at_start = false});
  ForeignModuleNode node(module);
  Port port;
  Time now{std::chrono::seconds{1}};
  node.on_time(now, port);
  for (int i = 0; i < 20; ++i) {
    now = node.next_event();
    node.on_time(now, port);
  }
  assert_int_equal(port.sent.size(), 1);
  assert_string_equal(text_of(port.sent[0]).c_str(), "705 00");
  CanFrame start = frame_of("000 01 05");
  start.time = now;
  node.on_frame(start, port);
  module.set_input(1, true);
  assert_true(node.next_event() == now + milliseconds{1});
  node.on_time(node.next_event(), port);
  assert_int_equal(port.sent.size(), 2);
  assert_string_equal(text_of(port.sent[1]).c_str(), "185 01 00");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(boots_up),
      cmocka_unit_test(follows_nmt),
      cmocka_unit_test(resets_communication_and_node),
      cmocka_unit_test(describes_itself),
      cmocka_unit_test(name_comes_in_segments),
      cmocka_unit_test(segments_alternate),
      cmocka_unit_test(refuses_what_it_cannot_do),
      cmocka_unit_test(answers_one_request_at_a_time),
      cmocka_unit_test(mapping_is_changed_in_its_order),
      cmocka_unit_test(outputs_may_lie_behind_dummies),
      cmocka_unit_test(a_valid_pdo_keeps_its_can_id),
      cmocka_unit_test(rpdo_acts_at_once_when_operational),
      cmocka_unit_test(rpdo_that_is_too_short_is_an_error),
      cmocka_unit_test(synchronous_rpdo_waits_for_sync),
      cmocka_unit_test(polarity_and_mask_of_outputs),
      cmocka_unit_test(inputs_are_told_by_interrupts),
      cmocka_unit_test(interrupts_have_masks_for_each_edge),
      cmocka_unit_test(polarity_of_inputs),
      cmocka_unit_test(filtered_inputs_last),
      cmocka_unit_test(inhibit_time_keeps_tpdos_apart),
      cmocka_unit_test(event_timer_repeats_the_tpdo),
      cmocka_unit_test(synchronous_tpdos),
      cmocka_unit_test(tpdo_on_request),
      cmocka_unit_test(lost_heartbeat_sets_error_values),
      cmocka_unit_test(error_values_are_per_output),
      cmocka_unit_test(error_behaviour_chooses_the_state),
      cmocka_unit_test(a_node_is_watched_once),
      cmocka_unit_test(leaving_operational_sets_error_values),
      cmocka_unit_test(without_optional_objects),
      cmocka_unit_test(silent_without_interrupts),
      cmocka_unit_test(tells_a_tpdo_that_becomes_valid),
      cmocka_unit_test(silent_at_start),
      cmocka_unit_test(starts_itself),
      cmocka_unit_test(fixed_mapping),
      cmocka_unit_test(cob_ids_that_are_kept),
      cmocka_unit_test(least_event_timer),
      cmocka_unit_test(outputs_that_are_kept),
      cmocka_unit_test(power),
      cmocka_unit_test(is_a_node_on_a_wire),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
