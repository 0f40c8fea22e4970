#include "runtime/blackboard/item.hpp"

#include "runtime/core/digest.hpp"

namespace flexrf {

std::uint64_t digest_of_item(std::uint64_t so_far, const TypeDescriptor& type, const ItemHeader& header,
                             const void* value) noexcept {
  Digest digest{so_far};
  digest.add(header.sequence);
  digest.add(static_cast<std::uint64_t>(nanoseconds(header.sampled_at)));
  digest.add_fields(type, value);
  return digest.value();
}

const char* name_of(NullReason reason) noexcept {
  switch (reason) {
    case NullReason::none:
      return "none";
    case NullReason::nothing_yet:
      return "nothing yet";
    case NullReason::too_old:
      return "too old";
    case NullReason::writer_stopped:
      return "writer stopped";
    case NullReason::writer_faulted:
      return "writer in fault";
    case NullReason::writer_retired:
      return "writer retired";
    case NullReason::not_registered:
      return "not registered";
    case NullReason::wrong_type:
      return "wrong type";
    case NullReason::no_longer_kept:
      return "no longer kept";
    case NullReason::driver_not_chosen:
      return "driver not chosen";
    case NullReason::ahead_of_time:
      return "stamped ahead of time";
    case NullReason::not_available:
      return "not available";
  }
  return "unknown";
}

}  // namespace flexrf
