// SPDX-License-Identifier: Apache-2.0
#include "documents/made/vertebra/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "documents/made/lines.h"
#include "documents/names.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

class VertebraMeter {
public:
    VertebraMeter(const Anatomy& anatomy, const LandmarkAxis& pedicle, Vec3 in_canal)
        : lines_(anatomy.phantom),
          in_canal_(in_canal),
          pedicle_from_(pedicle.from),
          along_(normalized(pedicle.to - pedicle.from)) {}

    std::vector<MeasuredDimension> measure() {
        measure_body();
        measure_pedicle();
        measure_canal();
        measure_processes();
        return std::move(found_);
    }

private:
    void add(const char* name, double value) {
        if (std::isfinite(value)) found_.push_back({name, value});
    }

    /// Width of the body from outside, through its middle; its end-plates may be hollow there.
    [[nodiscard]] double width_at(double z) const {
        const double left = lines_.to_border({-80.0_mm, 0, z}, {1, 0, 0}),
                     right = lines_.to_border({80.0_mm, 0, z}, {-1, 0, 0});
        return std::isfinite(left) && std::isfinite(right) ? 160.0_mm - left - right : 0.0;
    }
    struct Depth {
        double front = 0.0, back = 0.0;
        [[nodiscard]] double size() const noexcept { return back - front; }
    };
    /// From the front, and from the canal.
    [[nodiscard]] Depth depth_at(double z) const {
        const double front = lines_.to_border({0, -100.0_mm, z}, {0, 1, 0});
        const double back = lines_.to_border({0, in_canal_.y, z}, {0, -1, 0});
        return std::isfinite(front) && std::isfinite(back) ? Depth{front - 100.0_mm, in_canal_.y - back} : Depth{};
    }

    void measure_body() {
        // The body lies between the highest and the lowest bone in front of the canal.
        const Depth middle = depth_at(0.0);
        const auto height_over = [&](double y) { return 80.0_mm - lines_.to_border({0, y, 80.0_mm}, {0, 0, -1}); };
        const auto height_under = [&](double y) { return lines_.to_border({0, y, -80.0_mm}, {0, 0, 1}) - 80.0_mm; };
        struct Rim {
            double y = 0.0, z = 0.0;
        };
        const auto rim = [&](double from, double to, double sign, const auto& height) {
            Rim best{from, -sign * HUGE_VAL};
            for (int i = 0; i <= 24; ++i) {
                const double y = from + (to - from) * i / 24.0, z = height(y);
                if (std::isfinite(z) && sign * z > sign * best.z) best = {y, z};
            }
            return best;
        };
        const double span = 8.0_mm, out = 3.0_mm;
        const Rim back_top = rim(middle.back - span, middle.back + out, 1, height_over),
                  back_bottom = rim(middle.back - span, middle.back + out, -1, height_under),
                  front_top = rim(middle.front + span, middle.front - out, 1, height_over),
                  front_bottom = rim(middle.front + span, middle.front - out, -1, height_under);
        const double back = back_top.z - back_bottom.z, front = front_top.z - front_bottom.z;
        const double apart = 0.5 * (back_top.y + back_bottom.y - front_top.y - front_bottom.y);
        const double wedge = 2.0 * std::atan(0.5 * (back - front) / apart);

        const auto largest = [&](double low, double high, const auto& size) {
            double max = 0.0;
            for (int i = 0; i <= 30; ++i) max = std::max(max, size(low + (high - low) * i / 30.0));
            return max;
        };
        const double top = std::max(back_top.z, front_top.z), bottom = std::min(back_bottom.z, front_bottom.z),
                     third = (top - bottom) / 3.0;
        const auto width = [&](double z) { return width_at(z); };
        double wall = 0.0;
        const auto depth = [&](double z) {
            const Depth found = depth_at(z);
            wall = std::max(wall, found.back);
            return found.size();
        };
        add("upper_end_plate.width", largest(top - third, top, width));
        add("upper_end_plate.depth", largest(top - third, top, depth));
        add("lower_end_plate.width", largest(bottom, bottom + third, width));
        add("lower_end_plate.depth", largest(bottom, bottom + third, depth));
        wall_ = wall;
        // The rim is round: its crest lies in front of the wall, where a wedge is higher or lower.
        const double to_wall = wall - 0.5 * (back_top.y + back_bottom.y);
        add("body.height", back + to_wall * 2.0 * std::tan(0.5 * wedge));
        add("body.wedge", wedge);
    }

