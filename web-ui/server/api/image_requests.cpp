#include "web-ui/server/api/image_requests.hpp"

#include <algorithm>

namespace flexrf::panel {

void ImageRequests::ask(const Caller& caller, std::uint16_t slot, std::uint32_t width, Time now) {
  const auto place = std::find_if(waiting_.begin(), waiting_.end(), [](const Waiting& waiting) {
    return waiting.caller.kind == Caller::Kind::nobody;
  });
  if (place == waiting_.end())
    return answers_->refuse(caller,
                            Refusal::make(RefusalKind::busy, "Too many pictures are asked for at a time."));
  // The look that is under way may have begun before.
  *place = {caller, slot, images_->newest(slot).version, now + patience_};
  ++count_;
  images_->demand_once(slot, width);
}

void ImageRequests::tick(Time now) {
  if (count_ == 0) return;
  for (Waiting& waiting : waiting_) {
    if (waiting.caller.kind == Caller::Kind::nobody) continue;
    ImageWorker::Newest newest = images_->newest(waiting.slot);
    const bool overdue = now >= waiting.overdue_at;
    if (newest.version == waiting.version && !overdue) continue;
    const Caller caller = waiting.caller;
    waiting.caller = {};
    --count_;
    const char* cause = "nobody encodes it";
    std::string* const text = answers_->begin_bytes(caller);
    if (text == nullptr) continue;
    if (newest.version != waiting.version && images_->copy(waiting.slot, *text, newest, cause)) {
      answers_->end_bytes(caller, "image/jpeg");
    } else {
      answers_->refuse(caller, Refusal::make(RefusalKind::wrong_state, "There is no picture: %s.", cause));
    }
  }
}

}  // namespace flexrf::panel
