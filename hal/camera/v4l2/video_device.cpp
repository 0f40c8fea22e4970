#include "hal/camera/v4l2/video_device.hpp"

#include <linux/videodev2.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/text.hpp"
#include "hal/camera/interface/picture_size.hpp"

namespace flexrf {
namespace {

constexpr int most_nodes = 64;  // of /dev/videoN
constexpr std::size_t most_offered_text = 150;

/// 0: a camera has no such format.
std::uint32_t pixel_format_of(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::yuyv:
      return V4L2_PIX_FMT_YUYV;
    case PixelFormat::uyvy:
      return V4L2_PIX_FMT_UYVY;
    case PixelFormat::grey8:
      return V4L2_PIX_FMT_GREY;
    case PixelFormat::grey16:
      return V4L2_PIX_FMT_Y16;
    case PixelFormat::rgb24:
      return V4L2_PIX_FMT_RGB24;
    case PixelFormat::nv12:
      return V4L2_PIX_FMT_NV12;
    case PixelFormat::mjpeg:
      return V4L2_PIX_FMT_MJPEG;
    case PixelFormat::bayer_rggb8:
      return V4L2_PIX_FMT_SRGGB8;
    case PixelFormat::bayer_grbg8:
      return V4L2_PIX_FMT_SGRBG8;
    case PixelFormat::bayer_gbrg8:
      return V4L2_PIX_FMT_SGBRG8;
    case PixelFormat::bayer_bggr8:
      return V4L2_PIX_FMT_SBGGR8;
    case PixelFormat::none:
    case PixelFormat::bgr24:
      break;
  }
  return 0;
}

bool is_known(std::uint32_t pixel_format) noexcept {
  return std::any_of(std::begin(camera_formats), std::end(camera_formats),
                     [pixel_format](PixelFormat known) { return pixel_format_of(known) == pixel_format; });
}

/// As v4l2-ctl shows it: "Y10 ", "H264".
std::string code_of(std::uint32_t pixel_format) {
  std::string code;
  for (int byte = 0; byte < 4; ++byte) {
    const auto letter = static_cast<char>(pixel_format >> (8 * byte) & 0x7F);
    if (letter > ' ' && letter < 0x7F) code += letter;
  }
  return code;
}

/// Rows of two times in one picture.
bool is_woven(std::uint32_t field) noexcept {
  return field == V4L2_FIELD_INTERLACED || field == V4L2_FIELD_INTERLACED_TB ||
         field == V4L2_FIELD_INTERLACED_BT;
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
  const bool captures = (able & V4L2_CAP_VIDEO_CAPTURE) != 0;
  const bool captures_planes = (able & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
  if (result < 0 || (able & V4L2_CAP_STREAMING) == 0 || (!captures && !captures_planes)) {
    return Status::error(
        StatusCode::invalid_argument,
        "%s gives no pictures; v4l2-ctl --list-devices shows the cameras, whose first file it "
        "mostly is",
        path);
  }
  buffer_type_ = captures ? V4L2_BUF_TYPE_VIDEO_CAPTURE : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
  std::memcpy(driver_.data(), capability.driver, sizeof(capability.driver));
  return {};
}

bool VideoDevice::has_planes() const noexcept {
  return buffer_type_ == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

/// 0, and what the camera makes of it: another format is none; else −errno.
int VideoDevice::propose(VideoFormat& format, std::uint32_t& field) noexcept {
  v4l2_format asked{};
  asked.type = buffer_type_;
  const std::uint32_t wanted = pixel_format_of(format.format);
  v4l2_pix_format& plain = asked.fmt.pix;
  v4l2_pix_format_mplane& planes = asked.fmt.pix_mp;
  if (has_planes()) {
    planes.width = format.width;
    planes.height = format.height;
    planes.pixelformat = wanted;
    planes.field = V4L2_FIELD_NONE;
    planes.num_planes = 1;
  } else {
    plain.width = format.width;
    plain.height = format.height;
    plain.pixelformat = wanted;
    plain.field = V4L2_FIELD_NONE;
  }
  const int result = calls_->control(descriptor_, VIDIOC_S_FMT, &asked);
  if (result < 0) return result;
  // The two begin alike, but for the numbers behind the field.
  const std::uint32_t given = has_planes() ? planes.pixelformat : plain.pixelformat;
  const bool is_one_plane = !has_planes() || planes.num_planes == 1;
  format.width = has_planes() ? planes.width : plain.width;
  format.height = has_planes() ? planes.height : plain.height;
  format.stride = has_planes() ? planes.plane_fmt[0].bytesperline : plain.bytesperline;
  format.size = has_planes() ? planes.plane_fmt[0].sizeimage : plain.sizeimage;
  field = has_planes() ? planes.field : plain.field;
  if (given != wanted || !is_one_plane) format.format = PixelFormat::none;
  return 0;
}

Status VideoDevice::agree(VideoFormat& format, std::size_t room) {
  VideoFormat given = format;
  std::uint32_t field = V4L2_FIELD_NONE;
  const int result = propose(given, field);
  if (result == -EBUSY || result == -ENODEV) return video_error(result, path(), "take a format");
  if (result < 0 || given.width != format.width || given.height != format.height ||
      given.format != format.format) {
    return Status::error(StatusCode::invalid_argument, "the camera %s does not give %ux%u %s; it offers %s",
                         path(), format.width, format.height, name_of(format.format),
                         offers(format.format).c_str());
  }
  if (field != V4L2_FIELD_NONE && field != V4L2_FIELD_ANY && !is_woven(field)) {
    return Status::error(
        StatusCode::invalid_argument,
        "the camera %s is interlaced, and gives the fields of a picture one after the other; ask "
        "for one without lines left out (progressive), or of half the height",
        path());
  }
  format.interlaced = is_woven(field);
  const std::uint32_t row = row_bytes(format.format, format.width);
  format.stride = row == 0 ? 0 : std::max(given.stride, row);
  format.size = std::max(given.size, format.stride * data_rows(format.format, format.height));
  // Of compressed pictures the longest that could be, which none is: the buffers may be longer than an item.
  if (room > 0 && format.size > room && format.format != PixelFormat::mjpeg) {
    return Status::error(StatusCode::out_of_range,
                         "the camera %s needs %u bytes for a picture, an item of its slot holds %zu: write "
                         "elements = %u into the row of the slot ([slot.NAME]), or ask for a smaller one",
                         path(), format.size, room, format.size);
  }
  v4l2_streamparm rate{};
  rate.type = buffer_type_;
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
  std::string text, others;
  PixelFormat sized = PixelFormat::none;
  std::vector<std::uint32_t> found;
  v4l2_fmtdesc one{};
  one.type = buffer_type_;
  for (; calls_->control(descriptor_, VIDIOC_ENUM_FMT, &one) == 0; ++one.index) {
    found.push_back(one.pixelformat);
    if (!is_known(one.pixelformat)) others += (others.empty() ? "" : ", ") + code_of(one.pixelformat);
  }
  for (const PixelFormat format : camera_formats) {
    if (std::find(found.begin(), found.end(), pixel_format_of(format)) == found.end()) continue;
    if (text.empty() || format == asked) sized = format;
    text += (text.empty() ? "" : ", ") + std::string(name_of(format));
  }
  if (text.empty() && others.empty()) {
    text = "none of ";
    return text += camera_formats_text;
  }
  if (text.empty()) {
    if (others.size() > most_offered_text / 3) others.replace(most_offered_text / 3, others.npos, " ...");
    text = "only ";
    return text +=
           others + ", of which none is taken; its driver or its pipeline (media-ctl) may be set to another";
  }
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
