// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ios>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bone/image/scan.h"
#include "kerf/units.hpp"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::DicomWriter;
namespace tag = test::tag;

constexpr int columns = 6, rows = 5, slices = 4;
constexpr double pixel = 0.5, step = 2.0;  // [mm]

/// A function of the place that is linear, so that every interpolation must reproduce it: 100 x + 10 y + z [mm] HU.
double linear(double x, double y, double z) { return 100.0 * x + 10.0 * y + z; }

/// A series as one folder of files, one change at a time.
struct Series {
    std::vector<DicomWriter> files;

    /// First voxels at (10, 20 + shift, 30 + z) mm.
    static Series of(const std::vector<double>& heights, double shift_per_mm = 0.0) {
        Series series;
        for (std::size_t n = 0; n < heights.size(); ++n) {
            const double z = 30.0 + heights[n], y0 = 20.0 + shift_per_mm * heights[n];
            std::vector<int> values;
            for (int r = 0; r < rows; ++r)
                for (int c = 0; c < columns; ++c)
                    values.push_back(static_cast<int>(std::lround(linear(10.0 + pixel * c, y0 + pixel * r, z))));
            series.files.push_back(test::ct_slice(columns, rows, pixel, {10, y0, z}, static_cast<int>(n) + 1, values));
        }
        return series;
    }
    static Series straight() { return of({0, 2, 4, 6}); }
};

struct Dicom : testing::Test {
    test::TemporaryFolder folder;
    text::Diagnostics diagnostics;

    void write(const Series& series, const std::vector<std::size_t>& order = {}) {
        for (std::size_t n = 0; n < series.files.size(); ++n) {
            const std::size_t name = order.empty() ? n : order[n];
            series.files[n].write(folder / ("IM" + std::to_string(name)));
        }
    }
    std::optional<VoxelImage> read(const SeriesChoice& choice = {}) {
        const auto scan = open_scan(folder.path(), choice, {}).take(diagnostics);
        return scan ? scan->read(scan->grid().all(), 0, {}).take(diagnostics) : std::nullopt;
    }
    void expect_refused(const std::string& code, const std::string& words, const SeriesChoice& choice = {}) {
        EXPECT_FALSE(read(choice));
        ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
        EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
        EXPECT_NE(diagnostics[0].message.find(words), std::string::npos) << to_text(diagnostics);
    }
};

double at_mm(const VoxelImage& image, double x, double y, double z) {
    return image.sample_trilinear({1e-3 * x, 1e-3 * y, 1e-3 * z}, -9999.0);
}

TEST_F(Dicom, HasEveryVoxelWhereItsSliceSays) {
    write(Series::straight());
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    EXPECT_EQ(image->size, (std::array<int, 3>{columns, rows, slices}));
    for_each(image->values.begin(), image->values.end(), [](float v) { EXPECT_TRUE(std::isfinite(v)); });
    EXPECT_EQ(image->at(0, 0, 0), 1230.0f);  // 100 × 10 + 10 × 20 + 30
    EXPECT_EQ(image->at(2, 4, 3), 1356.0f);  // 100 × 11 + 10 × 22 + 36
    EXPECT_NEAR(at_mm(*image, 11.25, 21.25, 33.0), linear(11.25, 21.25, 33.0), 1e-2);
}

TEST_F(Dicom, KnowsNothingOfTheOrderOfFilesOrInstances) {
    Series turned = Series::straight();
    for (std::size_t n = 0; n < turned.files.size(); ++n)
        turned.files[n].text(tag::instance, "IS", std::to_string(100 - static_cast<int>(n)));
    write(turned, {2, 0, 3, 1});
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(2, 4, 3), 1356.0f);
}

TEST_F(Dicom, IsNeverMirroredWhateverTheOrientation) {
    // Sagittal slices: rows to the back, columns down to the feet; the normal points to the patient's left or right
    Series sagittal = Series::straight();
    for (std::size_t n = 0; n < sagittal.files.size(); ++n) {
        const double x = 10.0 + 2.0 * static_cast<double>(n);
        std::vector<std::int16_t> values;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c)
                values.push_back(
                    static_cast<std::int16_t>(std::lround(linear(x, 20.0 + pixel * c, 30.0 - pixel * r)) + 1024));
        sagittal.files[n]
            .number(tag::orientation, {0, 1, 0, 0, 0, -1})
            .number(tag::position, {x, 20, 30})
            .voxels(values);
    }
    write(sagittal);
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_GT(dot(image->step(0), cross(image->step(1), image->step(2))), 0.0);
    for (const Vec3 p : {Vec3{10, 20, 30}, Vec3{16, 20, 30}, Vec3{10, 22.5, 30}, Vec3{10, 20, 28}, Vec3{13, 21, 29}})
        EXPECT_NEAR(at_mm(*image, p.x, p.y, p.z), linear(p.x, p.y, p.z), 0.6 /* stored as whole HU */);
}

