// The main() of a program of several tests (FAMILY of flexrf_add_test), for the one source file that defines
// FLEXRF_TESTS as TEST(name) for each of them. The main() of a test's own source is called name_main() there.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>

#define TEST(name) int name##_main();
FLEXRF_TESTS
#undef TEST

/// Runs the test that the only argument names.
int main(int count, char** arguments) {
  struct Test {
    const char* name;
    int (*run)();
  };
#define TEST(name) Test{#name, name##_main},
  const Test tests[] = {FLEXRF_TESTS};
#undef TEST
  for (const Test& test : tests) {
    if (count != 2 || std::strcmp(arguments[1], test.name) != 0) continue;
    program_invocation_short_name = arguments[1];  // thread_witness.cpp names the test by it
    return test.run();
  }
  std::fprintf(stderr, "usage: %s TEST, where TEST is one of:\n", program_invocation_short_name);
  for (const Test& test : tests) std::fprintf(stderr, "  %s\n", test.name);
  return 2;
}
