#include "tests/beside_program.hpp"

#include <cstring>
#include <filesystem>

namespace flexrf {

const char* beside_program(const char* path) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  std::filesystem::path found = (program.parent_path() / path).lexically_normal();
  if (!found.has_filename()) found = found.parent_path();  // what ends with ".." gets a slash
  return strdup(found.c_str());
}

}  // namespace flexrf
