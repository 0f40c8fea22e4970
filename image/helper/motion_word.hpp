// The word for the application: whether anything may move, or why not (--motion-permit).
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "base/status.hpp"

namespace flexrf::helper {

/// Any thread. One at a time finds out and leaves the word, so that what was true before cannot follow what
/// is.
class MotionWord {
 public:
  /// `permission`: "permitted" or why not, of what is true now.
  MotionWord(std::string file, std::function<std::string()> permission,
             std::function<void(const std::string& line)> say);

  /// Leaves it as it has to be now. A failure is said, and tried again the next time.
  void renew();
  /// Nothing may move from now on, whatever is true. Fails if it cannot be left; then it does not hold.
  Status hold(const std::string& why);
  /// The end of hold(): what is true counts again.
  void release();
  /// As it stands in the file; empty: it could not be left yet.
  std::string text() const;

 private:
  Status leave(const std::string& word);
  void renew_locked();

  std::string file_;
  std::function<std::string()> permission_;
  std::function<void(const std::string& line)> say_;
  mutable std::mutex renewing_;  // held while it is found out
  mutable std::mutex reading_;   // of word_ alone: who reads it waits for no disk
  std::string held_;
  std::string word_;
  std::string said_;  // of failures, so that one is said once
};

}  // namespace flexrf::helper
