// Loading the configuration file: everything is read and checked beside the values in use, then taken at
// once.
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/nearest_name.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/configuration_document.hpp"
#include "runtime/parameters/configuration_file.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

// No format before the first has been released.
constexpr std::span<const FormatStep> format_steps;

std::string did_you_mean(const NearestName& nearest) {
  if (nearest.best().empty()) return "";
  return "; did you mean '" + std::string(nearest.best()) + "'?";
}

/// Of each kind; beyond it they are counted.
constexpr std::size_t most_messages = 50;

/// The values of one block as they will be, and which of them the file gives.
struct StagedBlock {
  std::vector<std::byte> values;
  SetMarks marks;
};

struct StagedComponent {
  StagedBlock configuration;
  StagedBlock runtime;
  bool is_given = false;
};

StagedBlock copy_of(const ParameterBlock& block, const void* values) {
  if (block.type == nullptr || values == nullptr) return {};
  const auto* bytes = static_cast<const std::byte*>(values);
  return {{bytes, bytes + block.type->size}, SetMarks(block.type->size)};
}

/// Lines of which the first are kept.
class Messages {
 public:
  /// Whether one more is worth its making.
  bool is_full() const noexcept { return lines_.size() >= most_messages; }
  bool is_empty() const noexcept { return lines_.empty(); }
  void add(std::string line) { lines_.push_back(std::move(line)); }
  void count() noexcept { ++further_; }
  void append_to(std::vector<std::string>& all, const std::string& file, const char* what) {
    all.insert(all.end(), lines_.begin(), lines_.end());
    if (further_ > 0) all.push_back(file + ": and " + std::to_string(further_) + " further " + what);
  }

 private:
  std::vector<std::string> lines_;
  std::size_t further_ = 0;
};

template <class Names>
std::string nearest_of(std::string_view word, const Names& offer) {
  NearestName nearest(word);
  offer(nearest);
  return did_you_mean(nearest);
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
    for (const ConfigurationComponent& component : components) {
      by_name_.emplace(component.name, staged_.size());
      staged_.push_back({copy_of(component.type->configuration, component.configuration),
                         copy_of(component.type->runtime, component.runtime)});
    }
    for (const Rename& rename : identity.renames) renames_.emplace(rename.from, rename.to);
  }

  void read();
  /// Only when there are no problems.
  void take() const;

  Messages problems;
  Messages notices;

 private:
  // One block of one component, while it is read.
  struct Block {
    const ConfigurationComponent& component;
    const char* former_name;  // as the file calls it
    const char* section;
    const ParameterBlock& declared;
    StagedBlock& staged;
  };

  void read_root(pugi::xml_node root);
  void read_component(pugi::xml_node node);
  void read_driver(pugi::xml_node node, std::size_t index);
  static std::string name_and_index(pugi::xml_node node, std::string name);
  void read_block(pugi::xml_node section, std::size_t component);
  void read_parameter(pugi::xml_node node, const Block& block);
  void read_field(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                  StagedBlock& block, std::size_t offset, const ValueRange* range);
  void read_structure(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                      StagedBlock& block, std::size_t offset);
  std::optional<std::string> text_in(pugi::xml_node node);
  void check_attributes(pugi::xml_node node, std::initializer_list<const char*> known);
  std::string component_renamed(const std::string& name) const;
  std::string parameter_renamed(const char* old_component, const char* component,
                                const char* parameter) const;

  /// In a file for this descriptor everything must fit; of another's, what does not is left out. `what` makes
  /// the text.
  template <class What>
  void unfit(pugi::xml_node node, What&& what) {
    Messages& messages = is_ours_ ? problems : notices;
    if (messages.is_full()) return messages.count();
    messages.add(document_.position_of(node) + (is_ours_ ? "error: " : "left out: ") + what());
  }
  void notice(pugi::xml_node node, const char* what) { notices.add(document_.position_of(node) + what); }

  const ConfigurationDocument& document_;
  const ConfigurationIdentity& identity_;
  std::span<const ConfigurationComponent> components_;
  std::vector<StagedComponent> staged_;
  std::unordered_map<std::string_view, std::size_t> by_name_;
  std::unordered_map<std::string_view, const char*> renames_;
  std::unordered_set<std::string> others_;  // devices with drivers that are not chosen
  bool is_ours_ = true;
};

