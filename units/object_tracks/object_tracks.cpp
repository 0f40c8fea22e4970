#include "units/object_tracks/object_tracks.hpp"

#include <algorithm>
#include <cmath>

#include "units/vision/attention_genes.hpp"
#include "units/vision/hidden_part.hpp"
#include "units/vision/watched_place.hpp"

namespace flexrf::user {
namespace {

constexpr double table_around = 0.010;  // m, of a predicted region; as much again where it is not well known
constexpr double most_pixels = 4000;    // of half a rectangle's side: what is larger is too near to tell
// Of what goes on behind the picture's border only a piece has a place: it lies somewhere within the
// obstacle.
constexpr double all_of_an_outline = 0.99;
constexpr double place_of_a_piece = 0.02;    // m, standard deviation
constexpr double place_of_obstacle = 0.003;  // m, likewise, of one that is seen wholly
constexpr double least_seen = 0.6;           // part of a predicted region that lies within the picture
constexpr double around_watched = 0.015;     // m of the table that are looked at around a watched place
constexpr double watched_score = 2;          // before what is measured in each picture

bool is_piece(const VisionVerdict& verdict) {
  return verdict.verdict == VisualClass::obstacle && verdict.support < all_of_an_outline;
}

}  // namespace

Status ObjectTracks::initialise() {
  list_ = {};
  watched_ = {};
  beside_ = {};
  read_ = {};
  is_changed_ = false;
  sees_ = false;
  if (verdicts.size() > most_recognisers)
    return Status::error(StatusCode::invalid_argument,
                         "%s: there are at most %zu recognisers; give the population a smaller capacity",
                         name(), most_recognisers);
  if (const Status status = parts_.take(configuration.catalogue); !status) return status;
  return check_camera(configuration.camera);
}

double ObjectTracks::height_of(std::uint16_t kind) const noexcept {
  const PartModel* const part = parts_.find(kind);
  return part != nullptr ? part->height : 0.0;
}

int ObjectTracks::symmetry_of(std::uint16_t kind) const noexcept {
  const PartModel* const part = parts_.find(kind);
  return part != nullptr ? part->symmetry : 0;
}

void ObjectTracks::step(const Tick& tick) {
  if (runtime.forget > 0)
    for (std::size_t i = 0; i < most_tracks; ++i) end(i);
  const auto hand = in_hand.latest();
  blind_ = hidden_part(configuration.camera, hand ? &*hand : nullptr);
  watch(hand ? &*hand : nullptr);
  if (hand && hand->holds)
    if (const std::size_t held = track_of(hand->track); held < most_tracks) end(held);
  read_verdicts();
  trust_the_promoted();
  const auto of = features.latest();
  if (of && of.is_new()) {
    list_.frame = of->frame;
    list_.time = of->time;
    // One that is stamped ahead of time says nothing of how long a track was not measured.
    forget_before(std::min(of->time, nanoseconds(tick.now)));
    post(*of, of.sampled_at());
    is_changed_ = true;
  }
  if (is_changed_) publish();
  is_changed_ = false;
}

/// Another place than before has not been looked at yet.
void ObjectTracks::watch(const TargetInHand* hand) noexcept {
  const TargetInHand asked = hand != nullptr ? *hand : TargetInHand{};
  if (asked.watch != watched_.watch || asked.watch_angle != watched_.watch_angle ||
      asked.watch_from != watched_.watch_from || asked.watch_to != watched_.watch_to) {
    is_changed_ = is_changed_ || list_.watched_at != 0;
    list_.watched_at = 0;
    list_.watched = {asked.watch[0], asked.watch[1], asked.watch_angle};
  }
  watched_ = asked;
}

void ObjectTracks::read_verdicts() noexcept {
  std::size_t recogniser = 0;
  for (auto& one : verdicts) {
    std::uint64_t& read = read_[recogniser++];
    const auto list = one.latest();
    if (!list || !list.is_new()) continue;
    // A recogniser that was constructed anew begins at 0 again.
    if (list->count < read) read = 0;
    const std::uint64_t kept = list->verdicts.size();
    if (list->count - read > kept) {
      feedback.unread += list->count - read - kept;
      read = list->count - kept;
    }
    for (; read < list->count; ++read) take(list->verdicts[read % kept]);
  }
}

void ObjectTracks::take(const VisionVerdict& verdict) noexcept {
  const VisionRegion& region = verdict.region;
  if (verdict.verdict != VisualClass::nothing && verdict.position_map().allFinite() &&
      std::isfinite(verdict.angle)) {
    const std::size_t place = nearest_to(verdict);
    if (place < most_tracks) {
      measure(place, verdict);
    } else if (!verdict.repeated) {
      begin(verdict);
    }
  }
  if (verdict.part + 1 < verdict.parts) return;
  // The last of a region's verdicts: was the track there that was expected?
  const std::size_t expected = region.track != 0 ? track_of(region.track) : most_tracks;
  if (expected < most_tracks && list_.tracks[expected].measured_at < region.time) miss(expected, verdict);
  if (WatchedPlace(watched_).is_of(region) && verdict.complete && region.time > list_.watched_at)
    take_watch(verdict);
}

/// The verdicts told all that stands in the watched place: an obstacle that they do not name was missed.
void ObjectTracks::take_watch(const VisionVerdict& verdict) noexcept {
  list_.watched_at = verdict.region.time;
  is_changed_ = true;
  const WatchedPlace place(watched_);
  for (std::size_t i = 0; i < most_tracks; ++i) {
    const ObjectTrack& track = list_.tracks[i];
    if (track.found == VisualClass::obstacle && track.measured_at < verdict.region.time &&
        place.holds(beside_[i].filter.position()))
      miss(i, verdict);
  }
}

/// Of the same kind, and within its gate when the verdict's picture was taken; most_tracks: none is.
std::size_t ObjectTracks::nearest_to(const VisionVerdict& verdict) const noexcept {
  std::size_t nearest = most_tracks;
  double least = 1e9;
  for (std::size_t i = 0; i < most_tracks; ++i) {
    const ObjectTrack& track = list_.tracks[i];
    if (track.found != verdict.verdict || track.kind != verdict.kind) continue;
    const ObjectFilter filter = filter_at(i, verdict.region.time);
    double gate = runtime.gate + std::min(3 * filter.deviation(), runtime.gate);
    // An obstacle's middle moves as more or less of it is seen.
    if (is_piece(verdict) || (track.found == VisualClass::obstacle && !beside_[i].is_whole))
      gate += std::max(track.radius, verdict.radius);
    else if (track.found == VisualClass::obstacle)
      gate += 0.5 * track.radius;
    const double distance = (filter.position() - verdict.position_map()).norm();
    if (distance > gate || distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

std::size_t ObjectTracks::track_of(std::uint32_t identity) const noexcept {
  for (std::size_t i = 0; i < most_tracks; ++i)
    if (list_.tracks[i].found != VisualClass::nothing && list_.tracks[i].identity == identity) return i;
  return most_tracks;
}

void ObjectTracks::measure(std::size_t place, const VisionVerdict& verdict) noexcept {
  ObjectTrack& track = list_.tracks[place];
  Beside& beside = beside_[place];
  const VisionRegion& region = verdict.region;
  trust(track, region);
  is_changed_ = true;
  // Once a picture, however many regions showed it; and pictures go on.
  if (verdict.repeated || region.time <= track.measured_at) return;
  // The verdict is about the track as it was when the picture was taken, however many pictures came since.
  beside.filter = filter_at(place, region.time);
  if (track.found == VisualClass::obstacle) {
    measure_obstacle(track, beside, verdict);
  } else {
    beside.filter.correct(verdict.position_map(), verdict.angle, symmetry_of(track.kind), noise());
    track.radius = verdict.radius;
  }
  track.residual = verdict.residual;
  track.measured_at = region.time;
  // A newer picture in which it was not there, told before this one, counts still.
  track.misses = beside.missed_at > region.time ? 1 : 0;
  ++track.frames;
  ++feedback.measurements;
  track.confirmed = track.confirmed || track.frames >= runtime.confirm_frames;
}

/// A piece of one that was seen wholly says that it is there, and nothing of its place.
void ObjectTracks::measure_obstacle(ObjectTrack& track, Beside& beside,
                                    const VisionVerdict& verdict) noexcept {
  if (is_piece(verdict) && beside.is_whole) return;
  const SeenFoot foot{verdict.position_map(), verdict.radius, verdict.body_height, verdict.lean_map()};
  FilterNoise noise = noise_of(verdict);
  if (is_piece(verdict)) {
    beside.filter.correct(foot.middle, 0, 0, noise);
    track.radius = std::max(track.radius, foot.radius);
    return;
  }
  if (runtime.belt && beside.is_whole) {
    beside.filter.correct(foot.middle, 0, 0, noise);
    track.radius = foot.radius;
    return;
  }
  if (beside.is_whole) {
    beside.foot.drift(runtime.drift * std::sqrt(seconds(Duration{verdict.region.time - track.measured_at})));
    beside.foot.correct(foot, noise.measured_position);
  } else {
    beside.foot.begin(foot, noise.measured_position);
  }
  beside.is_whole = true;
  noise.measured_position = beside.foot.deviation();
  beside.filter.begin(beside.foot.middle(), 0, runtime.belt, noise);
  track.radius = beside.foot.radius();
  track.body_height = beside.foot.height();
}

void ObjectTracks::begin(const VisionVerdict& verdict) noexcept {
  const VisionRegion& region = verdict.region;
  const auto free = std::find_if(list_.tracks.begin(), list_.tracks.end(), [](const ObjectTrack& track) {
    return track.found == VisualClass::nothing;
  });
  if (free == list_.tracks.end()) {
    ++feedback.refused;
    restrain("all places for tracks are taken: what was found is not followed");
    return;
  }
  const auto place = static_cast<std::size_t>(free - list_.tracks.begin());
  ObjectTrack& track = *free;
  track = {};
  track.identity = next_identity_++;
  track.found = verdict.verdict;
  track.kind = verdict.kind;
  track.radius = verdict.radius;
  track.body_height = verdict.body_height;
  track.residual = verdict.residual;
  track.measured_at = region.time;
  track.frames = 1;
  track.confirmed = runtime.confirm_frames <= 1;
  track.member = region.member;
  track.member_identity = region.identity;
  Beside& beside = beside_[place];
  beside = {};
  beside.filter.begin(verdict.position_map(), verdict.angle, runtime.belt, noise_of(verdict));
  if (track.found == VisualClass::obstacle) measure_obstacle(track, beside, verdict);
  ++feedback.measurements;
  is_changed_ = true;
  if (region.member != no_member) {
    trust(track, region);
  } else if (const std::size_t beside_it = track_of(region.track); beside_it < most_tracks) {
    // It was seen where another one was looked for, which lends it its member.
    const ObjectTrack& other = list_.tracks[beside_it];
    track.member = other.member;
    track.member_identity = other.member_identity;
    track.trusted = other.trusted;
  }
}

/// By the first member that is not on probation.
void ObjectTracks::trust(ObjectTrack& track, const VisionRegion& region) noexcept {
  if (track.trusted || region.member == no_member || region.probation) return;
  track.trusted = true;
  track.member = region.member;
  track.member_identity = region.identity;
}

void ObjectTracks::trust_the_promoted() noexcept {
  const auto members = generation.latest();
  if (!members) return;
  for (ObjectTrack& track : list_.tracks) {
    if (track.found == VisualClass::nothing || track.trusted || track.member >= members->members.size())
      continue;
    const AttentionMember& member = members->members[track.member];
    if (!member.active || member.probation || member.identity != track.member_identity) continue;
    track.trusted = true;
    is_changed_ = true;
  }
}

/// Once a picture. An obstacle is gone only where all of its place was seen, and told for certain.
void ObjectTracks::miss(std::size_t place, const VisionVerdict& verdict) noexcept {
  const std::int64_t time = verdict.region.time;
  if (beside_[place].missed_at == time) return;
  const bool is_obstacle = list_.tracks[place].found == VisualClass::obstacle;
  if (is_obstacle && !(verdict.complete && verdict.region.whole)) return;
  beside_[place].missed_at = time;
  is_changed_ = true;
  if (++list_.tracks[place].misses < runtime.lost_after) return;
  ++feedback.lost;
  end(place);
}

void ObjectTracks::end(std::size_t place) noexcept {
  is_changed_ = is_changed_ || list_.tracks[place].found != VisualClass::nothing;
  list_.tracks[place] = {};
  beside_[place] = {};
}

/// Ends tracks that are not confirmed and were not measured for long.
void ObjectTracks::forget_before(std::int64_t time) noexcept {
  for (std::size_t i = 0; i < most_tracks; ++i) {
    const ObjectTrack& track = list_.tracks[i];
    if (track.found != VisualClass::nothing && !track.confirmed &&
        seconds(Duration{time - track.measured_at}) > runtime.forget_after)
      end(i);
  }
}

/// A track as of a picture: predicted from its last measurement, or gone back to before that.
ObjectFilter ObjectTracks::filter_at(std::size_t place, std::int64_t time) const noexcept {
  ObjectFilter filter = beside_[place].filter;
  const double elapsed = seconds(Duration{time - list_.tracks[place].measured_at});
  if (elapsed < 0) {
    filter.go_back(-elapsed);
  } else {
    filter.predict(elapsed, runtime.belt, noise());
  }
  return filter;
}

void ObjectTracks::post(const VisualFeatures& of, Time sampled_at) noexcept {
  Pose tool{};
  const NullReason reason = tool_pose_at(tool_poses, Time{Duration{of.time}}, tool);
  sees_ = reason == NullReason::none;
  if (!sees_ && !lacks_poses(reason, tool_poses)) return;
  if (!sees_) {
    constexpr const char* trouble =
        "where the tool was when the picture was taken is not known: its slot needs a history that reaches "
        "back";
    feedback.set_trouble(trouble);
    log_warning(troubles_, name(), "{}", trouble);
    return;
  }
  feedback.set_trouble({});
  view_ = CameraView(configuration.camera, tool);
  for (std::size_t i = 0; i < most_tracks; ++i) {
    const ObjectTrack& track = list_.tracks[i];
    if (track.found == VisualClass::nothing) continue;
    const double rested = seconds(Duration{of.time - track.measured_at});
    // A track on a belt, a missed one and the arm's target are measured in each picture.
    const bool may_rest =
        track.confirmed && track.misses == 0 && track.identity != watched_.track && !runtime.belt;
    if (may_rest && rested < runtime.rest) continue;
    VisionRegion region{};
    region.frame = of.frame;
    region.time = of.time;
    region.score = 1 + std::max(rested, 0.0);
    const ObjectFilter filter = filter_at(i, of.time);
    region.expected = {filter.position().x(), filter.position().y(), filter.angle()};
    if (predict_region(track, filter.deviation(), region)) push(region, sampled_at);
  }
  VisionRegion place{};
  place.frame = of.frame;
  place.time = of.time;
  if (find_watched_region(place)) push(place, sampled_at);
}

void ObjectTracks::push(const VisionRegion& region, Time sampled_at) noexcept {
  if (tracked_regions.push(region, sampled_at))
    ++feedback.posted;
  else
    ++feedback.dropped;
}

/// False: no place is watched, or the picture does not show all of it.
bool ObjectTracks::find_watched_region(VisionRegion& region) const noexcept {
  const WatchedPlace watched(watched_);
  if (!watched.exists()) return false;
  const auto& camera = configuration.camera;
  Eigen::AlignedBox2d around;
  constexpr int steps = 4;  // along each side: nothing of it may be hidden
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      const auto place = [&](double wider) {
        const Eigen::Vector2d from = watched.room().min().array() - wider;
        const Eigen::Vector2d size = watched.room().sizes().array() + 2 * wider;
        return watched.on_table({from.x() + size.x() * i / steps, from.y() + size.y() * k / steps});
      };
      Eigen::Vector2d pixel;
      if (!view_.to_picture(place(0), pixel)) return false;
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= camera.width || pixel.y() >= camera.height ||
          blind_.holds(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())))
        return false;
      if (view_.to_picture(place(around_watched), pixel)) around.extend(pixel);
    }
  }
  const PixelRectangle seen =
      common_part({static_cast<int>(around.min().x()), static_cast<int>(around.min().y()),
                   static_cast<int>(around.sizes().x()) + 1, static_cast<int>(around.sizes().y()) + 1},
                  {0, 0, static_cast<int>(camera.width), static_cast<int>(camera.height)});
  region.left = static_cast<std::uint16_t>(seen.left);
  region.top = static_cast<std::uint16_t>(seen.top);
  region.width = static_cast<std::uint16_t>(seen.width);
  region.height = static_cast<std::uint16_t>(seen.height);
  region.member = no_member;
  region.kind = no_kind;
  region.score = watched_score;
  region.expected = {watched_.watch[0], watched_.watch[1], watched_.watch_angle};
  region.watched = true;
  region.whole = true;
  return true;
}

