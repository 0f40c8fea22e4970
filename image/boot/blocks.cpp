#include "image/boot/blocks.hpp"

#include <charconv>
#include <cstdio>
#include <optional>

namespace flexrf::boot {
namespace {

constexpr std::string_view signature = "# GRUB Environment Block\n";
constexpr std::size_t counter_digits = 10;

Status damage(const char* what) {
  return Status::error(StatusCode::invalid_argument, "%s", what);
}

std::string digits_of(std::uint64_t number) {
  char text[24];
  std::snprintf(text, sizeof(text), "%010llu", static_cast<unsigned long long>(number));
  return text;
}

const char* digits_of(Marks marks) noexcept {
  return marks.is_confirmed ? "11" : marks.is_whole ? "10" : "00";
}

std::string text_of(const Choice& choice) {
  return digits_of(choice.counter) + ' ' + letter_of(choice.primary) + ' ' + digits_of(choice.trial) + ' ' +
         digits_of(choice.of(Slot::a)) + ' ' + digits_of(choice.of(Slot::b));
}

// What is still to be read of a text.
class Rest {
 public:
  explicit Rest(std::string_view text) noexcept : text_(text) {}

  bool take(std::string_view expected) noexcept {
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }
  std::optional<std::uint64_t> take_counter() noexcept {
    if (text_.size() < counter_digits) return std::nullopt;
    std::uint64_t number = 0;
    const char* const end = text_.data() + counter_digits;
    const auto [stopped, error] = std::from_chars(text_.data(), end, number);
    if (error != std::errc{} || stopped != end) return std::nullopt;
    text_.remove_prefix(counter_digits);
    return number;
  }
  std::optional<Slot> take_slot() noexcept {
    const auto slot = slot_named(text_.substr(0, 1));
    if (slot) text_.remove_prefix(1);
    return slot;
  }
  std::optional<Marks> take_marks() noexcept {
    if (take("11")) return Marks{true, true};
    if (take("10")) return Marks{true, false};
    if (take("00")) return Marks{false, false};
    return std::nullopt;
  }
  bool is_empty() const noexcept { return text_.empty(); }

 private:
  std::string_view text_;
};

std::optional<Choice> choice_from(std::string_view text) noexcept {
  Rest rest(text);
  Choice choice;
  const auto counter = rest.take_counter();
  if (!counter || *counter == 0 || !rest.take(" ")) return std::nullopt;
  const auto primary = rest.take_slot();
  if (!primary || !rest.take(" ")) return std::nullopt;
  const auto trial = rest.take_counter();
  if (!trial || *trial == 0 || *trial > *counter || !rest.take(" ")) return std::nullopt;
  const auto marks_a = rest.take_marks();
  if (!marks_a || !rest.take(" ")) return std::nullopt;
  const auto marks_b = rest.take_marks();
  if (!marks_b || !rest.is_empty()) return std::nullopt;
  return Choice{*counter, *primary, *trial, {*marks_a, *marks_b}};
}

// The value of the first line that begins so; empty if there is none.
std::string_view value_in(std::string_view block, std::string_view line_begin) noexcept {
  const std::size_t found = block.find(line_begin);
  if (found == std::string_view::npos) return {};
  const std::string_view behind = block.substr(found + line_begin.size());
  const std::size_t end = behind.find('\n');
  return end == std::string_view::npos ? std::string_view{} : behind.substr(0, end);
}

Status form_of(std::string_view block) {
  if (block.size() < block_size)
    return Status::error(StatusCode::invalid_argument, "it has %zu bytes instead of %zu", block.size(),
                         block_size);
  if (block.size() > block_size)
    return Status::error(StatusCode::invalid_argument, "it has more than %zu bytes", block_size);
  if (!block.starts_with(signature)) return damage("it does not begin as an environment block of GRUB");
  return {};
}

}  // namespace

std::uint32_t checksum_of(std::string_view text) noexcept {
  std::uint32_t remainder = 0xFFFFFFFFu;
  for (const char character : text) {
    remainder ^= static_cast<unsigned char>(character);
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder >> 1) ^ ((remainder & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~remainder;
}

std::string block_of(const Choice& choice) {
  const std::string text = text_of(choice);
  char checksum[16];
  std::snprintf(checksum, sizeof(checksum), "%08x", checksum_of(text));
  std::string block{signature};
  block += "choice=" + text + "\nchecksum=" + checksum + '\n';
  const std::string mirror = "mirror=" + text + '\n';
  // The two writings at both ends of the sector: one that a disk leaves half written has two that differ.
  block.append(sector_size - mirror.size() - 1 - block.size(), '#');
  block += '\n' + mirror;
  block.append(block_size - block.size(), '#');
  return block;
}

Result<Choice> choice_in(std::string_view block) {
  if (const Status form = form_of(block); !form) return form;
  const std::string_view text = value_in(block, "\nchoice=");
  const auto choice = choice_from(text);
  if (!choice) return damage("what it says is no choice");
  char checksum[16];
  std::snprintf(checksum, sizeof(checksum), "%08x", checksum_of(text));
  if (value_in(block, "\nchecksum=") != checksum) return damage("its checksum does not match");
  if (value_in(block, "\nmirror=") != text) return damage("the two writings of its choice differ");
  if (block_of(*choice) != block) return damage("there is something else than filling around its choice");
  return *choice;
}

std::string block_of(const Attempts& attempts) {
  std::string block{signature};
  block += "attempted=" + digits_of(attempts.trial) + "\nattempts=" + std::to_string(attempts.count) +
           "\nlast=" + letter_of(attempts.last) +
           "\nfailed=" + (attempts.failed ? letter_of(*attempts.failed) : '0') + '\n';
  block.append(block_size - block.size(), '#');
  return block;
}

Result<Attempts> attempts_in(std::string_view block) {
  if (const Status form = form_of(block); !form) return form;
  const auto trial = Rest(value_in(block, "\nattempted=")).take_counter();
  const std::string_view count = value_in(block, "\nattempts=");
  const auto last = slot_named(value_in(block, "\nlast="));
  const auto failed = slot_named(value_in(block, "\nfailed="));  // anything else than 0 is found below
  if (!trial || count.size() != 1 || count[0] < '0' || count[0] > static_cast<char>('0' + most_attempts) ||
      !last)
    return damage("what it says are no attempts");
  const Attempts attempts{*trial, static_cast<unsigned>(count[0] - '0'), *last, failed};
  if (block_of(attempts) != block) return damage("there is something else than filling behind its attempts");
  return attempts;
}

}  // namespace flexrf::boot
