// Compressed pictures, as the driver reads them. The kernel's virtual camera makes none, so that they are
// made by libturbojpeg and injected in place of what the kernel would give.
#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/interface/jpeg_maker.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "hal/camera/v4l2/tests/scripted_kernel.hpp"
#include "hal/camera/v4l2/v4l2_camera.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using Jpeg = std::vector<std::uint8_t>;

constexpr std::uint32_t width = 64;
constexpr std::uint32_t height = 48;
constexpr std::uint32_t usual_buffer = width * height * 2;

/// The finer its pattern, the longer it is.
Jpeg jpeg(std::size_t detail, std::uint32_t rows = height) {
  JpegMaker maker;
  if (!maker.begin(width, rows)) return {};
  for (std::size_t i = 0; i < maker.canvas().size(); ++i)
    maker.canvas()[i] = static_cast<std::uint8_t>(detail == 0 ? 90 : i * i * 131 % detail);
  const auto bytes = maker.make(usual_picture_bytes);
  return {bytes.begin(), bytes.end()};
}

class InjectedCamera {
 public:
  explicit InjectedCamera(bool into_slot, std::uint32_t buffer_size = usual_buffer)
      : kernel(buffer_size),
        camera_(CameraRequest{.width = width,
                              .height = height,
                              .format = PixelFormat::mjpeg,
                              .silence = 600,
                              .into_slot = into_slot}),
        reader_(camera_.slot()) {
    camera_.bench().environment().virtual_time = false;
    set_text(camera_.bench().configuration().device, "/dev/injected");
    camera_.driver().use(kernel);
  }
  ~InjectedCamera() { camera_.driver().stop(); }

  Status start() { return camera_.driver().initialise(); }
  void receive() { camera_.bench().receive(MonotonicClock::now() - camera_.bench().now()); }
  const CameraFeedback& told() { return camera_.bench().feedback(); }
  std::string_view damage() { return text_view(told().damage); }

  /// What a reader has got of it; empty: nothing new.
  Jpeg after(const Jpeg& injected, std::uint32_t flags = 0) {
    kernel.inject(injected, flags);
    receive();
    if (camera_.slot() == nullptr) {
      const auto image = camera_.driver().frame();
      return image ? Jpeg(image->data.begin(), image->data.end()) : Jpeg{};
    }
    const ItemHeader* const header = reader_.newest();
    if (header == nullptr || header->sequence == seen_) return {};
    seen_ = header->sequence;
    const auto& frame = *static_cast<const CameraFrame*>(reader_.payload());
    newest = frame.data().data();
    if (frame.format != PixelFormat::mjpeg || frame.width != width || frame.height != height ||
        frame.stride != 0 || frame.size > frame.data().size())
      return {};
    const auto data = frame.data().first(frame.size);
    return {data.begin(), data.end()};
  }

  ScriptedKernel kernel;  // outlives the driver
  const std::uint8_t* newest = nullptr;

 private:
  CameraBench<V4l2Camera> camera_;
  SlotReader reader_;
  std::uint64_t seen_ = 0;
};

bool they_come_as_long_as_they_are(bool into_slot) {
  InjectedCamera camera(into_slot);
  if (!camera.start()) return false;
  std::size_t shortest = usual_buffer;
  std::size_t longest = 0;
  for (const std::size_t detail : {0U, 200U, 3U, 251U, 0U, 17U}) {
    const Jpeg sent = jpeg(detail);
    Jpeg padded = sent;
    padded.resize(sent.size() + detail % 5, 0);  // as some cameras do
    if (camera.after(padded) != sent) return false;
    if (into_slot && !camera.kernel.was_given(camera.newest)) return false;
    shortest = std::min(shortest, sent.size());
    longest = std::max(longest, sent.size());
  }
  print_message("%zu to %zu bytes\n", shortest, longest);
  return longest > shortest + 100 && camera.told().frames == 6 && camera.told().copied_bytes == 0 &&
         camera.told().damaged_frames == 0;
}

void mjpeg_comes_uncopied_and_as_long_as_it_is_injected_not_produced(void**) {
  assert_true(they_come_as_long_as_they_are(true));
  assert_true(they_come_as_long_as_they_are(false));
}

bool is_left_out(InjectedCamera& camera, const Jpeg& garbled, std::string_view why, std::uint32_t flags = 0) {
  const std::uint64_t damaged = camera.told().damaged_frames;
  const bool shown = !camera.after(garbled, flags).empty();
  print_message("%.80s\n", camera.told().damage.data());
  const Jpeg good = jpeg(50);
  return !shown && camera.told().damaged_frames == damaged + 1 &&
         camera.damage().find(why) != std::string_view::npos && camera.after(good) == good &&
         camera.told().damaged_frames == damaged + 1;
}

bool damaged_ones_are_left_out(bool into_slot) {
  InjectedCamera camera(into_slot);
  if (!camera.start()) return false;
  const Jpeg whole = jpeg(100);
  Jpeg hollow = whole;  // its data is gone, its beginning and end are there
  hollow.erase(hollow.begin() + 30, hollow.end() - 2);
  bool good = true;
  for (const std::size_t size : {whole.size() - 1, whole.size() - 2, whole.size() / 2, std::size_t{700}})
    good = good && is_left_out(camera, Jpeg(whole.begin(), whole.begin() + static_cast<long>(size)), "ends");
  return good && is_left_out(camera, {}, "no JPEG") && is_left_out(camera, Jpeg(500, 0x55), "no JPEG") &&
         is_left_out(camera, hollow, "JPEG") && is_left_out(camera, jpeg(100, 32), "another size") &&
         is_left_out(camera, whole, "marked", V4L2_BUF_FLAG_ERROR) && camera.told().losses == 0;
}

void damaged_mjpeg_is_counted_and_left_out_injected_not_produced(void**) {
  assert_true(damaged_ones_are_left_out(true));
  assert_true(damaged_ones_are_left_out(false));
}

/// The kernel's buffers are longer than an item: what comes is copied, and what is longer is not cut.
bool long_buffers_cost_a_copy() {
  InjectedCamera camera(true, usual_picture_bytes + 4096);
  if (!camera.start()) return false;
  const Jpeg sent = jpeg(20);
  if (camera.after(sent) != sent || camera.told().copied_bytes != sent.size()) return false;
  // A stretch that a decoder skips (APP0), again and again, in front of the picture.
  Jpeg stretch(2000, 0);
  constexpr std::uint8_t marker[] = {0xFF, 0xE0, (2000 - 2) >> 8, (2000 - 2) & 0xFF};
  std::copy(std::begin(marker), std::end(marker), stretch.begin());
  Jpeg too_long(sent.begin(), sent.begin() + 2);
  while (too_long.size() + sent.size() <= usual_picture_bytes + 2)
    too_long.insert(too_long.end(), stretch.begin(), stretch.end());
  too_long.insert(too_long.end(), sent.begin() + 2, sent.end());
  return is_left_out(camera, too_long, "does not fit");
}

void mjpeg_in_long_buffers_is_copied_once_injected_not_produced(void**) {
  assert_true(long_buffers_cost_a_copy());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(mjpeg_comes_uncopied_and_as_long_as_it_is_injected_not_produced),
      cmocka_unit_test(damaged_mjpeg_is_counted_and_left_out_injected_not_produced),
      cmocka_unit_test(mjpeg_in_long_buffers_is_copied_once_injected_not_produced),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
