// A station's register map as a constant.
#include "config-gen/emit/application_parts.hpp"

namespace flexrf::config_gen {

void emit_register_map(const RegisterMap& map, const std::string& constant, Text& out) {
  const auto value = [](const char* enumeration, const std::string& name) {
    return std::string("Modbus") + enumeration + "::" + (name == "bool" ? "boolean" : name);
  };
  out << "constexpr ModbusRegister " << constant << "_registers[] = {\n";
  for (const ModbusRegister& entry : map.registers) {
    out << "    {.name = " << string_literal(entry.name) << ", .address = " << entry.address
        << ", .area = " << value("Area", register_areas[entry.area])
        << ", .type = " << value("Type", register_types[entry.type])
        << ",\n     .word_order = " << value("WordOrder", register_word_orders[entry.word_order])
        << ", .access = " << value("Access", register_accesses[entry.access])
        << ", .poll_group = " << value("PollGroup", register_poll_groups[entry.poll_group])
        << ",\n     .scale = " << double_literal(entry.scale) << ", .unit = " << string_literal(entry.unit)
        << ", .safe_value = " << double_literal(entry.safe_value);
    if (entry.bit) out << ", .bit = " << unsigned{*entry.bit};
    if (!entry.refreshed) out << ", .refreshed = false";
    if (entry.offset != 0) out << ", .offset = " << double_literal(entry.offset);
    if (entry.missing) out << ", .missing = std::uint64_t{" << hash_literal(*entry.missing) << "}";
    if (entry.length != 0) out << ", .length = " << entry.length;
    if (entry.scale_register) out << ", .scale_register = " << *entry.scale_register;
    out << "},\n";
  }
  out << "};\nconstexpr ModbusRegisterMap " << constant << "{" << constant << "_registers};\n";
}

}  // namespace flexrf::config_gen
