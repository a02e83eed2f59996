// SPDX-License-Identifier: Apache-2.0
// Nothing of whose a scan is goes into a file that Kerf writes; and `kerf privacy` sees what others have left in
// theirs.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "app/privacy/privacy_report.h"
#include "session/recorder.h"
#include "session/report/report_data.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::DicomWriter;
using test::TemporaryFolder;
namespace tag = test::tag;

/// Sixty names and numbers, none of which is a word of any file of ours.
struct Planted {
    std::vector<std::string> strings;

    std::string next() {
        const auto n = static_cast<int>(strings.size());
        return strings.emplace_back("Qzx" + std::string(1, static_cast<char>('A' + n / 26)) +
                                    std::string(1, static_cast<char>('a' + n % 26)) + "wvkj" +
                                    std::to_string(7100 + n));
    }
    std::string next_uid() {
        return strings.emplace_back("2.25.4711." + std::to_string(900'000 + strings.size()) + ".81.1");
    }
};

/// A file that is given what it says of its patient with every element that may say it.
void plant(DicomWriter& file, Planted& planted) {
    for (const DicomWriter::Tag name : {0x00080090u, 0x00081048u, 0x00081050u, 0x00081060u, 0x00081070u, 0x00100010u,
                                        0x00101001u, 0x00101005u, 0x00101060u, 0x00321032u, 0x0040a075u, 0x0040a123u})
        file.text(name, "PN", planted.next() + "^" + planted.next());
    for (const DicomWriter::Tag text :
         {0x00080050u, 0x00080080u, 0x00081010u, 0x00081030u, 0x0008103eu, 0x00081040u, 0x00081080u,
          0x00100020u, 0x00100021u, 0x00101000u, 0x00101040u, 0x00102154u, 0x00102180u, 0x00104000u,
          0x00181000u, 0x00181030u, 0x00200010u, 0x00204000u, 0x00380010u, 0x00400254u, 0x00102000u,
          0x00102110u, 0x001021b0u, 0x00181400u, 0x00321033u, 0x00321060u, 0x00380300u, 0x00380500u})
        file.text(text, "LO", planted.next());
    file.text(0x00090010, "LO", planted.next())
        .text(0x00091001, "LO", planted.next())
        .text(0x00291010, "LO", planted.next());
    const std::string inner = planted.next() + (planted.strings.back().size() % 2 != 0 ? " " : "");
    std::string item = std::string("\xfe\xff\x00\xe0", 4) + std::string(1, static_cast<char>(8 + inner.size())) +
                       std::string(3, '\0') + std::string("\x10\x00\x10\x00PN", 6) +
                       std::string(1, static_cast<char>(inner.size())) + std::string(1, '\0') + inner;
    file.raw(0x00081120, "SQ", item);
    file.uid(tag::study, planted.next_uid())
        .uid(tag::series, planted.next_uid())
        .uid(tag::frame_of_reference, planted.next_uid());
    file.text(0x00100030, "DA", "19610307").text(0x00080020, "DA", "20190817");
}

/// A block of bone in slices, in a folder of somebody's name, in files of that name. Returns the folder.
std::string write_series(const std::string& folder, Planted& planted) {
    DicomWriter names;
    plant(names, planted);
    const std::string in = folder + "/" + planted.next() + "/" + planted.next(), stem = planted.next();
    fs::create_directories(in);
    int n = 0;
    for (double z = -16.0; z <= 16.0; z += 4.0, ++n) {
        std::vector<int> values;
        for (int r = 0; r < 12; ++r)
            for (int c = 0; c < 12; ++c)
                values.push_back(
                    std::max({std::abs(-22 + 4 * c), std::abs(-22 + 4 * r), static_cast<int>(std::abs(z))}) <= 10
                        ? 1000
                        : -1000);
        DicomWriter file = test::ct_slice(12, 12, 4.0, {-22, -22, z}, n + 1, values);
        Planted again;  // the same in every file
        plant(file, again);
        file.uid(tag::sop_instance, again.strings.back() + "." + std::to_string(n))
            .write(in + "/" + stem + std::to_string(n));
    }
    return in;
}

constexpr const char* procedure_text = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft}
needs: {landmarks: [way], zones: [nerve], tissues: [bone]}
anatomy: block.yaml
accuracy: {spacing: 1 mm}
haptics: {device: touch}
instruments:
  drill:
    plugin: kerf.drilling
    tool: twist_drill
    force: drill_cutting
    parameters: {diameter: 4 mm}
    drives: {spindle_speed: 1000 rpm}
steps:
  - {id: drill, title: Drill, instrument: drill, axis: way, goals: [{depth: {at_least: 3 mm}}]}
rehearsals:
  - {id: expert, expect: pass, hand: {feed: 1 mm/s, push: 100 N}, path: [{depth: -3 mm}, {depth: 5 mm}, {depth: -3 mm}]}
)";

