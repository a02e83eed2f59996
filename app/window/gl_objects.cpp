// SPDX-License-Identifier: Apache-2.0
#include "app/window/gl_objects.h"

#include <array>
#include <stdexcept>
#include <string_view>

namespace kerf::window {

namespace {

template <class Name, class Generate>
Name generated(const Generate& generate) {
    GLuint name = 0;
    generate(1, &name);
    return Name(name);
}

GLuint compiled(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint is_good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
    if (is_good != 0) return shader;
    std::array<char, 1024> message{};
    glGetShaderInfoLog(shader, message.size(), nullptr, message.data());
    glDeleteShader(shader);
    throw std::runtime_error("the graphics driver rejects a shader: " + std::string(message.data()));
}

std::string text_of(GLenum what) {
    const GLubyte* text = glGetString(what);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

}  // namespace

void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
void delete_program(GLuint name) { glDeleteProgram(name); }
void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }

GlBuffer make_buffer() {
    return generated<GlBuffer>([](GLsizei count, GLuint* names) { glGenBuffers(count, names); });
}
GlVertexArray make_vertex_array() {
    return generated<GlVertexArray>([](GLsizei count, GLuint* names) { glGenVertexArrays(count, names); });
}
GlTexture make_texture() {
    return generated<GlTexture>([](GLsizei count, GLuint* names) { glGenTextures(count, names); });
}
GlFramebuffer make_framebuffer() {
    return generated<GlFramebuffer>([](GLsizei count, GLuint* names) { glGenFramebuffers(count, names); });
}

GlProgram make_program(const char* vertex_shader, const char* fragment_shader) {
    GlProgram program(glCreateProgram());
    for (const auto& [kind, source] :
         {std::pair{GL_VERTEX_SHADER, vertex_shader}, std::pair{GL_FRAGMENT_SHADER, fragment_shader}}) {
        const GLuint shader = compiled(static_cast<GLenum>(kind), source);
        glAttachShader(program.get(), shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program.get());
    GLint is_good = 0;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &is_good);
    if (is_good != 0) return program;
    std::array<char, 1024> message{};
    glGetProgramInfoLog(program.get(), message.size(), nullptr, message.data());
    throw std::runtime_error("the graphics driver cannot link a program: " + std::string(message.data()));
}

bool is_software_renderer() {
    const std::string name = text_of(GL_RENDERER);
    return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
           name.find("SWR") != std::string::npos;
}

std::string renderer_name() { return text_of(GL_RENDERER) + ", OpenGL " + text_of(GL_VERSION); }

}  // namespace kerf::window