TEST_F(Dicom, ScalesEverySliceByItsOwnSlopeAndIntercept) {
    Series series = Series::straight();
    std::vector<std::int16_t> stored;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            stored.push_back(static_cast<std::int16_t>(
                std::lround((linear(10.0 + pixel * c, 20.0 + pixel * r, 34.0) + 500.0) / 0.5)));
    series.files[2].number(tag::slope, {0.5}).number(tag::intercept, {-500}).voxels(stored);
    write(series);
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(0, 0, 2), 1234.0f);
    EXPECT_EQ(image->at(0, 0, 1), 1232.0f);
}

TEST_F(Dicom, ReadsSignedAndShortPixelsAndSetsPaddingAside) {
    Series series = Series::straight();
    for (DicomWriter& file : series.files) {
        // 12 bits, signed; bit 12 to 15 hold an overlay that is nobody's HU
        std::vector<std::int16_t> raw(columns * rows,
                                      static_cast<std::int16_t>(0xa000 | (static_cast<std::uint16_t>(-100) & 0x0fff)));
        raw[0] = static_cast<std::int16_t>(0x0fff & static_cast<std::uint16_t>(-2000));  // padding
        file.word(tag::bits_stored, 12).word(tag::high_bit, 11).word(tag::representation, 1);
        file.word(tag::padding, -2000, "SS").number(tag::intercept, {0}).voxels(raw);
    }
    write(series);
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(1, 0, 0), -100.0f);
    EXPECT_EQ(image->at(0, 0, 0), -100.0f);  // never measured: the smallest value that was
}

TEST_F(Dicom, ReadsImplicitHeadersToo) {
    Series series = Series::straight();
    for (DicomWriter& file : series.files) file.syntax = "1.2.840.10008.1.2";
    write(series);
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(2, 4, 3), 1356.0f);
}

TEST_F(Dicom, RefusesMissingSlicesUnlessToldToFillThem) {
    write(Series::of({0, 2, 4, 8, 10}));
    expect_refused("E0665", "4.00 mm behind z 34.00 mm");
    diagnostics.clear();

    const auto image = read({.name = "", .may_resample = true});
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->size[2], 6);
    EXPECT_NEAR(image->spacing(2), 2.0_mm, 1e-9);
    EXPECT_NEAR(at_mm(*image, 11.0, 21.0, 36.0), linear(11.0, 21.0, 36.0), 1e-2);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "W0672");
}

TEST_F(Dicom, PutsUnevenSlicesWhereTheyBelong) {
    write(Series::of({0, 2, 4.3, 6.2, 8.5}));
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(diagnostics.size(), 1u);
    for (double z = 30.0; z <= 38.4; z += 0.7)
        EXPECT_NEAR(at_mm(*image, 11.0, 21.0, z), linear(11.0, 21.0, z), 0.6 /* stored as whole HU */) << z;
}

TEST_F(Dicom, ReportsTheSpacingThatItWrites) {
    // Given positions that are rounded to 0.1 mm, a gap that is filled, and even slices
    for (const std::vector<double>& heights : std::vector<std::vector<double>>{
             {0, 0.6, 1.2, 1.8, 2.3, 2.9, 3.5, 4.1, 4.7}, {0, 0.63, 1.26, 2.52, 3.15}, {0, 0.6, 1.2, 1.8, 2.4}}) {
        for (const auto& file : std::filesystem::directory_iterator(folder.path())) std::filesystem::remove(file);
        write(Series::of(heights));
        diagnostics.clear();
        const auto image = read({.name = "", .may_resample = true});
        ASSERT_TRUE(image) << to_text(diagnostics);
        const std::string all = to_text(diagnostics);
        const std::size_t at = all.find("resampled every ");
        EXPECT_EQ(at == std::string::npos, heights[1] == 0.6 && heights[2] == 1.2 && heights.size() == 5) << all;
        if (at == std::string::npos) continue;
        double named = 0.0;
        const char* number = all.c_str() + at + std::string_view("resampled every ").size();
        std::from_chars(number, all.c_str() + all.size(), named);
        EXPECT_NEAR(named * 1e-3, image->spacing(2), 0.06e-6) << all;
    }
}

