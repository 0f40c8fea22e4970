#include "runtime/realtime/process_statistics.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include "tests/cmocka.hpp"

namespace flexrf::process_statistics_test {
namespace {

/// As the kernel tells the thread itself.
std::uint64_t voluntary_switches() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_nvcsw);
}

void counts_of_this_thread_rise(void**) {
  const auto before = read_thread_statistics(gettid());
  assert_true(static_cast<bool>(before));
  constexpr std::size_t size = 64 * 4096;
  auto* const memory = static_cast<volatile char*>(
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  assert_ptr_not_equal(memory, MAP_FAILED);
  madvise(const_cast<char*>(memory), size, MADV_NOHUGEPAGE);
  for (std::size_t i = 0; i < size; i += 4096) memory[i] = 1;
  munmap(const_cast<char*>(memory), size);
  // A sleep that is over before the thread is asleep, as it was kept from its CPU, is no switch.
  const std::uint64_t switches = voluntary_switches();
  while (voluntary_switches() < switches + 5) {
    const timespec moment{0, 1'000'000};
    nanosleep(&moment, nullptr);
  }
  const auto after = read_thread_statistics(gettid());
  assert_true(static_cast<bool>(after));
  assert_true(after->minor_faults >= before->minor_faults + 64);
  assert_true(after->voluntary_switches >= before->voluntary_switches + 5);
  assert_true(after->cpu >= 0);
}

void process_has_memory_and_threads(void**) {
  const auto statistics = read_process_statistics();
  assert_true(static_cast<bool>(statistics));
  assert_true(statistics->resident > 0);
  assert_true(statistics->resident_peak >= statistics->resident);
  assert_true(statistics->mapped >= statistics->resident);
  assert_true(statistics->threads >= 1);
}

void write_text(const std::string& path, const char* text) {
  std::FILE* const file = std::fopen(path.c_str(), "w");
  std::fputs(text, file);
  std::fclose(file);
}

struct Read {
  ThreadStatistics thread;
  ProcessStatistics process;
  Status shortened;
};

/// Reads files in the kernel's form, with a thread's name that tries to deceive.
Read read_made_up_process() {
  char folder[] = "/tmp/flexrf-proc-XXXXXX";
  if (mkdtemp(folder) == nullptr) return {};
  const std::string root = folder;
  mkdir((root + "/task").c_str(), 0700);
  mkdir((root + "/task/7").c_str(), 0700);
  write_text(
      root + "/task/7/stat",
      "7 (a) b 9 9 9 9 9) S 1 2 3 4 5 6 1001 8 33 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 "
      "28 29 30 31 32 33 34 35 3 37 38\n");
  write_text(root + "/task/7/status",
             "Name:\tx\nvoluntary_ctxt_switches:\t41\nnonvoluntary_ctxt_switches:\t42\n");
  write_text(
      root + "/status",
      "Name:\tx\nVmSize:\t  400 kB\nVmLck:\t   100 kB\nVmHWM:\t 300 kB\nVmRSS:\t 200 kB\nThreads:\t5\n");
  Read read;
  const auto thread = read_thread_statistics(7, folder);
  if (thread) read.thread = *thread;
  const auto process = read_process_statistics(folder);
  if (process) read.process = *process;
  write_text(root + "/task/7/stat", "7 (a) S 1 2 3");
  read.shortened = read_thread_statistics(7, folder).status();
  for (const char* const file : {"/task/7/stat", "/task/7/status", "/status"}) unlink((root + file).c_str());
  rmdir((root + "/task/7").c_str());
  rmdir((root + "/task").c_str());
  rmdir(folder);
  return read;
}

void fields_are_where_proc_says(void**) {
  const Read read = read_made_up_process();
  assert_int_equal(read.thread.minor_faults, 1001);
  assert_int_equal(read.thread.major_faults, 33);
  assert_int_equal(read.thread.cpu, 3);
  assert_int_equal(read.thread.voluntary_switches, 41);
  assert_int_equal(read.thread.involuntary_switches, 42);
  assert_int_equal(read.process.mapped, 400 * 1024);
  assert_int_equal(read.process.locked, 100 * 1024);
  assert_int_equal(read.process.resident_peak, 300 * 1024);
  assert_int_equal(read.process.resident, 200 * 1024);
  assert_int_equal(read.process.threads, 5);
  assert_non_null(strstr(read.shortened.cause(), "ends after field 6 of 39"));
}

void a_thread_that_is_gone_is_not_found(void**) {
  const auto statistics = read_thread_statistics(1 << 30);
  assert_false(static_cast<bool>(statistics));
  assert_int_equal(statistics.status().code(), StatusCode::not_found);
}

}  // namespace
}  // namespace flexrf::process_statistics_test

int main() {
  using namespace flexrf::process_statistics_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(counts_of_this_thread_rise),
      cmocka_unit_test(process_has_memory_and_threads),
      cmocka_unit_test(fields_are_where_proc_says),
      cmocka_unit_test(a_thread_that_is_gone_is_not_found),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
