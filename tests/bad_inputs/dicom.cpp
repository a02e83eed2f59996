// SPDX-License-Identifier: Apache-2.0
// Folders with DICOM files.
#include <zlib.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bad_inputs/input.h"
#include "tests/support/dicom_writer.h"

namespace kerf::test {
namespace {

using Make = std::function<void(const std::string&)>;
using Change = std::function<void(DicomWriter&)>;

/// Which way rows, columns and slices go: axis of the patient 0 … 2 (LPS), and which end comes first.
struct Orientation {
    struct Way {
        std::size_t axis;
        int sign;
    };
    Way along_row{0, 1}, down_column{1, 1}, slices{2, 1};
};

constexpr int counts[]{24, 20, 16};
constexpr double steps[]{1.0, 1.5, 2.0}, firsts[]{-11.0, -14.0, -15.0};  // [mm] along x, y, z

double place_of(const Orientation::Way& way, int index) {
    const int n = way.sign > 0 ? index : counts[way.axis] - 1 - index;
    return firsts[way.axis] + steps[way.axis] * n;
}

/// One slice, by its rows and columns; `off` [mm] moves its place along the slices' way, `slide` along y.
DicomWriter slice_of(const Orientation& of, int n, double off = 0.0, double slide = 0.0) {
    const int columns = counts[of.along_row.axis], rows = counts[of.down_column.axis];
    std::vector<int> values;
    std::vector<double> origin;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            std::vector<double> at(3);
            at[of.along_row.axis] = place_of(of.along_row, c);
            at[of.down_column.axis] = place_of(of.down_column, r);
            at[of.slices.axis] = place_of(of.slices, n) + off;
            at[1] += slide;
            if (values.empty()) origin = at;
            values.push_back(static_cast<int>(std::lround(Bone::value(at[0], at[1], at[2]))));
        }
    std::vector<double> axes(6, 0.0);
    axes[of.along_row.axis] = of.along_row.sign;
    axes[3 + of.down_column.axis] = of.down_column.sign;
    return ct_slice(columns, rows, 1.0, origin, n + 1, values)
        .number(tag::orientation, axes)
        .number(tag::pixel_spacing, {steps[of.down_column.axis], steps[of.along_row.axis]})
        .number(tag::intercept, {-2048})
        .voxels([&] {
            std::vector<std::int16_t> stored;
            for (const int value : values) stored.push_back(static_cast<std::int16_t>(value + 2048));
            return stored;
        }());
}

/// Slices that are turned by 0.2 rad about z and then about x, 1 mm apart, around the bone.
std::vector<DicomWriter> oblique_slices() {
    constexpr int edge = 48;
    const double c = std::cos(0.2), s = std::sin(0.2);
    const double axes[3][3]{
        {c, s, 0}, {-s * c, c * c, s}, {s * s, -c * s, c}};  // along a row, down a column, to the next slice
    std::vector<DicomWriter> files;
    for (int n = 0; n < edge; ++n) {
        std::vector<int> values;
        std::vector<double> origin;
        for (int r = 0; r < edge; ++r)
            for (int col = 0; col < edge; ++col) {
                std::vector<double> at(3);
                for (std::size_t i = 0; i < 3; ++i)
                    at[i] = axes[0][i] * (col - 23.5) + axes[1][i] * (r - 23.5) + axes[2][i] * (n - 23.5);
                if (values.empty()) origin = at;
                values.push_back(static_cast<int>(std::lround(Bone::value(at[0], at[1], at[2]))) - 1024);
            }
        files.push_back(
            ct_slice(edge, edge, 1.0, origin, n + 1, values)
                .number(tag::orientation, {axes[0][0], axes[0][1], axes[0][2], axes[1][0], axes[1][1], axes[1][2]})
                .number(tag::intercept, {0})
                .word(tag::representation, 1));
    }
    return files;
}

struct Series {
    std::vector<DicomWriter> files;