TEST_F(Dicom, PutsATiltedSeriesStraight) {
    // Given slices that slide by 0.3 mm to the back, or to the front, for every mm, as under a tilted gantry
    for (const double slide : {0.3, -0.3}) {
        diagnostics.clear();
        write(Series::of({0, 2, 4, 6}, slide));
        const auto image = read();
        ASSERT_TRUE(image) << to_text(diagnostics);
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "W0671");
        EXPECT_NE(diagnostics[0].message.find("16.7 deg"), std::string::npos) << diagnostics[0].message;

        // Then the axes are at right angles, all slices are in, and values are where they were measured
        const auto shifted = [&](double height) { return 20.0 + slide * height; };  // the slice's first row
        const double first = std::min(shifted(0.0), shifted(6.0)), last = std::max(shifted(0.0), shifted(6.0));
        EXPECT_FALSE(image->is_sheared());
        EXPECT_LE(image->box().low.y, 1e-3 * first + 1e-9);
        EXPECT_GE(image->box().high.y, 1e-3 * (last + 4 * pixel) - 1e-9);
        for (double z = 30.0; z <= 36.0; z += 0.5)
            for (double y = first; y < last + 4 * pixel; y += 0.1) {
                const double below = std::floor((z - 30.0) / step) * step, above = std::ceil((z - 30.0) / step) * step;
                const bool is_inside = y - pixel >= std::max(shifted(above), shifted(below)) &&
                                       y + pixel <= std::min(shifted(above), shifted(below)) + 4 * pixel;
                if (!is_inside) continue;  // outside one of the two slices
                EXPECT_NEAR(at_mm(*image, 11.0, y, z), linear(11.0, y, z), 0.8) << y << " " << z;
            }
    }
}

TEST_F(Dicom, RefusesSlicesThatLieBesideEachOther) {
    Series crooked = Series::straight();
    crooked.files[2].number(tag::position, {13, 20, 34});
    write(crooked);
    expect_refused("E0666", "4.3 voxels");
}

TEST_F(Dicom, RefusesAScaleThatMakesNoFiniteValues) {
    Series steep = Series::straight();
    steep.files[1].text(tag::slope, "DS", "1e308");
    write(steep);
    expect_refused("E0667", "rescale slope (0028,1053) or intercept");
}

TEST_F(Dicom, RefusesTwoSlicesInOnePlace) {
    Series twice = Series::straight();
    twice.files.push_back(twice.files[1]);
    twice.files.back().text(tag::instance, "IS", "17");
    write(twice);
    expect_refused("E0664", "at z 32.00 mm (instances 2 and 17)");
}

TEST_F(Dicom, OffersMixedSeriesByName) {
    Series mixed = Series::straight();
    for (DicomWriter& file : Series::of({0, 1, 2}).files)
        mixed.files.push_back(file.uid(tag::series, "1.2.3.9").text(tag::series_number, "IS", "7"));
    write(mixed);
    expect_refused("E0661", "`4`: 4 slices of 6 × 5 pixels, 0.50 mm each, CT; `7`: 3 slices");
    diagnostics.clear();
    expect_refused("E0662", "no series `5`", {.name = "5"});
    diagnostics.clear();

    const auto image = read({.name = "7"});
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->size[2], 3);
}

TEST_F(Dicom, NamesSeriesThatShareANumber) {
    Series mixed = Series::straight();
    for (DicomWriter& file : Series::of({0, 1, 2}).files) mixed.files.push_back(file.uid(tag::series, "1.2.3.9"));
    write(mixed);
    expect_refused("E0661", "`4a`: 4 slices of 6 × 5 pixels, 0.50 mm each, CT; `4b`: 3 slices");
}

TEST_F(Dicom, RefusesSlicesThatDiffer) {
    const std::vector<std::pair<std::string, std::function<void(DicomWriter&)>>> changes{
        {"in orientation",
         [](DicomWriter& f) {
             f.number(tag::orientation, {1, 0, 0, 0, 0, 1});
         }},
        {"in pixel spacing",
         [](DicomWriter& f) {
             f.number(tag::pixel_spacing, {0.6, 0.5});
         }},
        {"in frame of reference", [](DicomWriter& f) { f.uid(tag::frame_of_reference, "1.9"); }},
        {"in modality", [](DicomWriter& f) { f.text(tag::modality, "CS", "MR"); }},
    };
    for (const auto& [words, change] : changes) {
        SCOPED_TRACE(words);
        diagnostics.clear();
        Series series = Series::straight();
        change(series.files[1]);
        write(series);
        expect_refused("E0663", words);
    }
}

