// Status line and header of a reply.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

struct ReplyHead {
  std::string_view date;  ///< as HTTP wants it
  bool keep_alive = true;
  std::string_view extra;  ///< further header lines, each with its end
};

/// What pages of ours may load and do, and what others may do with them: on every reply.
std::string_view security_headers() noexcept;

/// Replaces `text`.
void write_reply_head(std::string& text, const Reply& reply, const ReplyHead& head);

/// The reply's body: `fixed`, else `text`.
std::string_view body_of(const Reply& reply) noexcept;

/// Makes it as new, and keeps its memory.
void clear_reply(Reply& reply) noexcept;

}  // namespace flexrf::panel
