#include "image/boot/tests/lost_power.hpp"

#include <cstddef>
#include <iterator>
#include <set>

#include "image/boot/blocks.hpp"

namespace flexrf::boot {
namespace {

std::string half(const std::string& block, std::size_t number) {
  return block.size() <= number * sector_size ? std::string{}
                                              : block.substr(number * sector_size, sector_size);
}

// What a half may be after a power cut.
std::set<std::string> halves(const std::string& on_disk, const std::vector<std::string>& in_memory,
                             std::size_t number) {
  std::set<std::string> all = {half(on_disk, number), torn_sector()};
  for (const std::string& block : in_memory) all.insert(half(block, number));
  return all;
}

std::vector<std::string> states(const std::string& on_disk, const std::vector<std::string>& in_memory) {
  std::vector<std::string> all;
  for (const std::string& first : halves(on_disk, in_memory, 0))
    for (const std::string& second : halves(on_disk, in_memory, 1)) all.push_back(first + second);
  return all;
}

}  // namespace

std::string torn_sector() {
  std::string sector = "# GRUB Environment Block\nchoice=0000000009 B 0000000009 10";
  sector.resize(sector_size, '\x5A');
  return sector;
}

void LostPowerDisk::spend() {
  if (calls_left == 0) throw PowerCut{};
  if (calls_left > 0) --calls_left;
}

Result<std::string> LostPowerDisk::read(const std::string& name) {
  const auto written = in_memory_.find(name);
  std::string bytes = written != in_memory_.end() ? written->second.back() : on_disk_[name];
  if (bytes.empty()) return Status::error(StatusCode::not_found, "there is no %s", name.c_str());
  return bytes;
}

Status LostPowerDisk::overwrite(const std::string& name, std::string_view bytes) {
  spend();
  if (is_read_only) return Status::error(StatusCode::unavailable, "cannot write %s: read-only", name.c_str());
  in_memory_[name].emplace_back(bytes);
  return {};
}

Status LostPowerDisk::flush(const std::string& name) {
  spend();
  if (flushes_++ == missing_flush) return {};
  const auto written = in_memory_.find(name);
  if (written == in_memory_.end()) return {};
  on_disk_[name] = written->second.back();
  in_memory_.erase(written);
  return {};
}

Status LostPowerDisk::flush_device(const std::string& path) {
  spend();
  const auto slot = slot_named(path);
  if (!slot) return Status::error(StatusCode::not_found, "there is no %s", path.c_str());
  if (!misses_device_flush) is_whole_on_disk_[index_of(*slot)] = is_whole_in_memory_[index_of(*slot)];
  return {};
}

void LostPowerDisk::begin_writing(Slot slot) {
  is_whole_on_disk_[index_of(slot)] = false;
  is_whole_in_memory_[index_of(slot)] = false;
}

void LostPowerDisk::set_whole(Slot slot) {
  is_whole_on_disk_[index_of(slot)] = true;
  is_whole_in_memory_[index_of(slot)] = true;
}

void LostPowerDisk::put(const std::string& name, const std::string& bytes) {
  on_disk_[name] = bytes;
  in_memory_.erase(name);
}

void LostPowerDisk::settle() {
  for (const auto& [name, written] : in_memory_) on_disk_[name] = written.back();
  in_memory_.clear();
  is_whole_on_disk_ = is_whole_in_memory_;
}

void LostPowerDisk::restart_with(const Files& files) {
  on_disk_ = files;
  in_memory_.clear();
  is_whole_in_memory_ = is_whole_on_disk_;
  calls_left = -1;
}

void LostPowerDisk::for_each_state(const std::function<void(const Files&)>& visit) const {
  Files state = on_disk_;
  const std::function<void(std::map<std::string, std::vector<std::string>>::const_iterator)> choose =
      [&](auto written) {
        if (written == in_memory_.end()) {
          visit(state);
          return;
        }
        const auto old = on_disk_.find(written->first);
        const std::string on_disk = old == on_disk_.end() ? std::string{} : old->second;
        for (const std::string& block : states(on_disk, written->second)) {
          state[written->first] = block;
          choose(std::next(written));
        }
      };
  choose(in_memory_.begin());
}

}  // namespace flexrf::boot
