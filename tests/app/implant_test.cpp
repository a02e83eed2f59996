// SPDX-License-Identifier: Apache-2.0
// An implant comes into the scene where the tool is; its surface is read like a bone's, with the same care.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "session/recorder.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::app {
namespace {

/// A plate of 30 × 30 × 3 mm across the tool's axis, from 8 mm ahead of the tip; without the first faces it is open.
std::string plate(std::size_t first = 0) {
    constexpr std::array<std::array<int, 3>, 12> faces{{{0, 2, 1},
                                                        {1, 2, 3},
                                                        {4, 5, 6},
                                                        {5, 7, 6},
                                                        {0, 1, 4},
                                                        {1, 5, 4},
                                                        {2, 6, 3},
                                                        {3, 6, 7},
                                                        {0, 4, 2},
                                                        {2, 4, 6},
                                                        {1, 3, 5},
                                                        {3, 7, 5}}};
    std::string text = "solid plate\n";
    for (std::size_t f = first; f < faces.size(); ++f) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int corner : faces[f])
            text += std::string("vertex ") + ((corner & 1) != 0 ? "15 " : "-15 ") +
                    ((corner & 2) != 0 ? "15 " : "-15 ") + ((corner & 4) != 0 ? "11\n" : "8\n");
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid plate\n";
}

/// The pedicle screw's pilot hole, with a plate brought in 15 mm before the bone.
struct WithPlate {
    test::TemporaryFolder folder;
    std::string file = folder / "plate.yaml";

    explicit WithPlate(const std::string& surface) {
        std::filesystem::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy",
                              std::filesystem::copy_options::recursive);
        if (!surface.empty()) std::ofstream(folder / "plate.stl") << surface;
        std::string text = test::contents_of(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml");
        const auto put = [&](const std::string& before, const std::string& after) {
            const std::size_t at = text.find(before);
            ASSERT_NE(at, std::string::npos) << before;
            text.replace(at, before.size(), after);
        };
        put("steps:\n", "implants:\n  plate: {mesh: {file: plate.stl, unit: mm, frame: LPS}}\nsteps:\n");
        put("{depth: -5 mm, direction: surface}", "{depth: -15 mm, insert: plate}");
        put("{depth: 5 mm, direction: surface, stop: {aside: 2 mm}}", "{depth: 5 mm}");
        put("{depth: 3 mm, direction: surface}", "{depth: 3 mm}");
        put("spacing: 0.25 mm", "spacing: 0.5 mm");
        std::ofstream(file) << text;
    }
};

TEST(Implant, StopsTheDrillWhereItLies) {
    // Given a plate from 7 to 4 mm before the bone
    const WithPlate with(plate());
    text::Diagnostics diagnostics;
    const auto scene = run::make_scene(with.file, "", test::plugins()).take(diagnostics);
    ASSERT_TRUE(scene) << to_text(diagnostics);
    run::RunRequest request;
    request.out = with.folder / "run";
    const test::WatchedRun run = test::watched_run(*scene, test::plugins(), request);
    ASSERT_EQ(run.error, "");
    // Then the drill meets metal and never bone, and that is told
    const auto happened = [&](const std::string& id) {
        return std::any_of(run.events.begin(), run.events.end(),
                           [&](const session::EventRow& e) { return e.id == id; });
    };
    EXPECT_TRUE(happened("haptics.met_metal"));
    EXPECT_FALSE(happened("entered_bone"));
    double deepest = -1.0;
    for (const session::TickRow& row : run.ticks) deepest = std::max(deepest, row.depth);
    EXPECT_NEAR(deepest, -7e-3, 0.5e-3 /* its lips stand off the plate by their own angle */);
    EXPECT_EQ(run.summary.verdict, session::Verdict::incomplete);
    EXPECT_EQ(run.summary.removed, 0.0);
    // and it has a surface of its own: 30 × 30 × 3 mm
    ASSERT_EQ(run.summary.pieces.size(), 2u);
    EXPECT_NEAR(run.summary.pieces[1].volume, 2700e-9, 0.02 * 2700e-9);
    EXPECT_TRUE(std::filesystem::exists(request.out + "/" + run.summary.pieces[1].file));
}

TEST(Implant, AnOpenSurfaceIsRefusedAtItsPlaceInTheProcedure) {
    const WithPlate with(plate(2));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(run::make_scene(with.file, "", test::plugins()).take(diagnostics));
    const std::string text = to_text(diagnostics);
    EXPECT_NE(text.find("E0649"), std::string::npos) << text;
    EXPECT_NE(text.find("plate: {mesh: {file: plate.stl"), std::string::npos) << text;
}

TEST(Implant, AFileThatIsNotThereIsMissedBeforeAnythingIsMade) {
    const WithPlate with("");
    text::Diagnostics diagnostics;
    EXPECT_FALSE(run::check_documents({with.file}, test::plugins()).take(diagnostics));
    EXPECT_NE(to_text(diagnostics).find("E0620"), std::string::npos) << to_text(diagnostics);
}

}  // namespace
}  // namespace kerf::app
