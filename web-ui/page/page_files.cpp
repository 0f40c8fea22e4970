// The page as embed.mjs packs it: page.data holds its files one after the other, and page_rows.inc says
// what they are.
#include "web-ui/server/files.hpp"

// The assembler finds the file in the folders that the compiler searches for headers.
asm(".section .rodata\n"
    "flexrf_page:\n"
    ".incbin \"page.data\"\n"
    ".previous\n");
extern const char flexrf_page[] asm("flexrf_page");

namespace flexrf::panel {

std::span<const PageFile> page_files() noexcept {
  static const PageFile files[] = {
#include "page_rows.inc"
  };
  return files;
}

}  // namespace flexrf::panel
