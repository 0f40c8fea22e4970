// VirtualCamera: a driver of Camera over a generated base, whose pictures are made in memory. What differs
// between drivers is what they show and when.
#pragma once

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>

#include "hal/camera/interface/camera_controls.hpp"
#include "hal/camera/interface/camera_journal.hpp"
#include "hal/camera/interface/jpeg_check.hpp"
#include "hal/camera/interface/jpeg_maker.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "runtime/blackboard/sized_slot.hpp"
#include "types/camera_fault.hpp"

namespace flexrf {

/// What may happen to a camera that is only imagined. Any thread.
struct CameraCable {
  std::atomic<bool> plugged{true};
  std::atomic<bool> occupied{false};        ///< another program streams from it
  std::atomic<bool> silent{false};          ///< it is there and gives nothing
  std::atomic<std::uint32_t> to_lose{0};    ///< so many of the next pictures nobody gets
  std::atomic<std::uint32_t> to_damage{0};  ///< so many of the next come garbled
};

/// When the next picture comes, and whether whole.
struct ComingPicture {
  Duration after{};           ///< the one before, or the stream's beginning; Duration::max(): never
  std::uint32_t skipped = 0;  ///< the camera took so many in between that nobody got
  bool damaged = false;
};

/// Where a picture is to be drawn; rows without gaps.
struct PictureCanvas {
  std::span<std::uint8_t> data;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PixelFormat format = PixelFormat::none;
};

template <class Base>
class VirtualCamera : public Base {
 public:
  ~VirtualCamera() override { close_timer(); }

  Status initialise() override {
    VirtualCamera::stop();
    const auto& set = this->configuration;
    if (!refusal_.is_ok()) return refusal_;
    if (Status status = check_picture(set.width, set.height, set.format, this->frames.elements()); !status)
      return status;
    if (Status status = check_settings(controls_, text_view(this->runtime.controls)); !status) return status;
    jpegs_.reset();
    small_jpegs_.reset();
    if (set.format == PixelFormat::mjpeg) {
      if (Status status = begin_jpegs(jpegs_, set.width, set.height); !status) return status;
      if (Status status = begin_jpegs(small_jpegs_, half_of(set.width), half_of(set.height)); !status)
        return status;
    }
    given_.reset();
    journal_.restart(this->name());
    streaming_ = false;
    now_ = Time{};
    controls_in_force_ = {};
    if (!this->frames.is_connected()) own_.emplace(most_bytes());
    if (!this->environment().virtual_time) {
      timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
      if (timer_ < 0) {
        return Status::error(StatusCode::internal, "no timer for the camera: %s", std::strerror(errno));
      }
      arm_timer(Time{Duration{1}});  // due at once: the first cycle begins the stream
    }
    return {};
  }
  void stop() override {
    close_timer();
    image_.reset();
    own_.reset();
  }

  using Base::accept;
  Status accept(const typename Base::Runtime& proposed) override {
    return check_settings(controls_, text_view(proposed.controls));
  }

  void receive(const Tick& tick) noexcept override {
    now_ = tick.now;
    image_.reset();
    set_controls();
    follow_cable();
    if (timer_ >= 0) skip_late();
    for (int taken = 0; streaming_ && due_ <= now_ && taken < most_per_cycle; ++taken) take();
    if (streaming_ && now_ - heard_ >= silence()) {
      journal_.note_away("the camera is there and gives no pictures; it is begun anew until it does");
      streaming_ = false;
    }
    journal_.fill(this->feedback);
    this->feedback.frame_rate = this->configuration.frame_rate;
    std::copy(controls_.begin(), controls_.end(), this->feedback.controls.begin());
    if (timer_ >= 0) arm_timer(next_event());
  }

  std::optional<CameraImage> frame() const noexcept override { return image_; }
  int descriptor() const noexcept override { return timer_; }
  Time next_event() const noexcept override {
    if (now_ == Time{}) return Time{};
    return streaming_ ? std::min(due_, heard_ + silence()) : now_ + looking_interval;
  }

  // ---- for tests

  /// Any thread.
  CameraCable& cable() noexcept { return cable_; }
  /// What initialise() fails with from now on. Before it.
  void refuse(const Status& cause) noexcept { refusal_ = cause; }

 protected:
  static constexpr std::size_t most_controls = 4;

  virtual ComingPicture next_picture() noexcept { return {period(), 0, false}; }
  /// What is wrong with it now. Of `black` and `noise` draw() takes care, of the others nobody else.
  virtual CameraFault injected_fault() const noexcept { return CameraFault::none; }
  /// From the middle of an exposure until its picture comes: a sensor is read out, and a wire takes its time.
  /// A picture's time is the former.
  virtual Duration delay() const noexcept { return {}; }
  /// Why there is nothing that it could see, for the operator, while it is so; null: it sees; "": it does
  /// not, which is not worth telling yet. In each cycle.
  virtual const char* blindness() noexcept { return nullptr; }
  /// Before draw(): false when it is not known what there was to be seen at `at`. Then the picture is lost.
  virtual bool expose(Time /*at*/) noexcept { return true; }
  /// `at`: the middle of its exposure. The canvas may be smaller than what was asked for.
  virtual void draw(const PictureCanvas& canvas, Time at, std::uint64_t sequence) noexcept = 0;

