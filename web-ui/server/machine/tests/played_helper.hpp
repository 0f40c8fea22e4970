// The other end of the helper's socket, in the hands of a test.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace flexrf::panel {

/// A folder of the test's own with a place for a socket in it.
class SocketPlace {
 public:
  SocketPlace();
  ~SocketPlace();
  SocketPlace(const SocketPlace&) = delete;
  SocketPlace& operator=(const SocketPlace&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string folder_;
  std::string path_;
};

/// Listens from its construction to its end, and gives each message to `react`, in a thread of its own.
class PlayedHelper {
 public:
  enum class How {
    answers,        ///< with `text`
    says_nothing,   ///<
    hangs_up,       ///< closes the connection
    answers_twice,  ///< with `text`, and a word that nobody asked for
  };
  struct Reaction {
    How how = How::answers;
    std::string text;
  };
  /// Of the line, and of the bytes behind it.
  using React = std::function<Reaction(const std::string& line, const std::string& bytes)>;

  /// A socket that is there already is replaced.
  PlayedHelper(const std::string& path, React react);
  ~PlayedHelper();
  PlayedHelper(const PlayedHelper&) = delete;
  PlayedHelper& operator=(const PlayedHelper&) = delete;

  /// How many words nobody asked for are on their way to the client.
  int unasked_words() const { return unasked_words_; }

 private:
  void run();
  bool serve(int connection);

  std::string path_;
  React react_;
  int listener_ = -1;
  int end_ = -1;
  std::vector<int> connections_;
  std::atomic<int> unasked_words_{0};
  std::thread thread_;
};

}  // namespace flexrf::panel
