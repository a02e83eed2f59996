// SPDX-License-Identifier: Apache-2.0
// NIfTI, NRRD and MetaImage.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/bad_inputs/input.h"
#include "tests/support/dicom_writer.h"

namespace kerf::test {
namespace {

using Make = std::function<void(const std::string&)>;

/// Where the voxels of a volume lie: millimetres, LPS, from indices; three columns and the first voxel.
struct Layout {
    std::array<int, 3> size{24, 20, 16};
    std::array<double, 12> lps{1, 0, 0, -11, 0, 1.5, 0, -14, 0, 0, 2, -15};

    /// The same voxels, counted from the other end of an axis.
    [[nodiscard]] Layout flipped(std::size_t axis) const {
        Layout other = *this;
        for (std::size_t row = 0; row < 3; ++row) {
            other.lps[4 * row + 3] += lps[4 * row + axis] * (size[axis] - 1);
            other.lps[4 * row + axis] = -lps[4 * row + axis];
        }
        return other;
    }
    /// The axes in another order.
    [[nodiscard]] Layout ordered(std::size_t i, std::size_t j, std::size_t k) const {
        Layout other = *this;
        const std::size_t from[]{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            other.size[axis] = size[from[axis]];
            for (std::size_t row = 0; row < 3; ++row) other.lps[4 * row + axis] = lps[4 * row + from[axis]];
        }
        return other;
    }
    /// Slices that slide along y by a part of their height.
    [[nodiscard]] Layout sheared(double slide) const {
        Layout other = *this;
        other.lps[4 * 1 + 2] += slide * lps[4 * 2 + 2];
        other.lps[4 * 1 + 3] += slide * lps[4 * 2 + 3];
        return other;
    }
    [[nodiscard]] double at(std::size_t row, int i, int j, int k) const {
        return lps[4 * row] * i + lps[4 * row + 1] * j + lps[4 * row + 2] * k + lps[4 * row + 3];
    }
    [[nodiscard]] double value(int i, int j, int k) const {
        return Bone::value(at(0, i, j, k), at(1, i, j, k), at(2, i, j, k));
    }
};

/// What every voxel becomes in the file.
using Stored = std::function<double(double)>;
double as_it_is(double value) { return value; }

template <class Number>
std::string voxels(const Layout& layout, bool is_big = false, const Stored& stored = as_it_is) {
    std::string bytes;
    for (int k = 0; k < layout.size[2]; ++k)
        for (int j = 0; j < layout.size[1]; ++j)
            for (int i = 0; i < layout.size[0]; ++i) {
                const double value = stored(layout.value(i, j, k));
                const auto number = static_cast<Number>(std::is_integral_v<Number> ? std::round(value) : value);
                std::string one(reinterpret_cast<const char*>(&number), sizeof number);
                if (is_big) std::reverse(one.begin(), one.end());
                bytes += one;
            }
    return bytes;
}

std::string packed(std::string bytes, int window) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("deflate");
    std::string out(bytes.size() + 1000, '\0');
    stream.next_in = reinterpret_cast<unsigned char*>(bytes.data());
    stream.avail_in = static_cast<unsigned>(bytes.size());
    stream.next_out = reinterpret_cast<unsigned char*>(out.data());
    stream.avail_out = static_cast<unsigned>(out.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("deflate");
    out.resize(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return out;
}
std::string gzipped(const std::string& bytes) { return packed(bytes, 31); }
std::string deflated(const std::string& bytes) { return packed(bytes, 15); }

// ---- NIfTI
// ------------------------------------------------------------------------------------------------------------

/// A header that can be spoilt at one place, in either byte order. RAS: x and y turn their sign.
struct Nifti {
    Layout layout;
    bool is_big = false;
    std::map<std::size_t, std::string> fields;
    std::string data;  ///< empty: whole numbers of 16 bits
    std::size_t header = 352;

    template <class Number>
    Nifti& with(std::size_t at, Number value) {
        fields[at] = std::string(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Nifti& word(std::size_t at, int value) { return with(at, static_cast<std::int16_t>(value)); }
    Nifti& real(std::size_t at, double value) { return with(at, static_cast<float>(value)); }

    explicit Nifti(const Layout& placed = {}) : layout(placed) {
        with<std::int32_t>(0, 348)
            .word(40, 3)
            .word(70, 4)
            .word(72, 16)
            .real(76, 1)
            .real(108, 352)
            .real(112, 1)
            .with<char>(123, 2);
        for (std::size_t axis = 0; axis < 7; ++axis) word(42 + 2 * axis, axis < 3 ? layout.size[axis] : 1);
        for (std::size_t axis = 0; axis < 3; ++axis)
            real(80 + 4 * axis, std::hypot(layout.lps[axis], layout.lps[4 + axis], layout.lps[8 + axis]));
        sform(layout, 1.0);
    }
    Nifti& sform(const Layout& placed, double per_mm) {
        word(254, 1);
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 4; ++column)
                real(280 + 16 * row + 4 * column, (row < 2 ? -1.0 : 1.0) * per_mm * placed.lps[4 * row + column]);
        return *this;
    }
    /// LPS axes in RAS: half a turn about z. Pre: the layout as it stands at first.
    Nifti& qform() {
        return word(252, 1)
            .real(256, 0)
            .real(260, 0)
            .real(264, 1)
            .real(268, -layout.lps[3])
            .real(272, -layout.lps[7])
            .real(276, layout.lps[11]);
    }
    Nifti& without_sform() { return word(254, 0); }
    Nifti& magic(const char* word) {
        fields[344] = std::string(word, 4);
        return *this;
    }
    template <class Number>
    Nifti& of(int type, const Stored& stored = as_it_is) {
        data = voxels<Number>(layout, is_big, stored);
        return word(70, type).word(72, 8 * static_cast<int>(sizeof(Number)));
    }

    [[nodiscard]] std::string bytes() const {
        std::string all(header, '\0');
        if (!fields.contains(344)) std::memcpy(all.data() + 344, "n+1", 4);
        for (const auto& [at, field] : fields) {
            std::string one = field;
            if (is_big && at != 344) std::reverse(one.begin(), one.end());
            std::memcpy(all.data() + at, one.data(), one.size());
        }
        return all + (data.empty() ? voxels<std::int16_t>(layout, is_big) : data);
    }
};

Make nifti(const std::function<void(Nifti&)>& change, const Layout& layout = {}) {
    return [=](const std::string& folder) {
        Nifti file(layout);
        change(file);
        write_file_of(folder + "/a.nii", file.bytes());
    };
}

/// Bytes as some file.
Make file(const std::string& name, const std::function<std::string()>& bytes) {
    return [=](const std::string& folder) { write_file_of(folder + "/" + name, bytes()); };
}

std::string cut(std::string bytes, std::size_t count) { return bytes.substr(0, bytes.size() - count); }

Layout standard() { return {}; }
/// Turned by about 0.2 rad about z and x, around the bone.
Layout oblique() {
    Layout turned{.size = {48, 48, 40}, .lps = {}};
    const double c = std::cos(0.2), s = std::sin(0.2);
    const double axes[3][3]{{c, -s * c, s * s}, {s, c * c, -c * s}, {0, s, c}};
    for (std::size_t row = 0; row < 3; ++row) {
        double centre = 0.0;
        for (std::size_t column = 0; column < 3; ++column) {
            turned.lps[4 * row + column] = axes[row][column];
            centre += axes[row][column] * 0.5 * (turned.size[column] - 1);
        }
        turned.lps[4 * row + 3] = -centre;
    }
    return turned;
}

std::vector<Input> nifti_inputs() {
    const auto nothing = [](Nifti&) {};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {
        {"NIfTI, sform alone", Way::scan, "a.nii", nifti(nothing), "loaded", ""},
        {"NIfTI, qform alone", Way::scan, "a.nii", nifti([](Nifti& n) { n.qform().without_sform(); }), "loaded", ""},
        {"NIfTI, sform and qform that agree", Way::scan, "a.nii", nifti([](Nifti& n) { n.qform(); }), "loaded", ""},
        {"NIfTI, sform and qform 20 mm apart", Way::scan, "a.nii", nifti([](Nifti& n) { n.qform().real(268, 31); }),
         "loaded W0673", "20 mm apart; `sform` was taken"},
        {"NIfTI, qform with a mirrored third axis", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.qform().without_sform().real(76, -1).real(276, n.layout.lps[11]); },
               standard().flipped(2)),
         "loaded", ""},
        {"NIfTI, neither form", Way::scan, "a.nii", nifti([](Nifti& n) { n.without_sform(); }), "E0627",
         "left and right cannot be distinguished"},
        {"NIfTI, axes in another order", Way::scan, "a.nii", nifti(nothing, standard().ordered(2, 0, 1)), "loaded", ""},
        {"NIfTI, left-handed axes", Way::scan, "a.nii", nifti(nothing, standard().flipped(0)), "loaded", ""},
        {"NIfTI, all axes backwards and in another order", Way::scan, "a.nii",
         nifti(nothing, standard().flipped(0).flipped(1).flipped(2).ordered(1, 2, 0)), "loaded", ""},
        {"NIfTI, oblique", Way::scan, "a.nii", nifti([](Nifti& n) { n.of<float>(16); }, oblique()), "loaded", ""},
        {"NIfTI, sheared as under a tilted gantry", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.of<float>(16); }, standard().sheared(0.2)), "loaded W0671", "sheared by 11.3 deg"},
        {"NIfTI, big endian", Way::scan, "a.nii", nifti([](Nifti& n) { n.is_big = true; }), "loaded", ""},
        {"NIfTI, big endian floats", Way::scan, "a.nii", nifti([](Nifti& n) {
             n.is_big = true;
             n.of<float>(16);
         }),
         "loaded", ""},
        {"NIfTI, scaled to unsigned", Way::scan, "a.nii", nifti([](Nifti& n) {
             n.of<std::uint16_t>(512, [](double v) { return 2.0 * (v + 2000.0); }).real(112, 0.5).real(116, -2000);
         }),
         "loaded", ""},
        {"NIfTI, a scale of 0, which means none", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.real(112, 0).real(116, 77); }), "loaded W0673", "`scl_inter` is 77"},
        {"NIfTI, a scale that is no number", Way::scan, "a.nii", nifti([=](Nifti& n) { n.with(112, nan); }), "E0622",
         "`scl_slope` or `scl_inter`"},
        {"NIfTI, doubles", Way::scan, "a.nii", nifti([](Nifti& n) { n.of<double>(64); }), "loaded", ""},
        {"NIfTI, 32-bit whole numbers", Way::scan, "a.nii", nifti([](Nifti& n) { n.of<std::int32_t>(8); }), "loaded",
         ""},
        {"NIfTI, a voxel that is no number", Way::scan, "a.nii", nifti([=](Nifti& n) {
             n.of<float>(16);
             std::memcpy(n.data.data() + 400, &nan, 4);
         }),
         "E0629", "not a finite number"},
        {"NIfTI, four dimensions of which the last is 1", Way::scan, "a.nii", nifti([](Nifti& n) { n.word(40, 4); }),
         "loaded", ""},
        {"NIfTI, two points in time", Way::scan, "a.nii", nifti([](Nifti& n) {
             n.word(40, 4).word(48, 2);
             n.data = voxels<std::int16_t>({}) + voxels<std::int16_t>({});
         }),
         "E0623", "must have 3"},
        {"NIfTI, unused sizes of 0", Way::scan, "a.nii", nifti([](Nifti& n) {
             for (std::size_t at = 48; at <= 54; at += 2) n.word(at, 0);
         }),
         "loaded", ""},
        {"NIfTI-2", Way::scan, "a.nii", nifti([](Nifti& n) { n.with<std::int32_t>(0, 540); }), "E0622", "NIfTI-2"},
        {"NIfTI, the header of a pair", Way::scan, "a.hdr",
         [](const std::string& folder) {
             Nifti n;
             write_file_of(folder + "/a.hdr", n.magic("ni1").bytes().substr(0, 348));
             write_file_of(folder + "/a.img", voxels<std::int16_t>({}));
         },
         "E0621", "no format that can be read"},
        {"NIfTI, the header of a pair under another name", Way::scan, "a.nii", nifti([](Nifti& n) { n.magic("ni1"); }),
         "E0622", "the header of a pair"},
        {"NIfTI, metres", Way::scan, "a.nii", nifti([](Nifti& n) {
             n.with<char>(123, 1).sform(n.layout, 1e-3).real(80, 1e-3).real(84, 1.5e-3).real(88, 2e-3);
         }),
         "loaded", ""},
        {"NIfTI, micrometres", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.with<char>(123, 3).sform(n.layout, 1e3).real(80, 1e3).real(84, 1.5e3).real(88, 2e3); }),
         "loaded", ""},
        {"NIfTI, metres called millimetres", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.sform(n.layout, 1e-4).real(80, 1e-4).real(84, 1.5e-4).real(88, 2e-4); }), "E0627",
         "0.001 mm … 100 mm"},
        {"NIfTI, gzip", Way::scan, "a.nii.gz", file("a.nii.gz", [] { return gzipped(Nifti().bytes()); }), "loaded", ""},
        {"NIfTI, gzip in two pieces", Way::scan, "a.nii.gz",
         file("a.nii.gz",
              [] {
                  const std::string all = Nifti().bytes();
                  return gzipped(all.substr(0, 5000)) + gzipped(all.substr(5000));
              }),
         "loaded", ""},
        {"NIfTI, gzip cut short", Way::scan, "a.nii.gz",
         file("a.nii.gz", [] { return cut(gzipped(Nifti().bytes()), 300); }), "E0626", "the header promises"},
        {"NIfTI, gzip damaged", Way::scan, "a.nii.gz",
         file("a.nii.gz",
              [] {
                  std::string all = gzipped(Nifti().bytes());
                  all[200] = static_cast<char>(~all[200]);
                  all[201] = static_cast<char>(~all[201]);
                  return all;
              }),
         "E0626", "Copy the file again"},
        {"NIfTI, gzip under the name of plain", Way::scan, "a.nii",
         file("a.nii", [] { return gzipped(Nifti().bytes()); }), "E0622", "no NIfTI-1 file"},
        {"NIfTI, plain under the name of gzip", Way::scan, "a.nii.gz", file("a.nii.gz", [] { return Nifti().bytes(); }),
         "E0622", "no gzip file"},
        {"NIfTI, gzip of 0.4 MB that unpacks to 400 MB", Way::scan, "a.nii.gz",
         file("a.nii.gz", [] { return gzipped(Nifti().bytes() + std::string(400u << 20, '\0')); }), "loaded W0673",
         "more than the"},
        {"NIfTI, cut short", Way::scan, "a.nii", file("a.nii", [] { return cut(Nifti().bytes(), 1); }), "E0626",
         "the header promises"},
        {"NIfTI, empty", Way::scan, "a.nii", file("a.nii", [] { return std::string(); }), "E0626", "0 bytes"},
        {"NIfTI, sizes that want 1 TB", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.word(42, 4000).word(44, 4000).word(46, 4000); }), "E0624", "512 million"},
        {"NIfTI, a negative size", Way::scan, "a.nii", nifti([](Nifti& n) { n.word(44, -20); }), "E0624", "2 … 4096"},
        {"NIfTI, colours", Way::scan, "a.nii", nifti([](Nifti& n) { n.word(70, 128).word(72, 24); }), "E0625",
         "is 128: colours"},
        {"NIfTI, bits that do not fit the type", Way::scan, "a.nii", nifti([](Nifti& n) { n.word(72, 32); }), "E0622",
         "`bitpix` is 32"},
        {"NIfTI, voxels that begin in the header", Way::scan, "a.nii", nifti([](Nifti& n) { n.real(108, 0); }), "E0622",
         "`vox_offset` is 0"},
        {"NIfTI, an extension behind the header", Way::scan, "a.nii", nifti([](Nifti& n) {
             n.header = 384;
             n.real(108, 384).with<char>(348, 1).with<std::int32_t>(352, 32).with<std::int32_t>(356, 6);
         }),
         "loaded", ""},
        {"NIfTI, more bytes than voxels", Way::scan, "a.nii",
         nifti([](Nifti& n) { n.data = voxels<std::int16_t>({}) + std::string(5000, 'x'); }), "loaded W0673",
         "5000 bytes more"},
        {"NIfTI, a capital ending", Way::scan, "A.NII", file("A.NII", [] { return Nifti().bytes(); }), "loaded", ""},
        {"NIfTI, a name with blanks and letters of many sorts", Way::scan, "ein Wirbel – ärztlich 骨.nii",
         file("ein Wirbel – ärztlich 骨.nii", [] { return Nifti().bytes(); }), "loaded", ""},
    };
}

