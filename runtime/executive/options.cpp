#include "runtime/executive/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "base/nearest_name.hpp"

namespace flexrf {
namespace {

constexpr std::array own_options{
    Option{"--hardware", OptionKind::text, "CHOICE", "drivers: `mock`, or `arm=simulated,camera=real`"},
    Option{"--virtual-time", OptionKind::duration, "DURATION",
           "run on a simulated clock, as fast as it goes: `60s`, `500ms`"},
    Option{"--seed", OptionKind::text, "N", "of all random numbers (default 1)"},
    Option{"--digest", OptionKind::flag, nullptr,
           "last line of the output: digest of everything that was published"},
    Option{"--config", OptionKind::kept_file, "FILE",
           "configuration file (XML): read at the start, written when values are saved"},
    Option{"--report", OptionKind::output_file, "FILE", "write the final report as JSON too"},
    Option{"--audit", OptionKind::text, "FILE|off",
           "who did what (default: FILE.audit beside --config FILE)"},
    Option{"--standstill-limit", OptionKind::duration, "DURATION",
           "instead of the application's: what is a fault of time missed at a stretch"},
    Option{"--no-realtime", OptionKind::flag, nullptr, "ordinary priorities; refused with a real actuator"},
    Option{"--no-autostart", OptionKind::flag, nullptr,
           "nothing moves before a person gives Start, whatever the table says"},
    Option{"--motion-permit", OptionKind::text, "FILE",
           "nothing moves unless this file says `permitted`; else its first line says why not"},
    Option{"--descriptor", OptionKind::flag, nullptr, "print descriptor.json and end"},
    Option{"--drivers", OptionKind::flag, nullptr,
           "print which driver each device has, as --hardware takes it, and end"},
    Option{"--version", OptionKind::flag, nullptr, "which application of which FlexRF this is"},
    Option{"--help", OptionKind::flag, nullptr, "this text"},
};

/// Options of one part, under its name in --help.
struct OptionGroup {
  std::string name;
  std::span<const Option> options;
};

std::vector<OptionGroup> groups_of(const Application& application, const ObserverPart* observer) {
  std::vector<OptionGroup> groups{{"Application", own_options}};
  if (observer != nullptr) groups.push_back({observer->name, observer->options});
  for (const DeviceRecord& device : application.devices) {
    for (const DriverRecord& driver : device.drivers) {
      // Several devices permit the same driver.
      const bool is_known = std::any_of(groups.begin(), groups.end(), [&](const OptionGroup& group) {
        return group.options.data() == driver.options.data();
      });
      if (driver.options.empty() || is_known) continue;
      groups.push_back({std::string{"Driver `"} + driver.name + "` of " + device.interface, driver.options});
    }
  }
  return groups;
}

const Option* find_option(const std::vector<OptionGroup>& groups, std::string_view name) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      if (name == option.name) return &option;
    }
  }
  return nullptr;
}

/// "; did you mean `x`?", or nothing when no known word is near.
std::string did_you_mean(const NearestName& nearest) {
  if (nearest.best().empty()) return "";
  return "; did you mean `" + std::string{nearest.best()} + "`?";
}

Status unknown_option(const std::vector<OptionGroup>& groups, const std::string& argument) {
  NearestName nearest(argument);
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) nearest.offer(option.name);
  }
  const std::string hint = nearest.best().empty() ? "; --help lists what there is" : did_you_mean(nearest);
  return Status::error(StatusCode::invalid_argument, "unknown argument `%s`%s", argument.c_str(),
                       hint.c_str());
}

const DeviceRecord* find_device(const Application& application, std::string_view name) {
  for (const DeviceRecord& device : application.devices) {
    if (name == device.name) return &device;
  }
  return nullptr;
}

std::string drivers_of(const DeviceRecord& device) {
  std::string list;
  for (const DriverRecord& driver : device.drivers)
    list += (list.empty() ? "" : ", ") + std::string{driver.name};
  return list;
}

Status check_choice(const Application& application, const HardwareChoice& choice) {
  if (choice.device.empty()) {
    for (const DeviceRecord& device : application.devices) {
      for (const DriverRecord& driver : device.drivers) {
        if (choice.driver == driver.name || choice.driver == name_of(driver.kind)) return {};
      }
    }
    return Status::error(StatusCode::invalid_argument,
                         "--hardware %s: no device of this application has such a driver",
                         choice.driver.c_str());
  }
  const DeviceRecord* device = find_device(application, choice.device);
  if (device == nullptr) {
    NearestName nearest(choice.device);
    for (const DeviceRecord& known : application.devices) nearest.offer(known.name);
    return Status::error(StatusCode::invalid_argument, "--hardware: no device `%s`%s", choice.device.c_str(),
                         did_you_mean(nearest).c_str());
  }
  for (const DriverRecord& driver : device->drivers) {
    if (choice.driver == driver.name || choice.driver == name_of(driver.kind)) return {};
  }
  return Status::error(StatusCode::invalid_argument,
                       "--hardware: device `%s` has no driver `%s`; it permits: %s", device->name,
                       choice.driver.c_str(), drivers_of(*device).c_str());
}

