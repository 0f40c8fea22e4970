// WebSockets, right and wrong.
#include <string>
#include <thread>

#include "tests/cmocka.hpp"
#include "web-ui/server/tests/served.hpp"

namespace flexrf::panel::live_test {
namespace {

/// Time limits which nothing but a hang exceeds: what a test is about has one of its own.
ServerSettings patient() {
  ServerSettings settings;
  settings.header_timeout = settings.write_timeout = settings.live_silence = std::chrono::minutes{1};
  return settings;
}

int serve_with(void** state, const ServerSettings& settings) {
  *state = new Served(settings);
  return 0;
}

int serve(void** state) {
  return serve_with(state, patient());
}

int serve_briefly(void** state) {
  ServerSettings settings = patient();
  settings.live_silence = std::chrono::milliseconds{300};
  return serve_with(state, settings);
}

int serve_impatiently(void** state) {
  ServerSettings settings = patient();
  settings.write_timeout = std::chrono::milliseconds{300};
  return serve_with(state, settings);
}

/// A close waits as long as it takes to send what came before it.
int serve_to_the_end(void** state) {
  ServerSettings settings = patient();
  settings.linger_timeout = std::chrono::minutes{1};
  return serve_with(state, settings);
}

/// What a server that is kept from its work takes in each second is still more.
int serve_sparingly(void** state) {
  ServerSettings settings = patient();
  settings.live_message_rate = 500;
  return serve_with(state, settings);
}

int end(void** state) {
  delete static_cast<Served*>(*state);
  return 0;
}

Served& served(void** state) {
  return *static_cast<Served*>(*state);
}

Client& open_live(void** state, std::size_t index = 0) {
  Client& client = served(state).clients[index];
  assert_true(client.connect(served(state).port()));
  served(state).text = client.upgrade();
  assert_int_equal(status_of(served(state).text), 101);
  return client;
}

void wait_for_closed(void** state, int count) {
  while (served(state).handlers.closed < count) std::this_thread::sleep_for(std::chrono::milliseconds{5});
}

void messages_go_both_ways(void** state) {
  Client& client = open_live(state);
  assert_true(has(served(state).text, "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"));
  assert_true(has(served(state).text, "Sec-WebSocket-Protocol: flexrf.v1\r\n"));
  for (int i = 0; i < 200; ++i) {
    client.send_text("message");
    const Client::Frame frame = client.frame();
    assert_int_equal(frame.first_byte, 0x81);
    assert_string_equal(frame.payload.c_str(), "message");
  }
  const std::string longest(live_message_limit, 'a');
  client.send_text(longest);
  assert_int_equal(client.frame().payload.size(), longest.size());
}

void fragments_are_put_together(void** state) {
  Client& client = open_live(state);
  client.send_frame(0x01, "one ");
  client.send_frame(0x00, "");
  client.send_frame(0x89, "in between");
  client.send_frame(0x00, "two ");
  client.send_frame(0x80, "three");
  Client::Frame frame = client.frame();
  assert_int_equal(frame.first_byte, 0x8A);
  assert_string_equal(frame.payload.c_str(), "in between");
  frame = client.frame();
  assert_string_equal(frame.payload.c_str(), "one two three");
}

void either_side_may_close(void** state) {
  open_live(state).send_text("close");
  assert_int_equal(served(state).clients[0].close_code(), 4000);
  served(state).clients[0].send_frame(0x88, "\x0F\xA0");
  assert_true(served(state).clients[0].ends());
  wait_for_closed(state, 1);
  open_live(state).send_frame(0x88, "\x03\xE8");
  assert_int_equal(served(state).clients[0].close_code(), 1000);
  assert_true(served(state).clients[0].ends());
  wait_for_closed(state, 2);
  open_live(state).close();
  wait_for_closed(state, 3);
  assert_int_equal(served(state).handlers.opened, 3);
}

struct WrongUpgrade {
  const char* subprotocol;
  const char* more;
  unsigned status;
};

void wrong_upgrades_are_refused(void** state) {
  const WrongUpgrade cases[] = {
      {nullptr, "", 400},
      {"flexrf.v2", "", 400},
      {"flexrf.v11, other", "", 400},
      {"flexrf.v1", "Origin: http://evil.test\r\n", 403},
      {"flexrf.v1", "Origin: null\r\n", 403},
  };
  for (const WrongUpgrade& wrong : cases) {
    Client& client = served(state).clients[0];
    assert_true(client.connect(served(state).port()));
    served(state).text = client.upgrade(wrong.subprotocol, wrong.more);
    assert_int_equal(status_of(served(state).text), wrong.status);
  }
  Client& client = served(state).clients[0];
  assert_true(client.connect(served(state).port()));
  client.send(get("/api/v1/live",
                  "Connection: upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 12\r\n"
                  "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: flexrf.v1\r\n"));
  served(state).text = client.reply();
  assert_int_equal(status_of(served(state).text), 426);
  assert_true(has(served(state).text, "Sec-WebSocket-Version: 13\r\n"));
  assert_int_equal(served(state).handlers.opened, 0);
  assert_true(client.connect(served(state).port()));
  assert_int_equal(status_of(client.upgrade("other, flexrf.v1", "Origin: http://panel.test\r\n")), 101);
}

struct WrongFrame {
  const char* what;
  std::uint8_t first_byte;
  std::string payload;
  bool masked;
  unsigned code;
};

void wrong_frames_end_the_connection(void** state) {
  static const WrongFrame cases[] = {
      {"unmasked", 0x81, "text", false, 1002},
      {"a reserved bit", 0xC1, "text", true, 1002},
      {"a reserved opcode", 0x83, "text", true, 1002},
      {"a continuation of nothing", 0x80, "text", true, 1002},
      {"a long ping", 0x89, std::string(126, 'p'), true, 1002},
      {"a ping in parts", 0x09, "p", true, 1002},
      {"no UTF-8", 0x81, "\xC0\xAF", true, 1007},
      {"binary", 0x82, "bytes", true, 1003},
      {"too long", 0x81, std::string(live_message_limit + 1, 'a'), true, 1009},
      {"far too long", 0x81, std::string(1U << 20U, 'a'), true, 1009},
  };
  int closed = 0;
  for (const WrongFrame& wrong : cases) {
    Client& client = open_live(state);
    client.send_frame(wrong.first_byte, wrong.payload, wrong.masked);
    const unsigned code = client.close_code();
    if (code != wrong.code) print_error("%s: %u\n", wrong.what, code);
    // Beast tells broken text as a breach of the protocol.
    assert_true(code == wrong.code || (wrong.code == 1007 && code == 1002));
    client.close();
    wait_for_closed(state, ++closed);
  }
  assert_int_equal(served(state).handlers.texts, 0);
}

void a_message_too_long_in_parts_ends_the_connection(void** state) {
  Client& client = open_live(state);
  client.send_frame(0x01, std::string(10'000, 'a'));
  client.send_frame(0x00, std::string(10'000, 'a'));
  assert_int_equal(client.close_code(), 1009);
}

void who_sends_too_much_is_closed_and_starves_nobody(void** state) {
  open_live(state, 0);
  open_live(state, 1);
  // A great many small frames, as fast as they go.
  std::string& flood = served(state).text;
  flood.clear();
  for (int i = 0; i < 20'000; ++i) flood.append("\x81\x81\x00\x00\x00\x00y", 7);
  std::thread sender([&] { served(state).clients[0].send(flood); });
  bool all_came_back = true;
  for (int i = 0; i < 50; ++i) {
    served(state).clients[1].send_text("z");
    all_came_back = served(state).clients[1].frame().payload == "z" && all_came_back;
  }
  sender.join();
  assert_true(all_came_back);
  assert_int_equal(served(state).clients[0].close_code(), 1008);
}

void who_pings_too_much_is_closed(void** state) {
  Client& client = open_live(state);
  std::string& flood = served(state).text;
  flood.clear();
  for (int i = 0; i < 20'000; ++i) flood.append("\x89\x80\x00\x00\x00\x00", 6);
  std::thread sender([&] { client.send(flood); });
  const unsigned code = client.close_code();
  sender.join();
  assert_int_equal(code, 1008);
}

void silent_clients_are_closed(void** state) {
  Client& client = open_live(state);
  assert_int_equal(client.close_code(), 1008);
  wait_for_closed(state, 1);
}

void a_client_that_does_not_read_is_cut_and_delays_nobody(void** state) {
  open_live(state, 0).narrow();
  served(state).clients[0].send_text("flood");
  open_live(state, 1);
  for (int i = 0; i < 100; ++i) {
    served(state).clients[1].send_text("z");
    assert_string_equal(served(state).clients[1].frame().payload.c_str(), "z");
  }
  wait_for_closed(state, 1);
  served(state).clients[1].send_text("z");
  assert_string_equal(served(state).clients[1].frame().payload.c_str(), "z");
}

/// Reads what "much" was answered with: true, all came whole and in order, and so many pongs between them.
bool much_came(Client& client, int pongs) {
  std::size_t number = 0;
  while (number < TestHandlers::much_messages || pongs > 0) {
    const Client::Frame frame = client.frame();
    if (frame.first_byte == 0x8A && frame.payload == "ping") {
      --pongs;
    } else if (frame.first_byte == 0x82 &&
               frame.payload == std::string(TestHandlers::much_size, TestHandlers::byte_of(number))) {
      ++number;
    } else {
      return false;
    }
  }
  return pongs == 0;
}

void what_the_socket_takes_in_parts_comes_whole(void** state) {
  Client& client = open_live(state);
  client.send_text("much");
  // Answered while half a message is out, and nobody reads.
  for (int i = 0; i < 3; ++i) client.send_frame(0x89, "ping");
  assert_string_equal(client.frame().payload.c_str(), "much");
  assert_true(much_came(client, 3));
  // And after such a ping by the other way, and then by the first again.
  client.send_text("much");
  assert_string_equal(client.frame().payload.c_str(), "much");
  assert_true(much_came(client, 0));
}

/// Of the close that ends what "much" was answered with; 0: not all before it came whole and in order.
std::uint16_t close_code_amid_much(Client& client) {
  for (std::size_t number = 0;; ++number) {
    const Client::Frame frame = client.frame();
    if (frame.first_byte == 0x88) return frame.close_code();
    if (frame.payload != std::string(TestHandlers::much_size, TestHandlers::byte_of(number))) return 0;
  }
}

void a_close_comes_after_the_message_that_is_half_out(void** state) {
  Client& client = open_live(state);
  client.send_text("much");
  client.send_text("close");
  assert_string_equal(client.frame().payload.c_str(), "much");
  assert_int_equal(close_code_amid_much(client), 4000);
}

void the_end_of_the_server_is_told(void** state) {
  Client& client = open_live(state);
  client.send_text("hello");
  assert_string_equal(client.frame().payload.c_str(), "hello");
  served(state).stop();
  assert_int_equal(client.close_code(), 1001);
  client.send_frame(0x88, "\x03\xE9");
  assert_true(client.ends());
}

}  // namespace
}  // namespace flexrf::panel::live_test

int main() {
  using namespace flexrf::panel::live_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(messages_go_both_ways, serve, end),
      cmocka_unit_test_setup_teardown(fragments_are_put_together, serve, end),
      cmocka_unit_test_setup_teardown(either_side_may_close, serve, end),
      cmocka_unit_test_setup_teardown(wrong_upgrades_are_refused, serve, end),
      cmocka_unit_test_setup_teardown(wrong_frames_end_the_connection, serve, end),
      cmocka_unit_test_setup_teardown(a_message_too_long_in_parts_ends_the_connection, serve, end),
      cmocka_unit_test_setup_teardown(who_sends_too_much_is_closed_and_starves_nobody, serve_sparingly, end),
      cmocka_unit_test_setup_teardown(who_pings_too_much_is_closed, serve_sparingly, end),
      cmocka_unit_test_setup_teardown(silent_clients_are_closed, serve_briefly, end),
      cmocka_unit_test_setup_teardown(a_client_that_does_not_read_is_cut_and_delays_nobody, serve_impatiently,
                                      end),
      cmocka_unit_test_setup_teardown(what_the_socket_takes_in_parts_comes_whole, serve, end),
      cmocka_unit_test_setup_teardown(a_close_comes_after_the_message_that_is_half_out, serve_to_the_end,
                                      end),
      cmocka_unit_test_setup_teardown(the_end_of_the_server_is_told, serve, end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
