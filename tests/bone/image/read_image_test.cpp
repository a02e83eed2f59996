// SPDX-License-Identifier: Apache-2.0
#include "bone/image/read_image.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "bone/image/image_file.h"
#include "bone/image/scan.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using namespace literals;

// A volume of 4 × 3 × 2 voxels, 0.5 × 1 × 2 mm, first voxel at LPS (10, 20, 30) mm. Voxel (i, j, k) holds
// 100 i + 10 j + k, so that a reader can check every answer by hand.
constexpr std::array<int, 3> size{4, 3, 2};

std::string voxels() {
    std::string bytes;
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) {
                const auto value = static_cast<std::int16_t>(100 * i + 10 * j + k);
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
    return bytes;
}

/// zlib's format, or gzip's.
std::string packed(const std::string& bytes, bool as_gzip) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, as_gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string out(bytes.size() + 1000, '\0');
    std::string in = bytes;
    stream.next_in = reinterpret_cast<unsigned char*>(in.data());
    stream.avail_in = static_cast<unsigned>(in.size());
    stream.next_out = reinterpret_cast<unsigned char*>(out.data());
    stream.avail_out = static_cast<unsigned>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return out;
}

/// A NIfTI-1 header that a test can spoil at one place. NIfTI is RAS: x and y turn their sign.
struct Nifti {
    std::string header = std::string(352, '\0');

    template <class Number>
    Nifti& with(std::size_t at, Number value) {
        std::memcpy(header.data() + at, &value, sizeof value);
        return *this;
    }
    Nifti() {
        with<std::int32_t>(0, 348).with<std::int16_t>(40, 3);
        for (std::size_t axis = 0; axis < 3; ++axis)
            with<std::int16_t>(42 + 2 * axis, static_cast<std::int16_t>(size[axis]));
        for (std::size_t axis = 3; axis < 7; ++axis) with<std::int16_t>(42 + 2 * axis, 1);
        with<std::int16_t>(70, 4).with<std::int16_t>(72, 16);
        with(76, 1.0f).with(80, 0.5f).with(84, 1.0f).with(88, 2.0f).with(108, 352.0f).with(112, 1.0f);
        with<char>(123, 2).with<std::int16_t>(254, 1);
        with(280, -0.5f).with(292, -10.0f).with(300, -1.0f).with(308, -20.0f).with(320, 2.0f).with(324, 30.0f);
        std::memcpy(header.data() + 344, "n+1", 4);
    }
    [[nodiscard]] std::string file() const { return header + voxels(); }
};

const std::string nrrd_header =
    "NRRD0004\n# a remark\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
    "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
    "space origin: (10,20,30)\n\n";

const std::string meta_header =
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
    "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 0.5 1 2\nDimSize = 4 3 2\n"
    "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The header alone, which names another file.
std::string detached(const std::string& line) {
    const std::string header = replaced(nrrd_header, "encoding", line + "\nencoding");
    return header.substr(0, header.size() - 1);  // without the empty line
}

struct ReadImage : testing::Test {
    test::TemporaryFolder folder;

    std::string write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    void expect_refused(const std::string& code, const std::string& name, const std::string& bytes) {
        SCOPED_TRACE(name);
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_image(write(name, bytes)).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
        EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
    }
    void expect_the_volume(const std::string& name, const std::string& bytes) {
        SCOPED_TRACE(name);
        text::Diagnostics diagnostics;
        const auto image = read_image(write(name, bytes)).take(diagnostics);
        ASSERT_TRUE(image) << to_text(diagnostics);
        EXPECT_EQ(image->size, size);
        EXPECT_EQ(image->at(3, 2, 1), 321.0f);
        EXPECT_NEAR(length(image->lps({0, 0, 0}) - Vec3{10.0_mm, 20.0_mm, 30.0_mm}), 0.0, 1e-8 /* float headers */);
        // Voxel (3, 2, 1), half way to (2, 2, 1), in the patient: 10 + 2.5 × 0.5, 20 + 2 × 1, 30 + 1 × 2 mm.
        EXPECT_NEAR(image->sample_trilinear({11.25_mm, 22.0_mm, 32.0_mm}, -1.0), 271.0, 1e-3);
    }
};