// ---- NRRD
// -------------------------------------------------------------------------------------------------------------

/// A header, line by line.
struct Nrrd {
    Layout layout;
    std::vector<std::pair<std::string, std::string>> lines;
    std::string remarks, data, end = "\n";

    explicit Nrrd(const Layout& placed = {}, const char* space = "left-posterior-superior", double sign_x = 1.0,
                  double sign_y = 1.0)
        : layout(placed) {
        const auto vector = [&](std::size_t column) {
            return "(" + DicomWriter::decimal(sign_x * layout.lps[column]) + "," +
                   DicomWriter::decimal(sign_y * layout.lps[4 + column]) + "," +
                   DicomWriter::decimal(layout.lps[8 + column]) + ")";
        };
        lines = {{"type", "short"},
                 {"dimension", "3"},
                 {"space", space},
                 {"sizes", std::to_string(layout.size[0]) + " " + std::to_string(layout.size[1]) + " " +
                               std::to_string(layout.size[2])},
                 {"space directions", vector(0) + " " + vector(1) + " " + vector(2)},
                 {"kinds", "domain domain domain"},
                 {"endian", "little"},
                 {"encoding", "raw"},
                 {"space origin", vector(3)}};
        data = voxels<std::int16_t>(layout);
    }
    /// An empty value takes the line away.
    Nrrd& set(const std::string& key, const std::string& value) {
        const auto at = std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == key; });
        if (at == lines.end())
            lines.emplace_back(key, value);
        else if (value.empty())
            lines.erase(at);
        else
            at->second = value;
        return *this;
    }
    [[nodiscard]] std::string bytes() const {
        std::string text = "NRRD0004" + end;
        for (const auto& [key, value] : lines) text += key + ": " + value + end;
        return text + remarks + end + data;
    }
};

