// SPDX-License-Identifier: Apache-2.0
// Forces of the oscillating saw beside what [hsieh-2006] says a saw's forces do, and beside that paper's law as printed
// (studies/papers/as_printed): on a prescribed way, without a hand. Checks 03-05 … 03-09.
//
//     bench_saw_traces [FOLDER]   prints what was found; writes saw-traces.svg and saw-traces.csv into the folder
//
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/sawing/saw_force.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "studies/papers/as_printed/hsieh_2006.h"
#include "tests/support/saw_rig.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using namespace literals;
using as_printed::Hsieh2006;
using drawing::Curve;
using drawing::figure;
using drawing::Panel;

constexpr double outer = 13.0_mm, inner = 5.3_mm;  // of a femur's shaft
enum Colour : int { ours_colour, printed_colour = 8, exact_colour = 6, other_colour = 3 };

// ---- two saws
// ---------------------------------------------------------------------------------------------------------------

ToolSetup printed_saw(const std::map<std::string, double>& set = {}) {
    static const PluginRegistry registry = [] {
        PluginRegistry r;
        r.scan({KERF_BUILD_DIR "/lib/kerf-papers"});
        return r;
    }();
    ToolSetup setup;
    setup.tool = registry.find("papers.as_printed", KERF_KIND_TOOL, "paper_saw");
    setup.force = registry.find("papers.as_printed", KERF_KIND_FORCE, "hsieh_2006");
    if (setup.tool == nullptr || setup.force == nullptr)
        throw std::runtime_error("no as_printed plugin in lib/kerf-papers");
    for (const auto& info : registry.catalog()) {
        if (info.id == "paper_saw") {
            setup.tool_parameters = test::values(info.parameters, set);
            setup.drives = test::values(info.drives, set);
        }
        if (info.id == "hsieh_2006") setup.force_parameters = test::values(info.parameters, set);
    }
    return setup;
}

struct Felt {
    double across, along, against;  ///< [N] sizes with sign: the blade's y, its x, and the feed
};

/// A saw on its way straight down, at a feed that is prescribed.
struct Feeding {
    const Body& body;
    ToolSetup setup;
    Vec3 entry;
    double depth = -1.0_mm;
    Simulation simulation;

    Feeding(const Body& bone, ToolSetup saw, Vec3 where = {})
        : body(bone),
          setup(std::move(saw)),
          entry(where),
          simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(depth, 0.0, entry)) {}

    Felt go(double feed) {
        depth += feed * Simulation::dt;
        const TickResult r = simulation.tick_direct({test::at_depth(depth, 0.0, entry)});
        const Quat tool_from_world = inverse(r.world_from_tool).rotation;
        const Vec3 on_saw = rotate(tool_from_world, linear(r.bone_on_tool));
        return {on_saw.y, on_saw.x, -on_saw.z};
    }
    void to(double target, double feed = 8.0_mm_per_s) {
        while (depth < target - 1e-12) (void)go(feed);
    }
    [[nodiscard]] Hsieh2006::Signals printed_signals() const { return signals_of<Hsieh2006>(simulation.signals()); }
    [[nodiscard]] sawing::SawCutting::Signals signals() const {
        return signals_of<sawing::SawCutting>(simulation.signals());
    }
    [[nodiscard]] sawing::SawBlade blade() const {
        return value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    }
};

Body wide_block() {
    return test::block({-30.0_mm, -3.0_mm, -12.0_mm}, {30.0_mm, 3.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73});
}

/// Thrust of a tooth straight in front, in the mean over the oscillation [N].
double mean_tooth(const Feeding& saw, double feed) {
    const sawing::Stroke stroke{saw.blade().stroke(), saw.blade().pitch, saw.setup.drives[0]};
    double sum = 0.0;
    for (const auto& part : sawing::parts_of(stroke))
        sum += part.time_fraction * saw.blade().kerf() *
               force_per_width(part.chip_per_feed * feed,
                               value_of<sawing::SawCutting>(saw.setup.force_parameters).thrust());
    return sum;
}

