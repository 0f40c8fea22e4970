// Whether all fits into the application's memory_budget.
#include <algorithm>
#include <array>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/memory.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

void check_memory(const Model& model, Diagnostics& diagnostics) {
  if (!model.application->memory_budget) return;
  const std::size_t budget = *model.application->memory_budget;
  std::vector<MemoryItem> items = memory_map(model);
  const std::size_t needed = total(items);
  if (needed <= budget) return;
  constexpr std::array<const char*, 6> kinds{
      "slot", "history of slot", "queue", "stack of thread", "a driver's helper thread of", "parameters of"};
  std::stable_sort(items.begin(), items.end(),
                   [](const MemoryItem& a, const MemoryItem& b) { return a.bytes > b.bytes; });
  constexpr std::size_t most_shown = 4;
  std::vector<std::string> biggest;
  for (std::size_t i = 0; i < std::min(most_shown, items.size()) && items[i].bytes * 50 >= needed; ++i)
    biggest.push_back(std::string(kinds[static_cast<std::size_t>(items[i].kind)]) + " " +
                      quote(items[i].name) + " " + size_text(items[i].bytes) + " (" + items[i].account + ")");
  diagnostics.error(
      model.application->memory_budget_position,
      "the application needs " + size_text(needed) + ", more than its memory_budget of " + size_text(budget),
      "raise the budget, or make something smaller; the biggest are " + join(biggest, ", "));
}

}  // namespace flexrf::config_gen
