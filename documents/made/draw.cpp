// SPDX-License-Identifier: Apache-2.0
#include "documents/made/draw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "documents/made/normal.h"

namespace kerf::documents {
namespace {

constexpr double like_neighbours = 0.7;  // [–] correlation between neighbouring levels, beyond that of size
constexpr double stature_to_size = 0.6;  // [–] correlation
constexpr int max_attempts = 1000;       // of a bone
constexpr int max_draws = 100;           // of one dimension

/// Rounds to 0.1 µm and the like, so that the last bits of the C library do not reach the text.
double rounded(double value) noexcept { return std::round(value * 1e7) * 1e-7; }

double rest_of(double correlation) noexcept { return std::sqrt(1.0 - correlation * correlation); }

/// The bone of one person, in units of standard deviations.
class Person {
public:
    Person(const Population& population, const MakeRequest& request)
        : population_(population), noise_(request.seed.value_or(0)), has_noise_(request.seed.has_value()) {
        size_ = has_noise_ ? noise_.at("size", 0) : 0.0;
        if (request.stature)
            size_ = stature_to_size * (*request.stature - population_.stature.mean) / population_.stature.sd +
                    rest_of(stature_to_size) * size_;
    }

    /// Returns a value within the bounds of its dimension.
    [[nodiscard]] double value_of(const Dimension& dimension, int attempt) const {
        double value = dimension.mean;
        for (int n = 0; n < max_draws; ++n) {
            value =
                dimension.mean + before_truncation * dimension.sd * deviation_of(dimension, attempt * max_draws + n);
            if (value >= dimension.min_drawn && value <= dimension.max_drawn) return value;
        }
        return std::clamp(value, dimension.min_drawn, dimension.max_drawn);
    }

private:
    [[nodiscard]] double deviation_of(const Dimension& dimension, int draw) const {
        double own = own_variation(dimension, draw);
        if (!dimension.partner.empty())
            for (const Dimension& partner : population_.dimensions)
                if (partner.name == dimension.partner)
                    own = dimension.shared * own_variation(partner, draw - draw % max_draws) +
                          rest_of(dimension.shared) * own;
        return dimension.loading * size_ + rest_of(dimension.loading) * own;
    }

    /// Returns the variation of a dimension beyond that of size. Along the spine it is a chain from level to level;
    /// only the last link is drawn again.
    [[nodiscard]] double own_variation(const Dimension& dimension, int draw) const {
        if (!has_noise_) return 0.0;
        const std::vector<std::string>& levels = population_.levels;
        if (levels.empty()) return noise_.at(dimension.name, draw);
        const auto at_level = [&](std::size_t level) {
            return noise_.at(levels[level] + "/" + dimension.name, level + 1 == levels.size() ? draw : 0);
        };
        if (!dimension.is_along_spine) return at_level(levels.size() - 1);
        double chain = at_level(0);
        for (std::size_t level = 1; level < levels.size(); ++level)
            chain = like_neighbours * chain + rest_of(like_neighbours) * at_level(level);
        return chain;
    }

    const Population& population_;
    NormalSource noise_;
    bool has_noise_;
    double size_ = 0.0;
};

std::optional<double> fixed_value(const MakeRequest& request, const std::string& name) {
    for (const FixedDimension& fixed : request.fixed)
        if (fixed.name == name) return fixed.value;
    return std::nullopt;
}

}  // namespace

DrawnBone draw_bone(const Population& population, const MakeRequest& request) {
    const Person person(population, request);
    DrawnBone bone;
    const int attempts = request.seed ? max_attempts : 1;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        for (const Dimension& dimension : population.dimensions) {
            const std::optional<double> fixed = fixed_value(request, dimension.name);
            bone.values.set(dimension.name, fixed ? *fixed : rounded(person.value_of(dimension, attempt)));
        }
        bone.contradiction = population.find_contradiction(bone.values);
        bone.redraws = attempt;
        if (bone.contradiction.empty()) break;
    }
    return bone;
}

}  // namespace kerf::documents
