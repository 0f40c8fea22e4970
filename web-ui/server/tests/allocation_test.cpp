// In the steady state the server's thread takes no memory from the system and gives none back.
#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "runtime/realtime/realtime_scope.hpp"
#include "tests/cmocka.hpp"
#include "web-ui/server/tests/served.hpp"

namespace flexrf::panel {
namespace {

AllocationCounter counter{0};

/// The server runs its ticks in its own thread: there the counting begins and ends.
class Counting {
 public:
  std::atomic<bool> counts{false};
  std::atomic<bool> is_counting{false};

  void on_tick() {
    if (counts && !scope_) scope_.emplace(counter);
    if (!counts) scope_.reset();
    is_counting = scope_.has_value();
  }

 private:
  std::optional<RealtimeScope> scope_;
};

ServerSettings settings_of_talk() {
  ServerSettings settings;
  settings.live_silence = std::chrono::seconds{30};
  return settings;
}

struct Counted {
  ~Counted() { count(false); }
  void count(bool on) {
    ticks.counts = on;
    while (ticks.is_counting != on) std::this_thread::yield();
  }

  Counting ticks;
  Served served{settings_of_talk(), [this] { ticks.on_tick(); }};
  std::array<Client, 40>& clients = served.clients;
};

int serve(void** state) {
  *state = new Counted;
  return 0;
}

int end(void** state) {
  delete static_cast<Counted*>(*state);
  return 0;
}

bool ask(Counted& counted) {
  bool good = true;
  for (std::size_t i = 0; i < 4; ++i) {
    Client& client = counted.clients[i];
    client.send(get("/hello", "Cookie: a=b\r\nAccept-Encoding: gzip\r\n") + post("/echo", R"({"value":1})") +
                get("/later") + get("/nothing"));
    good = status_of(client.reply()) == 200 && good;
    good = status_of(client.reply()) == 200 && good;
    good = status_of(client.reply()) == 200 && good;
    good = status_of(client.reply()) == 404 && good;
  }
  return good;
}

bool talk(Counted& counted) {
  static const std::string text(1000, 'a');
  bool good = true;
  for (std::size_t i = 4; i < 8; ++i) {
    Client& client = counted.clients[i];
    client.send_text(text);
    good = client.frame().payload == text && good;
    client.send_frame(0x89, "ping");
    good = client.frame().first_byte == 0x8A && good;
  }
  // As fast as they are answered would be more often than a client may: on a quick machine the server ended
  // them.
  std::this_thread::sleep_for(std::chrono::milliseconds{2});
  return good;
}

void nothing_is_allocated_in_the_steady_state(void** state) {
  auto& counted = *static_cast<Counted*>(*state);
  for (std::size_t i = 0; i < 8; ++i) {
    assert_true(counted.clients[i].connect(counted.served.port()));
    if (i >= 4) assert_int_equal(status_of(counted.clients[i].upgrade()), 101);
  }
  for (int i = 0; i < 20; ++i) assert_true(ask(counted) && talk(counted));
  counter = 0;
  counted.count(true);
  for (int i = 0; i < 500; ++i) assert_true(ask(counted) && talk(counted));
  counted.count(false);
  assert_int_equal(counter.load(), 0);
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  if (!flexrf::has_allocation_guard()) return 1;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(nothing_is_allocated_in_the_steady_state, serve, end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
