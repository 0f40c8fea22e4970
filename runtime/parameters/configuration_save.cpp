// Saving the configuration file.
#include <algorithm>
#include <cstring>
#include <map>
#include <string_view>

#include "base/quantity_text.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/configuration_document.hpp"
#include "runtime/parameters/configuration_file.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

/// Former sections, by the component's name; those of one component in their order.
using FormerSections = std::multimap<std::string_view, pugi::xml_node>;

bool is_any_marked(const FieldDescriptor& field, std::size_t offset, const SetMarks& marks) {
  return marks.any(offset + field.offset, field_size(field));
}

/// What is marked below the field. `offset`: bytes of the structure that it lies in, within the outermost.
void write_field(pugi::xml_node parent, const FieldDescriptor& field, const std::byte* values,
                 std::size_t offset, const SetMarks& marks) {
  if (!is_any_marked(field, offset, marks)) return;
  if (field.scalar != Scalar::structure) {
    pugi::xml_node node = parent.append_child(field.name);
    if (field.unit[0] != '\0' && std::strcmp(field.unit, "1") != 0)
      node.append_attribute("unit").set_value(field.unit);
    node.text().set(text_of(whole(field), values + offset).c_str());
    return;
  }
  for (std::uint32_t element = 0; element < field.count; ++element) {
    const std::size_t at = offset + field.offset + element * element_size(field);
    if (!marks.any(at, element_size(field))) continue;
    pugi::xml_node node = parent.append_child(field.name);
    if (field.dimensions > 0) node.append_attribute("index").set_value(element);
    for (const FieldDescriptor& member : field.type->fields) write_field(node, member, values, at, marks);
  }
}

void write_block(pugi::xml_node component, const char* section, const ParameterBlock& block,
                 const void* values, const SetMarks* marks) {
  if (block.type == nullptr || values == nullptr || marks == nullptr) return;
  const bool is_runtime = std::strcmp(section, "runtime") == 0;
  pugi::xml_node node;
  for (const ParameterDescriptor& parameter : block.parameters) {
    const Scalar scalar = parameter.field->scalar;
    if (is_runtime && (!parameter.persist || scalar == Scalar::button || scalar == Scalar::hold)) continue;
    if (!is_any_marked(*parameter.field, 0, *marks)) continue;
    if (!node) node = component.append_child(section);
    write_field(node, *parameter.field, static_cast<const std::byte*>(values), 0, *marks);
  }
}

void write_component(pugi::xml_node root, const ConfigurationComponent& component,
                     const FormerSections& former) {
  pugi::xml_node node = root.append_child(component.kind);
  node.append_attribute("name").set_value(component.name);
  if (component.driver[0] != '\0') node.append_attribute("driver").set_value(component.driver);
  write_block(node, "configuration", component.type->configuration, component.configuration,
              component.configuration_marks);
  write_block(node, "runtime", component.type->runtime, component.runtime, component.runtime_marks);
  if (!node.first_child()) root.remove_child(node);
  // What was saved with another of its drivers stays.
  const auto [begin, end] = former.equal_range(component.name);
  for (auto section = begin; section != end; ++section) {
    const char* driver = section->second.attribute("driver").value();
    const auto is_this = [driver](const char* other) { return std::strcmp(other, driver) == 0; };
    if (std::any_of(component.other_drivers.begin(), component.other_drivers.end(), is_this))
      root.append_copy(section->second);
  }
}

FormerSections sections_of(pugi::xml_node former) {
  FormerSections sections;
  for (const pugi::xml_node section : former.children())
    sections.emplace(section.attribute("name").value(), section);
  return sections;
}

bool is_anything_set(std::span<const ConfigurationComponent> components) {
  const auto has_any = [](const SetMarks* marks) { return marks != nullptr && marks->any(0, marks->size()); };
  return std::any_of(components.begin(), components.end(), [&](const ConfigurationComponent& component) {
    return has_any(component.configuration_marks) || has_any(component.runtime_marks);
  });
}

std::string text_of_components(const ConfigurationIdentity& identity,
                               std::span<const ConfigurationComponent> components, pugi::xml_node former) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("utf-8");
  document.append_child(pugi::node_comment)
      .set_value(" Values only, in the units shown. After an edit by hand write checksum=\"edited\" below. ");
  pugi::xml_node root = document.append_child("flexrf");
  root.append_attribute("application").set_value(identity.application);
  root.append_attribute("format").set_value(configuration_format);
  root.append_attribute("descriptor").set_value(hexadecimal_text(identity.descriptor_hash).c_str());
  root.append_attribute("checksum");
  const FormerSections sections = sections_of(former);
  for (const ConfigurationComponent& component : components) write_component(root, component, sections);
  return text_with_checksum(document);
}

}  // namespace

Status save_configuration(const std::string& path, const ConfigurationIdentity& identity,
                          std::span<const ConfigurationComponent> components) {
  const Result<std::string> former = read_file(path);
  if (!former && former.status().code() != StatusCode::not_found) return former.status();
  if (!former && !is_anything_set(components)) return {};
  ConfigurationDocument document;
  const bool is_good = former && document.parse(path, *former);
  const std::string text =
      text_of_components(identity, components, is_good ? document.root() : pugi::xml_node());
  if (former) {
    if (*former == text) return {};
    const Status kept = replace_file(path + (is_good ? ".previous" : ".damaged"), *former);
    if (!kept) return kept;
  }
  return replace_file(path, text);
}

}  // namespace flexrf