Status parse_hardware(const Application& application, std::string_view text,
                      std::vector<HardwareChoice>& choices) {
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    const std::size_t equals = part.find('=');
    HardwareChoice choice;
    if (equals == std::string_view::npos) {
      choice.driver = part;
    } else {
      choice.device = part.substr(0, equals);
      choice.driver = part.substr(equals + 1);
    }
    if (const Status status = check_choice(application, choice); !status) return status;
    choices.push_back(std::move(choice));
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  }
  return {};
}

/// Adds to what is given, with a value that is as its option asks for.
Status take_argument(const std::vector<OptionGroup>& groups, char** arguments, int count, int& i,
                     std::vector<GivenOption>& given) {
  const std::string_view argument = arguments[i];
  const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string_view::npos;
  const Option* const option = find_option(groups, argument.substr(0, equals));
  if (option == nullptr) return unknown_option(groups, std::string{argument});
  const char* value = nullptr;
  if (option->kind == OptionKind::flag) {
    if (equals != std::string_view::npos)
      return Status::error(StatusCode::invalid_argument, "%s takes no value", option->name);
  } else {
    value = equals != std::string_view::npos ? arguments[i] + equals + 1
            : i + 1 < count                  ? arguments[++i]
                                             : "";
    if (value[0] == '\0')
      return Status::error(StatusCode::invalid_argument, "%s needs a value: %s", option->name, option->value);
    if (const Status status = check_value(*option, value); !status) return status;
  }
  given.push_back({option, value});
  return {};
}

/// What the executive itself is told.
Status read_own(const Application& application, Options& options) {
  for (const GivenOption& given : options.given) {
    if (given.option->name != std::string_view{"--hardware"}) continue;
    if (const Status status = parse_hardware(application, given.value, options.hardware); !status)
      return status;
  }
  const OptionValues values = options.values();
  options.virtual_time = values.duration("--virtual-time");
  options.configuration_file = values.text("--config", "");
  options.report_file = values.text("--report", "");
  options.audit_file = values.text("--audit", "");
  options.standstill_limit = values.duration("--standstill-limit");
  options.digest = values.has("--digest");
  options.realtime = !values.has("--no-realtime");
  options.autostart = !values.has("--no-autostart");
  options.motion_permit_file = values.text("--motion-permit", "");
  options.status_view = true;
  const std::string_view seed = values.text("--seed", "1");
  const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), options.seed);
  if (error != std::errc{} || end != seed.data() + seed.size()) {
    return Status::error(StatusCode::invalid_argument, "--seed %s: give a whole number from 0 to 2^64-1",
                         seed.data());
  }
  if (!options.motion_permit_file.empty() && options.virtual_time) {
    return Status::error(StatusCode::invalid_argument,
                         "--motion-permit has no meaning with --virtual-time: nothing there can move");
  }
  if (options.digest && !options.virtual_time) {
    return Status::error(StatusCode::invalid_argument,
                         "--digest needs --virtual-time: on the wall clock no two runs are the same");
  }
  return {};
}

}  // namespace

Result<Options> parse_options(const Application& application, const ObserverPart* observer,
                              int argument_count, char** arguments) {
  Options options;
  const std::vector<OptionGroup> groups = groups_of(application, observer);
  for (int i = 1; i < argument_count; ++i) {
    if (const Status status = take_argument(groups, arguments, argument_count, i, options.given); !status)
      return status;
  }
  if (const Status status = read_own(application, options); !status) return status;
  if (observer != nullptr) {
    const Result<bool> wanted = observer->is_wanted(options);
    if (!wanted) return wanted.status();
    options.observed = *wanted;
  }
  return options;
}

std::string usage(const Application& application, const ObserverPart* observer) {
  std::string text = std::string{application.name} + ": " + application.summary + "\n";
  for (const OptionGroup& group : groups_of(application, observer)) {
    text += "\n" + group.name + ":\n";
    for (const Option& option : group.options) {
      std::string left =
          "  " + std::string{option.name} + (option.value == nullptr ? "" : " " + std::string{option.value});
      left.resize(left.size() < 30 ? 30 : left.size() + 1, ' ');
      text += left + option.summary + "\n";
    }
  }
  text += "\nDevices and their drivers (the first is the default):\n";
  for (const DeviceRecord& device : application.devices) {
    text += "  " + std::string{device.name} + " (" + device.interface + "): " + drivers_of(device) + "\n";
  }
  text += "\nExit codes: 0 finished, 1 usage, 2 fault, 3 right missing, 128+n signal n.\n";
  return text;
}

}  // namespace flexrf
