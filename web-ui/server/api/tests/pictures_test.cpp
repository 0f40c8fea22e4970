// Pictures: formats, scaling, one encoding for all, by frame and by REST.
#include <turbojpeg.h>

#include <cstddef>
#include <cstring>
#include <memory>

#include "runtime/log/log.hpp"
#include "web-ui/server/api/picture.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel::pictures_test {
namespace {

constexpr std::size_t columns = 64;
constexpr std::size_t rows = 48;

struct Picture {
  std::uint32_t width;
  std::uint32_t height;
  std::uint8_t format;
  std::uint8_t data[columns * rows * 3];
};

constexpr EnumerationValue formats[] = {
    {"none", ""},        {"grey8", ""},       {"rgb24", ""},      {"bgr24", ""},  {"yuyv", ""},
    {"nv12", ""},        {"mjpeg", ""},       {"uyvy", ""},       {"grey16", ""}, {"bayer_rggb8", ""},
    {"bayer_grbg8", ""}, {"bayer_gbrg8", ""}, {"bayer_bggr8", ""}};
constexpr TypeDescriptor format_type{"PixelFormat", "", 1, 1, 1, {}, {}, formats, false};
constexpr FieldDescriptor picture_fields[] = {
    {"width", Scalar::u32, 0, {0, 0}, 1, offsetof(Picture, width), "1", "", nullptr},
    {"height", Scalar::u32, 0, {0, 0}, 1, offsetof(Picture, height), "1", "", nullptr},
    {"format", Scalar::enumeration, 0, {0, 0}, 1, offsetof(Picture, format), "", "", &format_type},
    {"data",
     Scalar::u8,
     1,
     {columns * rows * 3, 0},
     columns* rows * 3,
     offsetof(Picture, data),
     "1",
     "",
     nullptr}};
constexpr TypeDescriptor picture_type{
    "Picture", "", sizeof(Picture), alignof(Picture), 0x99, picture_fields, {}, {}, true};

enum Format : std::uint8_t {
  none,
  grey8,
  rgb24,
  bgr24,
  yuyv,
  nv12,
  mjpeg,
  uyvy,
  grey16,
  rggb,
  grbg,
  gbrg,
  bggr
};
constexpr Format shown_formats[] = {grey8, rgb24, bgr24, yuyv, nv12, uyvy, grey16, rggb, grbg, gbrg, bggr};

bool is_grey(Format format) {
  return format == grey8 || format == grey16;
}

/// Where in a cell of two by two pixels red lies, of row * 2 + column; green lies beside it.
std::size_t place_of_red(Format format) {
  return format == rggb ? 0 : format == grbg ? 1 : format == gbrg ? 2 : 3;
}

/// Left half red (grey: dark), right half green (grey: bright).
void draw(Picture& picture, Format format) {
  picture.width = columns;
  picture.height = rows;
  picture.format = format;
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const bool left = x < columns / 2;
      const bool in_twos = format == yuyv || format == uyvy || format == grey16;
      const std::size_t bytes = format == grey8 || format == nv12 || format >= rggb ? 1 : in_twos ? 2 : 3;
      std::uint8_t* const pixel = picture.data + (y * columns + x) * bytes;
      if (format == grey8) {
        pixel[0] = left ? 40 : 200;
      } else if (format == grey16) {
        pixel[0] = 255;
        pixel[1] = left ? 40 : 200;
      } else if (format >= rggb) {
        const std::size_t place = y % 2 * 2 + x % 2;
        const std::size_t red = place_of_red(format);
        const bool is_red = place == red;
        const bool is_blue = place == 3 - red;
        pixel[0] = (left ? is_red : !is_red && !is_blue) ? 255 : 0;
      } else if (format == yuyv || format == uyvy) {
        // BT.601: red is Y 76, U 85, V 255; green Y 150, U 44, V 21.
        const std::size_t brightness = format == yuyv ? 0 : 1;
        pixel[brightness] = left ? 76 : 150;
        pixel[1 - brightness] = x % 2 == 0 ? (left ? 85 : 44) : (left ? 255 : 21);
      } else if (format == nv12) {
        pixel[0] = left ? 76 : 150;
        std::uint8_t* const square = picture.data + (rows + y / 2) * columns + x / 2 * 2;
        square[0] = left ? 85 : 44;
        square[1] = left ? 255 : 21;
      } else {
        pixel[format == rgb24 ? 0 : 2] = left ? 255 : 0;
        pixel[1] = left ? 0 : 255;
        pixel[format == rgb24 ? 2 : 0] = 0;
      }
    }
  }
}

