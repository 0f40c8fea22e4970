// [option.NAME] of a driver: options of the command line.
#include <algorithm>

#include "config-gen/model/own_options.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {
namespace {

// How --help calls what follows, unless the table says it.
constexpr std::string_view usual_values[] = {"", "TEXT", "NUMBER", "DURATION", "FILE", "FILE", "FOLDER"};

DriverOption read_option(Library& library, const Node& node, Driver::Kind kind_of_driver) {
  Diagnostics& diagnostics = library.diagnostics();
  Row row(node, "[option." + node.key + "]", diagnostics);
  DriverOption option;
  option.name = node.key;
  option.position = node.key_position;
  option.summary = row.summary();
  const auto& own = own_options;
  if (std::find(own.begin(), own.end(), option.flag()) != own.end())
    diagnostics.error(option.position,
                      "an option of a driver cannot be named " + quote(option.name) + ": " + option.flag() +
                          " is FlexRF's own",
                      "choose another name, that says what of the driver it is");
  if (!row.has("kind")) row.missing("kind", "add kind = \"file\", \"number\", \"flag\" or another");
  const auto kind = row.word("kind", {option_words.begin(), option_words.end()});
  option.kind = static_cast<DriverOption::Kind>(kind.value_or(0));
  option.value = usual_values[kind.value_or(0)];
  if (option.kind != DriverOption::Kind::flag || !kind)
    option.value = row.sentence("value").value_or(option.value);
  if (option.kind == DriverOption::Kind::number) {
    const Parameter number = read_number(library, row);
    option.unit = number.field.unit == "1" ? "" : number.field.unit;
    if (number.low && number.high) option.range = {number_of(*number.low), number_of(*number.high)};
  }
  option.chooses = row.boolean("chooses").value_or(false);
  if (option.chooses && kind_of_driver == Driver::Kind::real)
    diagnostics.error(row.position("chooses"), row.name() + " cannot choose a real driver",
                      "a real driver is chosen by --hardware alone: remove 'chooses'");
  if (kind) row.finish();
  return option;
}

}  // namespace

std::vector<DriverOption> read_driver_options(Library& library, const Node& table, Driver::Kind kind) {
  std::vector<DriverOption> options;
  for (const Node* node : named_rows(library, table, "option", "an option"))
    options.push_back(read_option(library, *node, kind));
  return options;
}

}  // namespace flexrf::config_gen
