// Tests of the picture on the screen of an industrial PC.
#include <algorithm>
#include <string>
#include <vector>

#include "image/screen/large_letters.hpp"
#include "image/screen/picture.hpp"
#include "image/screen/qr_code.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::screen {
namespace {

constexpr Size of_text{80, 25};

Facts unclaimed() {
  Facts facts;
  facts.application = "pick-station";
  facts.version = "20261129T001500Z-4fb48992";
  facts.slot = "A";
  facts.addresses = {"192.168.1.17"};
  facts.has_cable = true;
  facts.claim_code = "7QK2M-9XR4T";
  facts.fingerprint = "00112233445566778899AABBCCDDEEFF00112233445566778899AABBCCDDEE01";
  facts.log = {"first", "second"};
  return facts;
}

bool has(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

std::size_t letters_in(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char one) { return (one & 0xC0) != 0x80; }));
}

/// The rows of a large letter, with # for what is lit.
std::string shape_of(char character) {
  std::string shape;
  for (const std::string& row : large_letters(std::string(1, character))) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if ((row[i] & 0xC0) == 0x80) continue;
      shape += row[i] == ' ' ? '.' : '#';
    }
    shape += '\n';
  }
  return shape;
}

void who_is_to_claim_it_sees_code_address_and_fingerprint() {
  const std::vector<std::string> lines = draw(unclaimed(), of_text);
  CHECK(lines.size() <= of_text.rows);
  CHECK(has(lines, "pick-station   version 20261129T001500Z-4fb48992   slot A"));
  CHECK(has(lines, "type the code  7QK2M-9XR4T"));
  CHECK(has(lines, "  https://192.168.1.17:8443/"));
  CHECK(has(lines, "  00:11:22:33:44:55:66:77:88:99:AA:BB:CC:DD:EE:FF"));
  CHECK(has(lines, "  00:11:22:33:44:55:66:77:88:99:AA:BB:CC:DD:EE:01"));
  CHECK(has(lines, "\u2588"));
  for (const std::string& line : lines) CHECK(letters_in(line) <= of_text.columns);
}

void a_telephone_reads_the_address() {
  // Light modules of a row of characters: of its upper and its lower half.
  const auto modules = [](const std::string& row, bool lower) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] == ' ') text += '#';
      if ((row[i] & 0xC0) != 0xC0) continue;
      const auto kind = static_cast<unsigned char>(row[i + 2]);  // U+2580, U+2584, U+2588
      text += kind == 0x88 || kind == (lower ? 0x84 : 0x80) ? '.' : '#';
    }
    return text;
  };
  const std::vector<std::string> code = qr_code("https://192.168.1.17:8443/");
  CHECK_EQUAL(code.size(), std::size_t{17});  // version 2: 25 modules, and four on each side
  for (const std::string& row : code) CHECK_EQUAL(letters_in(row), std::size_t{33});
  for (const std::size_t row : {0, 1}) CHECK_EQUAL(modules(code[row], true), std::string(33, '.'));
  // Finder patterns in three corners.
  CHECK_EQUAL(modules(code[2], false).substr(0, 12), "....#######.");
  CHECK_EQUAL(modules(code[2], false).substr(21), ".#######....");
  CHECK_EQUAL(modules(code[2], true).substr(0, 12), "....#.....#.");
  CHECK_EQUAL(modules(code[14], false).substr(0, 12), "....#######.");
  CHECK_EQUAL(modules(code[14], true), std::string(33, '.'));
  CHECK(qr_code(std::string(5000, 'x')).empty());

  const std::vector<std::string> lines = draw(unclaimed(), of_text);
  for (const std::string& row : code) CHECK(has(lines, row));
  CHECK(has(lines, large_letters("7QK2M-")[3]) && has(lines, large_letters("9XR4T")[3]));
  // Notices are worth more than it, and then the code is in one line.
  Facts damaged = unclaimed();
  damaged.notices = {"data was damaged, and is repaired", "choice0.env is damaged", "and more"};
  const std::vector<std::string> with_notices = draw(damaged, of_text);
  for (const std::string& notice : damaged.notices) CHECK(has(with_notices, "! " + notice));
  CHECK(!has(with_notices, code[3]) && has(with_notices, large_letters("7QK2M-9XR4T")[3]));
  CHECK(with_notices.back() == "second");
  // Without an address there is nothing to open.
  damaged.addresses.clear();
  damaged.notices.clear();
  CHECK(!has(draw(damaged, of_text), code[0]));
  CHECK(!has(draw(unclaimed(), {70, 25}), code[3]));
}

void a_large_screen_has_the_address_in_large_letters() {
  const std::vector<std::string> lines = draw(unclaimed(), {160, 50});
  CHECK(has(lines, large_letters("192.168.1.17")[3]));
  CHECK(lines.size() <= 50 && lines.back() == "second");
}

