// V4l2Camera: a camera of the machine, through the kernel's video interface.
#pragma once

#include <atomic>

#include "hal/camera/interface/camera_journal.hpp"
#include "hal/camera/v4l2/video_session.hpp"
#include "hal/driver/helper_thread.hpp"
#include "types/camera_report.hpp"
#include "types/camera_wishes.hpp"
#include "v4l2_camera_driver.hpp"

namespace flexrf {

/// Two threads. The camera's takes pictures and gives buffers back, which neither blocks nor allocates. All
/// that may wait for the camera (opening, closing, setting it) is for the keeper, a thread of its own, which
/// also looks for a camera that went away. A session goes from one to the other and back by two words.
class V4l2Camera final : public V4l2CameraDriver {
 public:
  ~V4l2Camera() override { V4l2Camera::stop(); }

  Status initialise() override;
  void stop() override;
  Status accept(const CameraRuntime& proposed) override;
  void receive(const Tick& tick) noexcept override;

  std::optional<CameraImage> frame() const noexcept override { return image_; }
  /// Readable when a picture or news of the camera is there, whether it is plugged in or not.
  int descriptor() const noexcept override { return events_; }

  /// For tests, before initialise(): the kernel, or what stands before it.
  void use(VideoCalls& calls) noexcept { calls_ = &calls; }

 private:
  static constexpr std::size_t most_loans = 8;

  // ---- the lifecycle thread's
  // ---- the keeper's
  void keep();
  void look_after();
  void begin_session();
  void heed_wishes();
  void tell(const Status& trouble);
  void ring() noexcept;

  // ---- the camera's thread's
  void follow_keeper(Time now) noexcept;
  void read_report() noexcept;
  bool take_picture(Time now) noexcept;
  Time time_of(const PictureStamp& stamp) noexcept;
  int pass_on(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept;
  int publish_filled(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept;
  int publish_copy(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept;
  int show(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept;
  void describe(CameraFrame& frame, const VideoPicture& picture, Time at,
                std::uint64_t sequence) const noexcept;
  int borrow() noexcept;
  int give_back_shown() noexcept;
  void lose(const Status& why) noexcept;

  VideoCalls kernel_;
  VideoCalls* calls_ = &kernel_;
  int events_ = -1;  // epoll: of the camera's and of news_
  int news_ = -1;    // eventfd

  // Between the two.
  std::atomic<VideoSession*> given_{nullptr};
  std::atomic<bool> returned_{false};
  std::atomic<bool> rung_{false};
  std::atomic<std::int64_t> heard_{0};  // ns, when a picture came or the stream began; 0: none is awaited
  Slot<CameraReport, 1> report_slot_;
  Slot<CameraWishes, 1> wishes_slot_;

  // The keeper's; the lifecycle thread's while it does not run.
  std::unique_ptr<VideoSession> kept_;
  VideoRequest request_;
  Duration silence_{};
  Status trouble_;  // as last told
  std::uint64_t wish_seen_ = 0;
  Output<CameraReport> reports_;
  SlotReader wishes_reader_{&wishes_slot_.control()};
  HelperThread keeper_;

  // The camera's thread's.
  VideoSession* session_ = nullptr;
  std::array<Loan<CameraFrame>, most_loans> loans_;
  std::array<CameraFrame*, most_loans> lent_{};  // where they are
  std::size_t loan_count_ = 0;
  CameraJournal journal_;
  PictureClock clock_;
  const char* told_clock_ = "";  // in the log, of this stream
  std::optional<CameraImage> image_;
  std::optional<std::uint32_t> shown_;  // the kernel's buffer that image_ is in
  std::array<char, 256> wished_{};
  Output<CameraWishes> wishes_;
  SlotReader report_reader_{&report_slot_.control()};
  std::uint64_t report_seen_ = 0;
};

}  // namespace flexrf