/// One of the three forces of a tooth as printed [N].
double printed_tooth(const Feeding& saw, double Hsieh2006::*which, double feed) {
    const auto law = value_of<Hsieh2006>(saw.setup.force_parameters);
    const auto tool = value_of<as_printed::PaperSaw>(saw.setup.tool_parameters, saw.setup.drives);
    return law.*which * as_printed::chip_as_printed(law.tooth_width, tool.tooth_pitch, feed, tool.oscillation);
}

// ---- the panels
// -------------------------------------------------------------------------------------------------------------

Curve line(const std::string& name, int colour, bool is_dashed = false) {
    return {.name = name, .colour = colour, .is_dashed = is_dashed, .has_dots = false};
}
Curve dots(const std::string& name, int colour) { return {.name = name, .colour = colour, .has_line = false}; }
void add(Curve& curve, double x, double y) { curve.markers.push_back({.x = x, .y = y}); }

/// How many pitches of the front's arc lie in the tube, the tip at `depth` below its highest line.
double teeth_in_tube(const sawing::SawBlade& blade, double depth) {
    constexpr int steps = 4000;
    int in = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = blade.half_front() * (2.0 * (i + 0.5) / steps - 1.0);
        const double x = blade.radius * std::sin(angle), z = outer - depth + blade.radius * (1.0 - std::cos(angle)),
                     r = std::hypot(x, z);
        in += r < outer && r > inner;
    }
    return blade.tooth_count * in / steps;
}

/// 03-09. Through the tube at 8 mm/s, drawn back by 1.5 mm three times.
Panel tube_cut() {
    const Body body = test::tube(outer, inner, 3.0_mm, 0.25_mm);
    constexpr double feed = 8.0_mm_per_s;
    Feeding saw(body, test::saw(), {0, 0, outer});
    const double per_tooth = mean_tooth(saw, feed);
    Curve exact = line("chord/pitch", exact_colour, true), ours = line("thrust/tooth", ours_colour);
    double deepest = -1.0, worst = 0.0, still_felt = 0.0;
    int tick = 0;
    const auto go = [&](double rate) {
        const double thrust = saw.go(rate).against;
        const bool is_at_front = saw.depth > deepest;
        deepest = std::max(deepest, saw.depth);
        const double teeth = is_at_front ? teeth_in_tube(saw.blade(), saw.depth) : 0.0;
        const bool is_clear = saw.depth < deepest - 0.5_mm;
        if (is_at_front) worst = std::max(worst, std::abs(thrust / per_tooth - teeth));
        if (is_clear) still_felt = std::max(still_felt, std::abs(thrust));
        if (tick++ % 8 != 0) return;
        add(exact, tick * Simulation::dt, teeth);
        add(ours, tick * Simulation::dt, thrust / per_tooth);
    };
    for (const double until : {4.0_mm, 13.0_mm, 22.0_mm, 29.0_mm}) {
        while (saw.depth < until) go(feed);
        if (until == 29.0_mm) break;
        for (const double from = saw.depth; saw.depth > from - 1.5_mm;) go(-20.0_mm_per_s);
    }
    std::printf("03-09  load is that of the teeth in bone: off by %.2f teeth at most (bar 1, and the front's slant of "
                "4 %%); drawn back %.3f N\n",
                worst, still_felt);
    return {.title = "03-09  A tube sawn through, drawn back three times",
            .x = {"time [s]", false, 0.0, 4.5},
            .y = {"thrust / that of one tooth", false, 0.0, 20.0},
            .curves = {exact, ours}};
}

