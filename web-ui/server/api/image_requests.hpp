// Pictures asked for by REST: each waits until the worker has looked at its slot.
#pragma once

#include <cstdint>

#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/image_worker.hpp"
#include "web-ui/server/api/places.hpp"

namespace flexrf::panel {

/// The server's thread.
class ImageRequests {
 public:
  ImageRequests(ImageWorker& images, Answers& answers, Duration patience) noexcept
      : images_(&images), answers_(&answers), patience_(patience) {}

  /// Answers `caller` when that much patience has run out at the latest.
  void ask(const Caller& caller, std::uint16_t slot, std::uint32_t width, Time now);
  void tick(Time now);

 private:
  struct Waiting {
    Caller caller;
    std::uint16_t slot = 0;
    std::uint64_t version = 0;  // that is too old
    Time overdue_at{};
  };

  void answer(const Waiting& waiting);

  ImageWorker* images_;
  Answers* answers_;
  Duration patience_;
  Places<Waiting, 16> waiting_;
};

}  // namespace flexrf::panel
