// The bundle of an update on its way to the disk.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "base/time.hpp"
#include "image/helper/answer.hpp"
#include "image/helper/files.hpp"

namespace flexrf::helper {

/// One at a time; one that begins replaces the one before. What is received lies in `bundle.part`, and is
/// named `bundle` by the caller when it is whole. One thread but for received().
class Upload {
 public:
  static constexpr std::uint64_t largest = std::uint64_t{1} << 30;
  static constexpr std::uint64_t spare = std::uint64_t{64} << 20;  ///< what stays free in the file system
  /// So much is at most on its way to the disk at once: who else writes does not wait for more.
  static constexpr std::uint64_t written_through_each = std::uint64_t{1} << 20;
  static constexpr Duration patience = std::chrono::minutes{10};

  using FreeBytes = std::function<std::uint64_t(const std::string& folder)>;

  /// What a helper before this one has left is removed: nobody has its token.
  Upload(const UpdateFiles& files, FreeBytes free_bytes);
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;
  ~Upload();

  /// Answers the token. The former upload and the bundle are gone when it is done; when it is refused they
  /// are as before.
  Answer begin(std::uint64_t size, Time now);
  /// Writes the next bytes. When they were the last, everything is on the disk when it returns.
  Answer part(std::string_view token, std::uint64_t offset, std::string_view bytes, Time now);
  /// All bytes are there, and nobody took them.
  bool is_whole() const noexcept { return file_ >= 0 && received_ == size_; }
  /// Gives what is whole the name `bundle`. Empty: done; else why not, and the upload is gone.
  std::string finish();
  /// Removes one of which nothing was heard for long. True: it has.
  bool remove_abandoned(Time now);

  struct Received {
    bool is_under_way = false;
    std::uint64_t bytes = 0;
    std::uint64_t size = 0;
  };
  /// Any thread.
  Received received() const;

 private:
  Answer write(std::string_view bytes);
  bool is_token(std::string_view token) const noexcept;
  void close_file();
  void drop();
  void publish();

  UpdateFiles files_;
  FreeBytes free_bytes_;
  std::string part_path_;
  std::string token_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t on_disk_ = 0;
  Time heard_of_{};
  mutable std::mutex reading_;
  Received published_;
};

}  // namespace flexrf::helper
