// What the server says to requests, right and wrong.
#include <string>
#include <thread>

#include "tests/cmocka.hpp"
#include "web-ui/server/tests/served.hpp"

namespace flexrf::panel::http_test {
namespace {

/// Time limits which nothing but a hang exceeds: what a test is about has one of its own.
ServerSettings patient() {
  ServerSettings settings;
  settings.header_timeout = settings.body_timeout = settings.idle_timeout = std::chrono::minutes{1};
  settings.write_timeout = settings.reply_timeout = settings.linger_timeout = std::chrono::minutes{1};
  return settings;
}

int serve_with(void** state, const ServerSettings& settings) {
  *state = new Served(settings);
  return 0;
}

int serve(void** state) {
  return serve_with(state, patient());
}

/// Who is connected need not say so.
int serve_patiently(void** state) {
  ServerSettings settings = patient();
  settings.live_silence = std::chrono::minutes{1};
  return serve_with(state, settings);
}

int serve_few(void** state) {
  ServerSettings settings = patient();
  settings.places = 2;
  settings.live_silence = std::chrono::minutes{1};
  return serve_with(state, settings);
}

/// 127.0.0.9 is local, and other addresses of this machine are as good as other machines.
int serve_addresses(void** state) {
  ServerSettings settings = patient();
  settings.places = 16;
  settings.live_silence = std::chrono::minutes{1};
  settings.loopback_is_local = false;
  settings.local = {*Address::parse("127.0.0.9")};
  return serve_with(state, settings);
}

int serve_slow_headers(void** state) {
  ServerSettings settings = patient();
  settings.header_timeout = std::chrono::milliseconds{200};
  return serve_with(state, settings);
}

int serve_slow_bodies(void** state) {
  ServerSettings settings = patient();
  settings.body_timeout = std::chrono::milliseconds{200};
  return serve_with(state, settings);
}

/// Who asks at once has to be quicker than this.
int serve_silent(void** state) {
  ServerSettings settings = patient();
  settings.idle_timeout = std::chrono::seconds{4};
  return serve_with(state, settings);
}

int serve_without_answers(void** state) {
  ServerSettings settings = patient();
  settings.reply_timeout = std::chrono::milliseconds{300};
  return serve_with(state, settings);
}

int serve_slow_readers(void** state) {
  ServerSettings settings = patient();
  settings.write_timeout = std::chrono::milliseconds{300};
  return serve_with(state, settings);
}

int end(void** state) {
  delete static_cast<Served*>(*state);
  return 0;
}

Client& client_of(void** state, std::size_t index = 0) {
  auto& served = *static_cast<Served*>(*state);
  assert_true(served.clients[index].connect(served.port()));
  return served.clients[index];
}

/// Sends the text on a connection of its own; the reply stays in the state.
const std::string& ask(void** state, std::string_view request) {
  auto& served = *static_cast<Served*>(*state);
  Client& client = client_of(state);
  client.send(request);
  served.text = client.reply();
  return served.text;
}

void a_request_is_answered(void** state) {
  const std::string& text = ask(state, get("/hello"));
  assert_int_equal(status_of(text), 200);
  assert_true(has(text, "Content-Type: application/json\r\n"));
  assert_true(has(text, "ETag: \"1\"\r\n"));
  assert_true(
      has(text, "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "));
  assert_true(has(text, "X-Content-Type-Options: nosniff\r\n"));
  assert_true(has(text, "Referrer-Policy: no-referrer\r\n"));
  assert_true(has(text, "Cross-Origin-Resource-Policy: same-origin\r\n"));
  assert_true(has(text, "\r\n\r\n{\"hello\":true}"));
}

void a_connection_is_kept(void** state) {
  Client& client = client_of(state);
  for (int i = 0; i < 100; ++i) {
    client.send(get("/hello"));
    assert_int_equal(status_of(client.reply()), 200);
  }
  client.send("GET /hello HTTP/1.0\r\nHost: panel.test\r\n\r\n");
  assert_true(has(client.reply(), "Connection: close\r\n"));
  assert_true(client.ends());
}

void head_has_no_body(void** state) {
  Client& client = client_of(state);
  client.send("HEAD /hello HTTP/1.1\r\nHost: panel.test\r\n\r\n" + get("/later"));
  assert_true(has(client.reply(false), "Content-Length: 14\r\n"));
  assert_true(has(client.reply(), "\r\n\r\nlater"));
}

void pipelined_requests_are_answered_in_order(void** state) {
  Client& client = client_of(state);
  client.send(get("/later") + post("/echo", "1") + get("/hello") + post("/echo", "2"));
  assert_true(has(client.reply(), "\r\n\r\nlater"));
  assert_true(has(client.reply(), "\r\n\r\n1"));
  assert_true(has(client.reply(), "hello"));
  assert_true(has(client.reply(), "\r\n\r\n2"));
}

void pipelined_garbage_ends_the_connection(void** state) {
  Client& client = client_of(state);
  client.send(get("/hello") + std::string(300, '\xFF') + "\r\n\r\n" + get("/hello"));
  assert_int_equal(status_of(client.reply()), 200);
  assert_int_equal(status_of(client.reply()), 400);
  assert_true(client.ends());
}

void a_large_reply_arrives_whole(void** state) {
  const std::string& text = ask(state, get("/large"));
  assert_int_equal(status_of(text), 200);
  assert_int_equal(body_of_text(text).size(), 8U << 20U);
}

void bodies_arrive_in_pieces(void** state) {
  Client& client = client_of(state);
  client.send(
      "POST /echo HTTP/1.1\r\nHost: panel.test\r\nContent-Type: application/json\r\nContent-Length: "
      "6\r\n\r\n{");
  client.send("    }");
  assert_string_equal(body_of_text(client.reply()).c_str(), "{    }");
  client.send(
      "POST /echo HTTP/1.1\r\nHost: panel.test\r\nContent-Type: application/json\r\n"
      "Transfer-Encoding: chunked\r\n\r\n2\r\n{ \r\n");
  client.send("2\r\n }\r\n0\r\nHost: elsewhere\r\n\r\n");
  assert_string_equal(body_of_text(client.reply()).c_str(), "{  }");
  // Chunk after chunk, cut anywhere.
  std::string& chunks = static_cast<Served*>(*state)->text;
  chunks =
      "POST /echo HTTP/1.1\r\nHost: panel.test\r\nContent-Type: application/json\r\n"
      "Transfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 5000; ++i) chunks += "3\r\n123\r\n";
  client.send(chunks + "0\r\n\r\n");
  assert_int_equal(body_of_text(client.reply()).size(), 15'000);
  // As large as it may be.
  const std::string body(64U << 10U, ' ');
  client.send(post("/echo", body));
  assert_int_equal(body_of_text(client.reply()).size(), body.size());
}

void continue_is_said(void** state) {
  Client& client = client_of(state);
  client.send(
      "POST /echo HTTP/1.1\r\nHost: panel.test\r\nContent-Type: application/json\r\nContent-Length: 2\r\n"
      "Expect: 100-continue\r\n\r\n");
  assert_int_equal(status_of(client.reply()), 100);
  client.send("{}");
  assert_true(has(client.reply(), "\r\n\r\n{}"));
}

void half_open_clients_get_their_answer(void** state) {
  Client& client = client_of(state);
  client.send(get("/hello"));
  client.finish();
  assert_int_equal(status_of(client.reply()), 200);
  assert_true(client.ends());
}

struct Wrong {
  const char* what;
  std::string request;
  unsigned status;
};

void wrong_requests_are_refused(void** state) {
  const std::string host = "Host: panel.test\r\n";
  static const Wrong cases[] = {
      {"no method", " / HTTP/1.1\r\n" + host + "\r\n", 400},
      {"no version", "GET /\r\n" + host + "\r\n", 400},
      {"version 2", "GET / HTTP/2.0\r\n" + host + "\r\n", 505},
      {"a bare line feed", "GET / HTTP/1.1\n" + host + "\n", 505},
      {"another method", "DELETE /hello HTTP/1.1\r\n" + host + "\r\n", 405},
      {"an unknown method", "BREW /hello HTTP/1.1\r\n" + host + "\r\n", 405},
      {"no host", "GET /hello HTTP/1.1\r\n\r\n", 400},
      {"two hosts", "GET /hello HTTP/1.1\r\n" + host + host + "\r\n", 400},
      {"a foreign host", "GET /hello HTTP/1.1\r\nHost: evil.test\r\n\r\n", 421},
      {"a foreign origin", "POST /echo HTTP/1.1\r\n" + host + "Origin: http://evil.test\r\n\r\n", 403},
      {"an absolute target", "GET http://panel.test/hello HTTP/1.1\r\n" + host + "\r\n", 400},
      {"a wrong escape", "GET /%4 HTTP/1.1\r\n" + host + "\r\n", 400},
      {"a zero in the path", "GET /a%00b HTTP/1.1\r\n" + host + "\r\n", 400},
      {"a way up", "GET /a/%2e%2e/b HTTP/1.1\r\n" + host + "\r\n", 400},
      {"a continued line", "GET /hello HTTP/1.1\r\n" + host + "X: a\r\n b\r\n\r\n", 400},
      {"a field without a colon", "GET /hello HTTP/1.1\r\n" + host + "nonsense\r\n\r\n", 400},
      {"another expectation", "GET /hello HTTP/1.1\r\n" + host + "Expect: miracles\r\n\r\n", 417},
      {"another type", post("/echo", "a=b", "application/x-www-form-urlencoded"), 415},
      {"two lengths", "POST /echo HTTP/1.1\r\n" + host + "Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}",
       400},
      {"a negative length", "POST /echo HTTP/1.1\r\n" + host + "Content-Length: -2\r\n\r\n{}", 400},
      {"two ways to tell the length",
       "POST /echo HTTP/1.1\r\n" + host + "Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
       400},
      {"a broken chunk", "POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\nz\r\n", 400},
      {"a large body", "POST /echo HTTP/1.1\r\n" + host + "Content-Length: 65537\r\n\r\n", 413},
      {"a large chunk", "POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n10001\r\n",
       413},
      {"a long target", "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n", 431},
      {"a long field", "GET / HTTP/1.1\r\n" + host + "X: " + std::string(9000, 'a') + "\r\n\r\n", 431},
      {"many fields",
       "GET / HTTP/1.1\r\n" + host +
           [] {
             std::string fields;
             while (fields.size() < 9000) fields += "X: a\r\n";
             return fields;
           }() +
           "\r\n",
       431},
      {"nothing of this name", get("/nothing"), 404},
      {"no upgrade", get("/api/v1/live"), 426},
  };
  for (const Wrong& wrong : cases) {
    const std::string& text = ask(state, wrong.request);
    if (status_of(text) != wrong.status) print_error("%s: %s\n", wrong.what, text.c_str());
    assert_int_equal(status_of(text), wrong.status);
    assert_true(has(text, "Content-Type: application/problem+json\r\n"));
    assert_true(has(text, "\"type\":\"about:blank\""));
    assert_true(has(text, "X-Content-Type-Options: nosniff\r\n"));
  }
  assert_true(has(ask(state, "DELETE / HTTP/1.1\r\n" + host + "\r\n"), "Allow: GET, HEAD, PUT, POST\r\n"));
}

/// Live connections, which make room for nobody.
void more_clients_than_places_get_503(void** state) {
  auto& served = *static_cast<Served*>(*state);
  for (std::size_t i = 0; i < 2; ++i) {
    assert_int_equal(status_of(client_of(state, i).upgrade()), 101);
  }
  for (std::size_t i = 2; i < 6; ++i) {
    client_of(state, i).send(get("/hello"));
    served.text = served.clients[i].reply();
    assert_int_equal(status_of(served.text), 503);
    assert_true(has(served.text, "Retry-After: 2\r\n"));
    assert_true(has(served.text, "close a page that is not needed"));
    assert_true(served.clients[i].ends());
  }
  // Who wants the page is shown one that tries again. There are but so many who are answered at a time: those
  // before may not be gone yet.
  served.text.clear();
  for (int tries = 0; served.text.empty() && tries < 100; ++tries) {
    client_of(state, 6).send(get("/"));
    served.text = served.clients[6].reply();
  }
  assert_int_equal(status_of(served.text), 503);
  assert_true(has(served.text, "Content-Type: text/html"));
  assert_true(has(served.text, "http-equiv=\"refresh\""));
  // Those that have a place keep it, and a place that gets free is given again.
  served.clients[1].send_text("still here");
  assert_string_equal(served.clients[1].frame().payload.c_str(), "still here");
  served.clients[0].close();
  client_of(state, 2).send(get("/hello"));
  assert_int_equal(status_of(served.clients[2].reply()), 200);
}

void who_has_nothing_to_say_makes_room(void** state) {
  auto& served = *static_cast<Served*>(*state);
  for (std::size_t i = 0; i < 2; ++i) {
    client_of(state, i).send(get("/hello"));
    assert_int_equal(status_of(served.clients[i].reply()), 200);
  }
  // An answer may be here before the server has noticed that it has left.
  unsigned status = 503;
  for (int tries = 0; status == 503 && tries < 100; ++tries) {
    client_of(state, 2).send(get("/hello"));
    status = status_of(served.clients[2].reply());
  }
  assert_int_equal(status, 200);
  assert_true(served.clients[0].ends());
}

/// As browsers do: six connections each for the page's files, kept, and one for the page. Of 32 places.
void eight_browsers_have_room(void** state) {
  auto& served = *static_cast<Served*>(*state);
  static std::array<Client, 48> for_files;
  for (Client& client : for_files) {
    assert_true(client.connect(served.port()));
    client.send(get("/hello"));
  }
  for (Client& client : for_files) assert_int_equal(status_of(client.reply()), 200);
  for (std::size_t i = 0; i < 8; ++i) {
    assert_int_equal(status_of(client_of(state, i).upgrade()), 101);
  }
  for (std::size_t i = 0; i < 8; ++i) {
    served.clients[i].send_text("alive");
    assert_string_equal(served.clients[i].frame().payload.c_str(), "alive");
  }
  for (Client& client : for_files) client.close();
}

/// 200 who say nothing, or not all, for as long as they may.
void half_open_connections_keep_nobody_out(void** state) {
  auto& served = *static_cast<Served*>(*state);
  static std::array<Client, 200> silent;
  for (std::size_t i = 0; i < silent.size(); ++i) {
    assert_true(silent[i].connect(served.port()));
    if (i % 2 == 0) silent[i].send("GET / HT");
  }
  for (std::size_t i = 0; i < 5; ++i) {
    client_of(state, i).send(get("/hello"));
    assert_int_equal(status_of(served.clients[i].reply()), 200);
  }
  for (Client& client : silent) client.close();
}

/// Of 16 places 4 are for who is local, and one other address has 9 at most.
void places_are_bounded_per_address(void** state) {
  auto& served = *static_cast<Served*>(*state);
  for (std::size_t i = 0; i < 9; ++i) {
    assert_true(served.clients[i].connect(served.port(), "127.0.0.7"));
    assert_int_equal(status_of(served.clients[i].upgrade()), 101);
  }
  assert_true(served.clients[9].connect(served.port(), "127.0.0.7"));
  served.clients[9].send(get("/hello"));
  served.text = served.clients[9].reply();
  assert_int_equal(status_of(served.text), 503);
  assert_true(
      has(served.text, "this address has all the connections to the panel that one address may have"));
  // Others have room, until what is not reserved is full; who is local has more.
  for (std::size_t i = 10; i < 13; ++i) {
    assert_true(served.clients[i].connect(served.port(), "127.0.0.8"));
    assert_int_equal(status_of(served.clients[i].upgrade()), 101);
  }
  assert_true(served.clients[13].connect(served.port(), "127.0.0.8"));
  assert_int_equal(status_of(served.clients[13].upgrade()), 503);
  for (std::size_t i = 14; i < 18; ++i) {
    assert_true(served.clients[i].connect(served.port(), "127.0.0.9"));
    assert_int_equal(status_of(served.clients[i].upgrade()), 101);
  }
}

void slow_headers_are_given_up(void** state) {
  Client& client = client_of(state);
  client.send("GET /hello HTTP/1.1\r\nHost: pan");
  assert_int_equal(status_of(client.reply()), 408);
  assert_true(client.ends());
}

void slow_bodies_are_given_up(void** state) {
  Client& client = client_of(state);
  client.send("POST /echo HTTP/1.1\r\nHost: panel.test\r\nContent-Length: 10\r\n\r\n{");
  assert_int_equal(status_of(client.reply()), 408);
  assert_true(client.ends());
}

void silent_clients_are_cut(void** state) {
  Client& silent = client_of(state, 1);
  Client& client = client_of(state);
  client.send(get("/hello"));
  assert_int_equal(status_of(client.reply()), 200);
  assert_true(silent.ends());
  assert_true(client.ends());
}

void a_handler_that_never_answers_is_given_up(void** state) {
  assert_int_equal(status_of(ask(state, get("/never"))), 504);
}

void clients_that_do_not_read_are_cut_and_delay_nobody(void** state) {
  auto& served = *static_cast<Served*>(*state);
  for (std::size_t i = 1; i < 6; ++i) {
    client_of(state, i).narrow();
    served.clients[i].send(get("/large"));
  }
  for (int i = 0; i < 10; ++i) assert_int_equal(status_of(ask(state, get("/hello"))), 200);
  served.clients[0].close();
  // The server gives up, so what comes ends before the 8 MiB are complete.
  while (served.handlers.connections_closed < 15) std::this_thread::sleep_for(std::chrono::milliseconds{5});
  for (std::size_t i = 1; i < 6; ++i) assert_int_equal(served.clients[i].reply().size(), 0);
}

}  // namespace
}  // namespace flexrf::panel::http_test

int main() {
  using namespace flexrf::panel::http_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_request_is_answered, serve, end),
      cmocka_unit_test_setup_teardown(a_connection_is_kept, serve, end),
      cmocka_unit_test_setup_teardown(head_has_no_body, serve, end),
      cmocka_unit_test_setup_teardown(pipelined_requests_are_answered_in_order, serve, end),
      cmocka_unit_test_setup_teardown(pipelined_garbage_ends_the_connection, serve, end),
      cmocka_unit_test_setup_teardown(a_large_reply_arrives_whole, serve, end),
      cmocka_unit_test_setup_teardown(bodies_arrive_in_pieces, serve, end),
      cmocka_unit_test_setup_teardown(continue_is_said, serve, end),
      cmocka_unit_test_setup_teardown(half_open_clients_get_their_answer, serve, end),
      cmocka_unit_test_setup_teardown(wrong_requests_are_refused, serve, end),
      cmocka_unit_test_setup_teardown(more_clients_than_places_get_503, serve_few, end),
      cmocka_unit_test_setup_teardown(who_has_nothing_to_say_makes_room, serve_few, end),
      cmocka_unit_test_setup_teardown(eight_browsers_have_room, serve_patiently, end),
      cmocka_unit_test_setup_teardown(half_open_connections_keep_nobody_out, serve, end),
      cmocka_unit_test_setup_teardown(places_are_bounded_per_address, serve_addresses, end),
      cmocka_unit_test_setup_teardown(slow_headers_are_given_up, serve_slow_headers, end),
      cmocka_unit_test_setup_teardown(slow_bodies_are_given_up, serve_slow_bodies, end),
      cmocka_unit_test_setup_teardown(silent_clients_are_cut, serve_silent, end),
      cmocka_unit_test_setup_teardown(a_handler_that_never_answers_is_given_up, serve_without_answers, end),
      cmocka_unit_test_setup_teardown(clients_that_do_not_read_are_cut_and_delay_nobody, serve_slow_readers,
                                      end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
