// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "kerf/assert.hpp"
#include "text/quantity.h"

namespace kerf::documents {

/// How a figure is known.
enum class Evidence {
    read,      ///< in the source
    computed,  ///< an average over figures that were read
    derived,   ///< from other figures by a formula
    recalled,  ///< from memory; the source was not opened
    assumed,   ///< without a source
};

/// A draw is cut at this many standard deviations. The cut lowers the deviation; so the one to draw from is larger.
inline constexpr double truncation = 2.5, before_truncation = 1.048;

/// A dimension of a bone over people of one sex at one level. All SI.
struct Dimension {
    std::string name;  ///< "pedicle.width"
    std::string help;  ///< what it is, in words
    kerf_dimension dimension{};
    std::string unit;  ///< of messages
    double mean = 0.0, sd = 0.0;
    double min_drawn = 0.0, max_drawn = 0.0;  ///< a number outside is drawn again
    double min_set = 0.0, max_set = 0.0;      ///< bounds of `--set`
    double loading = 0.0;                     ///< [–] correlation with the size of the person
    std::string partner{};                    ///< the dimension whose own variation it shares,
    double shared = 0.0;                      ///< [–] with this correlation
    bool is_along_spine = false;              ///< its own variation resembles that of neighbouring levels
    Evidence evidence = Evidence::recalled;
    std::string source{};
};

/// The values of all dimensions of one bone, by name. SI.
class DimensionValues {
public:
    void set(const std::string& name, double value) { values_[name] = value; }
    /// Pre: there is such a dimension.
    [[nodiscard]] double operator[](std::string_view name) const {
        const auto found = values_.find(name);
        KERF_ASSERT(found != values_.end(), "name a dimension of this bone");
        return found->second;
    }

private:
    std::map<std::string, double, std::less<>> values_;
};

/// Returns the word for it: "read", "computed".
[[nodiscard]] inline const char* word_for(Evidence evidence) {
    switch (evidence) {
        case Evidence::read:
            return "read";
        case Evidence::computed:
            return "computed";
        case Evidence::derived:
            return "derived";
        case Evidence::recalled:
            return "recalled";
        case Evidence::assumed:
            break;
    }
    return "assumed";
}

}  // namespace kerf::documents
