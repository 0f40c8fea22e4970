#include "image/boot/blocks.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "image/boot/tests/grub_environment.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::boot::blocks_test {
namespace {

// Every mixture of what a choice can say.
std::vector<Choice> all_kinds_of_choices() {
  std::vector<Choice> choices;
  const Marks marks[] = {{false, false}, {true, false}, {true, true}};
  for (const Slot primary : {Slot::a, Slot::b})
    for (const Marks& a : marks)
      for (const Marks& b : marks)
        for (const std::uint64_t counter : {std::uint64_t{1}, std::uint64_t{42}, last_counter})
          choices.push_back({counter, primary, counter > 1 ? counter - 1 : 1, {a, b}});
  return choices;
}

void the_block_is_as_documented() {
  const std::string block = block_of(Choice{42, Slot::b, 41, {Marks{true, true}, Marks{true, false}}});
  const std::string begin =
      "# GRUB Environment Block\n"
      "choice=0000000042 B 0000000041 11 10\n"
      "checksum=";
  const std::string end = "\nmirror=0000000042 B 0000000041 11 10\n";
  CHECK_EQUAL(block.size(), 1024u);
  CHECK_EQUAL(block.substr(0, begin.size()), begin);
  CHECK_EQUAL(block.substr(512 - end.size(), end.size()), end);
  CHECK_EQUAL(block.substr(512), std::string(512, '#'));
}

void the_checksum_is_that_of_iso_3309() {
  CHECK_EQUAL(checksum_of("123456789"), 0xCBF43926u);  // the standard's check value
  CHECK_EQUAL(checksum_of(""), 0u);
}

void what_is_written_reads_back() {
  for (const Choice& choice : all_kinds_of_choices()) {
    const Result<Choice> read = choice_in(block_of(choice));
    CHECK(read);
    CHECK(*read == choice);
  }
  for (unsigned count = 0; count <= most_attempts; ++count) {
    for (const Slot last : {Slot::a, Slot::b}) {
      const Result<Attempts> read = attempts_in(block_of(Attempts{last_counter, count, last, other(last)}));
      CHECK(read);
      CHECK(*read == (Attempts{last_counter, count, last, other(last)}));
    }
  }
}

void grub_reads_the_same() {
  for (const Choice& choice : all_kinds_of_choices()) {
    auto variables = grub_variables(block_of(choice));
    CHECK(variables.has_value());
    CHECK_EQUAL(variables->size(), 3u);
    CHECK_EQUAL((*variables)["choice"], (*variables)["mirror"]);
    CHECK_EQUAL((*variables)["choice"].substr(11, 1), std::string(1, letter_of(choice.primary)));
    CHECK_EQUAL((*variables)["choice"].substr(24, 2).front() == '1', choice.of(Slot::a).is_whole);
    CHECK_EQUAL((*variables)["choice"].substr(27, 2).back() == '1', choice.of(Slot::b).is_confirmed);
  }
}

// What GRUB writes has the form that is read here: each value keeps its length.
void what_grub_counts_is_read() {
  std::string block = block_of(Attempts{});
  CHECK(grub_set(block, "attempted", "0000000041"));
  CHECK(grub_set(block, "attempts", "2"));
  CHECK(grub_set(block, "last", "A"));
  CHECK(grub_set(block, "failed", "B"));
  CHECK(attempts_in(block));
  CHECK(attempts_in(block)->failed == Slot::b);
  CHECK(grub_set(block, "failed", "0"));
  const Result<Attempts> read = attempts_in(block);
  CHECK(read);
  CHECK(*read == (Attempts{41, 2, Slot::a, {}}));
}

void any_bit_that_flips_is_noticed() {
  const std::string good = block_of(Choice{42, Slot::b, 41, {Marks{true, true}, Marks{true, false}}});
  const std::string good_attempts = block_of(Attempts{41, 2, Slot::a, {}});
  for (std::size_t bit = 0; bit < 8 * block_size; ++bit) {
    std::string block = good;
    block[bit / 8] = static_cast<char>(block[bit / 8] ^ (1 << (bit % 8)));
    CHECK(!choice_in(block));
    block = good_attempts;
    block[bit / 8] = static_cast<char>(block[bit / 8] ^ (1 << (bit % 8)));
    const Result<Attempts> attempts = attempts_in(block);
    // There is no checksum that GRUB could keep: another digit is another number.
    CHECK(!attempts || !(*attempts == Attempts{41, 2, Slot::a, {}}));
  }
}

// GRUB's own check, of which the script's text is tested elsewhere: both writings are alike.
std::string choice_for_grub(const std::string& block) {
  auto variables = grub_variables(block);
  if (!variables || (*variables)["choice"] != (*variables)["mirror"]) return {};
  return (*variables)["choice"];
}

// Wherever a write stops, also within a sector, there is the old choice, the new one, or none that is taken
// for one.
void a_torn_block_is_the_old_or_the_new_or_none() {
  const auto choices = all_kinds_of_choices();
  for (const Choice& from : choices) {
    Choice to = from;
    to.counter = from.counter == last_counter ? 7 : from.counter + 1;
    to.trial = to.counter;
    to.primary = other(from.primary);
    const std::string old_block = block_of(from);
    const std::string new_block = block_of(to);
    CHECK(old_block.substr(sector_size) == new_block.substr(sector_size));
    const std::set<std::string> known = {choice_for_grub(old_block), choice_for_grub(new_block), ""};
    for (std::size_t size = 0; size <= block_size; ++size) {
      const std::string torn = new_block.substr(0, size) + old_block.substr(size);
      const Result<Choice> read = choice_in(torn);
      CHECK(!read || *read == from || *read == to);
      CHECK(known.count(choice_for_grub(torn)) == 1);
    }
  }
}

void expect_damage(const std::string& block, const char* part) {
  const Result<Choice> read = choice_in(block);
  CHECK(!read);
  CHECK_CONTAINS(read.status().cause(), part);
}

void each_damage_is_named() {
  const std::string good = block_of(choice_of_new_disk());
  expect_damage("", "0 bytes");
  expect_damage(good.substr(0, 512), "512 bytes");
  expect_damage(good + "#", "more than 1024");
  expect_damage(std::string(1024, '#'), "does not begin");
  std::string block = good;
  block.replace(block.find("choice="), 7, "chaice=");
  expect_damage(block, "no choice");
  block = good;
  block.replace(block.find("checksum=") + 9, 8, "00000000");
  expect_damage(block, "checksum");
  block = good;
  block[block.find("mirror=") + 7] = '1';
  expect_damage(block, "differ");
  block = good;
  block[1000] = '\0';
  expect_damage(block, "something else");
}

// A checksum that fits, over what makes no sense.
void a_choice_that_cannot_be_is_none() {
  const std::string good_text = "0000000042 B 0000000041 11 10";
  const char* const texts[] = {"0000000000 B 0000000000 11 10", "0000000042 C 0000000041 11 10",
                               "0000000042 B 0000000043 11 10", "0000000042 B 0000000041 01 10",
                               "0000000042 B 0000000041 11 1x", "+000000042 B 0000000041 11 10",
                               "0000000042 B  000000041 11 10", "0000000042 B 0000000000 11 10"};
  for (const char* text : texts) {
    std::string block = block_of(Choice{42, Slot::b, 41, {Marks{true, true}, Marks{true, false}}});
    for (std::size_t place = block.find(good_text); place != std::string::npos; place = block.find(good_text))
      block.replace(place, good_text.size(), text);
    char checksum[16];
    std::snprintf(checksum, sizeof(checksum), "%08x", checksum_of(text));
    block.replace(block.find("checksum=") + 9, 8, checksum);
    expect_damage(block, "no choice");
  }
}

}  // namespace
}  // namespace flexrf::boot::blocks_test

int main() {
  using namespace flexrf::boot::blocks_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(the_block_is_as_documented),
      CONTAINED_TEST(the_checksum_is_that_of_iso_3309),
      CONTAINED_TEST(what_is_written_reads_back),
      CONTAINED_TEST(grub_reads_the_same),
      CONTAINED_TEST(what_grub_counts_is_read),
      CONTAINED_TEST(any_bit_that_flips_is_noticed),
      CONTAINED_TEST(a_torn_block_is_the_old_or_the_new_or_none),
      CONTAINED_TEST(each_damage_is_named),
      CONTAINED_TEST(a_choice_that_cannot_be_is_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
