// The camera's thread, and the lifecycle thread; the keeper's part is in camera_keeper.cpp.
#include "hal/camera/v4l2/v4l2_camera.hpp"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/camera/interface/picture_size.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// A thread that comes late must not be held for ever by what it missed.
constexpr int most_per_cycle = 8;

bool watch(int events, int descriptor) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  return epoll_ctl(events, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

}  // namespace

Status V4l2Camera::initialise() {
  V4l2Camera::stop();
  const auto& set = configuration;
  if (Status status = check_picture(set.width, set.height, set.format, frames.elements()); !status)
    return status;
  feedback = {};
  trouble_ = {};
  journal_.restart(name());
  events_ = epoll_create1(EPOLL_CLOEXEC);
  news_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (events_ < 0 || news_ < 0 || !watch(events_, news_))
    return Status::error(StatusCode::internal, "the camera cannot be waited for: %s", std::strerror(errno));
  for (std::size_t i = 0; frames.is_connected() && i < most_loans; ++i) {
    loans_[i] = frames.loan();
    lent_[i] = loans_[i] ? &*loans_[i] : nullptr;
    if (lent_[i] != nullptr) loan_count_ = i + 1;
  }
  request_ = {.name = name(),
              .device = std::string(text_view(set.device)),
              .format = {.width = set.width,
                         .height = set.height,
                         .format = set.format,
                         .frame_rate = set.frame_rate},
              .controls = std::string(text_view(runtime.controls)),
              .buffers = {lent_.data(), set.user_pointers ? loan_count_ : 0},
              .room = frames.elements()};
  silence_ = duration_of(set.silence);
  reports_.connect(nullptr, &report_slot_.control());
  wishes_.connect(nullptr, &wishes_slot_.control());
  wished_ = runtime.controls;
  wishes_.publish({.controls = wished_}, Time{});
  begin_session();
  // What is not there may come, and who uses it may end; the rest is for a person to mend.
  const StatusCode code = trouble_.code();
  if (kept_ == nullptr && code != StatusCode::unavailable && code != StatusCode::busy) {
    V4l2Camera::stop();
    return trouble_;
  }
  const Status status = keeper_.begin<V4l2Camera, &V4l2Camera::keep>(name(), *this);
  if (!status) V4l2Camera::stop();
  return status;
}

void V4l2Camera::stop() {
  keeper_.end();
  session_ = nullptr;
  image_.reset();
  shown_.reset();
  given_.store(nullptr);
  returned_.store(false);
  heard_.store(0);
  kept_.reset();
  // Only now has the kernel let go of them.
  for (Loan<CameraFrame>& loan : loans_) loan.discard();
  lent_ = {};
  loan_count_ = 0;
  for (int* descriptor : {&events_, &news_}) {
    if (*descriptor >= 0) close(*descriptor);
    *descriptor = -1;
  }
}

/// Against what the camera offered when it was last there; one that never was is asked when it comes.
Status V4l2Camera::accept(const CameraRuntime& proposed) {
  const std::string_view text = text_view(proposed.controls);
  if (feedback.controls[0].name[0] != '\0') return check_settings(feedback.controls, text);
  return CameraSettings::parse(text).status();
}

void V4l2Camera::receive(const Tick& tick) noexcept {
  const Time now = tick.now;
  if (runtime.controls != wished_) {
    wished_ = runtime.controls;
    wishes_.publish({.controls = wished_}, now);
  }
  follow_keeper(now);
  if (session_ != nullptr && give_back_shown() < 0)
    lose(video_error(-ENODEV, request_.device.c_str(), "take a buffer"));
  for (int taken = 0; taken < most_per_cycle && take_picture(now); ++taken) {
  }
  if (session_ != nullptr && nanoseconds(now) - heard_.load(std::memory_order_relaxed) >= silence_.count()) {
    lose(Status::error(StatusCode::timeout,
                       "the camera %s is there and gives no pictures; it is begun anew until it does",
                       request_.device.c_str()));
  }
  journal_.fill(feedback);
}

void V4l2Camera::follow_keeper(Time now) noexcept {
  if (rung_.exchange(false, std::memory_order_relaxed)) {
    std::uint64_t count = 0;
    static_cast<void>(!read(news_, &count, sizeof(count)));  // empty when another cycle was quicker
  }
  read_report();
  if (session_ != nullptr) return;
  session_ = given_.exchange(nullptr, std::memory_order_acquire);
  if (session_ == nullptr) return;
  watch(events_, session_->descriptor());
  journal_.begin_stream();
  feedback.frame_rate = session_->format().frame_rate;
  const double rate = feedback.frame_rate > 0 ? feedback.frame_rate : configuration.frame_rate;
  clock_.begin({.period = duration_of(1 / rate),
                .exposure = duration_of(configuration.exposure_time),
                .readout = duration_of(configuration.readout_time),
                .rolling = configuration.rolling_shutter},
               session_->began());
  told_clock_ = "";
  heard_.store(nanoseconds(now), std::memory_order_relaxed);
}

void V4l2Camera::read_report() noexcept {
  const ItemHeader* const header = report_reader_.newest();
  if (header == nullptr || header->sequence == report_seen_) return;
  report_seen_ = header->sequence;
  const auto& report = *static_cast<const CameraReport*>(report_reader_.payload());
  feedback.controls = report.controls;
  if (report.streams) {
    journal_.note_trouble(text_view(report.trouble));
  } else {
    journal_.note_away(text_view(report.trouble));
  }
}

