#include "hal/driver/device_bench.hpp"
#include "hal/operator/pointer/conformance/pointer_conformance.hpp"
#include "hal/operator/pointer/mock/mock_pointer.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public PointerWorld {
 public:
  Status start() override { return mock().initialise(); }
  Pointer& device() override { return mock(); }
  const PointerFeedback& feedback() override { return bench_.feedback(); }
  void receive() override { bench_.receive(std::chrono::milliseconds(7)); }

  void move(int x, int y) override { mock().move(x, y); }
  void turn_wheel(int detents) override { mock().turn_wheel(detents); }
  void press(std::size_t button) override { mock().press(button); }
  void let_go(std::size_t button) override { mock().let_go(button); }
  void unplug() override { mock().unplug(); }
  void plug_in() override { mock().plug_in(); }

  bool hide() override { return refuse(StatusCode::not_found); }
  bool forbid() override { return refuse(StatusCode::not_permitted); }
  bool occupy() override { return refuse(StatusCode::busy); }

 private:
  MockPointer& mock() { return bench_.driver(); }
  bool refuse(StatusCode code) {
    mock().refuse(Status::error(code, "scripted, not produced"));
    return true;
  }

  DeviceBench<MockPointer> bench_{nullptr};
};

}  // namespace

int main() {
  return run_pointer_conformance(
      "mock pointer", []() -> std::unique_ptr<PointerWorld> { return std::make_unique<MockWorld>(); });
}
