// Recognition: one recogniser. It takes jobs, looks at their regions, and publishes verdicts.
#pragma once

#include <array>
#include <optional>

#include "recognition_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/vision/part_finder.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

class Recognition final : public RecognitionUnit {
 public:
  Status initialise() override;
  void reset() noexcept override;
  void step(const Tick& tick) override;
  /// Not while it holds a job: its thread is released again, though the queue may be empty.
  bool is_idle() const noexcept override { return !waiting_.has_value(); }

 private:
  std::optional<VisionRegion> next_job() noexcept;
  const CameraFrame* frame_of(std::uint64_t sequence) noexcept;
  bool is_flat(const VisionRegion& job) noexcept;
  void look_at_tracks(const VisionRegion& job, const CameraView& view) noexcept;
  bool answer(const VisionRegion& job) noexcept;
  void measure(const PictureView& picture, const VisionRegion& job, const Glance& at,
               const CameraView& view) noexcept;
  void note_nothing(const VisionRegion& job, std::uint32_t pixels, bool is_complete,
                    const Glance& at) noexcept;
  bool find_watched_place(const VisionRegion& job, const CameraView& view,
                          std::array<Eigen::Vector2d, 4>& corners) noexcept;
  template <class Same>
  const VisionVerdict* find_answered(std::uint64_t frame, const Same& same) noexcept;
  const VisionVerdict* find_part_in_the_middle(const PictureView& picture, const VisionRegion& job,
                                               const CameraView& view) noexcept;
  const VisionVerdict* glance(const PictureView& picture, const VisionRegion& job, Glance& at) noexcept;
  void repeat(const VisionRegion& job, const VisionVerdict& known) noexcept;
  void note(const VisionVerdict& verdict) noexcept;
  void complain(const char* trouble) noexcept;

  KnownParts parts_;
  PartFinder finder_;
  VisionVerdicts list_{};
  // Verdicts on tracks, as if they had been measured in picture followed_in_.
  std::array<VisionVerdict, std::tuple_size_v<decltype(TrackList::tracks)>> followed_{};
  std::size_t followed_count_ = 0;
  std::optional<std::uint64_t> followed_in_;
  std::optional<VisionRegion> waiting_;  // a job whose picture this step does not see
  bool is_measured_ = false;             // the last job was answered by a measurement
  PixelRectangle blind_;
  LogLimit troubles_;
};

}  // namespace flexrf::user
