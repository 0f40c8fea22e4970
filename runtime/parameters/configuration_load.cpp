// Loading the configuration file: everything is read and checked beside the values in use, then taken at
// once.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <optional>

#include "runtime/core/nearest_name.hpp"
#include "runtime/parameters/configuration_document.hpp"
#include "runtime/parameters/configuration_file.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/parameters/scalar_types.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

using Kind = ConfigurationComponent::Kind;

// No format before the first has been released.
constexpr std::span<const FormatStep> format_steps;

struct StagedComponent {
  std::vector<std::byte> configuration;
  std::vector<std::byte> runtime;
  bool is_given = false;
};

std::vector<std::byte> copy_of(const ParameterBlock& block, const void* values) {
  if (block.type == nullptr || values == nullptr) return {};
  const auto* bytes = static_cast<const std::byte*>(values);
  return {bytes, bytes + block.type->size};
}

std::string did_you_mean(const NearestName& nearest) {
  if (nearest.best().empty()) return "";
  return "; did you mean '" + std::string(nearest.best()) + "'?";
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

// Reads one document into staged copies.
class Reader {
 public:
  Reader(const ConfigurationDocument& document, const ConfigurationIdentity& identity,
         std::span<const ConfigurationComponent> components)
      : document_(document), identity_(identity), components_(components) {
    for (const ConfigurationComponent& component : components)
      staged_.push_back({copy_of(component.type->configuration, component.configuration),
                         copy_of(component.type->runtime, component.runtime)});
  }

  void read();
  /// Only when there are no problems.
  void take() const;

  std::vector<std::string> problems;
  std::vector<std::string> notices;

 private:
  void read_root(pugi::xml_node root);
  void read_component(pugi::xml_node node);
  void read_block(pugi::xml_node section, std::size_t component);
  void read_parameter(pugi::xml_node node, const ParameterBlock& block, std::size_t component,
                      std::vector<std::byte>& values);
  void read_field(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                  std::byte* structure, const ValueRange* range);
  void read_structure(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                      std::byte* structure);
  std::optional<std::string> text_in(pugi::xml_node node);
  void check_attributes(pugi::xml_node node, std::initializer_list<const char*> known);
  std::string component_renamed(const std::string& name) const;
  std::string parameter_renamed(const char* old_component, const char* component,
                                const char* parameter) const;

  /// In a file for this descriptor everything must fit; of another's, what does not is left out.
  void unfit(pugi::xml_node node, const std::string& what) {
    if (is_ours_)
      problems.push_back(document_.position_of(node) + "error: " + what);
    else
      notices.push_back(document_.position_of(node) + "left out: " + what);
  }

  const ConfigurationDocument& document_;
  const ConfigurationIdentity& identity_;
  std::span<const ConfigurationComponent> components_;
  std::vector<StagedComponent> staged_;
  bool is_ours_ = true;
};

void Reader::read() {
  const pugi::xml_node root = document_.root();
  if (std::strcmp(root.name(), "flexrf") != 0) {
    unfit(root, "the outermost element is <" + std::string(root.name()) + ">, not <flexrf>");
    return;
  }
  if (const Status status = upgrade_format(root, configuration_format, format_steps); !status) {
    unfit(root, status.cause());
    return;
  }
  const char* application = root.attribute("application").value();
  if (application[0] != '\0' && std::strcmp(application, identity_.application) != 0) {
    unfit(root, std::string("this file is of the application '") + application + "', not of '" +
                    identity_.application + "'");
    return;
  }
  read_root(root);
}

void Reader::read_root(pugi::xml_node root) {
  check_attributes(root, {"application", "format", "descriptor", "checksum"});
  const char* descriptor = root.attribute("descriptor").value();
  if (descriptor[0] != '\0') is_ours_ = std::strtoull(descriptor, nullptr, 16) == identity_.descriptor_hash;
  if (!is_ours_)
    notices.push_back(document_.position_of(root) +
                      "written for other tables of this application: values that still fit are taken");
  if (document_.checksum() == ConfigurationDocument::Checksum::edited)
    notices.push_back(document_.position_of(root) + "edited by hand: taken without a checksum");
  for (const pugi::xml_node node : root.children())
    if (node.type() == pugi::node_element) {
      read_component(node);
    } else if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
      unfit(root, "text between the units and devices");
    }
}

std::string Reader::component_renamed(const std::string& name) const {
  for (const Rename& rename : identity_.renames)
    if (name == rename.from) return rename.to;
  return name;
}

std::string Reader::parameter_renamed(const char* old_component, const char* component,
                                      const char* parameter) const {
  const std::string prefix = std::string(component) + ".";
  for (const Rename& rename : identity_.renames) {
    const bool is_this =
        rename.from == std::string(old_component) + "." + parameter || rename.from == prefix + parameter;
    if (is_this && std::string_view(rename.to).substr(0, prefix.size()) == prefix)
      return rename.to + prefix.size();
  }
  return parameter;
}

