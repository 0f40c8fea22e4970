#include "hal/driver/simulator/simulator_program.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "base/standard_descriptors.hpp"

namespace flexrf {

int run_simulator(SimulatorProgram& program, const char* name, const char* usage, int count, char** words) {
  hold_standard_descriptors();
  CommandLine line(count, words);
  if (!program.read(line) || !line.is_understood()) {
    std::fputs(usage, stderr);
    return 2;
  }
  if (const Status status = program.begin(); !status) {
    std::fprintf(stderr, "%s: %s\n", name, status.cause());
    return 1;
  }
  std::cout << program.place() << std::endl;
  for (std::string said; std::getline(std::cin, said);) std::cout << program.answer(said) << std::endl;
  while (true) pause();
}

}  // namespace flexrf
