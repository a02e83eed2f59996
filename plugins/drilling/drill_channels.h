// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The law's channels by number.
namespace kerf::drilling {

/// Two ways from `id_stick` on, four from `id_side` and `id_crush_side`, contact's slots from `id_contact` on.
enum ChannelId : std::uint32_t {
    id_feed = 1,
    id_heel,
    id_rub,
    id_crush,
    id_stick,
    id_side = 8,
    id_crush_side = 12,
    id_contact = 16
};
/// The first slots of contact are the still tip's, one for each of eight azimuths.
inline constexpr std::size_t tip_slots = 8;

}  // namespace kerf::drilling