std::string anatomy_text(const std::string& image) {
    return "apiVersion: kerf/v1\nkind: Anatomy\nmetadata: {id: block, title: A block of bone}\nct: {image: " + image +
           ", threshold: 0}\ntissues: [{id: bone, density: 1.5 g/cm3}]\nlandmarks:\n"
           "  points: {midline: {at: 9 0 0 mm, tolerance: 1 mm}}\n  axes: {way: {from: 0 0 15 mm, to: 0 0 -9 mm, "
           "tolerance: 1 mm}}\n"
           "zones: {nerve: [{tube: {from: 18 0 -9 mm, to: 18 0 9 mm, radius: 1 mm}}]}\n";
}

int run(const std::string& arguments, const std::string& log) {
    const int status = std::system((KERF_BUILD_DIR "/bin/kerf " + arguments + " > " + log + " 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string in_lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}
std::string in_utf16(const std::string& text) {
    std::string wide;
    for (const char c : text) wide += std::string{c, '\0'};
    return wide.substr(0, wide.size() - 1);  // the last zero may be anything's
}

/// Every planted string in every file below a folder, in either case, in one byte a letter or two.
std::vector<std::string> hits_in(const std::string& folder, const Planted& planted) {
    std::vector<std::string> hits;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string bytes =
            entry.is_regular_file() ? in_lower_case(test::contents_of(entry.path().string())) : "";
        const std::string name = in_lower_case(entry.path().filename().string());
        for (const std::string& one : planted.strings) {
            const std::string wanted = in_lower_case(one);
            if (bytes.find(wanted) != std::string::npos || bytes.find(in_utf16(wanted)) != std::string::npos ||
                name.find(wanted) != std::string::npos)
                hits.push_back(one + " in " + entry.path().filename().string());
        }
    }
    return hits;
}

struct Privacy : testing::Test {
    TemporaryFolder folder;
    Planted planted;
    std::string series = write_series(folder.path(), planted);
    std::string written = folder / "written";

    Privacy() {
        fs::create_directory(written);
        std::ofstream(folder / "hole.yaml") << procedure_text;
    }
    void expect_done(const std::string& arguments) {
        const std::string log = folder / "log";
        ASSERT_EQ(run(arguments, log), 0) << arguments << "\n" << test::contents_of(log);
    }
};

TEST_F(Privacy, CopiesNoPersonalDataOfASeries) {
    // Given sixty names in a series: in elements, private ones, sequences, UIDs, and the names of folders and files
    ASSERT_GE(planted.strings.size(), 60u);
    ASSERT_FALSE(hits_in(series, planted).empty());

    // When it is imported and a procedure is run on what came of it, and on the series itself, out of a folder of that
    // name
    expect_done("import " + series + " -o " + written + "/bone.nrrd");
    std::ofstream(written + "/block.yaml") << anatomy_text("bone.nrrd");
    expect_done("run " + (folder / "hole.yaml") + " --anatomy " + written + "/block.yaml --out " + written +
                "/by-file");
    expect_done("preview " + (folder / "hole.yaml") + " --anatomy " + written + "/block.yaml -o " + written +
                "/by-file.html");
    const fs::path above = fs::path(series).parent_path();
    std::ofstream(above / "block.yaml") << anatomy_text(fs::path(series).filename().string());
    expect_done("run " + (folder / "hole.yaml") + " --anatomy " + (above / "block.yaml").string() + " --out " +
                written + "/by-series");
    expect_done("preview " + (folder / "hole.yaml") + " --anatomy " + (above / "block.yaml").string() + " -o " +
                written + "/by-series.html");

    // Then none of them is in a file that was written
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(written)) files += entry.is_regular_file();
    EXPECT_EQ(files, 12u);
    for (const std::string& hit : hits_in(written, planted)) ADD_FAILURE() << hit;

    // And the program finds nothing in them
    for (const char* name :
         {"bone.nrrd", "by-file/session.db", "by-series/session.db", "by-file/summary.json", "by-file/report.html",
          "by-file/bone.stl", "by-file.html", "by-series/summary.json", "by-series/report.html", "by-series.html"}) {
        const PrivacyReport report = privacy_report(written + "/" + name);
        EXPECT_TRUE(report.error.empty() && report.findings.empty()) << privacy_text(name, report, true);
    }
}

TEST_F(Privacy, NamesElementsAndMasksValues) {
    const std::string file = fs::directory_iterator(series)->path().string();
    const PrivacyReport report = privacy_report(file);
    const std::string text = privacy_text("slice", report, false), shown = privacy_text("slice", report, true);
    EXPECT_GE(report.findings.size(), 36u) << text;
    EXPECT_NE(text.find("patient's name (0010,0010): Q…"), std::string::npos) << text;
    EXPECT_NE(text.find("date of birth (0010,0030): 1… (8 characters)"), std::string::npos) << text;
    EXPECT_NE(text.find("3 private elements"), std::string::npos) << text;
    EXPECT_NE(shown.find("patient's name (0010,0010), in a sequence: Qzx"), std::string::npos) << shown;
    for (const std::string& one : planted.strings) EXPECT_EQ(text.find(one), std::string::npos) << one;
    EXPECT_NE(shown.find("19610307"), std::string::npos);

    EXPECT_EQ(run("privacy " + file, folder / "log"), 1) << test::contents_of(folder / "log");
    EXPECT_EQ(test::contents_of(folder / "log").find("19610307"), std::string::npos);
    EXPECT_EQ(run("privacy " + (folder / "gone"), folder / "log"), 2);
    EXPECT_EQ(run("privacy " + (folder / "hole.yaml"), folder / "log"), 0) << test::contents_of(folder / "log");
}

TEST(PrivacyReport, FindsPathsNamesAndDates) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> leftovers[]{{"seen at /home/jane/scans/1", "a path"},
                                                          {"C:\\Users\\jane\\x", "a path"},
                                                          {"\"uid\": \"1.2.840.113619.2.55.3\"", "a UID"},
                                                          {"by Doe^Jane today", "a person's name as DICOM writes it"},
                                                          {"taken 20190817 at noon", "a date"},
                                                          {"taken 2019-08-17T10:00", "a date"},
                                                          {"PatientID=4", "a field for a patient"}};
    for (const auto& [text, what] : leftovers)
        for (const bool is_wide : {false, true}) {
            std::string bytes = text;
            if (is_wide) {
                bytes.clear();
                for (const char* c = text; *c != '\0'; ++c) bytes += std::string{*c, '\0'};
            }
            std::ofstream(folder / "some.txt", std::ios::binary) << bytes;
            const PrivacyReport report = privacy_report(folder / "some.txt");
            ASSERT_EQ(report.findings.size(), 1u) << text;
            EXPECT_EQ(report.findings[0].what, what) << text;
        }
    // And nothing in what only looks like it
    std::ofstream(folder / "some.txt") << "version 1.2.3 of 3.14159, 12345678, 2 ^ 3, x^2, http://www.w3.org/2000/svg, "
                                          "and/or, 20191399, f81d4fae-7dec-41d0-a765-00a0c91e6bf6";
    const PrivacyReport report = privacy_report(folder / "some.txt");
    EXPECT_TRUE(report.findings.empty()) << privacy_text("some.txt", report, true);
}

