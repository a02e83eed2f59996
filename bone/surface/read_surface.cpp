// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/read_surface.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "text/regular_file.h"

namespace kerf::bone {
namespace {

constexpr std::uintmax_t max_bytes = 1'000'000'000;

bool ends_in(const std::string& name, std::string_view ending) {
    if (name.size() < ending.size()) return false;
    return std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [](char want, char got) { return want == (got >= 'A' && got <= 'Z' ? got - 'A' + 'a' : got); });
}

}  // namespace

text::Result<SurfaceFile> read_surface(const std::string& file) {
    const auto refuse = [&](const SurfaceError& error) {
        return text::Diagnostics{text::error_about(file, error.code, error.message + " " + error.advice)};
    };
    const bool is_stl = ends_in(file, ".stl"), is_obj = ends_in(file, ".obj"), is_ply = ends_in(file, ".ply");
    if (!is_stl && !is_obj && !is_ply)
        return refuse({"E0641", "the name ends in none of .stl, .obj and .ply.", "Export the surface as one of them."});

    if (auto fault = text::fault_of_file(file))
        return refuse({"E0640", std::move(fault->problem), std::move(fault->advice)});
    std::error_code wrong;
    const std::uintmax_t size = std::filesystem::file_size(file, wrong);
    if (wrong) return refuse({"E0640", "the file cannot be read.", "Check who may read it."});
    if (size > max_bytes)
        return refuse(
            {"E0642", "the file has more than 1 GB.", "Export the surface with fewer faces, or cut out the bone."});
    try {
        std::string bytes(size, '\0');
        std::ifstream in = text::open_regular_file(file);
        in.read(bytes.data(), static_cast<std::streamsize>(size));
        if (!in) return refuse({"E0640", "the file cannot be read.", "Check who may read it."});
        SurfaceError error;
        std::optional<SurfaceFile> surface = is_stl   ? read_stl(bytes, error)
                                             : is_obj ? read_obj(bytes, error)
                                                      : read_ply(bytes, error);
        if (!surface) return refuse(error);
        return *std::move(surface);
    } catch (const std::exception& e) {
        return refuse(
            {"E0642", std::string("reading stopped: ") + e.what() + ".", "Export the surface with fewer faces."});
    }
}

}  // namespace kerf::bone