Make nrrd(const std::function<void(Nrrd&)>& change, const Nrrd& from = Nrrd(), const std::string& name = "a.nrrd") {
    return [=](const std::string& folder) {
        Nrrd n = from;
        change(n);
        write_file_of(folder + "/" + name, n.bytes());
    };
}

/// A header without an empty line at its end, its voxels and some more bytes beside it.
Make detached(const std::string& more) {
    return [=](const std::string& folder) {
        Nrrd n;
        write_file_of(folder + "/a.raw", n.data + more);
        n.data.clear();
        n.set("data file", "a.raw");
        const std::string header = n.bytes();
        write_file_of(folder + "/a.nhdr", header.substr(0, header.size() - 1));
    };
}

/// What 3D Slicer calls a segmentation: labels of the bone in one layer, something else in another.
Make segmentation(const std::function<void(Nrrd&)>& change) {
    return [=](const std::string& folder) {
        write_file_of(folder + "/a.nrrd", Nrrd().bytes());
        Nrrd n;
        const Layout& at = n.layout;
        n.data.clear();
        for (int k = 0; k < at.size[2]; ++k)
            for (int j = 0; j < at.size[1]; ++j)
                for (int i = 0; i < at.size[0]; ++i) {
                    n.data += at.value(i, j, k) > 0.0 ? '\3' : '\0';
                    n.data += j > 17 ? '\1' : '\0';
                }
        n.set("type", "uchar")
            .set("dimension", "4")
            .set("sizes", "2 24 20 16")
            .set("kinds", "list domain domain domain");
        n.set("space directions", "none (1,0,0) (0,1.5,0) (0,0,2)").set("endian", "");
        n.remarks = "Segment0_Name:=bone of "
                    "somebody\nSegment0_LabelValue:=3\nSegment0_Layer:=0\nSegment1_Name:=skin\nSegment1_LabelValue:="
                    "1\nSegment1_Layer:=1\n";
        change(n);
        write_file_of(folder + "/a.seg.nrrd", n.bytes());
    };
}

