// SPDX-License-Identifier: Apache-2.0
// The badge of a plugin, from `kerf check` to the session of a run.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "conformance/kit_version.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "text/file_digest.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::Ended;
using test::TemporaryFolder;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

int count_of(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Returns a value of the table `session`; "no such key" if there is none.
std::string value_in(const std::string& session, const std::string& key) {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    std::string value = "no such key";
    if (sqlite3_open_v2(session.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK &&
        sqlite3_prepare_v2(database, "SELECT value FROM session WHERE key = ?", -1, &statement, nullptr) == SQLITE_OK &&
        sqlite3_bind_text(statement, 1, key.c_str(), -1, SQLITE_TRANSIENT) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        value = reinterpret_cast<const char*>(sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return value;
}

/// One plugin alone in its folder, with a procedure that uses it and badges of its own.
struct PluginBadge : testing::Test {
    TemporaryFolder folder;
    const std::string plugin = folder / "plugins/bad.so", badges = folder / "badges", procedure = folder / "burr.yaml",
                      out = folder / "out", session = folder / "out/session.db";

    void SetUp() override {
        fs::create_directory(folder / "plugins");
        use("nothing_wrong");
        fs::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy", fs::copy_options::recursive);
        std::ofstream(procedure) << R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hostile, title: A burr of a stranger, version: 0.1.0, status: draft, authors: [Nobody]}
needs: {landmarks: [right_pedicle, midline], tissues: [cortical, cancellous]}
anatomy: anatomy/vertebra-phantom.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: premium-1.5-6dof}
time_limit: 20 s
instruments: {burr: {plugin: test.hostile, tool: burr, force: burring}}
steps:
  - id: groove
    title: Burr a hole
    instrument: burr
    axis: right_pedicle
    goals: [{entry: {}}, {depth: {at_least: 1 mm}}]
rehearsals:
  - id: expert
    title: Along the axis
    expect: pass
    hand: {feed: 5 mm/s, approach: 20 mm/s, push: 50 N, reaction: 150 ms}
    path: [{depth: -8 mm}, {depth: 2 mm}, {depth: -3 mm}]
)";
    }
    void use(const std::string& how) const {
        fs::copy(KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_" + how + ".so", plugin,
                 fs::copy_options::overwrite_existing);
    }
    [[nodiscard]] Ended kerf(const std::string& command, const std::string& environment = "") const {
        return test::kerf(command,
                          "KERF_PLUGIN_PATH=" + (folder / "plugins") + " KERF_BADGES=" + badges + " " + environment);
    }
    [[nodiscard]] Ended run(const std::string& more = "", const std::string& environment = "") const {
        return kerf("run " + procedure + " --out " + out + " " + more, environment);
    }
    [[nodiscard]] std::string digest() const { return text::digest_of_file(plugin).digest; }
    [[nodiscard]] std::string badge_file() const { return badges + "/" + digest() + ".json"; }
    /// Writes a badge as `kerf check` does, without the tests.
    void pass(int level) const {
        fs::create_directories(badges);
        std::ofstream(badge_file()) << R"({"schema": 1, "digest": ")" << digest()
                                    << R"(", "plugin": "test.hostile 1.0.0", "kit": )" << conformance::kit_version
                                    << R"(, "requested": )" << level << R"(, "level": )" << level
                                    << R"(, "tests": 60, "failed": 0, "excluded": 0})";
    }
    [[nodiscard]] std::string warning() const {
        return "kerf: `test.hostile` (bad.so) never passed `kerf check` at level 3 on this machine. Run `kerf check " +
               plugin + " --level 3`.\n";
    }
};

TEST_F(PluginBadge, IsMissedOncePerRunWithoutAnEffect) {
    const Ended unchecked = run();
    EXPECT_EQ(unchecked.exit_code, 0) << unchecked.out << unchecked.err;
    EXPECT_EQ(count_of(unchecked.err, warning()), 1) << unchecked.err;
    EXPECT_TRUE(has(unchecked.out, "  test.hostile (bad.so): never checked\n")) << unchecked.out;
    EXPECT_EQ(value_in(session, "version.test.hostile file"), "bad.so");
    EXPECT_EQ(value_in(session, "version.test.hostile SHA-256"), digest());
    EXPECT_EQ(value_in(session, "version.test.hostile badge"), "never checked");
    EXPECT_TRUE(has(contents_of(out + "/report.html"), "test.hostile badge never checked"));
    const std::string hash = value_in(session, "hash"), summary = contents_of(out + "/summary.json");

    pass(3);
    const Ended checked = run();
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    EXPECT_FALSE(has(checked.err, "never passed")) << checked.err;
    EXPECT_TRUE(has(checked.out, "  test.hostile (bad.so): checked: level 3, all of 60 tests\n")) << checked.out;
    EXPECT_EQ(value_in(session, "hash"), hash) << "a badge has no effect on a run";
    EXPECT_EQ(contents_of(out + "/summary.json"), summary);
}

TEST_F(PluginBadge, OfALowLevelIsNotSufficient) {
    pass(2);
    const Ended rehearsed = kerf("rehearse " + procedure + " " + procedure);
    EXPECT_EQ(rehearsed.exit_code, 0) << rehearsed.err;
    EXPECT_EQ(count_of(rehearsed.err, "never passed"), 1) << rehearsed.err;
    EXPECT_TRUE(has(rehearsed.err, "on this machine (checked: level 2, all of 60 tests). Run")) << rehearsed.err;
}