/// As the position is published, for who shows the picture.
void ObjectTracks::place_in_picture(ObjectTrack& track) const noexcept {
  track.left = track.top = track.width = track.height = 0;
  const Eigen::Vector3d place(track.position[0], track.position[1], height_of(track.kind));
  Eigen::Vector2d pixel;
  if (!sees_ || !view_.to_picture(place, pixel)) return;
  const double half = track.radius * view_.pixels_per_metre(place);
  if (half > most_pixels || pixel.cwiseAbs().maxCoeff() > 2 * most_pixels) return;
  const auto& camera = configuration.camera;
  const PixelRectangle seen =
      common_part({static_cast<int>(pixel.x() - half), static_cast<int>(pixel.y() - half),
                   static_cast<int>(2 * half) + 1, static_cast<int>(2 * half) + 1},
                  {0, 0, static_cast<int>(camera.width), static_cast<int>(camera.height)});
  if (seen.is_empty()) return;
  track.left = static_cast<std::uint16_t>(seen.left);
  track.top = static_cast<std::uint16_t>(seen.top);
  track.width = static_cast<std::uint16_t>(seen.width);
  track.height = static_cast<std::uint16_t>(seen.height);
}

/// False: the picture does not show its place. `deviation`: of that place, m.
bool ObjectTracks::predict_region(const ObjectTrack& track, double deviation,
                                  VisionRegion& region) const noexcept {
  const Eigen::Vector3d place(region.expected[0], region.expected[1], height_of(track.kind));
  Eigen::Vector2d pixel;
  if (!view_.to_picture(place, pixel)) return false;
  const double half =
      (track.radius + table_around + std::min(3 * deviation, table_around)) * view_.pixels_per_metre(place);
  const auto& camera = configuration.camera;
  if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= camera.width || pixel.y() >= camera.height ||
      half > most_pixels)
    return false;
  const PixelRectangle whole{static_cast<int>(pixel.x() - half), static_cast<int>(pixel.y() - half),
                             static_cast<int>(2 * half) + 1, static_cast<int>(2 * half) + 1};
  const PixelRectangle seen =
      common_part(whole, {0, 0, static_cast<int>(camera.width), static_cast<int>(camera.height)});
  if (seen.is_empty()) return false;
  const PixelRectangle hidden = common_part(seen, blind_);
  const int hidden_area = hidden.is_empty() ? 0 : hidden.width * hidden.height;
  const int seen_area = seen.width * seen.height - hidden_area;
  if (seen_area < least_seen * whole.width * whole.height) return false;
  region.left = static_cast<std::uint16_t>(seen.left);
  region.top = static_cast<std::uint16_t>(seen.top);
  region.width = static_cast<std::uint16_t>(seen.width);
  region.height = static_cast<std::uint16_t>(seen.height);
  region.member = no_member;
  region.track = track.identity;
  region.kind = track.kind;
  region.whole = seen_area == whole.width * whole.height;
  return true;
}

