#include "runtime/executive/file_options.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/parameters/durable_file.hpp"

namespace flexrf {
namespace {

Status refused(const char* option, const std::string& path, const char* why) {
  return Status::error(StatusCode::invalid_argument, "%s %s: %s", option, path.c_str(), why);
}

Status wrong_kind(const char* option, const std::string& path, mode_t mode) {
  return Status::error(StatusCode::invalid_argument, "%s %s: it is %s; name a file", option, path.c_str(),
                       name_of_file_kind(mode));
}

Status check_input(const char* option, const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return refused(option, path, strerrordesc_np(errno));
  if (!S_ISREG(found.st_mode)) return wrong_kind(option, path, found.st_mode);
  if (access(path.c_str(), R_OK) != 0) return refused(option, path, strerrordesc_np(errno));
  return {};
}

/// `folder` is there, which `path` names, or is in.
Status check_folder(const char* option, const std::string& path, const std::string& folder) {
  struct stat found {};
  if (stat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode)) return {};
  return Status::error(StatusCode::invalid_argument, "%s %s: there is no folder '%s'; make it first", option,
                       path.c_str(), folder.c_str());
}

/// It need not be there. `kept`: it is read, too, and replaced as a whole.
Status check_output(const char* option, const std::string& path, bool kept) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) {
    const int cause = errno;
    if (const Status status = check_folder(option, path, folder_of(resolved_path(path))); !status)
      return status;
    if (cause != ENOENT) return refused(option, path, strerrordesc_np(cause));
    if (!kept && access(folder_of(path).c_str(), W_OK | X_OK) != 0)
      return refused(option, path, strerrordesc_np(errno));
    return {};
  }
  // A device, as /dev/null, takes a report.
  if (!S_ISREG(found.st_mode) && (kept || !S_ISCHR(found.st_mode)))
    return wrong_kind(option, path, found.st_mode);
  if (kept) return {};
  if (access(path.c_str(), W_OK) != 0) return refused(option, path, strerrordesc_np(errno));
  // A file is replaced by one that is written beside it.
  const std::string folder = folder_of(resolved_path(path));
  if (S_ISREG(found.st_mode) && access(folder.c_str(), W_OK | X_OK) != 0) {
    return Status::error(StatusCode::invalid_argument, "%s %s: nothing can be written into its folder (%s)",
                         option, path.c_str(), strerrordesc_np(errno));
  }
  return {};
}

/// A report in the place of something else would be its end.
Status check_apart(const std::string& report, const char* option, const std::string& path) {
  if (report.empty()) return {};
  struct stat one {};
  struct stat other {};
  const bool are_there = stat(report.c_str(), &one) == 0 && stat(path.c_str(), &other) == 0;
  const bool is_same = are_there ? one.st_dev == other.st_dev && one.st_ino == other.st_ino
                                 : resolved_path(report) == resolved_path(path);
  if (!is_same) return {};
  return Status::error(StatusCode::invalid_argument, "--report %s: this is the file of %s; name another",
                       report.c_str(), option);
}

Status check_kind(const Option& option, const char* value) {
  switch (option.kind) {
    case OptionKind::file:
      return check_input(option.name, value);
    case OptionKind::output_file:
    case OptionKind::kept_file:
      return check_output(option.name, value, option.kind == OptionKind::kept_file);
    case OptionKind::folder:
      return check_folder(option.name, value, value);
    default:
      return {};
  }
}

}  // namespace

Status check_file_options(const Options& options) {
  for (const GivenOption& given : options.given) {
    const Status status = check_kind(*given.option, given.value);
    if (!status) return status;
  }
  for (const GivenOption& given : options.given) {
    const OptionKind kind = given.option->kind;
    const bool is_file =
        kind == OptionKind::file || kind == OptionKind::kept_file || kind == OptionKind::output_file;
    if (!is_file || given.option->name == std::string_view{"--report"}) continue;
    const Status status = check_apart(options.report_file, given.option->name, given.value);
    if (!status) return status;
  }
  return {};
}

}  // namespace flexrf
