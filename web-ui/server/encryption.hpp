// TLS of the panel.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "web-ui/server/asio.hpp"

namespace flexrf::panel {

/// What `--tls-certificate` and `--tls-key` name, PEM: the chain with our own certificate first, and its key.
/// TLS 1.2 and newer. invalid_argument says which file is wrong and how to make both. Blocks.
Result<std::unique_ptr<net::ssl::context>> make_encryption(const std::string& certificate_file,
                                                           const std::string& key_file);

/// What kept a client from TLS, for the log; null: it only went away. Any thread.
const char* refusal_of_encryption(const error_code& failure) noexcept;

/// What a client is told, without TLS, that asked without it; empty: this failure is another. Any thread.
std::string_view answer_without_encryption(const error_code& failure) noexcept;

/// The command that makes a certificate of our own for this name or numeric address, for a person to copy.
std::string certificate_command(const std::string& host);

}  // namespace flexrf::panel
