// SPDX-License-Identifier: Apache-2.0
#include "app/window/glfw_window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace kerf::window {

namespace {

std::string last_fault;  // GLFW reports faults to a function without context

void on_fault(int /*code*/, const char* words) { last_fault = words; }

GlfwWindow* self_of(GLFWwindow* window) { return static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }

int code_of(int key) {
    switch (key) {
        case GLFW_KEY_ESCAPE:
            return Input::escape;
        case GLFW_KEY_TAB:
            return Input::tab;
        case GLFW_KEY_SPACE:
            return Input::space;
        case GLFW_KEY_LEFT_SHIFT:
        case GLFW_KEY_RIGHT_SHIFT:
            return Input::left_shift;
        case GLFW_KEY_F1:
            return Input::f1;
        case GLFW_KEY_F2:
            return Input::f2;
        case GLFW_KEY_F3:
            return Input::f3;
        case GLFW_KEY_F4:
            return Input::f4;
        case GLFW_KEY_F12:
            return Input::f12;
        case GLFW_KEY_LEFT:
            return Input::arrow_left;
        case GLFW_KEY_RIGHT:
            return Input::arrow_right;
        case GLFW_KEY_UP:
            return Input::arrow_up;
        case GLFW_KEY_DOWN:
            return Input::arrow_down;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            return Input::enter;
        case GLFW_KEY_BACKSPACE:
            return Input::backspace;
        case GLFW_KEY_DELETE:
            return Input::erase;
        case GLFW_KEY_HOME:
            return Input::home;
        case GLFW_KEY_END:
            return Input::end;
        default:
            return key < 256 ? key : 0;
    }
}

}  // namespace

std::unique_ptr<GlfwWindow> GlfwWindow::open(const std::string& title, std::string& error) {
    last_fault.clear();
    glfwSetErrorCallback(on_fault);
    if (glfwInit() != GLFW_TRUE) {
        error = "no window can be opened: " + (last_fault.empty() ? "GLFW does not start" : last_fault) +
                ". Start it in a desktop session, or set DISPLAY. `kerf run` without `--window`, and `kerf view` and "
                "`kerf landmarks` with `--screenshot`, need no display.";
        return nullptr;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    constexpr int width = 1280, height = 800;
    GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        error = "no window can be opened: " + last_fault +
                ". Kerf needs a driver with OpenGL 3.3; Mesa's software renderer (libgl1-mesa-dri) has it.";
        glfwTerminate();
        return nullptr;
    }
    return std::unique_ptr<GlfwWindow>(new GlfwWindow(window));
}

GlfwWindow::GlfwWindow(GLFWwindow* window) : window_(window) {
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0);
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, on_key);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_move);
    glfwSetScrollCallback(window, on_wheel);
    glfwSetCharCallback(window, on_character);
}

GlfwWindow::~GlfwWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<Input> GlfwWindow::poll() {
    glfwPollEvents();
    return std::exchange(inputs_, {});
}

Input GlfwWindow::pointer() const {
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_, &x, &y);
    return {.kind = Input::Kind::move, .x = static_cast<float>(x), .y = static_cast<float>(y)};
}

void GlfwWindow::keep_open() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
bool GlfwWindow::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void GlfwWindow::swap() { glfwSwapBuffers(window_); }
void GlfwWindow::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
void GlfwWindow::copy(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }

void GlfwWindow::capture_cursor(bool captures) {
    if (std::exchange(has_captured_, captures) == captures) return;
    glfwSetInputMode(window_, GLFW_CURSOR, captures ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported() == GLFW_TRUE)
        glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, captures ? GLFW_TRUE : GLFW_FALSE);
    if (!captures) inputs_.push_back(pointer());  // GLFW moves the cursor back without an event
}

int GlfwWindow::width() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return width;
}

int GlfwWindow::height() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return height;
}

void GlfwWindow::on_key(GLFWwindow* window, int key, int /*scancode*/, int action, int mods) {
    GlfwWindow& self = *self_of(window);
    if (action == GLFW_REPEAT) return;
    // X11 reports the modifiers before the event, so those of Shift and Ctrl themselves are taken from the keyboard.
    const bool is_pressed = action == GLFW_PRESS;
    const auto is_held = [&](int left, int right, int mod) {
        if (key != left && key != right) return (mods & mod) != 0;
        return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
    };
    self.has_control_ = is_held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL);
    self.has_shift_ = is_held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT);
    if (key == GLFW_KEY_Q && self.has_control_ && action == GLFW_PRESS) glfwSetWindowShouldClose(window, GLFW_TRUE);
    self.inputs_.push_back({.kind = Input::Kind::key,
                            .code = code_of(key),
                            .is_pressed = is_pressed,
                            .has_control = self.has_control_,
                            .has_shift = self.has_shift_});
}

void GlfwWindow::on_button(GLFWwindow* window, int button, int action, int mods) {
    self_of(window)->inputs_.push_back({.kind = Input::Kind::button,
                                        .code = button,
                                        .is_pressed = action == GLFW_PRESS,
                                        .has_control = (mods & GLFW_MOD_CONTROL) != 0,
                                        .has_shift = (mods & GLFW_MOD_SHIFT) != 0});
}

void GlfwWindow::on_move(GLFWwindow* window, double x, double y) {
    self_of(window)->inputs_.push_back(
        {.kind = Input::Kind::move, .x = static_cast<float>(x), .y = static_cast<float>(y)});
}

void GlfwWindow::on_character(GLFWwindow* window, unsigned code) {
    self_of(window)->inputs_.push_back({.kind = Input::Kind::character, .code = static_cast<int>(code)});
}

void GlfwWindow::on_wheel(GLFWwindow* window, double /*x*/, double y) {
    GlfwWindow& self = *self_of(window);
    self.inputs_.push_back({.kind = Input::Kind::wheel,
                            .has_control = self.has_control_,
                            .has_shift = self.has_shift_,
                            .wheel = static_cast<float>(y)});
}

}  // namespace kerf::window
