// The scene's camera with each of the faults that it can be given.
#include <cmath>
#include <cstdlib>
#include <vector>

#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/interface/jpeg_check.hpp"
#include "hal/camera/scene/tests/still_camera.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

/// What a picture was.
struct Seen {
  std::uint64_t sequence = 0;
  Time time{};
  std::uint64_t bytes = 0;
  double row = 0;  // of the block's middle; no number: there is none
};

class Camera {
 public:
  explicit Camera(PixelFormat format = PixelFormat::rgb24)
      : camera_(CameraRequest{.width = 640, .height = 480, .format = format}) {
    if (!camera_.driver().initialise()) std::abort();
  }

  void give(CameraFault fault) { camera_.bench().runtime().injected_fault = fault; }
  /// All that come meanwhile.
  std::vector<Seen> look(int cycles) {
    std::vector<Seen> pictures;
    for (int i = 0; i < cycles; ++i) {
      camera_.bench().receive(cycle);
      const auto image = camera_.driver().frame();
      if (!image) continue;
      const bool is_rgb = image->format == PixelFormat::rgb24;
      pictures.push_back(
          {image->sequence, image->time, checksum(*image), is_rgb ? blue_middle(*image)[1] : 0.0});
    }
    return pictures;
  }
  std::optional<CameraImage> next() {
    for (int i = 0; i < 10; ++i) {
      camera_.bench().receive(cycle);
      if (const auto image = camera_.driver().frame()) return image;
    }
    return std::nullopt;
  }
  const CameraFeedback& told() { return camera_.bench().feedback(); }

  static constexpr Duration cycle = milliseconds(10);

 private:
  CameraBench<StillCamera> camera_;
};

constexpr int third_of_a_second = 33;  // cycles

/// Where a picture of that time has to show the block.
double row_at(Time time) {
  return 239.5 - 600 * 0.1 * seconds(time - Time{std::chrono::seconds(1)}) / 0.425;
}

/// From one picture to the next it is 4.7 rows; its side, which is seen the more the further off it is, is
/// part of what is blue.
bool is_true(const Seen& picture) {
  return std::abs(picture.row - row_at(picture.time)) < 2;
}

bool unplugged_it_says_so_until_it_is_back() {
  Camera camera;
  if (camera.look(third_of_a_second).size() < 8) return false;
  const std::uint64_t frames = camera.told().frames;
  camera.give(CameraFault::unplugged);
  if (!camera.look(third_of_a_second).empty()) return false;
  const bool said = !camera.told().present && camera.told().frames == frames && camera.told().losses == 1 &&
                    camera.told().trouble_view() == "the camera is not there; is it plugged in?";
  camera.give(CameraFault::none);
  const auto after = camera.look(third_of_a_second);
  return said && after.size() >= 8 && camera.told().present && camera.told().trouble_view().empty() &&
         camera.told().recoveries == 1;
}

bool black_is_black_and_the_count_goes_on() {
  Camera camera;
  const auto before = camera.look(third_of_a_second);
  camera.give(CameraFault::black);
  const auto image = camera.next();
  if (before.empty() || !image || image->sequence != before.back().sequence + 1) return false;
  for (const std::uint8_t byte : image->data)
    if (byte != 0) return false;
  camera.give(CameraFault::none);
  const auto after = camera.look(third_of_a_second);
  return !after.empty() && is_true(after.front()) && camera.told().lost_frames == 0;
}

/// The same count, time and bytes; then it goes on where it stopped.
bool frozen_it_repeats_a_picture() {
  Camera camera;
  const auto before = camera.look(third_of_a_second);
  if (before.empty() || !is_true(before.back())) return false;
  camera.give(CameraFault::frozen);
  const auto frozen = camera.look(third_of_a_second);
  if (frozen.size() < 8) return false;
  for (const Seen& picture : frozen)
    if (picture.sequence != before.back().sequence || picture.time != before.back().time ||
        picture.bytes != before.back().bytes)
      return false;
  camera.give(CameraFault::none);
  const auto after = camera.look(third_of_a_second);
  return after.size() >= 8 && after.front().sequence == before.back().sequence + 1 &&
         is_true(after.front()) && after.front().time > before.back().time + milliseconds(300) &&
         camera.told().lost_frames == 0;
}

/// 3 2 5 4 7 6 ...: each is what it says, and was taken then.
bool out_of_order_each_second_is_older_than_the_one_before() {
  Camera camera;
  const auto before = camera.look(third_of_a_second);
  camera.give(CameraFault::out_of_order);
  const auto mixed = camera.look(third_of_a_second);
  if (before.empty() || mixed.size() < 8) return false;
  int forward = 0;
  int back = 0;
  for (std::size_t i = 1; i < mixed.size(); ++i) {
    const std::int64_t step = static_cast<std::int64_t>(mixed[i].sequence - mixed[i - 1].sequence);
    const Duration passed = mixed[i].time - mixed[i - 1].time;
    if (step == 3 && passed > milliseconds(95)) ++forward;
    if (step == -1 && passed < milliseconds(-25)) ++back;
    if (!is_true(mixed[i])) return false;
  }
  camera.give(CameraFault::none);
  const auto after = camera.look(third_of_a_second);
  return forward + back == static_cast<int>(mixed.size()) - 1 && std::abs(forward - back) <= 1 &&
         after.size() >= 8 && after.back().sequence == after.front().sequence + after.size() - 1 &&
         camera.told().lost_frames == 0;
}