struct Decoded {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;
  int at(int x, int y, int channel) const {
    return rgb[static_cast<std::size_t>((y * width + x) * 3 + channel)];
  }
};

Decoded decode(std::string_view jpeg) {
  Decoded decoded;
  int sampling = 0;
  int colours = 0;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  const auto close = [](void* handle) { tjDestroy(handle); };
  const std::unique_ptr<void, decltype(close)> handle(tjInitDecompress(), close);
  CHECK(tjDecompressHeader3(handle.get(), bytes, jpeg.size(), &decoded.width, &decoded.height, &sampling,
                            &colours) == 0);
  decoded.rgb.resize(static_cast<std::size_t>(decoded.width * decoded.height * 3));
  CHECK(tjDecompress2(handle.get(), bytes, jpeg.size(), decoded.rgb.data(), decoded.width, 0, decoded.height,
                      TJPF_RGB, 0) == 0);
  return decoded;
}

bool is_near(int value, int wanted) {
  return std::abs(value - wanted) < 12;
}

void every_format_keeps_its_colours() {
  const PictureLayout layout = PictureLayout::of(picture_type);
  CHECK(layout.is_complete());
  const auto picture = std::make_unique<Picture>();
  PictureEncoder encoder;
  for (const Format format : shown_formats) {
    draw(*picture, format);
    const Decoded decoded = decode(encoder.encode(layout, picture.get(), 640));
    CHECK_EQUAL(decoded.width, 64);
    CHECK_EQUAL(decoded.height, 48);
    CHECK(is_near(decoded.at(8, 24, 0), is_grey(format) ? 40 : 254));
    CHECK(is_near(decoded.at(8, 24, 1), is_grey(format) ? 40 : 0));
    CHECK(is_near(decoded.at(56, 24, 0), is_grey(format) ? 200 : 0));
    CHECK(is_near(decoded.at(56, 24, 1), is_grey(format) ? 200 : 255));
  }
}

struct GappedPicture {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t stride;
  std::uint32_t size;
  std::uint8_t format;
  std::uint8_t data[40 * 8];
};

constexpr FieldDescriptor gapped_fields[] = {
    {"width", Scalar::u32, 0, {0, 0}, 1, offsetof(GappedPicture, width), "1", "", nullptr},
    {"height", Scalar::u32, 0, {0, 0}, 1, offsetof(GappedPicture, height), "1", "", nullptr},
    {"stride", Scalar::u32, 0, {0, 0}, 1, offsetof(GappedPicture, stride), "1", "", nullptr},
    {"size", Scalar::u32, 0, {0, 0}, 1, offsetof(GappedPicture, size), "1", "", nullptr},
    {"format", Scalar::enumeration, 0, {0, 0}, 1, offsetof(GappedPicture, format), "", "", &format_type},
    {"data", Scalar::u8, 1, {40 * 8, 0}, 40 * 8, offsetof(GappedPicture, data), "1", "", nullptr}};
constexpr TypeDescriptor gapped_type{
    "GappedPicture", "", sizeof(GappedPicture), alignof(GappedPicture), 0x9A, gapped_fields, {}, {}, true};

// Rows of 32 pixels, 40 bytes apart; between them lies what is no part of the picture.
void rows_may_have_gaps() {
  const PictureLayout layout = PictureLayout::of(gapped_type);
  GappedPicture picture{32, 8, 40, 0, grey8, {}};
  for (std::size_t i = 0; i < sizeof(picture.data); ++i) picture.data[i] = i % 40 < 32 ? 100 : 255;
  PictureEncoder encoder;
  const Decoded decoded = decode(encoder.encode(layout, &picture, 640));
  CHECK_EQUAL(decoded.width, 32);
  CHECK_EQUAL(decoded.height, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 32; ++x) CHECK(is_near(decoded.at(x, y, 0), 100));
  picture.height = 9;
  CHECK(encoder.encode(layout, &picture, 640).empty());
  CHECK_CONTAINS(encoder.cause(), "larger than its data");
}

