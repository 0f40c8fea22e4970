#include "hal/gpio/chip/interface/virtual_chip.hpp"

#include "base/text.hpp"

namespace flexrf {

VirtualChip::Entry* VirtualChip::entry(std::string_view name) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    if (text_view(entries_[i].name) == name) return &entries_[i];
  }
  if (count_ == capacity || name.size() > entries_[0].name.size()) return nullptr;
  Entry& made = entries_[count_++];
  set_text(made.name, name);
  return &made;
}

VirtualLine* VirtualChip::line(std::string_view name) {
  const std::lock_guard lock(mutex_);
  Entry* const found = entry(name);
  return found == nullptr ? nullptr : &found->line;
}

Result<GpioLine*> VirtualChip::request(const GpioLineSettings& settings, const char* chip) {
  const std::lock_guard lock(mutex_);
  if (!is_present())
    return Status::error(StatusCode::unavailable, "%s: the chip is away; plug it in again", chip);
  Entry* const found = entry(settings.name);
  if (found == nullptr)
    return Status::error(StatusCode::not_found, "%s has no room for line %s: it has %zu already", chip,
                         settings.name, capacity);
  if (found->taken)
    return Status::error(StatusCode::busy, "line %s of %s is in use by another device", settings.name, chip);
  found->taken = true;
  found->line.configure(settings, present_);
  requested_.fetch_add(1, std::memory_order_relaxed);
  return static_cast<GpioLine*>(&found->line);
}

void VirtualChip::release(GpioLine* line) noexcept {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < count_; ++i) {
    if (&entries_[i].line != line || !entries_[i].taken) continue;
    entries_[i].taken = false;
    requested_.fetch_sub(1, std::memory_order_relaxed);
  }
}

}  // namespace flexrf
