#include "runtime/executive/options.hpp"

#include <array>
#include <charconv>
#include <cstring>
#include <string_view>

#include "runtime/core/nearest_name.hpp"

namespace flexrf {
namespace {

struct Flag {
  const char* name;
  const char* value;  // what follows, or null
  const char* meaning;
};

constexpr std::array flags{
    Flag{"--hardware", "CHOICE", "drivers: `mock`, or `arm=simulated,camera=real`"},
    Flag{"--virtual-time", "DURATION", "run on a simulated clock, as fast as it goes: `60s`, `500ms`"},
    Flag{"--keys", "FILE", "key presses from a file: a line each, seconds and key, as `0.5 w`"},
    Flag{"--seed", "N", "of all random numbers (default 1)"},
    Flag{"--digest", nullptr, "last line of the output: digest of everything that was published"},
    Flag{"--config", "FILE", "configuration file (XML): read at the start, written when values are saved"},
    Flag{"--report", "FILE", "write the final report as JSON too"},
    Flag{"--audit", "FILE|off", "who did what (default: FILE.audit beside --config FILE)"},
    Flag{"--panel", "ADDRESS:PORT|off", "where the panel listens (default 127.0.0.1:8080)"},
    Flag{"--panel-users", "FILE", "who may log in to the panel (`./flexrf password` writes it)"},
    Flag{"--panel-host", "NAME", "another name of this machine in the panel's address"},
    Flag{"--panel-edit-timeout", "DURATION", "how long an edit may be left open (default `5min`)"},
    Flag{"--tls-certificate", "FILE", "serve the panel by TLS: certificate (PEM)"},
    Flag{"--tls-key", "FILE", "and its key (PEM)"},
    Flag{"--insecure-http", nullptr, "let other machines use the panel without TLS"},
    Flag{"--standstill-limit", "DURATION",
         "instead of the application's: what is a fault of time missed at a stretch"},
    Flag{"--no-realtime", nullptr, "ordinary priorities; refused with a real actuator"},
    Flag{"--descriptor", nullptr, "print descriptor.json and end"},
    Flag{"--version", nullptr, "which application of which FlexRF this is"},
    Flag{"--help", nullptr, "this text"},
};

/// "; did you mean `x`?", or nothing when no known word is near.
std::string did_you_mean(const NearestName& nearest) {
  if (nearest.best().empty()) return "";
  return "; did you mean `" + std::string{nearest.best()} + "`?";
}

Status unknown_flag(const std::string& argument) {
  NearestName nearest(argument);
  for (const Flag& flag : flags) nearest.offer(flag.name);
  const std::string hint = nearest.best().empty() ? "; --help lists what there is" : did_you_mean(nearest);
  return Status::error(StatusCode::invalid_argument, "unknown argument `%s`%s", argument.c_str(),
                       hint.c_str());
}

std::optional<Duration> parse_duration(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !(number > 0)) return std::nullopt;
  const std::string_view unit{end, static_cast<std::size_t>(text.data() + text.size() - end)};
  double scale = 0;
  if (unit == "h") scale = 3600e9;
  if (unit == "min") scale = 60e9;
  if (unit == "s") scale = 1e9;
  if (unit == "ms") scale = 1e6;
  if (unit == "us") scale = 1e3;
  if (scale == 0 || number * scale > 9e18 || number * scale < 1) return std::nullopt;
  return Duration{static_cast<std::int64_t>(number * scale)};
}

Status no_duration(std::string_view name, std::string_view value) {
  return Status::error(
      StatusCode::invalid_argument, "%.*s %.*s: give a duration with its unit (us, ms, s, min, h), as `60s`",
      static_cast<int>(name.size()), name.data(), static_cast<int>(value.size()), value.data());
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

bool has_keyboard_with_script(const Application& application) {
  for (const DeviceRecord& device : application.devices) {
    if (std::strcmp(device.interface, "Keyboard") != 0) continue;
    for (const DriverRecord& driver : device.drivers) {
      if (std::strcmp(driver.name, "script") == 0) return true;
    }
  }
  return false;
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

Status take(const Application& application, std::string_view name, std::string_view value, Options& options) {
  if (name == "--hardware") return parse_hardware(application, value, options.hardware);
  if (name == "--keys") {
    options.keys_file = value;
  } else if (name == "--config") {
    options.configuration_file = value;
  } else if (name == "--report") {
    options.report_file = value;
  } else if (name == "--audit") {
    options.audit_file = value;
  } else if (name == "--panel") {
    if (value != "off" && value.find(':') == std::string_view::npos) {
      return Status::error(StatusCode::invalid_argument, "--panel %.*s: give ADDRESS:PORT or off",
                           static_cast<int>(value.size()), value.data());
    }
    options.panel = value;
    options.panel_given = value != "off";
  } else if (name == "--panel-users") {
    options.panel_users = value;
  } else if (name == "--panel-host") {
    options.panel_hosts.emplace_back(value);
  } else if (name == "--tls-certificate") {
    options.tls_certificate = value;
  } else if (name == "--tls-key") {
    options.tls_key = value;
  } else if (name == "--panel-edit-timeout") {
    const std::optional<Duration> timeout = parse_duration(value);
    if (!timeout) return no_duration(name, value);
    options.panel_edit_timeout = *timeout;
  } else if (name == "--standstill-limit") {
    options.standstill_limit = parse_duration(value);
    if (!options.standstill_limit) return no_duration(name, value);
  } else if (name == "--virtual-time") {
    options.virtual_time = parse_duration(value);
    if (!options.virtual_time) return no_duration(name, value);
  } else if (name == "--seed") {
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), options.seed);
    if (error != std::errc{} || end != value.data() + value.size()) {
      return Status::error(StatusCode::invalid_argument, "--seed %.*s: give a whole number from 0 to 2^64-1",
                           static_cast<int>(value.size()), value.data());
    }
  }
  return {};
}

}  // namespace

