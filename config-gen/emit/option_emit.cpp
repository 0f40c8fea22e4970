// Options of the command line that a driver declares: their table, and how the driver reads them.
#include "config-gen/emit/component.hpp"

namespace flexrf::config_gen {
namespace {

struct Access {
  std::string type;      // in the driver's struct Options
  const char* function;  // of OptionValues
};

Access access_of(const DriverOption& option, const std::string& prefix) {
  using Kind = DriverOption::Kind;
  switch (option.kind) {
    case Kind::flag:
      return {"bool", "has"};
    case Kind::number:
      return {"std::optional<double>", "number"};
    case Kind::duration:
      return {"std::optional<" + prefix + "Duration>", "duration"};
    default:
      return {"const char*", "text"};
  }
}

}  // namespace

void declare_options(const Driver& driver, const std::string& prefix, Text& out) {
  if (driver.options.empty()) return;
  out << "  /// What the command line says; what it does not is null, empty or false.\n  struct Options {\n";
  for (const DriverOption& option : driver.options) {
    out << "    " << access_of(option, prefix).type << " " << option.name << ";  ///< " << option.flag()
        << " "
        << comment_text(option.value + (option.unit.empty() ? "" : " in " + option.unit) + ": " +
                        option.summary)
        << "\n";
  }
  out << "  };\n";
}

void define_options(const Driver& driver, const std::string& prefix, Text& out) {
  if (driver.options.empty()) return;
  const std::string name = driver_options_name(driver);
  out << "constinit const " << prefix << "Option " << name << "[" << driver.options.size() << "] = {\n";
  for (const DriverOption& option : driver.options) {
    out << "    {.name = " << string_literal(option.flag()) << ", .kind = " << prefix
        << "OptionKind::" << option_words[static_cast<std::size_t>(option.kind)]
        << ", .value = " << (option.value.empty() ? "nullptr" : string_literal(option.value))
        << ",\n     .summary = " << string_literal(option.summary);
    if (!option.unit.empty()) out << ", .unit = " << string_literal(option.unit);
    if (option.range)
      out << ", .least = " << double_literal(option.range->first)
          << ", .most = " << double_literal(option.range->second);
    out << (option.chooses ? ", .chooses = true},\n" : "},\n");
  }
  out << "};\n\n"
      << driver.base_class << "::Options " << driver.base_class << "::options() const noexcept {\n"
      << "  const " << prefix << "OptionValues& given = environment().options;\n  return {";
  for (const DriverOption& option : driver.options) {
    out << (&option == driver.options.data() ? "." : ",\n          .") << option.name << " = given."
        << access_of(option, prefix).function << "(" << string_literal(option.flag()) << ")";
  }
  out << "};\n}\n\n";
}

}  // namespace flexrf::config_gen