std::vector<Input> nrrd_inputs() {
    const auto nothing = [](Nrrd&) {};
    const auto set = [](const std::string& key, const std::string& value) {
        return nrrd([=](Nrrd& n) { n.set(key, value); });
    };
    const std::string by_name = "labels: {file: a.seg.nrrd, keep: [\"bone of somebody\"]}",
                      by_number = "labels: {file: a.seg.nrrd, keep: [3]}";
    return {
        {"NRRD, LPS", Way::scan, "a.nrrd", nrrd(nothing), "loaded", ""},
        {"NRRD, RAS", Way::scan, "a.nrrd", nrrd(nothing, Nrrd({}, "right-anterior-superior", -1, -1)), "loaded", ""},
        {"NRRD, LAS by its short name", Way::scan, "a.nrrd", nrrd(nothing, Nrrd({}, "LAS", 1, -1)), "loaded", ""},
        {"NRRD, no space", Way::scan, "a.nrrd", set("space", ""), "E0622", "no `space`"},
        {"NRRD, a space without a patient", Way::scan, "a.nrrd", set("space", "scanner-xyz"), "E0627",
         "left and right cannot be distinguished"},
        {"NRRD, left-handed and in another order", Way::scan, "a.nrrd",
         nrrd(nothing, Nrrd(standard().flipped(1).ordered(0, 2, 1))), "loaded", ""},
        {"NRRD, sheared", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("type", "float").data = voxels<float>(n.layout); }, Nrrd(standard().sheared(0.2))),
         "loaded W0671", "11.3 deg"},
        {"NRRD, sheared within its slices", Way::scan, "a.nrrd",
         set("space directions", "(1,0.4,0.4) (0,1.5,0.4) (0,0,2)"), "E0632", "right angles"},
        {"NRRD, big endian", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("endian", "big").data = voxels<std::int16_t>(n.layout, true); }), "loaded", ""},
        {"NRRD, no byte order", Way::scan, "a.nrrd", set("endian", ""), "E0622", "no `endian`"},
        {"NRRD, gzip", Way::scan, "a.nrrd", nrrd([](Nrrd& n) { n.set("encoding", "gzip").data = gzipped(n.data); }),
         "loaded", ""},
        {"NRRD, gzip cut short", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("encoding", "gzip").data = cut(gzipped(n.data), 500); }), "E0626", "promises"},
        {"NRRD, encoded as text", Way::scan, "a.nrrd", set("encoding", "ascii"), "E0625", "raw or gzip"},
        {"NRRD, lines that end in CR LF", Way::scan, "a.nrrd", nrrd([](Nrrd& n) { n.end = "\r\n"; }), "loaded", ""},
        {"NRRD, cut in its header", Way::scan, "a.nrrd", file("a.nrrd", [] { return Nrrd().bytes().substr(0, 150); }),
         "E0626", "does not end"},
        {"NRRD, voxels cut short", Way::scan, "a.nrrd", file("a.nrrd", [] { return cut(Nrrd().bytes(), 1); }), "E0626",
         "promises"},
        {"NRRD, voxels in another file that is missing", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("data file", "a.raw"); }), "E0620", "no such file"},
        {"NRRD, a detached header", Way::scan, "a.nhdr", detached(""), "loaded", ""},
        {"NRRD, a detached header, more bytes than voxels", Way::scan, "a.nhdr", detached("x"), "E0626",
         "1 bytes more"},
        {"NRRD, voxels in a file outside the folder", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("datafile", "../../../../etc/passwd"); }), "E0622", "beside the header"},
        {"NRRD, a byte skip", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("byte skip", "-1").data = std::string(64, 'x') + n.data; }), "loaded", ""},
        {"NRRD, a line skip", Way::scan, "a.nrrd", set("line skip", "1"), "E0622", "line skip"},
        {"NRRD, fewer sizes than dimensions", Way::scan, "a.nrrd", set("sizes", "24 20"), "E0622", "`dimension`"},
        {"NRRD, a size of words", Way::scan, "a.nrrd", set("sizes", "24 20 sixteen"), "E0622", "sizes"},
        {"NRRD, a size that no number holds", Way::scan, "a.nrrd", set("sizes", "24 20 99999999999999999999"), "E0622",
         "sizes"},
        {"NRRD, four dimensions of points in time", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.set("dimension", "4").set("sizes", "24 20 16 2").data += n.data; }), "E0623",
         "must have 3"},
        {"NRRD, inches", Way::scan, "a.nrrd", set("space units", "\"in\" \"in\" \"in\""), "E0627", "`space units`"},
        {"NRRD, a decimal comma", Way::scan, "a.nrrd", set("space origin", "(-11,5,-14,0,-15,0)"), "E0627", "one"},
        {"NRRD, a direction that is no number", Way::scan, "a.nrrd",
         set("space directions", "(nan,0,0) (0,1.5,0) (0,0,2)"), "E0627", "must be 0.001 mm"},
        {"NRRD, the same line twice", Way::scan, "a.nrrd",
         nrrd([](Nrrd& n) { n.lines.emplace_back("sizes", "24 20 16"); }), "E0622", "twice"},
        {"NRRD, a type wider than the voxels", Way::scan, "a.nrrd", nrrd([](Nrrd& n) { n.set("type", "double"); }),
         "E0626", "promises"},
        {"NRRD, a segmentation in layers, by name", Way::scan, "a.nrrd", segmentation([](Nrrd&) {}), "loaded", "",
         by_name},
        {"NRRD, a segmentation in layers, by number", Way::scan, "a.nrrd", segmentation([](Nrrd&) {}), "loaded", "",
         by_number},
    };
}

