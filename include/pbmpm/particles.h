/* pbmpm: adding, removing, reading, changing and finding particles. */
#ifndef PBMPM_PARTICLES_H
#define PBMPM_PARTICLES_H

#include "material.h"
#include "shape.h"
#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Particles from arrays. Arrays are read during the call only. "d" is the world's dimension. */
typedef struct pbmpm_particles_def {
    uint32_t size;              /**< sizeof(pbmpm_particles_def), set by pbmpm_particles_def_init() */
    uint32_t count;             /**< number of particles in the arrays */
    pbmpm_material_id material; /**< their material */
    float volume;               /**< rest volume of each particle [m^d], 1e-6 to 1e6 cell volumes; 0 (default): (dx/2)^d */
    const float *positions;     /**< count * d floats [m], relative to the origin; inside the domain box if there is one */
    const float *velocities;    /**< count * d floats [m/s], each in [-1e9, 1e9], or null for rest */
    const float *volumes;       /**< count floats: rest volumes [m^d], each 1e-6 to 1e6 cell volumes, or null: `volume` for all */
    const uint32_t *user_values; /**< count values that the host chooses, see PBMPM_USER_VALUE; null (default): all 0 */
} pbmpm_particles_def;

/** Particles that fill a shape on a jittered lattice. */
typedef struct pbmpm_fill_def {
    uint32_t size;              /**< sizeof(pbmpm_fill_def), set by pbmpm_fill_def_init() */
    uint32_t seed;              /**< of the jitter; equal seeds give equal particles; default 1 */
    pbmpm_material_id material; /**< of the particles */
    float particles_per_axis;   /**< lattice points per cell and axis, in [0.25, 16]; default 2 (4 per cell in 2D, 8 in 3D) */
    float jitter;               /**< random offset per axis, up to +- jitter / 2 lattice spacings, in [0, 1]; default 0.5 */
    float velocity[3];          /**< of every particle [m/s], each in [-1e9, 1e9]; default 0 */
    uint32_t user_value;        /**< of every particle, see PBMPM_USER_VALUE; default 0 */
} pbmpm_fill_def;

/** Writes the defaults. `size` is the caller's sizeof(*def). Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size).
 *  Threads: any. */
PBMPM_API pbmpm_result pbmpm_particles_def_init(pbmpm_particles_def *def, size_t size);
/** Writes the defaults, as pbmpm_particles_def_init() does. */
PBMPM_API pbmpm_result pbmpm_fill_def_init(pbmpm_fill_def *def, size_t size);

