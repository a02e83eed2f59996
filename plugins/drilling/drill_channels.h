// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Numbers of the law's channels.
namespace kerf::drilling {

/// `id_stick` begins two directions, `id_side` and `id_crush_side` four each, and `id_contact` the slots of contact.
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
/// The first contact slots belong to the still tip, one for each of eight azimuths.
inline constexpr std::size_t tip_slots = 8;

}  // namespace kerf::drilling
