#include "image/screen/picture.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "image/screen/large_letters.hpp"
#include "image/screen/qr_code.hpp"

namespace flexrf::screen {
namespace {

constexpr const char* page_port = ":8443/";
// A text screen of 25 rows has no room for a large address beside the large code.
constexpr unsigned rows_for_large_address = 36;

/// Printable ASCII alone: what a console has letters for, and what cannot steer it.
std::string plain(std::string_view text) {
  std::string kept;
  for (const char one : text) kept += one >= ' ' && one <= '~' ? one : ' ';
  return kept;
}

/// In rows, broken at gaps where there are some.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns) {
  std::string rest = plain(text);
  std::vector<std::string> rows;
  while (rest.size() > columns) {
    const std::size_t gap = rest.rfind(' ', columns);
    const bool is_broken = gap == std::string::npos || gap == 0;
    rows.push_back(rest.substr(0, is_broken ? columns : gap));
    rest.erase(0, is_broken ? columns : gap + 1);
  }
  rows.push_back(std::move(rest));
  return rows;
}

/// Characters of UTF-8.
std::size_t columns_of(std::string_view line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char one) { return (one & 0xC0) != 0x80; }));
}

constexpr std::size_t gap_beside = 2;

class Sheet {
 public:
  explicit Sheet(Size size) : size_(size) {}

  void add(std::string_view text) {
    std::string line = plain(text);
    if (line.size() > size_.columns) line.resize(size_.columns);
    lines_.push_back(std::move(line));
  }
  void add_wrapped(std::string_view text) {
    for (std::string& row : wrapped(text, size_.columns)) lines_.push_back(std::move(row));
  }
  void add_large(std::string_view text) {
    if (text.size() * columns_of_letter > size_.columns) return add(text);
    add_rows(large_letters(text));
  }
  /// In two lines, broken behind the dash, where one is too long.
  void add_large_code(std::string_view code) {
    if (code.size() * columns_of_letter <= size_.columns) return add_large(code);
    const std::size_t dash = code.find('-') + 1;
    add_large(code.substr(0, dash));
    gap();
    add_large(code.substr(dash));
  }
  /// Two pictures beside each other.
  void add_beside(std::vector<std::string> left, const std::vector<std::string>& right,
                  std::size_t from_column) {
    left.resize(std::max(left.size(), right.size()));
    for (std::size_t i = 0; i < right.size(); ++i)
      left[i].append(from_column - columns_of(left[i]), ' ').append(right[i]);
    std::move(left.begin(), left.end(), std::back_inserter(lines_));
  }
  void gap() { lines_.emplace_back(); }

  /// The last rows that there is room for.
  void add_end_of(const std::deque<std::string>& texts) {
    std::vector<std::string> rows;
    for (const std::string& text : texts)
      for (std::string& row : wrapped(text, size_.columns)) rows.push_back(std::move(row));
    const std::size_t shown = std::min(rows_left(), rows.size());
    std::move(rows.end() - static_cast<std::ptrdiff_t>(shown), rows.end(), std::back_inserter(lines_));
  }

  Size size() const { return size_; }
  /// Nothing is lost of what was added.
  bool has_room() const { return lines_.size() <= size_.rows; }
  std::size_t rows_left() const { return lines_.size() < size_.rows ? size_.rows - lines_.size() : 0; }
  std::vector<std::string> release() {
    if (lines_.size() > size_.rows) lines_.resize(size_.rows);
    return std::move(lines_);
  }

 private:
  template <class Rows>
  void add_rows(Rows rows) {
    std::move(rows.begin(), rows.end(), std::back_inserter(lines_));
  }

  Size size_;
  std::vector<std::string> lines_;
};

void add_addresses(const Facts& facts, Sheet& sheet) {
  if (facts.addresses.empty()) {
    sheet.add(facts.has_cable ? "  This PC has no address yet: nobody in its network gave it one."
                              : "  This PC has no address: no network cable is in.");
    return;
  }
  for (const std::string& address : facts.addresses) sheet.add("  https://" + address + page_port);
  if (!facts.claim_code.empty() && sheet.size().rows >= rows_for_large_address) {
    sheet.gap();
    sheet.add_large(facts.addresses.front());
  }
}

