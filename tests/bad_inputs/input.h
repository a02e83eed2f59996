// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

/// Files as people really have them, damaged or odd, and how each must end.
namespace kerf::test {

/// What is asked of an input: the same as by a person with `kerf import`, `kerf run`, `kerf run --replay` or `kerf
/// report`.
enum class Way {
    scan,      ///< imported and written anew; and bone made of it by an anatomy
    surface,   ///< the same
    markups,   ///< an anatomy with these landmarks is checked with a procedure
    document,  ///< a procedure, or an anatomy with a procedure, is checked
    session,   ///< read for a replay
    report,    ///< read for its page
};

struct Input {
    std::string name;
    Way way = Way::scan;
    std::string source;                            ///< what a person names, in the folder
    std::function<void(const std::string&)> make;  ///< writes it and what belongs to it into the folder
    std::string ends;      ///< "loaded", or a code; "loaded W0671 W0672" for what must come along, and nothing else may
    std::string words;     ///< that what a person is told must hold; of those that are refused never empty
    std::string how = "";  ///< more of `ct:` or `mesh:`, as in "series: 7"; of a surface the unit and frame
};

/// The block of bone that all scans and surfaces hold; millimetres, LPS. Nowhere the same from two sides, so that
/// whatever is mirrored, turned or moved is seen.
struct Bone {
    static constexpr double low[3]{-4.5, -9.0, -10.0}, high[3]{9.5, 3.0, 4.0};

    static bool has(double x, double y, double z) {
        return x > low[0] && x < high[0] && y > low[1] && y < high[1] && z > low[2] && z < high[2];
    }
    /// [HU] Linear in bone and around it: any true interpolation gives it back.
    static double value(double x, double y, double z) {
        return (has(x, y, z) ? 1000.0 : -1000.0) + 4.0 * x + 2.0 * y + z;
    }
};

void write_file_of(const std::string& file, const std::string& bytes);

/// The text with its first `from` replaced; stops the program if there is none.
[[nodiscard]] std::string with_replaced(std::string text, const std::string& from, const std::string& to);

[[nodiscard]] std::vector<Input> image_inputs();
[[nodiscard]] std::vector<Input> dicom_inputs();
[[nodiscard]] std::vector<Input> surface_inputs();
[[nodiscard]] std::vector<Input> markup_inputs();
[[nodiscard]] std::vector<Input> document_inputs();
[[nodiscard]] std::vector<Input> session_inputs();

}  // namespace kerf::test