void Reader::read() {
  const pugi::xml_node root = document_.root();
  if (std::strcmp(root.name(), "flexrf") != 0) {
    unfit(root, [&] { return "the outermost element is <" + std::string(root.name()) + ">, not <flexrf>"; });
    return;
  }
  if (const Status status = upgrade_format(root, configuration_format, format_steps); !status) {
    unfit(root, [&] { return std::string(status.cause()); });
    return;
  }
  const char* application = root.attribute("application").value();
  if (application[0] != '\0' && std::strcmp(application, identity_.application) != 0) {
    unfit(root, [&] {
      return std::string("this file is of the application '") + application + "', not of '" +
             identity_.application + "'";
    });
    return;
  }
  read_root(root);
}

void Reader::read_root(pugi::xml_node root) {
  check_attributes(root, {"application", "format", "descriptor", "checksum"});
  const char* descriptor = root.attribute("descriptor").value();
  if (descriptor[0] != '\0') is_ours_ = std::strtoull(descriptor, nullptr, 16) == identity_.descriptor_hash;
  if (!is_ours_)
    notice(root, "written for other tables of this application: values that still fit are taken");
  if (document_.checksum() == ConfigurationDocument::Checksum::edited)
    notice(root, "edited by hand: taken without a checksum");
  for (const pugi::xml_node node : root.children())
    if (node.type() == pugi::node_element) {
      read_component(node);
    } else if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
      unfit(root, [] { return std::string("text between the units and devices"); });
    }
}

std::string Reader::component_renamed(const std::string& name) const {
  const auto renamed = renames_.find(name);
  return renamed == renames_.end() ? name : renamed->second;
}

std::string Reader::parameter_renamed(const char* old_component, const char* component,
                                      const char* parameter) const {
  if (renames_.empty()) return parameter;
  const std::string prefix = std::string(component) + ".";
  for (const std::string& from : {std::string(old_component) + "." + parameter, prefix + parameter}) {
    const auto renamed = renames_.find(from);
    if (renamed != renames_.end() && std::string_view(renamed->second).starts_with(prefix))
      return renamed->second + prefix.size();
  }
  return parameter;
}

void Reader::read_component(pugi::xml_node node) {
  const std::string kind = node.name();
  if (kind != "unit" && kind != "device") {
    unfit(node, [&] {
      return "<" + kind + "> is neither <unit> nor <device>" + nearest_of(kind, [](NearestName& nearest) {
               nearest.offer("unit");
               nearest.offer("device");
             });
    });
    return;
  }
  check_attributes(node, {"name", "driver"});
  const std::string name = component_renamed(node.attribute("name").value());
  const auto found = by_name_.find(name);
  if (found != by_name_.end() && components_[found->second].kind == kind)
    return read_driver(node, found->second);
  unfit(node, [&] {
    return "there is no " + kind + " " + quoted(name) + nearest_of(name, [&](NearestName& nearest) {
             for (const ConfigurationComponent& component : components_)
               if (component.kind == kind) nearest.offer(component.name);
           });
  });
}

void Reader::read_driver(pugi::xml_node node, std::size_t index) {
  const ConfigurationComponent& component = components_[index];
  const auto shown = [&] { return std::string(node.name()) + " " + quoted(component.name); };
  const std::string driver = node.attribute("driver").value();
  if (!driver.empty() && driver != component.driver) {
    const auto is_this = [&driver](const char* other) { return driver == other; };
    if (std::any_of(component.other_drivers.begin(), component.other_drivers.end(), is_this)) {
      // It stays as it is, once.
      if (!others_.insert(component.name + (" " + driver)).second)
        unfit(node, [&] { return shown() + " with driver " + quoted(driver) + " is given twice"; });
      return;
    }
    unfit(node, [&] {
      return shown() + " has no driver " + quoted(driver) + nearest_of(driver, [&](NearestName& nearest) {
               nearest.offer(component.driver);
               for (const char* other : component.other_drivers) nearest.offer(other);
             });
    });
    return;
  }
  if (staged_[index].is_given) {
    unfit(node, [&] { return shown() + " is given twice"; });
    return;
  }
  staged_[index].is_given = true;
  std::unordered_set<std::string_view> seen;
  for (const pugi::xml_node section : node.children()) {
    if (is_stray_text(section)) unfit(section, [&] { return "text between the sections of " + shown(); });
    if (section.type() != pugi::node_element) continue;
    if (seen.insert(section.name()).second) {
      read_block(section, index);
    } else {
      unfit(section,
            [&] { return std::string("<") + section.name() + "> of " + shown() + " is given twice"; });
    }
  }
}