void add_fingerprint(const Facts& facts, Sheet& sheet) {
  if (facts.fingerprint.empty()) return;
  sheet.add("The browser warns of the certificate. Its fingerprint (SHA-256):");
  constexpr std::size_t digits_of_line = 32;
  for (std::size_t i = 0; i < facts.fingerprint.size(); i += digits_of_line) {
    std::string line = "  ";
    for (std::size_t k = i; k < std::min(i + digits_of_line, facts.fingerprint.size()); k += 2)
      line.append(k > i ? ":" : "").append(facts.fingerprint, k, 2);
    sheet.add(line);
  }
}

void add_log(const Facts& facts, Sheet& sheet) {
  if (facts.log.empty() || sheet.rows_left() < 3) return;
  sheet.gap();
  sheet.add_end_of(facts.log);
}

void add_name(const Facts& facts, Sheet& sheet) {
  sheet.add((facts.application.empty() ? "FlexRF" : facts.application) +
            (facts.version.empty() ? "" : "   version " + facts.version) +
            (facts.slot.empty() ? "" : "   slot " + facts.slot));
}

void add_notices(const Facts& facts, Sheet& sheet) {
  for (const std::string& notice : facts.notices) sheet.add_wrapped("! " + notice);
}

/// Code and addresses beside the QR code, which may be empty.
Sheet claim_sheet(const Facts& facts, Size size, const std::vector<std::string>& qr) {
  Sheet sheet(size);
  add_name(facts, sheet);
  if (qr.empty()) sheet.gap();
  sheet.add("Nobody has claimed this PC. Open its page, and type the code  " + facts.claim_code);
  sheet.gap();
  Size beside = size;
  if (!qr.empty()) beside.columns -= static_cast<unsigned>(columns_of(qr.front()) + gap_beside);
  Sheet left(beside);
  if (qr.empty()) {
    left.add_large(facts.claim_code);
  } else {
    left.add_large_code(facts.claim_code);
  }
  left.gap();
  add_addresses(facts, left);
  sheet.add_beside(left.release(), qr, beside.columns + gap_beside);
  sheet.gap();
  add_fingerprint(facts, sheet);
  add_notices(facts, sheet);
  return sheet;
}

/// Whether the code is in large letters beside it, too.
bool fits_beside(const std::vector<std::string>& qr, const Facts& facts, Size size) {
  if (qr.empty()) return false;
  const std::size_t dash = facts.claim_code.find('-') + 1;
  const std::size_t longer_half = std::max(dash, facts.claim_code.size() - dash);
  return longer_half * columns_of_letter + gap_beside + columns_of(qr.front()) <= size.columns;
}

std::vector<std::string> draw_claim(const Facts& facts, Size size) {
  std::vector<std::string> qr;
  if (!facts.addresses.empty()) qr = qr_code("https://" + facts.addresses.front() + page_port);
  if (!fits_beside(qr, facts, size)) qr.clear();
  Sheet sheet = claim_sheet(facts, size, qr);
  if (!qr.empty() && !sheet.has_room()) sheet = claim_sheet(facts, size, {});
  add_log(facts, sheet);
  return sheet.release();
}

}  // namespace

std::vector<std::string> draw(const Facts& facts, Size size) {
  if (!facts.claim_code.empty()) return draw_claim(facts, size);
  Sheet sheet(size);
  if (size.rows >= Size{}.rows) {
    sheet.add_large(facts.application.empty() ? "FlexRF" : facts.application);
    sheet.gap();
  }
  add_name(facts, sheet);
  sheet.gap();
  sheet.add_wrapped((facts.is_well ? "" : "! ") + facts.state);
  if (!facts.motion.empty()) sheet.add_wrapped(facts.motion);
  add_addresses(facts, sheet);
  add_notices(facts, sheet);
  add_log(facts, sheet);
  return sheet.release();
}

}  // namespace flexrf::screen