/// 03-08. Feed 6 mm/s, all teeth in bone.
Panel sideways(const Body& body) {
    Curve ours = dots("Kerf", ours_colour), printed = dots("as printed", printed_colour);
    double worst = 0.0;
    for (int n = 1; n <= 12; ++n) {
        Feeding saw(body, test::saw({{"tooth_count", n}}));
        saw.to(5.0_mm);
        Felt felt{};
        for (int i = 0; i < 20; ++i) felt = saw.go(6.0_mm_per_s);
        const double radial = value_of<sawing::SawCutting>(saw.setup.force_parameters).set_share * felt.against / n;
        add(ours, n, std::abs(felt.across) / radial);
        worst = std::max(worst, std::abs(ours.markers.back().y - n % 2));

        Feeding paper(body, printed_saw({{"tooth_count", n}}));
        paper.to(5.0_mm);
        for (int i = 0; i < 20; ++i) (void)paper.go(1.0_mm_per_s);
        add(printed, n,
            std::abs(paper.printed_signals().f_y) / printed_tooth(paper, &Hsieh2006::k_radial, 1.0_mm_per_s));
    }
    std::printf("03-08  across the blade what the unpaired tooth leaves: off by %.3f of a tooth at most\n", worst);
    return {.title = "03-08  Across the blade: the unpaired tooth",
            .x = {"teeth in bone", false, 0.0, 13.0},
            .y = {"force across / that of one tooth", false, 0.0, 12.5},
            .curves = {printed, ours}};
}

/// 03-07. In the middle of the swing, 20 oscillations a second, 2 mm/s; wider fronts have teeth at larger angles.
Panel angles(const Body& body) {
    Curve normal = line("Kerf, feed", ours_colour), lateral = line("Kerf, stroke", other_colour),
          printed = line("as printed, stroke", printed_colour);
    constexpr double feed = 2.0_mm_per_s, rate = 20.0;
    for (const double n : {2.0, 6.0, 10.0, 16.0, 24.0, 32.0, 44.0, 60.0}) {
        const std::map<std::string, double> set{{"tooth_count", n},
                                                {"tooth_pitch", 0.7_mm},
                                                {"stroke_rate", rate},
                                                {"oscillation", rate},
                                                {"motor_torque", 5000.0_Nmm}};
        Feeding saw(body, test::saw(set));
        saw.to(8.0_mm);
        Felt middle = saw.go(feed);  // of the swing, where the teeth are fastest and chips thinnest
        for (int i = 0; i < 100; ++i)
            if (const Felt felt = saw.go(feed); felt.against < middle.against) middle = felt;
        const auto law = value_of<sawing::SawCutting>(saw.setup.force_parameters);
        const double chip = sawing::chip_per_feed({saw.blade().stroke(), saw.blade().pitch, rate}, 1.0) * feed;
        const double degrees = saw.blade().half_front() / 1.0_deg;
        add(normal, degrees, middle.against / (n * saw.blade().kerf() * force_per_width(chip, law.thrust())));
        add(lateral, degrees, std::abs(middle.along) / (n * saw.blade().kerf() * force_per_width(chip, law.cutting())));

        Feeding paper(body, printed_saw(set));
        paper.to(8.0_mm);
        double sum = 0.0;
        for (int i = 0; i < 100; ++i) {
            (void)paper.go(feed);
            sum += paper.printed_signals().f_x / 100.0;
        }
        add(printed, degrees, std::abs(sum) / (n * printed_tooth(paper, &Hsieh2006::k_lateral, feed)));
    }
    std::printf("03-07  front of %.1f deg to either side: feed/normal %.3f, stroke/lateral %.3f (1 at small angles); "
                "as printed %.2f\n",
                normal.markers[0].x, normal.markers[0].y, lateral.markers[0].y, printed.markers[0].y);
    return {.title = "03-07  Small angles: feed meets normal, stroke lateral forces",
            .x = {"last tooth's angle [deg]", false, 0.0, 22.0},
            .y = {"feed / sum of normal, stroke / sum of lateral forces", false, 0.0, 2.0},
            .curves = {printed, normal, lateral}};
}

