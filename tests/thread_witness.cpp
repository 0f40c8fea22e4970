// Preloaded to the tests of the release build that do not declare THREADS (flexrf_add_test) and are no whole
// cells in real time: one that starts a thread all the same ends here, as the thread sanitizer, which gets
// the others only, would not see it.
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

// That of glibc, which both the standard library and code of ours come by.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                              void* argument) {
  const char* const test = std::getenv("FLEXRF_WITHOUT_THREADS");
  if (test != nullptr && std::strcmp(test, program_invocation_short_name) == 0) {  // not one that it starts
    const std::string message =
        std::string("\nflexrf: ") + test +
        " starts a thread: write THREADS into its flexrf_add_test, so that the thread "
        "sanitizer judges it\n";
    static_cast<void>(!write(STDERR_FILENO, message.data(), message.size()));
    std::abort();
  }
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, run, argument);
}
