// What a page wants to see, and how often.
#pragma once

#include "runtime/face/directory.hpp"
#include "runtime/json/json_reader.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/image_worker.hpp"

namespace flexrf::panel {

/// The server's thread.
class Subscriptions {
 public:
  static constexpr double most_topics = 10;  ///< a second

  Subscriptions(Clients& clients, const Directory& directory, ImageWorker& images, Answers& answers) noexcept
      : clients_(&clients), directory_(&directory), images_(&images), answers_(&answers) {}

  /// Of a live client. Replaces what it had: {"slots": [{"name", "rate", "width"}], "topics": [{"name",
  /// "rate"}]}.
  void subscribe(const Caller& caller, Fields& fields, Time now);
  /// Tells the worker what is looked at, after a client came, changed or went.
  void update_demand();

 private:
  const char* read_slots(Client& client, JsonArray slots, Time now);
  const char* read_topics(Client& client, JsonArray topics, Time now);
  bool is_observed(std::string_view name, std::uint16_t& slot) const noexcept;
  void write_unknown(JsonWriter& json, JsonArray entries, bool topics) const;

  Clients* clients_;
  const Directory* directory_;
  ImageWorker* images_;
  Answers* answers_;
};

}  // namespace flexrf::panel
