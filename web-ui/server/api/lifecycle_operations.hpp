// Start, stop and initialise of one component, as its lifecycle thread does them.
#pragma once

#include <memory>

#include "runtime/executive/executive.hpp"
#include "runtime/face/directory.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/mailbox.hpp"
#include "web-ui/server/api/places.hpp"

namespace flexrf::panel {

/// Answers its caller when it is done. The server's thread.
class LifecycleOperations {
 public:
  LifecycleOperations(Executive& executive, Doorbell* bell, const Directory& directory, Answers& answers,
                      Permission& permission)
      : executive_(&executive),
        outcomes_(std::make_shared<Mailbox<Outcome>>(bell)),
        directory_(&directory),
        answers_(&answers),
        permission_(&permission) {}

  void act(const Caller& caller, ComponentIndex component, ComponentAction action);
  void tick();

 private:
  static constexpr std::size_t most_waiting = 8;

  struct Waiting {
    Caller caller;
    ComponentIndex component = 0;
    std::uint64_t number = 0;
  };
  struct Outcome {
    std::uint64_t number;
    Status status;
  };

  void answer(const Waiting& waiting, const Status& status);

  Executive* executive_;
  std::shared_ptr<Mailbox<Outcome>> outcomes_;
  const Directory* directory_;
  Answers* answers_;
  Permission* permission_;
  Places<Waiting, most_waiting> waiting_;
  std::uint64_t last_number_ = 0;
};

}  // namespace flexrf::panel