void every_character_of_a_code_has_a_shape_of_its_own() {
  const std::string characters = "0123456789ABCDEFGHJKMNPQRSTVWXYZ-.";
  std::vector<std::string> shapes;
  for (const char one : characters) {
    shapes.push_back(shape_of(one));
    CHECK(shapes.back().find('#') != std::string::npos);
  }
  std::sort(shapes.begin(), shapes.end());
  CHECK(std::adjacent_find(shapes.begin(), shapes.end()) == shapes.end());
  CHECK_EQUAL(shape_of('7'), "#####.\n....#.\n...#..\n..#...\n.#....\n.#....\n.#....\n");
  CHECK(shape_of(' ').find('#') == std::string::npos);
}

void a_small_screen_has_the_code_in_small_letters() {
  const std::vector<std::string> lines = draw(unclaimed(), {40, 12});
  CHECK(lines.size() <= 12);
  CHECK(!has(lines, "\u2588"));
  for (const std::string& line : lines) CHECK(line.size() <= 40);
  CHECK(has(lines, "7QK2M-9XR4T"));
}

void without_an_address_it_says_why() {
  Facts facts = unclaimed();
  facts.addresses.clear();
  CHECK(has(draw(facts, of_text), "nobody in its network gave it one"));
  facts.has_cable = false;
  CHECK(has(draw(facts, of_text), "no network cable is in"));
}

void once_claimed_it_shows_how_the_cell_is() {
  Facts facts = unclaimed();
  facts.claim_code.clear();
  facts.is_well = true;
  facts.state = "The cell runs, and all is well.";
  facts.motion = "Nothing may move before Start is given at the panel.";
  CHECK(has(draw(facts, of_text), facts.motion));
  CHECK(has(draw(facts, of_text), "The cell runs, and all is well."));
  CHECK(!has(draw(facts, of_text), "! "));
  // Its name, seven rows high.
  CHECK_EQUAL(draw(facts, of_text)[0], large_letters("PICK-STATION")[0]);
  CHECK_EQUAL(draw(facts, of_text)[8], "pick-station   version 20261129T001500Z-4fb48992   slot A");
  facts.is_well = false;
  facts.state =
      "the panel says: drive left is in fault: node 5 is not heard, and a text that is much longer than a "
      "line is";
  facts.notices = {"version B was given up: it did not start"};
  const std::vector<std::string> lines = draw(facts, of_text);
  CHECK(has(lines, "! the panel says: drive left is in fault"));
  CHECK(has(lines, "longer than a line is"));
  CHECK(has(lines, "! version B was given up"));
  CHECK(has(lines, "https://192.168.1.17:8443/"));
  CHECK(!has(lines, "type the code"));
}

void what_others_say_cannot_steer_the_console() {
  Facts facts = unclaimed();
  facts.claim_code.clear();
  facts.log = {"\033[2Jgone\x9b", std::string(300, 'x'), "\xE2\x80\xAEtxet"};
  for (const std::string& line : draw(facts, of_text)) {
    CHECK(line.find('\033') == std::string::npos && line.find('\x9b') == std::string::npos);
    CHECK(letters_in(line) <= of_text.columns);
  }
}

void the_log_takes_the_rows_that_are_left() {
  Facts facts = unclaimed();
  facts.claim_code.clear();
  facts.log.clear();
  for (int i = 0; i < 60; ++i) facts.log.push_back("line " + std::to_string(i));
  for (unsigned rows = 1; rows < 100; ++rows) {
    const std::vector<std::string> lines = draw(facts, {80, rows});
    CHECK(lines.size() <= rows);
    if (rows >= 25) CHECK(lines.back() == "line 59");
  }
  facts.log = {"first", std::string(30, 'a').append(1, ' ').append(60, 'b')};
  const std::vector<std::string> wrapped = draw(facts, of_text);
  CHECK(wrapped[wrapped.size() - 3] == "first");
  CHECK(wrapped[wrapped.size() - 2] == std::string(30, 'a') && wrapped.back() == std::string(60, 'b'));
}

}  // namespace
}  // namespace flexrf::screen

int main() {
  using namespace flexrf::screen;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(who_is_to_claim_it_sees_code_address_and_fingerprint),
      CONTAINED_TEST(a_telephone_reads_the_address),
      CONTAINED_TEST(a_large_screen_has_the_address_in_large_letters),
      CONTAINED_TEST(every_character_of_a_code_has_a_shape_of_its_own),
      CONTAINED_TEST(a_small_screen_has_the_code_in_small_letters),
      CONTAINED_TEST(without_an_address_it_says_why),
      CONTAINED_TEST(once_claimed_it_shows_how_the_cell_is),
      CONTAINED_TEST(what_others_say_cannot_steer_the_console),
      CONTAINED_TEST(the_log_takes_the_rows_that_are_left),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
