#include "runtime/realtime/machine_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>

namespace flexrf {

namespace {

std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

int length_of(std::string_view text) noexcept {
  return static_cast<int>(std::min<std::size_t>(text.size(), 60));
}

/// Whole contents of a small file; false leaves errno.
bool read_small_file(const char* path, std::string& text) {
  std::FILE* const file = std::fopen(path, "re");
  if (file == nullptr) return false;
  char buffer[4096];
  std::size_t size = 0;
  while (text.size() < 65536 && (size = std::fread(buffer, 1, sizeof(buffer), file)) > 0)
    text.append(buffer, size);
  const bool good = std::ferror(file) == 0;
  std::fclose(file);
  return good;
}

}  // namespace

MachineFile MachineFile::by_default(const CpuSet& allowed, const CpuSet& isolated) noexcept {
  MachineFile machine;
  machine.allowed_ = allowed;
  CpuSet realtime = isolated.common_with(allowed);
  if (realtime.is_empty()) {
    realtime = CpuSet::of(allowed.highest());
    if (allowed.count() > 2) realtime.add(allowed.without(realtime).highest());
  }
  machine.control_ = CpuSet::of(realtime.highest());
  machine.io_ = CpuSet::of(realtime.lowest());
  machine.any_ = realtime;
  return machine;
}

Result<MachineFile> MachineFile::parse(std::string_view text, const char* name, const CpuSet& allowed,
                                       const CpuSet& isolated) {
  MachineFile machine = by_default(allowed, isolated);
  struct RoleLine {
    std::string_view name;
    CpuSet* cpus;
    int line;
  } roles[] = {{"control", &machine.control_, 0},
               {"io", &machine.io_, 0},
               {"any", &machine.any_, 0},
               {"rest", &machine.rest_, 0}};
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      return Status::error(StatusCode::invalid_argument, "%s:%d: expected ROLE = CPUS, such as: control = 1",
                           name, line_number);
    const std::string_view key = trimmed(line.substr(0, equals));
    std::string_view value = trimmed(line.substr(equals + 1));
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    RoleLine* const role =
        std::find_if(std::begin(roles), std::end(roles), [key](const RoleLine& r) { return r.name == key; });
    if (role == std::end(roles))
      return Status::error(StatusCode::invalid_argument,
                           "%s:%d: no role is called '%.*s'; there are control, io, any and rest", name,
                           line_number, length_of(key), key.data());
    if (role->line != 0)
      return Status::error(StatusCode::invalid_argument, "%s:%d: %.*s was already given in line %d", name,
                           line_number, length_of(key), key.data(), role->line);
    role->line = line_number;
    const Result<CpuSet> cpus = CpuSet::parse(value);
    if (!cpus)
      return Status::error(StatusCode::invalid_argument, "%s:%d: %s", name, line_number,
                           cpus.status().cause());
    if (cpus->is_empty())
      return Status::error(StatusCode::invalid_argument, "%s:%d: %.*s needs at least one CPU", name,
                           line_number, length_of(key), key.data());
    const CpuSet beyond = cpus->without(allowed);
    if (!beyond.is_empty())
      return Status::error(StatusCode::invalid_argument,
                           "%s:%d: CPU %s is not there or not allowed to this process, which has %s", name,
                           line_number, CpuText(beyond).text, CpuText(allowed).text);
    *role->cpus = *cpus;
  }
  return machine;
}

Result<MachineFile> MachineFile::read(const char* path, const CpuSet& allowed, const CpuSet& isolated) {
  std::string text;
  if (!read_small_file(path, text)) {
    const int cause = errno;
    return Status::error(cause == ENOENT ? StatusCode::not_found : StatusCode::unavailable,
                         "cannot read %s: %s", path, strerrordesc_np(cause));
  }
  return parse(text, path, allowed, isolated);
}

Result<MachineFile> MachineFile::of_this_machine(const char* path) {
  const CpuSet allowed = CpuSet::allowed();
  const CpuSet isolated = isolated_cpus();
  Result<MachineFile> machine = read(path, allowed, isolated);
  if (!machine && machine.status().code() == StatusCode::not_found) return by_default(allowed, isolated);
  return machine;
}

const CpuSet& MachineFile::cpus_of(CpuRole role) const noexcept {
  switch (role) {
    case CpuRole::control:
      return control_;
    case CpuRole::io:
      return io_;
    case CpuRole::any:
      return any_;
    case CpuRole::rest:
      return rest_;
  }
  return any_;
}

CpuSet MachineFile::rest(const CpuSet& claimed) const noexcept {
  if (!rest_.is_empty()) return rest_;
  const CpuSet left = allowed_.without(claimed);
  return left.is_empty() ? allowed_ : left;
}

CpuSet isolated_cpus(const char* path) noexcept {
  std::FILE* const file = std::fopen(path, "re");
  if (file == nullptr) return {};
  char text[512];
  const std::size_t size = std::fread(text, 1, sizeof(text), file);
  std::fclose(file);
  const Result<CpuSet> cpus = CpuSet::parse(std::string_view(text, size));
  return cpus ? *cpus : CpuSet{};
}

}  // namespace flexrf