    explicit Series(const Orientation& of = {}) {
        for (int n = 0; n < counts[of.slices.axis]; ++n) files.push_back(slice_of(of, n));
    }
    Series& each(const Change& change) {
        for (DicomWriter& file : files) change(file);
        return *this;
    }
    void write_to(const std::string& folder, const std::string& ending = ".dcm") const {
        for (std::size_t n = 0; n < files.size(); ++n)
            write_file_of(folder + "/scan/IM" + std::to_string(n) + ending, files[n].bytes());
    }
};

Make series(const std::function<void(Series&)>& change, const Orientation& of = {}) {
    return [=](const std::string& folder) {
        Series all(of);
        change(all);
        all.write_to(folder);
    };
}
Make each(const Change& change) {
    return series([=](Series& all) { all.each(change); });
}
Make one(const Change& change) {
    return series([=](Series& all) { change(all.files[5]); });
}

std::vector<std::int16_t> stored_of(const DicomWriter& file) {
    const std::string bytes = file.value(tag::pixel_data);
    std::vector<std::int16_t> values(bytes.size() / 2);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}
/// Pixels made anew, each from the HU it stands for.
void restore(DicomWriter& file, const std::function<int(int)>& stored_from_value) {
    std::vector<std::int16_t> values = stored_of(file);
    for (std::int16_t& v : values) v = static_cast<std::int16_t>(stored_from_value(v - 2048));
    file.voxels(values);
}

/// DICOM's run lengths in two segments, high bytes first; equal bytes as runs.
std::string run_lengths(const std::vector<std::int16_t>& values) {
    std::string coded(64, '\0');
    const auto word = [&](std::size_t at, std::uint32_t value) {
        std::memcpy(coded.data() + at, &value, sizeof value);
    };
    word(0, 2);
    for (const int byte : {1, 0}) {
        word(byte == 1 ? 4 : 8, static_cast<std::uint32_t>(coded.size()));
        const auto at = [&](std::size_t n) {
            return static_cast<char>(static_cast<std::uint16_t>(values[n]) >> (8 * byte));
        };
        for (std::size_t n = 0; n < values.size();) {
            std::size_t run = 1;
            while (n + run < values.size() && run < 128 && at(n + run) == at(n)) ++run;
            coded.push_back(run > 1 ? static_cast<char>(static_cast<unsigned char>(257 - run)) : '\0');
            coded.push_back(at(n));
            n += run;
        }
        if (coded.size() % 2 != 0) coded.push_back('\0');
    }
    return coded;
}

void replace_bytes(const std::string& folder, int n, const std::function<std::string(std::string)>& change) {
    const Series all;
    write_file_of(folder + "/scan/IM" + std::to_string(n) + ".dcm",
                  change(all.files[static_cast<std::size_t>(n)].bytes()));
}
Make damaged(const std::function<std::string(std::string)>& change) {
    return [=](const std::string& folder) {
        Series().write_to(folder);
        replace_bytes(folder, 5, change);
    };
}

/// The data set behind group 2, packed as transfer syntax 1.2.840.10008.1.2.1.99 wants it.
std::string deflated_file(DicomWriter file) {
    file.syntax = "1.2.840.10008.1.2.1.99";
    const std::string all = file.bytes();
    std::uint32_t length = 0;
    std::memcpy(&length, all.data() + 140, sizeof length);
    const std::size_t from = 144 + length;
    std::string in = all.substr(from), out(in.size() + 1000, '\0');
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("deflate");
    stream.next_in = reinterpret_cast<unsigned char*>(in.data());
    stream.avail_in = static_cast<unsigned>(in.size());
    stream.next_out = reinterpret_cast<unsigned char*>(out.data());
    stream.avail_out = static_cast<unsigned>(out.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("deflate");
    out.resize(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return all.substr(0, from) + out;
}

/// A sequence within a sequence, `depth` times, all of undefined length.
std::string nested(int depth) {
    const std::string item("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8), item_end("\xfe\xff\x0d\xe0\0\0\0\0", 8),
        end("\xfe\xff\xdd\xe0\0\0\0\0", 8);
    const std::string inner("\x08\x00\x40\x11SQ\0\0\xff\xff\xff\xff", 12);
    return item + (depth > 1 ? inner + nested(depth - 1) : std::string("\x08\x00\x50\x11UI\x04\0001.2\0", 12)) +
           item_end + end;
}

void add_localizer(Series& all, const std::string& uid, const std::string& number) {
    DicomWriter overview = slice_of({{1, 1}, {2, -1}, {0, 1}}, 3);
    all.files.push_back(overview.uid(tag::series, uid)
                            .text(tag::series_number, "IS", number)
                            .text(tag::image_type, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER")
                            .text(tag::instance, "IS", "99"));
}
void add_series_7(Series& all) {
    for (DicomWriter file : Series().files) {
        if (all.files.size() == 22) break;
        all.files.push_back(file.uid(tag::series, "1.2.3.9").text(tag::series_number, "IS", "7"));
    }
}

constexpr const char* big_endian_syntax = "1.2.840.10008.1.2.2";

}  // namespace

std::vector<Input> dicom_inputs() {
    const auto nothing = [](Series&) {};
    return {
        {"DICOM, axial", Way::scan, "scan", series(nothing), "loaded", ""},
        {"DICOM, slices from the head down", Way::scan, "scan", series(nothing, {{0, 1}, {1, 1}, {2, -1}}), "loaded",
         ""},
        {"DICOM, rows from left to right", Way::scan, "scan", series(nothing, {{0, -1}, {1, 1}, {2, 1}}), "loaded", ""},
        {"DICOM, prone", Way::scan, "scan", series(nothing, {{0, -1}, {1, -1}, {2, 1}}), "loaded", ""},
        {"DICOM, sagittal", Way::scan, "scan", series(nothing, {{1, 1}, {2, -1}, {0, 1}}), "loaded", ""},
        {"DICOM, sagittal, the other way", Way::scan, "scan", series(nothing, {{1, -1}, {2, -1}, {0, -1}}), "loaded",
         ""},
        {"DICOM, coronal", Way::scan, "scan", series(nothing, {{0, 1}, {2, -1}, {1, 1}}), "loaded", ""},
        {"DICOM, coronal, the other way", Way::scan, "scan", series(nothing, {{0, -1}, {2, 1}, {1, -1}}), "loaded", ""},
        {"DICOM, oblique slices", Way::scan, "scan", series([](Series& all) { all.files = oblique_slices(); }),
         "loaded", ""},
        {"DICOM, instances backwards and all the same", Way::scan, "scan",
         each([](DicomWriter& f) { f.text(tag::instance, "IS", "1"); }), "loaded", ""},
        {"DICOM, no instance numbers", Way::scan, "scan", each([](DicomWriter& f) { f.without(tag::instance); }),
         "loaded", ""},
        {"DICOM, a missing slice", Way::scan, "scan",
         series([](Series& all) { all.files.erase(all.files.begin() + 7); }), "E0665", "4.00 mm behind z -3.00 mm"},
        {"DICOM, a missing slice, filled as told", Way::scan, "scan",
         series([](Series& all) { all.files.erase(all.files.begin() + 6); }), "loaded W0672", "with 1 gap",
         "resample: true"},
        {"DICOM, the first and last slices missing", Way::scan, "scan", series([](Series& all) {
             all.files.erase(all.files.begin());
             all.files.pop_back();
         }),
         "loaded", ""},
        {"DICOM, every second slice missing behind the middle", Way::scan, "scan", series([](Series& all) {
             for (int n : {14, 12, 10}) all.files.erase(all.files.begin() + n);
         }),
         "E0665", "got 3 gaps"},
        {"DICOM, a slice twice", Way::scan, "scan", series([](Series& all) {
             all.files.push_back(all.files[3]);
             all.files.back().text(tag::instance, "IS", "40");
         }),
         "E0664", "(instances 4 and 40)"},
        {"DICOM, all slices twice, as of two phases", Way::scan, "scan", series([](Series& all) {
             const auto files = all.files;
             all.files.insert(all.files.end(), files.begin(), files.end());
         }),
         "E0664", "16 slices lie"},
        {"DICOM, uneven slices", Way::scan, "scan", series([](Series& all) {
             all.files[2] = slice_of({}, 2, 0.25);
             all.files[13] = slice_of({}, 13, -0.2);
         }),
         "loaded W0672", "resampled every"},
        {"DICOM, a tilted gantry", Way::scan, "scan", series([](Series& all) {
             for (int n = 0; n < counts[2]; ++n)
                 all.files[static_cast<std::size_t>(n)] = slice_of({}, n, 0.0, 0.2 * (n - 8) * 2.0);
         }),
         "loaded W0671", "11.3 deg"},
        {"DICOM, a tilt in the header alone", Way::scan, "scan",
         each([](DicomWriter& f) { f.number(tag::gantry_tilt, {12}); }), "loaded W0673", "The positions were used"},
        {"DICOM, one slice beside the others", Way::scan, "scan", one([](DicomWriter& f) {
             f.number(tag::position, {-2, -14, -5});
         }),
         "E0666", "voxels"},
        {"DICOM, all slices in one place", Way::scan, "scan", each([](DicomWriter& f) {
             f.number(tag::position, {-11, -14, 0});
         }),
         "E0664", "15 slices lie"},
        {"DICOM, two series, none chosen", Way::scan, "scan", series(add_series_7), "E0661", "`7`: 6 slices"},
        {"DICOM, two series, one chosen", Way::scan, "scan", series(add_series_7), "loaded", "", "series: 4"},
        {"DICOM, two series, another chosen", Way::scan, "scan", series(add_series_7), "E0662", "no series `5`",
         "series: 5"},
        {"DICOM, two series of one number", Way::scan, "scan", series([](Series& all) {
             for (DicomWriter f : Series().files) all.files.push_back(f.uid(tag::series, "1.2.3.9"));
         }),
         "E0661", "`4b`"},
        {"DICOM, a localizer in a series of its own", Way::scan, "scan",
         series([](Series& all) { add_localizer(all, "1.2.3.8", "1"); }), "E0661", "an overview"},
        {"DICOM, a localizer in its own series, the volume chosen", Way::scan, "scan",
         series([](Series& all) { add_localizer(all, "1.2.3.8", "1"); }), "loaded", "", "series: 4"},
        {"DICOM, a localizer in the same series", Way::scan, "scan",
         series([](Series& all) { add_localizer(all, "1.2.3.4", "4"); }), "E0663", "differ"},
        {"DICOM, one slice of another size", Way::scan, "scan",
         one([](DicomWriter& f) { f.word(tag::rows, 24).word(tag::columns, 20); }), "E0663", "number of pixels"},
        {"DICOM, one slice of another spacing", Way::scan, "scan", one([](DicomWriter& f) {
             f.number(tag::pixel_spacing, {1.5, 1.01});
         }),
         "E0663", "pixel spacing"},
        {"DICOM, one slice in another frame of reference", Way::scan, "scan",
         one([](DicomWriter& f) { f.uid(tag::frame_of_reference, "1.9"); }), "E0663", "frame of reference"},
        {"DICOM, a frame of reference each", Way::scan, "scan", series([](Series& all) {
             for (std::size_t n = 0; n < all.files.size(); ++n)
                 all.files[n].uid(tag::frame_of_reference, "1.9." + std::to_string(n));
         }),
         "loaded W0673", "its own frame of reference"},
        {"DICOM, one slice of another modality", Way::scan, "scan",
         one([](DicomWriter& f) { f.text(tag::modality, "CS", "MR"); }), "E0663", "modality"},
        {"DICOM, MR", Way::scan, "scan", each([](DicomWriter& f) { f.text(tag::modality, "CS", "MR"); }),
         "loaded W0673", "not a CT"},
        {"DICOM, compressed with loss once", Way::scan, "scan",
         each([](DicomWriter& f) { f.text(tag::lossy, "CS", "01"); }), "loaded W0673", "with loss"},
        {"DICOM, implicit", Way::scan, "scan", each([](DicomWriter& f) { f.syntax = "1.2.840.10008.1.2"; }), "loaded",
         ""},
        {"DICOM, big endian", Way::scan, "scan", each([](DicomWriter& f) { f.syntax = big_endian_syntax; }), "loaded",
         ""},
        {"DICOM, a slice of each of three encodings", Way::scan, "scan", series([](Series& all) {
             all.files[1].syntax = "1.2.840.10008.1.2";
             all.files[2].syntax = big_endian_syntax;
         }),
         "loaded", ""},
        {"DICOM, run lengths", Way::scan, "scan",
         each([](DicomWriter& f) { f.fragment("1.2.840.10008.1.2.5", run_lengths(stored_of(f))); }), "loaded", ""},
        {"DICOM, run lengths cut short", Way::scan, "scan", each([](DicomWriter& f) {
             const std::string all = run_lengths(stored_of(f));
             f.fragment("1.2.840.10008.1.2.5", all.substr(0, all.size() / 2));
         }),
         "E0674", "damaged"},
        {"DICOM, JPEG that is rubbish", Way::scan, "scan",
         each([](DicomWriter& f) { f.fragment("1.2.840.10008.1.2.4.70", std::string(3000, '\x5a')); }), "E0674",
         "damaged"},
        {"DICOM, JPEG-LS that is rubbish", Way::scan, "scan",
         each([](DicomWriter& f) { f.fragment("1.2.840.10008.1.2.4.80", std::string(3000, '\x5a')); }), "E0674",
         "damaged"},
        {"DICOM, JPEG 2000 that is rubbish", Way::scan, "scan", each([](DicomWriter& f) {
             f.fragment("1.2.840.10008.1.2.4.90", std::string("\xff\x4f\xff\x51", 4) + std::string(3000, '\x7f'));
         }),
         "E0674", "damaged"},
        {"DICOM, JPEG without a fragment", Way::scan, "scan",
         each([](DicomWriter& f) { f.fragment("1.2.840.10008.1.2.4.70", ""); }), "E0674", "damaged"},
        {"DICOM, a video", Way::scan, "scan",
         each([](DicomWriter& f) { f.fragment("1.2.840.10008.1.2.4.102", "video"); }), "E0667", "cannot be read"},
        {"DICOM, plain pixels that are called JPEG", Way::scan, "scan",
         each([](DicomWriter& f) { f.syntax = "1.2.840.10008.1.2.4.57"; }), "E0667", "not encoded as its header says"},
        {"DICOM, deflated", Way::scan, "scan",
         [](const std::string& folder) {
             const Series all;
             for (std::size_t n = 0; n < all.files.size(); ++n)
                 write_file_of(folder + "/scan/IM" + std::to_string(n), deflated_file(all.files[n]));
         },
         "E0667", "cannot be read"},
        {"DICOM, several frames in a file", Way::scan, "scan",
         each([](DicomWriter& f) { f.text(tag::frames, "IS", "12"); }), "E0667", "several frames"},
        {"DICOM, enhanced CT", Way::scan, "scan", series([](Series& all) {
             all.files.resize(1);
             all.files[0]
                 .uid(tag::sop_class, "1.2.840.10008.5.1.4.1.1.2.1")
                 .text(tag::frames, "IS", "16")
                 .without(tag::position)
                 .without(tag::orientation)
                 .without(tag::pixel_spacing);
         }),
         "E0667", "several frames"},
        {"DICOM, colour", Way::scan, "scan",
         each([](DicomWriter& f) { f.word(tag::samples, 3).text(tag::photometric, "CS", "RGB"); }), "E0667",
         "3 numbers per pixel"},
        {"DICOM, white is low", Way::scan, "scan",
         each([](DicomWriter& f) { f.text(tag::photometric, "CS", "MONOCHROME1"); }), "E0667", "not MONOCHROME2"},
        {"DICOM, 12 bits", Way::scan, "scan",
         each([](DicomWriter& f) { f.word(tag::bits_stored, 12).word(tag::high_bit, 11); }), "loaded", ""},
        {"DICOM, 12 bits with an overlay above", Way::scan, "scan", each([](DicomWriter& f) {
             f.word(tag::bits_stored, 12).word(tag::high_bit, 11);
             restore(f, [](int v) { return 0xa000 | (v + 2048); });
         }),
         "loaded", ""},
        {"DICOM, 12 bits at the upper end", Way::scan, "scan", each([](DicomWriter& f) {
             f.word(tag::bits_stored, 12).word(tag::high_bit, 15);
             restore(f, [](int v) { return (v + 2048) << 4; });
         }),
         "loaded", ""},
        {"DICOM, signed", Way::scan, "scan", each([](DicomWriter& f) {
             f.word(tag::representation, 1).number(tag::intercept, {0});
             restore(f, [](int v) { return v; });
         }),
         "loaded", ""},
        {"DICOM, signed, 12 bits", Way::scan, "scan", each([](DicomWriter& f) {
             f.word(tag::representation, 1)
                 .word(tag::bits_stored, 12)
                 .word(tag::high_bit, 11)
                 .number(tag::intercept, {0});
             restore(f, [](int v) { return v & 0x0fff; });
         }),
         "loaded", ""},
        {"DICOM, bits that do not fit together", Way::scan, "scan",
         each([](DicomWriter& f) { f.word(tag::bits_stored, 12).word(tag::high_bit, 3); }), "E0667", "bits per pixel"},
        {"DICOM, padding around the picture", Way::scan, "scan", each([](DicomWriter& f) {
             f.word(tag::representation, 1).number(tag::intercept, {0}).word(tag::padding, -2000, "SS");
             restore(f, [](int v) { return v; });
             std::vector<std::int16_t> values = stored_of(f);
             for (std::size_t n = 0; n < 24; ++n) values[n] = -2000;
             f.voxels(values);
         }),
         "loaded", ""},
        {"DICOM, a slope of its own in every slice", Way::scan, "scan", series([](Series& all) {
             for (std::size_t n = 0; n < all.files.size(); ++n) {
                 const double slope = n % 2 == 0 ? 0.5 : 0.25;
                 all.files[n].number(tag::slope, {slope}).number(tag::intercept, {-2048.0 - static_cast<double>(n)});
                 restore(all.files[n],
                         [=](int v) { return static_cast<int>((v + 2048 + static_cast<int>(n)) / slope); });
             }
         }),
         "loaded", ""},
        {"DICOM, a slope of 0", Way::scan, "scan", one([](DicomWriter& f) { f.number(tag::slope, {0}); }), "E0667",
         "slope"},
        {"DICOM, no slope and intercept", Way::scan, "scan", each([](DicomWriter& f) {
             f.without(tag::slope).without(tag::intercept).word(tag::representation, 1);
             restore(f, [](int v) { return v; });
         }),
         "loaded", ""},
        {"DICOM, a slope with a comma", Way::scan, "scan",
         each([](DicomWriter& f) { f.text(tag::slope, "DS", "0,5"); }), "E0667", "slope"},
        {"DICOM, no position", Way::scan, "scan", one([](DicomWriter& f) { f.without(tag::position); }), "E0667",
         "no position"},
        {"DICOM, a position with commas", Way::scan, "scan",
         one([](DicomWriter& f) { f.text(tag::position, "DS", "-11,0\\-14,0\\-5,0"); }), "E0667", "no position"},
        {"DICOM, a position that is no number", Way::scan, "scan",
         one([](DicomWriter& f) { f.text(tag::position, "DS", "nan\\-14\\-5"); }), "E0667", "no position"},
        {"DICOM, no orientation", Way::scan, "scan", each([](DicomWriter& f) { f.without(tag::orientation); }), "E0667",
         "no orientation"},
        {"DICOM, an orientation of one direction", Way::scan, "scan", each([](DicomWriter& f) {
             f.number(tag::orientation, {1, 0, 0, 1, 0, 0});
         }),
         "E0667", "right angles"},
        {"DICOM, no pixel spacing", Way::scan, "scan", each([](DicomWriter& f) { f.without(tag::pixel_spacing); }),
         "E0667", "no pixel spacing"},
        {"DICOM, a pixel spacing of 0", Way::scan, "scan", each([](DicomWriter& f) {
             f.number(tag::pixel_spacing, {0, 0});
         }),
         "E0667", "0.001 mm"},
        {"DICOM, numbers with plus signs, exponents and blanks", Way::scan, "scan", series([](Series& all) {
             for (int n = 0; n < counts[2]; ++n) {
                 const int z = 2 * n - 15;
                 all.files[static_cast<std::size_t>(n)]
                     .text(tag::position, "DS",
                           " -11.0 \\-1.4e+1\\ " + std::string(z > 0 ? "+" : "") + std::to_string(z) + ".000 ")
                     .text(tag::pixel_spacing, "DS", "+1.50 \\ 1E0");
             }
         }),
         "loaded", ""},
        {"DICOM, rows that the pixels do not fill", Way::scan, "scan",
         one([](DicomWriter& f) { f.word(tag::rows, 4000); }), "E0667", "bytes of pixels"},
        {"DICOM, 65535 × 65535 pixels", Way::scan, "scan",
         each([](DicomWriter& f) { f.word(tag::rows, 65535).word(tag::columns, 65535); }), "E0667", "2 … 4096"},
        {"DICOM, no pixels in one", Way::scan, "scan", one([](DicomWriter& f) { f.without(tag::pixel_data); }), "E0665",
         "slices are missing"},
        {"DICOM, cut short in the pixels", Way::scan, "scan",
         damaged([](std::string all) { return all.substr(0, all.size() - 100); }), "E0668", "bytes"},
        {"DICOM, cut short in the header", Way::scan, "scan",
         damaged([](std::string all) { return all.substr(0, 330); }), "E0668", "damaged"},
        {"DICOM, an empty file in between", Way::scan, "scan",
         damaged([](const std::string&) { return std::string(); }), "E0665", "slices are missing"},
        {"DICOM, an element that promises 3 GB", Way::scan, "scan", damaged([](std::string all) {
             return all.insert(all.find(std::string("\x28\x00\x02\x00US", 6)),
                               std::string("\x27\x00\x10\x00OB\x00\x00\x00\x00\x00\xc0", 12));
         }),
         "E0668", "promises 3221225472 bytes"},
        {"DICOM, elements out of order", Way::scan, "scan", damaged([](std::string all) {
             return all.insert(all.find(std::string("\x28\x00\x02\x00US", 6)), std::string("\x08\x00\x10\x00SH\x02\x00"
                                                                                           "ab",
                                                                                           10));
         }),
         "E0668", "out of order"},
        {"DICOM, no word DICM", Way::scan, "scan", damaged([](std::string all) { return all.replace(128, 4, "ABCD"); }),
         "E0665", "slices are missing"},
        {"DICOM, no transfer syntax", Way::scan, "scan", damaged([](std::string all) {
             return all.replace(all.find("1.2.840.10008.1.2.1"), 20, std::string(20, '\0'));
         }),
         "E0668", "how it is encoded"},
        {"DICOM, sequences in sequences", Way::scan, "scan",
         each([](DicomWriter& f) { f.raw(0x00081140, "SQ", nested(5), true); }), "loaded", ""},
        {"DICOM, sequences nested 10000 deep", Way::scan, "scan",
         each([](DicomWriter& f) { f.raw(0x00081140, "SQ", nested(10'000), true); }), "E0668", "nested more than"},
        {"DICOM, a sequence that does not end", Way::scan, "scan", each([](DicomWriter& f) {
             f.raw(0x00081140, "SQ", std::string("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8), true);
         }),
         "E0668", "damaged"},
        {"DICOM, a position within a sequence", Way::scan, "scan", each([](DicomWriter& f) {
             // An item with another position, as of a picture that it refers to: it is not this one's.
             const std::string place = "9\\9\\9 ", value = std::string("\x20\x00\x32\x00"
                                                                       "DS\x06\x00",
                                                                       8) +
                                                           place;
             const std::string item = std::string("\xfe\xff\x00\xe0\x0e\0\0\0", 8) + value;
             f.raw(0x00081140, "SQ", item);
         }),
         "loaded", ""},
        {"DICOM, private elements", Way::scan, "scan", each([](DicomWriter& f) {
             f.text(0x00090010, "LO", "SOMEBODY").raw(0x00091001, "UN", std::string(3000, '\xff'));
         }),
         "loaded", ""},
        {"DICOM, names without an ending", Way::scan, "scan",
         [](const std::string& folder) { Series().write_to(folder, ""); }, "loaded", ""},
        {"DICOM, names in letters of many sorts", Way::scan, "scan",
         [](const std::string& folder) {
             const Series all;
             for (std::size_t n = 0; n < all.files.size(); ++n)
                 write_file_of(folder + "/scan/Größe é " + std::to_string(n) + " 骨", all.files[n].bytes());
         },
         "loaded", ""},
        {"DICOM, in folders within folders", Way::scan, "scan",
         [](const std::string& folder) {
             const Series all;
             for (std::size_t n = 0; n < all.files.size(); ++n)
                 write_file_of(folder + "/scan/" + (n % 2 ? "a/" : "b/c/") + "IM" + std::to_string(n),
                               all.files[n].bytes());
         },
         "loaded", ""},
        {"DICOM, other files among them", Way::scan, "scan",
         [](const std::string& folder) {
             Series().write_to(folder);
             write_file_of(folder + "/scan/README.txt", "for the reader");
             write_file_of(folder + "/scan/.DS_Store", std::string(6000, '\0'));
             write_file_of(folder + "/scan/viewer.exe", "MZ" + std::string(100'000, '\x90'));
             DicomWriter report = slice_of({}, 0);
             write_file_of(folder + "/scan/DICOMDIR", report.without(tag::pixel_data).bytes());
         },
         "loaded", ""},
        {"DICOM, no slice among the files", Way::scan, "scan",
         [](const std::string& folder) { write_file_of(folder + "/scan/README.txt", "x"); }, "E0660",
         "none of the folder's 1 file"},
        {"DICOM, one slice alone", Way::scan, "scan", series([](Series& all) { all.files.resize(1); }), "E0669",
         "at least 2"},
        {"DICOM, a file of the series in its place", Way::scan, "scan/IM3.dcm", series(nothing), "E0669",
         "Name the folder"},
    };
}

}  // namespace kerf::test
