#include "image/screen/picture.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "image/screen/large_letters.hpp"

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
    for (std::string& row : large_letters(text)) lines_.push_back(std::move(row));
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

  unsigned rows() const { return size_.rows; }
  std::size_t rows_left() const { return lines_.size() < size_.rows ? size_.rows - lines_.size() : 0; }
  std::vector<std::string> release() {
    if (lines_.size() > size_.rows) lines_.resize(size_.rows);
    return std::move(lines_);
  }

 private:
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
  if (!facts.claim_code.empty() && sheet.rows() >= rows_for_large_address) {
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

}  // namespace

std::vector<std::string> draw(const Facts& facts, Size size) {
  Sheet sheet(size);
  const std::string name = facts.application.empty() ? "FlexRF" : facts.application;
  if (facts.claim_code.empty() && size.rows >= Size{}.rows) {
    sheet.add_large(name);
    sheet.gap();
  }
  sheet.add(name + (facts.version.empty() ? "" : "   version " + facts.version) +
            (facts.slot.empty() ? "" : "   slot " + facts.slot));
  sheet.gap();
  if (!facts.claim_code.empty()) {
    sheet.add("Nobody has claimed this PC. Open its page, and type the code  " + facts.claim_code);
    sheet.gap();
    sheet.add_large(facts.claim_code);
    sheet.gap();
    add_addresses(facts, sheet);
    sheet.gap();
    add_fingerprint(facts, sheet);
  } else {
    sheet.add_wrapped((facts.is_well ? "" : "! ") + facts.state);
    if (!facts.motion.empty()) sheet.add_wrapped(facts.motion);
    add_addresses(facts, sheet);
  }
  for (const std::string& notice : facts.notices) sheet.add_wrapped("! " + notice);
  add_log(facts, sheet);
  return sheet.release();
}

}  // namespace flexrf::screen
