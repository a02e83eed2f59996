// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/physics/published.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "kerf/units.hpp"
#include "studies/chart/drill/reference.h"
#include "studies/drawing/svg.h"

namespace kerf::chart {

using namespace literals;

namespace {

using drawing::figure;

constexpr double bovine_drill = 2.5e-3;      // [m] [orelaja-2020]
constexpr double bovine_feed_rate = 1.0e-3;  // [m/s] not reported [assumed]; any feed misses the measurement

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantity_of(const PublishedMean& mean, bool of_torque) { return of_torque ? mean.torque : mean.thrust; }

/// Largest thrust of the exact law on a way, from one depth to another [N].
double peak_thrust(const Scene& scene, const CuttingLaw& law, double from, double to) {
    ExactForce exact(scene, law);
    double most = 0.0;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        const double rate = (scene.depth[t + 1] - scene.depth[t]) / dt;
        const double thrust = -exact.wrench(scene.pose_at(scene.depth[t]), rate,
                                            2.0 * pi * scene.spindle * dt * static_cast<double>(t))[2];
        if (scene.depth[t] >= from && scene.depth[t] <= to) most = std::max(most, thrust);
    }
    return most;
}

}  // namespace

std::vector<PublishedSeries> published_series() {
    return {
        {"macavelia-2012",
         "human femur",
         2.0_mm_per_s,
         {{1000.0_rpm, 198.4, 14.2, 186.3_Nmm, 16.9_Nmm},
          {1250.0_rpm, 180.6, 14.0, 157.8_Nmm, 16.1_Nmm},
          {1500.0_rpm, 176.3, 11.2, 140.2_Nmm, 16.4_Nmm}}},
        {"macavelia-2012",
         "artificial femur",
         2.0_mm_per_s,
         {{1000.0_rpm, 87.2, 19.3, 67.2_Nmm, 8.4_Nmm},
          {1250.0_rpm, 82.2, 11.2, 61.0_Nmm, 2.9_Nmm},
          {1500.0_rpm, 75.7, 8.8, 53.3_Nmm, 2.9_Nmm}}},
        {"orelaja-2020", "bovine", 0.0, {{1000.0_rpm, 20.07, 0, 41.2_Nmm, 0}, {1500.0_rpm, 12.34, 0, 24.2_Nmm, 0}}},
        {"orelaja-2020", "porcine", 0.0, {{1000.0_rpm, 11.25, 0, 37.0_Nmm, 0}, {1500.0_rpm, 8.14, 0, 21.6_Nmm, 0}}},
        {"orelaja-2020", "artificial", 0.0, {{1000.0_rpm, 5.62, 0, 13.6_Nmm, 0}, {1500.0_rpm, 3.86, 0, 6.7_Nmm, 0}}},
    };
}

std::vector<FeedLaw> fitted_laws(const PublishedSeries& series, bool of_torque) {
    const std::size_t last = series.means.size() - 1;
    // Where the feed was not seen, only its ratio counts: a fixed feed speed is assumed.
    const auto feed = [&](std::size_t i) {
        return (series.feed_rate > 0.0 ? series.feed_rate : 1e-3) / series.means[i].speed;
    };
    const double f0 = feed(0), f1 = feed(last);
    const double y0 = quantity_of(series.means[0], of_torque), y1 = quantity_of(series.means[last], of_torque);
    const double chip = (y0 - y1) / (f0 - f1), edge = y0 - chip * f0, power = std::log(y0 / y1) / std::log(f0 / f1);
    return {{"proportional", {0}, [=](double f) { return y0 * f / f0; }},
            {"edge + chip", {0, last}, [=](double f) { return edge + chip * f; }},
            {"power", {0, last}, [=](double f) { return y0 * std::pow(f / f0, power); }}};
}

double shared_law_at(const CuttingLaw& law, double feed, bool of_torque, double diameter) {
    const Drill drill{diameter, 118.0 * pi / 180.0, 0.15};
    const Vec6 wrench = edge_wrench(drill, law, wholly_engaged(drill), 0.0, 0.5 * feed);
    return of_torque ? -wrench[5] : -wrench[2];
}

