// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bone/remesh/cut_path.h"
#include "core/field/cut/sweep.h"
#include "core/field/cut/tool_solid.h"
#include "core/field/grid/box.h"

namespace kerf::bone {

/// Returns a box around the sweep of a solid on a stretch, with a margin.   [any] pure.
[[nodiscard]] Box swept_box(const ToolSolid& solid, const CutStretch& stretch);

/// The sweeps of tools so far. A stretch is covered if it only passes through earlier sweeps: backwards through a slot,
/// or in air. Points on the surface of the solid, at most `apart` [m] from each other, are compared with the earlier
/// sweeps grown by `tolerance` [m]. Copies have common data.   [worker]
class SweptBefore {
public:
    SweptBefore(std::vector<const ToolSolid*> solids, double tolerance, double apart)
        : solids_(std::move(solids)),
          tolerance_(tolerance),
          apart_(apart),
          points_of_(std::make_shared<std::vector<std::vector<Vec3>>>(solids_.size())) {}

    [[nodiscard]] bool covers(const CutStretch& stretch) const;
    void add(const CutStretch& stretch);

private:
    struct Swept {
        Sweep sweep;
        Box box;
    };
    std::vector<const ToolSolid*> solids_;
    double tolerance_, apart_;
    std::shared_ptr<std::vector<std::vector<Vec3>>> points_of_;  ///< for each solid, computed at first use
    std::vector<std::shared_ptr<const Swept>> swept_;
};

}  // namespace kerf::bone
