// In the steady state no allocation reaches the system: values that are watched, holds that are refreshed,
// pings, values that are read.
#include <unistd.h>

#include "runtime/realtime/realtime_scope.hpp"
#include "web-ui/server/api/tests/rig.hpp"

namespace flexrf::panel {
namespace {

using fixture::ProducerAndConsumer;

void the_steady_state_allocates_nothing() {
  ProducerAndConsumer cell;
  Rig rig(cell);
  rig.start();
  rig.access().give(an_operator);
  PlayedLink& link = rig.connect(an_operator);
  PlayedLink& other = rig.connect(a_viewer);
  const json watch{
      {"op", "subscribe"},
      {"slots", {{{"name", "values"}, {"rate", 60}}, {{"name", "producer.runtime"}, {"rate", 60}}}},
      {"topics", {{{"name", "slots"}, {"rate", 10}}, {{"name", "components"}, {"rate", 10}}}}};
  rig.ask(link, watch);
  rig.ask(other, watch);
  std::string refresh;
  const auto hold = [&] {
    json held;
    // Not while the one before is still ending.
    CHECK(rig.wait_until([&] {
      held = rig.ask(link, {{"op", "hold"}, {"component", "producer"}, {"parameter", "move"}});
      return held.contains("lease");
    }));
    refresh = json{{"op", "refresh"}, {"id", 900}, {"lease", held.at("lease")}}.dump();
  };
  const std::string ping = R"({"op": "ping", "id": 901, "sent": 12345.5})";
  const std::string path = "/api/v1/slots/values";
  const std::string parameters = "/api/v1/components/producer/parameters";
  Request request;
  request.session = a_viewer;
  Reply reply;
  reply.text.reserve(PlayedLink::room);
  std::uint32_t exchange = 0;
  const auto turn = [&] {
    rig.api().live().on_text(link, refresh);
    rig.api().live().on_text(other, ping);
    for (const std::string* one : {&path, &parameters}) {
      request.path = *one;
      if (rig.api().handle(request, reply, {7, ++exchange}) != Handled::now || reply.status != 200)
        return false;
    }
    rig.tick();
    return link.closed == 0;
  };
  bool went_well = true;
  const auto run_for = [&](Duration duration) {
    for (const Time end = MonotonicClock::now() + duration; went_well && MonotonicClock::now() < end;)
      went_well = turn();
  };
  CHECK(has_allocation_guard());
  hold();
  // Until all memory has grown to what it is used for, also for the refusal when a machine that stood still
  // has ended the hold. What is played must not allocate either.
  link.keep = other.keep = false;
  for (int i = 0; i < 3; ++i) {
    usleep(300'000);  // longer than a lease
    run_for(std::chrono::milliseconds{100});
  }
  link.keep = other.keep = true;
  hold();
  link.keep = other.keep = false;
  run_for(std::chrono::milliseconds{1500});
  // Whatever a machine that stands still meanwhile makes longer than before has its room already.
  AllocationCounter count{0};
  {
    const RealtimeScope scope(count);
    run_for(std::chrono::milliseconds{1500});
  }
  CHECK(went_well);
  CHECK(link.sent > 100 && other.sent > 100);
  CHECK_EQUAL(count.load(), 0U);
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {CONTAINED_TEST(the_steady_state_allocates_nothing)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
