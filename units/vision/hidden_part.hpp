// What of a picture shows the arm's own hand, and what it holds.
#pragma once

#include "types/camera_model.hpp"
#include "types/target_in_hand.hpp"
#include "units/vision/picture_view.hpp"

namespace flexrf::user {

/// Where nothing is to be looked for: the camera's `blind`, and around that the held part as the camera sees
/// it. `hand` may be null: nothing is held. Any thread.
PixelRectangle hidden_part(const CameraModel& camera, const TargetInHand* hand) noexcept;

}  // namespace flexrf::user
