// A whole file as text.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace flexrf::config_gen {

/// Byte for byte; empty when there is no such file. Throws std::runtime_error with the file's name when it is
/// there and cannot be read.
inline std::string contents_of(const std::filesystem::path& file) {
  const auto failed = [&file] {
    return std::runtime_error("cannot read " + file.generic_string() + ": " + std::strerror(errno));
  };
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open() && (errno == ENOENT || errno == ENOTDIR)) return "";
  if (!stream.is_open()) throw failed();
  try {
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {
    throw failed();
  }
}

}  // namespace flexrf::config_gen
