// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/exact_burr.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "studies/chart/along_edge.h"
#include "studies/chart/setting.h"

namespace kerf::chart {

namespace {

constexpr int half_count = 32;  // meridians on either side of v·n = 0
constexpr int looks = 64;       // along a meridian, closer to each other near the tip

}  // namespace

std::vector<std::string> BallBurr::parameters() {
    return {"diameter",    "neck_diameter", "blades",       "spindle_speed", "thrust_edge",
            "thrust_chip", "cutting_edge",  "cutting_chip", "edge_depth",    "reference_density"};
}

BallBurr::BallBurr(const Values& values)
    : radius(0.5 * values.at("diameter")),
      neck_radius(0.5 * values.at("neck_diameter")),
      blades(values.at("blades")),
      speed(values.at("spindle_speed")),
      thrust{values.at("thrust_edge"), values.at("edge_depth"), values.at("thrust_chip")},
      cutting{values.at("cutting_edge"), values.at("edge_depth"), values.at("cutting_chip")},
      reference_density(values.at("reference_density")) {}

std::optional<Vec6> ExactBurr::tick(const Pose& body_from_tool, const Vec6& rate) {
    const double r = burr_.radius, blade_rate = burr_.blades * std::abs(burr_.speed);
    const double sense = burr_.speed < 0.0 ? -1.0 : 1.0;
    const Vec3 middle{0, 0, -r}, way = linear(rate) + cross(angular(rate), middle);
    swept_.go_to(body_from_tool * middle);
    if (!(length(way) > 1e-12)) return Vec6{};
    swept_.look_ahead(rotate(body_from_tool.rotation, way));

    const double last = std::sqrt(pi - std::asin(burr_.neck_radius / r));  // s = √θ where the ball meets its neck
    const double ahead = std::atan2(way.y, way.x);
    Vec3 force{}, torque{};
    double flow = 0.0;
    for (const double half : {0.0, pi})
        for (int k = 0; k < half_count; ++k) {
            const double u = pi * ((k + 0.5) / half_count - 0.5);
            const double phi = ahead + half + 0.5 * pi * std::sin(u);
            const double dphi = 0.5 * pi * std::cos(u) * pi / half_count;
            const double c = std::cos(phi), s = std::sin(phi);
            const auto normal_at = [&](double theta) {
                const double sine = std::sin(theta);
                return Vec3{sine * c, sine * s, std::cos(theta)};
            };
            const auto into = [&](Vec3 n) { return dot(rate_at(middle + r * n, n), rate); };
            const auto tissue = [&](double root) {
                const Vec3 n = normal_at(root * root);
                if (!(into(n) > 0.0)) return -1;
                const Vec3 at = body_from_tool * (middle + r * n);
                const int in = bone_->tissue_at(at);
                return in >= 0 && swept_.holds(at) ? -1 : in;
            };
            for_stretches<24>(0.0, last, looks, tissue, [&](double from, double to, int in) {
                const double m = resistance_of_density(bone_->tissues[static_cast<std::size_t>(in)].density,
                                                       burr_.reference_density);
                for_gauss_points(from, to, [&](double root, double droot) {
                    const double theta = root * root, dtheta = 2.0 * root * droot;
                    const Vec3 n = normal_at(theta), at = middle + r * n, with_the_turn{-sense * s, sense * c, 0.0};
                    const double v = into(n), t = v / blade_rate;
                    const double width = m * burr_.blades / (2.0 * pi) * r * dtheta * dphi;
                    const Vec3 f = -width * (force_per_width(t, burr_.thrust) * n +
                                             force_per_width(t, burr_.cutting) * with_the_turn);
                    force = force + f;
                    torque = torque + cross(at, f);
                    flow += v * r * r * std::sin(theta) * dtheta * dphi;
                });
            });
        }
    volume_ += flow * dt;
    return make_vec6(force, torque);
}

}  // namespace kerf::chart
