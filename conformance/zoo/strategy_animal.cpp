// SPDX-License-Identifier: Apache-2.0
// The example's strategy with one fault, `kerf_how`, which each library brings along; "strategy_saint" has none. Each
// test of a strategy has an animal here that fails it first.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <kerf/strategy.hpp>
#include <string_view>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#undef KERF_PLUGIN
#define KERF_PLUGIN(id, version, licence, ...) using Sound = ::kerf::PluginTables<__VA_ARGS__>;
#include "examples/06_groove/ball_groove.cpp"

extern "C" __attribute__((visibility("hidden"))) const char kerf_how[];

namespace {

const std::string_view how = kerf_how;
bool is(std::string_view fault) { return how == fault; }

constexpr const kerf_component& sound = Sound::components[0];
kerf_remesher remesher;
kerf_component component;
std::uint32_t calls = 0;

double* vertices_of(const kerf_remesh_out& out, const kerf_arena& to) {
    return reinterpret_cast<double*>(to.base + out.result.vertices);
}
void flip_a_face(const kerf_remesh_out& out, const kerf_arena& to) {
    auto* const triangle = reinterpret_cast<std::uint32_t*>(to.base + out.result.triangles);
    std::swap(triangle[0], triangle[1]);
}
/// Moves all vertices that the sound strategy has moved by a part of their way back.
void make_shallow(const kerf_remesh_in& in, const kerf_arena& from, kerf_remesh_out& out, kerf_arena& to, double by) {
    const auto cut = remeshing::array<kerf_cut>(from, in.cuts, 1).front();
    const Vec3 up = rotate(cut.from.rotation, {0, 0, -1});
    const auto base = remeshing::array<Vec3>(from, in.base.vertices, in.base.vertex_count);
    auto* const moved = reinterpret_cast<Vec3*>(vertices_of(out, to));
    for (std::uint32_t v = 0; v < out.result.vertex_count; ++v) {
        const double depth = -dot(moved[v], up);  // the kit's bone has its top in z = 0
        const bool is_of_base = v < base.size() && base[v] == moved[v];
        if (!is_of_base && depth > 1e-6 && depth < 3e-3) moved[v] = moved[v] + std::min(by, depth) * up;
    }
}

kerf_status remesh(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out,
                   void* cache) {
    const double tolerance = remeshing::array<double>(*from, in->params, 1).front();
    if (is("declines_everything")) return remeshing::refuse(KERF_REMESH_DECLINED, *out, "not today");
    if (is("writes_to_its_request")) from->base[in->cuts] ^= 1u;
    if (is("overruns_its_arena") && to->capacity < 10000) std::memset(to->base, 0, to->capacity + 64);
    if (is("ignores_that_it_is_cancelled"))
        for (const auto* cancel = reinterpret_cast<const volatile std::uint32_t*>(from->base + in->cancel);
             *cancel != 0;) {
        }
#if defined(__x86_64__)
    if (is("leaves_another_rounding")) _mm_setcsr(_mm_getcsr() | 0x8040u);  // what is tiny becomes 0
#endif
    const kerf_status status = sound.remesher->remesh(in, from, to, out, cache);
    if (is("invents_a_status")) return 77;
    if (is("declines_without_a_word") && status == KERF_REMESH_DECLINED) out->message[0] = '\0';
    if (is("scrapes_in_air") && status == KERF_REMESH_UNCHANGED) {
        remeshing::Triangles mesh = remeshing::read(in->base, *from);
        const auto locked =
            remeshing::array<std::uint8_t>(*from, in->base.locked, in->base.locked != 0 ? in->base.vertex_count : 0);
        for (std::size_t v = 0; v < locked.size(); ++v)
            if (locked[v] == 0) mesh.vertices[v].z -= 1e-5;
        return remeshing::write(mesh, *to, out->result) ? KERF_OK : KERF_FAILED;
    }
    if (status != KERF_OK) return status;
    if (is("turns_a_face_over")) flip_a_face(*out, *to);
    if (is("stumbles_over_its_walls")) {
        const auto tags = remeshing::array<std::uint8_t>(*from, in->base.tags, in->base.triangle_count);
        if (std::find(tags.begin(), tags.end(), KERF_FACE_WALL) != tags.end()) flip_a_face(*out, *to);
    }
    if (is("counts_its_calls")) vertices_of(*out, *to)[3 * out->result.vertex_count - 1] += 1e-12 * ++calls;
    if (is("breaks_when_it_is_fine") && tolerance <= sound.params[0].min) flip_a_face(*out, *to);
    if (is("leaves_bone")) make_shallow(*in, *from, *out, *to, 0.3e-3);
    if (is("is_a_little_shallow")) make_shallow(*in, *from, *out, *to, 1.3e-4);
    return status;
}

kerf_entry filled_entry() {
    remesher = *sound.remesher;
    remesher.remesh = &remesh;
    component = sound;
    component.remesher = &remesher;
    kerf_entry entry = Sound::entry("example.ball_groove", "0.1.0", "Apache-2.0");
    entry.components = &component;
    return entry;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry = filled_entry();