TEST_F(Dicom, RefusesASliceThatLacksSomething) {
    const std::vector<std::pair<std::string, std::function<void(DicomWriter&)>>> changes{
        {"no position", [](DicomWriter& f) { f.without(tag::position); }},
        {"no orientation", [](DicomWriter& f) { f.without(tag::orientation); }},
        {"no pixel spacing", [](DicomWriter& f) { f.without(tag::pixel_spacing); }},
        {"no position", [](DicomWriter& f) { f.text(tag::position, "DS", "1,5\\2\\3"); }},
        {"no pair of unit vectors",
         [](DicomWriter& f) {
             f.number(tag::orientation, {1, 0, 0, 1, 0, 0});
         }},
        {"outside 0.001 mm",
         [](DicomWriter& f) {
             f.number(tag::pixel_spacing, {0, 0});
         }},
        {"3 numbers per pixel", [](DicomWriter& f) { f.word(tag::samples, 3); }},
        {"several frames", [](DicomWriter& f) { f.text(tag::frames, "IS", "12"); }},
        {"not MONOCHROME2", [](DicomWriter& f) { f.text(tag::photometric, "CS", "PALETTE COLOR"); }},
        {"bits per pixel", [](DicomWriter& f) { f.word(tag::bits_allocated, 12); }},
        {"bytes of pixels", [](DicomWriter& f) { f.word(tag::rows, 4000); }},
        {"must have 2 … 4096", [](DicomWriter& f) { f.word(tag::columns, 60000); }},
        {"slope", [](DicomWriter& f) { f.number(tag::slope, {0}); }},
    };
    for (const auto& [words, change] : changes) {
        SCOPED_TRACE(words);
        diagnostics.clear();
        Series series = Series::straight();
        change(series.files[1]);
        write(series);
        expect_refused("E0667", words);
    }
}

/// DICOM's run lengths, without runs: high bytes, then low bytes, in literal groups.
std::string run_length_coded(const std::vector<std::int16_t>& values) {
    std::string coded(64, '\0');
    const auto word = [&](std::size_t at, std::uint32_t value) {
        std::memcpy(coded.data() + at, &value, sizeof value);
    };
    word(0, 2);
    for (const int byte : {1, 0}) {
        word(byte == 1 ? 4 : 8, static_cast<std::uint32_t>(coded.size()));
        for (std::size_t at = 0; at < values.size(); at += 128) {
            const std::size_t count = std::min<std::size_t>(128, values.size() - at);
            coded.push_back(static_cast<char>(count - 1));
            for (std::size_t n = at; n < at + count; ++n)
                coded.push_back(static_cast<char>(static_cast<std::uint16_t>(values[n]) >> (8 * byte)));
        }
        if (coded.size() % 2 != 0) coded.push_back('\0');
    }
    return coded;
}

TEST_F(Dicom, UnpacksRunLengths) {
    Series series = Series::straight();
    for (std::size_t n = 0; n < series.files.size(); ++n) {
        std::vector<std::int16_t> values;
        for (int i = 0; i < columns * rows; ++i)
            values.push_back(static_cast<std::int16_t>(1024 + 300 * static_cast<int>(n) + i));
        series.files[n].fragment("1.2.840.10008.1.2.5", run_length_coded(values));
    }
    write(series);
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->at(0, 0, 0), 0.0f);
    EXPECT_EQ(image->at(5, 4, 3), 929.0f);
}

TEST_F(Dicom, SurvivesCodecsThatDoNot) {
    // Given compressed pixels of every sort that are rubbish: nothing of it may end this program
    for (const char* encoding : {"5", "4.50", "4.51", "4.57", "4.70", "4.80", "4.81", "4.90", "4.91"})
        for (const std::size_t length : {0u, 3u, 64u, 3000u}) {
            SCOPED_TRACE(encoding);
            Series series = Series::straight();
            std::string rubbish(length, '\0');
            for (std::size_t i = 0; i < length; ++i) rubbish[i] = static_cast<char>(i * i * 31 + 7);
            for (DicomWriter& file : series.files) file.fragment(std::string("1.2.840.10008.1.2.") + encoding, rubbish);
            write(series);
            diagnostics.clear();
            if (!read()) {
                EXPECT_FALSE(diagnostics.empty());
            }
        }
}

