#include "units/recognition/recognition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "units/vision/attention_genes.hpp"
#include "units/vision/camera_view.hpp"
#include "units/vision/hidden_part.hpp"
#include "units/vision/integral_images.hpp"
#include "units/vision/watched_place.hpp"

namespace flexrf::user {
namespace {

// Attention's windows fit what they show closely; around it the table has to be seen.
constexpr int margin_share = 4;  // of a region's side, on each side
// A region holds what another one held if its middle is so near to the region's, as part of its side.
constexpr double near_the_middle = 0.3;
// Two boxes show the same if they have so much of the larger one in common.
constexpr double the_same = 0.6;
constexpr double within = 0.9;  // of a piece, to belong to what was measured
// Pixels of the smallest piece of a part that says something. A glance that may have missed it says nothing
// of the regions within: theirs is finer.
constexpr std::uint32_t smallest_piece = 100;
// A track that was measured at most so long ago, and not missed since, still lies where it was.
constexpr double as_it_was = 0.25;  // s
// Jobs of pictures that are gone are put away so many at a time, that a step ends.
constexpr int most_outdated = 64;
// Of luminance and of opponent colours, 0 to 255: less differs on a bare table by noise, texture and light.
constexpr double flat_variance = 9;
constexpr double flat_colour = 1.5;
constexpr double usual_luminance = 100;  // of a picture in the light that these are for, at least

PixelRectangle rectangle_of(const VisionRegion& job) {
  const PixelRectangle own{job.left, job.top, job.width, job.height};
  if (job.member == no_member) return own;
  const int across = own.width / margin_share;
  const int down = own.height / margin_share;
  return {own.left - across, own.top - down, own.width + 2 * across, own.height + 2 * down};
}

/// There was but the table in a region that has all of the job's within it.
bool covers(const VisionVerdict& nothing, const VisionRegion& job) {
  const VisionRegion& seen = nothing.region;
  if (!nothing.complete) return false;
  return seen.left <= job.left && seen.top <= job.top && seen.left + seen.width >= job.left + job.width &&
         seen.top + seen.height >= job.top + job.height;
}

/// What was measured lies in the middle of the job's region, or nothing was found where it is.
bool answers(const VisionVerdict& verdict, const VisionRegion& job) {
  if (verdict.verdict == VisualClass::nothing) return covers(verdict, job);
  const double across = verdict.pixel[0] - (job.left + 0.5 * job.width);
  const double down = verdict.pixel[1] - (job.top + 0.5 * job.height);
  return std::max(std::abs(across), std::abs(down)) < near_the_middle * std::max(job.width, job.height);
}

std::uint16_t kind_of(std::uint8_t pixel_class) {
  return pixel_class < class_first_part ? no_kind
                                        : static_cast<std::uint16_t>(pixel_class - class_first_part);
}

/// The verdict is about the thing in the middle of a glance, or the glance saw a piece of that thing. A blob
/// of a part's colour may have been measured to be no part; whatever is foreign is measured each time, as it
/// may be an obstacle.
bool shows(const VisionVerdict& verdict, const Glance& at) {
  if (verdict.kind != kind_of(at.pixel_class)) return false;
  if (verdict.verdict == VisualClass::nothing && at.pixel_class == class_foreign) return false;
  const PixelRectangle box{verdict.left, verdict.top, verdict.width, verdict.height};
  const int common = common_part(box, at.middle).area();
  return at.is_cut ? common > within * at.middle.area()
                   : common > the_same * std::max(box.area(), at.middle.area());
}

bool has_usable_size(const CameraFrame& frame) {
  return frame.format == PixelFormat::rgb24 && frame.width == picture_width &&
         frame.height == picture_height && frame.stride >= picture_row_bytes &&
         std::uint64_t{frame.stride} * (picture_height - 1) + picture_row_bytes <= frame.data().size();
}

PixelRectangle within_picture(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return {};
  constexpr double far = 4 * picture_width;
  const Eigen::Vector2d from = box.min().cwiseMax(-far);
  const Eigen::Vector2d to = box.max().cwiseMin(far);
  const PixelRectangle whole{static_cast<int>(std::floor(from.x())), static_cast<int>(std::floor(from.y())),
                             static_cast<int>(std::ceil(to.x()) - std::floor(from.x())),
                             static_cast<int>(std::ceil(to.y()) - std::floor(from.y()))};
  return common_part(whole, {0, 0, int{picture_width}, int{picture_height}});
}

/// The part of the picture that an upright cylinder takes up; empty: the camera stands below its top.
PixelRectangle shown(const Eigen::Vector2d& middle, double radius, double height, const CameraView& view) {
  Eigen::AlignedBox2d box;
  for (const double across : {-radius, radius}) {
    for (const double down : {-radius, radius}) {
      for (const double z : {0.0, height}) {
        Eigen::Vector2d pixel;
        if (!view.to_picture({middle.x() + across, middle.y() + down, z}, pixel)) return {};
        box.extend(pixel);
      }
    }
  }
  return within_picture(box);
}

/// What shows it in the picture: of a part all corners, below and above; of an obstacle, whose shape nobody
/// knows, what was seen of it.
PixelRectangle shown(const Finding& finding, const PartModel* part, const CameraView& view) {
  if (finding.found == VisualClass::obstacle) return finding.box;
  Eigen::AlignedBox2d box;
  if (finding.found == VisualClass::target && part != nullptr) {
    const Eigen::Rotation2Dd turn(finding.pose.angle);
    for (const Eigen::Vector2d& corner : part->outline()) {
      const Eigen::Vector2d at = finding.pose.position + turn * corner;
      for (const double z : {0.0, part->height}) {
        Eigen::Vector2d pixel;
        if (view.to_picture({at.x(), at.y(), z}, pixel)) box.extend(pixel);
      }
    }
  }
  return within_picture(box);
}

VisionVerdict verdict_of(const VisionRegion& job, const Finding& finding, const PixelRectangle& box) {
  VisionVerdict verdict{};
  verdict.region = job;
  verdict.verdict = finding.found;
  verdict.kind = finding.kind;
  verdict.position_map() = finding.pose.position;
  verdict.angle = finding.pose.angle;
  verdict.radius = finding.radius;
  verdict.body_height = finding.height;
  verdict.lean_map() = finding.lean;
  verdict.residual = finding.residual;
  verdict.support = finding.support;
  verdict.pixel_map() = finding.pixel;
  if (!box.is_empty()) {
    verdict.left = static_cast<std::uint16_t>(box.left);
    verdict.top = static_cast<std::uint16_t>(box.top);
    verdict.width = static_cast<std::uint16_t>(box.width);
    verdict.height = static_cast<std::uint16_t>(box.height);
  }
  verdict.parts = 1;
  return verdict;
}

}  // namespace

Status Recognition::initialise() {
  if (const Status status = parts_.take(configuration.catalogue); !status) return status;
  finder_.prepare(parts_.all(), configuration.catalogue.table, configuration.darkest_shadow);
  reset();
  return check_camera(configuration.camera);
}

/// The count of verdicts goes on: their readers have seen those of before. A job that was held until now is
/// nobody's any more, and counts as outdated.
void Recognition::reset() noexcept {
  feedback = {};
  if (waiting_) ++feedback.outdated;
  waiting_.reset();
}

/// Slots are read after the first job was taken: its picture was published before it, so it is there.
void Recognition::step(const Tick& /*tick*/) {
  const auto hand = in_hand.latest();
  blind_ = hidden_part(configuration.camera, hand ? &*hand : nullptr);
  followed_in_.reset();
  std::uint32_t done = 0;
  std::uint64_t told = list_.count;
  const auto tell = [&] {
    if (list_.count != told) verdicts.publish(list_);
    told = list_.count;
  };
  for (int outdated = 0; done < runtime.jobs && outdated < most_outdated;) {
    const bool has_waited = waiting_.has_value();
    const std::optional<VisionRegion> job = next_job();
    if (!job) break;
    const auto newest = frames.latest();
    if (newest && job->frame > newest->sequence && !has_waited) {
      // Of a picture that came since this step began to look.
      waiting_ = job;
      break;
    }
    if (!answer(*job)) {
      ++outdated;
      continue;
    }
    ++done;
    // A measurement is published at once: the arm may wait for it, and no other recogniser repeats it.
    if (is_measured_) tell();
  }
  tell();
  feedback.done += done;
}

std::optional<VisionRegion> Recognition::next_job() noexcept {
  if (waiting_) return std::exchange(waiting_, std::nullopt);
  if (auto job = tracked_regions.pop()) return job;
  return regions.pop();
}

/// The newest picture, or the one that was kept; null: neither is it.
const CameraFrame* Recognition::frame_of(std::uint64_t sequence) noexcept {
  if (const auto kept = frames.kept(); kept && kept->sequence == sequence) return &*kept;
  const auto newest = frames.latest();
  if (!newest || newest->sequence != sequence) return nullptr;
  frames.keep();
  return &*newest;
}

/// False: nobody can answer it any more.
bool Recognition::answer(const VisionRegion& job) noexcept {
  is_measured_ = false;
  const CameraFrame* const frame = frame_of(job.frame);
  if (frame == nullptr || !has_usable_size(*frame)) {
    ++feedback.outdated;
    return false;
  }
  Pose tool{};
  if (const NullReason reason = tool_pose_at(tool_poses, Time{Duration{frame->time}}, tool);
      reason != NullReason::none) {
    ++feedback.outdated;
    if (lacks_poses(reason, tool_poses))
      complain(
          "where the tool was when the picture was taken is not known: its slot needs a history that reaches "
          "back");
    return false;
  }
  feedback.set_trouble({});
  const CameraView view(configuration.camera, tool);
  const bool is_tracked = job.member == no_member;
  if (!is_tracked) {
    look_at_tracks(job, view);
    const auto same = [&job](const VisionVerdict& verdict) { return answers(verdict, job); };
    if (const VisionVerdict* const known = find_answered(job.frame, same); known != nullptr) {
      repeat(job, *known);
      return true;
    }
  }
  if (!job.watched && is_flat(job)) {
    note_nothing(job, 0, is_tracked, {});
    return true;
  }
  const PictureView picture{frame->data().data(), frame->stride, static_cast<int>(frame->width),
                            static_cast<int>(frame->height)};
  if (const auto of = features.latest()) finder_.set_light({of->white_balance}, of->sees_table);
  Glance at = Glance::none(rectangle_of(job));
  if (!is_tracked) {
    if (const VisionVerdict* const known = find_part_in_the_middle(picture, job, view); known != nullptr) {
      feedback.pixels += finder_.pixels();
      repeat(job, *known);
      return true;
    }
    if (const VisionVerdict* const known = glance(picture, job, at); known != nullptr) {
      feedback.pixels += at.pixels;
      repeat(job, *known);
      return true;
    }
  }
  measure(picture, job, at, view);
  return true;
}

void Recognition::measure(const PictureView& picture, const VisionRegion& job, const Glance& at,
                          const CameraView& view) noexcept {
  std::array<Eigen::Vector2d, 4> place;
  if (job.watched && !find_watched_place(job, view, place)) return note_nothing(job, 0, false, {});
  Finding expected;
  if (job.track != 0) {
    expected.kind = job.kind;
    expected.pose.position = {job.expected[0], job.expected[1]};
    expected.pose.angle = job.expected[2];
  }
  const FindingLimits limits{runtime.least_support, runtime.most_residual, runtime.least_obstacle,
                             runtime.obstacle_height};
  const auto findings = job.watched ? finder_.measure_all(picture, at.rectangle, blind_, view, limits, place)
                                    : finder_.measure(picture, at, blind_, view, expected, limits);
  is_measured_ = true;
  feedback.pixels += finder_.pixels();
  const bool is_tracked = job.member == no_member;
  if (findings.empty()) {
    // A glance from too far away may have missed a thing.
    const bool is_close = is_tracked || (at.is_empty() && at.least <= smallest_piece);
    note_nothing(job, finder_.pixels(), is_close && finder_.is_complete(), is_tracked ? Glance{} : at);
  }
  std::uint8_t part = 0;
  for (const Finding& finding : findings) {
    VisionVerdict verdict = verdict_of(job, finding, shown(finding, parts_.find(finding.kind), view));
    verdict.pixels = part == 0 ? finder_.pixels() : 0;
    verdict.part = part++;
    verdict.parts = static_cast<std::uint8_t>(findings.size());
    verdict.complete = is_tracked && finder_.is_complete();
    ++(finding.found == VisualClass::target ? feedback.targets : feedback.obstacles);
    note(verdict);
  }
}

void Recognition::note_nothing(const VisionRegion& job, std::uint32_t pixels, bool is_complete,
                               const Glance& at) noexcept {
  Finding finding;
  finding.kind = kind_of(at.pixel_class);
  VisionVerdict nothing = verdict_of(job, finding, at.middle);
  nothing.pixel = {job.left + 0.5 * job.width, job.top + 0.5 * job.height};
  nothing.pixels = pixels;
  nothing.complete = is_complete;
  ++feedback.nothing;
  note(nothing);
}

/// Its corners in the picture. False: another place is watched by now.
bool Recognition::find_watched_place(const VisionRegion& job, const CameraView& view,
                                     std::array<Eigen::Vector2d, 4>& corners) noexcept {
  const auto hand = in_hand.latest();
  if (!hand) return false;
  const WatchedPlace watched(*hand);
  if (!watched.is_of(job)) return false;
  constexpr std::array around{Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                              Eigen::AlignedBox2d::TopRight, Eigen::AlignedBox2d::TopLeft};
  for (std::size_t i = 0; i < around.size(); ++i)
    if (!view.to_picture(watched.on_table(watched.room().corner(around[i])), corners[i])) return false;
  return true;
}

/// Notes where the job's picture shows the tracks that were measured in it or just before.
void Recognition::look_at_tracks(const VisionRegion& job, const CameraView& view) noexcept {
  if (followed_in_ == job.frame) return;
  followed_in_ = job.frame;
  followed_count_ = 0;
  const auto list = tracks.latest();
  if (!list) return;
  for (const ObjectTrack& track : list->tracks) {
    if (track.found == VisualClass::nothing || !track.confirmed || track.misses > 0 ||
        std::abs(seconds(Duration{job.time - track.measured_at})) > as_it_was)
      continue;
    Finding finding;
    finding.found = track.found;
    finding.kind = track.kind;
    finding.pose = {track.position_map(), track.angle};
    finding.height = track.body_height;
    finding.radius = track.radius;
    finding.residual = track.residual;
    finding.support = 1;
    // A part is seen by its top, an obstacle by all of its height.
    const bool is_part = track.found == VisualClass::target;
    const double height = is_part ? track.body_height : track.body_height / 2;
    if (!view.to_picture({track.position[0], track.position[1], height}, finding.pixel)) continue;
    if (!is_part) finding.box = shown(track.position_map(), track.radius, track.body_height, view);
    followed_[followed_count_++] = verdict_of(job, finding, shown(finding, parts_.find(finding.kind), view));
  }
}

/// The features of its picture say that there is but the table: it differs from itself by as much less as it
/// is darker. Where they are of another picture: unknown.
bool Recognition::is_flat(const VisionRegion& job) noexcept {
  const auto of = features.latest();
  if (!of || of->frame != job.frame) return false;
  const FeatureWindow window{job.left / 2U, job.top / 2U,
                             std::min((job.left + job.width) / 2U, feature_width),
                             std::min((job.top + job.height) / 2U, feature_height)};
  if (window.right <= window.left || window.bottom <= window.top) return false;
  const double area = window.area();
  // A window that large is never flat, and its squares do not fit.
  if (area > 60000) return false;
  const double mean = window_sum(of->luminance, window) / area;
  const double variance = window_sum(of->luminance_squared, window) / area - mean * mean;
  const FeatureWindow all{0, 0, feature_width, feature_height};
  const auto differs = [&](const auto& sums) {
    return std::abs(window_sum(sums, window) / area - window_sum(sums, all) / all.area());
  };
  const double light = std::min(mean / usual_luminance, 1.0);
  return variance < flat_variance * light * light && differs(of->red_green) < flat_colour * light &&
         differs(of->yellow_blue) < flat_colour * light;
}

/// A verdict of which `same` is true: measured in that picture by any recogniser, or of a track that was
/// measured just before. Null: there is none.
template <class Same>
const VisionVerdict* Recognition::find_answered(std::uint64_t frame, const Same& same) noexcept {
  const auto find_in = [&](const VisionVerdicts& list) -> const VisionVerdict* {
    const std::uint64_t kept = std::min<std::uint64_t>(list.count, list.verdicts.size());
    for (std::uint64_t i = 0; i < kept; ++i) {
      const VisionVerdict& verdict = list.verdicts[(list.count - 1 - i) % list.verdicts.size()];
      if (verdict.region.frame == frame && !verdict.repeated && same(verdict)) return &verdict;
    }
    return nullptr;
  };
  if (const VisionVerdict* const own = find_in(list_); own != nullptr) return own;
  for (std::size_t i = 0; i < followed_count_; ++i)
    if (same(followed_[i])) return &followed_[i];
  for (auto& other : answered) {
    const auto list = other.latest();
    if (!list) continue;
    if (const VisionVerdict* const found = find_in(*list); found != nullptr) return found;
  }
  return nullptr;
}

/// The verdict on a known part, if the middle of the job's region has its colour and lies within its outline.
/// Null: there is none. Attention often finds a piece of a part.
const VisionVerdict* Recognition::find_part_in_the_middle(const PictureView& picture, const VisionRegion& job,
                                                          const CameraView& view) noexcept {
  const int column = job.left + job.width / 2;
  const int row = job.top + job.height / 2;
  const std::uint8_t of = finder_.class_at(picture, column, row, blind_);
  const PartModel* const part =
      of < class_first_part ? nullptr : parts_.find(static_cast<std::uint16_t>(of - class_first_part));
  Eigen::Vector2d place;
  if (part == nullptr || !view.to_plane(column + 0.5, row + 0.5, part->height, place)) return nullptr;
  const auto same = [&](const VisionVerdict& verdict) {
    return verdict.verdict == VisualClass::target && parts_.find(verdict.kind) == part &&
           is_within(*part, {verdict.position_map(), verdict.angle}, place);
  };
  return find_answered(job.frame, same);
}

/// What was measured of what a glance at the job's region saw, by whichever recogniser; null: nothing, or it
/// saw nothing.
const VisionVerdict* Recognition::glance(const PictureView& picture, const VisionRegion& job,
                                         Glance& at) noexcept {
  const auto same = [&at](const VisionVerdict& verdict) { return shows(verdict, at); };
  at = finder_.glance(picture, rectangle_of(job), blind_);
  const VisionVerdict* known = at.is_empty() ? nullptr : find_answered(job.frame, same);
  if (known != nullptr || !at.is_cut) return known;
  at = finder_.glance_around(picture, at, blind_);
  return at.is_empty() ? nullptr : find_answered(job.frame, same);
}

void Recognition::repeat(const VisionRegion& job, const VisionVerdict& known) noexcept {
  VisionVerdict verdict = known;
  verdict.region = job;
  verdict.repeated = true;
  verdict.pixels = 0;
  verdict.part = 0;
  verdict.parts = 1;
  if (verdict.verdict == VisualClass::nothing)
    verdict.pixel = {job.left + 0.5 * job.width, job.top + 0.5 * job.height};
  ++feedback.repeated;
  note(verdict);
}

void Recognition::note(const VisionVerdict& verdict) noexcept {
  list_.verdicts[list_.count % list_.verdicts.size()] = verdict;
  ++list_.count;
}

void Recognition::complain(const char* trouble) noexcept {
  feedback.set_trouble(trouble);
  log_warning(troubles_, name(), "{}", trouble);
}

}  // namespace flexrf::user