TEST_F(ReadImage, GivesTheSameVolumeFromEveryFormat) {
    expect_the_volume("a.nii", Nifti().file());
    expect_the_volume("b.nii.gz", packed(Nifti().file(), true));
    expect_the_volume("c.nrrd", nrrd_header + voxels());
    expect_the_volume("d.nrrd", replaced(nrrd_header, "encoding: raw", "encoding: gzip") + packed(voxels(), true));
    expect_the_volume("e.mha", meta_header + voxels());
    const std::string bytes = packed(voxels(), false);
    expect_the_volume("f.mha", replaced(meta_header, "CompressedData = False",
                                        "CompressedData = True\nCompressedDataSize = " + std::to_string(bytes.size())) +
                                   bytes);
    write("g.raw", voxels());
    expect_the_volume("g.mhd", replaced(meta_header, "LOCAL", "g.raw"));
    expect_the_volume("g.nhdr", detached("data file: g.raw"));
    write("h.raw.gz", packed(voxels(), true));
    expect_the_volume("h.nhdr", replaced(detached("datafile: ./h.raw.gz"), "encoding: raw", "encoding: gzip"));
    write("i.raw", "header of another program" + voxels());
    expect_the_volume("i.nhdr", detached("data file: i.raw\nbyte skip: 25"));
    expect_the_volume("j.nhdr", detached("data file: i.raw\nbyte skip: -1"));
    write("with blanks.raw", voxels());
    expect_the_volume("k.mhd", replaced(meta_header, "LOCAL", "with blanks.raw"));
}

TEST_F(ReadImage, ReadsWholeNumbersOf64Bits) {
    std::string wide;
    for (std::size_t at = 0; at < voxels().size(); at += 2) wide += voxels().substr(at, 2) + std::string(6, '\0');
    for (const std::int16_t type : {std::int16_t{1024}, std::int16_t{1280}})
        expect_the_volume("a.nii", Nifti().with<std::int16_t>(70, type).with<std::int16_t>(72, 64).header + wide);
    for (const char* type : {"int64", "unsigned long long"})
        expect_the_volume("b.nrrd", replaced(nrrd_header, "type: short", std::string("type: ") + type) + wide);
    expect_the_volume("c.mha", replaced(meta_header, "MET_SHORT", "MET_LONG_LONG") + wide);
    wide[7] = '\x7f';  // of the first voxel
    expect_refused("E0629", "d.mha", replaced(meta_header, "MET_SHORT", "MET_ULONG_LONG") + wide);
}

TEST_F(ReadImage, PassesOverAByteOrderMark) {
    expect_the_volume("a.nrrd", "\xef\xbb\xbf" + nrrd_header + voxels());
    expect_the_volume("b.mha", "\xef\xbb\xbf" + meta_header + voxels());
}

// A file beside its header has no other check of its sizes than its length.
TEST_F(ReadImage, RefusesMoreBytesThanTheSizesNeed) {
    write("g.raw", voxels() + std::string(1, '\0'));
    expect_refused("E0626", "g.mhd", replaced(meta_header, "LOCAL", "g.raw"));
    expect_refused("E0626", "g.nhdr", detached("data file: g.raw"));
    expect_refused("E0626", "h.nhdr", detached("data file: g.raw\nbyte skip: 0"));
    write("g.raw", packed(voxels() + std::string(1, '\0'), false));
    expect_refused(
        "E0626", "i.mhd",
        replaced(replaced(meta_header, "LOCAL", "g.raw"), "CompressedData = False", "CompressedData = True"));
    const std::string gzip = replaced(nrrd_header, "encoding: raw", "encoding: gzip");
    expect_refused("E0626", "c.nrrd", replaced(gzip, "4 3 2", "2 3 2") + packed(voxels(), true));
    expect_refused(
        "E0626", "d.mha",
        replaced(replaced(meta_header, "4 3 2", "2 3 2"), "CompressedData = False", "CompressedData = True") +
            packed(voxels(), false));
}

