// Formats, fields and planes, as the driver reads them: a scripted kernel gives what vivid does not, or not
// all of. What vivid gives of it is tested in the guest.
#include <string>

#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "hal/camera/v4l2/tests/scripted_kernel.hpp"
#include "hal/camera/v4l2/v4l2_camera.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"

namespace flexrf {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t width = 64;
constexpr std::uint32_t height = 48;

class Injected {
 public:
  Injected(PixelFormat format, bool into_slot, ScriptedCamera scripted)
      : size_(picture_bytes(format, row_bytes(format, width), height)),
        kernel_(static_cast<std::uint32_t>(size_), std::move(scripted)),
        camera_(CameraRequest{
            .width = width, .height = height, .format = format, .silence = 600, .into_slot = into_slot}),
        reader_(camera_.slot()) {
    camera_.bench().environment().virtual_time = false;
    set_text(camera_.bench().configuration().device, "/dev/injected");
    camera_.driver().use(kernel_);
  }
  ~Injected() { camera_.driver().stop(); }

  Status start() { return camera_.driver().initialise(); }
  const CameraFeedback& told() { return camera_.bench().feedback(); }

  /// A picture of numbers comes as it is, uncopied.
  bool gives_what_comes() {
    Bytes sent(size_);
    for (std::size_t i = 0; i < size_; ++i) sent[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
    kernel_.inject(sent);
    camera_.bench().receive(MonotonicClock::now() - camera_.bench().now());
    if (camera_.slot() == nullptr) {
      const auto image = camera_.driver().frame();
      return image && Bytes(image->data.begin(), image->data.end()) == sent && is_as_asked(image->stride);
    }
    if (reader_.newest() == nullptr) return false;
    const auto& frame = *static_cast<const CameraFrame*>(reader_.payload());
    const auto data = frame.data().first(frame.size);
    return Bytes(data.begin(), data.end()) == sent && is_as_asked(frame.stride) &&
           kernel_.was_given(data.data());
  }

  /// When the picture was exposed that comes with this stamp.
  std::optional<Time> exposed_at(std::uint32_t flags, Time stamp) {
    camera_.bench().configuration().exposure_time = 0.008;
    camera_.bench().configuration().readout_time = 0.03;
    kernel_.inject(Bytes(size_), flags, stamp);
    camera_.bench().receive(MonotonicClock::now() - camera_.bench().now());
    const auto image = camera_.driver().frame();
    return image ? std::optional(image->time) : std::nullopt;
  }
  const auto& own_told() { return camera_.bench().feedback(); }

 private:
  bool is_as_asked(std::uint32_t stride) {
    const auto format = camera_.bench().configuration().format;
    return stride == row_bytes(format, width) && told().copied_bytes == 0 && told().damaged_frames == 0;
  }

  std::size_t size_;
  ScriptedKernel kernel_;  // outlives the driver
  CameraBench<V4l2Camera> camera_;
  SlotReader reader_;
};

struct Coded {
  PixelFormat format;
  std::uint32_t code;
};
constexpr Coded all_formats[] = {
    {PixelFormat::yuyv, V4L2_PIX_FMT_YUYV},          {PixelFormat::uyvy, V4L2_PIX_FMT_UYVY},
    {PixelFormat::grey8, V4L2_PIX_FMT_GREY},         {PixelFormat::grey16, V4L2_PIX_FMT_Y16},
    {PixelFormat::rgb24, V4L2_PIX_FMT_RGB24},        {PixelFormat::nv12, V4L2_PIX_FMT_NV12},
    {PixelFormat::bayer_rggb8, V4L2_PIX_FMT_SRGGB8}, {PixelFormat::bayer_grbg8, V4L2_PIX_FMT_SGRBG8},
    {PixelFormat::bayer_gbrg8, V4L2_PIX_FMT_SGBRG8}, {PixelFormat::bayer_bggr8, V4L2_PIX_FMT_SBGGR8},
};

bool comes_as_it_is(const Coded& coded, std::uint8_t planes, bool into_slot) {
  Injected camera(coded.format, into_slot, {.formats = {coded.code}, .planes = planes});
  const bool good = camera.start() && camera.gives_what_comes() && camera.told().trouble[0] == '\0';
  if (!good) print_message("%s, %d planes\n", name_of(coded.format), int{planes});
  return good;
}

void every_format_comes_as_it_is_with_planes_and_without(void**) {
  for (const Coded& coded : all_formats) {
    for (const std::uint8_t planes : {std::uint8_t{0}, std::uint8_t{1}}) {
      assert_true(comes_as_it_is(coded, planes, true));
      assert_true(comes_as_it_is(coded, planes, false));
    }
  }
}

bool refused_with(PixelFormat format, ScriptedCamera scripted, std::string_view words) {
  Injected camera(format, true, std::move(scripted));
  const Status status = camera.start();
  const bool said = std::string_view(status.cause()).find(words) != std::string_view::npos;
  if (!said) print_message("%s\n", status.cause());
  return status.code() == StatusCode::invalid_argument && said;
}

void what_it_gives_instead_is_named(void**) {
  assert_true(refused_with(PixelFormat::yuyv, {.formats = {V4L2_PIX_FMT_H264, V4L2_PIX_FMT_UYVY}},
                           "does not give 64x48 yuyv; it offers uyvy"));
  assert_true(refused_with(PixelFormat::yuyv, {.formats = {V4L2_PIX_FMT_H264, V4L2_PIX_FMT_SRGGB10P}},
                           "it offers only H264, pRAA, of which none is taken; its driver or its pipeline "
                           "(media-ctl) may be set to another"));
  assert_true(refused_with(PixelFormat::yuyv, {.formats = {V4L2_PIX_FMT_UYVY}, .planes = 1},
                           "does not give 64x48 yuyv; it offers uyvy"));
  // One picture in two buffers.
  assert_true(refused_with(PixelFormat::nv12, {.formats = {V4L2_PIX_FMT_NV12}, .planes = 2},
                           "does not give 64x48 nv12"));
}

bool interlaced_is_told(std::uint32_t field) {
  Injected camera(PixelFormat::yuyv, true, {.formats = {V4L2_PIX_FMT_YUYV}, .field = field});
  if (!camera.start() || !camera.gives_what_comes()) return false;
  return camera.told().present &&
         text_view(camera.told().trouble).find("is interlaced: every other row is of another time") !=
             std::string_view::npos;
}

void interlaced_pictures_come_and_are_told(void**) {
  for (const std::uint32_t field :
       {V4L2_FIELD_INTERLACED, V4L2_FIELD_INTERLACED_TB, V4L2_FIELD_INTERLACED_BT})
    assert_true(interlaced_is_told(field));
}

void fields_that_come_one_after_the_other_are_refused(void**) {
  for (const std::uint32_t field :
       {V4L2_FIELD_TOP, V4L2_FIELD_BOTTOM, V4L2_FIELD_ALTERNATE, V4L2_FIELD_SEQ_TB, V4L2_FIELD_SEQ_BT})
    assert_true(refused_with(PixelFormat::yuyv, {.formats = {V4L2_PIX_FMT_YUYV}, .field = field},
                             "is interlaced, and gives the fields of a picture one after the other"));
}

bool a_picture_in_the_middle_of_its_buffer_is_left_out() {
  Injected camera(PixelFormat::yuyv, true, {.formats = {V4L2_PIX_FMT_YUYV}, .planes = 1, .data_offset = 64});
  return camera.start() && !camera.gives_what_comes() && camera.told().damaged_frames == 1 &&
         text_view(camera.told().damage) == "it does not begin with its buffer";
}

/// A column of what the kernel may say of a picture's time.
struct Stamped {
  std::uint32_t flags;
  Duration before_now;  // the stamp, when the picture comes
  const char* clock;    // that counts
  Duration after_stamp;
};

constexpr std::uint32_t monotonic = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
constexpr Duration half = std::chrono::milliseconds(19);  // of exposure and readout
constexpr Stamped stamps[] = {
    {monotonic | V4L2_BUF_FLAG_TSTAMP_SRC_EOF, std::chrono::milliseconds(5), "end of frame", -half},
    {monotonic | V4L2_BUF_FLAG_TSTAMP_SRC_SOE, std::chrono::milliseconds(25), "begin of exposure", half},
    {monotonic, std::chrono::milliseconds(-500), "arrival", {}},
    {monotonic, std::chrono::seconds(10), "arrival", {}},
    {V4L2_BUF_FLAG_TIMESTAMP_COPY, std::chrono::milliseconds(5), "arrival", {}},
    {V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, std::chrono::milliseconds(5), "arrival", {}},
};

bool is_stamped_as(const Stamped& column) {
  Injected camera(PixelFormat::grey8, false, {.formats = {V4L2_PIX_FMT_GREY}});
  const LogEar ear;
  if (!camera.start()) return false;
  // As the kernel tells it, in whole microseconds.
  const Time before =
      Time{std::chrono::floor<std::chrono::microseconds>(MonotonicClock::now().time_since_epoch())};
  const Time stamp = before - column.before_now;
  const auto exposed = camera.exposed_at(column.flags, stamp);
  const bool arrived = std::string_view(column.clock) == "arrival";
  const bool at_its_time =
      exposed && (arrived ? *exposed >= before - half && *exposed <= MonotonicClock::now() - half
                          : *exposed == stamp + column.after_stamp);
  return at_its_time && text_view(camera.own_told().clock) == column.clock &&
         camera.own_told().stamped_on_arrival == (arrived ? 1U : 0U) &&
         ear.has_heard("pictures are stamped on arrival") == arrived;
}

void a_picture_is_of_the_middle_of_its_exposure(void**) {
  for (const Stamped& column : stamps) {
    const bool good = is_stamped_as(column);
    if (!good) print_message("%s, %X\n", column.clock, column.flags);
    assert_true(good);
  }
}

void a_plane_that_begins_later_is_damaged(void**) {
  assert_true(a_picture_in_the_middle_of_its_buffer_is_left_out());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_format_comes_as_it_is_with_planes_and_without),
      cmocka_unit_test(what_it_gives_instead_is_named),
      cmocka_unit_test(interlaced_pictures_come_and_are_told),
      cmocka_unit_test(fields_that_come_one_after_the_other_are_refused),
      cmocka_unit_test(a_plane_that_begins_later_is_damaged),
      cmocka_unit_test(a_picture_is_of_the_middle_of_its_exposure),
  };
  return cmocka_run_group_tests_name("scripted camera", tests, nullptr, nullptr);
}
