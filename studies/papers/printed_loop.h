// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/law/tool.h"
#include "studies/scenes/bone_block.h"
#include "studies/scenes/signal_of.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::papers {

/// Why a row as printed has no figure where the papers' laws were not built.
inline constexpr const char* no_papers = "the papers' laws are not there: build kerf_as_printed, into lib/kerf-papers";

/// A law of the papers among the papers' bone: a voxel is bone or it is not, by its centre, of the tissue that its
/// centre lies in, and it stays until the drilling ends. The tool is where it is told to be, and the law takes the
/// difference of two poses for its rate.
///
/// Source: [tsai-2007] sections 4 and 5.
class PrintedLoop {
public:
    /// `grid`: that of the body made of `block`.   [main]
    PrintedLoop(const BoneBlock& block, const Grid& grid, const ToolSetup& setup, const Pose& start, double period);

    /// One tick, in which the tool goes to `next`.
    void go(const Pose& next);
    /// From the next tick on; where there is no such drive nothing happens.
    void command_drive(std::size_t drive, double value) noexcept {
        if (drive < setup_.drives.size()) setup_.drives[drive] = value;
    }

    [[nodiscard]] const Vec6& wrench() const noexcept {
        return wrench_;
    }  ///< bone on tool about its tip, tool frame [N, N·m]
    [[nodiscard]] double thrust() const noexcept { return -wrench_[2]; }  ///< [N] against the shaft
    /// The law's signal of this name; no number where it has none.
    [[nodiscard]] double signal(const char* id) const noexcept { return signal_of(setup_, signals_.data(), id); }
    [[nodiscard]] const Pose& at() const noexcept { return bone_.pose; }

private:
    struct Bone {
        BoneBlock block;
        Grid grid;
        Pose pose;
    };
    [[nodiscard]] kerf_bone_query query() const noexcept;
    static void sample(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                       std::uint32_t, kerf_bone_sample* out);
    static void nearest(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, kerf_surface_point* out);

    ToolSetup setup_;
    Bone bone_;
    double period_;
    Vec6 wrench_{};
    std::uint64_t tick_ = 0;
    std::vector<std::max_align_t> state_;
    std::vector<double> signals_;
};

}  // namespace kerf::papers