/// "0" and "00" are one index.
std::string Reader::name_and_index(pugi::xml_node node, std::string name) {
  const std::string_view index = node.attribute("index").value();
  const std::size_t zeros = std::min(index.find_first_not_of('0'), index.empty() ? 0 : index.size() - 1);
  return name.append(" ").append(index.substr(zeros));
}

void Reader::read_block(pugi::xml_node section, std::size_t component) {
  const ComponentType& type = *components_[component].type;
  const bool is_configuration = std::strcmp(section.name(), "configuration") == 0;
  if (!is_configuration && std::strcmp(section.name(), "runtime") != 0) {
    unfit(section, [&] {
      return std::string("<") + section.name() + "> is neither <configuration> nor <runtime>" +
             nearest_of(section.name(), [](NearestName& nearest) {
               nearest.offer("configuration");
               nearest.offer("runtime");
             });
    });
    return;
  }
  check_attributes(section, {});
  const Block block{components_[component], section.parent().attribute("name").value(), section.name(),
                    is_configuration ? type.configuration : type.runtime,
                    is_configuration ? staged_[component].configuration : staged_[component].runtime};
  std::unordered_set<std::string> seen;
  for (const pugi::xml_node node : section.children()) {
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
      unfit(section, [] { return std::string("text outside of the parameters"); });
    if (node.type() != pugi::node_element) continue;
    // Under its present name: the former one means the same.
    const std::string name = parameter_renamed(block.former_name, block.component.name, node.name());
    if (!seen.insert(name_and_index(node, name)).second) {
      unfit(node, [&] { return quoted(block.component.name + std::string(".") + name) + " is given twice"; });
      continue;
    }
    read_parameter(node, block);
  }
}

void Reader::read_parameter(pugi::xml_node node, const Block& block) {
  const std::string owner = block.component.name;
  const std::string name = parameter_renamed(block.former_name, owner.c_str(), node.name());
  for (const ParameterDescriptor& parameter : block.declared.parameters) {
    if (name != parameter.field->name || block.staged.values.empty()) continue;
    const Scalar scalar = parameter.field->scalar;
    const bool is_saved = std::strcmp(block.section, "configuration") == 0 ||
                          (parameter.persist && scalar != Scalar::button && scalar != Scalar::hold);
    if (!is_saved) {
      unfit(node, [&] { return quoted(owner + "." + name) + " is not kept in files"; });
      return;
    }
    ValueRange range{};
    read_field(node, *parameter.field, owner + "." + name, block.staged, 0, range_of(parameter, range));
    return;
  }
  unfit(node, [&] {
    return quoted(owner) + " has no " + block.section + " parameter " + quoted(name) +
           nearest_of(name, [&](NearestName& nearest) {
             for (const ParameterDescriptor& parameter : block.declared.parameters)
               nearest.offer(parameter.field->name);
           });
  });
}

void Reader::read_field(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                        StagedBlock& block, std::size_t offset, const ValueRange* range) {
  if (field.scalar == Scalar::structure) {
    read_structure(node, field, path, block, offset);
    return;
  }
  check_attributes(node, {"unit"});
  const pugi::xml_attribute unit = node.attribute("unit");
  if (unit && std::strcmp(unit.value(), field.unit) != 0) {
    unfit(node, [&] {
      return quoted(path) + " is given in '" + unit.value() + "', but its unit of measure is '" + field.unit +
             "'";
    });
    return;
  }
  const std::optional<std::string> text = text_in(node);
  if (!text) return;
  const Status status = write_text(whole(field), block.values.data() + offset, *text, range);
  if (status) {
    block.marks.mark(offset + field.offset, field_size(field));
    return;
  }
  // The cause begins with the field's own name, which the path replaces.
  const std::string cause = status.cause();
  unfit(node, [&] { return path + cause.substr(std::min(cause.size(), std::strlen(field.name))); });
}

