// Reads what a counting library writes while the application runs.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "benchmarks/panel/counts.hpp"

namespace flexrf::bench {

class CountsFile {
 public:
  explicit CountsFile(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file >= 0) memory_ = mmap(nullptr, sizeof(Counts), PROT_READ, MAP_SHARED, file, 0);
    if (memory_ == MAP_FAILED) std::perror(path.c_str());
    if (file >= 0) close(file);
  }
  CountsFile(const CountsFile&) = delete;
  CountsFile& operator=(const CountsFile&) = delete;
  ~CountsFile() {
    if (memory_ != MAP_FAILED) munmap(memory_, sizeof(Counts));
  }

  explicit operator bool() const noexcept { return memory_ != MAP_FAILED; }
  const Counts* operator->() const noexcept { return static_cast<const Counts*>(memory_); }

 private:
  void* memory_ = MAP_FAILED;
};

}  // namespace flexrf::bench