// An odd number of bytes from row to row, and an odd number of pixels, which share their colour all the same.
void rows_of_colour_have_the_same_gaps() {
  const PictureLayout layout = PictureLayout::of(gapped_type);
  constexpr std::uint32_t stride = 37;
  GappedPicture picture{31, 5, stride, 0, nv12, {}};
  for (std::size_t i = 0; i < sizeof(picture.data); ++i) {
    const std::size_t row = i / stride;
    const std::size_t column = i % stride;
    // Red; what lies between the rows would show.
    picture.data[i] = row < 5 ? (column < 31 ? 76 : 255) : column < 32 ? (column % 2 == 0 ? 85 : 255) : 0;
  }
  PictureEncoder encoder;
  const Decoded decoded = decode(encoder.encode(layout, &picture, 640));
  CHECK_EQUAL(decoded.width, 31);
  CHECK_EQUAL(decoded.height, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 31; ++x) {
      CHECK(is_near(decoded.at(x, y, 0), 254));
      CHECK(is_near(decoded.at(x, y, 1), 0));
    }
  }
  // Three rows of colour are needed, and what is there ends before them.
  picture.height = 6;
  CHECK(encoder.encode(layout, &picture, 640).empty());
  CHECK_CONTAINS(encoder.cause(), "larger than its data");
}

// Neither decoded nor encoded: not even whether it can be is looked at.
void what_is_a_jpeg_already_is_passed_on() {
  const PictureLayout layout = PictureLayout::of(gapped_type);
  GappedPicture picture{640, 480, 0, 7, mjpeg, {0xFF, 0xD8, 1, 2, 3, 0xFF, 0xD9, 9}};
  PictureEncoder encoder;
  const std::string_view jpeg = encoder.encode(layout, &picture, 16);
  CHECK_EQUAL(jpeg.size(), 7U);
  CHECK(jpeg.data() == reinterpret_cast<const char*>(picture.data));
  CHECK_EQUAL(encoder.scaled_by(), 1);
  const auto is_refused = [&] {
    return encoder.encode(layout, &picture, 16).empty() && std::strstr(encoder.cause(), "JPEG") != nullptr;
  };
  for (const std::uint32_t size : {0U, 1U, 321U}) {
    picture.size = size;
    CHECK(is_refused());
  }
  picture.size = 7;
  picture.data[1] = 0;
  CHECK(is_refused());
}

void it_is_no_larger_than_it_is_shown() {
  const PictureLayout layout = PictureLayout::of(picture_type);
  const auto picture = std::make_unique<Picture>();
  PictureEncoder encoder;
  for (const Format format : shown_formats) {
    draw(*picture, format);
    const Decoded decoded = decode(encoder.encode(layout, picture.get(), 30));
    CHECK(decoded.width == 21 && decoded.height == 16 && encoder.scaled_by() == 3);
    CHECK(is_near(decoded.at(18, 8, 1), is_grey(format) ? 200 : 255));
  }
}

void what_is_no_picture_says_why() {
  const PictureLayout layout = PictureLayout::of(picture_type);
  const auto picture = std::make_unique<Picture>();
  PictureEncoder encoder;
  CHECK(encoder.encode(layout, picture.get(), 640).empty());
  CHECK_CONTAINS(encoder.cause(), "empty");
  CHECK_EQUAL(encoder.scaled_by(), 0);
  draw(*picture, none);
  CHECK(encoder.encode(layout, picture.get(), 640).empty());
  CHECK_CONTAINS(encoder.cause(), "format");
  draw(*picture, rgb24);
  picture->height = rows + 1;
  CHECK(encoder.encode(layout, picture.get(), 640).empty());
  CHECK_CONTAINS(encoder.cause(), "larger than its data");
}

/// A cell with a slot of pictures, that the test publishes.
class PictureCell : public fixture::ProducerAndConsumer {
 public:
  PictureCell() : memory_(std::make_unique<SlotMemory<Picture, 3>>()) {}

  void add_to(Application& application) {
    records_.assign(application.slots.begin(), application.slots.end());
    records_.push_back({"camera", "", &control_, &observer_, "", false});
    application.slots = records_;
  }
  void publish(Format format, Time sampled_at = MonotonicClock::now()) {
    const std::uint8_t buffer = control_.loan();
    draw(*reinterpret_cast<Picture*>(control_.payload(buffer)), format);
    control_.publish(buffer, sampled_at);
  }
  void end_in_fault() { control_.set_writer_state(WriterState::faulted); }

 private:
  std::unique_ptr<SlotMemory<Picture, 3>> memory_;
  SlotControl control_{&picture_type, memory_->view(1, true)};
  SlotReader observer_{&control_};
  std::vector<SlotRecord> records_;
};

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  Value value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

