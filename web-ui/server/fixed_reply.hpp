// Replies with bytes that never change, in the form that a client understands, and only to who has not got
// them.
#pragma once

#include <string>
#include <string_view>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// Bytes that outlive the server, in the forms that are at hand.
struct FixedBytes {
  std::string_view tag;         ///< of their contents, without quotes
  std::string_view plain;       ///< empty: only compressed
  std::string_view compressed;  ///< with gzip; empty: only plain
};

/// Names the form that this client understands, or says 304 where it has that already. False: it would have
/// to be inflated.
bool answer_fixed(const Request& request, Reply& reply, const FixedBytes& bytes);
/// Says 304 instead of the reply's text where the client has that already.
void answer_text(const Request& request, Reply& reply);

/// Bytes that are at hand as they are: with a tag, and compressed where that saves something.
struct Document {
  explicit Document(std::string_view bytes);
  FixedBytes bytes() const noexcept { return {tag, plain, compressed}; }

  std::string tag;
  std::string_view plain;
  std::string compressed;
};

}  // namespace flexrf::panel
