// The real driver on the kernel's simulated chip: the conformance suite, and what the operator reads.
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <ctime>

#include "hal/gpio/chip/linux/linux_gpio_chip.hpp"
#include "hal/gpio/chip/linux/tests/gpio_sim.hpp"
#include "hal/gpio/lines/conformance/virtual_world.hpp"
#include "hal/gpio/lines/linux/linux_digital_io.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

constexpr const char* input = "BUTTON";
constexpr const char* output = "LAMP";

class GpioSimWorld final : public DigitalIoWorld {
 public:
  GpioSimWorld() { set_text(chip_.configuration().chip, GpioSim::label); }
  ~GpioSimWorld() override {
    if (forbidden_ && seteuid(0) != 0) std::perror("seteuid");
    if (!sim_.is_plugged()) sim_.plug_in();
    if (line_) line_->driver().stop();
    chip_.driver().stop();
  }

  using DigitalIoWorld::start;
  Status start(const DigitalLineSettings& settings, bool signal) override {
    if (forbidden_ && seteuid(nobody) != 0) return Status::error(StatusCode::internal, "seteuid");
    if (const Status status = chip_.driver().initialise(); !status) return status;
    line_.emplace(nullptr, std::span<QueueSink* const>{}, &chip_.driver());
    configure_line(*line_, settings, settings.direction == LineDirection::input ? input : output, signal);
    return line_->driver().initialise();
  }
  DigitalIo& io() override { return line_->driver(); }
  void receive(Duration elapsed) override {
    const timespec pause{0, static_cast<long>(elapsed.count())};
    nanosleep(&pause, nullptr);
    const Time now = MonotonicClock::now();
    chip_.receive(now - chip_.now());
    line_->receive(now - line_->now());
  }
  void send() override {
    line_->send();
    chip_.send();
  }
  Time now() const override { return line_->now(); }
  void drive(bool high) override { sim_.pull(input, high); }
  bool sees_high() override { return sim_.is_high(output); }
  bool unplug() override {
    sim_.unplug();
    return sim_.is_good();
  }
  bool plug_in() override {
    sim_.plug_in();
    return sim_.is_good();
  }
  bool occupy() override {
    auto line = LibraryLine::request(GpioSim::label, {.name = input});
    if (!line) return false;
    other_ = std::move(*line);
    return true;
  }
  void let_go() override { other_.reset(); }
  bool forbid() override {
    forbidden_ = true;
    return true;
  }
  void permit() override {
    if (seteuid(0) != 0) std::perror("seteuid");
    forbidden_ = false;
  }

 private:
  static constexpr uid_t nobody = 65534;

  GpioSim sim_;
  bool forbidden_ = false;
  std::unique_ptr<LibraryLine> other_;
  DeviceBench<LinuxGpioChip> chip_{nullptr};
  std::optional<DeviceBench<LinuxDigitalIo>> line_;
};

Status request(const char* chip, const char* line) {
  const auto requested = LibraryLine::request(chip, {.name = line});
  return requested ? Status{} : requested.status();
}

// [gpio-chip-5]
void a_line_in_use_names_its_user(void**) {
  Status status;
  {
    const auto mine = LibraryLine::request(GpioSim::label, {.name = input});
    if (mine) status = request(GpioSim::label, input);
  }
  assert_int_equal(status.code(), StatusCode::busy);
  assert_non_null(std::strstr(status.cause(), "flexrf"));
  assert_non_null(std::strstr(status.cause(), input));
  // And is free again afterwards.
  status = request(GpioSim::label, input);
  assert_int_equal(status.code(), StatusCode::ok);
}

// [gpio-chip-5]
void a_line_that_is_not_there_is_told(void**) {
  const Status status = request(GpioSim::label, "NO_SUCH_LINE");
  assert_int_equal(status.code(), StatusCode::not_found);
  assert_non_null(std::strstr(status.cause(), "NO_SUCH_LINE"));
  assert_non_null(std::strstr(status.cause(), "gpioinfo"));
}

/// Cycles until it is so.
template <class Condition>
bool until(GpioSimWorld& world, const Condition& is_so) {
  constexpr int most_cycles = 10'000;
  for (int i = 0; i < most_cycles; ++i) {
    world.receive(std::chrono::milliseconds(1));
    if (is_so()) return true;
    world.send();
  }
  return false;
}

/// The line of a chip that came back is somebody else's, who was quicker.
bool is_plugged_in_for_another(GpioSimWorld& world) {
  constexpr int most_tries = 20;
  for (int i = 0; i < most_tries; ++i) {
    if (!world.unplug() || !until(world, [&] { return !world.io().state(); }) || !world.plug_in())
      return false;
    if (world.occupy()) return true;
    if (!until(world, [&] { return world.io().state().has_value(); })) return false;
  }
  return false;
}

bool what_keeps_a_lost_line_is_told() {
  const LogEar log;
  GpioSimWorld world;
  if (!world.start({}) || !until(world, [&] { return world.io().state().has_value(); })) return false;
  if (!world.unplug() || !until(world, [&] { return log.has_heard("there is no GPIO chip flexrf-sim"); }))
    return false;
  if (world.io().state() || !world.plug_in()) return false;
  if (!until(world, [&] { return log.has_heard("GPIO chip flexrf-sim are there again"); })) return false;
  if (!until(world, [&] { return world.io().state().has_value(); })) return false;
  if (!is_plugged_in_for_another(world) ||
      !until(world, [&] { return log.has_heard("BUTTON of GPIO chip flexrf-sim is in use by flexrf"); }))
    return false;
  if (world.io().state() || !world.io().fault().is_ok()) return false;
  world.let_go();
  const Time free = world.now();
  return until(world, [&] { return world.io().state().has_value(); }) &&
         is_back_in_time("another user of a lost line", world.now() - free);
}

void a_lost_line_that_cannot_be_had_is_told(void**) {
  assert_true(what_keeps_a_lost_line_is_told());
}

void the_kernel_pulls_as_the_bias_says(void**) {
  int pulled_up = -1;
  int pulled_down = -1;
  {
    if (auto line = LibraryLine::request(GpioSim::label, {.name = input, .bias = LineBias::pull_up}))
      pulled_up = (*line)->value();
    if (auto line = LibraryLine::request(GpioSim::label, {.name = input, .bias = LineBias::pull_down}))
      pulled_down = (*line)->value();
  }
  assert_int_equal(pulled_up, 1);
  assert_int_equal(pulled_down, 0);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_in_use_names_its_user),
      cmocka_unit_test(a_line_that_is_not_there_is_told),
      cmocka_unit_test(a_lost_line_that_cannot_be_had_is_told),
      cmocka_unit_test(the_kernel_pulls_as_the_bias_says),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_digital_io_conformance("gpio on gpio-sim", []() -> std::unique_ptr<DigitalIoWorld> {
           return std::make_unique<GpioSimWorld>();
         });
}