void Reader::read_component(pugi::xml_node node) {
  const std::string kind = node.name();
  if (kind != "unit" && kind != "device") {
    NearestName nearest(kind);
    nearest.offer("unit");
    nearest.offer("device");
    unfit(node, "<" + kind + "> is neither <unit> nor <device>" + did_you_mean(nearest));
    return;
  }
  check_attributes(node, {"name", "driver"});
  const std::string name = component_renamed(node.attribute("name").value());
  NearestName nearest(name);
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const ConfigurationComponent& component = components_[i];
    if ((component.kind == Kind::unit) != (kind == "unit")) continue;
    nearest.offer(component.name);
    if (name != component.name) continue;
    const std::string driver = node.attribute("driver").value();
    const auto is_this = [&driver](const char* other) { return driver == other; };
    if (!driver.empty() && driver != component.driver) {
      if (!std::any_of(component.other_drivers.begin(), component.other_drivers.end(), is_this)) {
        NearestName drivers(driver);
        drivers.offer(component.driver);
        for (const char* other : component.other_drivers) drivers.offer(other);
        unfit(node, kind + " " + quoted(name) + " has no driver " + quoted(driver) + did_you_mean(drivers));
      }
      return;
    }
    if (staged_[i].is_given) {
      unfit(node, kind + " " + quoted(name) + " is given twice");
      return;
    }
    staged_[i].is_given = true;
    for (const pugi::xml_node section : node.children())
      if (section.type() == pugi::node_element) read_block(section, i);
    return;
  }
  unfit(node, "there is no " + kind + " " + quoted(name) + did_you_mean(nearest));
}

void Reader::read_block(pugi::xml_node section, std::size_t component) {
  const ComponentType& type = *components_[component].type;
  const bool is_configuration = std::strcmp(section.name(), "configuration") == 0;
  if (!is_configuration && std::strcmp(section.name(), "runtime") != 0) {
    NearestName nearest(section.name());
    nearest.offer("configuration");
    nearest.offer("runtime");
    unfit(section, std::string("<") + section.name() + "> is neither <configuration> nor <runtime>" +
                       did_you_mean(nearest));
    return;
  }
  check_attributes(section, {});
  const ParameterBlock& block = is_configuration ? type.configuration : type.runtime;
  std::vector<std::byte>& values =
      is_configuration ? staged_[component].configuration : staged_[component].runtime;
  std::vector<std::string> seen;
  for (const pugi::xml_node node : section.children()) {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
      unfit(section, "text outside of the parameters");
    if (node.type() != pugi::node_element) continue;
    const std::string once = std::string(node.name()) + " " + node.attribute("index").value();
    if (std::find(seen.begin(), seen.end(), once) != seen.end()) {
      unfit(node, quoted(components_[component].name + std::string(".") + node.name()) + " is given twice");
      continue;
    }
    seen.push_back(once);
    read_parameter(node, block, component, values);
  }
}

void Reader::read_parameter(pugi::xml_node node, const ParameterBlock& block, std::size_t component,
                            std::vector<std::byte>& values) {
  const std::string owner = components_[component].name;
  const char* section = node.parent().name();
  const std::string name =
      parameter_renamed(node.parent().parent().attribute("name").value(), owner.c_str(), node.name());
  NearestName nearest(name);
  for (const ParameterDescriptor& parameter : block.parameters) {
    nearest.offer(parameter.field->name);
    if (name != parameter.field->name || values.empty()) continue;
    const Scalar scalar = parameter.field->scalar;
    const bool is_saved = std::strcmp(section, "configuration") == 0 ||
                          (parameter.persist && scalar != Scalar::button && scalar != Scalar::hold);
    if (!is_saved) {
      unfit(node, quoted(owner + "." + name) + " is not kept in files");
      return;
    }
    ValueRange range{};
    read_field(node, *parameter.field, owner + "." + name, values.data(), range_of(parameter, range));
    return;
  }
  unfit(node, quoted(owner) + " has no " + section + " parameter " + quoted(name) + did_you_mean(nearest));
}

void Reader::read_field(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                        std::byte* structure, const ValueRange* range) {
  if (field.scalar == Scalar::structure) {
    read_structure(node, field, path, structure);
    return;
  }
  check_attributes(node, {"unit"});
  const pugi::xml_attribute unit = node.attribute("unit");
  if (unit && std::strcmp(unit.value(), field.unit) != 0) {
    unfit(node, quoted(path) + " is given in '" + unit.value() + "', but its unit of measure is '" +
                    field.unit + "'");
    return;
  }
  const std::optional<std::string> text = text_in(node);
  if (!text) return;
  const Status status = write_text(whole(field), structure, *text, range);
  if (status) return;
  // The cause begins with the field's own name, which the path replaces.
  const std::string cause = status.cause();
  unfit(node, path + cause.substr(std::min(cause.size(), std::strlen(field.name))));
}

