// A library for LD_PRELOAD: counts what the panel's threads ask of the memory allocator, and pictures that
// are encoded. The applications' own allocation guard passes calls on to the C library under these names.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "benchmarks/panel/counts.hpp"

namespace {

using flexrf::bench::Counts;

Counts nowhere{};
Counts* counts = &nowhere;

[[gnu::constructor]] void open_counts() {
  const char* const path = std::getenv("FLEXRF_BENCH_COUNTS");
  const int file = path == nullptr ? -1 : open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0 || ftruncate(file, sizeof(Counts)) != 0) return;
  void* const memory = mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory != MAP_FAILED) counts = static_cast<Counts*>(memory);
  close(file);
}

std::atomic<std::uint64_t> others;

/// Where the calling thread's calls are counted. A thread gets its name when it begins, and keeps it.
std::atomic<std::uint64_t>& counter() noexcept {
  static thread_local std::atomic<std::uint64_t>* known [[gnu::tls_model("initial-exec")]] = nullptr;
  if (known != nullptr) return *known;
  char name[16] = {};
  prctl(PR_GET_NAME, name);
  if (std::strcmp(name, "panel") == 0) known = &counts->allocations;
  if (std::strcmp(name, "panel-pictures") == 0) known = &counts->encoders_allocations;
  return known == nullptr ? others : *known;
}

void count() noexcept {
  counter().fetch_add(1, std::memory_order_relaxed);
}

template <class Function>
Function next(const char* name) noexcept {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size) noexcept {
  static const auto original = next<void* (*)(std::size_t)>("__libc_malloc");
  count();
  return original(size);
}

void __libc_free(void* memory) noexcept {
  static const auto original = next<void (*)(void*)>("__libc_free");
  count();
  original(memory);
}

void* __libc_calloc(std::size_t number, std::size_t size) noexcept {
  static const auto original = next<void* (*)(std::size_t, std::size_t)>("__libc_calloc");
  count();
  return original(number, size);
}

void* __libc_realloc(void* memory, std::size_t size) noexcept {
  static const auto original = next<void* (*)(void*, std::size_t)>("__libc_realloc");
  count();
  return original(memory, size);
}

void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept {
  static const auto original = next<void* (*)(std::size_t, std::size_t)>("__libc_memalign");
  count();
  return original(alignment, size);
}

int tjCompress2(void* handle, const unsigned char* source, int width, int pitch, int height, int format,
                unsigned char** jpeg, unsigned long* size, int sampling, int quality, int flags) {
  using Compress = int (*)(void*, const unsigned char*, int, int, int, int, unsigned char**, unsigned long*,
                           int, int, int);
  static const auto original = next<Compress>("tjCompress2");
  counts->encodings.fetch_add(1, std::memory_order_relaxed);
  return original(handle, source, width, pitch, height, format, jpeg, size, sampling, quality, flags);
}
}
