#include "config-gen/read/needs.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

// Numbers of values are kept as bits.
constexpr std::size_t most_values = 64;

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::vector<std::string> parts_of(std::string_view list) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t bar = list.find('|');
    parts.emplace_back(without_blanks(list.substr(0, bar)));
    if (bar == std::string_view::npos) return parts;
    list.remove_prefix(bar + 1);
  }
}

// As the panel writes names.
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

Need motion() {
  return {Need::Of::motion, "", 0, "needs motion to be permitted; give Start"};
}

class NeedReader {
 public:
  // Looked for in this order. `where` is as "[feedback] or [runtime]".
  NeedReader(Library& library, std::vector<const ParameterBlock*> blocks, const char* where)
      : library_(library), blocks_(std::move(blocks)), where_(where) {}

  std::optional<Need> read(const Node& node) {
    std::string_view text = without_blanks(node.text);
    if (text == "motion" && takes_motion()) return motion();
    const bool negated = text.starts_with("not ");
    if (negated) text = without_blanks(text.substr(4));
    const std::size_t equals = text.find('=');
    const std::string name{without_blanks(text.substr(0, equals))};
    Need need;
    const Parameter* const parameter = find(name, need.of);
    if (parameter == nullptr) return refuse_name(node, name);
    need.field = name;
    const FieldType& type = parameter->field.type;
    const bool is_single = parameter->field.shape.empty() && parameter->input == Parameter::Input::value;
    if (is_single && type.kind == FieldType::Kind::scalar && type.scalar == Scalar::boolean) {
      if (equals != std::string_view::npos) {
        library_.diagnostics().error(node.position, quote(name) + " is a bool and has no values to name",
                                     "write \"" + name + "\" or \"not " + name + "\"");
        return std::nullopt;
      }
      need.numbers = negated ? 1U : 2U;
      need.reason = "needs " + spoken(name) + " to be " + (negated ? "off" : "on");
      return need;
    }
    if (is_single && type.kind == FieldType::Kind::declared) {
      const Type& declared = library_.model().types[type.declared];
      if (declared.kind == Type::Kind::enumeration)
        return read_values(node, declared, name, negated,
                           equals == std::string_view::npos ? "" : text.substr(equals + 1), need);
    }
    library_.diagnostics().error(node.position,
                                 quote(name) + " is neither a bool nor an enumeration: nothing can need it",
                                 takes_motion() ? "let the unit tell in a bool of its feedback what it needs"
                                                : "name a bool or an enumeration");
    return std::nullopt;
  }

 private:
  // A command may need the permission to move; what is configured is so before there is one.
  bool takes_motion() const { return blocks_.size() > 2; }

  const Parameter* find(const std::string& name, Need::Of& of) const {
    for (const ParameterBlock* const block : blocks_) {
      for (const Parameter& parameter : block->parameters) {
        of = parameter.kind == Parameter::Kind::runtime    ? Need::Of::runtime
             : parameter.kind == Parameter::Kind::feedback ? Need::Of::feedback
                                                           : Need::Of::configuration;
        if (parameter.field.name == name) return &parameter;
      }
    }
    return nullptr;
  }

  std::nullopt_t refuse_name(const Node& node, const std::string& name) {
    std::vector<std::string> known;
    if (takes_motion()) known.emplace_back("motion");
    for (const ParameterBlock* const block : blocks_)
      for (const Parameter& parameter : block->parameters) known.push_back(parameter.field.name);
    library_.diagnostics().error(
        node.position,
        quote(name) + (takes_motion() ? " is neither \"motion\" nor a name in " : " is no name in ") +
            where_ + " here",
        suggest(name, known, "names", ""));
    return std::nullopt;
  }

