// What the application consists of, by name: components, slots, queues, threads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/face/refusal.hpp"

namespace flexrf {

struct ComponentEntry {
  const char* name;
  const ComponentRecord* record;
  const ComponentType* type;                   ///< with ranges as the application narrows them
  std::uint16_t runtime_slot;                  ///< in Application::slots, or no_index
  std::uint16_t feedback_slot;                 ///< likewise
  const char* driver = "";                     ///< that was chosen; of a unit ""
  std::span<const DriverRecord> drivers = {};  ///< that the device's row permits; of a unit none
};

/// What has names of its own: a slot and a thread may share one.
enum class Part : std::uint8_t { component, slot, queue, thread };

/// Made once, when everything is constructed; any thread reads it. Looking up allocates nothing.
class Directory {
 public:
  explicit Directory(const Cell& cell);

  /// Its index in its table, of a component its number.
  std::optional<std::uint16_t> find(Part part, std::string_view name) const noexcept;
  /// Why there is none, with the name that may have been meant.
  Refusal unknown(Part part, std::string_view name) const noexcept;

  std::optional<ComponentIndex> component(std::string_view name) const noexcept {
    return find(Part::component, name);
  }
  std::optional<std::uint16_t> slot(std::string_view name) const noexcept { return find(Part::slot, name); }
  Refusal no_component(std::string_view name) const noexcept { return unknown(Part::component, name); }
  Refusal no_slot(std::string_view name) const noexcept { return unknown(Part::slot, name); }

  std::size_t count(Part part) const noexcept { return names_[static_cast<std::size_t>(part)].size(); }
  // All there is of a kind, in the order of its table; Statistics has the figures.
  std::span<const SlotRecord> slots() const noexcept { return application_->slots; }
  std::span<const QueueRecord> queues() const noexcept { return application_->queues; }
  std::span<const ThreadRecord> threads() const noexcept { return application_->threads; }

  const ComponentEntry& entry(ComponentIndex component) const noexcept { return components_[component]; }
  ComponentIndex component_count() const noexcept { return static_cast<ComponentIndex>(components_.size()); }

 private:
  using Names = std::unordered_map<std::string_view, std::uint16_t>;

  const Application* application_;
  std::vector<ComponentEntry> components_;
  std::array<Names, 4> names_;  // of each Part
};

}  // namespace flexrf
