// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/motion_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "devices/motion/motion_text.h"

namespace kerf::motion {

namespace {

std::string text_in(const std::string& file) {
    constexpr std::uintmax_t max_bytes = max_rows * max_line;
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error("the motion " + file.substr(0, 100) + " " + why);
    };
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) refuse("is no file. Check `motion`.");
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || size > max_bytes)
        refuse("is larger than " + std::to_string(max_bytes >> 20u) + " MiB. Write fewer rows.");
    std::string text(static_cast<std::size_t>(size), '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.read(text.data(), static_cast<std::streamsize>(size))) refuse("cannot be read. Check `motion`.");
    return text;
}

}  // namespace

std::optional<Motion> motion_of(const DeviceRequest& request) {
    const std::string file = request.setting("motion");
    if (file.empty()) return std::nullopt;
    std::string error;
    std::optional<std::vector<MotionRow>> rows = parse_motion(text_in(file), error);
    if (!rows) throw std::runtime_error("the motion " + file.substr(0, 100) + ", " + error);
    return Motion(*std::move(rows));
}

void require_no_id(const DeviceRequest& request, const std::string& driver) {
    if (!request.id().empty())
        throw std::runtime_error("its id is `" + request.id().substr(0, 64) +
                                 "`, but this driver has one device. Write `" + driver + "`.");
}

}  // namespace kerf::motion
