#include "units/visual_features/visual_features.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr Duration frame_period = std::chrono::milliseconds(33);

struct World {
  UnitBench<FeatureExtraction> bench;
  SlotBench<CameraFrame> frames;
  SlotBench<VisualFeatures> features;
  SlotBench<PictureCondition> condition;
  SizedItem<CameraFrame> item;
  SlotBench<TargetInHand> in_hand;
  InputBinding inputs[2] = {frames.input(), in_hand.input()};
  SlotControl* outputs[2] = {&features.control(), &condition.control()};
  DrawnTable table;
  CameraFrame& frame = *item;
  std::uint64_t sequence = 0;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    static_cast<FeatureExtractionConfiguration*>(bench.unit().parameter_memory().configuration)->catalogue =
        catalogue_of_tests();
    initialised = bench.unit().initialise().is_ok();
    paint();
    draw(table.picture(4));
  }
  void draw(const PictureView& picture) {
    frame.width = picture_width;
    frame.height = picture_height;
    frame.stride = picture_row_bytes;
    frame.size = picture_row_bytes * picture_height;
    frame.format = PixelFormat::rgb24;
    std::memcpy(frame.data().data(), picture.pixels, frame.size);
  }
  void fill(std::uint8_t value) { std::memset(frame.data().data(), value, frame.size); }
  /// One picture in such a light, of each channel.
  void light(double red, double green, double blue) {
    table.light = {red, green, blue};
    paint();
    draw(table.picture(4));
    table.light = {1, 1, 1};
    paint();
  }
  void paint() {
    table.clear();
    table.put(known_parts()[0], {{0.45, 0.02}, 0.4});
    table.put(known_parts()[3], {{0.38, -0.05}, 1.4});
  }
  void scatter() {
    std::uint32_t seed = 5;
    for (std::uint8_t& byte : frame.data()) {
      seed = seed * 1664525 + 1013904223;
      byte = static_cast<std::uint8_t>(seed >> 24);
    }
  }
  void give(std::uint64_t number) {
    frame.sequence = number;
    frame.time = nanoseconds(bench.now());
    frames.publish(frame, bench.now());
    bench.step(frame_period);
  }
  void give() { give(++sequence); }
  /// So many that all is said to be well again.
  void give_some() {
    for (int i = 0; i < 10; ++i) give();
  }
  PictureState state() { return bench.feedback().state; }
  std::uint64_t used() { return bench.feedback().pictures; }
  bool is_refused_as(PictureState state_wanted) {
    const auto& told = bench.feedback();
    return told.state == state_wanted && !told.trouble_view().empty();
  }
  bool initialised = false;
};

bool a_good_picture_is_published_with_its_time() {
  const auto world = std::make_unique<World>();
  const bool waiting = world->state() == PictureState::waiting;
  world->give(7);
  const auto of = std::make_unique<std::optional<VisualFeatures>>(world->features.latest());
  return world->initialised && waiting && *of && (*of)->frame == 7 && (*of)->time == world->frame.time &&
         world->state() == PictureState::good && world->used() == 1 &&
         world->bench.feedback().trouble_view().empty() &&
         std::abs(world->bench.feedback().brightness - 0.55) < 0.05 && world->bench.feedback().edge < 0.5;
}

/// Refused, told in feedback and once in the log; and told when all is well again.
bool is_refused_and_told(PictureState expected, const char* told, void (*spoil)(World&)) {
  const auto world = std::make_unique<World>();
  world->give();
  LogEar first;
  spoil(*world);
  world->give();
  const bool refused = world->is_refused_as(expected) && world->used() == 1 && first.has_heard(told);
  LogEar second;
  world->give();
  const bool once =
      world->is_refused_as(expected) && !second.has_heard(told) && world->bench.feedback().refused == 2;
  LogEar third;
  world->draw(world->table.picture(4));
  for (int i = 0; i < 9; ++i) world->give();
  const bool waits = world->is_refused_as(expected) && !third.has_heard("good again") && world->used() == 10;
  world->give();
  return refused && once && waits && world->state() == PictureState::good && third.has_heard("good again") &&
         world->used() == 11;
}

bool a_picture_that_repeats_is_frozen() {
  const auto world = std::make_unique<World>();
  world->give(5);
  world->give(5);
  const bool frozen = world->is_refused_as(PictureState::frozen) && world->used() == 1;
  world->sequence = 5;
  world->give_some();
  return frozen && world->state() == PictureState::good && world->used() == 11;
}