/** Adds particles: all of them or none. `ids`: null or room for def->count identifiers. Expires all views.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (also NaN, infinity or a position outside the domain in any element); UNSUPPORTED
 *  (size); CAPACITY; OUT_OF_MEMORY (room for F with the first non-liquid particle, or for user values); BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_particles_add(pbmpm_world_id world, const pbmpm_particles_def *def, pbmpm_particle_id *ids);

/** Fills a shape (any kind but PBMPM_PLANE) with a lattice of spacing dx / particles_per_axis that is centred on it. Each particle
 *  has the rest volume of one lattice cell. Lattice points outside the domain box are left out, and those in an obstacle that acts
 *  on the material. Existing particles are not looked at, so two fills of one place overlap (PBMPM_ADVICE_OVERLAPS). Make room with
 *  pbmpm_particles_remove_in(). To keep a place empty, have a collider there while you fill. Expires all views.
 *  `added` (may be null): how many were added. With a CAPACITY error nothing is added, and it says how many the shape needs.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (also: no point is left, or the shape's bounds in the domain hold over 2^30 points);
 *  UNSUPPORTED (size); CAPACITY; OUT_OF_MEMORY (as above); BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_particles_fill(pbmpm_world_id world, const pbmpm_fill_def *def, const pbmpm_shape *shape, uint32_t *added);

/** Removes particles by identifier. An identifier may be given twice. Expires all views.
 *  Errors: INVALID_ID (any of them; nothing is removed), INVALID_ARGUMENT (null with a count), BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_particles_remove(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count);

/** Removes all particles inside a shape; *removed (may be null) says how many. Expires all views.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_particles_remove_in(pbmpm_world_id world, const pbmpm_shape *shape, uint32_t *removed);

/** Number of live particles. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_particles_count(pbmpm_world_id world, uint32_t *count);

/** Fields of particles. */
typedef enum pbmpm_field {
    PBMPM_POSITION = 0,        /**< d floats [m], relative to the origin */
    PBMPM_VELOCITY = 1,        /**< d floats [m/s] */
    PBMPM_AFFINE_VELOCITY = 2, /**< d*d floats [1/s], row-major: velocity gradient of the particle's neighbourhood */
    PBMPM_VOLUME_RATIO = 3,    /**< 1 float: J, present volume over rest volume. Liquids: in [0.05, 1.2]. Elastic: det F after the
                                    last step. Sand with the dual or convergent solver: kept apart from F */
    PBMPM_DEFORMATION = 4,     /**< d*d floats, row-major F; identity for liquids. Exists once the world had a particle that is not
                                    liquid. Sand with the dual or convergent solver: encodes stress and is no strain; det F =
                                    exp(-pressure / K), K = lambda + 2 mu / d */
    PBMPM_MATERIAL = 5,        /**< 1 uint32: index of the material's identifier */
    PBMPM_PARTICLE = 6,        /**< 2 uint32: pbmpm_particle_id */
    PBMPM_MASS = 7,            /**< 1 float [kg] (2D: per metre of depth); read-only */
    PBMPM_PRESSURE = 8,        /**< 1 float [Pa] (2D: N/m): last pressure of liquid, or of sand with the dual or convergent solver;
                                    else 0. Exists once a step needed it, or it was set. Liquid: divide it by J for the true
                                    pressure; with a bulk modulus K that is K (1 - J). Values of neighbours scatter, which moves
                                    nothing: average them. */
    PBMPM_USER_VALUE = 9,      /**< 1 uint32: the host's own, which goes with the particle (a colour, an owner); default 0. Exists,
                                    and takes memory, once a value other than 0 was given, or any was set. */
    PBMPM_FIELD_FORCE32 = 0x7fffffff
} pbmpm_field;

/** A window on the world's own memory, read-only. Element (i, c) is at (const char *)data + i * stride + c * component_stride.
 *  The memory stays allocated until the world is destroyed. So an expired view may be read safely, but its values mean nothing.
 *  For what is drawn later, or by another thread, publish the field (async.h) or copy it (pbmpm_particles_copy()). */
typedef struct pbmpm_view {
    uint32_t size;             /**< sizeof(pbmpm_view), set by the caller */
    uint32_t count;            /**< particles */
    uint32_t components;       /**< values per particle */
    uint32_t component_stride; /**< bytes from one component to the next */
    uint64_t stride;           /**< bytes from one particle to the next */
    const void *data;          /**< null when count is 0 */
    uint64_t generation;       /**< valid while pbmpm_world_generation() returns this; published views: longer, see async.h */
} pbmpm_view;

