// The lists of components, slots, queues, threads and devices with their counters, and of the threads' steps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json_writer.hpp"
#include "runtime/face/statistics.hpp"
#include "web-ui/server/api/clients.hpp"

namespace flexrf::panel {

/// The server's thread. Each list is made at most ten times a second, for all who want it.
class TopicBodies {
 public:
  static constexpr Duration shortest_interval = std::chrono::milliseconds{100};
  static constexpr Duration traced_for = std::chrono::seconds{3};
  static constexpr Duration told_for = std::chrono::seconds{5};  ///< steps that ended earlier are not told
  static constexpr std::size_t most_steps = 4096;                ///< of all threads together

  /// When everything is constructed, and nothing runs.
  explicit TopicBodies(Cell& cell);

  /// Not for the log. Made anew when it is older than shortest_interval. Who wants the steps has them noted
  /// from then on, for `traced_for`.
  std::string_view body(Topic topic, Time now);
  /// Bytes that a copy of it should have room for: its numbers grow.
  std::size_t room(Topic topic) const noexcept {
    return bodies_[static_cast<std::size_t>(topic)].text.capacity();
  }
  /// Rises with each change of what body() gives.
  std::uint64_t version(Topic topic) const noexcept {
    return bodies_[static_cast<std::size_t>(topic)].version;
  }
  /// One entry of the list of components.
  void write_component(JsonWriter& json, ComponentIndex component) const;
  void write_devices(JsonWriter& json) const;
  const Statistics& statistics() const noexcept { return statistics_; }

 private:
  struct Body {
    std::string text;
    std::string former;
    Time made_at{};
    std::uint64_t version = 0;
  };
  struct KernelFigures {
    int cpu = -1;
    std::uint64_t minor_faults = 0;
    std::uint64_t major_faults = 0;
  };

  void write(JsonWriter& json, Topic topic, Time now);
  void write_slots(JsonWriter& json) const;
  void write_queues(JsonWriter& json) const;
  void write_threads(JsonWriter& json, Time now);
  void write_steps(JsonWriter& json, Time now);
  std::size_t room_to_grow(Topic topic) const noexcept;

  Cell* cell_;
  Statistics statistics_;
  std::array<Body, topic_count> bodies_;
  std::vector<std::optional<Duration>> response_estimates_;  // per thread
  std::vector<KernelFigures> figures_;                       // per thread, looked up once a second
  Time figures_at_{};
  std::size_t room_of_scores_ = 0;  // bytes that those of all queues take at most
  std::vector<TracedStep> steps_;   // of one thread
};

const char* name_of(Topic topic) noexcept;

}  // namespace flexrf::panel