TEST_F(ReadImage, DoubtsBytesBehindVoxelsInTheHeadersFile) {
    for (const auto& [name, bytes] : {std::pair<const char*, std::string>{"a.nii", Nifti().file() + "\n"},
                                      {"b.nii.gz", packed(Nifti().file() + "\n", true)},
                                      {"c.mha", meta_header + voxels() + "\n"}}) {
        SCOPED_TRACE(name);
        text::Diagnostics diagnostics;
        const auto header = check_image_file(write(name, bytes)).take(diagnostics);
        ASSERT_TRUE(header) << to_text(diagnostics);
        ASSERT_EQ(header->doubts.size(), 1u);
        EXPECT_NE(header->doubts[0].find("1 bytes more"), std::string::npos) << header->doubts[0];
    }
}

TEST_F(ReadImage, TurnsRasIntoLps) {
    const std::string ras = replaced(nrrd_header, "left-posterior-superior", "right-anterior-superior");
    expect_the_volume(
        "ras.nrrd",
        replaced(replaced(ras, "(0.5,0,0) (0,1,0)", "(-0.5,0,0) (0,-1,0)"), "(10,20,30)", "(-10,-20,30)") + voxels());
}

TEST_F(ReadImage, KeepsTheShearOfATiltedScan) {
    text::Diagnostics diagnostics;
    const auto image =
        read_image(write("tilted.nrrd", replaced(nrrd_header, "(0,0,2)", "(0,0.5,2)") + voxels())).take(diagnostics);
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_NEAR(length(image->lps({0, 0, 1}) - Vec3{10.0_mm, 20.5_mm, 32.0_mm}), 0.0, 1e-9);
    EXPECT_NEAR(image->sample_trilinear({10.0_mm, 20.5_mm, 32.0_mm}, -1.0), 1.0, 1e-6);
}

TEST_F(ReadImage, GivesTheBackgroundOutsideTheVolume) {
    text::Diagnostics diagnostics;
    const auto image = read_image(write("a.mha", meta_header + voxels())).take(diagnostics);
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->sample_trilinear({9.9_mm, 20.0_mm, 30.0_mm}, -1024.0), -1024.0);
    EXPECT_EQ(image->sample_trilinear({10.0_mm, 20.0_mm, 32.1_mm}, -1024.0), -1024.0);
    EXPECT_EQ(image->sample_trilinear({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, -1024.0), -1024.0);
}

TEST_F(ReadImage, AppliesTheScaleOfTheFile) {
    text::Diagnostics diagnostics;
    const auto image = read_image(write("a.nii", Nifti().with(112, 2.0f).with(116, -1000.0f).file())).take(diagnostics);
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(1, 0, 0), -800.0f);
}

TEST_F(ReadImage, RefusesWhatIsNoFile) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_image(folder / "missing.nii").take(diagnostics));
    std::filesystem::create_directory(folder / "folder.nii");
    EXPECT_FALSE(read_image(folder / "folder.nii").take(diagnostics));
    EXPECT_FALSE(read_image("").take(diagnostics));
    EXPECT_FALSE(read_image("/dev/zero").take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 4u);
    for (const text::Diagnostic& d : diagnostics) EXPECT_EQ(d.code, "E0620") << to_text(diagnostics);
}

// Opening a FIFO waits for a writer for ever.
TEST_F(ReadImage, RefusesAFifoWhateverItsName) {
    for (const char* name : {"x.nrrd", "x.nhdr", "x.nii", "x.nii.gz", "x.mha", "x.mhd", "x", "x.raw"})
        ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    for (const char* name : {"x.nrrd", "x.nhdr", "x.nii", "x.nii.gz", "x.mha", "x.mhd", "x"}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(open_scan(folder / name, {}, {}).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "E0620") << to_text(diagnostics);
    }
    expect_refused("E0620", "a.mhd", replaced(meta_header, "LOCAL", "x.raw"));
    expect_refused("E0620", "a.nhdr", detached("data file: x.raw"));
}

TEST_F(ReadImage, RefusesAnUnknownEnding) { expect_refused("E0621", "a.png", "PNG"); }

