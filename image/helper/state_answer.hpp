// The answer to `state`: all that a person may want to know of this PC.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "image/helper/data_use.hpp"
#include "image/helper/failure_lines.hpp"
#include "image/helper/files.hpp"
#include "image/helper/helper.hpp"
#include "image/helper/interfaces.hpp"
#include "image/helper/start_record.hpp"
#include "image/helper/upload.hpp"

namespace flexrf::helper {

/// What no file tells.
struct OfThisMoment {
  std::string word;  ///< about motion; empty: it could not be left yet
  Health health;
  Duration health_needed{};
  Upload::Received upload;
  std::vector<Interface> interfaces;
  Time now{};
  std::optional<Failure> failure{};  ///< to show; see failure_to_show()
  std::optional<DataUse> data{};
  FailureLines::Answer failure_lines{};  ///< of it
};

/// The notices for a person: the lines of all files in the folder of notices, 16 at most. Any thread.
std::vector<std::string> notices_of(const Files& files);
/// A JSON object of at most some 14 KiB. Reads the files of versions, notices and the update. Any thread.
std::string state_answer(const Files& files, const Facts& facts, const OfThisMoment& moment);

}  // namespace flexrf::helper