bool with_a_low_frame_rate_one_comes_each_second() {
  Camera camera;
  const auto before = camera.look(third_of_a_second);
  camera.give(CameraFault::low_frame_rate);
  const auto slow = camera.look(330);
  if (before.empty() || slow.size() < 3) return false;
  for (std::size_t i = slow.size() - 2; i < slow.size(); ++i)
    if (slow[i].time - slow[i - 1].time != std::chrono::seconds(1) ||
        slow[i].sequence != slow[i - 1].sequence + 1)
      return false;
  return slow.size() <= 5 && camera.told().present && camera.told().lost_frames == 0;
}

bool of_the_wrong_size_is_half_of_it() {
  Camera camera;
  camera.give(CameraFault::wrong_size);
  const auto image = camera.next();
  if (!image || image->width != 320 || image->height != 240 || image->stride != 960 ||
      image->data.size() != 960U * 240U)
    return false;
  // Each second row of the whole one.
  const bool shows_it = std::abs(2 * blue_middle(*image)[1] - row_at(image->time)) < 1.7;
  camera.give(CameraFault::none);
  const auto whole = camera.next();
  return shows_it && whole && whole->width == 640 && whole->data.size() == 1920U * 480U;
}

bool of_the_wrong_size_in_other_formats() {
  Camera yuyv(PixelFormat::yuyv);
  yuyv.give(CameraFault::wrong_size);
  const auto packed = yuyv.next();
  Camera mjpeg(PixelFormat::mjpeg);
  mjpeg.give(CameraFault::wrong_size);
  const auto jpeg = mjpeg.next();
  return packed && packed->stride == 640 && packed->data.size() == 640U * 240U && jpeg &&
         jpeg->width == 320 && check_jpeg(jpeg->data, 320, 240).damage == nullptr &&
         check_jpeg(jpeg->data, 640, 480).damage != nullptr;
}

bool too_small_for_a_half_it_stays_as_it_is() {
  CameraBench<StillCamera> camera(CameraRequest{.width = 640, .height = 3, .format = PixelFormat::rgb24});
  if (!camera.driver().initialise()) return false;
  camera.bench().runtime().injected_fault = CameraFault::wrong_size;
  for (int i = 0; i < 10; ++i) {
    camera.bench().receive(Camera::cycle);
    if (const auto image = camera.driver().frame()) return image->width == 320 && image->height == 3;
  }
  return false;
}

/// As likely each value, nothing of its neighbour in it, and another one each time.
bool noise_is_noise() {
  Camera camera;
  camera.give(CameraFault::noise);
  const auto image = camera.next();
  if (!image) return false;
  const std::vector<std::uint8_t> bytes(image->data.begin(), image->data.end());
  double sum = 0;
  double product = 0;
  for (std::size_t i = 3; i < bytes.size(); ++i) {
    sum += bytes[i];
    product += (bytes[i] - 127.5) * (bytes[i - 3] - 127.5);
  }
  const auto count = static_cast<double>(bytes.size() - 3);
  const double variance = 255.0 * 257 / 12;
  const auto other = camera.next();
  return std::abs(sum / count - 127.5) < 1 && std::abs(product / count) < 0.02 * variance && other &&
         !std::equal(bytes.begin(), bytes.end(), other->data.begin());
}

/// The block is where it was, and as bright on the whole; the steepest step of its edges is small.
bool blurred_it_has_no_sharp_edge() {
  struct Look {
    double column = 0;
    double sum = 0;
    int steepest = 0;
  };
  const auto look = [](const CameraImage& image) {
    Look of;
    of.column = blue_middle(image)[0];
    for (std::size_t i = 3; i < image.data.size(); ++i) {
      of.sum += image.data[i];
      if (i / 3 % image.width != 0)
        of.steepest = std::max(of.steepest, std::abs(int{image.data[i]} - int{image.data[i - 3]}));
    }
    return of;
  };
  Camera camera;
  const auto sharp_image = camera.next();
  if (!sharp_image) return false;
  const Look sharp = look(*sharp_image);
  camera.give(CameraFault::blurred);
  const auto blurred_image = camera.next();
  if (!blurred_image) return false;
  const Look blurred = look(*blurred_image);
  camera.give(CameraFault::none);
  const auto after = camera.next();
  return blurred.steepest * 3 < sharp.steepest && std::abs(blurred.column - sharp.column) < 2 &&
         std::abs(blurred.sum / sharp.sum - 1) < 0.01 && after &&
         look(*after).steepest * 10 > sharp.steepest * 9;
}

bool the_same_seed_makes_the_same_noise() {
  const auto first_of = [] {
    Camera camera;
    camera.give(CameraFault::noise);
    const auto image = camera.next();
    return image ? checksum(*image) : 0;
  };
  const std::uint64_t first = first_of();
  return first != 0 && first == first_of();
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<unplugged_it_says_so_until_it_is_back>),
      cmocka_unit_test(judged<black_is_black_and_the_count_goes_on>),
      cmocka_unit_test(judged<frozen_it_repeats_a_picture>),
      cmocka_unit_test(judged<out_of_order_each_second_is_older_than_the_one_before>),
      cmocka_unit_test(judged<with_a_low_frame_rate_one_comes_each_second>),
      cmocka_unit_test(judged<of_the_wrong_size_is_half_of_it>),
      cmocka_unit_test(judged<of_the_wrong_size_in_other_formats>),
      cmocka_unit_test(judged<too_small_for_a_half_it_stays_as_it_is>),
      cmocka_unit_test(judged<noise_is_noise>),
      cmocka_unit_test(judged<the_same_seed_makes_the_same_noise>),
      cmocka_unit_test(judged<blurred_it_has_no_sharp_edge>),
  };
  return cmocka_run_group_tests_name("faults of the scene's camera", tests, nullptr, nullptr);
}