    void measure_canal() {
        double depth = HUGE_VAL;
        for (int i = 0; i <= 60; ++i)
            depth = std::min(depth, lines_.across({0, in_canal_.y, in_canal_.z - 0.5_mm * i}, {0, 1, 0}).size());
        add("canal.width", lines_.across({0, isthmus_.y, isthmus_.z}, {1, 0, 0}).size());
        add("canal.depth", depth);
    }

    void measure_pedicle() {
        // Where it is narrowest behind the wall of the body.
        const double to_wall = (wall_ - pedicle_from_.y) / along_.y;
        const Vec3 side = normalized(cross(Vec3{0, 0, 1}, along_)), up = normalized(cross(along_, side));
        constexpr int stations = 31;  // from 1.5 to 9 mm behind the wall
        const auto station = [&](int i) { return pedicle_from_ + (to_wall - 1.5_mm - 0.25_mm * i) * along_; };
        std::array<double, stations> widths{};
        for (int i = 0; i < stations; ++i) widths[static_cast<std::size_t>(i)] = lines_.across(station(i), side).size();
        const double narrowest = *std::min_element(widths.begin(), widths.end());
        int count = 0;  // the middle of the narrow stretch: where exactly it is narrowest is chance
        for (int i = 0; i < stations; ++i)
            if (widths[static_cast<std::size_t>(i)] < 1.02 * narrowest) isthmus_ = isthmus_ + station(i), ++count;
        if (count == 0) return;  // no bone on the axis
        isthmus_ = (1.0 / count) * isthmus_;
        add("pedicle.width", narrowest);
        add("pedicle.height", lines_.across(isthmus_, up).size());
        // The middle between both sides, and the upper border. The lower one may lead into the lamina at once.
        const auto border_at = [&](double ahead) {
            const Vec3 at = isthmus_ + ahead * along_;
            return at + lines_.across(at, side).middle() * side + lines_.to_border(at, up) * up;
        };
        const Vec3 ahead = border_at(1.0_mm), behind = border_at(-1.0_mm), d = ahead - behind;
        add("pedicle.transverse_angle", std::atan2(isthmus_.x < 0.0 ? d.x : -d.x, -d.y));
        add("pedicle.sagittal_angle", std::atan2(-d.z, -d.y));
    }

    void measure_processes() {
        double half = 0.0, tip = 0.0;
        for (double y = in_canal_.y - 10.0_mm; y <= in_canal_.y + 30.0_mm; y += 1.0_mm)
            for (double z = in_canal_.z - 16.0_mm; z <= in_canal_.z + 16.0_mm; z += 1.0_mm) {
                const double far = lines_.to_border({-100.0_mm, y, z}, {1, 0, 0});
                if (std::isfinite(far)) half = std::max(half, 100.0_mm - far);
            }
        for (double z = in_canal_.z - 50.0_mm; z <= in_canal_.z; z += 1.0_mm) {
            const double far = lines_.to_border({0, 110.0_mm, z}, {0, -1, 0});
            if (std::isfinite(far)) tip = std::max(tip, 110.0_mm - far);
        }
        add("transverse_processes.width", 2.0 * half);
        add("spinous_process.length", tip - wall_);
    }

    Lines lines_;
    Vec3 in_canal_, pedicle_from_, along_;
    Vec3 isthmus_{};     ///< the middle of the pedicle where it is narrowest
    double wall_ = 0.0;  ///< y of the posterior wall of the body
    std::vector<MeasuredDimension> found_;
};

}  // namespace

std::vector<MeasuredDimension> measured_vertebra(const Anatomy& anatomy) {
    const LandmarkAxis* axis = find_id(anatomy.axes, "right_pedicle");
    const LandmarkPoint* point = find_id(anatomy.points, "midline");
    if (axis == nullptr || point == nullptr || anatomy.phantom.parts.empty()) return {};
    return VertebraMeter(anatomy, *axis, point->at).measure();
}

}  // namespace kerf::documents