struct Recorded {
    std::vector<double> along, against;
    double vibration = 0.0;  ///< [N] of the last tick
};
Recorded recorded(const Body& body, double rate) {
    Feeding saw(body, test::saw({{"stroke_rate", rate}}));
    saw.to(5.0_mm);
    Recorded record;
    for (int i = 0; i < 1000; ++i) {
        const Felt felt = saw.go(2.0_mm_per_s);
        record.along.push_back(felt.along);
        record.against.push_back(felt.against);
        record.vibration = saw.signals().vibration;
    }
    return record;
}
/// Amplitudes at 0, 1 … 499 Hz of a second of ticks, its mean left out.
std::vector<double> spectrum_of(const std::vector<double>& force) {
    double mean = 0.0;
    for (const double f : force) mean += f / static_cast<double>(force.size());
    std::vector<double> amplitude;
    for (int hertz = 0; hertz < 500; ++hertz) {
        std::complex<double> sum{};
        for (std::size_t i = 0; i < force.size(); ++i)
            sum += (force[i] - mean) * std::polar(1.0, -2.0 * pi * hertz * static_cast<double>(i) * Simulation::dt);
        amplitude.push_back(2.0 * std::abs(sum) / static_cast<double>(force.size()));
    }
    return amplitude;
}
int peak_of(const std::vector<double>& amplitude) {
    return static_cast<int>(std::max_element(amplitude.begin(), amplitude.end()) - amplitude.begin());
}

/// 03-06, as time goes.
Panel strokes(const Recorded& slow) {
    Curve along = line("along the teeth", other_colour), against = line("against the feed", ours_colour);
    for (int i = 0; i < 150; ++i) {
        add(along, i, slow.along[static_cast<std::size_t>(i)]);
        add(against, i, slow.against[static_cast<std::size_t>(i)]);
    }
    return {.title = "03-06  Twenty oscillations a second: forces as they swing",
            .x = {"time [ms]", false, 0.0, 150.0},
            .y = {"force [N]", false, -150.0, 350.0},
            .curves = {along, against}};
}

/// 03-06, by frequency; at 200 oscillations a second the force does not swing, and `vibration` says by how much it
/// would.
Panel spectra(const Body& body, const Recorded& slow) {
    std::vector<Curve> curves;
    const auto draw = [&](const std::string& name, int colour, const std::vector<double>& amplitude) {
        Curve curve = line(name, colour);
        for (int hertz = 1; hertz < 500; ++hertz)
            add(curve, hertz, std::max(1e-3, amplitude[static_cast<std::size_t>(hertz)]));
        curves.push_back(curve);
    };
    for (const double rate : {20.0, 80.0}) {
        const Recorded record = rate == 20.0 ? slow : recorded(body, rate);
        const std::vector<double> along = spectrum_of(record.along);
        std::printf("03-06  %.0f oscillations a second: peak along the teeth at %d Hz (bar ±1), against the feed at %d "
                    "Hz: both strokes push alike\n",
                    rate, peak_of(along), peak_of(spectrum_of(record.against)));
        draw(figure(rate) + " /s", rate == 20.0 ? other_colour : 5, along);
    }
    const Recorded fast = recorded(body, 200.0);
    const std::vector<double> along = spectrum_of(fast.along);
    std::printf("03-06  200 oscillations a second: %.4f N at most in the force; `vibration` is %.1f N at the rate of "
                "`stroke_rate`\n",
                *std::max_element(along.begin(), along.end()), fast.vibration);
    draw("200 /s", ours_colour, along);
    Curve vibration = dots("vibration, 200 /s", ours_colour);
    vibration.markers.push_back({.x = 200.0, .y = fast.vibration, .is_filled = false});
    curves.push_back(vibration);
    return {.title = "03-06  By frequency: the rate it oscillates with",
            .x = {"frequency [Hz]", true, 1.0, 500.0},
            .y = {"force along the teeth [N]", true, 1e-3, 1e3},
            .curves = curves};
}

