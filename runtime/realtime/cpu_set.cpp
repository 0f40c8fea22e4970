#include "runtime/realtime/cpu_set.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace flexrf {

CpuSet CpuSet::allowed() noexcept {
  CpuSet set;
  if (sched_getaffinity(getpid(), sizeof(set.mask_), &set.mask_) != 0) set.add(0);
  return set;
}

Result<CpuSet> CpuSet::parse(std::string_view text) noexcept {
  CpuSet set;
  const auto refused = [text](const char* why) {
    return Status::error(StatusCode::invalid_argument, "'%.*s' is no list of CPUs such as 0-2,5: %s",
                         static_cast<int>(std::min<std::size_t>(text.size(), 60)), text.data(), why);
  };
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto blank = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\n')) ++at;
  };
  blank();
  while (at != end) {
    unsigned first = 0;
    const auto [after_first, first_error] = std::from_chars(at, end, first);
    if (first_error != std::errc{}) return refused("a number is expected");
    at = after_first;
    unsigned last = first;
    if (at != end && *at == '-') {
      const auto [after_last, last_error] = std::from_chars(at + 1, end, last);
      if (last_error != std::errc{}) return refused("a number is expected after '-'");
      at = after_last;
    }
    if (last < first) return refused("a range runs upwards");
    if (last >= CPU_SETSIZE) return refused("the highest CPU is 1023");
    for (unsigned cpu = first; cpu <= last; ++cpu) set.add(static_cast<int>(cpu));
    blank();
    if (at == end) break;
    if (*at != ',') return refused("',' is expected");
    ++at;
    blank();
    if (at == end) return refused("a number is expected after ','");
  }
  return set;
}

int CpuSet::lowest() const noexcept {
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (contains(cpu)) return cpu;
  return -1;
}

int CpuSet::highest() const noexcept {
  for (int cpu = CPU_SETSIZE - 1; cpu >= 0; --cpu)
    if (contains(cpu)) return cpu;
  return -1;
}

CpuSet CpuSet::united_with(const CpuSet& other) const noexcept {
  CpuSet set;
  CPU_OR(&set.mask_, &mask_, &other.mask_);
  return set;
}

CpuSet CpuSet::common_with(const CpuSet& other) const noexcept {
  CpuSet set;
  CPU_AND(&set.mask_, &mask_, &other.mask_);
  return set;
}

CpuSet CpuSet::without(const CpuSet& other) const noexcept {
  CpuSet set;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (contains(cpu) && !other.contains(cpu)) set.add(cpu);
  return set;
}

const char* CpuSet::write(char* text, std::size_t capacity) const noexcept {
  text[0] = '\0';
  std::size_t used = 0;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!contains(cpu)) continue;
    int last = cpu;
    while (contains(last + 1)) ++last;
    const char* const comma = used == 0 ? "" : ",";
    const int wanted = last == cpu ? std::snprintf(text + used, capacity - used, "%s%d", comma, cpu)
                                   : std::snprintf(text + used, capacity - used, "%s%d-%d", comma, cpu, last);
    if (wanted < 0 || static_cast<std::size_t>(wanted) >= capacity - used) break;
    used += static_cast<std::size_t>(wanted);
    cpu = last;
  }
  return text;
}

}  // namespace flexrf
