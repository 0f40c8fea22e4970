#include "hal/linux/v4l2_camera/video_device.hpp"

#include <linux/videodev2.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "hal/interfaces/camera/picture_size.hpp"
#include "runtime/core/text.hpp"

namespace flexrf {
namespace {

constexpr int most_nodes = 64;  // of /dev/videoN
constexpr std::size_t most_offered_text = 150;
constexpr PixelFormat known_formats[] = {PixelFormat::yuyv, PixelFormat::grey8, PixelFormat::rgb24,
                                         PixelFormat::nv12, PixelFormat::mjpeg};

std::uint32_t pixel_format_of(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::grey8:
      return V4L2_PIX_FMT_GREY;
    case PixelFormat::rgb24:
      return V4L2_PIX_FMT_RGB24;
    case PixelFormat::nv12:
      return V4L2_PIX_FMT_NV12;
    case PixelFormat::mjpeg:
      return V4L2_PIX_FMT_MJPEG;
    default:
      return V4L2_PIX_FMT_YUYV;
  }
}

}  // namespace

Status video_error(int error, const char* path, const char* what) {
  const int cause = -error;
  if (cause == EACCES || cause == EPERM) {
    return Status::error(StatusCode::not_permitted,
                         "no permission to open the camera %s: add this user to the group video", path);
  }
  if (cause == EBUSY) {
    return Status::error(StatusCode::busy, "the camera %s is in use by another program; end that program",
                         path);
  }
  if (cause == ENOENT || cause == ENODEV || cause == ENXIO) {
    return Status::error(StatusCode::unavailable,
                         "there is no camera %s; is it plugged in? v4l2-ctl --list-devices shows what is",
                         path);
  }
  return Status::error(StatusCode::device_fault, "the camera %s cannot %s: %s", path, what,
                       std::strerror(cause));
}

VideoDevice::~VideoDevice() {
  close();
}

void VideoDevice::close() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

/// A camera may have several nodes of one name, of which one gives pictures.
Status VideoDevice::open(const std::string& name) {
  if (!name.empty() && name[0] == '/') return open_path(name.c_str());
  Status status = video_error(-ENODEV, name.c_str(), "");
  for (int node = 0; node < most_nodes; ++node) {
    const std::string file = "video" + std::to_string(node);
    std::ifstream stream("/sys/class/video4linux/" + file + "/name");
    std::string found;
    if (!std::getline(stream, found) || found != name) continue;
    status = open_path(("/dev/" + file).c_str());
    if (status) return status;
  }
  return status;
}

Status VideoDevice::open_path(const char* path) {
  close();
  path_ = path;
  descriptor_ = calls_->open(path);
  if (descriptor_ < 0) return video_error(descriptor_, path, "be opened");
  v4l2_capability capability{};
  const int result = calls_->control(descriptor_, VIDIOC_QUERYCAP, &capability);
  if (result == -ENODEV) return video_error(result, path, "say what it is");
  const std::uint32_t able = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                                                   : capability.capabilities;
  constexpr std::uint32_t needed = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if (result < 0 || (able & needed) != needed) {
    return Status::error(
        StatusCode::invalid_argument,
        "%s gives no pictures; v4l2-ctl --list-devices shows the cameras, whose first file it "
        "mostly is",
        path);
  }
  std::memcpy(driver_.data(), capability.driver, sizeof(capability.driver));
  return {};
}

Status VideoDevice::agree(VideoFormat& format) {
  v4l2_format asked{};
  asked.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  asked.fmt.pix.width = format.width;
  asked.fmt.pix.height = format.height;
  asked.fmt.pix.pixelformat = pixel_format_of(format.format);
  asked.fmt.pix.field = V4L2_FIELD_NONE;
  const int result = calls_->control(descriptor_, VIDIOC_S_FMT, &asked);
  const v4l2_pix_format& given = asked.fmt.pix;
  if (result == -EBUSY || result == -ENODEV) return video_error(result, path(), "take a format");
  if (result < 0 || given.width != format.width || given.height != format.height ||
      given.pixelformat != pixel_format_of(format.format)) {
    return Status::error(StatusCode::invalid_argument, "the camera %s does not give %ux%u %s; it offers %s",
                         path(), format.width, format.height, name_of(format.format),
                         offers(format.format).c_str());
  }
  const std::uint32_t row = row_bytes(format.format, format.width);
  format.stride = row == 0 ? 0 : std::max(given.bytesperline, row);
  format.size = std::max(given.sizeimage, format.stride * data_rows(format.format, format.height));
  // Of compressed pictures the longest that could be, which none is: the buffers may be longer than an item.
  if (format.size > most_picture_bytes && format.format != PixelFormat::mjpeg) {
    return Status::error(
        StatusCode::out_of_range,
        "the camera %s needs %u bytes for a picture, an item holds %zu; ask for a smaller one", path(),
        format.size, most_picture_bytes);
  }
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  rate.parm.capture.timeperframe = {1000, static_cast<std::uint32_t>(format.frame_rate * 1000)};
  // A camera that has but one rate refuses; what it has is told if it tells.
  if (calls_->control(descriptor_, VIDIOC_S_PARM, &rate) < 0)
    static_cast<void>(calls_->control(descriptor_, VIDIOC_G_PARM, &rate));
  const v4l2_fract& interval = rate.parm.capture.timeperframe;
  format.frame_rate =
      interval.numerator == 0 ? 0 : static_cast<double>(interval.denominator) / interval.numerator;
  return {};
}