TEST_F(Dicom, RefusesWhatItCannotDecode) {
    Series series = Series::straight();
    for (DicomWriter& file : series.files) file.syntax = "1.2.840.10008.1.2.4.57";  // JPEG lossless, but it is not
    write(series);
    expect_refused("E0667", "not encoded as its header says");
    diagnostics.clear();
    for (DicomWriter& file : series.files) file.syntax = "1.2.840.10008.1.2.1.99";  // deflated
    write(series);
    expect_refused("E0667", "cannot be read");
    diagnostics.clear();
    for (DicomWriter& file : series.files) file.fragment("1.2.840.10008.1.2.4.70", "rubbish");
    write(series);
    expect_refused("E0674", "damaged");
}

TEST_F(Dicom, RefusesADamagedFileAndTakesNoMemoryForIt) {
    // Given a private element that promises 3 GB
    Series series = Series::straight();
    write(series);
    std::string bytes = series.files[1].bytes();
    const std::size_t at = bytes.find(std::string("\x28\x00\x02\x00US", 6));
    ASSERT_NE(at, std::string::npos);
    const std::string huge("\x27\x00\x10\x00OB\x00\x00\x00\x00\x00\xc0", 12);
    bytes.insert(at, huge);
    std::ofstream(folder / "IM1", std::ios::binary) << bytes;
    expect_refused("E0668", "promises 3221225472 bytes");
}

TEST_F(Dicom, SurvivesEveryTruncation) {
    Series series = Series::straight();
    write(series);
    const std::string bytes = series.files[1].bytes();
    for (std::size_t length = 0; length < bytes.size(); length += 7) {
        std::ofstream(folder / "IM1", std::ios::binary) << bytes.substr(0, length);
        diagnostics.clear();
        // A file cut before its voxels is no slice, and its gap is told; no length is accepted in silence.
        EXPECT_FALSE(read()) << length;
        EXPECT_FALSE(diagnostics.empty()) << length;
    }
}

TEST_F(Dicom, SurvivesDamagedHeaders) {
    Series series = Series::straight();
    write(series);
    const std::string whole = series.files[1].bytes();
    std::uint64_t state = 7;
    for (int trial = 0; trial < 300; ++trial) {
        std::string bytes = whole;
        for (int hit = 0; hit < 3; ++hit) {
            state = state * 6364136223846793005ull + 1442695040888963407ull;
            bytes[132 + (state >> 33) % (bytes.size() - 132)] = static_cast<char>(state >> 56);
        }
        std::ofstream(folder / "IM1", std::ios::binary) << bytes;
        diagnostics.clear();
        const auto image = read();
        if (image)
            EXPECT_EQ(image->values.size(), image->all().voxels());
        else
            EXPECT_FALSE(diagnostics.empty());
    }
}

TEST_F(Dicom, LooksIntoSubfoldersAndPassesOverWhatIsNoSlice) {
    std::filesystem::create_directories(folder / "a/b");
    const Series series = Series::straight();
    for (std::size_t n = 0; n < series.files.size(); ++n)
        series.files[n].write(folder / ((n % 2 ? "a/IM" : "a/b/IM") + std::to_string(n)));
    std::ofstream(folder / "README.txt") << "for the reader";
    DicomWriter report = series.files[0];
    report.without(tag::pixel_data).write(folder / "report");
    const auto image = read();
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->size[2], 4);
}

