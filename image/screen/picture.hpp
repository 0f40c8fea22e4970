// Draws the picture on the screen of an industrial PC.
#pragma once

#include <deque>
#include <string>
#include <vector>

namespace flexrf::screen {

/// The contents of a picture. A text that is not known is empty.
struct Facts {
  std::string application;
  std::string version;
  std::string slot;                    ///< "A"
  std::vector<std::string> addresses;  ///< as "192.168.1.17"
  bool has_cable = false;              ///< in one of its network interfaces at least
  std::string claim_code;              ///< as "7QK2M-9XR4T"; empty: it does not wait to be claimed
  std::string fingerprint;             ///< SHA-256 of the panel's certificate, 64 hexadecimal digits
  std::string state;                   ///< of the cell, for a person
  std::string motion;                  ///< whether anything may move
  bool is_well = false;                ///< else `state` is marked
  std::vector<std::string> notices;    ///< of the helper: repairs, a version that was given up
  std::deque<std::string> log;         ///< what the PC's services said, the newest last
};

struct Size {
  unsigned columns = 80;
  unsigned rows = 25;
};

/// The lines of a picture of this size, in UTF-8, none longer than its columns. The claim code is in large
/// letters where there is room for it (66 columns, or 36 in two lines), and the first address is a QR code
/// beside it (from 71 columns and 25 rows on, unless notices need the rows); on larger screens the first
/// address is in large letters, too. Once it is claimed the application's name is. The log takes the rows
/// that are left. Texts of others are shown without control characters.
std::vector<std::string> draw(const Facts& facts, Size size);

}  // namespace flexrf::screen
