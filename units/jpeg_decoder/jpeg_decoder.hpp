// JpegDecoder: pixels of a camera's compressed pictures, by libturbojpeg.
//
// libturbojpeg allocates with each picture and takes milliseconds: it belongs in a thread with priority 0,
// which a slot of pictures triggers. What it cannot decode without a doubt it counts and leaves out.
#pragma once

#include "jpeg_decoder_unit.hpp"

namespace flexrf::user {

class JpegDecoder final : public JpegDecoderUnit {
 public:
  ~JpegDecoder() override;

  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  void decode(const CameraFrame& from, Time sampled_at);
  void leave_out(const char* why);
  void leave_out_for_want_of_room(std::size_t size);

  void* decompressor_ = nullptr;
};

}  // namespace flexrf::user
