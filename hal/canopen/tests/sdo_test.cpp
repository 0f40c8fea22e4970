// SDO: the client's bytes, client and server together, and what goes wrong between them.
#include <cstring>

#include "hal/canopen/sdo_abort.hpp"
#include "hal/canopen/sdo_client.hpp"
#include "hal/canopen/sdo_server.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::canopen {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t node = 2;
constexpr ObjectAddress number_object{0x6041, 0};
constexpr ObjectAddress text_object{0x1008, 0};
constexpr ObjectAddress constant_object{0x1000, 0};

Time at(int ms) {
  return Time{std::chrono::seconds(1) + milliseconds(ms)};
}

class Objects final : public ObjectDictionary {
 public:
  std::uint32_t read(ObjectAddress object, std::span<std::uint8_t> value, std::size_t& size) override {
    if (object == text_object) {
      std::copy_n(text, text_size, value.begin());
      size = text_size;
      return 0;
    }
    if (object == number_object) {
      write_number(value.data(), number_size, number);
      size = number_size;
      return 0;
    }
    if (object == constant_object) {
      write_number(value.data(), 4, 0x00020192);
      size = 4;
      return 0;
    }
    return sdo_abort::no_object;
  }
  std::uint32_t write(ObjectAddress object, std::span<const std::uint8_t> value) override {
    if (object == constant_object) return sdo_abort::read_only;
    if (object == text_object) {
      std::copy(value.begin(), value.end(), text);
      text_size = value.size();
      return 0;
    }
    if (object != number_object) return sdo_abort::no_object;
    if (value.size() > number_size) return sdo_abort::too_long;
    number = read_number(value.data(), value.size());
    return 0;
  }

  std::uint8_t text[SdoServer::capacity] = {'d', 'r', 'i', 'v', 'e', ' ', 'o', 'n', 'e'};
  std::size_t text_size = 9;
  std::uint64_t number = 0x0237;
  std::size_t number_size = 2;
};

struct Pair {
  Objects objects;
  SdoServer server{node, objects};
  SdoClient client{node, milliseconds(500)};
  Outbox outbox;
  unsigned requests = 0;

  // Carries messages to and fro until nobody has anything to say.
  void settle() {
    while (!outbox.is_empty()) {
      const Message request = outbox.front();
      outbox.pop();
      ++requests;
      if (const auto answer = server.receive(request)) client.receive(*answer, at(1), outbox);
    }
  }
  Message sent() {
    const Message message = outbox.front();
    outbox.pop();
    return message;
  }
};

void a_small_object_is_read_in_one_piece(void**) {
  Pair pair;
  assert_true(pair.client.read(number_object, at(0), pair.outbox));
  assert_true(pair.outbox.front() == (Message{0x602, 8, {0x40, 0x41, 0x60, 0x00}}));
  assert_false(pair.client.read(number_object, at(0), pair.outbox));
  pair.settle();
  assert_true(pair.client.state() == SdoClient::State::done);
  assert_int_equal(pair.client.value().size(), 2);
  assert_int_equal(pair.client.number(), 0x0237);
  assert_true(pair.client.status().is_ok());
}

void answers_of_each_size_are_understood(void**) {
  struct Case {
    std::uint8_t command;
    std::size_t size;
  };
  for (const Case& each : {Case{0x43, 4}, Case{0x47, 3}, Case{0x4B, 2}, Case{0x4F, 1}, Case{0x42, 4}}) {
    Pair pair;
    pair.client.read(number_object, at(0), pair.outbox);
    pair.client.receive({0x582, 8, {each.command, 0x41, 0x60, 0, 1, 2, 3, 4}}, at(1), pair.outbox);
    assert_true(pair.client.state() == SdoClient::State::done);
    assert_int_equal(pair.client.value().size(), each.size);
    assert_int_equal(pair.client.value()[0], 1);
  }
}

void values_of_up_to_four_bytes_are_written_in_one_piece(void**) {
  const std::uint8_t commands[] = {0x2F, 0x2B, 0x27, 0x23};
  for (std::size_t size = 1; size <= 4; ++size) {
    Pair pair;
    pair.objects.number_size = 4;
    const std::uint8_t value[] = {0x11, 0x22, 0x33, 0x44};
    assert_true(pair.client.write(number_object, {value, size}, at(0), pair.outbox));
    assert_int_equal(pair.outbox.front().data[0], commands[size - 1]);
    pair.settle();
    assert_true(pair.client.state() == SdoClient::State::done);
    assert_int_equal(pair.objects.number, read_number(value, size));
  }
}