// ---- where nobody looks
// ------------------------------------------------------------------------------------------------

/// An element as explicit little-endian files have it, of a sort with two bytes of length.
std::string element(int group, int number, const std::string& sort, std::string value) {
    if (value.size() % 2 != 0) value += ' ';
    const auto two = [](std::size_t n) {
        return std::string{static_cast<char>(n & 0xff), static_cast<char>(n >> 8 & 0xff)};
    };
    return two(static_cast<std::size_t>(group)) + two(static_cast<std::size_t>(number)) + sort + two(value.size()) +
           value;
}
std::string bytes_of(std::uint32_t n) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> (8 * i) & 0xff);
    return bytes;
}
/// A sequence of one item, with lengths or with marks where they end.
std::string sequence(int group, int number, const std::string& inside, bool has_length) {
    const std::string tag{static_cast<char>(group & 0xff), static_cast<char>(group >> 8),
                          static_cast<char>(number & 0xff), static_cast<char>(number >> 8)};
    const std::string item("\xfe\xff\x00\xe0", 4), item_end("\xfe\xff\x0d\xe0\0\0\0\0", 8),
        end("\xfe\xff\xdd\xe0\0\0\0\0", 8);
    const std::string all = has_length ? item + bytes_of(static_cast<std::uint32_t>(inside.size())) + inside
                                       : item + bytes_of(0xffffffffu) + inside + item_end + end;
    return tag + std::string("SQ\0\0", 4) +
           bytes_of(has_length ? static_cast<std::uint32_t>(all.size()) : 0xffffffffu) + all;
}

