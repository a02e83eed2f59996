// SPDX-License-Identifier: Apache-2.0
#include "documents/made/normal.h"

#include <cmath>
#include <numbers>

#include "core/field/fnv1a.h"

namespace kerf::documents {
namespace {

/// Mixes the bits of a hash [splitmix64]: those of FNV-1a alone are correlated between names that are alike.
std::uint64_t mixed(std::uint64_t bits) noexcept {
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

std::uint64_t hash_of(std::uint32_t seed, std::string_view name, int attempt) noexcept {
    Fnv1a hash;
    hash.add_bytes(seed, 4);
    hash.add_bytes(static_cast<std::uint32_t>(attempt), 4);
    hash.add(name);
    return mixed(hash.value());
}

double in_unit_interval(std::uint64_t bits) noexcept { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

double NormalSource::uniform(std::string_view name, int attempt) const noexcept {
    return in_unit_interval(hash_of(seed_, name, attempt));
}

double NormalSource::at(std::string_view name, int attempt) const noexcept {
    const std::uint64_t first = hash_of(seed_, name, attempt);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - in_unit_interval(first)));  // Box and Muller
    return radius * std::cos(2.0 * std::numbers::pi * in_unit_interval(mixed(first)));
}

}  // namespace kerf::documents
