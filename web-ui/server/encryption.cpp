#include "web-ui/server/encryption.hpp"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {
namespace {

Status wrong_file(const char* option, const std::string& file, const error_code& error) {
  // Asio's own text of an error of OpenSSL 3 says nothing.
  const char* reason = ERR_reason_error_string(static_cast<unsigned long>(error.value()));
  if (access(file.c_str(), R_OK) != 0) reason = std::strerror(errno);
  return Status::error(StatusCode::invalid_argument, "%s %s: %s; a readable PEM file is wanted", option,
                       file.c_str(), reason == nullptr ? "not understood" : reason);
}

}  // namespace

Result<std::unique_ptr<net::ssl::context>> make_encryption(const std::string& certificate_file,
                                                           const std::string& key_file) {
  auto context = std::make_unique<net::ssl::context>(net::ssl::context::tls_server);
  error_code error;
  context->set_options(net::ssl::context::default_workarounds | net::ssl::context::no_compression, error);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  // Of TLS 1.2 only what authenticates as it encrypts, with a key of each connection; TLS 1.3 knows nothing
  // else.
  SSL_CTX_set_cipher_list(context->native_handle(), "ECDHE+AESGCM:ECDHE+CHACHA20");
  SSL_CTX_set_session_cache_mode(context->native_handle(), SSL_SESS_CACHE_OFF);
  context->use_certificate_chain_file(certificate_file, error);
  if (error) return wrong_file("--tls-certificate", certificate_file, error);
  context->use_private_key_file(key_file, net::ssl::context::pem, error);
  if (error) return wrong_file("--tls-key", key_file, error);
  if (SSL_CTX_check_private_key(context->native_handle()) != 1) {
    return Status::error(StatusCode::invalid_argument, "--tls-key %s: not the key of the certificate %s",
                         key_file.c_str(), certificate_file.c_str());
  }
  return context;
}

const char* refusal_of_encryption(const error_code& failure) noexcept {
  if (failure.category() != net::error::get_ssl_category()) return nullptr;
  switch (ERR_GET_REASON(static_cast<unsigned long>(failure.value()))) {
    case SSL_R_HTTP_REQUEST:
      return "it asked without TLS; the address begins with https://";
    case SSL_R_UNSUPPORTED_PROTOCOL:
    case SSL_R_VERSION_TOO_LOW:
      return "it knows no version of TLS that is allowed here (1.2 and 1.3)";
    case SSL_R_NO_SHARED_CIPHER:
      return "it knows no encryption that is allowed here (AES-GCM and ChaCha20-Poly1305)";
    case SSL_R_WRONG_VERSION_NUMBER:
      return "what it sent is no TLS";
    default:
      return ERR_reason_error_string(static_cast<unsigned long>(failure.value()));
  }
}

std::string_view answer_without_encryption(const error_code& failure) noexcept {
  if (failure.category() != net::error::get_ssl_category() ||
      ERR_GET_REASON(static_cast<unsigned long>(failure.value())) != SSL_R_HTTP_REQUEST)
    return {};
  return "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain\r\nContent-Length: 55\r\n"
         "Connection: close\r\n\r\n"
         "The panel speaks TLS here: the address begins https://\n";
}

std::string certificate_command(const std::string& host) {
  const bool is_numeric = Address::parse(host).has_value();
  return "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 825 -subj \"/CN=" +
         host + "\" -addext \"subjectAltName=" + (is_numeric ? "IP:" : "DNS:") + host +
         "\" -keyout panel.key -out panel.crt";
}

}  // namespace flexrf::panel
