// SPDX-License-Identifier: Apache-2.0
// Strategies that do wrong what a strategy can do wrong, each in one way.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "kerf/remesh_mesh.hpp"

namespace {

using namespace kerf;

/// The request's own mesh as the result.
void copy_base(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out) {
    const kerf_patch& base = in->base;
    out->result = base;
    const auto copy = [&](kerf_offset at, std::size_t bytes) {
        const kerf_offset there = (to->used + 7) / 8 * 8;
        std::memcpy(to->base + there, from->base + at, bytes);
        to->used = there + bytes;
        return there;
    };
    out->result.vertices = copy(base.vertices, 24 * std::size_t{base.vertex_count});
    out->result.triangles = copy(base.triangles, 12 * std::size_t{base.triangle_count});
    out->result.tags = copy(base.tags, base.triangle_count);
    out->result.locked = 0;
}
double* first_vertex(const kerf_remesh_out* out, const kerf_arena* to) {
    return reinterpret_cast<double*>(to->base + out->result.vertices);
}
std::uint32_t* first_triangle(const kerf_remesh_out* out, const kerf_arena* to) {
    return reinterpret_cast<std::uint32_t*>(to->base + out->result.triangles);
}

using In = const kerf_remesh_in*;
using From = const kerf_arena*;

kerf_status copies(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    return KERF_OK;
}
kerf_status dies(In, From, kerf_arena*, kerf_remesh_out*, void*) { std::abort(); }
kerf_status exits(In, From, kerf_arena*, kerf_remesh_out*, void*) { std::_Exit(7); }
kerf_status hangs(In, From, kerf_arena*, kerf_remesh_out*, void*) {
    for (;;) pause();
}
kerf_status gives_way(In in, From from, kerf_arena*, kerf_remesh_out*, void*) {
    const auto* cancel = reinterpret_cast<const volatile std::uint32_t*>(from->base + in->cancel);
    while (*cancel == 0) usleep(1000);
    return KERF_REMESH_CANCELLED;
}
kerf_status leaves_the_arena(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    out->result.vertices = to->capacity - 8;
    return KERF_OK;
}
kerf_status overflows(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    out->result.vertices = ~std::uint64_t{7};
    return KERF_OK;
}
kerf_status invents_a_vertex(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    first_triangle(out, to)[1] = in->base.vertex_count;
    return KERF_OK;
}
kerf_status returns_nan(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    first_vertex(out, to)[2] = std::nan("");
    return KERF_OK;
}
kerf_status moves_a_vertex(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    first_vertex(out, to)[0] *= 1.0 - 1e-15;
    return KERF_OK;
}
kerf_status flips_a_face(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    std::uint32_t* t = first_triangle(out, to);
    const std::uint32_t second = t[1];
    t[1] = t[2];
    t[2] = second;
    return KERF_OK;
}
kerf_status drops_a_face(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    --out->result.triangle_count;
    return KERF_OK;
}
kerf_status invents_a_status(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    return 77;
}
kerf_status rambles(In, From, kerf_arena*, kerf_remesh_out* out, void*) {
    std::memset(out->message, 'x', sizeof out->message);
    out->message[3] = '\n';
    return KERF_REMESH_REFUSED;
}

kerf_status stays_as_it_was(In, From, kerf_arena*, kerf_remesh_out*, void*) { return KERF_REMESH_UNCHANGED; }
kerf_status declines(In, From, kerf_arena*, kerf_remesh_out* out, void*) {
    std::strcpy(out->message, "this animal cuts nothing");
    return KERF_REMESH_DECLINED;
}
kerf_status shrinks(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    copy_base(in, from, to, out);
    for (std::uint32_t n = 0; n < 3 * out->result.vertex_count; ++n) first_vertex(out, to)[n] *= 0.99;
    return KERF_OK;
}
/// Each face in three: the surface stays as it was.
kerf_status splits_every_face(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    remeshing::Triangles mesh = remeshing::read(in->base, *from), split = mesh;
    split.triangles.clear();
    split.tags.clear();
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const std::uint32_t *t = &mesh.triangles[3 * f], middle = static_cast<std::uint32_t>(split.vertices.size());
        split.vertices.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0);
        for (int i = 0; i < 3; ++i) {
            split.triangles.insert(split.triangles.end(), {t[i], t[(i + 1) % 3], middle});
            split.tags.push_back(mesh.tags[f]);
        }
    }
    return remeshing::write(split, *to, out->result) ? KERF_OK : KERF_FAILED;
}

/// Each result is another one.
kerf_status counts(In in, From from, kerf_arena* to, kerf_remesh_out* out, void*) {
    static int calls = 0;
    copy_base(in, from, to, out);
    first_vertex(out, to)[0] += 1e-9 * ++calls;
    return KERF_OK;
}

#define TABLE_OF(name, scope)                                                                     \
    constexpr kerf_remesher name##_table {                                                        \
        sizeof(kerf_remesher), scope, KERF_REMESH_LAYOUT_INIT, 0, "none", &name, nullptr, nullptr \
    }
#define TABLE(name) TABLE_OF(name, KERF_REMESH_WHOLE)
TABLE_OF(counts, KERF_REMESH_PATCH);
TABLE(copies);
TABLE(dies);
TABLE(exits);
TABLE(hangs);
TABLE(gives_way);
TABLE(leaves_the_arena);
TABLE(overflows);
TABLE(invents_a_vertex);
TABLE(returns_nan);
TABLE(moves_a_vertex);
TABLE(flips_a_face);
TABLE(drops_a_face);
TABLE(invents_a_status);
TABLE(rambles);
TABLE(stays_as_it_was);
TABLE(declines);
TABLE(shrinks);
TABLE(splits_every_face);

#define ANIMAL(name)                                                                                                \
    {                                                                                                               \
        sizeof(kerf_component), KERF_KIND_REMESHER, KERF_REMESHER_VERSION, 0, 0, 0, #name, "An animal of the zoo.", \
            nullptr, nullptr, {                                                                                     \
            &name##_table                                                                                           \
        }                                                                                                           \
    }
constexpr kerf_component animals[] = {ANIMAL(copies),
                                      ANIMAL(dies),
                                      ANIMAL(exits),
                                      ANIMAL(hangs),
                                      ANIMAL(gives_way),
                                      ANIMAL(leaves_the_arena),
                                      ANIMAL(overflows),
                                      ANIMAL(invents_a_vertex),
                                      ANIMAL(returns_nan),
                                      ANIMAL(moves_a_vertex),
                                      ANIMAL(flips_a_face),
                                      ANIMAL(drops_a_face),
                                      ANIMAL(invents_a_status),
                                      ANIMAL(rambles),
                                      ANIMAL(stays_as_it_was),
                                      ANIMAL(declines),
                                      ANIMAL(shrinks),
                                      ANIMAL(splits_every_face),
                                      ANIMAL(counts)};

}  // namespace

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" constinit const kerf_entry kerf_plugin_entry = {KERF_MAGIC,
                                                           KERF_ABI_VERSION,
                                                           sizeof(kerf_entry),
                                                           sizeof animals / sizeof animals[0],
                                                           KERF_LAYOUT_INIT,
                                                           "test.animals",
                                                           "0.1.0",
                                                           "Apache-2.0",
                                                           "any",
                                                           animals,
                                                           nullptr};