  /// Before initialise().
  void offer(std::size_t index, std::string_view control, CameraControlKind kind, std::int32_t minimum,
             std::int32_t maximum, std::int32_t default_value, bool read_only = false) noexcept {
    CameraControl& one = controls_[index];
    set_text(one.name, control);
    one.kind = kind;
    one.minimum = minimum;
    one.maximum = maximum;
    one.step = 1;
    one.default_value = one.value = default_value;
    one.read_only = read_only;
  }
  std::int32_t value_of(std::size_t index) const noexcept { return controls_[index].value; }
  Duration period() const noexcept { return duration_of(1.0 / this->configuration.frame_rate); }

 private:
  /// A thread that comes late must not be held for ever by what it missed.
  static constexpr int most_per_cycle = 8;
  /// So many pictures a camera keeps for who comes late.
  static constexpr int most_waiting = 3;
  /// Of one with a low frame rate.
  static constexpr Duration slow_period = std::chrono::seconds(1);
  /// Out of order each second picture is as many older than the one that would have come.
  static constexpr std::uint32_t steps_back = 2;

  /// A picture that was given.
  struct Given {
    Time at{};  // the middle of its exposure
    std::uint64_t sequence = 0;
  };

  static Status begin_jpegs(std::unique_ptr<JpegMaker>& jpegs, std::uint32_t width, std::uint32_t height) {
    jpegs = std::make_unique<JpegMaker>();
    return jpegs->begin(width, height);
  }
  /// An even number, as some formats need it; of less than 4 there is no half.
  static constexpr std::uint32_t half_of(std::uint32_t length) noexcept {
    return length < 4 ? length : length / 4 * 2;
  }
  /// How soon it is noticed that the camera is back.
  static constexpr Duration looking_interval = std::chrono::milliseconds(50);

  /// Of a picture: as its slot has room for, or, where it has none, as it takes at most.
  std::size_t most_bytes() const noexcept {
    constexpr std::size_t most_of_a_jpeg_without_picture = 4096;
    const auto& set = this->configuration;
    return this->frames.is_connected()
               ? this->frames.elements()
               : std::size_t{3} * set.width * set.height + most_of_a_jpeg_without_picture;
  }

  Duration silence() const noexcept { return duration_of(this->configuration.silence); }

  void set_controls() noexcept {
    const auto& wanted = this->runtime.controls;
    if (wanted == controls_in_force_) return;
    controls_in_force_ = wanted;
    const Result<CameraSettings> settings = CameraSettings::parse(text_view(wanted));
    if (!settings) return;
    for (const CameraSetting& setting : settings->all()) {
      for (CameraControl& control : controls_)
        if (text_view(control.name) == setting.name) control.value = setting.value;
    }
  }

  void follow_cable() noexcept {
    const bool occupied = cable_.occupied.load(std::memory_order_relaxed);
    const bool plugged =
        cable_.plugged.load(std::memory_order_relaxed) && injected_fault() != CameraFault::unplugged;
    const char* const blind = blindness();
    const bool usable = plugged && !occupied && blind == nullptr;
    if (!usable) {
      journal_.note_away(occupied   ? "the camera is in use by another program; end that program"
                         : !plugged ? "the camera is not there; is it plugged in?"
                                    : blind);
    } else if (!streaming_) {
      journal_.begin_stream();
      count_ = 0;
      heard_ = now_;
      plan(now_);
    }
    streaming_ = usable;
  }

  /// By the clock on the wall: who comes too late finds the camera's buffers full, and what came then is
  /// lost.
  void skip_late() noexcept {
    while (streaming_ && coming_.after < most_waiting * period() && due_ + most_waiting * period() <= now_) {
      ++count_;
      plan(due_);
    }
  }

  void plan(Time after) noexcept {
    coming_ = next_picture();
    if (injected_fault() == CameraFault::low_frame_rate) coming_.after = std::max(coming_.after, slow_period);
    due_ = coming_.after == Duration::max() ? Time::max() : after + coming_.after;
  }