std::vector<Prediction> predictions(const CuttingLaw& law) {
    std::vector<Prediction> all;
    for (const PublishedSeries& series : published_series())
        for (const bool of_torque : {false, true}) {
            const auto add = [&](const char* name, std::size_t i, double predicted) {
                const PublishedMean& mean = series.means[i];
                all.push_back({series.source, series.tissue, name, of_torque ? "torque" : "thrust", mean.speed,
                               predicted, quantity_of(mean, of_torque), of_torque ? mean.torque_sd : mean.thrust_sd,
                               series.feed_rate > 0.0});
            };
            const double feed_rate = series.feed_rate > 0.0 ? series.feed_rate : 1e-3;
            for (const FeedLaw& fitted : fitted_laws(series, of_torque))
                for (std::size_t i = 0; i < series.means.size(); ++i)
                    if (std::find(fitted.calibrated_on.begin(), fitted.calibrated_on.end(), i) ==
                        fitted.calibrated_on.end())
                        add(fitted.name, i, fitted.at(feed_rate / series.means[i].speed));
            if (std::string(series.tissue) == "human femur")
                add("Kerf", 1, shared_law_at(law, series.feed(series.means[1]), of_torque));
            if (std::string(series.tissue) == "bovine")
                for (std::size_t i = 0; i < series.means.size(); ++i)
                    add("Kerf", i,
                        shared_law_at(law, bovine_feed_rate / series.means[i].speed, of_torque, bovine_drill));
        }
    return all;
}

