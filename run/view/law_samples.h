// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "kerf/abi.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Passes a law's queries on to bone and keeps their points with the answers.   [main]
class LawSamples {
public:
    /// Pre: `bone` outlives this object.
    explicit LawSamples(const kerf_bone_query& bone);
    LawSamples(const LawSamples&) = delete;
    LawSamples& operator=(const LawSamples&) = delete;

    /// Returns the query to evaluate the law with.
    [[nodiscard]] const kerf_bone_query& query() const noexcept { return query_; }
    /// Returns the first `max_viewed_samples` points.
    [[nodiscard]] const std::vector<ViewedSample>& points() const noexcept { return points_; }
    /// Returns the number of points of all queries.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

private:
    void add_edges(const kerf_vec3* points, std::uint32_t count, const kerf_vec3* directions,
                   std::uint32_t direction_count, const kerf_bone_sample* answers);
    void add_contacts(const kerf_vec3* points, std::uint32_t count, const kerf_surface_point* answers);

    const kerf_bone_query* bone_;
    kerf_bone_query query_{};
    std::vector<ViewedSample> points_;
    std::size_t count_ = 0;
};

}  // namespace kerf::run
