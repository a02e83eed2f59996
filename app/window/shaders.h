// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Programs in GLSL. Colours are linear in the shaders: squares of sRGB values, with the root at the end.
namespace kerf::window::shaders {

/// Bone is lit per vertex: on a software renderer vertices are cheaper than fragments.
inline constexpr const char* bone_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint tissue;
layout(location = 3) in float light;
uniform mat4 clip_from_body;
uniform mat4 view_from_body;
uniform vec3 palette[16];
uniform vec4 cut_plane;      // body frame; parts with a positive distance are cut away
uniform float noise;
out vec3 colour;
out float gl_ClipDistance[1];

float random(vec3 at) {
    at = fract(at * vec3(0.1031, 0.1030, 0.0973));
    at += dot(at, at.yxz + 33.33);
    return fract((at.x + at.y) * at.z);
}

void main() {
    gl_Position = clip_from_body * vec4(position, 1.0);
    gl_ClipDistance[0] = -dot(cut_plane, vec4(position, 1.0));
    vec3 n = normalize(mat3(view_from_body) * normal);
    vec3 eye = normalize(-(view_from_body * vec4(position, 1.0)).xyz);
    vec3 key = normalize(vec3(-0.45, 0.62, 0.64));
    float facing = clamp((dot(n, key) + 0.25) / 1.25, 0.0, 1.0);
    facing *= facing;
    vec3 ambient = mix(vec3(0.27, 0.22, 0.20), vec3(0.44, 0.46, 0.50), 0.5 * n.y + 0.5);
    ambient *= vec3(light * light, light * light * light, light * light * light);
    float shine = pow(max(dot(n, normalize(key + eye)), 0.0), 12.0);
    float rim = pow(1.0 - max(dot(n, eye), 0.0), 3.0);
    vec3 base = palette[min(tissue, 15u)];
    base *= 1.0 + noise * (random(floor(position * 2500.0)) - 0.5);
    vec3 sun = vec3(0.80, 0.77, 0.71) * facing * (0.55 + 0.45 * light);
    colour = base * (sun + ambient) + vec3(0.05 * shine + 0.03 * rim) * light;
}
)";

inline constexpr const char* bone_fragment = R"(#version 330 core
in vec3 colour;
out vec4 pixel;
void main() { pixel = vec4(sqrt(colour), 1.0); }
)";

/// Seen through: the rims of all faces add up.
inline constexpr const char* x_ray_fragment = R"(#version 330 core
in float facing;
out vec4 pixel;
void main() { float rim = pow(1.0 - facing, 2.0); pixel = vec4(vec3(0.42, 0.55, 0.66) * (0.04 + 0.30 * rim), 1.0); }
)";
inline constexpr const char* x_ray_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_body;
uniform mat4 view_from_body;
out float facing;
void main() {
    gl_Position = clip_from_body * vec4(position, 1.0);
    vec3 n = normalize(mat3(view_from_body) * normal);
    vec3 eye = normalize(-(view_from_body * vec4(position, 1.0)).xyz);
    facing = abs(dot(n, eye));
}
)";

inline constexpr const char* shape_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_body;
uniform mat4 view_from_body;
out vec3 n;
out vec3 at;
void main() {
    gl_Position = clip_from_body * vec4(position, 1.0);
    n = mat3(view_from_body) * normal;
    at = (view_from_body * vec4(position, 1.0)).xyz;
}
)";

/// Metal mirrors a sky that is light above and dark below.
inline constexpr const char* metal_fragment = R"(#version 330 core
in vec3 n;
in vec3 at;
uniform vec3 base;
out vec4 pixel;
void main() {
    vec3 normal = normalize(n), eye = normalize(-at);
    vec3 mirrored = reflect(-eye, normal);
    float sky = smoothstep(-0.35, 0.75, mirrored.y + 0.25 * mirrored.z);
    vec3 key = normalize(vec3(-0.45, 0.62, 0.64));
    float shine = pow(max(dot(normal, normalize(key + eye)), 0.0), 60.0);
    float facing = clamp((dot(normal, key) + 0.25) / 1.25, 0.0, 1.0);
    vec3 colour = base * (0.16 + 0.62 * sky + 0.38 * facing) + vec3(0.55 * shine);
    pixel = vec4(sqrt(colour), 1.0);
}
)";

/// A zone is hatched in the picture, so that no hue of a tissue looks like it.
inline constexpr const char* zone_fragment = R"(#version 330 core
in vec3 n;
in vec3 at;
uniform vec3 base;
out vec4 pixel;
void main() {
    vec3 normal = normalize(n), eye = normalize(-at);
    float facing = abs(dot(normal, eye));
    float rim = pow(1.0 - facing, 2.0);
    vec2 cell = mod(vec2(gl_FragCoord.x + gl_FragCoord.y, gl_FragCoord.x - gl_FragCoord.y), 10.0);
    float hatch = (cell.x < 1.6 || cell.y < 1.6) ? 0.30 : 0.0;
    pixel = vec4(sqrt(base * (0.55 + 0.45 * facing)), clamp(0.10 + hatch + 0.30 * rim, 0.0, 0.8));
}
)";

/// Lines of a plan.
inline constexpr const char* flat_fragment = R"(#version 330 core
in vec3 n;
in vec3 at;
uniform vec3 base;
uniform float opacity;
out vec4 pixel;
void main() {
    float facing = abs(dot(normalize(n), normalize(-at)));
    pixel = vec4(sqrt(base * (0.5 + 0.5 * facing)), opacity);
}
)";

/// The background: a little lighter in the middle.
inline constexpr const char* background_vertex = R"(#version 330 core
out vec2 at;
void main() {
    at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(at, 1.0, 1.0);
}
)";
inline constexpr const char* background_fragment = R"(#version 330 core
in vec2 at;
out vec4 pixel;
void main() {
    float near = 1.0 - 0.30 * dot(at, at);
    pixel = vec4(vec3(0.125, 0.145, 0.172) * (0.72 + 0.42 * near), 1.0);
}
)";

}  // namespace kerf::window::shaders
