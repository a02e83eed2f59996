/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KERF_REMESH_H
#define KERF_REMESH_H

/* Remeshing strategies, components of kind KERF_KIND_REMESHER. They cut an exact surface along the tools' sweeps.
 *
 * The program `kerf-remesh` calls a strategy, in a process of its own. So a strategy may link any library, allocate,
 * throw inside and crash. The process of the haptic loop loads its library only to read the tables.
 *
 * A strategy is a function of its input: the same bytes in give the same bytes out, whichever data its cache contains.
 * The host trusts no result and checks each one: mesh, border, crossings, locked vertices, removed volume.
 *
 * Meshes cross as offsets into arenas, blocks of memory that both processes map at different addresses. An offset
 * counts bytes from the arena's base. 0 means none. Arrays begin at multiples of 8 bytes.
 *
 * Units: SI. Frame: body. All pointers are valid during the call. */

#include "kerf/abi.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint64_t kerf_offset;

typedef struct kerf_arena {
    unsigned char* base;
    uint64_t capacity; /* [bytes] */
    uint64_t used;     /* [bytes]; the next array begins at the next multiple of 8 */
} kerf_arena;

/* Tags of faces. A strategy keeps the tags of the faces that it keeps, and gives KERF_FACE_WALL to new ones. The host
 * itself distinguishes cortical from cancellous walls. */
enum { KERF_FACE_SURFACE = 0, KERF_FACE_WALL = 1 };

/* A mesh of triangles: closed and 2-manifold if it is WHOLE, else with a border whose vertices are locked. */
typedef struct kerf_patch {
    uint32_t vertex_count, triangle_count;
    kerf_offset vertices;  /* double[3] each [m] */
    kerf_offset triangles; /* uint32_t[3] each, anticlockwise seen from outside */
    kerf_offset tags;      /* uint8_t each triangle: KERF_FACE_… */
    kerf_offset locked; /* uint8_t each vertex: a vertex with 1 must be returned bit for bit; 0: no vertex is locked */
} kerf_patch;

/* The solid that removes bone: the cutting part of a tool's outline, kerf_solid as offsets. */
typedef struct kerf_cut_solid {
    uint32_t kind; /* KERF_SOLID_… */
    uint32_t profile_count;
    kerf_offset profile; /* kerf_profile_point each */
    double kerf;         /* of a prism: thickness of its cutting part [m], > 0; else 0 */
    double bore;         /* of a hollow solid of revolution: radius of its bore [m]; else 0 */
} kerf_cut_solid;

/* A straight motion of a solid from one pose to another. */
typedef struct kerf_cut {
    kerf_pose from, to; /* body_from_tool */
    uint32_t solid;     /* index into the request's solids */
    uint32_t reserved;
} kerf_cut;

/*   PATCH  gets the faces near the cuts, with a locked border
 *   WHOLE  gets the whole mesh */
enum { KERF_REMESH_PATCH = 1, KERF_REMESH_WHOLE = 2 };

/*   PROVISIONAL  may be undone: the next request can repeat the base with more cuts
 *   COMMIT       becomes the base of the next request
 *   FINAL        last request of a step */
enum { KERF_REMESH_PROVISIONAL = 1, KERF_REMESH_COMMIT = 2, KERF_REMESH_FINAL = 3 };

typedef struct kerf_remesh_in {
    uint32_t size;
    uint32_t mode; /* KERF_REMESH_PROVISIONAL … */
    kerf_patch base;
    kerf_offset cuts, solids;
    uint32_t cut_count, solid_count; /* only cuts that removed bone */
    uint64_t nudge_seed;             /* 0 at first; another value after the host has refused a result */
    double tolerance;                /* [m] permitted deviation of new faces from the swept volume */
    kerf_offset params;              /* double each: the component's parameters in declared order, SI */
    uint32_t param_count, reserved;
    kerf_offset cancel; /* uint32_t; if it is not 0 the strategy must soon return KERF_REMESH_CANCELLED */
} kerf_remesh_in;

typedef struct kerf_remesh_out {
    uint32_t size;
    uint32_t reserved;
    kerf_patch result;                /* in the arena `out` */
    double want_low[3], want_high[3]; /* [m] with KERF_REMESH_NEED_REGION: the box that is needed */
    char message[240];                /* with a refusal: the reason; UTF-8, ends with NUL */
} kerf_remesh_out;

/* Statuses of a remesh beyond KERF_OK and KERF_FAILED. */
enum {
    KERF_REMESH_UNCHANGED = 1,   /* the cuts meet none of the faces; `result` is not read */
    KERF_REMESH_NEED_REGION = 2, /* the patch is too small */
    KERF_REMESH_REFUSED = 3,     /* this input cannot be cut; another seed may help */
    KERF_REMESH_CANCELLED = 4,
    KERF_REMESH_DECLINED = 5 /* this strategy does not make such a cut, with any seed; another strategy may */
};

/* Sizes of the structs that cross. */
typedef struct kerf_remesh_layout {
    uint32_t in, out, patch, cut, solid;
} kerf_remesh_layout;
#define KERF_REMESH_LAYOUT_INIT \
    { sizeof(kerf_remesh_in), sizeof(kerf_remesh_out), sizeof(kerf_patch), sizeof(kerf_cut), sizeof(kerf_cut_solid) }

/* If the strategy has a parameter `tolerance`, a length, its value becomes the `tolerance` of the requests. */
typedef struct kerf_remesher {
    uint32_t size;
    uint32_t scope; /* KERF_REMESH_PATCH or KERF_REMESH_WHOLE */
    kerf_remesh_layout layout;
    uint32_t reserved;
    const char* kernel; /* library, version and flags on which its results depend [library] */
    /* Cuts a mesh. Reads `in` and the offsets in the arena `from`; writes into `to`, which it does not enlarge. */
    kerf_status (*remesh)(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out,
                          void* cache);
    void* (*cache_new)(void); /* null: the strategy needs no cache */
    void (*cache_drop)(void* cache);
} kerf_remesher;

#ifdef __cplusplus
}
#endif
#endif
