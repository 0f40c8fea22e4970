#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace flexrf {
namespace {

/// Calls use(word) for each word between spaces, until one fails.
template <class Use>
Status each_word(std::string_view text, Use use) {
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    if (const Status status = use(word); !status) return status;
  }
  return {};
}

std::uint64_t hash_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char character : name) hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3U;
  return hash;
}

}  // namespace

Status SimulatedGpioChip::initialise() {
  const auto unusable = [](std::string_view word) {
    return Status::error(StatusCode::invalid_argument, "`%.*s` is no name of a line, or there are too many",
                         static_cast<int>(word.size()), word.data());
  };
  const Status driven = each_word(text_view(configuration.high), [&](std::string_view word) {
    VirtualLine* const input = chip_.line(word);
    if (input == nullptr) return unusable(word);
    input->drive(true);
    return Status{};
  });
  if (!driven) return driven;
  while (blocked_count_ > 0) blocked_[--blocked_count_]->block(false);
  const Status blocked = each_word(text_view(configuration.blocked), [&](std::string_view word) {
    VirtualLine* const input = chip_.line(word);
    if (input == nullptr || blocked_count_ == blocked_.size()) return unusable(word);
    blocked_[blocked_count_++] = input;
    input->block(true);
    return Status{};
  });
  if (!blocked) return blocked;
  return each_word(text_view(configuration.wires), [&](std::string_view word) {
    const std::size_t arrow = word.find('>');
    if (arrow == std::string_view::npos || arrow == 0 || arrow + 1 == word.size()) {
      return Status::error(StatusCode::invalid_argument,
                           "configuration.wires: `%.*s` is no wire; write it as OUTPUT>INPUT",
                           static_cast<int>(word.size()), word.data());
    }
    const VirtualLine* const output = chip_.line(word.substr(0, arrow));
    VirtualLine* const input = chip_.line(word.substr(arrow + 1));
    if (output == nullptr || input == nullptr) return unusable(word);
    input->wire(*output, duration_of(configuration.wire_delay));
    return Status{};
  });
}

void SimulatedGpioChip::receive(const Tick& /*tick*/) noexcept {
  const bool present = chip_.is_present();
  if (feedback.present && !present) feedback.losses += feedback.lines;
  feedback.present = present;
  feedback.lines = chip_.requested();
}

Result<GpioLine*> SimulatedGpioChip::request(const GpioLineSettings& settings) {
  Result<GpioLine*> line = chip_.request(settings, name());
  if (line) {
    chip_.line(settings.name)
        ->bounce(duration_of(configuration.bounce), environment().seed ^ hash_of(settings.name));
  }
  return line;
}

}  // namespace flexrf
