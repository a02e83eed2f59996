// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <utility>

/// Objects of OpenGL that delete themselves. Pre of all functions: a context of OpenGL 3.3 or newer is current.
namespace kerf::window {

void delete_buffer(GLuint name);
void delete_vertex_array(GLuint name);
void delete_program(GLuint name);
void delete_texture(GLuint name);
void delete_framebuffer(GLuint name);

/// A name of an object, deleted with `Delete`.
template <auto Delete>
class GlName {
public:
    GlName() = default;
    explicit GlName(GLuint name) : name_(name) {}
    GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlName() {
        if (name_ != 0) Delete(name_);
    }
    [[nodiscard]] GLuint get() const noexcept { return name_; }

private:
    GLuint name_ = 0;
};

using GlBuffer = GlName<&delete_buffer>;
using GlVertexArray = GlName<&delete_vertex_array>;
using GlProgram = GlName<&delete_program>;
using GlTexture = GlName<&delete_texture>;
using GlFramebuffer = GlName<&delete_framebuffer>;

[[nodiscard]] GlBuffer make_buffer();
[[nodiscard]] GlVertexArray make_vertex_array();
[[nodiscard]] GlTexture make_texture();
[[nodiscard]] GlFramebuffer make_framebuffer();

/// Compiles and links a program. Throws std::runtime_error with the driver's message.
[[nodiscard]] GlProgram make_program(const char* vertex_shader, const char* fragment_shader);

/// Returns the location of a uniform; −1 if the program does not use it.
[[nodiscard]] inline GLint uniform(const GlProgram& program, const char* name) {
    return glGetUniformLocation(program.get(), name);
}

/// Returns whether a context draws without a graphics card.
[[nodiscard]] bool is_software_renderer();
/// Returns renderer and version, for people.
[[nodiscard]] std::string renderer_name();

}  // namespace kerf::window
