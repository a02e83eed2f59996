// SPDX-License-Identifier: Apache-2.0
#include "bone/import/bone_mask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

/// Returns the voxels with the value `of` that are connected to `start` over faces; marks them in `seen`.
std::vector<std::size_t> connected(const BoneMask& mask, std::array<int, 3> start, bool of,
                                   std::vector<std::uint8_t>& seen) {
    std::vector<std::size_t> found;
    std::vector<std::array<int, 3>> open{start};
    seen[mask.image.offset(start[0], start[1], start[2])] = 1;
    while (!open.empty()) {
        const auto [i, j, k] = open.back();
        open.pop_back();
        found.push_back(mask.image.offset(i, j, k));
        for (const auto& step : face_neighbours) {
            const int x = i + step[0], y = j + step[1], z = k + step[2];
            if (!mask.image.has(x, y, z) || mask.at(x, y, z) != of) continue;
            if (auto& mark = seen[mask.image.offset(x, y, z)]; mark == 0) {
                mark = 1;
                open.push_back({x, y, z});
            }
        }
    }
    return found;
}

std::vector<std::vector<std::size_t>> pieces_of(const BoneMask& mask) {
    std::vector<std::vector<std::size_t>> pieces;
    std::vector<std::uint8_t> seen(mask.is_bone.size(), 0);
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        if (mask.is_bone[at] != 0 && seen[at] == 0) pieces.push_back(connected(mask, {i, j, k}, true, seen));
    });
    return pieces;
}

/// Removes the crumbs of pieces: of each piece of `before`, only the largest part remains.
void remove_crumbs(BoneMask& mask, const BoneMask& before) {
    std::vector<std::size_t> piece_before(mask.is_bone.size(), 0);
    std::size_t count = 0;
    for (const auto& piece : pieces_of(before)) {
        ++count;
        for (const std::size_t at : piece) piece_before[at] = count;
    }
    auto parts = pieces_of(mask);
    std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    std::vector<bool> has_part(count + 1, false);
    has_part[0] = true;
    for (const auto& part : parts) {
        bool is_needed = false;
        for (const std::size_t at : part) {
            if (!has_part[piece_before[at]]) is_needed = true;
            has_part[piece_before[at]] = true;
        }
        if (is_needed) continue;
        for (const std::size_t at : part) mask.is_bone[at] = 0;
    }
}

void keep_only(BoneMask& mask, const std::vector<std::size_t>& piece) {
    std::fill(mask.is_bone.begin(), mask.is_bone.end(), std::uint8_t{0});
    for (const std::size_t at : piece) mask.is_bone[at] = 1;
}

}  // namespace

std::size_t BoneMask::count() const {
    return static_cast<std::size_t>(std::count(is_bone.begin(), is_bone.end(), std::uint8_t{1}));
}

std::vector<BonePiece> bone_pieces(const BoneMask& mask) {
    std::vector<BonePiece> pieces;
    const auto& size = mask.image.size;
    for (const std::vector<std::size_t>& voxels : pieces_of(mask)) {
        const auto index_of = [&](std::size_t at) {
            const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
            return std::array<int, 3>{static_cast<int>(at % nx), static_cast<int>(at / nx % ny),
                                      static_cast<int>(at / (nx * ny))};
        };
        const bool is_at_face = std::any_of(voxels.begin(), voxels.end(), [&](std::size_t at) {
            const auto [i, j, k] = index_of(at);
            return i == 0 || j == 0 || k == 0 || i == size[0] - 1 || j == size[1] - 1 || k == size[2] - 1;
        });
        pieces.push_back({voxels.size(), index_of(voxels.front()), is_at_face});
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const BonePiece& a, const BonePiece& b) { return a.voxels > b.voxels; });
    return pieces;
}

int keep_largest(BoneMask& mask) {
    const auto pieces = pieces_of(mask);
    if (pieces.empty()) return 0;
    keep_only(mask, *std::max_element(pieces.begin(), pieces.end(),
                                      [](const auto& a, const auto& b) { return a.size() < b.size(); }));
    return static_cast<int>(pieces.size());
}

std::optional<double> keep_nearest(BoneMask& mask, Vec3 point) {
    double nearest = HUGE_VAL;
    std::array<int, 3> there{};
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        if (mask.is_bone[at] == 0) return;
        const double way =
            length(mask.image.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}) - point);
        if (way >= nearest) return;
        nearest = way;
        there = {i, j, k};
    });
    if (nearest == HUGE_VAL) return std::nullopt;
    std::vector<std::uint8_t> seen(mask.is_bone.size(), 0);
    keep_only(mask, connected(mask, there, true, seen));
    return nearest;
}

void spread(BoneMask& mask, bool value, double radius) {
    const VoxelImage& image = mask.image;
    std::array<int, 3> reach{};
    for (std::size_t axis = 0; axis < 3; ++axis) reach[axis] = static_cast<int>(radius / image.spacing(axis));
    std::vector<std::array<int, 3>> ball;
    for (int z = -reach[2]; z <= reach[2]; ++z)
        for (int y = -reach[1]; y <= reach[1]; ++y)
            for (int x = -reach[0]; x <= reach[0]; ++x)
                if (std::hypot(x * image.spacing(0), y * image.spacing(1), z * image.spacing(2)) <= radius)
                    ball.push_back({x, y, z});

    const BoneMask before = mask;
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        if ((before.is_bone[at] != 0) != value) return;
        const bool is_border = std::any_of(face_neighbours.begin(), face_neighbours.end(), [&](const auto& step) {
            const int x = i + step[0], y = j + step[1], z = k + step[2];
            return image.has(x, y, z) && before.at(x, y, z) != value;
        });
        if (!is_border) return;
        for (const auto& [x, y, z] : ball)
            if (image.has(i + x, j + y, k + z)) mask.is_bone[image.offset(i + x, j + y, k + z)] = value ? 1 : 0;
    });
}

void fill_cavities(BoneMask& mask) {
    std::vector<std::uint8_t> is_open(mask.is_bone.size(), 0);
    const auto& size = mask.image.size;
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        const bool is_face = i == 0 || j == 0 || k == 0 || i == size[0] - 1 || j == size[1] - 1 || k == size[2] - 1;
        if (is_face && mask.is_bone[at] == 0 && is_open[at] == 0) connected(mask, {i, j, k}, false, is_open);
    });
    for (std::size_t at = 0; at < is_open.size(); ++at)
        if (is_open[at] == 0) mask.is_bone[at] = 1;
}

void follow_grey(BoneMask& mask, double threshold) {
    const BoneMask before = mask;
    const auto is_bright = [&](int i, int j, int k) {
        return static_cast<double>(mask.image.at(i, j, k)) >= threshold;
    };
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        const bool is_bone = before.is_bone[at] != 0;
        if (!is_bone && !mask.is_other.empty() && mask.is_other[at] != 0) return;
        if (is_bone == is_bright(i, j, k)) return;
        for (const auto& [x, y, z] : face_neighbours) {
            if (!mask.image.has(i + x, j + y, k + z) || before.at(i + x, j + y, k + z) == is_bone) continue;
            // A bone voxel darker than the threshold becomes air only if brighter bone lies behind it, because
            // cancellous bone is dark.
            const bool has_rim =
                mask.image.has(i - x, j - y, k - z) && before.at(i - x, j - y, k - z) && is_bright(i - x, j - y, k - z);
            if (!is_bone || has_rim) mask.is_bone[at] = is_bone ? 0 : 1;
        }
    });
    remove_crumbs(mask, before);
}

}  // namespace kerf::bone
