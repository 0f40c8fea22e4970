#include "image/helper/update_progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "image/helper/named_lines.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

constexpr std::array<std::pair<const char*, JobState>, 4> states = {{{"starting", JobState::starting},
                                                                     {"running", JobState::running},
                                                                     {"done", JobState::done},
                                                                     {"failed", JobState::failed}}};

std::string file_of(const UpdateFiles& files, Job job) {
  return files.results + '/' + name_of(job);
}

}  // namespace

const char* name_of(Job job) noexcept {
  return job == Job::verify ? "verify" : "install";
}

std::string unit_of(Job job) {
  return std::string{"flexrf-update@"} + name_of(job) + ".service";
}

JobResult read_result(const UpdateFiles& files, Job job) {
  const std::string file = file_of(files, job);
  const Result<NamedLines> lines = NamedLines::read(file);
  JobResult result;
  if (!lines) {
    if (lines.status().code() == StatusCode::not_found) return result;
    result.state = JobState::unknown;
    result.why = lines.status().cause();
    return result;
  }
  const std::string state = lines->text("state");
  const auto* const known =
      std::find_if(states.begin(), states.end(), [&](const auto& one) { return state == one.first; });
  result.state = known == states.end() ? JobState::unknown : known->second;
  result.percent = std::min<std::uint64_t>(lines->number("percent"), 100);
  result.application = lines->text("application");
  result.version = lines->text("version");
  result.built = lines->number("built");
  result.drivers = lines->whole("drivers");
  result.why = result.state == JobState::unknown ? file + " does not say how far it is" : lines->text("why");
  return result;
}

// The results lie in memory: to replace them is all that matters.
Status write_starting(const UpdateFiles& files, Job job) {
  return replace_file(file_of(files, job), "state=starting\npercent=0\n");
}

Status write_failed(const UpdateFiles& files, Job job, const std::string& why) {
  return replace_file(file_of(files, job), "state=failed\npercent=0\nwhy=" + why + '\n');
}

Status remove_result(const UpdateFiles& files, Job job) {
  return remove_file(file_of(files, job));
}

std::string bundle_of(const UpdateFiles& files) {
  return files.folder + "/bundle";
}

std::string permission_for_older(const UpdateFiles& files) {
  return files.folder + "/older-is-allowed";
}

std::string permission_for_drivers(const UpdateFiles& files) {
  return files.folder + "/other-drivers-are-allowed";
}

const char* name_of(Phase phase) noexcept {
  switch (phase) {
    case Phase::none:
      return "none";
    case Phase::receiving:
      return "receiving";
    case Phase::verifying:
      return "verifying";
    case Phase::verified:
      return "verified";
    case Phase::installing:
      return "installing";
    case Phase::installed:
      return "installed";
    case Phase::failed:
    case Phase::unknown:
      break;
  }
  return "failed";  // what cannot be told is a failure to who asks; its reason says what it is
}

Progress read_progress(const UpdateFiles& files) {
  Progress progress;
  progress.bundle = read_result(files, Job::verify);
  progress.install = read_result(files, Job::install);
  const JobResult& verify = progress.bundle;
  const JobResult& install = progress.install;
  progress.is_verified = verify.state == JobState::done && access(bundle_of(files).c_str(), F_OK) == 0;
  if (install.state != JobState::none) {
    progress.percent = install.percent;
    progress.why = install.why;
    progress.phase = install.is_under_way()              ? Phase::installing
                     : install.state == JobState::done   ? Phase::installed
                     : install.state == JobState::failed ? Phase::failed
                                                         : Phase::unknown;
  } else if (verify.is_under_way()) {
    progress.percent = verify.percent;
    progress.phase = Phase::verifying;
  } else if (verify.state == JobState::failed || verify.state == JobState::unknown) {
    progress.why = verify.why;
    progress.phase = Phase::failed;
  } else if (progress.is_verified) {
    progress.percent = 100;
    progress.phase = Phase::verified;
  }
  return progress;
}

}  // namespace flexrf::helper
