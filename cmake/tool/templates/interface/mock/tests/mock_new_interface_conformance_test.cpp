#include "hal/driver/device_bench.hpp"
#include "hal/new_interface/conformance/new_interface_conformance.hpp"
#include "hal/new_interface/mock/mock_new_interface.hpp"

namespace flexrf {
namespace {

class MockWorld final : public NewInterfaceWorld {
 public:
  Status start() override { return bench_.driver().initialise(); }
  NewInterface& device() override { return bench_.driver(); }
  const NewInterfaceInterface::Feedback& feedback() override { return bench_.feedback(); }
  void cycle(const bool* command) override {
    bench_.receive(std::chrono::milliseconds{1});
    if (command != nullptr) bench_.driver().command(*command);
    bench_.send();
  }
  bool is_on() override { return bench_.driver().is_on(); }

 private:
  DeviceBench<MockNewInterface> bench_{nullptr};
};

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  return run_new_interface_conformance("mock of NewInterface", []() -> std::unique_ptr<NewInterfaceWorld> {
    return std::make_unique<MockWorld>();
  });
}
