// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Colours of tissues, the same in reports, previews and windows.
namespace kerf::text {

/// sRGB.
struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0;

    /// Returns it as `#rrggbb`.
    [[nodiscard]] std::string hex() const {
        constexpr std::string_view digits = "0123456789abcdef";
        std::string text = "#";
        for (const std::uint8_t part : {red, green, blue}) {
            text += digits[part >> 4];
            text += digits[part & 15];
        }
        return text;
    }
    friend constexpr bool operator==(Colour, Colour) = default;
};

namespace palette {

inline constexpr Colour cortical{0xe8, 0xdc, 0xc4};
inline constexpr Colour cancellous{0xc5, 0x98, 0x7b};  ///< trabeculae and their pores together
inline constexpr Colour marrow{0xd9, 0xb2, 0x5f}, dentine{0xe2, 0xcb, 0x9c}, enamel{0xf3, 0xf0, 0xe6},
    cartilage{0xd5, 0xe3, 0xe6};

}  // namespace palette

/// Returns the colour of a tissue by its name, "cortical"; of a name that is not among the usual ones, by its position
/// in the anatomy.   [any] pure
[[nodiscard]] constexpr Colour tissue_colour(std::string_view name, std::size_t position) noexcept {
    struct Named {
        std::string_view name;
        Colour colour;
    };
    constexpr std::array named{Named{"cortical", palette::cortical},     Named{"diaphysis", palette::cortical},
                               Named{"condylar", palette::cortical},     Named{"canal_wall", palette::cortical},
                               Named{"cancellous", palette::cancellous}, Named{"marrow", palette::marrow},
                               Named{"dentine", palette::dentine},       Named{"root", palette::dentine},
                               Named{"enamel", palette::enamel},         Named{"crown", palette::enamel},
                               Named{"cartilage", palette::cartilage}};
    for (const Named& one : named)
        if (one.name == name) return one.colour;
    constexpr std::array others{Colour{0x6f, 0x9f, 0xc8}, Colour{0x82, 0xad, 0x7c}, Colour{0xa8, 0x84, 0xb8},
                                Colour{0xd3, 0xa0, 0xa8}, Colour{0x93, 0x99, 0x9e}, Colour{0x5a, 0xa9, 0xa3}};
    return others[position % others.size()];
}

}  // namespace kerf::text
