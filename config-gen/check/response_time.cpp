#include "config-gen/check/response_time.hpp"

namespace flexrf::config_gen {

std::optional<std::int64_t> response_time(const std::vector<Task>& tasks, std::size_t index,
                                          std::int64_t limit) {
  // Where the load is close to the whole CPU each round adds little: what takes longer has no bound that
  // helps.
  constexpr std::size_t most_rounds = 10'000;
  const Task& own = tasks[index];
  std::int64_t response = own.demand;
  for (std::size_t round = 0; round < most_rounds && response + own.jitter <= limit; ++round) {
    std::int64_t next = own.demand;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (i == index || tasks[i].priority < own.priority) continue;
      const std::int64_t releases = (response + tasks[i].jitter + tasks[i].interval - 1) / tasks[i].interval;
      if (tasks[i].demand > 0 && releases > (limit + own.demand) / tasks[i].demand + 1) return std::nullopt;
      next += releases * tasks[i].demand;
      if (next > limit) return std::nullopt;
    }
    if (next == response) return response + own.jitter;
    response = next;
  }
  return std::nullopt;
}

}  // namespace flexrf::config_gen
