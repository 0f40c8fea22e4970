// The real driver on real interfaces, as root: a vcan of its own, and can0 with can1 at the far end.
#include <linux/can/error.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "hal/can/conformance/can_bus_conformance.hpp"
#include "hal/can/socket_can/can_node_runner.hpp"
#include "hal/can/socket_can/socket_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"
#include "tests/recovery.hpp"

namespace {

using namespace flexrf;

constexpr const char* virtual_interface = "vcanflexrf";
constexpr Duration pause = std::chrono::milliseconds(1);
constexpr int most_tries = 20'000;

bool ip(const std::string& words) {
  return std::system(("ip " + words).c_str()) == 0;
}

class SocketWorld : public CanBusWorld {
 public:
  SocketWorld(const char* near, const char* far) : near_(near) {
    bench_->configuration().set_interface(near);
    ready_ = bench_->driver().initialise() && far_->open() && far_->listen_to_all() &&
             far_->bind(static_cast<int>(if_nametoindex(far)));
    for (int i = 0; i < most_tries && !bus().is_usable(); ++i) receive();
  }
  ~SocketWorld() override { bench_->driver().stop(); }

  CanBus& bus() override { return bench_->driver(); }
  void receive() override {
    std::this_thread::sleep_for(pause);
    bench_->receive(pause);
  }
  void send() override { bench_->send(); }
  Time now() const override { return MonotonicClock::now(); }

  void say(const CanFrame& frame) override {
    for (int i = 0; i < most_tries && far_->send(frame).frames == 0; ++i) std::this_thread::sleep_for(pause);
  }
  std::optional<CanFrame> hear() override {
    if (heard_ == count_) {
      heard_ = 0;
      count_ = far_->receive();
    }
    if (heard_ == count_) return std::nullopt;
    return far_->frame(heard_++);
  }

  bool set_down() override { return ready_ && ip("link set " + near_ + " down"); }
  bool set_up() override { return ip("link set " + near_ + " up"); }

 protected:
  CanSocket& far() { return *far_; }

 private:
  std::string near_;
  std::unique_ptr<DeviceBench<SocketCanBus>> bench_ = std::make_unique<DeviceBench<SocketCanBus>>(nullptr);
  std::unique_ptr<CanSocket> far_ = std::make_unique<CanSocket>();
  std::size_t heard_ = 0;
  std::size_t count_ = 0;
  bool ready_ = false;
};

/// Error frames come from another socket here: injected, not produced.
class VirtualWorld final : public SocketWorld {
 public:
  VirtualWorld() : SocketWorld(make(), virtual_interface) {}
  ~VirtualWorld() override { ip(std::string("link del ") + virtual_interface); }

  bool take_away() override { return ip(std::string("link del ") + virtual_interface); }
  bool put_back() override {
    make();
    return far().bind(static_cast<int>(if_nametoindex(virtual_interface))).is_ok();
  }
  bool cause_bus_off() override { return inject(CAN_ERR_BUSOFF, 0); }
  void end_bus_off() override { inject(CAN_ERR_RESTARTED, 0); }
  bool cause_error_passive() override { return inject(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE); }

 private:
  static const char* make() {
    const std::string name = virtual_interface;
    if (if_nametoindex(virtual_interface) == 0) ip("link add " + name + " type vcan");
    ip("link set " + name + " up");
    return virtual_interface;
  }
  bool inject(canid_t what, std::uint8_t controller) {
    can_frame frame{};
    frame.can_id = CAN_ERR_FLAG | what;
    frame.can_dlc = CAN_ERR_DLC;
    frame.data[1] = controller;
    return write(far().descriptor(), &frame, sizeof(frame)) == static_cast<ssize_t>(sizeof(frame));
  }
};

class KvaserWorld final : public SocketWorld {
 public:
  KvaserWorld() : SocketWorld("can0", "can1") {}
};

// ---- beside the conformance suite

struct Gone {
  Gone() { ip(std::string("link del ") + virtual_interface + " 2>/dev/null"); }
  ~Gone() { ip(std::string("link del ") + virtual_interface + " 2>/dev/null"); }
};

bool an_interface_that_comes_later_is_taken() {
  const Gone gone;
  const auto bench = std::make_unique<DeviceBench<SocketCanBus>>(nullptr);
  bench->configuration().set_interface(virtual_interface);
  const LogEar log;
  if (!bench->driver().initialise()) return false;
  for (int i = 0; i < 50; ++i) bench->receive(pause);
  const bool missing = bench->driver().state() == CanBusState::gone &&
                       log.has_heard(std::string("there is no network interface ") + virtual_interface);
  ip(std::string("link add ") + virtual_interface + " type vcan");
  ip(std::string("link set ") + virtual_interface + " up");
  const Time came = MonotonicClock::now();
  for (int i = 0; i < most_tries && !bench->driver().is_usable(); ++i) {
    std::this_thread::sleep_for(pause);
    bench->receive(pause);
  }
  const bool there = bench->driver().is_usable() && bench->driver().counters().recoveries == 0 &&
                     is_back_in_time("missing at the start", MonotonicClock::now() - came);
  bench->driver().stop();
  return missing && there;
}

bool an_interface_has_one_bus() {
  VirtualWorld world;
  const auto second = std::make_unique<DeviceBench<SocketCanBus>>(nullptr);
  second->configuration().set_interface(virtual_interface);
  const Status refused = second->driver().initialise();
  world.bus().stop();
  const bool later = second->driver().initialise().is_ok();
  second->driver().stop();
  return !refused && std::string(refused.cause()).find("that of bus `") != std::string::npos && later;
}

/// Answers each frame with the next identifier, and says something by itself every 10 ms.
class EchoNode final : public CanNode {
 public:
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    CanFrame answer = frame;
    ++answer.identifier;
    port.send(answer);
  }
  Time next_event() const noexcept override { return next_; }
  void on_time(Time now, CanPort& port) noexcept override {
    CanFrame beat;
    beat.identifier = 0x701;
    port.send(beat);
    next_ = now + std::chrono::milliseconds(10);
  }