bool pictures_out_of_order_are_refused() {
  const auto world = std::make_unique<World>();
  world->give(10);
  world->give(12);
  world->give(11);
  const bool refused = world->is_refused_as(PictureState::out_of_order);
  world->give(13);
  return refused && world->used() == 3;
}

/// Each second one is used, and the operator reads one state all the while, and one line in the log.
bool good_ones_in_between_do_not_hide_what_is_wrong() {
  const auto world = std::make_unique<World>();
  world->give(1);
  world->give(3);
  world->give(2);
  LogEar later;
  for (std::uint64_t i = 5; i < 65; i += 2) {
    world->give(i);
    if (!world->is_refused_as(PictureState::out_of_order)) return false;
    world->give(i - 1);
  }
  const bool used = world->used() == 32 && world->bench.feedback().refused == 31;
  const bool quiet = !later.has_heard("good again") && !later.has_heard("older");
  world->sequence = 64;
  world->give_some();
  return used && quiet && world->state() == PictureState::good;
}

/// What goes on from itself for long enough is a camera that counts anew; what jumps about is not.
bool a_camera_may_count_anew() {
  const auto world = std::make_unique<World>();
  world->give(1000);
  for (std::uint64_t i = 0; i < 9; ++i) world->give(i);
  const bool refused = world->is_refused_as(PictureState::out_of_order) && world->used() == 1;
  world->give(9);
  const bool taken = world->used() == 2;
  for (std::uint64_t i = 0; i < 30; ++i) world->give(i % 2 + 3);
  return refused && taken && world->used() == 2;
}

bool silence_is_noticed() {
  const auto world = std::make_unique<World>();
  world->bench.step(frame_period);
  world->bench.step(std::chrono::milliseconds(400));
  const bool patient = world->state() == PictureState::waiting;
  world->bench.step(std::chrono::milliseconds(200));
  const bool silent = world->is_refused_as(PictureState::silent);
  world->give_some();
  const bool good = world->state() == PictureState::good;
  world->bench.step(std::chrono::milliseconds(600));
  return patient && silent && good && world->is_refused_as(PictureState::silent);
}

/// One picture a second: each is used, and it is no camera that works.
bool pictures_that_come_too_seldom_are_told() {
  const auto world = std::make_unique<World>();
  const auto says = [&](std::string_view text) {
    return world->is_refused_as(PictureState::silent) &&
           world->bench.feedback().trouble_view().find(text) != std::string_view::npos;
  };
  world->give();
  world->bench.step(std::chrono::milliseconds(600));
  const bool none = says("no picture comes");
  for (int i = 0; i < 3; ++i) {
    world->give();
    if (!world->is_refused_as(PictureState::silent)) return false;
    world->bench.step(std::chrono::milliseconds(600));
    if (!says("too seldom")) return false;
  }
  const bool used = world->used() == 4;
  world->give_some();
  const bool good = world->state() == PictureState::good;
  world->bench.step(std::chrono::milliseconds(600));
  return none && used && good && says("no picture comes");
}

/// What lies between two pictures that were refused is no motion.
bool nothing_is_compared_with_what_was_refused() {
  const auto world = std::make_unique<World>();
  world->give();
  world->give();
  const auto of = std::make_unique<std::optional<VisualFeatures>>(world->features.latest());
  const bool compares = *of && (*of)->compares;
  world->fill(0);
  world->give();
  world->draw(world->table.picture(4));
  world->give();
  *of = world->features.latest();
  return compares && !(*of)->compares;
}

/// A bare table in little light: its noise is no noise of a broken camera.
bool a_bare_table_is_good(double brightness) {
  const auto world = std::make_unique<World>();
  world->table.light = {brightness, brightness, brightness};
  world->table.clear();
  world->draw(world->table.picture(8));
  world->give();
  return world->state() == PictureState::good;
}

