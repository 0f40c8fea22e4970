#include "web-ui/server/ordinary_memory.hpp"

#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <string_view>

namespace flexrf::panel {
namespace {

constexpr std::string_view libraries[] = {"/libcrypto.so", "/libssl.so", "/libturbojpeg.so",
                                          "/libsimdjson.so", "/libsodium.so"};

void unlock(std::uintptr_t begin, std::size_t size) noexcept {
  void* const address = reinterpret_cast<void*>(begin);
  // A page that is still locked is not given back, which munlock's failure would mean: nothing is lost then.
  if (munlock(address, size) == 0) madvise(address, size, MADV_DONTNEED);
}

int unlock_library(dl_phdr_info* info, std::size_t /*size*/, void* /*argument*/) noexcept {
  const std::string_view name{info->dlpi_name};
  const bool is_one = std::any_of(std::begin(libraries), std::end(libraries), [name](std::string_view one) {
    return name.find(one) != std::string_view::npos;
  });
  if (!is_one) return 0;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  for (ElfW(Half) i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = info->dlpi_phdr[i];
    // What was written to is not in the file.
    if (part.p_type != PT_LOAD || (part.p_flags & PF_W) != 0) continue;
    const std::uintptr_t begin = (info->dlpi_addr + part.p_vaddr) / page * page;
    const std::uintptr_t end = (info->dlpi_addr + part.p_vaddr + part.p_memsz) / page * page;
    if (end > begin) unlock(begin, end - begin);
  }
  return 0;
}

}  // namespace

void OrdinaryMemoryRelease::operator()(char* memory) const noexcept {
  munmap(memory, size);
}

OrdinaryMemory make_ordinary_memory(std::size_t size) {
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc{};
  return OrdinaryMemory{static_cast<char*>(memory), OrdinaryMemoryRelease{size}};
}

void unlock(const OrdinaryMemory& memory) noexcept {
  unlock(reinterpret_cast<std::uintptr_t>(memory.get()), memory.get_deleter().size);
}

void unlock_libraries() noexcept {
  dl_iterate_phdr(unlock_library, nullptr);
}

}  // namespace flexrf::panel