Result<Options> parse_options(const Application& application, int argument_count, char** arguments) {
  Options options;
  for (int i = 1; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string_view::npos;
    const std::string_view name = argument.substr(0, equals);
    const Flag* flag = nullptr;
    for (const Flag& known : flags) {
      if (name == known.name) flag = &known;
    }
    if (flag == nullptr) return unknown_flag(std::string{argument});
    if (flag->value == nullptr) {
      if (equals != std::string_view::npos) {
        return Status::error(StatusCode::invalid_argument, "%s takes no value", flag->name);
      }
      options.digest |= name == "--digest";
      options.help |= name == "--help";
      options.version |= name == "--version";
      options.insecure_http |= name == "--insecure-http";
      options.descriptor |= name == "--descriptor";
      if (name == "--no-realtime") options.realtime = false;
      continue;
    }
    std::string_view value;
    if (equals != std::string_view::npos) {
      value = argument.substr(equals + 1);
    } else if (i + 1 < argument_count) {
      value = arguments[++i];
    }
    if (value.empty())
      return Status::error(StatusCode::invalid_argument, "%s needs a value: %s", flag->name, flag->value);
    if (const Status status = take(application, name, value, options); !status) return status;
  }
  if (options.digest && !options.virtual_time) {
    return Status::error(StatusCode::invalid_argument,
                         "--digest needs --virtual-time: on the wall clock no two runs are the same");
  }
  if (!options.keys_file.empty() && !has_keyboard_with_script(application)) {
    return Status::error(
        StatusCode::invalid_argument,
        "--keys %s: no Keyboard of this application has the driver `script`, which reads it; "
        "leave --keys away, or add the driver to the device's table",
        options.keys_file.c_str());
  }
  if (options.panel_given && options.virtual_time) {
    return Status::error(
        StatusCode::invalid_argument,
        "--panel %s with --virtual-time: there is no panel on a simulated clock; leave one of "
        "them away",
        options.panel.c_str());
  }
  options.status_view = true;
  return options;
}

std::string usage(const Application& application) {
  std::string text = std::string{application.name} + ": " + application.summary + "\n\n";
  for (const Flag& flag : flags) {
    std::string left =
        "  " + std::string{flag.name} + (flag.value == nullptr ? "" : " " + std::string{flag.value});
    left.resize(left.size() < 30 ? 30 : left.size() + 1, ' ');
    text += left + flag.meaning + "\n";
  }
  text += "\nDevices and their drivers (the first is the default):\n";
  for (const DeviceRecord& device : application.devices) {
    text += "  " + std::string{device.name} + " (" + device.interface + "): " + drivers_of(device) + "\n";
  }
  text += "\nExit codes: 0 finished, 1 usage, 2 fault, 3 right missing, 128+n signal n.\n";
  return text;
}

}  // namespace flexrf
