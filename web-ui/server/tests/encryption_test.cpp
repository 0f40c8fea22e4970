#include <arpa/inet.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <thread>

#include "tests/cmocka.hpp"
#include "web-ui/server/tests/served.hpp"

namespace flexrf::panel::encryption_test {
namespace {

char folder[] = "/tmp/flexrf_encryption_XXXXXX";

std::string path_of(const char* name) {
  return std::string{folder} + "/" + name;
}

/// A key and a certificate that it signed itself.
bool write_pair(const char* certificate_name, const char* key_name) {
  EVP_PKEY* key = EVP_EC_gen("P-256");
  X509* certificate = X509_new();
  ASN1_INTEGER_set(X509_get_serialNumber(certificate), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate), 0);
  X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
  X509_set_pubkey(certificate, key);
  X509_NAME* name = X509_get_subject_name(certificate);
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("panel.test"),
                             -1, -1, 0);
  X509_set_issuer_name(certificate, name);
  X509_sign(certificate, key, EVP_sha256());
  std::FILE* key_file = std::fopen(path_of(key_name).c_str(), "w");
  std::FILE* certificate_file = std::fopen(path_of(certificate_name).c_str(), "w");
  const bool written = key_file != nullptr && certificate_file != nullptr &&
                       PEM_write_PrivateKey(key_file, key, nullptr, nullptr, 0, nullptr, nullptr) == 1 &&
                       PEM_write_X509(certificate_file, certificate) == 1;
  if (key_file != nullptr) std::fclose(key_file);
  if (certificate_file != nullptr) std::fclose(certificate_file);
  X509_free(certificate);
  EVP_PKEY_free(key);
  return written;
}

int make_files(void**) {
  return mkdtemp(folder) != nullptr && write_pair("one.crt", "one.key") && write_pair("two.crt", "two.key")
             ? 0
             : -1;
}

int remove_files(void**) {
  for (const char* name : {"one.crt", "one.key", "two.crt", "two.key"}) unlink(path_of(name).c_str());
  return rmdir(folder);
}

/// What is wrong with these files; empty: nothing.
std::string fault_of(const char* certificate, const char* key) {
  return fault_of_encryption(path_of(certificate), path_of(key));
}

bool begins(const std::string& text, const std::string& beginning) {
  return text.rfind(beginning, 0) == 0;
}

void wrong_files_are_named(void**) {
  assert_true(fault_of("one.crt", "one.key").empty());
  assert_true(begins(fault_of("none.crt", "one.key"), "--tls-certificate " + path_of("none.crt")));
  assert_true(begins(fault_of("one.key", "one.key"), "--tls-certificate " + path_of("one.key")));
  assert_true(begins(fault_of("one.crt", "one.crt"), "--tls-key " + path_of("one.crt")));
  assert_true(begins(fault_of("one.crt", "two.key"), "--tls-key " + path_of("two.key")));
}

/// A client by TLS; gives what came back.
/// `ciphers`: of TLS 1.2, null: all.
std::string ask_encrypted(std::uint16_t port, const std::string& request, int newest_version,
                          const char* ciphers = nullptr) {
  const int socket_of_ours = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  assert_int_equal(connect(socket_of_ours, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  SSL_CTX* context = SSL_CTX_new(TLS_client_method());
  SSL_CTX_set_max_proto_version(context, newest_version);
  if (ciphers != nullptr) SSL_CTX_set_cipher_list(context, ciphers);
  SSL* stream = SSL_new(context);
  SSL_set_fd(stream, socket_of_ours);
  std::string text;
  if (SSL_connect(stream) == 1) {
    SSL_write(stream, request.data(), static_cast<int>(request.size()));
    char buffer[4096];
    for (int size = 0; (size = SSL_read(stream, buffer, sizeof(buffer))) > 0;) {
      text.append(buffer, static_cast<std::size_t>(size));
    }
  }
  SSL_free(stream);
  SSL_CTX_free(context);
  close(socket_of_ours);
  return text;
}

int serve(void** state) {
  *state = new Served(ServerSettings{}, {}, path_of("one.crt"), path_of("one.key"));
  return 0;
}

int end(void** state) {
  delete static_cast<Served*>(*state);
  return 0;
}

void requests_travel_encrypted(void** state) {
  auto& served = *static_cast<Served*>(*state);
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
    served.text =
        ask_encrypted(served.port(), get("/hello") + get("/large", "Connection: close\r\n"), version);
    assert_int_equal(status_of(served.text), 200);
    assert_true(has(served.text, "{\"hello\":true}"));
    assert_true(served.text.size() > 8U << 20U);
  }
  served.text = ask_encrypted(served.port(), get("/hello"), TLS1_1_VERSION);
  assert_true(served.text.empty());
}

void plain_requests_are_told_to_use_tls(void** state) {
  auto& served = *static_cast<Served*>(*state);
  assert_true(served.clients[0].connect(served.port()));
  served.clients[0].send(get("/hello"));
  served.text = served.clients[0].reply();
  assert_int_equal(status_of(served.text), 400);
  assert_true(has(served.text, "\r\n\r\nThe panel speaks TLS here: the address begins https://\n"));
}

void what_encrypts_without_authenticating_is_not_offered(void** state) {
  auto& served = *static_cast<Served*>(*state);
  const std::string request = "GET /hello HTTP/1.1\r\nHost: panel.test\r\nConnection: close\r\n\r\n";
  const auto ask = [&](const char* ciphers) {
    return ask_encrypted(served.port(), request, TLS1_2_VERSION, ciphers);
  };
  assert_int_equal(status_of(ask("ECDHE-ECDSA-AES128-GCM-SHA256")), 200);
  assert_int_equal(status_of(ask("ECDHE-ECDSA-CHACHA20-POLY1305")), 200);
  assert_int_equal(
      status_of(ask("ECDHE-ECDSA-AES128-SHA256:ECDHE-ECDSA-AES256-SHA384:ECDHE-ECDSA-AES128-SHA")), 0);
}

}  // namespace
}  // namespace flexrf::panel::encryption_test

int main() {
  using namespace flexrf::panel::encryption_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(wrong_files_are_named),
      cmocka_unit_test_setup_teardown(requests_travel_encrypted, serve, end),
      cmocka_unit_test_setup_teardown(plain_requests_are_told_to_use_tls, serve, end),
      cmocka_unit_test_setup_teardown(what_encrypts_without_authenticating_is_not_offered, serve, end),
  };
  return cmocka_run_group_tests(tests, make_files, remove_files);
}
