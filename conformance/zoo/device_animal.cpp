// SPDX-License-Identifier: Apache-2.0
// A driver of a stylus that circles, with one fault, `kerf_how`, which each library brings along; "device_saint" has
// none. Each test of a driver has an animal here that fails it first.
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <kerf/device_driver.hpp>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

extern "C" __attribute__((visibility("hidden"))) const char kerf_how[];

namespace {

using namespace kerf;

const std::string_view how = kerf_how;
bool is(std::string_view fault) { return how == fault; }
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t some_tick = 400;

// ---- the sound driver ---------------------------------------------------------------------------------------------

class Stylus final : public DeviceLink {
public:
    Stylus() { state_.device_from_handle.rotation.w = 1.0; }
    [[nodiscard]] kerf_device_facts facts() const override {
        return {.name = "circling stylus",
                .abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE,
                .button_count = 2,
                .peak_force = 3.0,
                .continuous_force = 1.0,
                .peak_torque = 0.0,
                .continuous_torque = 0.0,
                .largest_stiffness = 500.0,
                .largest_damping = 2.0,
                .mass = 0.05,
                .resolution = 1e-5,
                .peak_turn_torque = 0.0,
                .continuous_turn_torque = 0.0,
                .turn_resolution = 0.0};
    }
    [[nodiscard]] kerf_device_state read() noexcept override {
        const double angle = 1e-2 * static_cast<double>(++state_.reports);
        state_.device_from_handle.position = {0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.0};
        state_.buttons = static_cast<std::uint32_t>(state_.reports / 100 % 4);
        state_.flags = KERF_DEVICE_VALID;
        return state_;
    }
    void write(const kerf_device_command& /*command*/) noexcept override {}

private:
    kerf_device_state state_{};
};

struct CirclingStylus {
    double wait;  ///< [s]

    static constexpr auto about() {
        using namespace literals;
        return describe("circling_stylus", "A stylus that circles.",
                        param(&CirclingStylus::wait, {.id = "wait",
                                                      .help = "Maximum time to wait for the stylus.",
                                                      .unit = unit::s,
                                                      .min = 0.1_s,
                                                      .max = 10.0_s,
                                                      .def = 1.0_s,
                                                      .source = "made up"}));
    }
    [[nodiscard]] std::vector<DeviceFound> find() const {
        return {{.id = "left", .name = "the left stylus", .problem = ""},
                {.id = "right-2.0", .name = "the right stylus", .problem = "It is switched off."}};
    }
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const {
        if (!request.id().empty() && request.id() != "left") throw std::runtime_error("there is no such stylus");
        return std::make_unique<Stylus>();
    }
};

using Sound = PluginTables<CirclingStylus>;
constexpr const kerf_component& sound = Sound::components[0];
kerf_device driver;
kerf_component component;

// ---- faults of what is found and opened ---------------------------------------------------------------------------

std::uint32_t faulty_find(const double* params, kerf_device_found* found, std::uint32_t capacity) {
    static std::uint32_t calls = 0;
    const std::uint32_t count = sound.device->find(params, found, is("finds_more_than_fit") ? 2 : capacity);
    if (count == 0) return count;
    if (is("forgets_the_end_of_a_name")) std::memset(found->name, 'x', sizeof found->name);
    if (is("spells_its_ids_freely")) std::strcpy(found->id, "left stylus");
    if (is("finds_two_of_one_id") && count > 1) std::strcpy(found[1].id, found[0].id);
    if (is("finds_another_each_time")) std::strcpy(found->id, ("left-" + std::to_string(++calls)).c_str());
    return count;
}

/// Faults of the time and of the texts of `open`.
kerf_status faulty_open(const kerf_device_open_in* in, std::int32_t (*is_cancelled)(void*), void* context,
                        kerf_device_open_out* out) {
    kerf_device_open_in changed = *in;
    if (is("opens_whatever_is_asked")) changed.id = "";
    if (is("waits_in_vain") && is_cancelled(context) != 0) std::this_thread::sleep_for(std::chrono::seconds(6));
    if (is("reads_numbers_from_any_text"))
        for (std::uint32_t i = 0; i < in->setting_count; ++i) static_cast<void>(std::stod(in->settings[i].value));
    const kerf_status status = sound.device->open(&changed, is_cancelled, context, out);
    if (is("is_silent_about_strangers")) out->message[0] = '\0';
    if (is("leaves_its_file")) static_cast<void>(::open("/dev/null", O_RDONLY));
    if (is("leaves_its_memory")) static_cast<void>(new std::vector<char>(10000));
    if (is("leaves_its_thread")) {
        static std::atomic<bool> is_running{false};
        if (!is_running) {
            std::thread([] {
                is_running = true;
                pause();
            }).detach();
            while (!is_running) std::this_thread::yield();  // the plugin may be unloaded before the thread runs
        }
    }
    kerf_device_facts& facts = out->facts;
    if (is("weighs_no_number")) facts.mass = nan_value;
    if (is("has_forty_buttons")) facts.button_count = 40;
    if (is("invents_an_ability")) facts.abilities |= 256;
    if (is("is_stronger_for_long")) facts.continuous_force = 4.0;
    if (is("twists_without_the_ability")) facts.peak_torque = 1.0;
    return status;
}

// ---- faults of an open device -------------------------------------------------------------------------------------

double pushed = 0.0;
void* volatile allocated = nullptr;
pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

void faulty_read(void* device, kerf_device_state* state) {
    sound.device->read(device, state);
    kerf_pose& pose = state->device_from_handle;
    if (is("integrates_any_force")) pose.position.x += pushed;
    if (state->reports < some_tick) return;
    if (is("counts_backwards")) state->reports = some_tick;
    if (is("counts_backwards") && state->buttons == 0) state->reports = some_tick - 1;
    if (is("reports_before_it_is_born")) state->age = -1e-3;
    if (is("loses_its_position")) pose.position.z = nan_value;
    if (is("stretches_its_rotation")) pose.rotation.w = 1.1;
    if (is("turns_without_the_ability")) pose.rotation = {std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0};
    if (is("bends_without_the_ability")) state->deflection[2] = 0.5;
    if (is("presses_a_button_too_many")) state->buttons |= 4;
    if (is("invents_a_flag")) state->flags |= 8;
    if (is("allocates_in_read")) {
        allocated = std::malloc(7);
        std::free(allocated);
    }
    if (is("calls_the_system_in_read")) static_cast<void>(syscall(SYS_getppid));
}

void faulty_write(void* device, const kerf_device_command* command) {
    pushed += 1e-9 * command->force.x;
    if (is("locks_in_write")) {
        pthread_mutex_lock(&mutex);
        pthread_mutex_unlock(&mutex);
    }
    sound.device->write(device, command);
}

void faulty_close(void* device) {
    if (is("takes_long_to_close")) std::this_thread::sleep_for(std::chrono::milliseconds(300));
    sound.device->close(device);
}

kerf_entry filled_entry() {
    driver = *sound.device;
    driver.find = &faulty_find;
    driver.open = &faulty_open;
    driver.read = &faulty_read;
    driver.write = &faulty_write;
    driver.close = &faulty_close;
    component = sound;
    component.device = &driver;
    kerf_entry entry = Sound::entry("example.circling_stylus", "0.1.0", "Apache-2.0");
    entry.components = &component;
    return entry;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry = filled_entry();