void Reader::read_structure(pugi::xml_node node, const FieldDescriptor& field, const std::string& path,
                            StagedBlock& block, std::size_t offset) {
  std::uint32_t element = 0;
  std::string here = path;
  if (field.dimensions > 0) {
    check_attributes(node, {"index"});
    const std::string_view index = node.attribute("index").value();
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), number);
    if (error != std::errc{} || end != index.data() + index.size() || number >= field.count) {
      unfit(node, [&] {
        return quoted(path) + " wants index=\"0\" to \"" + std::to_string(field.count - 1) + "\"";
      });
      return;
    }
    element = number;
    here += "[" + std::to_string(number) + "]";
  } else {
    check_attributes(node, {});
  }
  const std::size_t at = offset + field.offset + element * element_size(field);
  std::unordered_set<std::string> seen;
  for (const pugi::xml_node child : node.children()) {
    if (is_stray_text(child)) unfit(child, [&] { return "text between the members of " + quoted(here); });
    if (child.type() != pugi::node_element) continue;
    if (!seen.insert(name_and_index(child, child.name())).second) {
      unfit(child, [&] { return quoted(here + "." + child.name()) + " is given twice"; });
      continue;
    }
    const auto member = std::find_if(
        field.type->fields.begin(), field.type->fields.end(),
        [&](const FieldDescriptor& candidate) { return std::strcmp(candidate.name, child.name()) == 0; });
    if (member != field.type->fields.end()) {
      read_field(child, *member, here + "." + child.name(), block, at, nullptr);
      continue;
    }
    unfit(child, [&] {
      return quoted(here) + " has no member " + quoted(child.name()) +
             nearest_of(child.name(), [&](NearestName& nearest) {
               for (const FieldDescriptor& candidate : field.type->fields) nearest.offer(candidate.name);
             });
    });
  }
}

std::optional<std::string> Reader::text_in(pugi::xml_node node) {
  std::string text;
  for (const pugi::xml_node part : node.children()) {
    if (part.type() == pugi::node_element) {
      unfit(part, [&] { return std::string("<") + part.name() + "> within a single value"; });
      return std::nullopt;
    }
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) text += part.value();
  }
  return text;
}

void Reader::check_attributes(pugi::xml_node node, std::initializer_list<const char*> known) {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    // The first of a name: another one would be passed over.
    if (node.attribute(attribute.name()) != attribute) {
      unfit(node, [&] {
        return std::string("attribute '") + attribute.name() + "' of <" + node.name() + "> is given twice";
      });
      continue;
    }
    const auto is_this = [&](const char* name) { return std::strcmp(name, attribute.name()) == 0; };
    if (std::any_of(known.begin(), known.end(), is_this)) continue;
    unfit(node, [&] {
      return std::string("<") + node.name() + "> has no attribute '" + attribute.name() + "'" +
             nearest_of(attribute.name(), [&](NearestName& nearest) {
               for (const char* name : known) nearest.offer(name);
             });
    });
  }
}

void Reader::take() const {
  const auto take_block = [](const StagedBlock& staged, void* values, SetMarks* marks) {
    if (staged.values.empty()) return;
    std::memcpy(values, staged.values.data(), staged.values.size());
    if (marks != nullptr) *marks = staged.marks;
  };
  for (std::size_t i = 0; i < components_.size(); ++i) {
    take_block(staged_[i].configuration, components_[i].configuration, components_[i].configuration_marks);
    take_block(staged_[i].runtime, components_[i].runtime, components_[i].runtime_marks);
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
  reader.problems.append_to(report.problems, path, "errors");
  reader.notices.append_to(report.notices, path, "that were left out");
  if (!reader.problems.is_empty()) return Outcome::unfit;
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
    report.notices.push_back(path +
                             ": there is no such file yet: the values of the tables hold; it is written when "
                             "somebody has set one");
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