/** A view of a field. `view->size` must be set. The order of particles is the same in all views of one generation and changes with
 *  steps; their identity is PBMPM_PARTICLE.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size; no such field in this world), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_particles_view(pbmpm_world_id world, pbmpm_field field, pbmpm_view *view);

/** What pbmpm_particles_copy() writes for each particle. Fill it with pbmpm_copy_def_init(), then change what differs. */
typedef struct pbmpm_copy_def {
    uint32_t size;             /**< sizeof(pbmpm_copy_def), set by pbmpm_copy_def_init() */
    uint32_t stride;           /**< bytes from one particle to the next, a multiple of 4; 0 (default): offset and fields, packed */
    float alpha;               /**< time, from 0 (before the last step) to 1 (default: now). Positions are x - (1 - alpha) dt v, dt
                                    of the last step; other fields are those of now. With one substep that is exact but for what
                                    moves places alone: shifting (0.02 cells per axis), pushes of crowded matter (0.025). Further
                                    off is what an obstacle or a wall put back. So is what has another velocity than its way:
                                    with `flip`, with BDF2, or where the primal solver corrects velocities afterwards. */
    uint32_t field_count;      /**< number of `fields`; 0 (default): POSITION, VELOCITY, MATERIAL */
    const pbmpm_field *fields; /**< in the order in which they are written, without gaps; 4 bytes for each component */
    int32_t pads_vectors;      /**< 1: POSITION and VELOCITY take 3 floats in 2D too, the third is 0. 0 (default): d floats */
    uint32_t offset;           /**< bytes from the beginning of a record to the first field, a multiple of 4; default 0 */
} pbmpm_copy_def;

/** Writes the defaults, as pbmpm_particles_def_init() does. */
PBMPM_API pbmpm_result pbmpm_copy_def_init(pbmpm_copy_def *def, size_t size);

/** Copies all particles into the caller's memory, for rendering and for uploads to a GPU. `def` may be null: the defaults. *count
 *  becomes the number of particles. `capacity`: bytes of `buffer`, any alignment. The order is that of views. Expires no view.
 *  To ask for *count first, pass a null `buffer` with capacity 0; the result is CAPACITY.
 *
 *  Records for a GPU: with pads_vectors 1 they are the same in 2D and 3D. The default fields take 28 bytes: position (3 floats),
 *  velocity (3 floats), index of the material (uint32). HLSL structured buffers use this layout. Fields POSITION, MATERIAL,
 *  VELOCITY with stride 32 are {vec3, uint, vec3} of GLSL's std430. Bytes before `offset` and after the last field of a record are
 *  not written.
 *
 *  A host that steps at a fixed rate draws between two states: `alpha` is the share of the way to the present one. So motion is
 *  even on any display. While a background step runs, it copies the published state, see async.h.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (null, a value out of range); UNSUPPORTED (size; a field that the world does not have);
 *  CAPACITY (the buffer is too small; nothing is written, *count is set); BUSY (also, while a background step runs: a field is
 *  not published, or VELOCITY is not and `alpha` is below 1); FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_particles_copy(pbmpm_world_id world, const pbmpm_copy_def *def, void *buffer, uint64_t capacity, uint32_t *count);

/** Writes a field of some particles: count * components values, tightly packed: floats, or uint32 for USER_VALUE. With null `ids`
 *  the values are for all particles in storage order, and `count` must be their number. All or nothing; expires all views.
 *  Settable: POSITION (velocity stays), VELOCITY, AFFINE_VELOCITY, VOLUME_RATIO (liquid, in [0.05, 1.2]), PRESSURE (liquid, in [0,
 *  1e30]: where the dual solver starts from), DEFORMATION (elastic, any finite matrix with entries up to 1e6), USER_VALUE (wakes
 *  nothing).
 *  Errors: INVALID_ID; INVALID_ARGUMENT (a value out of range, a field that cannot be set); UNSUPPORTED (a particle whose
 *  material has no such field); OUT_OF_MEMORY (room for PRESSURE or USER_VALUE); BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_particles_set(pbmpm_world_id world, pbmpm_field field, const pbmpm_particle_id *ids, uint32_t count,
                                           const void *values);

/** Writes for each identifier its row in the current views; `rows` has room for `count`.
 *  Errors: INVALID_ID (no row is written), INVALID_ARGUMENT (null with a count), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_particles_find(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count, uint32_t *rows);

/** Particles inside a shape, in storage order. Writes up to `capacity` identifiers; *count is the full number. `ids` may be null
 *  when capacity is 0.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_shape(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_particle_id *ids, uint32_t capacity,
                                         uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
