#include "web-ui/server/files.hpp"

#include <cstdint>
#include <cstdio>

#include "web-ui/server/gunzip.hpp"
#include "web-ui/server/gzip.hpp"
#include "web-ui/server/http_problem.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::panel {
namespace {

constexpr std::string_view application_folder = "/application/";

/// FNV-1a with 64 bits: a tag has to differ, not to withstand anybody.
std::string tag_of(std::string_view bytes) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001B3U;
  }
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

Files::Files(std::span<const PageFile> page, std::span<const PanelFile> application)
    : page_(page), application_(application) {
  for (const PanelFile& file : application) {
    application_tags_.push_back(tag_of(file.bytes));
    application_compressed_.push_back(gzip(file.bytes));
  }
}

bool Files::find(std::string_view path, PageFile& file, std::string_view& plain) const noexcept {
  if (path == "/") path = "/index.html";
  for (const PageFile& known : page_) {
    if (known.path != path) continue;
    file = known;
    return true;
  }
  if (!path.starts_with(application_folder)) return false;
  path.remove_prefix(application_folder.size());
  for (std::size_t i = 0; i < application_.size(); ++i) {
    if (application_[i].path != path) continue;
    const bool compressed = !application_compressed_[i].empty();
    plain = application_[i].bytes;
    file = {path,
            application_[i].content_type,
            application_tags_[i],
            compressed,
            false,
            compressed ? std::string_view{application_compressed_[i]} : application_[i].bytes};
    return true;
  }
  return false;
}

Handled Files::handle(const Request& request, Reply& reply, Ticket) {
  PageFile file{};
  std::string_view plain;
  if (!find(request.path, file, plain)) {
    answer_problem(reply, 404, "there is nothing of this name");
    return Handled::now;
  }
  if (request.method != Method::get && request.method != Method::head) {
    reply.allow = "GET, HEAD";
    answer_problem(reply, 405, "a file can only be read");
    return Handled::now;
  }
  const bool inflate = file.compressed && !request.accepts_gzip;
  // Each representation has a tag of its own.
  reply.etag = '"';
  reply.etag += file.tag;
  reply.etag += inflate ? "-i\"" : "\"";
  reply.cache_control = file.lasting ? "public, max-age=31536000, immutable" : "no-cache";
  reply.varies_by_encoding = file.compressed;
  reply.content_type = file.content_type;
  if (names_tag(request.if_none_match, reply.etag)) {
    reply.status = 304;
  } else if (!inflate) {
    reply.fixed = file.bytes;
    if (file.compressed) reply.content_encoding = "gzip";
  } else if (!plain.empty()) {
    reply.fixed = plain;
  } else if (!gunzip(file.bytes, reply.text)) {
    answer_problem(reply, 500, "the embedded file is broken; build the application anew");
  }
  return Handled::now;
}

}  // namespace flexrf::panel
