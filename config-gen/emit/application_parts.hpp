// The parts of a generated application's source, in the order in which they stand there.
#pragma once

#include "config-gen/emit/application_names.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

// What a slot carries, in C++: "Pose", "JogFeedback".
std::string slot_type(const Model& model, const Slot& slot);

// Memory: what every thread, slot and queue is made of, and the objects' storage. `sizes` collects the
// expressions that the memory budget is checked against.
void emit_threads_memory(const Model& model, const ApplicationNames& names, Text& out,
                         std::vector<std::string>& sizes);
void emit_slots(const Model& model, const ApplicationNames& names, Text& out,
                std::vector<std::string>& sizes);
void emit_readers(const Model& model, const ApplicationNames& names, Text& out);
void emit_queues(const Model& model, const ApplicationNames& names, Text& out,
                 std::vector<std::string>& sizes);
void emit_devices(const Model& model, const ApplicationNames& names, Text& out,
                  std::vector<std::string>& sizes);
void emit_units(const Model& model, const ApplicationNames& names, Text& out,
                std::vector<std::string>& sizes);
// A constant of the type ModbusRegisterMap.
void emit_register_map(const RegisterMap& map, const std::string& constant, Text& out);

// Tables: what the executive reads.
void emit_slot_records(const Model& model, const ApplicationNames& names, Text& out);
void emit_queue_records(const Model& model, const ApplicationNames& names, Text& out);
void emit_thread_records(const Model& model, const ApplicationNames& names, Text& out);
void emit_ranges(const Model& model, Text& out);  // "ranges_table", or nothing

// "a, b, c" of what `make` gives for each; and the array of it with a name, or nothing when there is none.
template <class Rows, class Make>
std::string list_of(const Rows& rows, const Make& make) {
  std::string list;
  for (const auto& row : rows) list += (list.empty() ? "" : ", ") + make(row);
  return list;
}
inline void emit_array(std::string_view type, const std::string& name, const std::string& list, Text& out) {
  if (!list.empty()) out << type << " " << name << "[] = {" << list << "};\n";
}
inline std::string array_or_none(const std::string& name, const std::string& list) {
  return list.empty() ? "{}" : name;
}

}  // namespace flexrf::config_gen
