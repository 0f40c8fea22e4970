// How much memory an application takes, item by item: shared by the check of the budget and the memory map.
#pragma once

#include <string>
#include <vector>

#include "config-gen/model/footprint.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

struct MemoryItem {
  enum class Kind { slot, history, queue, stack, helper, parameters };
  Kind kind = Kind::slot;
  std::string name;
  std::size_t bytes = 0;
  std::string account;  // how it comes about: "5 buffers of 64 B"
  Position position;
};

// Control blocks and buffers as config-gen lays them out; units and drivers themselves are sized by the
// compiler and judged there. In the order slots, histories, queues,
// stacks, stacks of drivers' helper threads, parameters.
std::vector<MemoryItem> memory_map(const Model& model);
std::size_t total(const std::vector<MemoryItem>& items);

}  // namespace flexrf::config_gen