/// The sizes differ from format to format: those of the one that was asked for, if it is there.
std::string VideoDevice::offers(PixelFormat asked) {
  std::string text;
  std::string none;
  PixelFormat sized = PixelFormat::none;
  for (const PixelFormat format : known_formats) {
    bool has = false;
    v4l2_fmtdesc one{};
    one.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    for (; !has && calls_->control(descriptor_, VIDIOC_ENUM_FMT, &one) == 0; ++one.index)
      has = one.pixelformat == pixel_format_of(format);
    none += (none.empty() ? "none of " : ", ") + std::string(name_of(format));
    if (!has) continue;
    if (text.empty() || format == asked) sized = format;
    text += (text.empty() ? "" : ", ") + std::string(name_of(format));
  }
  if (text.empty()) return none;
  text += sizes_of(pixel_format_of(sized));
  if (text.size() > most_offered_text) text.replace(most_offered_text, text.npos, " ...");
  return text;
}

std::string VideoDevice::sizes_of(std::uint32_t pixel_format) {
  std::string text;
  v4l2_frmsizeenum size{};
  size.pixel_format = pixel_format;
  const auto words = [](std::uint32_t width, std::uint32_t height) {
    return " " + std::to_string(width) + "x" + std::to_string(height);
  };
  for (; calls_->control(descriptor_, VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      return " of" + words(size.stepwise.min_width, size.stepwise.min_height) + " to" +
             words(size.stepwise.max_width, size.stepwise.max_height);
    }
    text += (size.index == 0 ? " of" : ",") + words(size.discrete.width, size.discrete.height);
  }
  return text;
}

void VideoDevice::find_controls() {
  controls_ = {};
  count_ = 0;
  v4l2_query_ext_ctrl found{};
  found.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (count_ < most_controls && calls_->control(descriptor_, VIDIOC_QUERY_EXT_CTRL, &found) == 0) {
    add(found);
    found.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
}

void VideoDevice::add(const v4l2_query_ext_ctrl& found) {
  if ((found.flags & V4L2_CTRL_FLAG_DISABLED) != 0 || found.elems > 1) return;
  CameraControl control{};
  switch (found.type) {
    case V4L2_CTRL_TYPE_INTEGER:
      control.kind = CameraControlKind::integer;
      break;
    case V4L2_CTRL_TYPE_BOOLEAN:
      control.kind = CameraControlKind::boolean;
      break;
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_INTEGER_MENU:
      control.kind = CameraControlKind::menu;
      break;
    case V4L2_CTRL_TYPE_BUTTON:
      control.kind = CameraControlKind::button;
      break;
    default:
      return;  // texts, bit masks, 64 bits, headings
  }
  control.name = control_name({found.name, strnlen(found.name, sizeof(found.name))});
  if (find_control(controls(), text_view(control.name)) != nullptr) return;
  control.read_only = (found.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
  control.minimum = static_cast<std::int32_t>(found.minimum);
  control.maximum = static_cast<std::int32_t>(found.maximum);
  control.step = static_cast<std::int32_t>(found.step);
  control.value = control.default_value = static_cast<std::int32_t>(found.default_value);
  controls_[count_] = control;
  identifiers_[count_] = found.id;
  look_at(count_++);
}

void VideoDevice::look_at(std::size_t index) noexcept {
  v4l2_control control{};
  control.id = identifiers_[index];
  if (calls_->control(descriptor_, VIDIOC_G_CTRL, &control) == 0) controls_[index].value = control.value;
}

Status VideoDevice::set_controls(std::string_view text) {
  Status status = check_settings(controls(), text);
  const Result<CameraSettings> settings = CameraSettings::parse(text);
  if (!status || !settings) return status;
  for (const CameraSetting& setting : settings->all()) {
    const auto index = static_cast<std::size_t>(find_control(controls(), setting.name) - controls_.data());
    v4l2_control control{};
    control.id = identifiers_[index];
    control.value = setting.value;
    const int result = calls_->control(descriptor_, VIDIOC_S_CTRL, &control);
    if (result < 0 && status.is_ok()) {
      status = Status::error(
          result == -ENODEV ? StatusCode::unavailable : StatusCode::device_fault,
          "the camera refuses %.*s=%d: %s; perhaps another control, as an automatic one, must be set before",
          static_cast<int>(setting.name.size()), setting.name.data(), setting.value, std::strerror(-result));
    }
  }
  // Setting one may change others.
  for (std::size_t i = 0; i < count_; ++i) look_at(i);
  return status;
}

}  // namespace flexrf
