// SPDX-License-Identifier: Apache-2.0
// A session belongs to one scan: its replay refuses another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "run/scene.h"
#include "session/content_hash.h"
#include "session/recorder.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

constexpr const char* procedure_file = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
constexpr const char* phantom_file = KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml";

/// The shipped phantom as a scanner would see it, with one voxel of air at `odd` instead of 0.
void write_scan(const std::string& file, float odd) {
    text::Diagnostics diagnostics;
    const auto phantom = documents::read_anatomy(phantom_file).take(diagnostics);
    if (!phantom) throw std::runtime_error(to_text(diagnostics));
    constexpr int size[] = {64, 90, 40};
    std::ofstream out(file, std::ios::binary);
    out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nOffset = -32 -22 -20\nElementSpacing = 1 1 1\n"
           "DimSize = 64 90 40\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) {
                const double d = distance_to(phantom->phantom, {1e-3 * (i - 32), 1e-3 * (j - 22), 1e-3 * (k - 20)});
                const auto value = static_cast<float>(500.0 * std::clamp(0.5 - d / 2e-3, 0.0, 1.0));
                const float stored = i + j + k == 0 ? odd : value;
                out.write(reinterpret_cast<const char*>(&stored), sizeof stored);
            }
}

/// The phantom's document with `ct:` in place of `phantom:`.
void write_anatomy(const std::string& file) {
    const std::string text = test::contents_of(phantom_file);
    const auto from = text.find("phantom:\n"), to = text.find("tissues:\n");
    std::ofstream(file) << text.substr(0, from) << "ct:\n  image: scan.mha\n  threshold: 250\n\n" << text.substr(to);
}

std::optional<run::Scene> scene_of(const std::string& anatomy) {
    text::Diagnostics diagnostics;
    auto scene = run::make_scene(procedure_file, anatomy, test::plugins()).take(diagnostics);
    EXPECT_TRUE(scene) << to_text(diagnostics);
    return scene;
}

TEST(ScanReplay, APhantomsHashIsThatOfItsText) {
    const auto scene = scene_of(phantom_file);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->anatomy_hash, session::hash_of_text(test::contents_of(phantom_file)));
    EXPECT_FALSE(scene->import.notes.empty());
}

TEST(ScanReplay, IsRefusedWithAnotherScanUnderTheSameName) {
    // Given a session that was recorded with a scan
    const test::TemporaryFolder folder;
    write_anatomy(folder / "anatomy.yaml");
    write_scan(folder / "scan.mha", 0.0f);
    const auto scene = scene_of(folder / "anatomy.yaml");
    ASSERT_TRUE(scene);
    session::SessionHeader header;
    header.procedure_text = scene->procedure.text;
    header.anatomy_hash = scene->anatomy_hash;
    auto created = session::Recorder::create(folder / "session.db", header);
    ASSERT_EQ(created.error, "");
    session::TickRow row;
    row.device_from_handle = identity_pose();
    created.recorder->push(row);
    ASSERT_EQ(created.recorder->finish(session::RunSummary{}), "");

    // When a voxel of the scan changes, and the session is replayed
    write_scan(folder / "scan.mha", -1.0f);
    const auto other = scene_of(folder / "anatomy.yaml");
    ASSERT_TRUE(other);
    const std::string command = KERF_BUILD_DIR "/bin/kerf run " + std::string(procedure_file) + " --anatomy " +
                                (folder / "anatomy.yaml") + " --replay " + (folder / "session.db") + " --out " +
                                (folder / "out") + " > " + (folder / "said.txt") + " 2>&1";
    const int status = std::system(command.c_str());

    // Then it is refused before anything is drilled, and says why
    EXPECT_NE(other->anatomy_hash, scene->anatomy_hash);
    EXPECT_NE(scene->anatomy_hash, session::hash_of_text(scene->anatomy.text));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_NE(test::contents_of(folder / "said.txt").find("another scan"), std::string::npos)
        << test::contents_of(folder / "said.txt");
}

}  // namespace
}  // namespace kerf::app