  void take() noexcept {
    const Time at = due_;
    if (injected_fault() == CameraFault::frozen && given_) {
      plan(at);
      heard_ = now_;
      return show_again();
    }
    count_ += coming_.skipped;
    const std::uint32_t number = count_++;
    const bool damaged = coming_.damaged;
    plan(at);
    if (cable_.silent.load(std::memory_order_relaxed) || consume(cable_.to_lose)) return;
    const bool is_late = injected_fault() == CameraFault::out_of_order && number % 2 == 0;
    const std::uint32_t back = is_late ? steps_back : 0;
    const Time exposed = at - delay() - back * period();
    if (!expose(exposed)) return;
    heard_ = now_;
    if (damaged || consume(cable_.to_damage)) return journal_.note_damaged(number, damage_of_half());
    show(exposed, number, back);
  }

  static bool consume(std::atomic<std::uint32_t>& count) noexcept {
    std::uint32_t left = count.load(std::memory_order_relaxed);
    while (left > 0 && !count.compare_exchange_weak(left, left - 1, std::memory_order_relaxed)) {
    }
    return left > 0;
  }

  /// What is found of a picture of which but half came.
  const char* damage_of_half() noexcept {
    if (jpegs_ == nullptr) return "garbled on purpose";
    const auto jpeg = jpegs_->make(most_bytes());
    return check_jpeg(jpeg.first(jpeg.size() / 2), this->configuration.width, this->configuration.height)
        .damage;
  }

  /// `back`: so much less than it should be is the count that readers see.
  void show(Time at, std::uint32_t number, std::uint32_t back) noexcept {
    give(at, [this, number, back] {
      const std::uint64_t sequence = journal_.note_whole(number);
      return sequence - std::min<std::uint64_t>(back, sequence);
    });
  }
  void show_again() noexcept {
    give(given_->at, [this] { return given_->sequence; });
  }

  /// `count`: asked for its sequence only when there is room for the picture.
  void give(Time at, auto count) noexcept {
    if (own_) {
      CameraFrame& own = **own_;
      fill(own, at, count());
      image_ = CameraImage{.data = own.data().first(own.size),
                           .width = own.width,
                           .height = own.height,
                           .stride = own.stride,
                           .format = own.format,
                           .time = at,
                           .sequence = own.sequence};
    } else if (auto loan = this->frames.loan()) {
      fill(*loan, at, count());
      loan.publish(at);
    }
  }

  void fill(CameraFrame& frame, Time at, std::uint64_t sequence) noexcept {
    const auto& set = this->configuration;
    const bool is_small = injected_fault() == CameraFault::wrong_size;
    const std::span<std::uint8_t> data = frame.data();
    frame.width = is_small ? half_of(set.width) : set.width;
    frame.height = is_small ? half_of(set.height) : set.height;
    frame.format = set.format;
    frame.stride = row_bytes(set.format, frame.width);
    frame.time = nanoseconds(at);
    frame.sequence = sequence;
    given_ = {at, sequence};
    if (JpegMaker* const jpegs = is_small ? small_jpegs_.get() : jpegs_.get(); jpegs != nullptr) {
      draw({jpegs->canvas(), frame.width, frame.height, PixelFormat::rgb24}, at, sequence);
      const auto jpeg = jpegs->make(data.size());
      frame.size = static_cast<std::uint32_t>(jpeg.size());
      std::copy_n(jpeg.begin(), frame.size, data.begin());
    } else {
      frame.size = static_cast<std::uint32_t>(picture_bytes(frame.format, frame.stride, frame.height));
      draw({data.first(frame.size), frame.width, frame.height, frame.format}, at, sequence);
    }
    // The same run gives the same items, to the last byte.
    std::fill(data.begin() + frame.size, data.end(), std::uint8_t{0});
  }

  void arm_timer(Time when) noexcept {
    itimerspec setting{};  // zero disarms
    if (when != Time::max()) {
      const std::int64_t due = std::max<std::int64_t>(nanoseconds(when), 1);
      setting.it_value.tv_sec = due / 1'000'000'000;
      setting.it_value.tv_nsec = due % 1'000'000'000;
    }
    timerfd_settime(timer_, TFD_TIMER_ABSTIME, &setting, nullptr);
  }
  void close_timer() noexcept {
    if (timer_ >= 0) close(timer_);
    timer_ = -1;
  }

  CameraCable cable_;
  Status refusal_;
  CameraJournal journal_;
  std::array<CameraControl, most_controls> controls_{};
  std::array<char, 256> controls_in_force_{};
  std::optional<SizedItem<CameraFrame>> own_;  // of one that belongs to a unit
  std::unique_ptr<JpegMaker> jpegs_;           // of one that gives mjpeg
  std::unique_ptr<JpegMaker> small_jpegs_;     // likewise, of pictures of the wrong size
  std::optional<Given> given_;                 // last
  std::optional<CameraImage> image_;
  ComingPicture coming_;
  std::uint32_t count_ = 0;  // the camera's
  bool streaming_ = false;
  Time now_{};    // of the last cycle
  Time due_{};    // the next picture
  Time heard_{};  // when the last one came, or the stream began
  int timer_ = -1;
};

}  // namespace flexrf
