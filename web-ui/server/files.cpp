#include "web-ui/server/files.hpp"

#include "web-ui/server/gunzip.hpp"
#include "web-ui/server/http_problem.hpp"

namespace flexrf::panel {
namespace {

constexpr std::string_view application_folder = "/application/";

}  // namespace

Files::Files(std::span<const PageFile> page, std::span<const PanelFile> application)
    : page_(page), application_(application) {
  for (const PanelFile& file : application) documents_.emplace_back(file.bytes);
}

bool Files::find(std::string_view path, Found& file) const noexcept {
  if (path == "/") path = "/index.html";
  for (const PageFile& known : page_) {
    if (known.path != path) continue;
    file.bytes.tag = known.tag;
    (known.compressed ? file.bytes.compressed : file.bytes.plain) = known.bytes;
    file.content_type = known.content_type;
    file.lasting = known.lasting;
    return true;
  }
  if (!path.starts_with(application_folder)) return false;
  path.remove_prefix(application_folder.size());
  for (std::size_t i = 0; i < application_.size(); ++i) {
    if (application_[i].path != path) continue;
    file.bytes = documents_[i].bytes();
    file.content_type = application_[i].content_type;
    return true;
  }
  return false;
}

Handled Files::handle(const Request& request, Reply& reply, Ticket) {
  Found file;
  if (!find(request.path, file)) {
    answer_problem(reply, 404, "there is nothing of this name");
    return Handled::now;
  }
  if (request.method != Method::get && request.method != Method::head) {
    reply.allow = "GET, HEAD";
    answer_problem(reply, 405, "a file can only be read");
    return Handled::now;
  }
  reply.cache_control = file.lasting ? "public, max-age=31536000, immutable" : "no-cache";
  reply.content_type = file.content_type;
  if (!answer_fixed(request, reply, file.bytes) && !gunzip(file.bytes.compressed, reply.text))
    answer_problem(reply, 500, "the embedded file is broken; build the application anew");
  return Handled::now;
}

}  // namespace flexrf::panel
