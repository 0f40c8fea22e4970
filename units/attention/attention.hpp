// Attention: one member's judgement of where in a picture something may be.
#pragma once

#include <array>

#include "attention_unit.hpp"
#include "units/vision/attention_genes.hpp"
#include "units/vision/camera_view.hpp"
#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {

class Attention final : public AttentionUnit {
 public:
  Status initialise() override;
  void reset() noexcept override;
  void step(const Tick& tick) override;

 private:
  struct Window {
    float rating = 0;
    std::uint16_t left = 0;
    std::uint16_t top = 0;
    std::uint16_t side = 0;  ///< 0: it overlaps a better one
  };
  /// Where tracks are in the picture.
  struct Expected {
    std::array<Eigen::Vector2d, 32> places{};  ///< in pixels of the half-size picture
    std::size_t count = 0;
  };

  void find_expected(const VisualFeatures& of) noexcept;
  void rate_windows(const VisualFeatures& of) noexcept;
  double rate(const VisualFeatures& of, const FeatureWindow& window, double size) const noexcept;
  bool is_hidden(const FeatureWindow& window) const noexcept;
  void condense(const VisualFeatures& of) noexcept;
  std::size_t best_window() const noexcept;
  void suppress_around(const Window& window) noexcept;
  void post(Time sampled_at) noexcept;
  Genes genes() const noexcept;

  std::array<Window, most_windows> windows_{};
  std::size_t window_count_ = 0;
  Expected expected_;
  AttentionReport found_{};
  PixelRectangle blind_;
  std::uint16_t member_ = 0;
};

}  // namespace flexrf::user
