// What an application with its panel takes: memory, and bytes that a browser loads.
#include <cctype>
#include <cstdio>
#include <map>
#include <set>
#include <thread>

#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/live_load.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

/// The page's files as they come over the wire, and which of them name which.
class Page {
 public:
  explicit Page(int port) : port_(port) {}

  /// Bytes of a file, compressed; 0: there is none.
  std::size_t size(const std::string& path) {
    if (const auto known = sizes_.find(path); known != sizes_.end()) return known->second;
    const HttpAnswer answer = ask(port_, "GET", path, "Accept-Encoding: gzip\r\n");
    return sizes_[path] = answer.status == 200 ? answer.body.size() : 0;
  }

  /// A file and all that it cannot do without.
  void add_with_needs(const std::string& path, std::set<std::string>& files) {
    if (!files.insert(path).second) return;
    const std::string text = ask(port_, "GET", path).body;
    for (const char* before : {"from\"./", "import\"./", "src=\"/assets/", "href=\"/assets/"}) {
      for (const std::string& name : names_after(text, before)) add_with_needs("/assets/" + name, files);
    }
  }
  /// A file of that name that the given one loads when it comes to it; empty: none.
  std::string loaded_by(const std::string& path, const std::string& name) {
    const std::string text = ask(port_, "GET", path).body;
    for (const std::string& one : names_after(text, "import(\"./")) {
      if (one.starts_with(name + "-")) return "/assets/" + one;
    }
    return {};
  }
  double kilobytes(const std::set<std::string>& files) {
    double sum = 0;
    for (const std::string& file : files) sum += static_cast<double>(size(file));
    return sum / 1000;
  }

 private:
  static std::vector<std::string> names_after(const std::string& text, const std::string& before) {
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
      at += before.size();
      names.push_back(text.substr(at, text.find('"', at) - at));
    }
    return names;
  }

  int port_;
  std::map<std::string, std::size_t> sizes_;
};

std::string first_starting(const std::set<std::string>& files, const std::string& prefix) {
  for (const std::string& file : files) {
    if (file.starts_with(prefix) && file.ends_with(".js")) return file;
  }
  return {};
}

}  // namespace

bool measure_memory(Report& report) {
  Cell cell{{place::keyboard}};
  if (!cell.begin()) return false;
  LiveLoad load;
  // A page: it looks at a few values, and something is asked for now and then.
  if (!load.begin({cell.port(),
                   cell.session(),
                   1,
                   false,
                   R"([{"name":"joints","rate":30},{"name":"tool_pose","rate":10}])",
                   {},
                   -1})) {
    return false;
  }
  for (const char* path : {"descriptor", "state", "components", "slots", "threads", "log"}) {
    cell.ask("GET", path);
  }
  std::this_thread::sleep_for(1s);
  const auto megabytes = [&](const char* line) { return cell.process().status_kilobytes(line) * 1.024e-3; };
  const double resident = megabytes("VmRSS");
  report.add({"memory of keyboard with its panel and a page, resident",
              "MB",
              {resident, resident, resident},
              14,
              true,
              text("%.1f MB of its own, %.1f MB of files", megabytes("RssAnon"), megabytes("RssFile"))});
  return true;
}

bool measure_page(Report& report) {
  Cell cell{{place::keyboard}};
  if (!cell.begin()) return false;
  Page page{cell.port()};
  std::set<std::string> files;
  page.add_with_needs("/", files);
  const std::string further = page.loaded_by(first_starting(files, "/assets/first-"), "further");
  if (further.empty()) {
    std::fputs("panel: the page's files are not as they were: footprint.cpp has to follow\n", stderr);
    return false;
  }
  const double first_view = page.kilobytes(files);
  report.add({"page: first view, gzip",
              "kB",
              {first_view, first_view, first_view},
              40,
              true,
              text("%zu files", files.size())});
  std::set<std::string> with_further = files;
  page.add_with_needs(further, with_further);
  const double changing = page.kilobytes(with_further);
  report.add(
      {"  the same with what changes values, gzip", "kB", {changing, changing, changing}, 0, false, ""});
  const std::string scene = page.loaded_by(further, "scene");
  if (scene.empty()) return true;
  std::set<std::string> of_scene;
  page.add_with_needs(scene, of_scene);
  for (const std::string& file : with_further) of_scene.erase(file);
  const double three = page.kilobytes(of_scene);
  report.add({"page: what draws in 3D, gzip", "kB", {three, three, three}, 175, true, ""});
  return true;
}

}  // namespace flexrf::bench
