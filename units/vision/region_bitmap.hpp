// RegionBitmap: a rectangle of a picture, each of its pixels told apart by colour, and the blobs of one
// class.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "units/vision/colour_classes.hpp"
#include "units/vision/picture_view.hpp"

namespace flexrf::user {

/// Pixels of one class that hang together by their sides. Cells, which are pixels or squares of them.
struct Blob {
  std::uint8_t pixel_class = class_table;
  std::uint8_t label = 0;
  int area = 0;
  int left = 0;  ///< bounding box, right and bottom inclusive
  int top = 0;
  int right = 0;
  int bottom = 0;
  int first_column = 0;  ///< of the first cell in its first row
  double middle_column = 0;
  double middle_row = 0;
};

/// At most 160 x 160 cells. Of a rectangle that is larger each cell is the first pixel of a square of them.
/// Of one thread; allocates nothing.
class RegionBitmap {
 public:
  static constexpr int side = 160;
  static constexpr std::size_t most_blobs = 8;
  static constexpr int least_area = 24;  ///< pixels of a blob, but 6 cells at least; less is noise

  /// Takes the rectangle, which lies within the picture, and finds its blobs, the largest first, at most 8.
  /// Nothing is seen in `blind`. What is foreign and nowhere more than two cells wide is a blurred edge,
  /// which mixes two colours, and becomes the table. `least_scale`: pixels along a cell's side, at least.
  void take(const PictureView& picture, const PixelRectangle& rectangle, const PixelRectangle& blind,
            const ColourClasses& classes, const WhiteBalance& balance, int least_scale = 1) noexcept;

  std::span<const Blob> blobs() const noexcept { return {blobs_.data(), blob_count_}; }
  /// Whether there may be more blobs than blobs() has.
  bool is_full() const noexcept { return blob_count_ == most_blobs || run_count_ == most_runs; }
  const PixelRectangle& rectangle() const noexcept { return rectangle_; }
  int columns() const noexcept { return columns_; }
  int rows() const noexcept { return rows_; }
  int scale() const noexcept { return scale_; }  ///< pixels along a cell's side
  /// Pixels of the smallest blob there can be. What has less is taken for noise: the more, the larger a cell.
  std::uint32_t smallest_blob() const noexcept {
    return least_cells_ * static_cast<std::uint32_t>(scale_ * scale_);
  }
  /// Of the blob that a cell belongs to, 0: none. Outside of the bitmap 0.
  std::uint8_t label(int column, int row) const noexcept {
    return is_inside(column, row) ? labels_[place(column, row)] : std::uint8_t{0};
  }
  /// Of a cell; the table's outside of the bitmap.
  std::uint8_t pixel_class(int column, int row) const noexcept {
    return is_inside(column, row) ? classes_[place(column, row)] : class_table;
  }
  /// Whether it lies within what was looked at, and not in what is blind.
  bool is_seen(int column, int row) const noexcept {
    return is_inside(column, row) && classes_[place(column, row)] != class_unseen;
  }
  bool is_blind(int column, int row) const noexcept {
    return is_inside(column, row) && classes_[place(column, row)] == class_unseen;
  }
  /// The blob's bounding box lies at the rectangle's border, where the picture goes on.
  bool is_cut(const Blob& blob, const PictureView& picture) const noexcept;
  /// The blob's bounding box in pixels.
  PixelRectangle box_of(const Blob& blob) const noexcept;

 private:
  static constexpr std::uint8_t class_unseen = 0xFE;
  /// What has more is noise: of the rest nothing is seen.
  static constexpr std::size_t most_runs = 4096;

  struct Run {
    std::uint8_t from = 0;
    std::uint8_t to = 0;  // exclusive
    std::uint8_t row = 0;
    std::uint8_t pixel_class = class_table;
    std::uint16_t first = 0;  // the first run of its blob, or one that leads there
    std::uint8_t label = 0;
    // Of all the blob, with its first run only.
    std::uint8_t left = side;
    std::uint8_t right = 0;
    std::uint8_t bottom = 0;
    std::uint32_t area = 0;
    std::uint32_t columns = 0;  // sums over all cells
    std::uint32_t rows = 0;

    void add(const Run& other) noexcept;
  };
  /// A bit for each cell.
  using BitRow = std::array<std::uint64_t, (side + 63) / 64>;

  bool is_inside(int column, int row) const noexcept {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  static std::size_t place(int column, int row) noexcept {
    return static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column);
  }
  void classify(const PictureView& picture, const PixelRectangle& blind,
                const ColourClasses& classes) noexcept;
  bool is_shadow(const PictureView& picture, int column, int row,
                 const ColourClasses& classes) const noexcept;
  void drop_edges() noexcept;
  void find_blobs() noexcept;
  void find_runs() noexcept;
  void join(std::size_t one, std::size_t other) noexcept;
  void keep(const Run& first) noexcept;

  std::array<std::uint8_t, std::size_t{side} * side> classes_{};
  std::array<std::uint8_t, std::size_t{side} * side> labels_{};
  std::array<Run, most_runs> runs_{};
  std::size_t run_count_ = 0;
  std::array<BitRow, side> foreign_{};
  std::array<BitRow, side> kept_{};
  std::array<Blob, most_blobs> blobs_{};
  std::size_t blob_count_ = 0;
  PixelRectangle rectangle_;
  WhiteBalance balance_{{0, 0, 0}};  // that places_ was made for; no light has this one
  ColourClasses::Places places_{};
  int first_foreign_ = 0;  // rows with something foreign
  int last_foreign_ = -1;
  int columns_ = 0;
  int rows_ = 0;
  int scale_ = 1;
  std::uint32_t least_cells_ = least_area;
};

}  // namespace flexrf::user
