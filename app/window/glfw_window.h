// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/window/input.h"

struct GLFWwindow;

namespace kerf::window {

/// A window of the desktop with a context of OpenGL 3.3, through GLFW. One at a time.   [main]
class GlfwWindow {
public:
    /// Opens a window. Returns null with the reason in `error`: no display, or a driver without OpenGL 3.3.
    [[nodiscard]] static std::unique_ptr<GlfwWindow> open(const std::string& title, std::string& error);
    ~GlfwWindow();
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    /// Handles the events of the desktop. Returns the input since the last call.
    [[nodiscard]] std::vector<Input> poll();
    /// Returns where the mouse is, as a move to there.
    [[nodiscard]] Input pointer() const;
    /// Returns whether the user has closed the window, by its frame or by Ctrl+Q.   [any]
    [[nodiscard]] bool should_close() const;
    /// Forgets that the user has closed it.
    void keep_open();
    /// Shows what was drawn.
    void swap();
    /// Size of the picture in pixels; 0 while the window is minimised.
    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;
    /// Hides the cursor and lets the mouse move without an end, or shows it again.
    void capture_cursor(bool captures);
    void set_title(const std::string& title);
    /// Puts a text on the clipboard of the desktop.
    void copy(const std::string& text);

private:
    explicit GlfwWindow(GLFWwindow* window);
    static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods);
    static void on_button(GLFWwindow* window, int button, int action, int mods);
    static void on_move(GLFWwindow* window, double x, double y);
    static void on_character(GLFWwindow* window, unsigned code);
    static void on_wheel(GLFWwindow* window, double x, double y);

    GLFWwindow* window_;
    std::vector<Input> inputs_;
    bool has_control_ = false, has_shift_ = false, has_captured_ = false;
};

}  // namespace kerf::window
