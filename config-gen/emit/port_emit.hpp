// Ports as members of generated base classes: those of units, interfaces and drivers alike.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

// What a table declares; no inputs of an interface, no devices but of a unit.
struct Ports {
  std::vector<InputPort> inputs;
  std::vector<OutputPort> outputs;
  std::vector<DevicePort> devices = {};

  bool empty() const { return inputs.empty() && outputs.empty() && devices.empty(); }
};

void add_port_includes(const Model& model, const Ports& ports, std::set<std::string>& own);
// As members, without the devices.
void declare_ports(const Model& model, const Space& space, const Ports& ports, Text& members);
// The lines of connect() that connect them. `before`: outputs that come first in the binding.
void connect_ports(const Ports& ports, const std::vector<OutputPort>& before, Text& out);
// input_counters(), where there are inputs of slots: reports ask each by its number what it has read.
void declare_input_counters(const Space& space, const Ports& ports, Text& out);
void define_input_counters(const Space& space, const std::string& class_name, const Ports& ports, Text& out);
// The array of PortDescriptors of this name, where there are ports.
void define_ports(const Model& model, const Space& space, const std::string& name, const Ports& ports,
                  Text& out);

}  // namespace flexrf::config_gen
