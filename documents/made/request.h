// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace kerf::documents {

/// A dimension that is given, and not drawn.
struct FixedDimension {
    std::string name;    ///< "pedicle.width"
    double value = 0.0;  ///< SI
};

/// A bone to make from published dimensions.
struct MakeRequest {
    enum class Sex { unsaid, female, male };
    std::string kind;                 ///< "vertebra"
    std::string level;                ///< "L3"
    Sex sex = Sex::unsaid;            ///< unsaid: the mean of both, or drawn
    std::optional<double> stature{};  ///< [m]
    std::optional<double> age{};      ///< [years]
    bool is_osteoporotic = false;
    std::optional<std::uint32_t> seed{};  ///< none: the bone of mean dimensions
    std::vector<FixedDimension> fixed{};
};

}  // namespace kerf::documents
