// Cases of the conformance suite, of cameras that compress.
#pragma once

#include "hal/camera/conformance/camera_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf {

Verdict a_unit_sees_compressed_pictures(CameraWorld& world);
Verdict a_slot_gets_compressed_pictures(CameraWorld& world);
Verdict half_a_compressed_picture_is_counted_and_not_shown(CameraWorld& world);

}  // namespace flexrf
