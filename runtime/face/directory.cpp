#include "runtime/face/directory.hpp"

#include "base/nearest_name.hpp"
#include "runtime/face/slot_readers.hpp"

namespace flexrf {
Directory::Directory(const Cell& cell) : application_(&cell.application()) {
  const Application& application = *application_;
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    const ComponentRecord& record = application.component(i);
    components_.push_back({record.name, &record, &cell.component_type(i),
                           index_of(application, record.runtime_slot),
                           index_of(application, record.feedback_slot), cell.driver_name(i)});
  }
  for (const DeviceRecord& device : application.devices) components_[device.index].drivers = device.drivers;
  const auto add = [this](Part part, const auto& records) {
    Names& names = names_[static_cast<std::size_t>(part)];
    for (std::size_t i = 0; i < records.size(); ++i)
      names.emplace(records[i].name, static_cast<std::uint16_t>(i));
  };
  add(Part::component, components_);
  add(Part::slot, application.slots);
  add(Part::queue, application.queues);
  add(Part::thread, application.threads);
}

std::optional<std::uint16_t> Directory::find(Part part, std::string_view name) const noexcept {
  const Names& names = names_[static_cast<std::size_t>(part)];
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional{found->second};
}

Refusal Directory::unknown(Part part, std::string_view name) const noexcept {
  static constexpr const char* words[] = {"unit or device", "slot", "queue", "thread"};
  NearestName nearest(name);
  for (const auto& [known, index] : names_[static_cast<std::size_t>(part)]) nearest.offer(known);
  return no_such(words[static_cast<std::size_t>(part)], name, nearest.best(),
                 "descriptor.json has the names");
}

}  // namespace flexrf
