// A station's register map as a constant.
#include "config-gen/emit/application_parts.hpp"

namespace flexrf::config_gen {

void emit_register_map(const RegisterMap& map, const std::string& constant, Text& out) {
  const auto value = [](const char* enumeration, const std::string& name) {
    return std::string("Modbus") + enumeration + "::" + (name == "bool" ? "boolean" : name);
  };
  out << "constexpr ModbusRegister " << constant << "_registers[] = {\n";
  for (const ModbusRegister& entry : map.registers) {
    out << "    {" << string_literal(entry.name) << ", " << entry.address << ", "
        << value("Area", register_areas[entry.area]) << ", " << value("Type", register_types[entry.type])
        << ",\n     " << value("WordOrder", register_word_orders[entry.word_order]) << ", "
        << value("Access", register_accesses[entry.access]) << ", "
        << value("PollGroup", register_poll_groups[entry.poll_group]) << ", " << double_literal(entry.scale)
        << ", " << string_literal(entry.unit) << ", " << double_literal(entry.safe_value);
    if (entry.bit || !entry.refreshed)
      out << ", " << (entry.bit ? std::to_string(*entry.bit) : "ModbusRegister::whole");
    if (!entry.refreshed) out << ", false";
    out << "},\n";
  }
  out << "};\nconstexpr ModbusRegisterMap " << constant << "{" << constant << "_registers};\n";
}

}  // namespace flexrf::config_gen
