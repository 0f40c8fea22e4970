// libFuzzer's two functions. The last word of the command line that is no option is the folder of the corpus:
// the seeds are written there before it is read.
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
  std::string folder;
  for (int i = 1; i < *count; ++i)
    if ((*words)[i][0] != '-') folder = (*words)[i];
  if (folder.empty()) return 0;
  int number = 0;
  for (const flexrf::fuzz::Bytes& seed : flexrf::fuzz::seeds()) {
    std::ofstream file(folder + "/seed-" + std::to_string(number++), std::ios::binary);
    file.write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
    if (!file.flush()) std::fprintf(stderr, "no seed could be written to %s\n", folder.c_str());
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  flexrf::fuzz::take({data, size});
  return 0;
}
