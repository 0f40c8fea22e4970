// ObjectTracks: a bounded list of what lies on the table, each thing with a filter of its own.
#pragma once

#include <array>

#include "object_tracks_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/vision/camera_view.hpp"
#include "units/vision/foot_filter.hpp"
#include "units/vision/object_filter.hpp"
#include "units/vision/part_model.hpp"
#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {

class ObjectTracks final : public ObjectTracksUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  static constexpr std::size_t most_tracks = 32;
  static constexpr std::size_t most_recognisers = 16;
  /// What is known of a track beside what is told of it.
  struct Beside {
    ObjectFilter filter;         // as of the picture in which it was measured last: see filter_at()
    FootFilter foot;             // of an obstacle that is_whole
    std::int64_t missed_at = 0;  // ns, the last picture in which it was not there
    bool is_whole = false;       // an obstacle that some picture showed wholly
  };

  double height_of(std::uint16_t kind) const noexcept;  // m; 0: it is no known part
  int symmetry_of(std::uint16_t kind) const noexcept;
  void watch(const TargetInHand* hand) noexcept;
  void take_watch(const VisionVerdict& verdict) noexcept;
  void read_verdicts() noexcept;
  void take(const VisionVerdict& verdict) noexcept;
  std::size_t nearest_to(const VisionVerdict& verdict) const noexcept;
  std::size_t track_of(std::uint32_t identity) const noexcept;
  void measure(std::size_t place, const VisionVerdict& verdict) noexcept;
  void measure_obstacle(ObjectTrack& track, Beside& beside, const VisionVerdict& verdict) noexcept;
  void begin(const VisionVerdict& verdict) noexcept;
  void trust(ObjectTrack& track, const VisionRegion& region) noexcept;
  void miss(std::size_t place, const VisionVerdict& verdict) noexcept;
  void end(std::size_t place) noexcept;
  void trust_the_promoted() noexcept;
  void forget_before(std::int64_t time) noexcept;
  ObjectFilter filter_at(std::size_t place, std::int64_t time) const noexcept;
  void post(const VisualFeatures& of, Time sampled_at) noexcept;
  void push(const VisionRegion& region, Time sampled_at) noexcept;
  bool find_watched_region(VisionRegion& region) const noexcept;
  void place_in_picture(ObjectTrack& track) const noexcept;
  bool predict_region(const ObjectTrack& track, double deviation, VisionRegion& region) const noexcept;
  void publish() noexcept;
  FilterNoise noise() const noexcept;
  FilterNoise noise_of(const VisionVerdict& verdict) const noexcept;

  KnownParts parts_;
  TrackList list_{};
  std::array<Beside, most_tracks> beside_{};
  std::array<std::uint64_t, most_recognisers> read_{};  // verdicts of each recogniser
  std::uint32_t next_identity_ = 1;
  TargetInHand watched_{};  // the place that is watched, if there is one
  PixelRectangle blind_;
  CameraView view_;    // when the list's picture was taken
  bool sees_ = false;  // that is known
  LogLimit troubles_;
  bool is_changed_ = false;
};

}  // namespace flexrf::user
