// SPDX-License-Identifier: Apache-2.0
#include "base.h"

#include <cmath>

namespace kerf::force_dimension {

namespace {

constexpr int max_bases = 16;
constexpr int max_buttons = 4;
constexpr double largest_jump = 20e-3;  // [m] between two reads: no hand is so fast
constexpr double settling = 0.1;        // [s] after a jump
constexpr unsigned char on = 1;

std::string serial_of(const Dhd& dhd, char id) {
    unsigned short number = 0;
    return dhd.serial_number(&number, id) >= 0 ? std::to_string(number) : std::string("any");
}

std::string text_of(const char* text) { return text != nullptr ? text : "no reason is given"; }

}  // namespace

std::string Base::last_error() const { return text_of(dhd_->last_error_text()); }

std::string Base::open(const std::string& serial, bool may_move) {
    const int count = dhd_->device_count();
    if (count <= 0)
        return "no device of Force Dimension is connected. Check its power and USB cable, and that this user may open "
               "USB "
               "devices of the maker: 1451.";
    std::string others, refusals;
    for (int index = 0; index < count && index < max_bases; ++index) {
        const int opened = dhd_->open(static_cast<char>(index));
        if (opened < 0) {
            refusals += (refusals.empty() ? "" : "; ") + last_error();
            continue;
        }
        id_ = static_cast<char>(opened);
        serial_ = serial_of(*dhd_, id_);
        if (serial.empty() || serial == serial_) {
            is_open_ = true;
            std::string fault = prepare(may_move);
            if (!fault.empty()) close();
            return fault;
        }
        others += (others.empty() ? "`" : ", `") + serial_ + "`";
        dhd_->close(id_);
    }
    if (!others.empty()) return "no base with the id `" + serial + "` is connected; there is " + others + ".";
    return "the base cannot be opened: " + refusals + ". Another program may use it: end that one.";
}

std::string Base::prepare(bool may_move) {
    model_ = model_of(dhd_->system_type(id_));
    has_wrist_ = dhd_->has_wrist(id_);
    has_position_ = false;
    if (dhd_->is_initialized != nullptr && !dhd_->is_initialized(id_)) {
        if (!may_move)
            return "the base is not calibrated. Calibrate it with the maker's program, or write `settings: {may_move: "
                   "yes}` "
                   "in the station: the arm then moves by itself when Kerf starts. Keep your hands away from it.";
        if (dhd_->initialize == nullptr || dhd_->initialize(id_) < 0)
            return "the base cannot calibrate itself: " + last_error() + ". Free the arm, and try again.";
        if (dhd_->stop_regulation != nullptr) static_cast<void>(dhd_->stop_regulation(true, id_));
    }
    unsigned char steps = 0;
    has_watchdog_ =
        dhd_->set_watchdog(watchdog_steps, id_) >= 0 && dhd_->watchdog(&steps, id_) >= 0 && steps == watchdog_steps;
    if (dhd_->enable_force(on, id_) < 0) return "the base does not enable its forces: " + last_error() + ".";
    return "";
}

void Base::close() noexcept {
    if (!is_open_) return;
    static_cast<void>(dhd_->set_force(0.0, 0.0, 0.0, id_));
    static_cast<void>(dhd_->close(id_));
    is_open_ = false;
}

kerf_device_facts Base::facts() const {
    kerf_device_facts facts{};
    detail::copy_text(facts.name, std::string(model_.is_known ? model_.name : text_of(dhd_->system_name(id_)).c_str()) +
                                      " " + serial_ + (model_.is_known ? "" : " (limits of a Falcon)") +
                                      (has_watchdog_ ? "" : " (no watchdog)"));
    facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE;
    if (has_wrist_) facts.abilities |= KERF_DEVICE_ROTATION;
    facts.button_count = max_buttons;
    facts.peak_force = model_.peak_force;
    facts.continuous_force = 0.25 * model_.peak_force;  // [assumed]: data sheets state none
    facts.largest_stiffness = model_.stiffness;
    facts.largest_damping = model_.damping;
    facts.mass = 0.2;          // [assumed]
    facts.resolution = 30e-6;  // [assumed]: 0.03 mm or finer
    return facts;
}

bool Base::read(double now, kerf_device_state& state) {
    double x = 0.0, y = 0.0, z = 0.0;
    if (dhd_->position(&x, &y, &z, id_) < 0) {
        fault_ = "the base does not answer: " + last_error() + ". Check its USB cable and power.";
        state.flags = 0;
        return false;
    }
    const Vec3 at = to_device({x, y, z});
    std::optional<Quat> rotation = Quat{1, 0, 0, 0};
    double rows[3][3] = {};
    if (has_wrist_) rotation = dhd_->orientation(rows, id_) >= 0 ? rotation_of(rows) : std::nullopt;
    fault_.clear();
    if (!is_finite(at) || !rotation) {
        fault_ = "the base reports a pose that is none. Switch it off and on.";
    } else if (has_position_ && length(at - last_position_) > largest_jump) {
        unsound_until_ = now + settling;
    }
    if (is_finite(at)) {
        last_position_ = at;
        has_position_ = true;
    }
    if (fault_.empty() && now < unsound_until_)
        fault_ = "the position of the handle jumped, so no force is made. If it happens again, calibrate the base.";
    state.flags = fault_.empty() ? std::uint32_t{KERF_DEVICE_VALID} : 0;
    if (!fault_.empty()) return true;
    ++state.reports;
    state.device_from_handle = {at, *rotation};
    state.buttons = 0;
    for (int i = 0; i < max_buttons; ++i)
        if (dhd_->button(i, id_) > 0) state.buttons |= 1u << i;
    return true;
}

bool Base::make(Vec3 force) noexcept {
    const Vec3 of_maker = to_maker(is_finite(force) ? force : Vec3{});
    return dhd_->set_force(of_maker.x, of_maker.y, of_maker.z, id_) >= 0;
}

std::string Base::problem() const {
    if (!fault_.empty() || !is_open_) return fault_;
    int values[status_count] = {};
    return dhd_->status(values, id_) >= 0 ? reason_of_force_off(values[status_force_off]) : std::string();
}

std::vector<DeviceFound> list_bases(const Dhd& dhd) {
    std::vector<DeviceFound> found;
    const int count = dhd.device_count();
    for (int index = 0; index < count && index < max_bases; ++index) {
        const int opened = dhd.open(static_cast<char>(index));
        if (opened < 0) {
            found.push_back({.id = "index-" + std::to_string(index),
                             .name = "a device of Force Dimension",
                             .problem = "it cannot be opened: " + text_of(dhd.last_error_text()) +
                                        ". Another program may use it: end that one."});
            continue;
        }
        const auto id = static_cast<char>(opened);
        found.push_back({.id = serial_of(dhd, id), .name = text_of(dhd.system_name(id)), .problem = ""});
        dhd.close(id);
    }
    return found;
}

}  // namespace kerf::force_dimension
