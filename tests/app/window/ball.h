// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/picked_bone.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf::test {

using namespace literals;

inline constexpr Vec3 ball_centre{3.0_mm, -4.0_mm, 5.0_mm};
inline constexpr double ball_radius = 20.0_mm;

/// An anatomy without landmarks: a ball off every axis.
inline const std::string ball_text = R"(# A ball.
apiVersion: kerf/v1
kind: Anatomy
metadata: {id: ball, title: A ball}
phantom:
  parts: [{id: ball, sphere: {centre: 3 -4 5 mm, radius: 20 mm}}]
tissues:
  - {id: cortical, thickness: 2 mm, density: 1.85 g/cm3}
  - {id: cancellous, density: 0.25 g/cm3}
)";

/// A file with an anatomy, and its bone.
struct PickedFile {
    TemporaryFolder folder;
    std::string file;
    std::unique_ptr<app::PickedBone> bone;

    explicit PickedFile(const std::string& text = ball_text, const std::string& shipped = "/nonexistent") {
        file = folder / "ball.yaml";
        std::ofstream(file, std::ios::binary) << text;
        open(shipped);
    }
    void open(const std::string& shipped = "/nonexistent") {
        text::Diagnostics diagnostics;
        auto made = app::PickedBone::make(file, std::nullopt, shipped).take(diagnostics);
        if (!made) throw std::runtime_error(to_text(diagnostics));
        bone = std::move(*made);
    }
};

}  // namespace kerf::test
