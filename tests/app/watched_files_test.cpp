// SPDX-License-Identifier: Apache-2.0
// What `kerf run --watch` watches.
#include "app/watched_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

void write(const std::string& path, const std::string& text) {
    fs::create_directories(fs::path(path).parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

/// A procedure and all kinds of data that an anatomy names.
struct WatchedFiles : testing::Test {
    WatchedFiles() {
        write(folder / "case/hole.yaml", "kind: Procedure\nanatomy: bones/bone.yaml\n");
        write(folder / "case/bones/bone.yaml", "kind: Anatomy\n"
                                               "mesh: {file: bone.stl, canal: {file: canal.ply}}\n"
                                               "ct: {image: scan, labels: {file: labels.nrrd, keep: [1]}}\n"
                                               "landmarks: {markups: [{file: way.mrk.json}]}\n");
        for (const char* data : {"bone.stl", "canal.ply", "scan/1.dcm", "scan/more/2", "labels.nrrd", "way.mrk.json"})
            write(folder / ("case/bones/" + std::string(data)), "data");
        write(folder / "patches/other.yaml", "anatomy.ct.image: volume.nhdr\n");
        write(folder / "patches/volume.nhdr", "data file: volume.raw\n");
        write(folder / "patches/volume.raw", "data");
        write(folder / "plugins/kerf_mill.so", "data");
        write(folder / "own.db", "data");
        options.procedure = folder / "case/hole.yaml";
        options.patches = {folder / "patches/other.yaml"};
        options.replay = folder / "own.db";
    }

    FileStates now() const { return watched_files(options, {folder / "plugins"}); }

    test::TemporaryFolder folder;
    RunOptions options;
};

TEST_F(WatchedFiles, ChangesWithEachFileThatARunReads) {
    for (const char* name :
         {"case/hole.yaml", "case/bones/bone.yaml", "case/bones/bone.stl", "case/bones/canal.ply",
          "case/bones/scan/1.dcm", "case/bones/scan/more/2", "case/bones/labels.nrrd", "case/bones/way.mrk.json",
          "patches/other.yaml", "patches/volume.nhdr", "patches/volume.raw", "plugins/kerf_mill.so", "own.db"}) {
        SCOPED_TRACE(name);
        const std::string file = folder / name;
        const FileStates before = now();
        ASSERT_TRUE(before.contains(file));
        EXPECT_EQ(first_change(before, now()), "");

        std::ofstream(file, std::ios::app) << "\n";
        const FileStates written = now();
        EXPECT_EQ(first_change(before, written), file);

        // Another file of the same size and time under its name
        const auto time = fs::last_write_time(file);
        fs::copy(file, folder / "copy");
        fs::last_write_time(folder / "copy", time);
        fs::rename(folder / "copy", file);
        const FileStates replaced = now();
        EXPECT_EQ(first_change(written, replaced), file);

        const std::string content = test::contents_of(file);
        fs::remove(file);
        const FileStates removed = now();
        EXPECT_FALSE(removed.contains(file));
        EXPECT_NE(first_change(replaced, removed), "");
        write(file, content);
        EXPECT_TRUE(now().contains(file));
        EXPECT_NE(first_change(removed, now()), "");
    }
}

TEST_F(WatchedFiles, SeesAFileThatIsAdded) {
    const FileStates before = now();
    write(folder / "case/bones/scan/3.dcm", "data");
    EXPECT_EQ(first_change(before, now()), folder / "case/bones/scan/3.dcm");
}

TEST_F(WatchedFiles, FollowsAnAnatomyThatIsSet) {
    write(folder / "case/other.yaml", "kind: Anatomy\nmesh: {file: far/bone.obj}\n");
    write(folder / "case/far/bone.obj", "data");
    options.settings = {"anatomy=other.yaml"};
    EXPECT_TRUE(now().contains(folder / "case/far/bone.obj"));
    options.settings.clear();
    EXPECT_FALSE(now().contains(folder / "case/far/bone.obj"));
    options.anatomy = folder / "case/other.yaml";
    EXPECT_TRUE(now().contains(folder / "case/far/bone.obj"));
}

TEST_F(WatchedFiles, ReadsADamagedProcedureAgainOnceItIsMended) {
    const FileStates before = now();
    write(folder / "case/hole.yaml", "kind: [Procedure\n");
    const FileStates damaged = now();
    EXPECT_EQ(first_change(before, damaged), folder / "case/hole.yaml");
    write(folder / "case/hole.yaml", "kind: Procedure\nanatomy: bones/bone.yaml\n");
    EXPECT_EQ(first_change(damaged, now()), folder / "case/bones/bone.stl");
}

}  // namespace
}  // namespace kerf::app