// ---- MetaImage
// --------------------------------------------------------------------------------------------------------

struct Meta {
    Layout layout;
    std::vector<std::pair<std::string, std::string>> lines;
    std::string data, end = "\n";

    explicit Meta(const Layout& placed = {}) : layout(placed) {
        std::string matrix, spacing, offset, size;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double step = std::hypot(layout.lps[axis], layout.lps[4 + axis], layout.lps[8 + axis]);
            for (std::size_t row = 0; row < 3; ++row)
                matrix += DicomWriter::decimal(layout.lps[4 * row + axis] / step) + " ";
            spacing += DicomWriter::decimal(step) + " ";
            offset += DicomWriter::decimal(layout.lps[4 * axis + 3]) + " ";
            size += std::to_string(layout.size[axis]) + " ";
        }
        lines = {{"ObjectType", "Image"},      {"NDims", "3"},
                 {"BinaryData", "True"},       {"BinaryDataByteOrderMSB", "False"},
                 {"TransformMatrix", matrix},  {"Offset", offset},
                 {"ElementSpacing", spacing},  {"DimSize", size},
                 {"ElementType", "MET_SHORT"}, {"ElementDataFile", "LOCAL"}};
        data = voxels<std::int16_t>(layout);
    }
    Meta& set(const std::string& key, const std::string& value) {
        const auto at = std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == key; });
        if (at == lines.end())
            lines.insert(lines.end() - 1, {key, value});
        else if (value.empty())
            lines.erase(at);
        else
            at->second = value;
        return *this;
    }
    [[nodiscard]] std::string header() const {
        std::string text;
        for (const auto& [key, value] : lines) text += key + " = " + value + end;
        return text;
    }
};