void good(void**) {
  assert_true(a_good_picture_is_published_with_its_time());
  assert_true(a_bare_table_is_good(1.0));
  assert_true(a_bare_table_is_good(0.3));
}
void wrong_formats(void**) {
  assert_true(is_refused_and_told(PictureState::wrong_format, "640x480",
                                  [](World& world) { world.frame.width = 320; }));
  assert_true(is_refused_and_told(PictureState::wrong_format, "640x480",
                                  [](World& world) { world.frame.height = 4000000; }));
  assert_true(is_refused_and_told(PictureState::wrong_format, "640x480",
                                  [](World& world) { world.frame.stride = 640; }));
  assert_true(is_refused_and_told(PictureState::wrong_format, "640x480",
                                  [](World& world) { world.frame.stride = 0xFFFFFFFF; }));
  assert_true(is_refused_and_told(PictureState::wrong_format, "640x480",
                                  [](World& world) { world.frame.format = PixelFormat::bgr24; }));
}
void black(void**) {
  assert_true(is_refused_and_told(PictureState::black, "lens covered", [](World& world) { world.fill(3); }));
}
void light(void**) {
  assert_true(is_refused_and_told(PictureState::too_dark, "give more light",
                                  [](World& world) { world.light(0.2, 0.2, 0.2); }));
  assert_true(is_refused_and_told(PictureState::too_bright, "give less light",
                                  [](World& world) { world.light(1.6, 1.6, 1.6); }));
  assert_true(is_refused_and_told(PictureState::colour_cast, "light is coloured",
                                  [](World& world) { world.light(1.5, 0.5, 0.5); }));
  assert_true(is_refused_and_told(PictureState::colour_cast, "light is coloured",
                                  [](World& world) { world.light(0.5, 0.5, 1.5); }));
}
/// Replaces each pixel three times by the mean of its neighbours, `reach` on either side.
void blur(CameraFrame& frame, int reach) {
  const auto along = [&](std::uint8_t* first, int count, int step) {
    std::vector<int> line(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = first[i * step];
    for (int i = 0; i < count; ++i) {
      int sum = 0;
      for (int k = -reach; k <= reach; ++k)
        sum += line[static_cast<std::size_t>(std::clamp(i + k, 0, count - 1))];
      first[i * step] = static_cast<std::uint8_t>(sum / (2 * reach + 1));
    }
  };
  for (int i = 0; i < 3; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      std::uint8_t* const first = frame.data().data() + channel;
      for (int row = 0; row < 480; ++row) along(first + 1920 * row, 640, 3);
      for (int column = 0; column < 640; ++column) along(first + 3 * column, 480, 1920);
    }
  }
}

/// A little blur hurts no measurement; with the parameter at 0 nothing is refused for it.
void blurred(void**) {
  assert_true(is_refused_and_told(PictureState::blurred, "look at the lens",
                                  [](World& world) { blur(world.frame, 4); }));
  const auto world = std::make_unique<World>();
  world->give();
  assert_true(world->bench.feedback().sharpness > 0.9);
  blur(world->frame, 1);
  world->give();
  assert_true(world->used() == 2 && world->bench.feedback().sharpness < 0.99);
  blur(world->frame, 4);
  world->bench.runtime().blurred = 0;
  world->give();
  assert_true(world->used() == 3 && world->bench.feedback().sharpness < 0.6);
}
void condition(void**) {
  const auto world = std::make_unique<World>();
  world->give();
  assert_true(world->condition.latest() && world->condition.latest()->state == PictureState::good);
  world->light(0.2, 0.2, 0.2);
  world->give();
  assert_true(world->condition.latest()->state == PictureState::too_dark);
}
void noise(void**) {
  assert_true(is_refused_and_told(PictureState::noise, "is noise", [](World& world) { world.scatter(); }));
}
void frozen(void**) {
  assert_true(a_picture_that_repeats_is_frozen());
}
void order(void**) {
  assert_true(pictures_out_of_order_are_refused());
  assert_true(a_camera_may_count_anew());
  assert_true(good_ones_in_between_do_not_hide_what_is_wrong());
}
void silence(void**) {
  assert_true(silence_is_noticed());
  assert_true(pictures_that_come_too_seldom_are_told());
}
void comparison(void**) {
  assert_true(nothing_is_compared_with_what_was_refused());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(good),       cmocka_unit_test(wrong_formats), cmocka_unit_test(black),
      cmocka_unit_test(light),      cmocka_unit_test(condition),     cmocka_unit_test(noise),
      cmocka_unit_test(frozen),     cmocka_unit_test(order),         cmocka_unit_test(silence),
      cmocka_unit_test(comparison), cmocka_unit_test(blurred)};
  return cmocka_run_group_tests_name("visual features", tests, nullptr, nullptr);
}
