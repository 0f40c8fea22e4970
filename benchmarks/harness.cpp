#include "benchmarks/harness.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

#include "base/json_writer.hpp"
#include "base/text_table.hpp"

namespace flexrf::bench {
namespace {

std::atomic<bool> is_unsettled{false};

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::string processor() {
  std::ifstream file{"/proc/cpuinfo"};
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string machine() {
  utsname system{};
  uname(&system);
  double load[1] = {};
  getloadavg(load, 1);
  return text("%s, %ld CPUs, Linux %s, load %.1f", processor().c_str(), sysconf(_SC_NPROCESSORS_ONLN),
              static_cast<const char*>(system.release), load[0]);
}

std::string today() {
  const time_t now = time(nullptr);
  tm parts{};
  gmtime_r(&now, &parts);
  char date[16] = {};
  strftime(date, sizeof(date), "%F", &parts);
  return date;
}

std::string number(double value) {
  const double size = std::fabs(value);
  return text(size >= 1000 ? "%.0f" : size >= 100 ? "%.1f" : size >= 10 ? "%.2f" : "%.3f", value);
}

bool is_met(const Row& row) {
  return row.at_least ? row.value.high >= row.goal : row.value.low <= row.goal;
}

const char* verdict(const Row& row) {
  if (!row.has_goal) return "";
  return is_met(row) ? "met" : "missed";
}

}  // namespace

Estimate estimate(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> sample(values.begin(), values.end());
  const double median = median_of(sample);
  constexpr int resamplings = 2000;
  std::mt19937_64 random{20080511};
  std::uniform_int_distribution<std::size_t> which{0, values.size() - 1};
  std::vector<double> medians(resamplings);
  for (double& resampled : medians) {
    for (double& value : sample) value = values[which(random)];
    resampled = median_of(sample);
  }
  return {median, quantile(medians, 0.025), quantile(medians, 0.975)};
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = std::ceil(share * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>(std::max(place, 0.0))];
}

bool settle_thread(int cpu, int priority) {
  bool settled = true;
  if (cpu >= 0) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(cpu), &set);
    settled = pthread_setaffinity_np(pthread_self(), sizeof(set), &set) == 0;
  }
  if (priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    settled = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0 && settled;
  }
  if (!settled) is_unsettled = true;
  return settled;
}

void leave_real_time() {
  const sched_param parameters{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &parameters);
}

NoDeepIdle::NoDeepIdle() : descriptor_(open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
  const std::int32_t microseconds = 0;
  if (descriptor_ >= 0 && write(descriptor_, &microseconds, sizeof(microseconds)) < 0) {
    close(descriptor_);
    descriptor_ = -1;
  }
}

NoDeepIdle::~NoDeepIdle() {
  if (descriptor_ >= 0) close(descriptor_);
}

Report::Report(const char* name, int argument_count, char** arguments) : name_(name) {
  for (int i = 1; i < argument_count; ++i) {
    if (std::strcmp(arguments[i], "--quick") == 0) {
      quick_ = true;
    } else if (std::strcmp(arguments[i], "--json") == 0 && i + 1 < argument_count) {
      json_file_ = arguments[++i];
    } else {
      std::fprintf(stderr, "%s: unexpected '%s'; known: --quick, --json FILE\n", name, arguments[i]);
      std::exit(1);
    }
  }
}

void Report::add(Row row) {
  std::fprintf(stderr, "%s: %s: %s %s\n", name_.c_str(), row.what.c_str(), number(row.value.median).c_str(),
               row.unit.c_str());
  rows_.push_back(std::move(row));
}

void Report::add_ratio(std::string what, const Pairs& pairs, double goal, const char* unit,
                       const std::string& note, Goal kind) {
  Row row{std::move(what), "", pairs.ratio(), goal, true, ""};
  row.at_least = kind == Goal::at_least;
  row.ours = number(pairs.ours().median) + " " + unit;
  row.floor = number(pairs.floor().median) + " " + unit;
  row.note = "ours " + row.ours + ", floor " + row.floor + (note.empty() ? "" : "; " + note);
  add(std::move(row));
}

int Report::finish() {
  const std::string where = machine();
  std::printf("%s, %s, %s%s%s\n", name_.c_str(), today().c_str(), where.c_str(), quick_ ? ", quick" : "",
              is_unsettled ? ", threads not pinned or not SCHED_FIFO: the right is missing" : "");
  TextTable table{{"<what", "median", "95 % interval", "<", "goal", "<", "<note"}};
  JsonWriter json;
  json.begin_object().member("benchmark", name_).member("date", today()).member("machine", where);
  json.member("quick", quick_).member("settled", !is_unsettled).key("rows").begin_array();
  for (const Row& row : rows_) {
    const bool has_interval = row.value.low != row.value.high;
    table.add({row.what, number(row.value.median),
               has_interval ? number(row.value.low) + " - " + number(row.value.high) : "", row.unit,
               row.has_goal ? (row.at_least ? ">= " : "") + number(row.goal) : "", verdict(row), row.note});
    json.begin_object().member("what", row.what).member("unit", row.unit).member("median", row.value.median);
    json.member("low", row.value.low).member("high", row.value.high);
    if (row.has_goal) {
      json.member("goal", row.goal).member("at_least", row.at_least).member("met", is_met(row));
    }
    if (!row.ours.empty() || !row.floor.empty()) json.member("ours", row.ours).member("floor", row.floor);
    json.member("note", row.note).end_object();
  }
  json.end_array().key("remarks").begin_array();
  for (const std::string& remark : remarks_) json.value(remark);
  json.end_array().end_object();
  std::fputs(table.text("  ").c_str(), stdout);
  for (const std::string& remark : remarks_) std::printf("  - %s\n", remark.c_str());
  if (json_file_.empty()) return 0;
  std::ofstream file{json_file_};
  file << json.take();
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "%s: cannot write '%s'\n", name_.c_str(), json_file_.c_str());
  return 1;
}

std::string text(const char* format, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return buffer;
}

}  // namespace flexrf::bench
