// SPDX-License-Identifier: Apache-2.0
#include "text/file_digest.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"
#include "text/sha256.h"

namespace kerf::text {
namespace {

using test::TemporaryFolder;

void write(const std::string& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

TEST(FileDigest, IsThatOfTheBytes) {
    const TemporaryFolder folder;
    const std::string bytes(200'000, 'k');
    write(folder / "a.so", bytes);
    const FileDigest digest = digest_of_file(folder / "a.so");
    EXPECT_EQ(digest.error, "");
    EXPECT_EQ(digest.digest, sha256_of(bytes));
    EXPECT_EQ(digest.stamp, stamp_of(folder / "a.so"));
}

TEST(FileDigest, NamesWhyAFileIsNotRead) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo.so").c_str(), 0600), 0);
    for (const std::string& file : {folder / "fifo.so", folder / "none.so", folder.path()}) {
        const FileDigest digest = digest_of_file(file);
        EXPECT_EQ(digest.digest, "") << file;
        EXPECT_NE(digest.error, "") << file;
    }
}

TEST(FileStamp, ChangesWhenAFileIsReplaced) {
    const TemporaryFolder folder;
    write(folder / "a.so", "one");
    const FileStamp before = stamp_of(folder / "a.so");
    EXPECT_EQ(before, stamp_of(folder / "a.so"));
    write(folder / "b.so", "two");
    std::filesystem::rename(folder / "b.so", folder / "a.so");
    EXPECT_NE(before, stamp_of(folder / "a.so"));
    std::filesystem::remove(folder / "a.so");
    EXPECT_EQ(stamp_of(folder / "a.so"), FileStamp{});
}

}  // namespace
}  // namespace kerf::text