TEST_F(ReadImage, RefusesWhatIsNotWhatItsEndingSays) {
    expect_refused("E0622", "a.nii", std::string(400, 'x'));
    expect_refused("E0622", "a.nii.gz", Nifti().file());
    expect_refused("E0622", "a.nrrd", "PNG\n\n");
    expect_refused("E0622", "a.mha", "PNG\n\n");
    expect_refused("E0622", "b.nii", Nifti().with<std::int32_t>(0, 540).file());
}

TEST_F(ReadImage, RefusesTruncatedFilesOfEveryFormat) {
    const auto cut = [](std::string bytes) { return bytes.substr(0, bytes.size() - 1); };
    expect_refused("E0626", "empty.nii", "");
    expect_refused("E0626", "a.nii", cut(Nifti().file()));
    const std::string gzip = packed(Nifti().file(), true);
    expect_refused("E0626", "b.nii.gz", gzip.substr(0, gzip.size() - 20 /* the sums at its end are 8 bytes */));
    expect_refused("E0626", "short.nii.gz", packed(cut(Nifti().file()), true));
    expect_refused("E0626", "c.nrrd", cut(nrrd_header + voxels()));
    expect_refused("E0626", "d.nrrd",
                   replaced(nrrd_header, "encoding: raw", "encoding: gzip") + packed(cut(voxels()), true));
    expect_refused("E0626", "e.mha", cut(meta_header + voxels()));
    write("g.raw", cut(voxels()));
    expect_refused("E0626", "g.mhd", replaced(meta_header, "LOCAL", "g.raw"));
}

TEST_F(ReadImage, RefusesDamagedCompressedData) {
    std::string header = replaced(nrrd_header, "encoding: raw", "encoding: gzip");
    expect_refused("E0626", "a.nrrd", header + "not compressed at all");
    std::string gzip = packed(Nifti().file(), true);
    gzip[12] = static_cast<char>(~gzip[12]);
    gzip[13] = static_cast<char>(~gzip[13]);
    expect_refused("E0626", "b.nii.gz", gzip);
}

TEST_F(ReadImage, ComparesTheCheckSumOfPackedVoxels) {
    const std::string header = replaced(nrrd_header, "encoding: raw", "encoding: gzip");
    const std::string meta = replaced(meta_header, "CompressedData = False", "CompressedData = True");
    const std::string gzip = packed(voxels(), true), nifti = packed(Nifti().file(), true),
                      zlib = packed(voxels(), false);
    for (std::size_t from_end = 1; from_end <= 8; ++from_end) {  // gzip ends with a check sum and a length
        const auto spoilt = [&](std::string bytes) {
            bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] ^ 1);
            return bytes;
        };
        expect_refused("E0626", "a.nrrd", header + spoilt(gzip));
        expect_refused("E0626", "b.nii.gz", spoilt(nifti));
        expect_refused("E0626", "c.nrrd", header + gzip.substr(0, gzip.size() - from_end));
        expect_refused("E0626", "d.nii.gz", nifti.substr(0, nifti.size() - from_end));
        if (from_end <= 4) expect_refused("E0626", "e.mha", meta + spoilt(zlib));
        if (from_end <= 4) expect_refused("E0626", "f.mha", meta + zlib.substr(0, zlib.size() - from_end));
    }
    // In two pieces, as bgzip writes it: the first one's sum counts, too.
    std::string first = packed(voxels().substr(0, 20), true);
    const std::string second = packed(voxels().substr(20), true);
    expect_the_volume("g.nrrd", header + first + second);
    first[first.size() - 6] = static_cast<char>(first[first.size() - 6] ^ 1);
    expect_refused("E0626", "h.nrrd", header + first + second);
}

