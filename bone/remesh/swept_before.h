// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bone/remesh/cut_path.h"
#include "core/field/cut/sweep.h"
#include "core/field/cut/tool_solid.h"
#include "core/field/grid/box.h"

namespace kerf {

/// A box that holds what a solid sweeps on a stretch, and a little more.   [any] pure.
[[nodiscard]] Box swept_box(const ToolSolid& solid, const CutStretch& stretch);

/// What tools have swept. Stretches that only pass where others, before them, have are covered: on the way back through
/// a slot, or in the air. Points on the surface of the solid, at most `apart` [m] from each other, are compared with
/// what was swept before, grown by `tolerance` [m]. Copies share what they hold.   [worker]
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
    std::shared_ptr<std::vector<std::vector<Vec3>>> points_of_;  ///< of each solid, once it was asked for
    std::vector<std::shared_ptr<const Swept>> swept_;
};

}  // namespace kerf