TEST_F(Dicom, RefusesAnEmptyFolderAndASingleSlice) {
    expect_refused("E0660", "the folder is empty");
    diagnostics.clear();
    std::ofstream(folder / "README.txt") << "for the reader";
    expect_refused("E0660", "none of the folder's 1 file");
    diagnostics.clear();

    Series one = Series::of({0});
    write(one);
    expect_refused("E0669", "at least 2");
    diagnostics.clear();
    EXPECT_FALSE(open_scan(folder / "IM0", {}, {}).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_NE(diagnostics[0].message.find("Name the folder"), std::string::npos);
}

TEST_F(Dicom, DoubtsLossyCompressionOtherModalitiesAndATiltThatIsNotThere) {
    Series series = Series::straight();
    for (DicomWriter& file : series.files)
        file.text(tag::modality, "CS", "MR").text(tag::lossy, "CS", "01").number(tag::gantry_tilt, {15});
    write(series);
    EXPECT_TRUE(read());
    ASSERT_EQ(diagnostics.size(), 3u) << to_text(diagnostics);
    for (const text::Diagnostic& d : diagnostics) EXPECT_EQ(d.code, "W0673");
}

TEST_F(Dicom, SaysNothingOfWhoseItIs) {
    Series series = Series::straight();
    for (DicomWriter& file : series.files)
        file.text(tag::patient_name, "PN", "Doe^Jane")
            .text(0x00100020, "LO", "PAT-4711")
            .text(0x0008103e, "LO", "DOE HEAD");
    write(series);
    const auto scan = open_scan(folder.path(), {}, {}).take(diagnostics);
    ASSERT_TRUE(scan);
    std::string all;
    for (const std::string& note : scan->notes()) all += note;
    for (const char* planted : {"Doe", "Jane", "4711", "DOE", "1.2.3", "IM"})
        EXPECT_EQ(all.find(planted), std::string::npos) << planted;
}

TEST_F(Dicom, ReadsFilesWithoutAPreamble) {
    for (const char* syntax : {"1.2.840.10008.1.2", "1.2.840.10008.1.2.1"})
        for (const bool keeps_first_group : {false, true}) {
            if (keeps_first_group && syntax == std::string("1.2.840.10008.1.2")) continue;
            SCOPED_TRACE(syntax);
            Series series = Series::straight();
            for (std::size_t n = 0; n < series.files.size(); ++n) {
                series.files[n].syntax = syntax;
                const std::string whole = series.files[n].bytes();
                const std::size_t dataset = whole.find(std::string("\x08\x00\x08\x00", 4));
                std::ofstream(folder / ("IM" + std::to_string(n)), std::ios::binary)
                    << whole.substr(keeps_first_group ? 132 : dataset);
            }
            diagnostics.clear();
            const auto image = read();
            ASSERT_TRUE(image) << to_text(diagnostics);
            EXPECT_EQ(image->at(2, 4, 3), 1356.0f);
        }
    // One of them cut short is damaged; a text is none.
    const std::string bytes = test::contents_of(folder / "IM1");
    std::ofstream(folder / "IM1", std::ios::binary) << bytes.substr(0, bytes.size() - 10);
    std::ofstream(folder / "text", std::ios::binary) << std::string("\x08\x00\x05\x00 is no tag", 14);
    diagnostics.clear();
    expect_refused("E0668", "1 file is damaged");
}

// ---- acquisitions

/// Slices of two passes in turn, each told from the other by one element.
Series in_turn(DicomWriter::Tag what, const char* sort, const char* first, const char* second) {
    Series series = Series::of({0, 2, 4, 6, 8, 10});
    for (std::size_t n = 0; n < series.files.size(); ++n) series.files[n].text(what, sort, n % 2 == 0 ? first : second);
    return series;
}

TEST_F(Dicom, RefusesTwoAcquisitionsInOneSeries) {
    write(in_turn(tag::acquisition, "IS", "1", "2"));
    expect_refused("E0676", "`1`: 3 slices, 30.00 … 38.00 mm along their normal; `2`: 3 slices");
    EXPECT_NE(diagnostics[0].message.find("`--acquisition 1`"), std::string::npos) << diagnostics[0].message;
    diagnostics.clear();
    expect_refused("E0677", "no acquisition `3`", {.name = "", .acquisition = "3"});
    diagnostics.clear();

    const auto image = read({.name = "", .acquisition = "2"});
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_EQ(image->size[2], 3);
    EXPECT_NEAR(image->spacing(2), 4.0_mm, 1e-9);
    EXPECT_NEAR(image->origin().z, 32.0_mm, 1e-9);
}

TEST_F(Dicom, TellsAcquisitionsApartByMoreThanTheirNumber) {
    // Place in time, echo, voltage, kernel, time of acquisition
    for (const auto& [what, sort] : {std::pair<DicomWriter::Tag, const char*>{0x00200100, "IS"},
                                     {0x00180086, "IS"},
                                     {0x00180060, "DS"},
                                     {0x00181210, "SH"},
                                     {0x00080032, "TM"}}) {
        diagnostics.clear();
        write(in_turn(what, sort, "80", "140"));
        expect_refused("E0676", "2 acquisitions");
        EXPECT_NE(diagnostics[0].message.find("`a`"), std::string::npos) << diagnostics[0].message;
        diagnostics.clear();
        EXPECT_TRUE(read({.name = "", .acquisition = "b"})) << to_text(diagnostics);
    }
}

TEST_F(Dicom, RefusesTwoAcquisitionsInOnePlace) {
    Series twice = Series::straight();
    for (DicomWriter file : Series::straight().files)
        twice.files.push_back(file.text(tag::acquisition, "IS", "5").text(tag::instance, "IS", "17"));
    write(twice);
    expect_refused("E0676", "`5`: 4 slices");
}

TEST_F(Dicom, JoinsAcquisitionsOneBehindTheOtherAndSaysSo) {
    // A scanner that stops for a new pass half way; then one that stops for every slice, as is usual
    for (const bool stops_each_time : {false, true}) {
        Series series = Series::of({0, 2, 4, 6});
        for (std::size_t n = 0; n < series.files.size(); ++n)
            series.files[n]
                .text(tag::acquisition, "IS", std::to_string(stops_each_time ? n + 1 : n / 2 + 1))
                .text(0x00080032, "TM", "10070" + std::to_string(n));
        write(series);
        diagnostics.clear();
        const auto scan = open_scan(folder.path(), {}, {}).take(diagnostics);
        ASSERT_TRUE(scan) << to_text(diagnostics);
        EXPECT_EQ(scan->grid().size[2], 4);
        EXPECT_EQ(diagnostics.size(), stops_each_time ? 0u : 1u) << to_text(diagnostics);
        std::string all;
        for (const std::string& note : scan->notes()) all += note;
        EXPECT_NE(all.find("acquisitions of different parts of the patient"), std::string::npos) << all;
        EXPECT_EQ(all.find("1007"), std::string::npos) << all;
    }
}

TEST_F(Dicom, CutsALongListOfSeries) {
    Series each = Series::of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    for (std::size_t n = 0; n < each.files.size(); ++n)
        each.files[n].uid(tag::series, "1.2." + std::to_string(100 + n));
    write(each);
    expect_refused("E0661", "12 series of one slice each");
    EXPECT_NE(diagnostics[0].message.find("and 6 more series"), std::string::npos) << diagnostics[0].message;
    EXPECT_EQ(diagnostics[0].message.find("--series"), std::string::npos) << "no choice helps";
    diagnostics.clear();

    // Where one is a volume, it is offered first
    for (std::size_t n = 9; n < 12; ++n) each.files[n].uid(tag::series, "1.2.900");
    write(each);
    expect_refused("E0661", "and 4 more series");
    const std::string& message = diagnostics[0].message;
    const std::size_t at = message.find("--series ") + 9;
    const std::string name = message.substr(at, message.find('`', at) - at);
    diagnostics.clear();
    EXPECT_TRUE(read({.name = name})) << name << to_text(diagnostics);
}

TEST_F(Dicom, SaysWhyNoFileIsASlice) {
    std::ofstream(folder / "README.txt") << "for the reader";
    DicomWriter report = Series::straight().files[0];
    report.without(tag::pixel_data).write(folder / "report");
    expect_refused("E0660", "1 is not DICOM, 1 has no image");
}

// ---- real ones
// --------------------------------------------------------------------------------------------------------

std::string data(const std::string& name) {
    const char* root = std::getenv("KERF_DATA");
    return root == nullptr ? "" : (std::filesystem::path(root) / name).string();
}
bool is_there(const std::string& name) { return !data(name).empty() && std::filesystem::exists(data(name)); }

TEST_F(Dicom, RealSpineIsTheSameAsItsVolume) {
    if (!is_there("dicom/spine_t11_t12_lidc0314")) GTEST_SKIP() << "no KERF_DATA";
    const auto series = open_scan(data("dicom/spine_t11_t12_lidc0314"), {}, {}).take(diagnostics);
    const auto volume = open_scan(data("volumes/spine_t9_t12_lidc0314.nrrd"), {}, {}).take(diagnostics);
    ASSERT_TRUE(series && volume) << to_text(diagnostics);
    const Box box{{-30.0_mm, 200.0_mm, -690.0_mm}, {10.0_mm, 245.0_mm, -650.0_mm}};
    const auto a = series->read(series->grid().range(box), 0, {}).take(diagnostics);
    const auto b = volume->read(volume->grid().range(box), 0, {}).take(diagnostics);
    ASSERT_TRUE(a && b) << to_text(diagnostics);
    double worst = 0.0;
    int compared = 0;
    for (double x = box.low.x; x < box.high.x; x += 1.3_mm)
        for (double y = box.low.y; y < box.high.y; y += 1.3_mm)
            for (double z = box.low.z; z < box.high.z; z += 1.3_mm) {
                const double in_a = a->sample_trilinear({x, y, z}, -1e9), in_b = b->sample_trilinear({x, y, z}, -1e9);
                if (in_a < -1e8 || in_b < -1e8) continue;
                worst = std::max(worst, std::abs(in_a - in_b));
                ++compared;
            }
    EXPECT_GT(compared, 10'000);
    EXPECT_LT(worst, 0.05 /* HU; positions in decimal text */);
}

TEST_F(Dicom, RealUnevenSeriesKeepsItsSlicesWhereTheyWere) {
    if (!is_there("dicom/uneven_vertex_harvard02")) GTEST_SKIP() << "no KERF_DATA";
    EXPECT_FALSE(open_scan(data("dicom/uneven_vertex_harvard02"), {}, {}).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0665");
    EXPECT_NE(diagnostics[0].message.find("got 2 gaps, 1.00 mm behind z -6.00 mm, 1.50 mm behind z -5.00 mm"),
              std::string::npos)
        << diagnostics[0].message;
    diagnostics.clear();

    const auto scan =
        open_scan(data("dicom/uneven_vertex_harvard02"), {.name = "", .may_resample = true}, {}).take(diagnostics);
    ASSERT_TRUE(scan) << to_text(diagnostics);
    EXPECT_NEAR(scan->grid().spacing(2), 0.5_mm, 1e-9);
    EXPECT_EQ(scan->grid().size[2], 23);  // 20 slices, and three where there were none
    EXPECT_NEAR(scan->grid().box().high.z - scan->grid().box().low.z, 11.0_mm, 1e-6);
}

TEST_F(Dicom, RealTiltedSeriesAgreesWithItsGroundTruth) {
    if (!is_there("dicom/tilted_jaw_vhp_male_derived")) GTEST_SKIP() << "no KERF_DATA";
    const auto tilted = open_scan(data("dicom/tilted_jaw_vhp_male_derived"), {}, {}).take(diagnostics);
    ASSERT_TRUE(tilted) << to_text(diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_NE(diagnostics[0].message.find("18.0 deg"), std::string::npos) << diagnostics[0].message;
    const auto truth = open_scan(data("volumes/jaw_teeth_vhp_male.nii.gz"), {}, {}).take(diagnostics);
    ASSERT_TRUE(truth) << to_text(diagnostics);
    const auto a = tilted->read(tilted->grid().all(), 0, {}).take(diagnostics);
    const auto b = truth->read(truth->grid().all(), 0, {}).take(diagnostics);
    ASSERT_TRUE(a && b) << to_text(diagnostics);

    // Where both were measured. Shifted by half a millimetre each way they must agree less.
    struct Agreement {
        double mean = 0.0, mean_size = 0.0, correlation = 0.0;  // [HU], [HU], [–]
    };
    const auto agreement = [&](Vec3 shift) {
        double n = 0.0, sum = 0.0, size = 0.0, x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0, xy = 0.0;
        const Box box = b->box();
        for (double x = box.low.x + 10.0_mm; x < box.high.x - 10.0_mm; x += 2.3_mm)
            for (double y = box.low.y + 10.0_mm; y < box.high.y - 10.0_mm; y += 2.3_mm)
                for (double z = box.low.z + 10.0_mm; z < box.high.z - 10.0_mm; z += 2.3_mm) {
                    const double is = a->sample_trilinear(Vec3{x, y, z} + shift, -1e9);
                    const double ought = b->sample_trilinear({x, y, z}, -1e9);
                    if (is < -1e8 || ought < -1e8) continue;
                    n += 1.0;
                    sum += is - ought;
                    size += std::abs(is - ought);
                    x1 += is, x2 += is * is, y1 += ought, y2 += ought * ought, xy += is * ought;
                }
        return Agreement{sum / n, size / n, (xy - x1 * y1 / n) / std::sqrt((x2 - x1 * x1 / n) * (y2 - y1 * y1 / n))};
    };
    const Agreement found = agreement({});
    std::printf(
        "tilted series against its ground truth: mean difference %.1f HU, mean size %.1f HU, correlation %.4f\n",
        found.mean, found.mean_size, found.correlation);
    EXPECT_LT(std::abs(found.mean), 5.0 /* HU */);
    EXPECT_GT(found.correlation, 0.99 /* slices of 3 mm against voxels of 1 mm */);
    const double here = found.mean_size;
    const auto difference = [&](Vec3 shift) { return agreement(shift).mean_size; };
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const double minus = difference(-0.5_mm * axis), plus = difference(0.5_mm * axis);
        // The least difference on a parabola through three shifts: where the two agree best.
        const double best = 0.5_mm * 0.5 * (minus - plus) / (minus - 2.0 * here + plus);
        std::printf("agrees best when moved by %.3f mm along (%g, %g, %g)\n", best * 1e3, axis.x, axis.y, axis.z);
        EXPECT_LT(std::abs(best), 0.1_mm);
    }
}

}  // namespace
}  // namespace kerf::bone
