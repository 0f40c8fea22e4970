// How far an update is, as the files tell it that the units which verify and install leave.
#pragma once

#include <cstdint>
#include <string>

#include "base/status.hpp"
#include "image/helper/files.hpp"

namespace flexrf::helper {

/// What a unit of its own does: flexrf-update@verify.service, flexrf-update@install.service.
enum class Job : std::uint8_t { verify, install };
const char* name_of(Job job) noexcept;
std::string unit_of(Job job);

enum class JobState : std::uint8_t {
  none,      ///< there is no file
  starting,  ///< written by the helper, before it asks for the unit
  running,   ///< by the unit, as what follows
  done,
  failed,
  unknown,  ///< the file says none of these, or cannot be read
};

struct JobResult {
  JobState state = JobState::none;
  std::uint64_t percent = 0;
  std::string application;
  std::string version;
  std::uint64_t built = 0;  ///< seconds since 1970; 0: not told
  std::string drivers;      ///< which driver each device has, as --hardware takes it; empty: not told
  std::string why;          ///< it failed, or the file tells nothing

  bool is_under_way() const noexcept { return state == JobState::starting || state == JobState::running; }
};

JobResult read_result(const UpdateFiles& files, Job job);
/// Before the unit is asked for: from now on the job is under way, whoever dies.
Status write_starting(const UpdateFiles& files, Job job);
/// The unit could not be started.
Status write_failed(const UpdateFiles& files, Job job, const std::string& why);
Status remove_result(const UpdateFiles& files, Job job);

/// A whole bundle; until it is whole it has another name.
std::string bundle_of(const UpdateFiles& files);
/// Permits the unit to install a bundle that is older than what runs.
std::string permission_for_older(const UpdateFiles& files);
/// Permits it to install one whose devices have other drivers than those that run.
std::string permission_for_drivers(const UpdateFiles& files);

enum class Phase : std::uint8_t {
  none,
  receiving,
  verifying,
  verified,
  installing,
  installed,
  failed,
  unknown
};
/// As `state` says it.
const char* name_of(Phase phase) noexcept;

/// What is known without the upload that may be under way.
struct Progress {
  Phase phase = Phase::none;
  bool is_verified =
      false;         ///< there is a bundle that may be installed: also after an installation that failed
  JobResult bundle;  ///< of verifying
  JobResult install;
  std::uint64_t percent = 0;
  std::string why;
};

Progress read_progress(const UpdateFiles& files);

}  // namespace flexrf::helper
