#include "web-ui/server/fixed_reply.hpp"

#include "runtime/core/digest.hpp"
#include "web-ui/server/gzip.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::panel {
namespace {

/// 16 hexadecimal digits: it has to differ, not to withstand anybody.
void append_tag(std::string& tag, std::string_view bytes) {
  Digest digest;
  digest.add_text(bytes);
  for (int shift = 60; shift >= 0; shift -= 4) tag += "0123456789abcdef"[(digest.value() >> shift) & 15U];
}

}  // namespace

Document::Document(std::string_view bytes) : plain(bytes), compressed(gzip(bytes)) {
  append_tag(tag, bytes);
}

bool answer_fixed(const Request& request, Reply& reply, const FixedBytes& bytes) {
  const bool has_choice = !bytes.compressed.empty();
  const bool as_plain = !has_choice || !request.accepts_gzip;
  // Each form has a tag of its own.
  reply.etag.assign("\"").append(bytes.tag).append(has_choice && as_plain ? "-i\"" : "\"");
  reply.varies_by_encoding = has_choice;
  if (names_tag(request.if_none_match, reply.etag)) {
    reply.status = 304;
    return true;
  }
  if (has_choice && as_plain && bytes.plain.empty()) return false;
  reply.fixed = as_plain ? bytes.plain : bytes.compressed;
  if (!as_plain) reply.content_encoding = "gzip";
  return true;
}

void answer_text(const Request& request, Reply& reply) {
  reply.etag = '"';
  append_tag(reply.etag, reply.text);
  reply.etag += '"';
  if (!names_tag(request.if_none_match, reply.etag)) return;
  reply.status = 304;
  reply.text.clear();
}

}  // namespace flexrf::panel
