// The upload of a bundle: its bounds, its token, and what is left of one that nobody ends.
#include "image/helper/upload.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <string>

#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::upload_test {
namespace {

using std::chrono::minutes;

class Bench {
 public:
  Pc pc;
  std::string part_file = pc.bundle() + ".part";
  Upload upload{pc.files.update, pc.surroundings.free_bytes};

  std::string begin(std::uint64_t size) {
    const Answer answer = upload.begin(size, pc.now);
    CHECK_EQUAL(refusal(answer), "200 ");
    CHECK_EQUAL(answer.upload.size(), 32U);
    return answer.upload;
  }
  Answer part(const std::string& token, std::uint64_t offset, const std::string& bytes) {
    return upload.part(token, offset, bytes, pc.now);
  }
};

void parts_become_the_bundle() {
  Bench bench;
  const std::string token = bench.begin(7);
  CHECK_EQUAL(*bench.part(token, 0, "bun").received, 3U);
  CHECK_EQUAL(bench.upload.received().bytes, 3U);
  CHECK(!bench.upload.is_whole());
  CHECK_EQUAL(*bench.part(token, 3, "dle!").received, 7U);
  CHECK(bench.upload.is_whole());
  CHECK(!bench.pc.has(bench.pc.bundle()));  // until it is taken
  CHECK_EQUAL(bench.upload.finish(), "");
  CHECK_EQUAL(text_of_file(bench.pc.bundle()), "bundle!");
  CHECK(!bench.upload.received().is_under_way);
  struct stat status {};
  CHECK(stat(bench.pc.bundle().c_str(), &status) == 0);
  CHECK_EQUAL(status.st_mode & 07777U, 0600U);
  // The answer to the last part was lost: who sends it again is told that all is here.
  const Answer again = bench.part(token, 3, "dle!");
  CHECK_CONTAINS(refusal(again), "409 all of the bundle is here already");
  CHECK_EQUAL(*again.received, 7U);
}

void a_part_in_the_wrong_place_is_told_the_right_one() {
  Bench bench;
  const std::string token = bench.begin(10);
  CHECK(bench.part(token, 0, "abc").is_done());
  for (const std::uint64_t offset : {0U, 2U, 4U, 10U}) {
    const Answer wrong = bench.part(token, offset, "d");
    CHECK_CONTAINS(refusal(wrong), "409 the next part begins at byte 3");
    CHECK_EQUAL(*wrong.received, 3U);
  }
  CHECK_CONTAINS(refusal(bench.part(token, 3, "12345678")), "413 the part goes beyond the bundle's 10 bytes");
  CHECK_EQUAL(*bench.part(token, 3, "1234567").received, 10U);
}

void only_the_token_of_this_upload_counts() {
  Bench bench;
  const std::string first = bench.begin(10);
  const std::string second = bench.begin(20);
  CHECK(first != second);
  CHECK(bench.part(second, 0, "abc").is_done());
  for (const std::string& token :
       {first, std::string{}, second.substr(1), second + '0', std::string(32, '0')})
    CHECK_CONTAINS(refusal(bench.part(token, 3, "d")), "404 there is no such upload");
  CHECK_EQUAL(bench.upload.received().bytes, 3U);
}

void sizes_and_room_are_bounded() {
  Bench bench;
  CHECK_CONTAINS(refusal(bench.upload.begin(0, bench.pc.now)), "400 'size' is 0");
  CHECK_CONTAINS(refusal(bench.upload.begin(Upload::largest + 1, bench.pc.now)),
                 "413 a bundle has at most 1024 MiB");
  CHECK_CONTAINS(refusal(bench.upload.begin(~std::uint64_t{0}, bench.pc.now)), "413");
  bench.begin(Upload::largest);
  bench.pc.free = Upload::spare + 99;
  CHECK_CONTAINS(refusal(bench.upload.begin(100, bench.pc.now)), "507 there is no room for 100 bytes");
  // It was refused: the one before goes on.
  CHECK(bench.upload.received().is_under_way);
  bench.begin(99);
}

void what_is_replaced_makes_room() {
  Bench bench;
  Pc::write(bench.pc.bundle(), std::string(1 << 20, 'x'));
  bench.pc.free = Upload::spare;
  bench.begin(1 << 20);
  CHECK(!bench.pc.has(bench.pc.bundle()));
}

void one_that_is_abandoned_is_removed() {
  Bench bench;
  const std::string token = bench.begin(10);
  bench.pc.now += minutes{9};
  CHECK(bench.part(token, 0, "abc").is_done());
  bench.pc.now += minutes{9};
  CHECK_EQUAL(bench.part(token, 9, "x").status, 409U);  // a word, but no part
  CHECK(!bench.upload.remove_abandoned(bench.pc.now));
  bench.pc.now += minutes{1};
  CHECK(bench.upload.remove_abandoned(bench.pc.now));
  CHECK(!bench.pc.has(bench.part_file));
  CHECK_CONTAINS(refusal(bench.part(token, 3, "d")), "404");
  CHECK(!bench.upload.remove_abandoned(bench.pc.now + minutes{60}));
}

void what_a_helper_before_left_is_removed() {
  Bench bench;
  const std::string token = bench.begin(10);
  CHECK(bench.part(token, 0, "abc").is_done());
  Upload next(bench.pc.files.update, bench.pc.surroundings.free_bytes);
  CHECK(!bench.pc.has(bench.part_file));
  CHECK_EQUAL(next.part(token, 3, "d", bench.pc.now).status, 404U);
}

void a_link_in_its_place_is_not_followed() {
  Bench bench;
  const std::string other = bench.pc.files.update.folder + "/other";
  Pc::write(other, "precious");
  fs::create_symlink(other, bench.part_file);
  const std::string token = bench.begin(3);
  CHECK(bench.part(token, 0, "abc").is_done());
  CHECK_EQUAL(bench.upload.finish(), "");
  CHECK_EQUAL(text_of_file(other), "precious");
}

/// More than this process may write, as a full disk would have it.
void a_write_that_fails_ends_the_upload() {
  Bench bench;
  const std::string token = bench.begin(10);
  CHECK(bench.part(token, 0, "abc").is_done());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  CHECK(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit limit{5, before.rlim_max};
  CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  const Answer failed = bench.part(token, 3, "defghij");
  CHECK(setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK_CONTAINS(refusal(failed), "503 the bundle cannot be written to");
  CHECK_CONTAINS(failed.why, "File too large; the upload is gone, begin anew");
  CHECK(!bench.pc.has(bench.part_file));
  CHECK_EQUAL(bench.part(token, 3, "d").status, 404U);
}

void a_folder_that_is_not_there_is_told() {
  Bench bench;
  fs::remove_all(bench.pc.files.update.folder);
  CHECK_CONTAINS(refusal(bench.upload.begin(10, bench.pc.now)), "503 the bundle cannot be written to");
  CHECK(!bench.upload.received().is_under_way);
}

}  // namespace
}  // namespace flexrf::helper::upload_test

int main() {
  using namespace flexrf::helper::upload_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(parts_become_the_bundle),
      CONTAINED_TEST(a_part_in_the_wrong_place_is_told_the_right_one),
      CONTAINED_TEST(only_the_token_of_this_upload_counts),
      CONTAINED_TEST(sizes_and_room_are_bounded),
      CONTAINED_TEST(what_is_replaced_makes_room),
      CONTAINED_TEST(one_that_is_abandoned_is_removed),
      CONTAINED_TEST(what_a_helper_before_left_is_removed),
      CONTAINED_TEST(a_link_in_its_place_is_not_followed),
      CONTAINED_TEST(a_write_that_fails_ends_the_upload),
      CONTAINED_TEST(a_folder_that_is_not_there_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
