// urdf_header URDF CONSTANT HEADER: writes the URDF's chain as flexrf::CONSTANT.
#include <fstream>
#include <iostream>

#include "config-gen/urdf/urdf_reader.hpp"

int main(int argc, char** argv) {
  using namespace flexrf::config_gen;
  if (argc != 4) {
    std::cerr << "usage: urdf_header URDF CONSTANT HEADER\n";
    return 1;
  }
  Diagnostics diagnostics;
  UrdfRow row;
  row.position = {intern(argv[1])};
  const auto chain = read_urdf(argv[1], row, diagnostics);
  diagnostics.print(std::cerr);
  if (!chain) return 1;
  std::ofstream header(argv[3]);
  header << "#pragma once\n\n#include \"" << kinematic_chain_header << "\"\n\nnamespace flexrf {\n\n"
         << "inline constexpr KinematicChain " << argv[2] << " = " << emit_kinematic_chain(*chain)
         << ";\n\n}  // namespace flexrf\n";
  header.close();
  if (!header) {
    std::cerr << argv[3] << ": cannot be written\n";
    return 1;
  }
  return 0;
}
