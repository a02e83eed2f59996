// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bone/radiograph/attenuation.h"
#include "core/field/cut/cut_field.h"
#include "core/field/grid/body.h"
#include "core/field/grid/box.h"
#include "core/field/pieces/present_bone.h"

namespace kerf::bone {

/// A body of bone in an attenuation image. Bone and cut must not change while the image reads them.
struct AttenuatingBody {
    const Body* bone = nullptr;
    const CutField* cut = nullptr;
    Pose world_from_body = identity_pose();
    /// Bricks whose cut has changed since the last update, as in CutField::take_changed(). Nothing: any may have.
    std::optional<std::span<const std::size_t>> changed = std::nullopt;
    bool has_air = true;  ///< its cavities contain air; false for a part that separated from a body with cavities
};

/// Pose of a body of a BoneImage. `is_bone` is false for implants and for bodies that are not in the picture.
struct BodyInImage {
    Pose world_from_body = identity_pose();
    bool is_bone = true;
};

/// Returns a box around the bone of a body before any cut, along the world's axes; `empty_box` without bone. Where the
/// body is turned, it may be a brick larger than the bone on each side. The box for `AttenuationImage::around` joins
/// those of all bodies, also where they will be moved.   [worker] pure.
[[nodiscard]] Box bone_box(const Body& body, const Pose& world_from_body);

/// World frame [m].
struct Ellipsoid {
    Vec3 centre{}, semi_axes{};
};

/// Attenuation of the present bone on a dense grid of bytes, from which radiographs are made. World frame.
///
/// A voxel is the mean over its volume, to first order: tissues are weighted by how far their borders cover it.
/// Everything that is not bone is soft tissue, which counts as water; so is a drilled hole, which fills with blood.
/// Soft tissue ends at an ellipsoid around the box [assumed].
///
/// A value of its own: it has no thread and no lock. It may be made and used on any one thread at a time.
class AttenuationImage {
public:
    static constexpr int block_edge = 8;             ///< voxels of a block: voxels are made anew block by block
    static constexpr std::uint8_t water_value = 64;  ///< of the voxels of soft tissue
    /// Attenuation of a step of a voxel's value [1/m]. The largest value is bone of 2.9 g/cm³, as enamel.
    static constexpr double step = water_attenuation / water_value;

    struct Size {
        int voxels = 256;            ///< along the longest side of the box; 16 … 256
        double finest = 0.1e-3;      ///< [m] smallest edge of a voxel
        double soft_tissue = 80e-3;  ///< [m] from the ellipsoid around the box to the skin [assumed]
    };
    /// Makes an image of soft tissue that covers a box, in which all bone lies; bone outside is not in the picture.
    /// A box that is empty or not finite gives an image without voxels.   [worker]
    [[nodiscard]] static AttenuationImage around(const Box& world, const Size& size);
    [[nodiscard]] static AttenuationImage around(const Box& world) { return around(world, Size{}); }

    /// Makes the voxels anew that may differ from those of the last update: in changed bricks, and where a body was or
    /// is that moved, came or went. The result is, byte for byte, that of an image that never had another bone. Bodies
    /// keep their number from update to update. Pre: `bone` of a known body has not been replaced at its address.
    /// [worker]
    void update(std::span<const AttenuatingBody> bodies);
    /// The same for a snapshot of the present bone, which any thread may read. Pieces of the same address as in the
    /// last update are unchanged; of others, their bricks are compared. The image keeps the pieces until the next
    /// update. Pre: a pose for each piece; a piece without one is left out.   [worker]
    void update(const BoneImage& bone, std::span<const BodyInImage> bodies);

    [[nodiscard]] const std::array<int, 3>& voxels() const noexcept { return voxels_; }  ///< per axis
    [[nodiscard]] double spacing() const noexcept { return spacing_; }                   ///< [m]
    [[nodiscard]] Vec3 origin() const noexcept { return origin_; }  ///< centre of voxel (0, 0, 0) [m]
    [[nodiscard]] const Ellipsoid& soft_tissue() const noexcept { return soft_tissue_; }
    /// Returns all values, x fastest.
    [[nodiscard]] const std::vector<std::uint8_t>& values() const noexcept { return values_; }
    [[nodiscard]] std::uint8_t value(int i, int j, int k) const noexcept { return values_[line(j, k) + index(i)]; }

    /// The voxels of a line along x that are not soft tissue; `end` ≤ `begin`: none.
    struct Span {
        std::int16_t begin = 0, end = 0;
    };
    [[nodiscard]] Span bone_in_line(int j, int k) const noexcept { return spans_[line(j, k) / index(voxels_[0])]; }
    /// Number of voxels that the last update made anew.
    [[nodiscard]] std::size_t updated_voxels() const noexcept { return updated_; }

private:
    struct KnownBody {
        const Body* bone = nullptr;
        Pose world_from_body = identity_pose();
        bool has_air = true;
        Box bounds = empty_box;  ///< of all voxels that it may cover a part of, body frame
    };
    struct Placed;
    [[nodiscard]] static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    [[nodiscard]] std::size_t line(int j, int k) const noexcept {
        return (index(k) * index(voxels_[1]) + index(j)) * index(voxels_[0]);
    }
    void mark(const Box& box_in_body, const Pose& world_from_body);
    void remake(std::span<const AttenuatingBody> bodies);
    void mark_changes(std::span<const AttenuatingBody> bodies);
    void fill_block(std::array<int, 3> first, std::span<const Placed> bodies);
    void find_span(int j, int k) noexcept;

    std::array<int, 3> voxels_{}, blocks_{};
    double spacing_ = 0.0;
    Vec3 origin_{};
    Ellipsoid soft_tissue_{};
    std::vector<std::uint8_t> values_;
    std::vector<Span> spans_;             ///< of each line along x
    std::vector<std::uint8_t> is_stale_;  ///< of each block
    std::vector<KnownBody> known_;
    std::vector<std::shared_ptr<const PieceImage>> pieces_;  ///< of the last update from a BoneImage
    std::size_t updated_ = 0;
};

}  // namespace kerf::bone
