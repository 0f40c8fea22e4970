// config-gen-parts: what tables name of each other and of the system, for a build that is being configured
// (config-gen/read/parts.hpp).
//
//   config-gen-parts (--application | --unit | --interface | --driver) FILE...
//
// The lines of each file follow a line "table FILE". Ends with 2 when it is called otherwise.
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include "config-gen/read/parts.hpp"

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen;
  const std::map<std::string, Target::Kind> kinds = {{"--application", Target::Kind::application},
                                                     {"--unit", Target::Kind::unit},
                                                     {"--interface", Target::Kind::interface},
                                                     {"--driver", Target::Kind::driver}};
  const auto kind = argument_count < 3 ? kinds.end() : kinds.find(arguments[1]);
  if (kind == kinds.end()) {
    std::cerr << "usage: config-gen-parts (--application | --unit | --interface | --driver) FILE...\n";
    return 2;
  }
  for (int index = 2; index < argument_count; ++index)
    std::cout << "table " << arguments[index] << '\n' << list_parts(kind->second, arguments[index]);
  return std::cout.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
}