  std::optional<Need> read_values(const Node& node, const Type& type, const std::string& name, bool negated,
                                  std::string_view list, Need need) {
    Diagnostics& diagnostics = library_.diagnostics();
    std::vector<std::string> known;
    for (const EnumerationValue& value : type.values) known.push_back(value.name);
    if (known.size() > most_values) {
      diagnostics.error(node.position, quote(name) + " has more than 64 values: nothing can need it",
                        "let the unit tell in a bool of its feedback what it needs");
      return std::nullopt;
    }
    if (without_blanks(list).empty()) {
      diagnostics.error(node.position, "which values of " + quote(name) + " will do is not said",
                        "write \"" + name + " = " + (known.empty() ? "VALUE" : known.front()) + "\"");
      return std::nullopt;
    }
    std::string spoken_list;
    const std::vector<std::string> wanted = parts_of(list);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto found = std::find(known.begin(), known.end(), wanted[i]);
      if (found == known.end()) {
        diagnostics.error(node.position, quote(name) + " has no value " + quote(wanted[i]),
                          suggest(wanted[i], known, "values", "its type has none"));
        return std::nullopt;
      }
      need.numbers |= std::uint64_t{1} << (found - known.begin());
      if (i > 0) spoken_list += i + 1 == wanted.size() ? " or " : ", ";
      spoken_list += spoken(wanted[i]);
    }
    if (negated) {
      const std::uint64_t all =
          known.size() == most_values ? ~std::uint64_t{0} : (std::uint64_t{1} << known.size()) - 1;
      need.numbers = all & ~need.numbers;
    }
    need.reason = "needs " + spoken(name) + (negated ? " not to be " : " to be ") + spoken_list;
    return need;
  }

  Library& library_;
  std::vector<const ParameterBlock*> blocks_;
  const char* where_;
};

// A text, or all of a list; what else stands there is reported.
std::vector<const Node*> texts_of(const Node& needs, Diagnostics& diagnostics) {
  std::vector<const Node*> texts;
  const auto take = [&](const Node& one) {
    if (one.kind == Node::Kind::text)
      texts.push_back(&one);
    else
      diagnostics.error(one.position, "'needs' is a text or a list of texts, not " + kind_text(one.kind),
                        "write needs = \"motion\", or needs = [\"motion\", \"state = ready\"]");
  };
  if (needs.kind == Node::Kind::array)
    std::for_each(needs.children.begin(), needs.children.end(), take);
  else
    take(needs);
  return texts;
}

// Calls `take` with each parameter of the block whose row has 'needs', and with these.
template <typename Take>
void each_needs(const Node& root, std::string_view section, ParameterBlock& block, Take take) {
  const Node* const rows = root.find(section);
  if (rows == nullptr || rows->kind != Node::Kind::table) return;
  for (Parameter& parameter : block.parameters) {
    const Node* const row = rows->find(parameter.field.name);
    const Node* const needs = row != nullptr && row->kind == Node::Kind::table ? row->find("needs") : nullptr;
    if (needs != nullptr) take(parameter, *needs);
  }
}

}  // namespace

void read_needs(Library& library, const Node& root, ParameterBlock& runtime, const ParameterBlock& feedback,
                const Interface& before) {
  // No hold begins without the permission to move.
  for (Parameter& parameter : runtime.parameters)
    if (parameter.input == Parameter::Input::hold) parameter.needs.push_back(motion());
  NeedReader reader(library, {&feedback, &before.feedback, &runtime, &before.runtime},
                    "[feedback] or [runtime]");
  each_needs(root, "runtime", runtime, [&](Parameter& parameter, const Node& needs) {
    if (parameter.input == Parameter::Input::value) {
      library.diagnostics().error(
          needs.position, "[runtime." + parameter.field.name + "] is set, and needs nothing",
          "only a button or a hold has 'needs'; let accept() of the unit refuse values");
      return;
    }
    for (const Node* one : texts_of(needs, library.diagnostics())) {
      auto need = reader.read(*one);
      if (need && !(need->of == Need::Of::motion && parameter.input == Parameter::Input::hold))
        parameter.needs.push_back(std::move(*need));
    }
  });
}

void read_needs_of_configuration(Library& library, const Node& root, ParameterBlock& configuration,
                                 const ParameterBlock& before) {
  NeedReader reader(library, {&configuration, &before}, "[configuration]");
  each_needs(root, "configuration", configuration, [&](Parameter& parameter, const Node& needs) {
    for (const Node* one : texts_of(needs, library.diagnostics()))
      if (auto need = reader.read(*one)) parameter.conditions.push_back(std::move(*need));
  });
}

}  // namespace flexrf::config_gen
