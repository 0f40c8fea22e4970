#include "hal/camera/scene/scene_camera.hpp"

#include <algorithm>
#include <random>

#include "hal/camera/interface/rgb_conversion.hpp"
#include "hal/scene/interface/joint_samples.hpp"
#include "motion/pose_conversion.hpp"

namespace flexrf {
namespace {

JointSample sample_of(const ItemHeader& header, const JointState& state) noexcept {
  JointSample sample;
  sample.time = header.sampled_at;
  sample.position = state.position;
  sample.velocity = state.velocity;
  return sample;
}

struct PictureSize {
  std::size_t width = 0;
  std::size_t height = 0;
};

/// What is left of a picture when only each n-th pixel of each m-th row is, in front of the rest.
void thin_out(std::span<std::uint8_t> rgb, const PictureSize& whole, const PictureSize& small) noexcept {
  constexpr std::size_t channels = 3;
  const std::size_t across = whole.width / small.width;
  const std::size_t down = whole.height / small.height;
  auto to = rgb.begin();
  for (std::size_t row = 0; row < small.height; ++row)
    for (std::size_t column = 0; column < small.width; ++column)
      to = std::copy_n(&rgb[channels * (row * down * whole.width + column * across)], channels, to);
}

/// Each value becomes the mean of nine, of which it is the middle one; beyond its ends a line goes on as it
/// ends.
void smooth_line(std::uint8_t* first, std::size_t count, std::size_t step,
                 std::span<std::uint8_t> sharp) noexcept {
  constexpr std::size_t reach = 4;
  constexpr std::uint32_t width = 2 * reach + 1;
  for (std::size_t i = 0; i < count; ++i) sharp[i] = first[i * step];
  const auto at = [&](std::size_t shifted) {
    return std::uint32_t{sharp[std::min(std::max(shifted, reach) - reach, count - 1)]};
  };
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < width; ++k) sum += at(k);
  for (std::size_t i = 0; i < count; ++i) {
    first[i * step] = static_cast<std::uint8_t>((sum + width / 2) / width);
    sum += at(i + width) - at(i);
  }
}

/// Blurs as a lens out of focus does: three means along rows and columns are nearly a Gaussian of 4.5 pixels.
/// `line`: room for the longest row or column.
void blur(std::span<std::uint8_t> rgb, const PictureSize& size, std::span<std::uint8_t> line) noexcept {
  constexpr std::size_t channels = 3;
  constexpr int times = 3;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    for (std::size_t row = 0; row < size.height; ++row)
      for (int i = 0; i < times; ++i)
        smooth_line(&rgb[channels * row * size.width + channel], size.width, channels, line);
    for (std::size_t column = 0; column < size.width; ++column)
      for (int i = 0; i < times; ++i)
        smooth_line(&rgb[channels * column + channel], size.height, channels * size.width, line);
  }
}

}  // namespace

SceneCamera::SceneCamera() {
  offer(0, "brightness", CameraControlKind::integer, -100, 100, 0);
}

Status SceneCamera::initialise() {
  if (configuration.exposure > 1 / configuration.frame_rate) {
    return Status::error(StatusCode::invalid_argument,
                         "configuration.exposure (%g s) is longer than a period at %g pictures a second",
                         configuration.exposure, configuration.frame_rate);
  }
  Pose told{};
  told.position = configuration.hand_eye_position;
  told.orientation = configuration.hand_eye_orientation;
  if (told.orientation_map().norm() < 0.5) {
    return Status::error(StatusCode::invalid_argument,
                         "configuration.hand_eye_orientation is no quaternion: 0 0 0 1 turns nothing");
  }
  if (const Status status = VirtualCamera::initialise(); !status) return status;
  eye_ = disturbed({.pose = to_isometry(told), .focal_length = configuration.focal_length},
                   {.position = configuration.position_error,
                    .orientation = configuration.orientation_error,
                    .focal_length = configuration.focal_error},
                   environment().seed);
  RendererPlan plan;
  plan.pinhole.width = configuration.width;
  plan.pinhole.height = configuration.height;
  plan.pinhole.focal_length = eye_.focal_length;
  plan.pinhole.centre_column = (configuration.width - 1.0) / 2;
  plan.pinhole.centre_row = (configuration.height - 1.0) / 2;
  plan.hand.reach = configuration.hand_reach;
  plan.noise = configuration.noise;
  plan.seed = environment().seed;
  renderer_ = std::make_unique<SceneRenderer>();
  renderer_->begin(plan);
  waited_ = 0;
  rgb_.resize(std::size_t{3} * configuration.width * configuration.height);
  line_.resize(std::max(configuration.width, configuration.height));
  return {};
}

