#include "runtime/realtime/process_statistics.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace flexrf {

namespace {

/// The text of a file in /proc.
struct ProcText {
  Status read_from(const char* path) noexcept {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
      return Status::error(errno == ENOENT ? StatusCode::not_found : StatusCode::unavailable,
                           "cannot read %s: %s", path, strerrordesc_np(errno));
    std::size_t size = 0;
    ssize_t count = 0;
    while (size < sizeof(text) - 1 && (count = read(file, text + size, sizeof(text) - 1 - size)) > 0)
      size += static_cast<std::size_t>(count);
    const int cause = errno;
    close(file);
    text[size] = '\0';
    // A thread that ends between open and read answers ESRCH.
    if (count < 0 || size == 0)
      return Status::error(StatusCode::not_found, "cannot read %s: %s", path,
                           count < 0 ? strerrordesc_np(cause) : "it is empty");
    return {};
  }
  /// The number behind "name:" at the start of a line; 0 when there is none.
  std::uint64_t number(const char* name) const noexcept {
    const std::size_t length = std::strlen(name);
    for (const char* line = text; line != nullptr; line = std::strchr(line, '\n')) {
      if (*line == '\n') ++line;
      if (std::strncmp(line, name, length) == 0 && line[length] == ':')
        return std::strtoull(line + length + 1, nullptr, 10);
    }
    return 0;
  }

  char text[8192];
};

}  // namespace

Result<ThreadStatistics> read_thread_statistics(pid_t id, const char* process) noexcept {
  char path[256];
  ProcText file;
  std::snprintf(path, sizeof(path), "%s/task/%d/stat", process, id);
  if (Status status = file.read_from(path); !status) return status;
  // The name, in parentheses, may hold anything: fields count from behind the last one. proc(5): minflt is
  // the 10th field, majflt the 12th, processor the 39th; behind the name comes the 3rd.
  const char* at = std::strrchr(file.text, ')');
  ThreadStatistics statistics;
  int field = 2;
  while (at != nullptr && field < 39) {
    at = std::strchr(at + 1, ' ');
    if (at == nullptr) break;
    ++field;
    if (field == 10) statistics.minor_faults = std::strtoull(at, nullptr, 10);
    if (field == 12) statistics.major_faults = std::strtoull(at, nullptr, 10);
    if (field == 39) statistics.cpu = static_cast<int>(std::strtol(at, nullptr, 10));
  }
  if (at == nullptr)
    return Status::error(StatusCode::unavailable, "%s ends after field %d of 39", path, field);
  std::snprintf(path, sizeof(path), "%s/task/%d/status", process, id);
  if (Status status = file.read_from(path); !status) return status;
  statistics.voluntary_switches = file.number("voluntary_ctxt_switches");
  statistics.involuntary_switches = file.number("nonvoluntary_ctxt_switches");
  return statistics;
}

Result<ProcessStatistics> read_process_statistics(const char* process) noexcept {
  char path[256];
  ProcText file;
  std::snprintf(path, sizeof(path), "%s/status", process);
  if (Status status = file.read_from(path); !status) return status;
  ProcessStatistics statistics;
  statistics.locked = file.number("VmLck") * 1024;
  statistics.resident = file.number("VmRSS") * 1024;
  statistics.resident_peak = file.number("VmHWM") * 1024;
  statistics.mapped = file.number("VmSize") * 1024;
  statistics.threads = static_cast<int>(file.number("Threads"));
  return statistics;
}

}  // namespace flexrf
