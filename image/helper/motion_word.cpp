#include "image/helper/motion_word.hpp"

#include <utility>

#include "image/helper/permission.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {

MotionWord::MotionWord(std::string file, std::function<std::string()> permission,
                       std::function<void(const std::string& line)> say)
    : file_(std::move(file)), permission_(std::move(permission)), say_(std::move(say)) {}

void MotionWord::renew() {
  const std::lock_guard lock(renewing_);
  renew_locked();
}

Status MotionWord::hold(const std::string& why) {
  const std::lock_guard lock(renewing_);
  if (const Status left = leave(why); !left) return left;
  held_ = why;
  return {};
}

void MotionWord::release() {
  const std::lock_guard lock(renewing_);
  held_.clear();
  renew_locked();
}

std::string MotionWord::text() const {
  const std::lock_guard lock(reading_);
  return word_;
}

void MotionWord::renew_locked() {
  if (const Status left = leave(held_.empty() ? permission_() : held_); !left) {
    const std::string line = std::string{"the word about motion cannot be left: "} + left.cause();
    if (line == said_) return;
    said_ = line;
    say_(line);
  }
}

Status MotionWord::leave(const std::string& word) {
  if (word == text()) return {};
  // In memory, not on a disk: to replace it is all that matters.
  if (const Status written = replace_file(file_, word + '\n'); !written) return written;
  said_.clear();
  {
    const std::lock_guard lock(reading_);
    word_ = word;
  }
  say_(word == permitted ? "motion is permitted" : "motion is not permitted: " + word);
  return {};
}

}  // namespace flexrf::helper