Make meta(const std::function<void(Meta&)>& change, const Layout& layout = {}) {
    return [=](const std::string& folder) {
        Meta m(layout);
        change(m);
        write_file_of(folder + "/a.mha", m.header() + m.data);
    };
}
Make meta_pair(
    const std::string& data_file, const std::function<void(Meta&)>& change = [](Meta&) {}) {
    return [=](const std::string& folder) {
        Meta m;
        change(m);
        write_file_of(folder + "/in/a.mhd", m.set("ElementDataFile", data_file).header());
        write_file_of(folder + "/in/a.raw", m.data);
        write_file_of(folder + "/a.raw", m.data);
    };
}

std::vector<Input> meta_inputs() {
    const auto set = [](const std::string& key, const std::string& value) {
        return meta([=](Meta& m) { m.set(key, value); });
    };
    return {
        {"MetaImage, one file", Way::scan, "a.mha", meta([](Meta&) {}), "loaded", ""},
        {"MetaImage, header and voxels apart", Way::scan, "in/a.mhd", meta_pair("a.raw"), "loaded", ""},
        {"MetaImage, compressed", Way::scan, "a.mha", meta([](Meta& m) {
             m.data = deflated(m.data);
             m.set("CompressedData", "True").set("CompressedDataSize", std::to_string(m.data.size()));
         }),
         "loaded", ""},
        {"MetaImage, compressed, without the size of that", Way::scan, "a.mha", meta([](Meta& m) {
             m.data = deflated(m.data);
             m.set("CompressedData", "True");
         }),
         "loaded", ""},
        {"MetaImage, compressed, with a size that lies", Way::scan, "a.mha", meta([](Meta& m) {
             m.data = deflated(m.data);
             m.set("CompressedData", "True").set("CompressedDataSize", "99999999999");
         }),
         "loaded W0673", "`CompressedDataSize` is 99999999999"},
        {"MetaImage, compressed and cut short", Way::scan, "a.mha", meta([](Meta& m) {
             m.data = cut(deflated(m.data), 600);
             m.set("CompressedData", "True");
         }),
         "E0626", "promises"},
        {"MetaImage, big endian", Way::scan, "a.mha",
         meta([](Meta& m) { m.set("BinaryDataByteOrderMSB", "True").data = voxels<std::int16_t>(m.layout, true); }),
         "loaded", ""},
        {"MetaImage, oblique", Way::scan, "a.mha",
         meta([](Meta& m) { m.set("ElementType", "MET_FLOAT").data = voxels<float>(m.layout); }, oblique()), "loaded",
         ""},
        {"MetaImage, left-handed", Way::scan, "a.mha", meta([](Meta&) {}, standard().flipped(2)), "loaded", ""},
        {"MetaImage, no offset", Way::scan, "a.mha", set("Offset", ""), "E0627", "no `Offset`"},
        {"MetaImage, two offsets", Way::scan, "a.mha", set("Position", "1 2 3"), "E0622", "two names"},
        {"MetaImage, no directions", Way::scan, "a.mha", set("TransformMatrix", ""), "loaded W0673",
         "`TransformMatrix`"},
        {"MetaImage, no spacing", Way::scan, "a.mha", set("ElementSpacing", ""), "E0622", "no `elementspacing`"},
        {"MetaImage, a spacing of 0", Way::scan, "a.mha", set("ElementSpacing", "1 0 2"), "E0627", "above 0 mm"},
        {"MetaImage, directions in one plane", Way::scan, "a.mha", set("TransformMatrix", "1 0 0 0 1 0 0.6 0.8 0"),
         "E0627", "one plane"},
        {"MetaImage, two dimensions", Way::scan, "a.mha",
         meta([](Meta& m) { m.set("NDims", "2").set("DimSize", "24 20"); }), "E0623", "must have 3"},
        {"MetaImage, colours", Way::scan, "a.mha", set("ElementNumberOfChannels", "3"), "E0623", "3 numbers per voxel"},
        {"MetaImage, voxels as text", Way::scan, "a.mha", set("BinaryData", "False"), "E0625", "as text"},
        {"MetaImage, a header of another size", Way::scan, "a.mha", set("HeaderSize", "-1"), "E0622", "HeaderSize"},
        {"MetaImage, lines that end in CR LF", Way::scan, "a.mha", meta([](Meta& m) { m.end = "\r\n"; }), "loaded", ""},
        {"MetaImage, voxels cut short", Way::scan, "a.mha", meta([](Meta& m) { m.data = cut(m.data, 2); }), "E0626",
         "promises"},
        {"MetaImage, a line without an end", Way::scan, "a.mha",
         file("a.mha", [] { return std::string(5u << 20, 'x'); }), "E0622", "the line"},
        {"MetaImage, the voxels' file is missing", Way::scan, "in/a.mhd", meta_pair("b.raw"), "E0620", "no such file"},
        {"MetaImage, the voxels' file is in the folder above", Way::scan, "in/a.mhd", meta_pair("../a.raw"), "E0622",
         "beside the header"},
        {"MetaImage, the voxels' file is anywhere", Way::scan, "in/a.mhd", meta_pair("/etc/passwd"), "E0622",
         "beside the header"},
        {"MetaImage, the voxels' file is the header", Way::scan, "in/a.mhd", meta_pair("a.mhd"), "E0626", "promises"},
        {"MetaImage, a list of files", Way::scan, "in/a.mhd", meta_pair("LIST"), "E0622", "beside the header"},
        {"MetaImage, a pattern of files", Way::scan, "in/a.mhd", meta_pair("a%d.raw 1 16 1"), "E0622",
         "beside the header"},
        {"a picture", Way::scan, "a.png", file("a.png", [] { return std::string("\x89PNG\r\n\x1a\n", 8); }), "E0621",
         "got a picture"},
        {"a name without an ending", Way::scan, "scan", file("scan", [] { return std::string(1000, 'x'); }), "E0621",
         "no format"},
        {"no file at all", Way::scan, "a.nii.gz", [](const std::string&) {}, "E0620", "no such file"},
        {"a link that leads nowhere", Way::scan, "a.nrrd",
         [](const std::string& folder) { std::filesystem::create_symlink("nowhere", folder + "/a.nrrd"); }, "E0620",
         "no such file"},
    };
}

}  // namespace

std::vector<Input> image_inputs() {
    std::vector<Input> all;
    for (const auto& some : {nifti_inputs(), nrrd_inputs(), meta_inputs()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace kerf::test
