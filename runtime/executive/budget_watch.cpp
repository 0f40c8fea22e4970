#include "runtime/executive/budget_watch.hpp"

#include <sys/resource.h>

#include <ctime>
#include <utility>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr Duration interval = std::chrono::seconds{10};

double milliseconds(Duration duration) noexcept {
  return seconds(duration) * 1e3;
}

}  // namespace

BudgetWatch::Usage BudgetWatch::usage_of_this_thread() noexcept {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  rusage counted{};
  getrusage(RUSAGE_THREAD, &counted);
  return {std::chrono::seconds{used.tv_sec} + Duration{used.tv_nsec}, counted.ru_nvcsw};
}

void BudgetWatch::begin() noexcept {
  measures_ = std::exchange(suspects_, false);
  if (measures_) usage_ = usage_of_this_thread();
}

void BudgetWatch::note(std::uint16_t unit, Duration took, Time ended) noexcept {
  const Duration budget = application_->units[unit].budget;
  const bool exceeds = thread_->priority > 0 && budget.count() > 0 && took > budget;
  suspects_ = suspects_ || exceeds;
  if (!measures_) return;
  const Usage now = usage_of_this_thread();
  const Usage before = std::exchange(usage_, now);
  // Of a step that waited the whole time is its own: no unit may wait.
  const Duration own = now.waits != before.waits ? took : now.processor - before.processor;
  if (!exceeds || own <= budget) return;
  std::atomic<std::uint64_t>& counter = application_->unit_states[unit].budget_overruns;
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  ++exceeded_;
  if (own - budget > longest_) {
    longest_ = own - budget;
    longest_unit_ = unit;
  }
  if (say_at_ == Time{}) say(ended);
}

void BudgetWatch::say(Time now) noexcept {
  if (exceeded_ == 0 || now < say_at_) return;
  const ComponentRecord& unit = application_->units[longest_unit_];
  const double budget = milliseconds(unit.budget);
  const double took = milliseconds(unit.budget + longest_);
  if (say_at_ == Time{}) {
    log_warning(
        thread_->name,
        "a step of {} took {:.2} ms of its own, its budget is {:.2} ms; shorten the step or raise the "
        "budget in its row. More of them are summed up",
        StaticText{unit.name}, took, budget);
  } else {
    log_warning(thread_->name, "steps beyond their budget since then: {}, the worst of {}: {:.2} of {:.2} ms",
                exceeded_, StaticText{unit.name}, took, budget);
  }
  exceeded_ = 0;
  longest_ = Duration{};
  if (now != Time::max()) say_at_ = now + interval;
}

}  // namespace flexrf
