#include "runtime/face/directory.hpp"

#include "runtime/core/nearest_name.hpp"

namespace flexrf {
namespace {

std::uint16_t index_of(const Application& application, const SlotControl* control) noexcept {
  if (control == nullptr) return no_index;
  for (std::size_t i = 0; i < application.slots.size(); ++i) {
    if (application.slots[i].control == control) return static_cast<std::uint16_t>(i);
  }
  return no_index;
}

}  // namespace

Directory::Directory(const Cell& cell) {
  const Application& application = cell.application();
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    const ComponentRecord& record = application.component(i);
    components_.push_back({record.name, &cell.component_type(i), index_of(application, record.runtime_slot),
                           index_of(application, record.feedback_slot)});
  }
  for (std::size_t i = 0; i < components_.size(); ++i)
    component_names_.emplace(components_[i].name, static_cast<std::uint16_t>(i));
  for (std::size_t i = 0; i < application.slots.size(); ++i)
    slot_names_.emplace(application.slots[i].name, static_cast<std::uint16_t>(i));
}

std::optional<std::uint16_t> Directory::find(const Names& names, std::string_view name) noexcept {
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional{found->second};
}

Refusal Directory::unknown(const char* what, const Names& names, std::string_view name) noexcept {
  NearestName nearest(name);
  for (const auto& [known, index] : names) nearest.offer(known);
  return no_such(what, name, nearest.best(), "descriptor.json has the names");
}

Refusal Directory::no_component(std::string_view name) const noexcept {
  return unknown("unit or device", component_names_, name);
}

Refusal Directory::no_slot(std::string_view name) const noexcept {
  return unknown("slot", slot_names_, name);
}

}  // namespace flexrf
