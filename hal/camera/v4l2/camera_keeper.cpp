// The keeper of V4l2Camera: the thread that may wait for the camera.
#include <unistd.h>

#include "hal/camera/v4l2/v4l2_camera.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// How soon a camera that was lost is looked for, and how often.
constexpr std::chrono::milliseconds keeping_interval{50};

}  // namespace

/// A camera that is lost says so by a word of its own: a cycle must not wait to wake somebody.
void V4l2Camera::keep() {
  while (keeper_.wait(keeping_interval)) look_after();
}

void V4l2Camera::look_after() {
  if (returned_.exchange(false, std::memory_order_acquire)) {
    kept_.reset();
    trouble_ = {};
  }
  heed_wishes();
  if (kept_ == nullptr) begin_session();
  // Nothing wakes the camera's thread while it is silent.
  const std::int64_t heard = heard_.load(std::memory_order_relaxed);
  if (heard != 0 && nanoseconds(MonotonicClock::now()) - heard >= silence_.count()) ring();
}

void V4l2Camera::begin_session() {
  Result<std::unique_ptr<VideoSession>> session = VideoSession::begin(*calls_, request_);
  if (!session) {
    // Each reason once, however often it is tried.
    if (session.status().code() != trouble_.code()) tell(session.status());
    return;
  }
  kept_ = std::move(*session);
  tell(kept_->trouble());
  given_.store(kept_.get(), std::memory_order_release);
  ring();
}

void V4l2Camera::heed_wishes() {
  const ItemHeader* const header = wishes_reader_.newest();
  if (header == nullptr || header->sequence == wish_seen_) return;
  wish_seen_ = header->sequence;
  request_.controls = text_view(static_cast<const CameraWishes*>(wishes_reader_.payload())->controls);
  if (kept_ != nullptr) tell(kept_->set_controls(request_.controls));
}

void V4l2Camera::tell(const Status& trouble) {
  trouble_ = trouble;
  CameraReport report{};
  report.streams = kept_ != nullptr;
  set_text(report.trouble, trouble.cause());
  if (kept_ != nullptr) {
    const std::span<const CameraControl> found = kept_->device().controls();
    std::copy(found.begin(), found.end(), report.controls.begin());
    if (!trouble.is_ok()) log_warning(name(), "{}", std::string_view(trouble.cause()));
  }
  reports_.publish(report, Time{});
  ring();
}

void V4l2Camera::ring() noexcept {
  constexpr std::uint64_t one = 1;
  // Before, for whom the writing wakes at once, who else would be woken again and again while this thread
  // waits for its CPU; and after, for whom looked between the two.
  rung_.store(true, std::memory_order_release);
  static_cast<void>(!write(news_, &one, sizeof(one)));  // one that counts already is as good
  rung_.store(true, std::memory_order_release);
}

}  // namespace flexrf
