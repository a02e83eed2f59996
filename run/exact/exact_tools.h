// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/field/tool_solid.h"
#include "core/remesh/remesh_child.h"

namespace kerf {

/// What exact surfaces are cut with. All that it points to must outlive them.
struct ExactTools {
    std::vector<const ToolSolid*> solids;  ///< by the records' numbers
    std::vector<RemeshChild*> strategies;  ///< of each solid; null: it leaves no exact surface
    RemeshChild* otherwise = nullptr;      ///< gets the stretches that a strategy declines; null: none
    std::string why_no_otherwise{};        ///< why it could not be started: part of a sentence
    double tolerance = 20e-6;              ///< [m] that a straight stretch may be off the recorded path
    double window = 2e-3;                  ///< [m] the longest stretch that is cut into a patch
    std::chrono::milliseconds limit = std::chrono::minutes(5);         ///< for a whole mesh
    std::chrono::milliseconds patch_limit = std::chrono::seconds(20);  ///< for a patch
    std::function<void(double fraction, const std::string& what)> progress{};
    std::function<bool()> is_cancelled{};  ///< asked before each request

    void report(double fraction, const std::string& what) const {
        if (progress) progress(fraction, what);
    }
    [[nodiscard]] bool are_cancelled() const { return is_cancelled && is_cancelled(); }
};

}  // namespace kerf