 private:
  Time next_{};
};

bool a_simulated_node_answers_over_the_wire() {
  VirtualWorld world;
  EchoNode node;
  std::atomic<bool> ends{false};
  Status outcome;
  std::thread thread([&] { outcome = run_can_node(virtual_interface, node, ends); });
  CanInbox answers;
  CanInbox beats;
  const CanIdentifier answer[] = {{0x602}};
  const CanIdentifier beat[] = {{0x701}};
  bool good = world.bus().open(answers, answer).is_ok() && world.bus().open(beats, beat).is_ok();
  int heard = 0;
  for (int i = 0; i < most_tries && heard < 3; ++i) {  // the node is there before it is asked
    world.receive();
    if (beats.pop()) ++heard;
  }
  CanFrame question;
  question.identifier = 0x601;
  question.length = 1;
  question.data[0] = 0x42;
  good = good && heard == 3 && world.bus().queue(question);
  std::optional<CanFrame> got;
  for (int i = 0; i < most_tries && !got; ++i) {
    world.send();
    world.receive();
    got = answers.pop();
  }
  ends = true;
  thread.join();
  return good && got && got->data[0] == 0x42 && outcome.is_ok();
}

/// Answers a frame, and in the same turn says (as a simulator's console does) that it is quiet from now on.
class QuietNode final : public CanNode {
 public:
  explicit QuietNode(CanSocket& listener) : listener_(&listener) {}

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    CanFrame answer = frame;
    answer.identifier = answer_identifier;
    has_answered_ = port.send(answer);
    next_ = {};
  }
  Time next_event() const noexcept override { return next_; }
  void on_time(Time /*now*/, CanPort& /*port*/) noexcept override {
    next_ = Time::max();
    if (!has_answered_) return;
    const std::size_t count = listener_->receive();
    for (std::size_t i = 0; i < count; ++i)
      was_heard_ = was_heard_ || listener_->frame(i).identifier == answer_identifier;
    is_quiet_.store(true, std::memory_order_release);
  }
  bool is_quiet() const { return is_quiet_.load(std::memory_order_acquire); }
  /// Its answer, before it was quiet.
  bool was_heard() const { return was_heard_; }

 private:
  static constexpr std::uint32_t answer_identifier = 0x602;

  CanSocket* listener_;
  Time next_{};
  bool has_answered_ = false;
  bool was_heard_ = false;
  std::atomic<bool> is_quiet_{false};
};

bool what_a_simulated_node_answered_leaves_before_it_acts() {
  VirtualWorld world;
  const auto listener = std::make_unique<CanSocket>();
  const auto asker = std::make_unique<CanSocket>();
  const auto index = static_cast<int>(if_nametoindex(virtual_interface));
  if (!listener->open() || !listener->listen_to_all() || !listener->bind(index)) return false;
  if (!asker->open() || !asker->bind(index)) return false;
  QuietNode node(*listener);
  std::atomic<bool> ends{false};
  Status outcome;
  std::thread thread([&] { outcome = run_can_node(virtual_interface, node, ends); });
  CanFrame question;
  question.identifier = 0x601;
  for (int i = 0; i < most_tries && !node.is_quiet(); ++i) {  // until it is there
    if (i % 100 == 0) asker->send(question);
    std::this_thread::sleep_for(pause);
  }
  ends = true;
  thread.join();
  return outcome.is_ok() && node.is_quiet() && node.was_heard();
}

void comes_later(void**) {
  assert_true(an_interface_that_comes_later_is_taken());
}
void has_one_bus(void**) {
  assert_true(an_interface_has_one_bus());
}
void node_answers(void**) {
  assert_true(a_simulated_node_answers_over_the_wire());
}
void node_is_quiet(void**) {
  assert_true(what_a_simulated_node_answered_leaves_before_it_acts());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"an interface that comes later is taken", comes_later, nullptr, nullptr, nullptr},
      {"an interface has one bus", has_one_bus, nullptr, nullptr, nullptr},
      {"a simulated node answers over the wire", node_answers, nullptr, nullptr, nullptr},
      {"what a simulated node answered leaves before it acts", node_is_quiet, nullptr, nullptr, nullptr},
  };
  int failed = run_can_bus_conformance(
      "SocketCAN on vcan (errors injected, not produced)",
      []() -> std::unique_ptr<CanBusWorld> { return std::make_unique<VirtualWorld>(); });
  failed += run_can_bus_conformance("SocketCAN on two kvaser_pci", []() -> std::unique_ptr<CanBusWorld> {
    return std::make_unique<KvaserWorld>();
  });
  failed += cmocka_run_group_tests_name("SocketCAN beside the suite", tests, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
