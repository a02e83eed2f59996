// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "kerf/plugin.hpp"
#include "screw_parameters.h"
#include "screw_thread.h"

namespace kerf::implant {

/// Contact of the core with its hole, of the tip with bone ahead, and of the head with its seat.
struct ScrewContact {
    static constexpr std::size_t levels = 2, directions = 4, around = 8;
    std::array<Vec3, levels * directions> wall{};  ///< points of the core, at each level +x, +y, -x, -y
    std::array<Vec3, around + 1> tip{};            ///< centre and rim
    std::array<double, around + 1> tip_area{};     ///< [m²] that each point represents
    std::array<Vec3, around> seat{};               ///< under the head
    bool has_head = false;

    ScrewContact() = default;
    explicit ScrewContact(const ScrewThread& thread) noexcept;

    static constexpr std::uint32_t id_tip = 10, id_seat = 11, id_wall = 20;
    /// Adds the channels of walls, tip and seat.
    void add_to(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept;

private:
    void add_walls(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept;
    void add_seat(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept;
};

}  // namespace kerf::implant