void texts_are_read_and_written_in_segments(void**) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{7}, std::size_t{8},
                                 std::size_t{14}, std::size_t{200}, SdoClient::capacity}) {
    Pair pair;
    std::uint8_t text[SdoClient::capacity];
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<std::uint8_t>(i * 7 + 1);
    assert_true(pair.client.write(text_object, {text, size}, at(0), pair.outbox));
    pair.settle();
    assert_true(pair.client.state() == SdoClient::State::done);
    assert_int_equal(pair.objects.text_size, size);
    pair.requests = 0;
    assert_true(pair.client.read(text_object, at(0), pair.outbox));
    pair.settle();
    assert_true(pair.client.state() == SdoClient::State::done);
    assert_int_equal(pair.client.value().size(), size);
    assert_memory_equal(pair.client.value().data(), text, size);
    assert_int_equal(pair.requests, 1 + std::max<std::size_t>(1, (size + 6) / 7));
  }
}

void what_is_too_long_is_not_begun(void**) {
  Pair pair;
  const std::uint8_t text[SdoClient::capacity + 1] = {};
  assert_false(pair.client.write(text_object, text, at(0), pair.outbox));
  assert_true(pair.outbox.is_empty());
}

void an_abort_is_told_in_words(void**) {
  Pair pair;
  pair.client.read({0x2FFF, 3}, at(0), pair.outbox);
  pair.settle();
  assert_int_equal(pair.client.abort_code(), sdo_abort::no_object);
  const Status status = pair.client.status();
  assert_non_null(
      std::strstr(status.cause(), "2FFF:03 of node 2 was aborted by the node: there is no such object"));
  const std::uint8_t value[] = {0, 0, 0, 0};
  pair.client.write(constant_object, value, at(0), pair.outbox);
  pair.settle();
  assert_int_equal(pair.client.abort_code(), sdo_abort::read_only);
  pair.client.write(number_object, value, at(0), pair.outbox);
  pair.settle();
  assert_int_equal(pair.client.abort_code(), sdo_abort::too_long);
}

void silence_ends_a_transfer_and_the_late_answer_is_dropped(void**) {
  Pair pair;
  pair.client.read(number_object, at(0), pair.outbox);
  const Message late = *pair.server.receive(pair.sent());
  pair.client.advance(at(500), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::busy);
  pair.client.advance(at(501), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::failed);
  assert_true(pair.client.status().code() == StatusCode::timeout);
  assert_true(pair.sent() == (Message{0x602, 8, {0x80, 0x41, 0x60, 0, 0, 0, 0x04, 0x05}}));
  pair.client.read(constant_object, at(600), pair.outbox);
  pair.client.receive(late, at(601), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::busy);
  assert_int_equal(pair.client.dropped(), 1);
  pair.settle();
  assert_true(pair.client.state() == SdoClient::State::done);
  assert_int_equal(pair.client.number(), 0x00020192);
  pair.client.receive(late, at(602), pair.outbox);
  assert_int_equal(pair.client.dropped(), 2);
  assert_int_equal(pair.client.number(), 0x00020192);
}

void each_segment_has_its_own_time(void**) {
  Pair pair;
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive(*pair.server.receive(pair.sent()), at(400), pair.outbox);
  pair.client.advance(at(800), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::busy);
  pair.client.advance(at(901), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::failed);
}

void garbage_is_dropped(void**) {
  Pair pair;
  pair.client.read(number_object, at(0), pair.outbox);
  pair.outbox.clear();
  const Message garbage[] = {
      {0x582, 7, {0x4B, 0x41, 0x60, 0}},              // cut short
      {0x582, 8, {0x4B, 0x42, 0x60, 0}},              // of another object
      {0x582, 8, {0x60, 0x41, 0x60, 0}},              // answers a write
      {0x582, 8, {0x00, 0x41, 0x60, 0}},              // a segment
      {0x582, 8, {0xFF, 0xFF, 0xFF, 0xFF}},           // noise
      {0x582, 8, {0x80, 0x42, 0x60, 0, 0, 0, 2, 6}},  // aborts another object
  };
  for (const Message& each : garbage) pair.client.receive(each, at(1), pair.outbox);
  assert_int_equal(pair.client.dropped(), std::size(garbage));
  pair.client.receive({0x583, 8, {0x4B, 0x41, 0x60, 0, 1}}, at(1), pair.outbox);  // another node's
  assert_true(pair.client.state() == SdoClient::State::busy);
  assert_true(pair.outbox.is_empty());
}

void a_segment_that_comes_twice_ends_the_transfer(void**) {
  Pair pair;
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive(*pair.server.receive(pair.sent()), at(1), pair.outbox);
  const Message segment = *pair.server.receive(pair.sent());
  pair.client.receive(segment, at(1), pair.outbox);
  pair.outbox.clear();
  pair.client.receive(segment, at(1), pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::failed);
  assert_int_equal(pair.client.abort_code(), sdo_abort::toggle);
  assert_int_equal(pair.sent().data[0], 0x80);
  assert_non_null(std::strstr(pair.client.status().cause(), "by us"));
}