/// 03-05. At 200 oscillations a second, in the mean over the oscillation; both 1 at a chip of 1 µm.
Panel proportions(const Body& body) {
    Curve printed = dots("as printed", printed_colour), ours = dots("Kerf", ours_colour);
    printed.has_line = ours.has_line = true;
    double printed_once = 0.0, ours_once = 0.0;
    const auto thrust = [&](const ToolSetup& setup, double feed) {
        Feeding saw(body, setup);
        saw.to(5.0_mm);
        Felt felt{};
        for (int i = 0; i < 10; ++i) felt = saw.go(feed);
        return felt.against;
    };
    Feeding blade(body, test::saw());
    const double chip_per_feed = sawing::mean_chip_per_feed({blade.blade().stroke(), blade.blade().pitch, 200.0});
    const auto chips = {1.0_um, 2.0_um, 5.0_um, 10.0_um};
    for (const double chip : chips) {
        const double feed = chip / chip_per_feed, of_printed = thrust(printed_saw({{"swing", 0.0}}), feed),
                     of_ours = thrust(test::saw(), feed);
        if (printed_once == 0.0) printed_once = of_printed;
        if (ours_once == 0.0) ours_once = of_ours;
        add(printed, chip / 1.0_um, of_printed / printed_once);
        add(ours, chip / 1.0_um, of_ours / ours_once);
    }
    const auto growth = [](const Curve& curve) { return curve.markers[3].y / curve.markers[1].y; };
    const double once = thrust(printed_saw({{"swing", 0.0}}), 1.0_mm_per_s);
    const double twice = thrust(printed_saw({{"swing", 0.0}, {"oscillation", 400.0}}), 1.0_mm_per_s);
    std::printf("03-05  from 2 to 10 um of chip: as printed x %.2f, Kerf x %.2f (bone: x 1.3); at twice the rate as "
                "printed x %.2f\n",
                growth(printed), growth(ours), twice / once);
    return {.title = "03-05  Force in proportion to the feed: as printed only",
            .x = {"chip [um], in the mean", true, 1.0, 10.0},
            .y = {"thrust / that at 1 um", true, 0.8, 12.0},
            .curves = {printed, ours}};
}

std::string table_of(const std::vector<Panel>& panels) {
    std::string text = "panel,curve,x,y\n";
    for (const Panel& panel : panels)
        for (const Curve& curve : panel.curves)
            for (const auto& m : curve.markers)
                text += drawing::csv_quoted(panel.title) + "," + drawing::csv_quoted(curve.name) + "," +
                        figure(m.x, 5) + "," + figure(m.y, 5) + "\n";
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    const Body block = wide_block();
    const Recorded slow = recorded(block, 20.0);
    const std::vector<Panel> panels{tube_cut(),         sideways(block), angles(block),
                                    proportions(block), strokes(slow),   spectra(block, slow)};
    if (argc < 2) return 0;
    const std::filesystem::path folder = argv[1];
    constexpr double width = 560, height = 320;
    std::string content;
    for (std::size_t n = 0; n < panels.size(); ++n)
        content += panel_svg(panels[n], 10.0 + width * static_cast<double>(n % 2),
                             10.0 + height * static_cast<double>(n / 2), width, height);
    std::filesystem::create_directories(folder);
    const std::string picture =
        drawing::picture(2.0 * width + 20.0, 3.0 * height + 20.0, "Forces of an oscillating saw", content);
    for (const std::string& error : {text::write_file(folder / "saw-traces.svg", picture),
                                     text::write_file(folder / "saw-traces.csv", table_of(panels))})
        if (!error.empty()) {
            std::fprintf(stderr, "%s\n", error.c_str());
            return 1;
        }
    return 0;
}
