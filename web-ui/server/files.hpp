// What is served from memory: the page, and the files that the application brings along.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "runtime/executive/panel_record.hpp"
#include "web-ui/server/fixed_reply.hpp"

namespace flexrf::panel {

/// One file of the page, as the build embedded it.
struct PageFile {
  std::string_view path;  ///< "/assets/index-5f3a.js"
  std::string_view content_type;
  std::string_view tag;  ///< of its contents, without quotes
  bool compressed;       ///< with gzip
  bool lasting;          ///< its name changes with its contents
  std::string_view bytes;
};

/// All files of the page.
std::span<const PageFile> page_files() noexcept;

/// Answers GET and HEAD of files; `/` is the page's index.html, `/application/PATH` a file of the
/// application. The server's thread.
class Files {
 public:
  /// What is named lives for ever. Compresses the application's files where that saves something.
  Files(std::span<const PageFile> page, std::span<const PanelFile> application);

  Handled handle(const Request& request, Reply& reply, Ticket ticket);

 private:
  struct Found {
    FixedBytes bytes;
    std::string_view content_type;
    bool lasting = false;
  };
  bool find(std::string_view path, Found& file) const noexcept;

  std::span<const PageFile> page_;
  std::span<const PanelFile> application_;
  std::vector<Document> documents_;  // of the application's
};

}  // namespace flexrf::panel
