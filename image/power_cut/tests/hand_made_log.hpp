// Logs written byte by byte as the kernel's documentation has them, and files for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::power_cut {

inline constexpr std::uint64_t flush_flag = 1;
inline constexpr std::uint64_t fua_flag = 2;
inline constexpr std::uint64_t discard_flag = 4;
inline constexpr std::uint64_t mark_flag = 8;

class Folder {
 public:
  Folder() {
    char name[] = "/tmp/flexrf-power-cut-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

inline std::string write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::string little_endian(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFF);
  return bytes;
}

/// What stands in each 512 bytes of a write: nothing else on the disk is the same.
inline std::string marked_bytes(std::uint64_t entry, std::uint64_t piece) {
  std::string bytes = "entry " + std::to_string(entry) + " piece " + std::to_string(piece) + ' ';
  bytes.resize(512, '.');
  return bytes;
}

struct HandMadeLog {
  std::uint64_t magic = 0x6a736677736872;
  std::uint64_t version = 1;
  std::uint64_t sector_size = 512;
  std::uint64_t count = 0;  ///< entries, as the log's head says; add() counts
  std::string body;

  /// An entry with `sectors` of marked bytes, if it is none of those that have no data.
  void add(std::uint64_t sector, std::uint64_t sectors, std::uint64_t flags, const std::string& text = "") {
    std::string head = little_endian(sector, 8) + little_endian(sectors, 8) + little_endian(flags, 8) +
                       little_endian(text.size(), 8) + text;
    head.resize(sector_size, '\0');
    body += head;
    if ((flags & (discard_flag | mark_flag)) == 0)
      for (std::uint64_t piece = 0; piece < sectors * sector_size / 512; ++piece)
        body += marked_bytes(count, piece);
    ++count;
  }
  std::string bytes() const {
    std::string head = little_endian(magic, 8) + little_endian(version, 8) + little_endian(count, 8) +
                       little_endian(sector_size, 4);
    head.resize(sector_size, '\0');
    return head + body;
  }
};

}  // namespace flexrf::power_cut
