#include "runtime/face/component_values.hpp"

#include "runtime/core/value_json.hpp"

namespace flexrf {

std::uint64_t ComponentValues::sequence(ComponentIndex component) {
  const std::uint16_t slot = directory_->entry(component).runtime_slot;
  return slot == no_index ? 0 : slots_->read(slot).header.sequence;
}

void ComponentValues::write_slot(JsonWriter& json, std::uint16_t slot, const TypeDescriptor* type) {
  if (slot == no_index || type == nullptr) {
    json.begin_object().end_object();
    return;
  }
  const ObservedSlot& newest = slots_->read(slot);
  if (newest.value == nullptr) {
    json.null();
  } else {
    write_value(json, *type, newest.value);
  }
}

void ComponentValues::write_runtime(JsonWriter& json, ComponentIndex component) {
  const ComponentEntry& entry = directory_->entry(component);
  write_slot(json, entry.runtime_slot, entry.type->runtime.type);
}

void ComponentValues::write_feedback(JsonWriter& json, ComponentIndex component) {
  const ComponentEntry& entry = directory_->entry(component);
  write_slot(json, entry.feedback_slot, entry.type->feedback.type);
}

void ComponentValues::write_configuration(JsonWriter& json, ComponentIndex component) {
  const TypeDescriptor* const type = directory_->entry(component).type->configuration.type;
  if (type != nullptr && bytes_.size() < type->size) bytes_.resize(type->size);
  if (type == nullptr || cell_->copy_configuration(component, bytes_.data(), type->size) == 0) {
    json.begin_object().end_object();
  } else {
    write_value(json, *type, bytes_.data());
  }
}

void ComponentValues::write_all(JsonWriter& json, ComponentIndex component) {
  json.member("sequence", sequence(component));
  json.key("configuration");
  write_configuration(json, component);
  json.key("runtime");
  write_runtime(json, component);
  json.key("feedback");
  write_feedback(json, component);
}

}  // namespace flexrf
