// SPDX-License-Identifier: Apache-2.0
#include "text/file_kind.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace kerf::text {
namespace {

using namespace std::string_literals;

class FileKindTest : public testing::Test {
protected:
    [[nodiscard]] RecognisedFile recognised(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return recognise(folder_ / name);
    }
    [[nodiscard]] FileKind kind(const std::string& name, const std::string& bytes) const {
        return recognised(name, bytes).kind;
    }
    /// The head of an SQLite file with this application id.
    static std::string database(const std::string& application) {
        std::string head(100, '\0');
        head.replace(0, 16, "SQLite format 3\0"s);
        return head.replace(68, 4, application);
    }

    const test::TemporaryFolder folder_;
};

TEST_F(FileKindTest, RecognisesFilesByTheirFirstBytes) {
    EXPECT_EQ(kind("a", database("KERF")), FileKind::session);
    EXPECT_EQ(kind("a", database("xxxx")), FileKind::database);
    EXPECT_EQ(kind("a", "\x89PNG\r\n"), FileKind::picture);
    EXPECT_EQ(kind("a", "<!DOCTYPE html><html>"), FileKind::page);
    EXPECT_EQ(kind("a", "\x7f"s + "ELF"), FileKind::shared_library);
    EXPECT_EQ(kind("a", std::string(128, '\0') + "DICM and more"), FileKind::scan);
    EXPECT_EQ(kind("a", "NRRD0004\n"), FileKind::scan);
    EXPECT_EQ(kind("a", "solid bone\n"), FileKind::surface);
    EXPECT_EQ(kind("a", "%PDF-1.7"), FileKind::pdf);
}

TEST_F(FileKindTest, RecognisesDocumentsByTheirKind) {
    EXPECT_EQ(kind("a.md", "# A procedure\napiVersion: kerf/v1\nkind: Procedure\n"), FileKind::procedure);
    EXPECT_EQ(kind("a.yaml", "kind: Anatomy\n"), FileKind::anatomy);
    EXPECT_EQ(kind("a.yaml", "kind: Station\n"), FileKind::station);
    EXPECT_EQ(kind("a.yaml", "metadata: {id: a}\n"), FileKind::unknown);
}

TEST_F(FileKindTest, RecognisesTextsByTheirNames) {
    EXPECT_EQ(kind("README.md", "# Kerf\n"), FileKind::markdown);
    EXPECT_EQ(kind("ticks.CSV", "a,b\n"), FileKind::table);
    EXPECT_EQ(kind("scan.nii.gz", "\x1f\x8b more"), FileKind::scan);
    EXPECT_EQ(kind("all.tgz", "\x1f\x8b more"), FileKind::archive);
    EXPECT_EQ(kind("empty.stl", ""), FileKind::unknown);
}

TEST_F(FileKindTest, RecognisesFolders) {
    EXPECT_EQ(recognise(folder_ / "none").kind, FileKind::missing);
    EXPECT_EQ(recognise(folder_ / "").kind, FileKind::folder);
    std::ofstream(folder_ / "session.db") << "x";
    EXPECT_EQ(recognise(folder_ / "").kind, FileKind::run_folder);
}

TEST_F(FileKindTest, NamesTheCommandThatReadsIt) {
    const RecognisedFile file = recognised("run.db", database("KERF"));
    const std::string name = folder_ / "run.db";
    EXPECT_EQ(other_kind_text(file, "a procedure"), "got a session of Kerf, expected a procedure. Write `kerf view " +
                                                        name + "` to see it, or `kerf report " + name +
                                                        "` for its report.");
    EXPECT_EQ(other_kind_text(recognise(folder_ / "none"), "a procedure"), "");
}

}  // namespace
}  // namespace kerf::text
