#include "hal/process/interface/process_lines.hpp"

#include <algorithm>

namespace flexrf {

void ProcessLines::restart() noexcept {
  parts_ = {};
  first_ = size_ = 0;
  run_ = count_ = dropped_ = cut_ = 0;
}

void ProcessLines::put(ProcessSource source, std::string_view bytes, Time now) noexcept {
  Part& part = parts_[static_cast<std::size_t>(source)];
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    append(part, bytes.substr(0, end));
    if (end == std::string_view::npos) return;
    end_line(source, now);
    bytes.remove_prefix(end + 1);
  }
}

void ProcessLines::finish(Time now) noexcept {
  for (const ProcessSource source : {ProcessSource::output, ProcessSource::error}) {
    if (parts_[static_cast<std::size_t>(source)].begun) end_line(source, now);
  }
}

void ProcessLines::append(Part& part, std::string_view bytes) noexcept {
  part.begun = true;
  const std::size_t count = std::min(bytes.size(), part.text.size() - part.size);
  std::replace_copy(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count),
                    part.text.begin() + static_cast<std::ptrdiff_t>(part.size), '\0', '?');
  part.size += count;
  part.cut = part.cut || count < bytes.size();
}

void ProcessLines::end_line(ProcessSource source, Time now) noexcept {
  Part& part = parts_[static_cast<std::size_t>(source)];
  ++count_;
  if (part.cut) ++cut_;
  if (size_ == ring_.size()) {
    ++dropped_;
  } else {
    if (!part.cut && part.size > 0 && part.text[part.size - 1] == '\r') --part.size;
    ProcessLine& line = ring_[(first_ + size_++) % ring_.size()];
    line = {};
    set_text(line.content, {part.text.data(), part.size});
    line.source = source;
    line.cut = part.cut;
    line.run = run_;
    line.number = count_;
    line.at = nanoseconds(now);
  }
  part.size = 0;
  part.begun = part.cut = false;
}

bool ProcessLines::take(ProcessLine& line) noexcept {
  if (size_ == 0) return false;
  line = ring_[first_];
  first_ = (first_ + 1) % ring_.size();
  --size_;
  return true;
}

}  // namespace flexrf
