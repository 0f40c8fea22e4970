#include "runtime/realtime/thread_setup.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace flexrf {

namespace {

enum Verdict { wait_for_it, begin, end };

constexpr std::size_t default_stack_size = 256 * 1024;

// Sanitizers keep megabytes of thread-local storage on a thread's stack: it is then allocated, whatever is
// given, and larger.
#if FLEXRF_SANITIZER
constexpr std::size_t sanitizer_stack_size = 4 * 1024 * 1024;
#else
constexpr std::size_t sanitizer_stack_size = 0;
#endif

std::size_t page_size() noexcept {
  return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Refuses an address at which the kernel, told to read there, meets memory.
Status check_guard(const void* address, const char* thread) noexcept {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
    return Status::error(StatusCode::unavailable,
                         "whether the stack of thread %s has a guard cannot be found out: pipe: %s", thread,
                         strerrordesc_np(errno));
  const bool refused = write(ends[1], address, 1) < 0 && errno == EFAULT;
  close(ends[0]);
  close(ends[1]);
  if (refused) return {};
  return Status::error(StatusCode::internal, "the stack of thread %s has no guard", thread);
}

/// Faults in every page of a stack that nobody uses yet.
void prefault(std::byte* from, std::size_t size, std::size_t page) noexcept {
  for (std::size_t offset = 0; offset < size; offset += page)
    *static_cast<volatile std::byte*>(from + offset) = std::byte{0};
}

/// Thread attributes that are destroyed again.
struct Attributes {
  Attributes() noexcept { pthread_attr_init(&value); }
  ~Attributes() { pthread_attr_destroy(&value); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  pthread_attr_t value{};
};

}  // namespace

std::size_t minimal_stack_size() noexcept {
  // The system's minimum, which also holds thread-local storage, and room for a step's frames, beside the
  // guard.
  const long least = sysconf(_SC_THREAD_STACK_MIN);
  const std::size_t wanted = static_cast<std::size_t>(least > 0 ? least : PTHREAD_STACK_MIN) + 16 * 1024;
  const std::size_t page = page_size();
  return (wanted + page - 1) / page * page + page;
}

RunningThread::~RunningThread() {
  join();
}

void* RunningThread::trampoline(void* self) {
  auto& thread = *static_cast<RunningThread*>(self);
  thread.frame_ = __builtin_frame_address(0);
  thread.announced_.store(gettid(), std::memory_order_release);
  thread.announced_.notify_one();
  thread.verdict_.wait(wait_for_it, std::memory_order_acquire);
  if (thread.verdict_.load(std::memory_order_acquire) == begin) thread.body_(thread.argument_);
  return nullptr;
}

Status RunningThread::start(const ThreadSettings& settings, void (*body)(void*), void* argument) noexcept {
  if (started_) return Status::error(StatusCode::busy, "thread %s has been started already", settings.name);
  const std::size_t page = page_size();
  stack_is_own_ = settings.stack == nullptr;
  stack_size_ = settings.stack_size == 0 && stack_is_own_ ? default_stack_size : settings.stack_size;
  if (stack_size_ < minimal_stack_size() || stack_size_ % page != 0)
    return Status::error(StatusCode::invalid_argument,
                         "the stack of thread %s has %zu bytes; it needs at least %zu, in whole pages of %zu",
                         settings.name, stack_size_, minimal_stack_size(), page);
  if (!stack_is_own_ && reinterpret_cast<std::uintptr_t>(settings.stack) % page != 0)
    return Status::error(StatusCode::invalid_argument, "the stack of thread %s is not page-aligned",
                         settings.name);
  if (sanitizer_stack_size > 0) {
    stack_is_own_ = true;
    stack_size_ += sanitizer_stack_size;
  }
  if (stack_is_own_) {
    void* const memory = mmap(nullptr, stack_size_, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED && errno == EAGAIN)  // mmap(2): what is mapped is locked, and that is limited
      return Status::error(StatusCode::not_permitted,
                           "the stack of thread %s cannot be locked: RLIMIT_MEMLOCK is too low, and "
                           "CAP_IPC_LOCK is not held",
                           settings.name);
    if (memory == MAP_FAILED)
      return Status::error(StatusCode::unavailable, "no memory for the stack of thread %s: %s", settings.name,
                           strerrordesc_np(errno));
    stack_ = static_cast<std::byte*>(memory);
  } else {
    stack_ = static_cast<std::byte*>(settings.stack);
  }
  body_ = body;
  argument_ = argument;
  announced_.store(0, std::memory_order_relaxed);
  verdict_.store(wait_for_it, std::memory_order_relaxed);
  const CpuSet cpus = settings.cpus.is_empty() ? CpuSet::allowed() : settings.cpus;
  Status status = create(settings, cpus);
  if (!status) {
    finish();
    return status;
  }
  announced_.wait(0, std::memory_order_acquire);
  id_ = announced_.load(std::memory_order_acquire);
  status = read_back(settings, cpus);
  verdict_.store(status ? begin : end, std::memory_order_release);
  verdict_.notify_one();
  started_ = true;
  if (!status) join();
  return status;
}

Status RunningThread::create(const ThreadSettings& settings, const CpuSet& cpus) noexcept {
  const std::size_t page = page_size();
  if (mprotect(stack_, page, PROT_NONE) != 0)
    return Status::error(StatusCode::internal, "the stack of thread %s cannot be guarded: %s", settings.name,
                         strerrordesc_np(errno));
  prefault(stack_ + page, stack_size_ - page, page);
  Attributes attributes;
  const bool is_realtime = settings.priority > 0;
  sched_param parameters{};
  parameters.sched_priority = settings.priority;
  // Never what the creator happens to be: a helper made by a real-time thread is not real-time.
  int error = pthread_attr_setinheritsched(&attributes.value, PTHREAD_EXPLICIT_SCHED);
  if (error == 0)
    error = pthread_attr_setschedpolicy(&attributes.value, is_realtime ? SCHED_FIFO : SCHED_OTHER);
  if (error == 0) error = pthread_attr_setschedparam(&attributes.value, &parameters);
  if (error == 0) error = pthread_attr_setaffinity_np(&attributes.value, sizeof(cpu_set_t), &cpus.mask());
  if (error == 0) error = pthread_attr_setstack(&attributes.value, stack_ + page, stack_size_ - page);
  if (error == 0) error = pthread_create(&handle_, &attributes.value, &trampoline, this);
  if (error == EPERM)
    return Status::error(StatusCode::not_permitted,
                         "thread %s may not have SCHED_FIFO priority %d: RLIMIT_RTPRIO is too low and "
                         "CAP_SYS_NICE is not held",
                         settings.name, settings.priority);
  if (error != 0)
    return Status::error(StatusCode::invalid_argument,
                         "thread %s cannot be created with priority %d on CPU %s: %s", settings.name,
                         settings.priority, CpuText(cpus).text, strerrordesc_np(error));
  char short_name[16];
  std::snprintf(short_name, sizeof(short_name), "%.15s", settings.name);
  pthread_setname_np(handle_, short_name);
  return {};
}

Status RunningThread::read_back(const ThreadSettings& settings, const CpuSet& cpus) const noexcept {
  // From the kernel: the C library would repeat what it was told.
  const int wanted_policy = settings.priority > 0 ? SCHED_FIFO : SCHED_OTHER;
  const int policy = sched_getscheduler(id_);
  sched_param parameters{};
  sched_getparam(id_, &parameters);
  if (policy != wanted_policy || parameters.sched_priority != settings.priority)
    return Status::error(
        StatusCode::internal,
        "thread %s was to have policy %d with priority %d, the kernel gave policy %d with %d", settings.name,
        wanted_policy, settings.priority, policy, parameters.sched_priority);
  cpu_set_t mask;
  CPU_ZERO(&mask);
  sched_getaffinity(id_, sizeof(mask), &mask);
  if (!(CpuSet(mask) == cpus))
    return Status::error(StatusCode::internal, "thread %s was to run on CPU %s, the kernel gave %s",
                         settings.name, CpuText(cpus).text, CpuText(CpuSet(mask)).text);
  const auto* const frame = static_cast<const std::byte*>(frame_);
  if (frame < stack_ || frame >= stack_ + stack_size_)
    return Status::error(StatusCode::internal, "thread %s does not run on the stack it was given",
                         settings.name);
  return check_guard(stack_, settings.name);
}

void RunningThread::join() noexcept {
  if (!started_) return;
  pthread_join(handle_, nullptr);
  started_ = false;
  finish();
}

void RunningThread::finish() noexcept {
  if (stack_is_own_)
    munmap(stack_, stack_size_);
  else
    mprotect(stack_, page_size(), PROT_READ | PROT_WRITE);
  stack_ = nullptr;
}

}  // namespace flexrf
