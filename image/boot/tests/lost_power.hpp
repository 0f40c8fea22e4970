// A disk that records what was written and what was flushed, and loses its power: the boot choice's files,
// and two slots.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/boot/choice.hpp"
#include "image/boot/medium.hpp"

namespace flexrf::boot {

/// Thrown when the power goes, or the process is killed.
struct PowerCut {};

/// Contents by name; a file that is missing is empty.
using Files = std::map<std::string, std::string>;

/// A half of a block that was being written when the power went may also be this: neither the old nor the
/// new.
std::string torn_sector();

class LostPowerDisk final : public Medium {
 public:
  LostPowerDisk() = default;
  explicit LostPowerDisk(Files on_disk) : on_disk_(std::move(on_disk)) {}

  Result<std::string> read(const std::string& name) override;
  Status overwrite(const std::string& name, std::string_view bytes) override;
  Status flush(const std::string& name) override;
  Status flush_device(const std::string& path) override;

  /// A slot's partitions, which RAUC writes: its "device" is the letter.
  void begin_writing(Slot slot);
  void finish_writing(Slot slot) { is_whole_in_memory_[index_of(slot)] = true; }
  bool is_whole(Slot slot) const { return is_whole_on_disk_[index_of(slot)]; }
  void set_whole(Slot slot);

  /// Somebody else has written this file, and it is on the disk.
  void put(const std::string& name, const std::string& bytes);
  /// All that is in memory reaches the disk, as before an orderly restart.
  void settle();
  /// The power is back, and this is what it left of the files; of the slots what was flushed.
  void restart_with(const Files& files);
  /// Each state in which a power cut now could leave the files: of what is not flushed, each half of each
  /// block is the old one, any that was written since, or a torn one.
  void for_each_state(const std::function<void(const Files&)>& visit) const;

  /// So many calls that write or flush are carried out; the next one finds no power. -1: all.
  int calls_left = -1;
  /// The flush with this number, of those after begin_process(), is not carried out, as if its line were
  /// missing. -1: all are.
  int missing_flush = -1;
  bool misses_device_flush = false;
  bool is_read_only = false;
  void begin_process() { flushes_ = 0; }

 private:
  void spend();

  Files on_disk_;
  std::map<std::string, std::vector<std::string>> in_memory_;  // written since the last flush, in order
  std::array<bool, 2> is_whole_on_disk_{};
  std::array<bool, 2> is_whole_in_memory_{};
  int flushes_ = 0;
};

}  // namespace flexrf::boot