void Reader::read_structure(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                            std::byte* structure) {
  std::uint32_t element = 0;
  std::string here = path;
  if (field.dimensions > 0) {
    check_attributes(node, {"index"});
    const char* index = node.attribute("index").value();
    char* end = nullptr;
    const unsigned long number = std::strtoul(index, &end, 10);
    if (index[0] == '\0' || *end != '\0' || number >= field.count) {
      unfit(node, quoted(path) + " wants index=\"0\" to \"" + std::to_string(field.count - 1) + "\"");
      return;
    }
    element = static_cast<std::uint32_t>(number);
    here += "[" + std::string(index) + "]";
  } else {
    check_attributes(node, {});
  }
  std::byte* const at = structure + field.offset + element * element_size(field);
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    NearestName nearest(child.name());
    const FieldDescriptor* member = nullptr;
    for (const FieldDescriptor& candidate : field.type->fields) {
      nearest.offer(candidate.name);
      if (std::strcmp(candidate.name, child.name()) == 0) member = &candidate;
    }
    if (member == nullptr)
      unfit(child, quoted(here) + " has no member " + quoted(child.name()) + did_you_mean(nearest));
    else
      read_field(child, *member, here + "." + child.name(), at, nullptr);
  }
}

std::optional<std::string> Reader::text_in(pugi::xml_node node) {
  std::string text;
  for (const pugi::xml_node part : node.children()) {
    if (part.type() == pugi::node_element) {
      unfit(part, std::string("<") + part.name() + "> within a single value");
      return std::nullopt;
    }
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) text += part.value();
  }
  return text;
}

void Reader::check_attributes(pugi::xml_node node, std::initializer_list<const char*> known) {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    NearestName nearest(attribute.name());
    bool is_known = false;
    for (const char* name : known) {
      nearest.offer(name);
      is_known = is_known || std::strcmp(name, attribute.name()) == 0;
    }
    if (!is_known)
      unfit(node, std::string("<") + node.name() + "> has no attribute '" + attribute.name() + "'" +
                      did_you_mean(nearest));
  }
}

void Reader::take() const {
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const auto copy = [](void* to, const std::vector<std::byte>& from) {
      if (!from.empty()) std::memcpy(to, from.data(), from.size());
    };
    copy(components_[i].configuration, staged_[i].configuration);
    copy(components_[i].runtime, staged_[i].runtime);
  }
}

enum class Outcome : std::uint8_t { absent, unreadable, damaged, unfit, taken };

Outcome try_file(const std::string& path, const ConfigurationIdentity& identity,
                 std::span<const ConfigurationComponent> components, ConfigurationReport& report) {
  Result<std::string> text = read_file(path);
  if (!text) {
    if (text.status().code() == StatusCode::not_found) return Outcome::absent;
    report.problems.push_back(path + ": error: " + text.status().cause());
    return Outcome::unreadable;
  }
  ConfigurationDocument document;
  if (!document.parse(path, std::move(*text))) {
    report.problems.push_back(document.damage());
    return Outcome::damaged;
  }
  Reader reader(document, identity, components);
  reader.read();
  report.problems.insert(report.problems.end(), reader.problems.begin(), reader.problems.end());
  report.notices.insert(report.notices.end(), reader.notices.begin(), reader.notices.end());
  if (!reader.problems.empty()) return Outcome::unfit;
  reader.take();
  return Outcome::taken;
}

}  // namespace

ConfigurationReport load_configuration(const std::string& path, const ConfigurationIdentity& identity,
                                       std::span<const ConfigurationComponent> components) {
  ConfigurationReport report;
  const Outcome outcome = try_file(path, identity, components, report);
  if (outcome == Outcome::taken) {
    report.source = ConfigurationSource::file;
    return report;
  }
  report.source = ConfigurationSource::refused;
  if (outcome == Outcome::unreadable || outcome == Outcome::unfit) return report;
  // A cell that was tuned must not start untuned because a file broke or went astray: without a good copy it
  // does not start, unless there has never been a file.
  const bool is_absent = outcome == Outcome::absent;
  const std::string previous = path + ".previous";
  const Outcome fallback = try_file(previous, identity, components, report);
  if (fallback == Outcome::taken) {
    report.source = ConfigurationSource::previous;
    report.notices.push_back(
        path +
        (is_absent ? ": there is no such file (remove its copy too to start with the tables' values)" : "") +
        ": the previous copy '" + previous + "' is used in its place");
  } else if (is_absent && fallback == Outcome::absent) {
    report.source = ConfigurationSource::tables;
    report.notices.push_back(
        path +
        ": there is no such file yet: the values of the tables hold, and the end of the run writes it");
  } else if (is_absent) {
    report.problems.push_back(path + ": error: there is no such file, and '" + previous +
                              "' cannot be used in its place: repair that, or remove it to start with the "
                              "values of the tables");
  } else if (fallback == Outcome::absent) {
    report.problems.push_back(path + ": error: there is no previous copy '" + previous +
                              "': repair the file, or remove it to start with the values of the tables");
  } else {
    report.problems.push_back(
        path + ": error: nor can '" + previous +
        "' be used: repair the file, or remove both to start with the values of the tables");
  }
  return report;
}

}  // namespace flexrf
