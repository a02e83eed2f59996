// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/voxel_bone.h"

#include <algorithm>
#include <cmath>

namespace kerf::chart {

VoxelBone::VoxelBone(const ExactBone& bone, double spacing, Vec3 offset, Reading reading)
    : spacing_(spacing), origin_(bone.low + spacing * (offset - Vec3{1, 1, 1})), reading_(reading) {
    const Vec3 extent = (1.0 / spacing) * (bone.high - bone.low);
    size_[0] = static_cast<int>(extent.x) + 3;
    size_[1] = static_cast<int>(extent.y) + 3;
    size_[2] = static_cast<int>(extent.z) + 3;
    for (const ExactBone::Tissue& tissue : bone.tissues) densities_.push_back(tissue.density);
    voxels_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                   static_cast<std::size_t>(size_[2]));
    for (int k = 0; k < size_[2]; ++k)
        for (int j = 0; j < size_[1]; ++j)
            for (int i = 0; i < size_[0]; ++i) {
                Voxel& voxel = *at(i, j, k);
                voxel.tissue =
                    static_cast<std::int8_t>(bone.tissue_at(origin_ + spacing * Vec3{i + 0.5, j + 0.5, k + 0.5}));
                bone_count_ += voxel.tissue >= 0 ? 1 : 0;
            }
    query_.size = sizeof query_;
    query_.tissue_count = static_cast<std::uint32_t>(densities_.size());
    query_.reach = 4.0 * spacing;
    query_.bone = reinterpret_cast<const kerf_bone*>(this);
    query_.sample = [](const kerf_bone* self, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                       std::uint32_t,
                       kerf_bone_sample* out) { reinterpret_cast<const VoxelBone*>(self)->sample(points, count, out); };
    query_.nearest = [](const kerf_bone* self, const kerf_vec3*, std::uint32_t count, kerf_surface_point* out) {
        const double reach = reinterpret_cast<const VoxelBone*>(self)->query_.reach;
        for (std::uint32_t i = 0; i < count; ++i) out[i] = {reach, {0, 0, 0}, -1, 0};
    };
}

VoxelBone::Voxel* VoxelBone::at(int i, int j, int k) const noexcept {
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return nullptr;
    return &voxels_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(j)) *
                        static_cast<std::size_t>(size_[0]) +
                    static_cast<std::size_t>(i)];
}

void VoxelBone::answer_binary(const Voxel* voxel, kerf_bone_sample& out) const noexcept {
    const bool is_bone = voxel != nullptr && voxel->tissue >= 0 && voxel->left > 0.0F;
    out.engagement = is_bone ? 1.0 : 0.0;
    for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) out.weight[m] = 0.0;
    if (is_bone) out.weight[voxel->tissue] = 1.0;
}

void VoxelBone::answer_mixed(Vec3 p, kerf_bone_sample& out) const noexcept {
    const double gx = p.x - 0.5, gy = p.y - 0.5, gz = p.z - 0.5;  // voxels' centres are the nodes
    const int i = static_cast<int>(std::floor(gx)), j = static_cast<int>(std::floor(gy)),
              k = static_cast<int>(std::floor(gz));
    const double f[3] = {gx - i, gy - j, gz - k};
    double share[KERF_MAX_TISSUES] = {}, density = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int di = corner & 1, dj = (corner >> 1) & 1, dk = corner >> 2;
        const Voxel* voxel = at(i + di, j + dj, k + dk);
        if (voxel == nullptr || voxel->tissue < 0) continue;
        const double w = (di != 0 ? f[0] : 1.0 - f[0]) * (dj != 0 ? f[1] : 1.0 - f[1]) * (dk != 0 ? f[2] : 1.0 - f[2]) *
                         static_cast<double>(voxel->left);
        share[voxel->tissue] += w;
        density += w * densities_[static_cast<std::size_t>(voxel->tissue)];
    }
    double sum = 0.0;
    for (const double s : share) sum += s;
    if (reading_ == Reading::density) {
        out.engagement = density > 0.0 ? 1.0 : 0.0;
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) out.weight[m] = m == 0 ? out.engagement : 0.0;
        out.density[0] = density;
        return;
    }
    out.engagement = sum;
    for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) out.weight[m] = sum > 0.0 ? share[m] / sum : 0.0;
}

void VoxelBone::sample(const kerf_vec3* points, std::uint32_t count, kerf_bone_sample* out) const noexcept {
    for (std::uint32_t n = 0; n < count; ++n) {
        kerf_bone_sample& one = out[n];
        one.gap = 0.0;
        one.reserved = 0;
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) one.density[m] = m < densities_.size() ? densities_[m] : 0.0;
        const Vec3 p = (1.0 / spacing_) * (body_from_tool_ * points[n] - origin_);
        Voxel* voxel =
            at(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)), static_cast<int>(std::floor(p.z)));
        if (reading_ == Reading::binary)
            answer_binary(voxel, one);
        else
            answer_mixed(p, one);
        one.body = one.engagement > 0.0 ? 0 : -1;
        if (loss_ > 0.0 && voxel != nullptr && voxel->tissue >= 0)
            voxel->left = std::max(0.0F, voxel->left - static_cast<float>(loss_));
    }
}

void VoxelBone::take(const std::function<bool(Vec3)>& is_taken) {
    for (int k = 0; k < size_[2]; ++k)
        for (int j = 0; j < size_[1]; ++j)
            for (int i = 0; i < size_[0]; ++i) {
                Voxel& voxel = *at(i, j, k);
                if (voxel.tissue >= 0 && is_taken(origin_ + spacing_ * Vec3{i + 0.5, j + 0.5, k + 0.5}))
                    voxel.left = 0.0F;
            }
}

double VoxelBone::removed_volume() const noexcept {
    std::size_t gone = 0;
    for (const Voxel& voxel : voxels_) gone += voxel.tissue >= 0 && voxel.left <= 0.0F ? 1 : 0;
    return static_cast<double>(gone) * spacing_ * spacing_ * spacing_;
}

}  // namespace kerf::chart
