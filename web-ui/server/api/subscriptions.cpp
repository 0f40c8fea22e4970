#include "web-ui/server/api/subscriptions.hpp"

#include <algorithm>
#include <limits>

#include "runtime/face/observed_slots.hpp"
#include "web-ui/server/api/topic_bodies.hpp"

namespace flexrf::panel {
namespace {

constexpr std::uint64_t default_width = 640;
constexpr std::uint64_t largest_width = 4096;

bool topic_named(std::string_view name, std::size_t& topic) noexcept {
  for (topic = 0; topic < topic_count; ++topic) {
    if (name == name_of(static_cast<Topic>(topic))) return true;
  }
  return false;
}

}  // namespace

bool Subscriptions::is_observed(std::string_view name, std::uint16_t& slot) const noexcept {
  const auto found = directory_->slot(name);
  if (!found || directory_->slots()[*found].observer == nullptr) return false;
  slot = *found;
  return true;
}

const char* Subscriptions::read_slots(Client& client, JsonArray slots, Time now) {
  for (const JsonElement element : slots) {
    JsonObject object;
    if (element.get(object) != simdjson::SUCCESS)
      return "'slots' is a list of {\"name\", \"rate\", \"width\"}";
    Fields fields(object);
    const std::string_view name = fields.text("name");
    const double rate = fields.number_or("rate", SlotRate::usual);
    const std::uint64_t width = fields.integer_or("width", default_width);
    if (!fields.status() || !SlotRate::is_possible(rate) || width < 1 || width > largest_width)
      return "a slot's 'name' is a text, its 'rate' lies from 0.01 to 60 a second, its 'width' from 1 to "
             "4096";
    SlotSubscription wanted;
    if (!is_observed(name, wanted.slot)) continue;
    wanted.width = static_cast<std::uint16_t>(width);
    wanted.interval = duration_of(1 / rate);
    wanted.next = now;
    const auto same =
        std::find_if(client.slots.begin(), client.slots.end(),
                     [&wanted](const SlotSubscription& one) { return one.slot == wanted.slot; });
    if (same == client.slots.end()) {
      client.slots.push_back(wanted);
    } else {
      same->interval = std::min(same->interval, wanted.interval);
      same->width = std::max(same->width, wanted.width);
    }
  }
  return nullptr;
}

const char* Subscriptions::read_topics(Client& client, JsonArray topics, Time now) {
  for (const JsonElement element : topics) {
    JsonObject object;
    if (element.get(object) != simdjson::SUCCESS) return "'topics' is a list of {\"name\", \"rate\"}";
    Fields fields(object);
    const std::string_view name = fields.text("name");
    const double rate = fields.number_or("rate", 1);
    if (!fields.status() || !(rate >= SlotRate::slowest && rate <= most_topics))
      return "a topic's 'name' is a text, its 'rate' lies from 0.01 to 10 a second";
    std::size_t topic = 0;
    if (topic_named(name, topic)) client.topics[topic] = {duration_of(1 / rate), now, 0};
  }
  return nullptr;
}

void Subscriptions::subscribe(const Caller& caller, Fields& fields, Time now) {
  Client* const client = clients_->find(caller);
  if (client == nullptr) return;
  std::optional<JsonArray> slots;
  std::optional<JsonArray> topics;
  if (fields.has("slots")) slots = fields.array("slots");
  if (fields.has("topics")) topics = fields.array("topics");
  const char* wrong = fields.status() ? nullptr : fields.status().cause();
  if (wrong == nullptr) {
    const std::uint64_t log_seen = client->topics[static_cast<std::size_t>(Topic::log)].seen;
    client->slots.clear();
    client->topics = {};
    if (slots) wrong = read_slots(*client, *slots, now);
    if (wrong == nullptr && topics) wrong = read_topics(*client, *topics, now);
    // Who goes on looking at the log needs no line twice.
    client->topics[static_cast<std::size_t>(Topic::log)].seen = log_seen;
    update_demand();
  }
  if (wrong != nullptr) return answers_->refuse(caller, RefusalKind::bad_request, "subscribe: %s.", wrong);
  answers_->done(caller, [&](JsonWriter& json) {
    json.key("unknown").begin_array();
    if (slots) write_unknown(json, *slots, false);
    if (topics) write_unknown(json, *topics, true);
    json.end_array();
  });
}

void Subscriptions::write_unknown(JsonWriter& json, JsonArray entries, bool topics) const {
  for (const JsonElement element : entries) {
    std::string_view name;
    if (element.at_key("name").get(name) != simdjson::SUCCESS) continue;
    std::uint16_t slot = 0;
    std::size_t topic = 0;
    if (topics ? !topic_named(name, topic) : !is_observed(name, slot)) json.value(name);
  }
}

void Subscriptions::update_demand() {
  for (std::size_t i = 0; i < directory_->slots().size(); ++i) {
    const auto slot = static_cast<std::uint16_t>(i);
    if (!images_->is_image(slot)) continue;
    std::uint32_t width = 0;
    Duration interval{std::numeric_limits<Duration::rep>::max()};
    for (const Client& client : clients_->all()) {
      for (const SlotSubscription& subscription : client.slots) {
        if (subscription.slot != slot) continue;
        width = std::max<std::uint32_t>(width, subscription.width);
        interval = std::min(interval, subscription.interval);
      }
    }
    images_->demand(slot, width, width == 0 ? Duration{} : interval);
  }
}

}  // namespace flexrf::panel