TEST_F(ReadImage, RefusesASmallFileThatPromisesMuch) {
    // 512 million voxels of 2 bytes in a file of a few hundred
    expect_refused(
        "E0626", "a.nii",
        Nifti().with<std::int16_t>(42, 1024).with<std::int16_t>(44, 1024).with<std::int16_t>(46, 512).file());
    expect_refused("E0626", "b.nrrd", replaced(nrrd_header, "4 3 2", "1024 1024 512") + voxels());
    expect_refused("E0626", "c.mha", replaced(meta_header, "4 3 2", "1024 1024 512") + voxels());
    expect_refused("E0624", "d.mha", replaced(meta_header, "4 3 2", "4096 4096 4096") + voxels());
    expect_refused("E0624", "e.nrrd", replaced(nrrd_header, "4 3 2", "999999999999 3 2") + voxels());
}

TEST_F(ReadImage, RefusesSizesThatAreNone) {
    expect_refused("E0624", "a.nii", Nifti().with<std::int16_t>(42, -4).file());
    expect_refused("E0624", "b.nrrd", replaced(nrrd_header, "4 3 2", "4 -3 2") + voxels());
    expect_refused("E0624", "c.mha", replaced(meta_header, "4 3 2", "4 3 1") + voxels());
    expect_refused("E0622", "d.mha", replaced(meta_header, "4 3 2", "4 3 two") + voxels());
    expect_refused("E0623", "e.nii", Nifti().with<std::int16_t>(40, -1).file());
    expect_refused("E0623", "f.nii", Nifti().with<std::int16_t>(40, 4).with<std::int16_t>(48, 2).file());
}

TEST_F(ReadImage, RefusesTypesItCannotRead) {
    expect_refused("E0625", "a.nii", Nifti().with<std::int16_t>(70, 128 /* colours */).file());
    expect_refused("E0625", "f.nii", Nifti().with<std::int16_t>(70, 1536 /* 16 bytes */).file());
    expect_refused("E0625", "b.nrrd", replaced(nrrd_header, "type: short", "type: block") + voxels());
    expect_refused("E0625", "c.nrrd", replaced(nrrd_header, "encoding: raw", "encoding: bzip2") + voxels());
    expect_refused("E0625", "d.mha", replaced(meta_header, "MET_SHORT", "MET_OTHER") + voxels());
    expect_refused("E0623", "e.mha", "ElementNumberOfChannels = 3\n" + meta_header + voxels());
}

TEST_F(ReadImage, RefusesSpacingsThatAreNone) {
    expect_refused("E0627", "a.nii", Nifti().with(80, 0.0f).file());
    expect_refused("E0627", "b.nii", Nifti().with(300, std::numeric_limits<float>::quiet_NaN()).file());
    expect_refused("E0627", "c.nrrd", replaced(nrrd_header, "(0,1,0)", "(0.5,0,0)") + voxels());
    expect_refused("E0627", "d.mha", replaced(meta_header, "0.5 1 2", "0.5 -1 2") + voxels());
    expect_refused("E0627", "e.mha", replaced(meta_header, "0.5 1 2", "0.5 inf 2") + voxels());
}

TEST_F(ReadImage, RefusesAnImageThatDoesNotSayWhereLeftIs) {
    expect_refused("E0627", "a.nii", Nifti().with<std::int16_t>(254, 0).file());
    expect_refused("E0627", "b.nrrd", replaced(nrrd_header, "left-posterior-superior", "3D-right-handed") + voxels());
}

TEST_F(ReadImage, NeverLeavesTheFolderOfTheHeader) {
    for (const char* name : {"../g.raw", "/etc/passwd", "LIST", "g%d.raw 1 2 1", ".."})
        expect_refused("E0622", "a.mhd", replaced(meta_header, "LOCAL", name));
    expect_refused("E0622", "a.nrrd", replaced(nrrd_header, "endian", "data file: /etc/passwd\nendian") + voxels());
    expect_refused("E0620", "b.mhd", replaced(meta_header, "LOCAL", "missing.raw"));
    for (const char* name : {"../g.raw", "/etc/passwd", "LIST", "g%d.raw 1 2 1", "..", "a/../../g.raw"})
        expect_refused("E0622", "a.nhdr", detached("data file: " + std::string(name)));
    // A link may lead to a file beside it, but not out of the folder.
    write("g.raw", voxels());
    std::filesystem::create_symlink("g.raw", folder / "near.raw");
    const test::TemporaryFolder other;
    std::ofstream(other / "far.raw", std::ios::binary) << voxels();
    std::filesystem::create_symlink(other / "far.raw", folder / "far.raw");
    std::filesystem::create_directory_symlink(other.path(), folder / "away");
    expect_the_volume("c.mhd", replaced(meta_header, "LOCAL", "near.raw"));
    for (const char* name : {"far.raw", "away/far.raw"}) {
        expect_refused("E0619", "d.mhd", replaced(meta_header, "LOCAL", name));
        expect_refused("E0619", "d.nhdr", detached("data file: " + std::string(name)));
    }
}