void pictures_come_to_all_who_look() {
  PictureCell cell;
  // The application is the fixture's to keep and the test's to complete.
  cell.add_to(const_cast<Application&>(cell.application()));
  Rig rig(cell);
  rig.start();
  PlayedLink& first = rig.connect(a_viewer);
  PlayedLink& second = rig.connect(a_viewer);
  const auto look = [](int width) {
    return json{{"op", "subscribe"}, {"slots", {{{"name", "camera"}, {"rate", 50}, {"width", width}}}}};
  };
  CHECK(rig.ask(first, look(16)).at("unknown").empty());
  rig.ask(second, look(64));
  // The worker may still be about to look for the first alone: that look is over when a later one is
  // answered.
  CHECK_EQUAL(rig.get("slots/camera/image").status, 409U);
  cell.publish(rgb24);
  for (PlayedLink* link : {&first, &second}) {
    std::string item;
    CHECK(rig.wait_until([&] {
      for (const std::string& frame : link->frames)
        if (at<std::uint32_t>(frame, 16) == 1 && at<std::uint32_t>(frame, 36) > 0) item = frame;
      return !item.empty();
    }));
    CHECK_EQUAL(at<std::uint8_t>(item, 57), 1);
    CHECK_EQUAL(at<std::uint64_t>(item, 40), 1U);
    const Decoded decoded = decode(std::string_view{item}.substr(64, at<std::uint32_t>(item, 36)));
    CHECK_EQUAL(decoded.width, 64);  // for the one who sees it largest
    CHECK_EQUAL(at<std::uint16_t>(item, 58), 1);
    link->frames.clear();
  }
  const Answer picture = rig.request(Method::get, "slots/camera/image", a_viewer, "", "", "", "width=64");
  CHECK_EQUAL(picture.status, 200U);
  CHECK_EQUAL(picture.reply.content_type, "image/jpeg");
  CHECK(is_near(decode(picture.reply.text).at(8, 24, 0), 254));
  CHECK_EQUAL(rig.request(Method::get, "slots/camera/image", a_viewer, "", "", "", "width=0").status, 400U);
}

void a_slot_of_pictures_is_described_as_any_other() {
  PictureCell cell;
  cell.add_to(const_cast<Application&>(cell.application()));
  Rig rig(cell);
  rig.start();
  const auto is = [&rig](std::uint64_t sequence, const char* reason) {
    const json slot = rig.get("slots/camera").body;
    CHECK(slot.at("value").is_null());
    CHECK_EQUAL(slot.at("sequence").get<std::uint64_t>(), sequence);
    CHECK_EQUAL(slot.at("reason").get<std::string>(), reason);
    return slot.at("sampled_at_ns").get<std::int64_t>();
  };
  is(0, name_of(NullReason::nothing_yet));
  const Time sampled_at = MonotonicClock::now() - std::chrono::seconds{3};
  cell.publish(rgb24, sampled_at);
  CHECK_EQUAL(is(1, ""), nanoseconds(sampled_at));
  cell.end_in_fault();
  is(1, name_of(NullReason::writer_faulted));
}

void what_cannot_be_encoded_is_logged_once() {
  PictureCell cell;
  cell.add_to(const_cast<Application&>(cell.application()));
  Rig rig(cell);
  rig.start();
  const std::string cause = "Slot camera: a picture cannot be shown: the picture's format";
  for (int i = 0; i < 3; ++i) {
    cell.publish(none);
    const Answer picture = rig.get("slots/camera/image");
    CHECK_EQUAL(picture.status, 409U);
    CHECK_CONTAINS(picture.body.at("detail").get<std::string>(), "format");
  }
  log_info("test", "the last line");
  const auto count = [&rig](const std::string& text) {
    int lines = 0;
    const json log = rig.get("log").body;
    for (const json& line : log.at("lines"))
      lines += line.at("text").get<std::string>().find(text) != std::string::npos ? 1 : 0;
    return lines;
  };
  CHECK(rig.wait_until([&] { return count("the last line") == 1; }));
  CHECK_EQUAL(count(cause), 1);
}

}  // namespace
}  // namespace flexrf::panel::pictures_test

int main() {
  using namespace flexrf::panel::pictures_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(every_format_keeps_its_colours),
      CONTAINED_TEST(rows_may_have_gaps),
      CONTAINED_TEST(rows_of_colour_have_the_same_gaps),
      CONTAINED_TEST(what_is_a_jpeg_already_is_passed_on),
      CONTAINED_TEST(it_is_no_larger_than_it_is_shown),
      CONTAINED_TEST(what_is_no_picture_says_why),
      CONTAINED_TEST(pictures_come_to_all_who_look),
      CONTAINED_TEST(a_slot_of_pictures_is_described_as_any_other),
      CONTAINED_TEST(what_cannot_be_encoded_is_logged_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