void a_server_that_sends_too_much_or_too_little_is_refused(void**) {
  Pair pair;
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive({0x582, 8, {0x41, 0x08, 0x10, 0, 0x01, 0x01, 0, 0}}, at(1), pair.outbox);
  assert_int_equal(pair.client.abort_code(), sdo_abort::out_of_memory);
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive({0x582, 8, {0x41, 0x08, 0x10, 0, 9}}, at(1), pair.outbox);
  pair.client.receive({0x582, 8, {0x01, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}}, at(1), pair.outbox);
  assert_int_equal(pair.client.abort_code(), sdo_abort::wrong_length);
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive({0x582, 8, {0x40, 0x08, 0x10, 0}}, at(1), pair.outbox);
  for (int i = 0; pair.client.state() == SdoClient::State::busy; ++i) {
    pair.client.receive({0x582, 8, {static_cast<std::uint8_t>((i & 1) << 4)}}, at(1), pair.outbox);
  }
  assert_int_equal(pair.client.abort_code(), sdo_abort::out_of_memory);
}

void a_cancelled_transfer_leaves_the_server_free(void**) {
  Pair pair;
  pair.client.read(text_object, at(0), pair.outbox);
  pair.client.receive(*pair.server.receive(pair.sent()), at(1), pair.outbox);
  pair.outbox.clear();
  pair.client.cancel(pair.outbox);
  assert_true(pair.client.state() == SdoClient::State::idle);
  pair.settle();
  pair.client.read(number_object, at(2), pair.outbox);
  pair.settle();
  assert_int_equal(pair.client.number(), 0x0237);
}

// As a server in the field was seen to do.
void a_server_refuses_what_interrupts_a_transfer(void**) {
  Pair pair;
  const Message read_text{0x602, 8, {0x40, 0x08, 0x10}};
  const Message read_number_object{0x602, 8, {0x40, 0x41, 0x60}};
  assert_int_equal(pair.server.receive(read_text)->data[0], 0x41);
  const auto refusal = pair.server.receive(read_number_object);
  assert_true(*refusal == (Message{0x582, 8, {0x80, 0x41, 0x60, 0, 0x01, 0, 0x04, 0x05}}));
  assert_int_equal(pair.server.receive(read_number_object)->data[0], 0x4B);
  assert_false(pair.server.receive({0x603, 8, {0x40}}).has_value());
  assert_false(pair.server.receive({0x602, 7, {0x40}}).has_value());
  assert_int_equal(pair.server.receive({0x602, 8, {0xE0}})->data[0], 0x80);
}

// They ask for bytes and carry none.
void remote_frames_are_no_transfer(void**) {
  SdoClient client(node, milliseconds(100));
  Outbox outbox;
  assert_true(client.read(number_object, at(0), outbox));
  client.receive({0x582, 8, {0x4B, 0x41, 0x60, 0}, true}, at(1), outbox);
  assert_true(client.state() == SdoClient::State::busy);
  assert_int_equal(client.dropped(), 1);
  Objects objects;
  SdoServer server(node, objects);
  Message request{0x602, 8, {0x40, 0x41, 0x60, 0}};
  assert_true(server.receive(request).has_value());
  request.remote = true;
  assert_false(server.receive(request).has_value());
}

}  // namespace
}  // namespace flexrf::canopen

int main() {
  using namespace flexrf::canopen;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_small_object_is_read_in_one_piece),
      cmocka_unit_test(answers_of_each_size_are_understood),
      cmocka_unit_test(values_of_up_to_four_bytes_are_written_in_one_piece),
      cmocka_unit_test(texts_are_read_and_written_in_segments),
      cmocka_unit_test(what_is_too_long_is_not_begun),
      cmocka_unit_test(an_abort_is_told_in_words),
      cmocka_unit_test(silence_ends_a_transfer_and_the_late_answer_is_dropped),
      cmocka_unit_test(each_segment_has_its_own_time),
      cmocka_unit_test(garbage_is_dropped),
      cmocka_unit_test(a_segment_that_comes_twice_ends_the_transfer),
      cmocka_unit_test(a_server_that_sends_too_much_or_too_little_is_refused),
      cmocka_unit_test(a_cancelled_transfer_leaves_the_server_free),
      cmocka_unit_test(a_server_refuses_what_interrupts_a_transfer),
      cmocka_unit_test(remote_frames_are_no_transfer),
  };
  return cmocka_run_group_tests_name("canopen sdo", tests, nullptr, nullptr);
}