bool V4l2Camera::take_picture(Time now) noexcept {
  if (session_ == nullptr) return false;
  VideoPicture picture;
  int result = session_->take(picture);
  if (result == 0) {
    clock_.note_none(now);
    return false;
  }
  if (result > 0) {
    heard_.store(nanoseconds(now), std::memory_order_relaxed);
    if (picture.damage == nullptr) {
      const std::uint64_t sequence = journal_.note_whole(picture.sequence);
      result = pass_on(picture, time_of(picture.stamp), sequence);
    } else {
      journal_.note_damaged(picture.sequence, picture.damage);
      result = session_->give(picture.index);
    }
  }
  if (result >= 0) return true;
  lose(result == -ENODEV
           ? Status::error(StatusCode::unavailable,
                           "the camera %s went away; it is looked for until it is back",
                           request_.device.c_str())
           : Status::error(StatusCode::device_fault, "the camera %s failed (%s); it is begun anew",
                           request_.device.c_str(), std::strerror(-result)));
  return false;
}

/// By the clock as it is now: a picture may have come since the cycle began.
Time V4l2Camera::time_of(const PictureStamp& stamp) noexcept {
  const Time at = clock_.exposed_at(stamp, MonotonicClock::now());
  const char* const clock = words_for(clock_.source());
  if (clock_.source() == StampSource::arrival) ++feedback.stamped_on_arrival;
  if (text_view(feedback.clock) != clock) set_text(feedback.clock, clock);
  if (clock_.source() == StampSource::arrival && *told_clock_ == '\0') {
    told_clock_ = clock;
    log_warning(
        name(),
        "pictures are stamped on arrival: the stamps of the kernel's driver are {}, and times may be off "
        "by what the way to this machine takes",
        StaticText{stamp.source == StampSource::arrival ? "not by CLOCK_MONOTONIC"
                                                        : "ahead of now, or too old"});
  }
  return at;
}

int V4l2Camera::pass_on(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept {
  if (!frames.is_connected()) return show(picture, at, sequence);
  if (session_->has_user_pointers()) return publish_filled(picture, at, sequence);
  return publish_copy(picture, at, sequence);
}

int V4l2Camera::publish_filled(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept {
  CameraFrame* const frame = session_->filled(picture.index);
  for (std::size_t i = 0; i < loan_count_; ++i) {
    if (lent_[i] != frame) continue;
    describe(*frame, picture, at, sequence);
    lent_[i] = nullptr;
    loans_[i].publish(at);
  }
  return borrow();
}

int V4l2Camera::publish_copy(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept {
  if (lent_[0] != nullptr) {
    std::memcpy(lent_[0]->data().data(), session_->mapped(picture.index).data(), picture.bytes);
    feedback.copied_bytes += picture.bytes;
    describe(*lent_[0], picture, at, sequence);
    lent_[0] = nullptr;
    loans_[0].publish(at);
  }
  const int borrowed = borrow();
  const int given = session_->give(picture.index);
  return borrowed < 0 ? borrowed : given;
}

int V4l2Camera::show(const VideoPicture& picture, Time at, std::uint64_t sequence) noexcept {
  const int given = give_back_shown();
  shown_ = picture.index;
  const VideoFormat& format = session_->format();
  image_ = CameraImage{.data = session_->mapped(picture.index).first(picture.bytes),
                       .width = format.width,
                       .height = format.height,
                       .stride = format.stride,
                       .format = format.format,
                       .time = at,
                       .sequence = sequence};
  return given;
}

void V4l2Camera::describe(CameraFrame& frame, const VideoPicture& picture, Time at,
                          std::uint64_t sequence) const noexcept {
  const VideoFormat& format = session_->format();
  frame.width = format.width;
  frame.height = format.height;
  frame.stride = format.stride;
  frame.size = picture.bytes;
  frame.format = format.format;
  frame.time = nanoseconds(at);
  frame.sequence = sequence;
}

/// In place of what was published, for the kernel to fill.
int V4l2Camera::borrow() noexcept {
  int result = 0;
  for (std::size_t i = 0; i < loan_count_; ++i) {
    if (lent_[i] != nullptr) continue;
    loans_[i] = frames.loan();
    if (!loans_[i]) continue;
    lent_[i] = &*loans_[i];
    const int given = session_->has_user_pointers() ? session_->give(*lent_[i]) : 0;
    if (given < 0) result = given;
  }
  return result;
}

int V4l2Camera::give_back_shown() noexcept {
  image_.reset();
  if (!shown_) return 0;
  const std::uint32_t index = *shown_;
  shown_.reset();
  return session_->give(index);
}

/// To the keeper, which closes it and looks for the camera again; what is lent stays lent.
void V4l2Camera::lose(const Status& why) noexcept {
  image_.reset();
  shown_.reset();
  journal_.note_away(why.cause());
  epoll_ctl(events_, EPOLL_CTL_DEL, session_->descriptor(), nullptr);
  session_ = nullptr;
  heard_.store(0, std::memory_order_relaxed);
  returned_.store(true, std::memory_order_release);
}

}  // namespace flexrf
