// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "core/plugin/component_info.h"

/// What a step could be modelled with: the bone at any spacing, and the tool with its features. For training and
/// research; not for diagnosis, planning or deciding treatment.
namespace kerf::plan {

/// The bone at a spacing [m]; nothing where it cannot be had.   [main]
using BoneAt = std::function<std::optional<Body>(double spacing)>;

/// The way a step goes, at a steady feed along the tool.
struct Way {
    Pose start = identity_pose();  ///< in air, before the entry
    Vec3 direction{0, 0, 1};       ///< of the feed, tool frame
    double length = 0.0;           ///< [m]
    double feed = 1e-3;            ///< [m/s]
    double turn = 0.0;             ///< [rad/m] about the shaft
};

/// Something that may be left out: parameters of tool or force set aside, or a part of what is known of the bone.
struct Feature {
    std::string id, help;
    /// What is there without it. Pre: the setup is the one the features were made for.
    std::function<void(ToolSetup& setup, Body& body)> leave_out;
};

/// The effects that tool and force say they can do without and that are there now, and of the bone: more than one
/// tissue, and a density of its own at every place.
[[nodiscard]] std::vector<Feature> features_of(const ToolSetup& setup, const ComponentInfo& tool,
                                               const ComponentInfo& force, const Body& body);

/// The parameter that says how finely the law works, if it says so.
struct Pitch {
    std::size_t param = 0;                ///< of the force
    double finest = 0.0, coarsest = 0.0;  ///< SI
    std::string unit;
};
[[nodiscard]] std::optional<Pitch> pitch_of(const ComponentInfo& force);

}  // namespace kerf::plan