void SceneCamera::stop() {
  VirtualCamera::stop();
  renderer_.reset();
  rgb_.clear();
  rgb_.shrink_to_fit();
}

/// At the start scene and arm need their first cycles, too: that is no trouble.
const char* SceneCamera::blindness() noexcept {
  constexpr int first_cycles = 4;
  const char* const why = missing();
  if (why == nullptr) {
    waited_ = first_cycles;
  } else if (waited_ < first_cycles) {
    ++waited_;
    return "";
  }
  return why;
}

const char* SceneCamera::missing() noexcept {
  if (!scene.latest() || !arm.latest())
    return "the scene that it looks into says nothing; does its device run?";
  if (!true_joints.latest()) return "the arm that carries it does not say where it is; does its device run?";
  return nullptr;
}

bool SceneCamera::look(Time at, SceneGlance& glance) noexcept {
  const auto chain = arm.latest();
  std::array<double, max_joints> joints{};
  if (!chain || scene.at(at, glance.state) != NullReason::none || !joints_at(at, joints)) return false;
  glance.tool = frames_of(*chain, joints).tool;
  // What the hand holds is where the hand is now, not where it was in the scene's step before.
  carry_held_part(glance.state, glance.tool);
  return true;
}

bool SceneCamera::joints_at(Time at, std::array<double, max_joints>& joints) noexcept {
  constexpr Duration nearby = std::chrono::milliseconds(50);
  constexpr std::size_t most = 4;
  JointState before{};
  Time sampled_at{};
  if (true_joints.at(at, before, &sampled_at) != NullReason::none) return false;
  ItemHeader header{};
  header.sampled_at = sampled_at;
  const JointSample last = sample_of(header, before);
  std::array<ItemHeader, most> headers{};
  std::array<JointState, most> states{};
  const std::size_t count =
      true_joints.between(at + Duration{1}, at + nearby, {headers.data(), most}, states.data());
  joints = count > 0 ? joints_between(last, sample_of(headers[0], states[0]), at) : joints_after(last, at);
  return true;
}

void SceneCamera::draw(const PictureCanvas& canvas, Time /*at*/, std::uint64_t sequence) noexcept {
  const bool is_whole = canvas.width == configuration.width && canvas.height == configuration.height;
  const bool is_rgb = canvas.format == PixelFormat::rgb24;
  const std::span<std::uint8_t> rgb = is_whole && is_rgb ? canvas.data : std::span<std::uint8_t>(rgb_);
  switch (injected_fault()) {
    case CameraFault::black:
      std::fill(rgb.begin(), rgb.end(), std::uint8_t{0});
      break;
    case CameraFault::noise:
      draw_noise(rgb, sequence);
      break;
    case CameraFault::blurred:
      draw_scene(rgb, sequence);
      blur(rgb, {configuration.width, configuration.height}, line_);
      break;
    default:
      draw_scene(rgb, sequence);
  }
  if (!is_whole) thin_out(rgb, {configuration.width, configuration.height}, {canvas.width, canvas.height});
  if (!is_rgb) {
    convert_rgb(rgb, canvas.width, canvas.height, canvas.format, canvas.data);
  } else if (!is_whole) {
    std::copy_n(rgb.begin(), canvas.data.size(), canvas.data.begin());
  }
}

void SceneCamera::draw_scene(std::span<std::uint8_t> rgb, std::uint64_t sequence) noexcept {
  renderer_->draw(glance_.state, glance_.tool * eye_.pose, glance_.tool, sequence, rgb);
  const int brightness = value_of(0);
  if (brightness == 0) return;
  for (std::uint8_t& channel : rgb)
    channel = static_cast<std::uint8_t>(std::clamp(channel + brightness, 0, 255));
}

void SceneCamera::draw_noise(std::span<std::uint8_t> rgb, std::uint64_t sequence) const noexcept {
  std::minstd_rand random(static_cast<std::uint32_t>(environment().seed + sequence));
  constexpr int low_bits = 8;  // of a linear generator these are the worst
  for (std::uint8_t& channel : rgb) channel = static_cast<std::uint8_t>(random() >> low_bits);
}

}  // namespace flexrf
