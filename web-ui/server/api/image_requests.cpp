#include "web-ui/server/api/image_requests.hpp"

namespace flexrf::panel {

void ImageRequests::ask(const Caller& caller, std::uint16_t slot, std::uint32_t width, Time now) {
  // The look that is under way may have begun before.
  if (!waiting_.add({caller, slot, images_->newest(slot).version, now + patience_}))
    return answers_->refuse(caller, RefusalKind::busy, "Too many pictures are asked for at a time.");
  images_->demand_once(slot, width);
}

void ImageRequests::tick(Time now) {
  waiting_.take(
      [&](const Waiting& one) {
        return now >= one.overdue_at || images_->newest(one.slot).version != one.version;
      },
      [this](const Waiting& waiting) { answer(waiting); });
}

void ImageRequests::answer(const Waiting& waiting) {
  ImageWorker::Newest newest = images_->newest(waiting.slot);
  const char* cause = "nobody encodes it";
  std::string* const text = answers_->begin_bytes(waiting.caller);
  if (text == nullptr) return;
  if (newest.version != waiting.version && images_->copy(waiting.slot, *text, newest, cause)) {
    answers_->end_bytes(waiting.caller, "image/jpeg");
  } else {
    answers_->refuse(waiting.caller, RefusalKind::wrong_state, "There is no picture: %s.", cause);
  }
}

}  // namespace flexrf::panel