TEST_F(ReadImage, ShowsNoControlCharacterOfAHeader) {
    for (const auto& [name, bytes] :
         {std::pair<const char*, std::string>{"a.nrrd", replaced(nrrd_header, "short", "\x1b[31m\xe2\x80\xae")},
          {"b.mha", replaced(meta_header, "MET_SHORT", "\x1b]0;title\x07")}}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_image(write(name, bytes)).take(diagnostics));
        EXPECT_NE(to_text(diagnostics).find("\\x1b"), std::string::npos) << to_text(diagnostics);
        for (const char* raw : {"\x1b", "\x07", "\xe2\x80\xae"})
            EXPECT_EQ(to_text(diagnostics).find(raw), std::string::npos);
    }
}

TEST_F(ReadImage, RefusesVoxelsThatAreNoNumbers) {
    std::string bytes(96, '\0');
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(bytes.data() + 8, &nan, sizeof nan);
    expect_refused("E0629", "a.mha", replaced(meta_header, "MET_SHORT", "MET_FLOAT") + bytes);
}

// Every header cut or spoilt at every byte: refused or read, never a crash or a throw.
TEST_F(ReadImage, SurvivesADamagedHeader) {
    const std::pair<const char*, std::string> files[]{
        {"a.nii", Nifti().file()}, {"b.nrrd", nrrd_header + voxels()}, {"c.mha", meta_header + voxels()}};
    for (const auto& [name, whole] : files)
        for (std::size_t at = 0; at < whole.size() - voxels().size(); ++at) {
            std::string spoilt = whole;
            spoilt[at] = static_cast<char>(spoilt[at] ^ 0x55);
            text::Diagnostics diagnostics;
            EXPECT_NO_THROW({
                const bool is_read = read_image(write(name, spoilt)).take(diagnostics).has_value();
                EXPECT_NE(is_read, text::has_error(diagnostics)) << name << " byte " << at;
            });
        }
}

/// The folder with real data, or nothing.
std::string real_data(const std::string& name) {
    const char* folder = std::getenv("KERF_DATA");
    const std::string file = folder ? std::string(folder) + "/volumes/" + name : "";
    return std::filesystem::exists(file) ? file : "";
}

TEST(RealData, TheSameCtInTwoFormatsHasTheSameValuesAtTheSamePlaces) {
    // Given a NIfTI whose axes are stored P, I, R with only an sform, and the same voxels reordered to x, y, z
    if (real_data("lumbar_l3_tptbox_ct.nii.gz").empty())
        GTEST_SKIP() << "KERF_DATA names no folder with volumes/lumbar_l3_tptbox_ct.nii.gz, so no real CT was read.";
    text::Diagnostics diagnostics;
    const auto nifti = read_image(real_data("lumbar_l3_tptbox_ct.nii.gz")).take(diagnostics);
    const auto meta = read_image(real_data("lumbar_l3_tptbox_axial.mhd")).take(diagnostics);
    ASSERT_TRUE(nifti && meta) << to_text(diagnostics);

    // Then every voxel of the one is the voxel of the other at the same place in the patient
    long long different = 0;
    for (int k = 0; k < meta->size[2]; ++k)
        for (int j = 0; j < meta->size[1]; ++j)
            for (int i = 0; i < meta->size[0]; ++i) {
                const Vec3 place = meta->lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
                const double other = nifti->sample_trilinear(place, 1e9);
                different += !(std::abs(other - static_cast<double>(meta->at(i, j, k))) < 0.5 /* of 1 HU */);
            }
    EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace kerf::bone
