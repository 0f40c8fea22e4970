// The token's file, the token, and which addresses are within the machine.
#include "units/remote_control/remote_entrance.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::remote {
namespace {

const std::string secret = "0123456789abcdef0123456789abcdef";

class TokenFile {
 public:
  explicit TokenFile(const std::string& content, mode_t mode = 0600) {
    const int descriptor = ::mkstemp(path_);
    CHECK(descriptor >= 0);
    CHECK(::write(descriptor, content.data(), content.size()) == static_cast<ssize_t>(content.size()));
    CHECK(::fchmod(descriptor, mode) == 0);
    ::close(descriptor);
  }
  ~TokenFile() { ::unlink(path_); }
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;
  const char* path() const { return path_; }

 private:
  char path_[32] = "/tmp/flexrf-token-XXXXXX";
};

std::string refusal_of(const std::string& content, mode_t mode = 0600) {
  const TokenFile file(content, mode);
  Token token;
  const Status status = token.load(file.path());
  CHECK_EQUAL(token.is_there(), status.is_ok());
  return status.cause();
}

void a_private_file_with_one_line() {
  CHECK_EQUAL(refusal_of(secret), "");
  CHECK_EQUAL(refusal_of(secret + "\n", 0400), "");
  CHECK_EQUAL(refusal_of(std::string(128, 'x') + "\n"), "");
  for (const mode_t mode : {mode_t{0640}, mode_t{0604}, mode_t{0620}, mode_t{0601}})
    CHECK_CONTAINS(refusal_of(secret, mode), "0600");
  for (const std::string& content :
       {std::string{}, std::string{"secret"}, std::string(129, 'x'), std::string(4000, 'x'), secret + "\n\n",
        secret + " ", secret + "\n" + secret, secret + std::string(1, '\0')})
    CHECK_CONTAINS(refusal_of(content), "32 to 128");
}

void other_things_than_files() {
  Token token;
  CHECK_CONTAINS(token.load("/tmp/there/is/none").cause(), "No such file");
  CHECK_CONTAINS(token.load("/tmp").cause(), "as a file");
  const TokenFile file(secret);
  const std::string link = std::string{file.path()} + ".link";
  CHECK(::symlink(file.path(), link.c_str()) == 0);
  const Status status = token.load(link.c_str());
  ::unlink(link.c_str());
  CHECK(!status.is_ok() && !token.is_there());
}

void only_the_token_is_the_token() {
  Token token;
  CHECK(!token.is(""));
  const TokenFile file(secret + "\n");
  CHECK(token.load(file.path()).is_ok());
  CHECK(token.is(secret));
  CHECK(!token.is(""));
  CHECK(!token.is(secret.substr(1)));
  CHECK(!token.is(secret + "0"));
  CHECK(!token.is(secret + std::string(1, '\0')));
  CHECK(!token.is(secret + std::string(1000, '\0')));
  token.forget();
  CHECK(!token.is(secret));
  CHECK(!token.is(std::string(128, '\0')));
}

void addresses_within_the_machine() {
  for (const char* const address :
       {"tcp:127.0.0.1:5000", "tcp:127.1.2.3:0", "tcp:[::1]:5000", "unix:/run/cell.sock", "unix:@cell"})
    CHECK(is_within_the_machine(address));
  for (const char* const address :
       {"", "tcp::5000", "tcp:0.0.0.0:5000", "tcp:192.168.1.5:5000", "tcp:[::]:5000", "tcp:localhost:5000",
        "tcp:127.0.0.1.example.com:5000", "tcp:127.example.com:5000", "tcp:127.0.0.256:5000",
        "tcp:127.0.0:5000", "tcp:128.0.0.1:5000", "tcp:127.0.0.1", "tcp:[::1"})
    CHECK(!is_within_the_machine(address));
}

}  // namespace
}  // namespace flexrf::remote

int main() {
  using namespace flexrf::remote;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_private_file_with_one_line),
      CONTAINED_TEST(other_things_than_files),
      CONTAINED_TEST(only_the_token_is_the_token),
      CONTAINED_TEST(addresses_within_the_machine),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