std::vector<std::string> kinds_of(const PrivacyReport& report) {
    std::vector<std::string> kinds;
    for (const PrivacyFinding& f : report.findings) kinds.push_back(f.what + "=" + f.value);
    return kinds;
}
bool has(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

TEST(PrivacyReport, SearchesNestedSequences) {
    const TemporaryFolder folder;
    for (const bool has_length : {true, false}) {
        const std::string who = element(0x0010, 0x0010, "PN", "Doe^Jane"),
                          study = element(0x0040, 0xa160, "LO", "seen at /home/jane/scans/1");
        const std::string deep =
            sequence(0x0008, 0x1140, sequence(0x0040, 0xa730, who + study, has_length), has_length);
        const std::string meta = element(0x0002, 0x0010, "UI", "1.2.840.10008.1.2.1");
        std::ofstream(folder / "a.dcm", std::ios::binary)
            << std::string(128, '\0') + "DICM" + meta + deep + element(0x0010, 0x0020, "LO", "4711");
        const PrivacyReport report = privacy_report(folder / "a.dcm");
        const auto kinds = kinds_of(report);
        EXPECT_TRUE(has(kinds, "patient's name (0010,0010), in a sequence=Doe^Jane"))
            << privacy_text("a.dcm", report, true);
        EXPECT_TRUE(has(kinds, "a path, in a sequence=/home/jane/scans/1")) << privacy_text("a.dcm", report, true);
        EXPECT_TRUE(has(kinds, "patient's number (0010,0020)=4711")) << privacy_text("a.dcm", report, true);
        EXPECT_TRUE(report.unseen.empty() && !report.is_partial) << privacy_text("a.dcm", report, true);
    }
}

TEST(PrivacyReport, ReportsADamagedSequence) {
    const TemporaryFolder folder;
    std::string deep = sequence(0x0008, 0x1140, element(0x0010, 0x0010, "PN", "Doe^Jane"), true);
    deep.replace(deep.find("PN") + 2, 2, "\xff\x7f");  // longer than the file
    std::ofstream(folder / "a.dcm", std::ios::binary) << std::string(128, '\0') + "DICM" +
                                                             element(0x0002, 0x0010, "UI", "1.2.840.10008.1.2.1") +
                                                             deep + element(0x0010, 0x0020, "LO", "4711");
    const PrivacyReport report = privacy_report(folder / "a.dcm");
    EXPECT_TRUE(has(kinds_of(report), "patient's number (0010,0020)=4711"));
    EXPECT_TRUE(report.is_partial);
    ASSERT_EQ(report.unseen.size(), 1u);
    EXPECT_TRUE(report.unseen[0].starts_with("A sequence is damaged")) << report.unseen[0];
}

/// Packed as gzip packs.
std::string gzipped(const std::string& bytes) {
    z_stream packer{};
    if (deflateInit2(&packer, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) std::abort();
    std::string packed(deflateBound(&packer, bytes.size()) + 64, '\0');
    packer.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    packer.avail_in = static_cast<unsigned>(bytes.size());
    packer.next_out = reinterpret_cast<Bytef*>(packed.data());
    packer.avail_out = static_cast<unsigned>(packed.size());
    if (deflate(&packer, Z_FINISH) != Z_STREAM_END) std::abort();
    packed.resize(packed.size() - packer.avail_out);
    deflateEnd(&packer);
    return packed;
}

/// Three megabytes that mean nothing, with a word in the middle.
std::string voxels_with(const std::string& word) {
    std::string bytes;
    std::uint32_t state = 7;
    for (int n = 0; n < 3'000'000; ++n) bytes += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    const std::string framed = std::string(1, '\0') + word + std::string(1, '\0');
    return bytes.replace(1'500'000, framed.size(), framed);
}

TEST(PrivacyReport, SearchesVoxelsCompressedOrNot) {
    const TemporaryFolder folder;
    const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 100 100 150\nencoding: ",
                      meta = "ObjectType = Image\nNDims = 3\nCompressedData = ";
    for (const auto& [word, what] :
         {std::pair<std::string, std::string>{"by Doe^Jane, 4",
                                              "a person's name as DICOM writes it, among the voxels=Doe^Jane"},
          {"/home/jane/scans/1", "a path, among the voxels=/home/jane/scans/1"},
          {"", ""}}) {
        const std::string voxels = voxels_with(word), nifti = std::string(352, '\0') + voxels;
        for (const auto& [name, bytes] : {std::pair<const char*, std::string>{"a.nii", nifti},
                                          {"a.nii.gz", gzipped(nifti)},
                                          {"raw.nrrd", nrrd + "raw\n\n" + voxels},
                                          {"gz.nrrd", nrrd + "gzip\n\n" + gzipped(voxels)},
                                          {"raw.mha", meta + "False\nElementDataFile = LOCAL\n" + voxels},
                                          {"gz.mha", meta + "True\nElementDataFile = LOCAL\n" + gzipped(voxels)}}) {
            std::ofstream(folder / name, std::ios::binary) << bytes;
            const PrivacyReport report = privacy_report(folder / name);
            if (word.empty())
                EXPECT_TRUE(report.findings.empty()) << privacy_text(name, report, true);
            else
                EXPECT_EQ(kinds_of(report), std::vector<std::string>{what}) << name;
        }
    }
}

TEST(PrivacyReport, IgnoresCornersOfTriangles) {
    // Given voxels of two bytes whose high bytes are a letter each, and a caret where the low one happens to be one
    const TemporaryFolder folder;
    std::string voxels;
    for (int n = 0; n < 4000; ++n) {
        voxels += n % 7 == 3 ? '^' : static_cast<char>('K' + n % 3);
        voxels += 'X';
    }
    const std::string header =
        "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 20 20 10\nspacings: 1 1 1\nencoding: raw\nendian: little\n\n";
    const std::string file = folder / "labels.nrrd";
    std::ofstream(file, std::ios::binary) << header << voxels;
    for (const PrivacyFinding& found : privacy_report(file).findings)
        ADD_FAILURE() << found.what << ": " << found.value;
    // and a name beside them is still seen
    std::ofstream(file, std::ios::binary)
        << header << voxels.substr(0, 4000) << " Muster^Maximilian " << voxels.substr(4019);
    EXPECT_EQ(privacy_report(file).findings.size(), 1u);
}

TEST(PrivacyReport, ReportsUncheckedVoxels) {
    const TemporaryFolder folder;
    const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 1 1 1\nencoding: ";
    std::string cut = gzipped(voxels_with(""));
    cut.replace(cut.size() / 2, 1000, 1000, '\xff');
    std::ofstream(folder / "a.nrrd", std::ios::binary) << nrrd + "gzip\n\n" + cut;
    EXPECT_NE(
        privacy_text("a", privacy_report(folder / "a.nrrd"), false).find("damaged. They were not checked to their end"),
        std::string::npos);
    std::ofstream(folder / "b.nrrd", std::ios::binary) << nrrd + "bzip2\n\nBZh";
    EXPECT_NE(privacy_text("b", privacy_report(folder / "b.nrrd"), false).find("but not by gzip"), std::string::npos);
}

TEST(PrivacyReport, SearchesBase64InPages) {
    const TemporaryFolder folder;
    std::string bytes(600, '\x01');
    for (std::size_t shift = 0; shift < 3; ++shift) {
        const std::string planted = bytes.substr(0, 300 + shift) + "/home/jane/scans/1" + bytes;
        std::ofstream(folder / "report.html")
            << "<script>{\"positions\":\""
            << session::base64({reinterpret_cast<const unsigned char*>(planted.data()), planted.size()})
            << "\"}</script>";
        EXPECT_EQ(kinds_of(privacy_report(folder / "report.html")),
                  std::vector<std::string>{"a path, in base64=/home/jane/scans/1"})
            << shift;
    }
}

void change_session(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
}

TEST(PrivacyReport, AllowsTheStartAndNumberOfASession) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    session::SessionHeader header;
    header.envelope.start = "2026-11-25T01:02:03Z";
    header.envelope.uuid = "20240517-2024-4051-8240-202405172024";
    session::Recorder::create(path, header).recorder.reset();
    EXPECT_EQ(kinds_of(privacy_report(path)), std::vector<std::string>{});

    // Any other text in their place, and the same text in any other place, is found
    for (const char* sql :
         {"UPDATE envelope SET value='1961-02-03' WHERE key='start'",
          "UPDATE envelope SET value='2026-11-25T01:02:03Z of 1961-02-03' WHERE key='start'",
          "UPDATE envelope SET key='consent' WHERE key='start'",
          "UPDATE session SET value='2026-11-25T01:02:03Z' WHERE key='anatomy_notes'", "PRAGMA application_id=7"}) {
        const std::string copy = folder / "copy.db";
        fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
        change_session(copy, sql);
        EXPECT_FALSE(privacy_report(copy).findings.empty()) << sql;
    }
}

TEST(PrivacyReport, IgnoresNumbersOfASession) {
    // Given a session with a megabyte of numbers that look like noise
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = session::Recorder::create(path, {}).recorder;
    std::uint64_t noise = 1;
    for (std::uint64_t tick = 0; tick < 6000; ++tick) {
        session::TickRow row;
        row.tick = tick;
        for (double& component : row.coupled) {
            noise = noise * 6364136223846793005u + 1442695040888963407u;
            component = static_cast<double>(noise >> 11);
        }
        for (Vec6* same : {&row.modelled, &row.limited}) *same = row.coupled;
        recorder->push(row);
    }
    recorder.reset();
    ASSERT_GT(fs::file_size(path), 400'000u);
    EXPECT_EQ(kinds_of(privacy_report(path)), std::vector<std::string>{});

    // But bytes that are not numbers alone are searched
    change_session(path, "UPDATE blocks SET data=CAST(data || '/home/jane/scans/1' AS BLOB) WHERE column_name='depth'");
    EXPECT_EQ(kinds_of(privacy_report(path)), std::vector<std::string>{"a path, among bytes=/home/jane/scans/1"});
}

TEST(PrivacyReport, ReadsTheTextsOfANiftiHeader) {
    const TemporaryFolder folder;
    std::string header(352, '\0');
    header.replace(148, 9, "of a name");
    std::ofstream(folder / "a.nii", std::ios::binary) << header;
    const PrivacyReport report = privacy_report(folder / "a.nii");
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(report.findings[0].value, "of a name");
}

}  // namespace
}  // namespace kerf::app