void ObjectTracks::publish() noexcept {
  list_.count = 0;
  feedback.confirmed = feedback.targets = 0;
  for (std::size_t i = 0; i < most_tracks; ++i) {
    ObjectTrack& track = list_.tracks[i];
    if (track.found == VisualClass::nothing) continue;
    const ObjectFilter filter = filter_at(i, std::max(list_.time, track.measured_at));
    track.position_map() = filter.position();
    track.velocity_map() = filter.velocity();
    track.angle = filter.angle();
    track.deviation = filter.deviation();
    place_in_picture(track);
    track.may_be_target = track.found == VisualClass::target && track.confirmed && track.trusted;
    ++list_.count;
    if (track.confirmed) ++feedback.confirmed;
    if (track.may_be_target) ++feedback.targets;
  }
  feedback.tracks = list_.count;
  tracks.publish(list_);
}

FilterNoise ObjectTracks::noise() const noexcept {
  FilterNoise noise;
  noise.measured_position = runtime.measurement;
  noise.drift = runtime.drift;
  return noise;
}

FilterNoise ObjectTracks::noise_of(const VisionVerdict& verdict) const noexcept {
  FilterNoise own = noise();
  if (verdict.verdict == VisualClass::obstacle)
    own.measured_position =
        std::max(own.measured_position, is_piece(verdict) ? place_of_a_piece : place_of_obstacle);
  return own;
}

}  // namespace flexrf::user