namespace {

using Checks = std::vector<Check>;

/// B1-a: laws set in some spindle speeds, at another one.
void add_feed_checks(const CuttingLaw& law, Checks& checks) {
    const auto predicted = predictions(law);
    const auto off = [&](const char* name, const char* quantity, double speed) {
        for (const Prediction& p : predicted)
            if (p.law == name && p.quantity == quantity && p.tissue == "human femur" && p.speed == speed) return p;
        return Prediction{};
    };
    const auto in_words = [](const Prediction& p) {
        const double unit = p.quantity == "torque" ? 1e3 : 1.0;
        return figure(unit * p.predicted, 4) + " against " + figure(unit * p.measured, 4) +
               (unit > 1.0 ? " N mm" : " N") + ", " + figure(p.off_in_sd(), 2) + " SD";
    };
    for (const char* quantity : {"thrust", "torque"}) {
        const Prediction p = off("proportional", quantity, 1500.0_rpm);
        checks.push_back({"B1-a", std::string("proportional, from 1000 rpm: ") + quantity + " at 1500 rpm", in_words(p),
                          "within 1 SD", std::abs(p.off_in_sd()) <= 1.0, "one constant, one mean; no edge term"});
    }
    for (const char* name : {"edge + chip", "Kerf", "power"})
        for (const char* quantity : {"thrust", "torque"}) {
            const Prediction p = off(name, quantity, 1250.0_rpm);
            const bool is_kerf = std::string(name) == "Kerf";
            checks.push_back({"B1-a",
                              std::string(name) + (is_kerf ? ", from all three: " : ", from 1000 and 1500 rpm: ") +
                                  quantity + " at 1250 rpm",
                              in_words(p), "within 1 SD", std::abs(p.off_in_sd()) <= 1.0,
                              is_kerf ? "the plugin's law along its edges; its line is the least-squares one through "
                                        "all three means: agreement, no prediction"
                                      : "two constants, two means"});
        }
}

/// B1-b: which tissue resists more.
void add_tissue_checks(const CuttingLaw& law, Checks& checks) {
    const double cortical = shared_law_at(law, 0.12_mm, false), cancellous = law.resistance(353.0) * cortical;
    checks.push_back({"B1-b", "cortical resists more than cancellous bone",
                      figure(cortical) + " N at 1.85 g/cm3, " + figure(cancellous) + " N at 0.353 g/cm3",
                      "in this order", cortical > cancellous,
                      "cancellous by the square of density [carter-hayes-1977], not calibrated"});
    const std::vector<PublishedSeries> all = published_series();
    const bool is_ordered = all[0].means[0].thrust > all[1].means[0].thrust &&
                            all[2].means[0].thrust > all[3].means[0].thrust &&
                            all[3].means[0].thrust > all[4].means[0].thrust;
    checks.push_back({"B1-b", "human over artificial; bovine over porcine over artificial",
                      "198 > 87 N; 20.1 > 11.3 > 5.6 N as measured", "in this order", is_ordered,
                      "the measurements among themselves, no check of a law: densities are not reported"});
}

/// B1-c: through a pedicle's wall over along its axis.
void add_breach_checks(const CuttingLaw& law, std::span<const AwlWay> awl, Checks& checks) {
    // Past the shell that the drill enters by; the breach goes through the canal's wall after that.
    const Scene safe = pedicle_scene(0.0), breach = pedicle_scene(medial_breach);
    constexpr double past_entry = 6.0_mm, to = 26.0_mm;
    const double safe_peak = peak_thrust(safe, law, past_entry, to),
                 breach_peak = peak_thrust(breach, law, past_entry, to);
    const auto compare = [&](const std::string& what, double of_breach, double of_safe, const std::string& note) {
        const double ratio = of_breach / of_safe;
        checks.push_back({"B1-c", what, figure(of_breach) + " over " + figure(of_safe) + " N = " + figure(ratio),
                          "1.5 to 1.7", ratio >= 1.5 && ratio <= 1.7, note});
    };
    // Which walls the surgeons broke is not told: both sides on every level, and the means of each side and of both.
    const double along_axis = awl.front().push;
    std::vector<double> medial, lateral;  // [N]
    for (const AwlWay& way : awl) {
        if (way.wall == nullptr) continue;
        (way.wall->is_medial ? medial : lateral).push_back(way.push);
        compare("largest push of an awl aimed " + figure(aimed_wrong) +
                    " degrees beside the axis over that along it, behind the entry: " + way.wall->name(),
                way.push, along_axis,
                figure(way.wall->thickness / 1.0_mm) + " mm [irie-2021], " + figure(100.0 * way.wall->bone()) +
                    " % of it bone, taken for " + (way.wall->is_medial ? "99.8" : "under 64"));
    }
    const std::string measured_as = "the source does not say which walls broke; " + figure(measured_breach_push[0]) +
                                    " to " + figure(measured_breach_push[1]) + " over about " +
                                    figure(measured_safe_push) + " N on average, with wide variations [cors-2013]";
    compare("the same, mean of the lateral walls of L1 to L5", mean_of(lateral), along_axis, measured_as);
    compare("the same, mean of the medial walls of L1 to L5", mean_of(medial), along_axis, measured_as);
    compare("the same, mean of both", 0.5 * (mean_of(lateral) + mean_of(medial)), along_axis, measured_as);
    compare("thrust of a drill that goes 6.3 mm beside the axis over that along it", breach_peak, safe_peak,
            "measured with an awl; phantom with 1 mm of cortex and cancellous bone of 0.25 g/cm3");
}

/// B1-d: thrust against spindle speed.
void add_speed_check(const CuttingLaw& law, const PublishedSeries& human, Checks& checks) {
    bool falls = true;
    std::string found;
    double last = 1e300;
    for (const PublishedMean& mean : human.means) {
        const double thrust = shared_law_at(law, human.feed(mean), false);
        falls = falls && thrust < last;
        last = thrust;
        found += (found.empty() ? "" : ", ") + figure(thrust, 4);
    }
    checks.push_back({"B1-d", "thrust falls as the spindle turns faster at 2 mm/s",
                      found + " N at 1000, 1250, 1500 rpm", "falling", falls, ""});
}

/// B1: how thrust and torque rise with the feed.
void add_exponent_checks(const CuttingLaw& law, const PublishedSeries& human, Checks& checks) {
    // F ∝ f^e, from the slowest spindle to the fastest; its spread is that of the two means.
    const PublishedMean &slow = human.means.front(), &fast = human.means.back();
    const double feeds = std::log(human.feed(slow) / human.feed(fast));
    for (const bool of_torque : {false, true}) {
        const auto sd = [&](const PublishedMean& mean) {
            return (of_torque ? mean.torque_sd : mean.thrust_sd) / quantity_of(mean, of_torque);
        };
        const double measured = std::log(quantity_of(slow, of_torque) / quantity_of(fast, of_torque)) / feeds;
        const double spread = std::hypot(sd(slow), sd(fast)) / feeds;
        const double exponent = std::log(shared_law_at(law, human.feed(slow), of_torque) /
                                         shared_law_at(law, human.feed(fast), of_torque)) /
                                feeds;
        checks.push_back({"B1", std::string("exponent of ") + (of_torque ? "torque" : "thrust") + " in the feed",
                          figure(exponent, 3) + " against " + figure(measured, 3), "within 1 SD, " + figure(spread, 2),
                          std::abs(exponent - measured) <= spread,
                          "from lines through the same means: agreement, no prediction"});
    }
}

/// B1-e: chisel edge and edge force.
void add_edge_checks(const CuttingLaw& law, Checks& checks) {
    CuttingLaw no_chisel = law, edge_only = law;
    no_chisel.chisel = {};
    edge_only.thrust.chip = edge_only.chisel.chip = 0.0;
    const double whole = shared_law_at(law, 0.12_mm, false);
    const double share = 1.0 - shared_law_at(no_chisel, 0.12_mm, false) / whole;
    const double remains = shared_law_at(edge_only, 0.12_mm, false) / whole;
    checks.push_back({"B1-e", "the chisel edge's share of the thrust", figure(100.0 * share) + " %", "about 45 %",
                      std::abs(share - 0.45) < 0.01, "put in: what a split point saves [saha-1982]; no check"});
    checks.push_back({"B1-e", "what remains of the thrust as the feed goes to nothing", figure(100.0 * remains) + " %",
                      "65 % of the line through the means", std::abs(remains - 0.65) < 0.01,
                      "put in: the same line at no feed, where nobody has measured; at standstill the law is zero"});
}

/// B1-f: against a study that the law was not fitted to.
void add_bovine_check(const CuttingLaw& law, const PublishedSeries& bovine, Checks& checks) {
    const double gentle = shared_law_at(law, 0.01_mm, false, bovine_drill),
                 firm = shared_law_at(law, 0.1_mm, false, bovine_drill);
    const double least = gentle / bovine.means.front().thrust, most = firm / bovine.means.back().thrust;
    checks.push_back({"B1-f", "Kerf, calibrated on nothing of this study: thrust of a 2.5 mm drill in bovine femur",
                      figure(gentle) + " to " + figure(firm) + " N at 0.01 to 0.1 mm a revolution, against " +
                          figure(bovine.means.front().thrust, 4) + " and " + figure(bovine.means.back().thrust, 4) +
                          " N: " + figure(least, 2) + " to " + figure(most, 2) + " times",
                      "within a factor of 2", least <= 2.0 && most <= 2.0,
                      "density, feed speed and drill are not reported [orelaja-2020]; studies of cortical bone differ "
                      "tenfold among themselves"});
}

}  // namespace

std::vector<Check> published_checks(const CuttingLaw& law, std::span<const AwlWay> awl) {
    const std::vector<PublishedSeries> all = published_series();
    const PublishedSeries &human = all[0], &bovine = all[2];
    Checks checks;
    add_feed_checks(law, checks);
    add_tissue_checks(law, checks);
    add_breach_checks(law, awl, checks);
    add_speed_check(law, human, checks);
    add_exponent_checks(law, human, checks);
    add_edge_checks(law, checks);
    add_bovine_check(law, bovine, checks);
    return checks;
}

}  // namespace kerf::chart
