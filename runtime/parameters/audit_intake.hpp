// What people did, on its way from whoever saw it happen to the thread that writes it down.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/time.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/parameters/intake.hpp"

namespace flexrf {

/// A person as the audit names him: "ann (192.168.0.7)", "remote control (connection 3)"; cut, not longer.
inline constexpr std::size_t longest_who = 64;

inline constexpr std::uint16_t no_component = 0xFFFF;

struct AuditRecord {
  enum class Kind : std::uint8_t {
    act,         ///< in words: `did` and `what`
    stop,        ///< likewise, and motion is stopped by it
    clear,       ///< likewise, and the stop is cleared
    change,      ///< a parameter had the value `before` and has `after`
    press,       ///< of a button, `number` times
    hold_begin,  ///< under the lease `number`
    hold_end,    ///< of that lease; `did` says why
  };
  /// Bytes of a value; what is larger is told in pieces of whole elements, or of its members.
  static constexpr std::size_t value_capacity = 64;

  Kind kind = Kind::act;
  ParameterKind block = ParameterKind::runtime;  ///< of a change
  std::uint16_t component = no_component;
  std::uint16_t size = 0;    ///< bytes of the values
  std::uint32_t offset = 0;  ///< of a parameter, element or member, in bytes from the start of its struct
  std::uint64_t number = 0;
  Time at{};
  const char* did = "";  ///< lives for ever
  char who[longest_who] = {};
  char what[160] = {};
  std::byte before[value_capacity]{};
  std::byte after[value_capacity]{};
};

/// All functions: any thread, none waits or allocates, but those that say otherwise.
class AuditIntake {
 public:
  static constexpr std::uint32_t capacity = 256;

  /// From now on there is somebody who takes; until then nothing is kept.
  void open() noexcept { open_.store(true, std::memory_order_release); }
  bool is_open() const noexcept { return open_.load(std::memory_order_acquire); }

  /// `who` empty: no person did it, nothing is kept. A full intake drops it and counts it.
  void put(const AuditRecord& record) noexcept;
  /// An act in words: `did` lives for ever, `what` is cut at 160 bytes.
  void note(std::string_view who, const char* did, std::string_view what = {},
            AuditRecord::Kind kind = AuditRecord::Kind::act) noexcept;
  /// The parameters whose values differ between two structs of this block.
  void note_differences(std::string_view who, std::uint16_t component, ParameterKind kind,
                        const ParameterBlock& block, const void* before, const void* after, Time at) noexcept;

  /// Copies the oldest out; false when there is none. One thread.
  bool take(AuditRecord& record) noexcept { return intake_.take(record); }
  std::uint64_t dropped() const noexcept { return intake_.refused(); }

 private:
  std::atomic<bool> open_{false};
  Intake<AuditRecord, capacity> intake_;
};

}  // namespace flexrf
