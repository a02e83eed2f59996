// SPDX-License-Identifier: Apache-2.0
// The program names inputs that are no regular files, and links that lead out of a folder.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::Ended;
using test::kerf;
using test::TemporaryFolder;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Runs the program for at most 60 s, so that a hang fails.
Ended kerf_in_time(const std::string& arguments) { return kerf(arguments, "timeout 60"); }

TEST(OddInputs, AProcedureThatIsNoRegularFileIsNamed) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo.yaml").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder / "zero.yaml");
    fs::create_directory(folder / "folder.yaml");
    for (const auto& [name, problem] :
         {std::pair<std::string, std::string>{"fifo", "This is a FIFO, not a regular file."},
          {"zero", "This is a device, not a regular file."},
          {"folder", "The path is a folder, expected a file."}})
        for (const char* command : {"validate ", "run "}) {
            const Ended refused = kerf_in_time(command + (folder / (name + ".yaml")));
            EXPECT_EQ(refused.exit_code, 2) << command << name;
            EXPECT_TRUE(has(refused.out + refused.err, problem)) << refused.out << refused.err;
        }
}

TEST(OddInputs, AFileOfAnyOtherKindIsNamedAtOnce) {
    const TemporaryFolder folder;
    const std::string fifo = folder / "fifo", socket = folder / "socket", loop = folder / "loop";
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
    ASSERT_EQ(mknod(socket.c_str(), S_IFSOCK | 0600, 0), 0);
    fs::create_symlink("loop", loop);
    for (const auto& [file, problem] : {std::pair<std::string, std::string>{fifo, "his is a FIFO"},
                                        {socket, "his is a socket"},
                                        {loop, "his is a link that leads to itself"}})
        for (const char* command : {"check ", "validate ", "report ", "privacy ", "import "}) {
            const Ended refused = kerf(command + file, "timeout 8");
            EXPECT_EQ(refused.exit_code, 2) << command << file;
            EXPECT_TRUE(has(refused.out + refused.err, problem)) << command << refused.out << refused.err;
        }
}

TEST(OddInputs, AnAnatomyIsNotReadThroughALinkThatLeadsOut) {
    const TemporaryFolder secret, folder;
    std::ofstream(secret / "secret.yaml") << "the secret: line\n";
    fs::create_symlink(secret / "secret.yaml", folder / "out.yaml");
    fs::create_directory_symlink(secret.path(), folder / "away");
    for (const char* anatomy : {"out.yaml", "away/secret.yaml"}) {
        std::string text = test::contents_of(pedicle_screw);
        const std::string shipped = "anatomy/vertebra-l3.yaml";
        ASSERT_NE(text.find(shipped), std::string::npos);
        std::ofstream(folder / "p.yaml") << text.replace(text.find(shipped), shipped.size(), anatomy);
        const Ended refused = kerf("validate " + (folder / "p.yaml"));
        EXPECT_EQ(refused.exit_code, 2);
        const std::string all = refused.out + refused.err;
        EXPECT_TRUE(has(all, "E0619") && has(all, "a link leads out of the document's folder")) << all;
        EXPECT_FALSE(has(all, "secret: line")) << all;
    }
}

TEST(OddInputs, AFifoNextToASessionHangsNoCommand) {
    const TemporaryFolder folder;
    const std::string session = folder / "session.db";
    fs::copy_file(KERF_SOURCE_DIR "/tests/sessions/schema-5.db", session);
    ASSERT_EQ(mkfifo((session + "-journal").c_str(), 0600), 0);
    std::ofstream(session + "-wal") << "damaged";
    for (const std::string& command :
         {"report " + session + " --out " + (folder / "r.html"), "privacy " + session, "remesh " + session,
          "run " + pedicle_screw + " --replay " + session + " --out " + (folder / "o")}) {
        const Ended refused = kerf_in_time(command);
        EXPECT_EQ(refused.exit_code, 2) << command << refused.err;
        EXPECT_TRUE(has(refused.err + refused.out, "-journal: this is a FIFO")) << command << refused.err;
    }
}

TEST(OddInputs, RemeshRefusesAnEditedSession) {
    const TemporaryFolder folder;
    const std::string session = folder / "session.db";
    fs::copy_file(KERF_SOURCE_DIR "/tests/sessions/schema-5.db", session);
    ASSERT_TRUE(test::changed(session, "UPDATE metrics SET value=0"));
    const Ended remesh = kerf("remesh " + session);
    EXPECT_EQ(remesh.exit_code, 2);
    EXPECT_TRUE(has(remesh.err, "was changed after its run wrote it")) << remesh.err;
}

}  // namespace
}  // namespace kerf::app
