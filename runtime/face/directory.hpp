// What the application consists of, by name: components, slots, queues, threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/face/refusal.hpp"

namespace flexrf {

struct ComponentEntry {
  const char* name;
  const ComponentType* type;    ///< with ranges as the application narrows them
  std::uint16_t runtime_slot;   ///< in Application::slots, or no_index
  std::uint16_t feedback_slot;  ///< likewise
};

/// Made once, when everything is constructed; any thread reads it. Looking up allocates nothing.
class Directory {
 public:
  explicit Directory(const Cell& cell);

  std::optional<ComponentIndex> component(std::string_view name) const noexcept {
    return find(component_names_, name);
  }
  std::optional<std::uint16_t> slot(std::string_view name) const noexcept { return find(slot_names_, name); }
  /// Why there is no such component (slot), with the name that may have been meant.
  Refusal no_component(std::string_view name) const noexcept;
  Refusal no_slot(std::string_view name) const noexcept;

  const ComponentEntry& entry(ComponentIndex component) const noexcept { return components_[component]; }
  ComponentIndex component_count() const noexcept { return static_cast<ComponentIndex>(components_.size()); }

 private:
  using Names = std::unordered_map<std::string_view, std::uint16_t>;
  static std::optional<std::uint16_t> find(const Names& names, std::string_view name) noexcept;
  static Refusal unknown(const char* what, const Names& names, std::string_view name) noexcept;

  std::vector<ComponentEntry> components_;
  Names component_names_;
  Names slot_names_;
};

}  // namespace flexrf
