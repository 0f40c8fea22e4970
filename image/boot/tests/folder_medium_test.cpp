// The folder of the ESP, with files on it that should not be there.
#include "image/boot/folder_medium.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "image/boot/blocks.hpp"
#include "image/boot/verbs.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::boot::folder_medium_test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds no_long_wait{50};

class Folder {
 public:
  Folder() {
    char name[] = "/tmp/flexrf-boot-choice-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  const std::string& path() const { return path_; }
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

ino_t number_of(const std::string& path) {
  struct stat found {};
  CHECK(stat(path.c_str(), &found) == 0);
  return found.st_ino;
}

void expect_error(const Status& status, StatusCode code, const char* part) {
  CHECK(!status);
  CHECK_EQUAL(name_of(status.code()), name_of(code));
  CHECK_CONTAINS(status.cause(), part);
}

void a_file_is_made_and_written_over_in_its_place() {
  const Folder folder;
  FolderMedium medium;
  CHECK(medium.open(folder.path(), no_long_wait));
  expect_error(medium.read("a.env").status(), StatusCode::not_found, "a.env");
  CHECK(medium.overwrite("a.env", "first"));
  CHECK(medium.flush("a.env"));
  const ino_t number = number_of(folder / "a.env");
  CHECK(medium.overwrite("a.env", "other"));
  CHECK(medium.flush("a.env"));
  CHECK_EQUAL(number_of(folder / "a.env"), number);
  const Result<std::string> read = medium.read("a.env");
  CHECK(read);
  CHECK_EQUAL(*read, "other");
}

void a_file_of_another_length_gets_the_right_one() {
  const Folder folder;
  FolderMedium medium;
  CHECK(medium.open(folder.path(), no_long_wait));
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{100'000}}) {
    write(folder / "a.env", std::string(size, 'x'));
    const Result<std::string> read = medium.read("a.env");
    CHECK(read);
    CHECK_EQUAL(read->size(), std::min(size, block_size + 1));
    CHECK(medium.overwrite("a.env", std::string(1024, 'y')));
    CHECK_EQUAL(bytes_of(folder / "a.env"), std::string(1024, 'y'));
  }
}

void what_is_no_file_is_refused() {
  const Folder folder;
  FolderMedium medium;
  CHECK(medium.open(folder.path(), no_long_wait));
  fs::create_directory(folder / "folder.env");
  CHECK(mkfifo((folder / "pipe.env").c_str(), 0600) == 0);
  write(folder / "target", "kept");
  fs::create_symlink("target", folder / "link.env");
  expect_error(medium.read("folder.env").status(), StatusCode::invalid_argument, "folder.env is a folder");
  expect_error(medium.overwrite("folder.env", "x"), StatusCode::invalid_argument, "folder.env is a folder");
  expect_error(medium.read("pipe.env").status(), StatusCode::invalid_argument, "a pipe or a device");
  CHECK(!medium.overwrite("pipe.env", "x"));  // nobody reads it
  expect_error(medium.read("link.env").status(), StatusCode::invalid_argument, "a symbolic link");
  expect_error(medium.overwrite("link.env", "x"), StatusCode::invalid_argument, "a symbolic link");
  CHECK_EQUAL(bytes_of(folder / "target"), "kept");
  CHECK(!medium.flush("none.env"));
  CHECK(!medium.flush_device(folder.path()));
  CHECK(!medium.flush_device("/dev/null"));
  CHECK(medium.flush_device(folder / "target"));
}

void a_folder_that_is_none_is_refused() {
  const Folder folder;
  FolderMedium missing;
  expect_error(missing.open(folder / "none", no_long_wait), StatusCode::not_found, "none");
  write(folder / "file", "");
  FolderMedium file;
  CHECK(!file.open(folder / "file", no_long_wait));
}

void one_at_a_time() {
  const Folder folder;
  {
    FolderMedium first;
    CHECK(first.open(folder.path(), no_long_wait));
    FolderMedium second;
    expect_error(second.open(folder.path(), no_long_wait), StatusCode::busy, "another process");
  }
  FolderMedium third;
  CHECK(third.open(folder.path(), no_long_wait));
}

// One directory in the place of a copy: the other one counts, nothing is changed, and the repair says what to
// do.
void a_folder_in_the_place_of_a_copy_is_survived() {
  const Folder folder;
  FolderMedium medium;
  CHECK(medium.open(folder.path(), no_long_wait));
  CHECK(perform({"create"}, medium, {}).exit == Exit::done);
  fs::remove(folder / "choice0.env");
  fs::create_directory(folder / "choice0.env");
  Outcome outcome = perform({"get-primary"}, medium, {});
  CHECK(outcome.exit == Exit::done);
  CHECK_EQUAL(outcome.answer, "A\n");
  const std::string before = bytes_of(folder / "choice1.env");
  CHECK(perform({"set-primary", "B"}, medium, {}).exit == Exit::failed);
  CHECK_EQUAL(bytes_of(folder / "choice1.env"), before);
  outcome = perform({"repair"}, medium, {Slot::a, "only", 1});
  CHECK(outcome.exit == Exit::failed);
  CHECK_CONTAINS(outcome.said.front(), "choice0.env is a folder, not a file; remove it");
  fs::remove(folder / "choice0.env");
  CHECK(perform({"repair"}, medium, {Slot::a, "only", 1}).exit == Exit::repaired);
  CHECK_EQUAL(bytes_of(folder / "choice0.env"), before);
}

// Without files nothing is lost but the choice between the slots.
void missing_files_are_made_again() {
  const Folder folder;
  FolderMedium medium;
  CHECK(medium.open(folder.path(), no_long_wait));
  CHECK(perform({"repair"}, medium, {Slot::b, "unknown", 0}).exit == Exit::repaired);
  CHECK_EQUAL(perform({"get-primary"}, medium, {}).answer, "B\n");
  CHECK_EQUAL(bytes_of(folder / "choice0.env"), bytes_of(folder / "choice1.env"));
  CHECK_EQUAL(bytes_of(folder / "attempts.env"), block_of(Attempts{}));
}

}  // namespace
}  // namespace flexrf::boot::folder_medium_test

int main() {
  using namespace flexrf::boot::folder_medium_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_file_is_made_and_written_over_in_its_place),
      CONTAINED_TEST(a_file_of_another_length_gets_the_right_one),
      CONTAINED_TEST(what_is_no_file_is_refused),
      CONTAINED_TEST(a_folder_that_is_none_is_refused),
      CONTAINED_TEST(one_at_a_time),
      CONTAINED_TEST(a_folder_in_the_place_of_a_copy_is_survived),
      CONTAINED_TEST(missing_files_are_made_again),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