TEST_F(PluginBadge, MayBeAbsentWithoutAnEffect) {
    for (const char* environment : {"KERF_BADGES= XDG_STATE_HOME= HOME=", "KERF_BADGES=/proc/badges"}) {
        const Ended ended = kerf("rehearse " + procedure, environment);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_EQ(count_of(ended.err, "badges of plugins. Set HOME") + count_of(ended.err, "never passed"), 1)
            << ended.err;
    }
    const Ended off = kerf("rehearse " + procedure, "KERF_BADGES=off");
    EXPECT_EQ(off.exit_code, 0);
    EXPECT_FALSE(has(off.err, "kerf: ")) << off.err;
}

TEST_F(PluginBadge, IsIgnoredIfItsFileIsDamaged) {
    fs::create_directories(badges);
    fs::create_symlink("/dev/zero", badge_file());
    const Ended ended = kerf("rehearse " + procedure);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(has(ended.err, "kerf: the badge " + badge_file() + " is ignored: it is a link.")) << ended.err;
    EXPECT_TRUE(has(ended.err, warning())) << ended.err;
}

TEST_F(PluginBadge, IsListedAndDescribed) {
    pass(3);
    const std::string words = "checked: level 3, all of 60 tests\n";
    const Ended listed = kerf("list"), described = kerf("describe test.hostile"),
                shipped = kerf("describe kerf.drilling");
    EXPECT_TRUE(has(listed.out, "plugin   test.hostile  " + words)) << listed.out;
    EXPECT_TRUE(has(listed.out, "plugin   kerf.drilling  shipped with Kerf\n")) << listed.out;
    EXPECT_TRUE(has(described.out, "  " + words)) << described.out;
    EXPECT_TRUE(has(shipped.out, "\n  shipped with Kerf\n")) << shipped.out;
}

TEST_F(PluginBadge, OfAReplacedFileIsNotKnown) {
    use("replaces_its_file");
    pass(3);
    const Ended ended = run();
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    EXPECT_EQ(count_of(ended.err, "kerf: `test.hostile` (bad.so) was replaced after it was loaded"), 1) << ended.err;
    EXPECT_EQ(contents_of(plugin), "another build");
}

TEST_F(PluginBadge, ComesWithTheNameOfALawThatDoesNotReplay) {
    use("reads_the_environment");
    pass(3);
    ASSERT_EQ(run().exit_code, 0);
    const std::string replay = "--replay " + (folder / "first.db");
    fs::copy(session, folder / "first.db");
    const Ended same = run(replay);
    EXPECT_TRUE(has(same.out, "  replay: the same bits\n")) << same.out;
    EXPECT_FALSE(has(same.out, "in hand")) << same.out;

    const Ended other = run(replay, "HOSTILE_FORCE=1");
    EXPECT_EQ(other.exit_code, 3) << other.out;
    EXPECT_TRUE(has(other.out, "  replay: NOT the same bits\n  replay: the first difference is in tick ")) << other.out;
    EXPECT_TRUE(has(other.out, "  replay: the law in hand there is `burring` of `test.hostile` (" + plugin +
                                   "). Run `kerf check " + plugin + "`"))
        << other.out;

    // Given another build of the plugin, its digest is named first
    const std::string recorded = digest();
    use("pushes");
    const Ended rebuilt = run(replay);
    EXPECT_TRUE(has(rebuilt.out, "  replay: NOT the same bits\n  replay: it was recorded with other code: test.hostile "
                                 "SHA-256 was " +
                                     recorded + ", and is " + digest() + "\n"))
        << rebuilt.out;
}

TEST_F(PluginBadge, IsKeptByKerfCheck) {
    const Ended checked = kerf("check " + plugin + " --level 1");
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    EXPECT_TRUE(has(contents_of(badge_file()), "\"level\": 1,")) << contents_of(badge_file());
    EXPECT_TRUE(has(contents_of(badge_file()), "For training and research"));
    const std::string first = contents_of(badge_file());
    EXPECT_EQ(kerf("check " + plugin + " --level 1").exit_code, 0);
    EXPECT_EQ(contents_of(badge_file()), first);

    // Given a selection of tests, the badge stays as it is
    EXPECT_EQ(kerf("check " + plugin + " --level 2 --only load").exit_code, 0);
    EXPECT_EQ(contents_of(badge_file()), first);
    // Given an exclusion, the badge has it
    EXPECT_EQ(kerf("check " + plugin + " --level 1 --exclude describe.version --reason tired").exit_code, 0);
    EXPECT_TRUE(has(contents_of(badge_file()), "\"excluded\": 1")) << contents_of(badge_file());

    // Given a plugin that fails, the badge has no level
    use("crashes_in_shape");
    EXPECT_EQ(kerf("check " + plugin + " --level 2").exit_code, 1);
    EXPECT_TRUE(has(contents_of(badge_file()), "\"level\": 1,")) << contents_of(badge_file());
    EXPECT_FALSE(has(contents_of(badge_file()), "\"failed\": 0,")) << contents_of(badge_file());
}

TEST_F(PluginBadge, IsNotKeptWhereNoFolderCanBeMade) {
    for (const char* environment : {"KERF_BADGES= XDG_STATE_HOME= HOME=", "KERF_BADGES=/proc/badges"}) {
        const Ended checked = kerf("check " + plugin + " --level 1", environment);
        EXPECT_EQ(checked.exit_code, 0) << checked.err;
        EXPECT_EQ(count_of(checked.err, "the badge is not kept: "), 1) << checked.err;
    }
}

}  // namespace
}  // namespace kerf::app
