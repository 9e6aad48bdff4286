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
    float volume;               /**< rest volume of each particle [m^d]; 0 (default): (dx/2)^d */
    const float *positions;     /**< count * d floats [m], relative to the origin; inside the domain box if there is one */
    const float *velocities;    /**< count * d floats [m/s], or null for rest */
    const float *volumes;       /**< count floats: rest volumes [m^d], > 0, or null for `volume` */
    const uint32_t *user_values; /**< count numbers of the host's, see PBMPM_USER_VALUE; null (default): 0 */
} pbmpm_particles_def;

/** Particles that fill a shape on a jittered lattice. */
typedef struct pbmpm_fill_def {
    uint32_t size;              /**< sizeof(pbmpm_fill_def), set by pbmpm_fill_def_init() */
    uint32_t seed;              /**< of the jitter; equal seeds give equal particles; default 1 */
    pbmpm_material_id material;
    float particles_per_axis;   /**< lattice points per cell and axis, in [0.25, 16]; default 2 (4 per cell in 2D, 8 in 3D) */
    float jitter;               /**< random offset as a share of the lattice spacing, in [0, 1]; default 0.5 */
    float velocity[3];          /**< of every particle [m/s]; default 0 */
    uint32_t user_value;        /**< of every particle, see PBMPM_USER_VALUE; default 0 */
} pbmpm_fill_def;

/** Writes the defaults. `size` is the caller's sizeof(*def).
 *  Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size that no version had). Any thread. */
PBMPM_API pbmpm_result pbmpm_particles_def_init(pbmpm_particles_def *def, size_t size);
/** Writes the defaults, as pbmpm_particles_def_init() does. */
PBMPM_API pbmpm_result pbmpm_fill_def_init(pbmpm_fill_def *def, size_t size);

/** Adds particles. All of them or none. `ids`: null or room for def->count identifiers.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also NaN, infinity or a position outside the domain in any element), CAPACITY, BUSY;
 *  OUT_OF_MEMORY: the first particle that is not liquid makes room for F, the first user value for user values. */
PBMPM_API pbmpm_result pbmpm_particles_add(pbmpm_world_id world, const pbmpm_particles_def *def, pbmpm_particle_id *ids);

/** Fills a shape (any kind but PBMPM_PLANE) with a lattice of spacing dx / particles_per_axis that is centred on it; each particle has the rest volume of
 *  one lattice cell. Lattice points outside the domain box are left out, and those in an obstacle that acts on the material.
 *  Particles that are there already do not count: two fills of one place overlap (PBMPM_ADVICE_OVERLAPS).
 *  pbmpm_particles_remove_in() makes room; a collider that is there while you fill leaves its place out.
 *  With a CAPACITY error nothing is added and `added` says how many the shape needs. `added` may be null.
 *  Errors: INVALID_ID; INVALID_ARGUMENT, also where no lattice point is left, or more than 2^30 are around the shape in the
 *  domain; CAPACITY, BUSY; OUT_OF_MEMORY (as above). */
PBMPM_API pbmpm_result pbmpm_particles_fill(pbmpm_world_id world, const pbmpm_fill_def *def, const pbmpm_shape *shape, uint32_t *added);

/** Removes particles by identifier. An unknown one: INVALID_ID and nothing is removed. */
PBMPM_API pbmpm_result pbmpm_particles_remove(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count);

/** Removes all particles inside a shape; *removed (may be null) says how many. Errors: INVALID_ID, INVALID_ARGUMENT, BUSY. */
PBMPM_API pbmpm_result pbmpm_particles_remove_in(pbmpm_world_id world, const pbmpm_shape *shape, uint32_t *removed);

/** Number of live particles. */
PBMPM_API pbmpm_result pbmpm_particles_count(pbmpm_world_id world, uint32_t *count);

/** Fields of particles. */
typedef enum pbmpm_field {
    PBMPM_POSITION = 0,        /**< d floats [m], relative to the origin */
    PBMPM_VELOCITY = 1,        /**< d floats [m/s] */
    PBMPM_AFFINE_VELOCITY = 2, /**< d*d floats [1/s], row-major: velocity gradient of the particle's neighbourhood */
    PBMPM_VOLUME_RATIO = 3,    /**< 1 float: J of a liquid particle, in [0.05, 1.2]; det F of an elastic one as of its last step. Sand with the dual or
                                    the convergent solver: J, stored beside F */
    PBMPM_DEFORMATION = 4,     /**< d*d floats, row-major F; identity for liquids; only once the world had a particle that is not liquid. Sand with the
                                    dual or the convergent solver: its shape tells the deviator of the stress, det F the pressure p, as exp(-p / K) */
    PBMPM_MATERIAL = 5,        /**< 1 uint32: index of the material's identifier */
    PBMPM_PARTICLE = 6,        /**< 2 uint32: pbmpm_particle_id */
    PBMPM_MASS = 7,            /**< 1 float [kg] (2D: per metre of depth); read-only */
    PBMPM_PRESSURE = 8,        /**< 1 float [Pa] (2D: N/m): of a liquid particle, or of sand with the dual or the convergent solver, as last solved for; 0 for elastic
                                    ones. Of a compressed liquid it is the pressure K (1 - J) times J. Take the mean
                                    over a few cells: differences between neighbouring particles cause no motion. */
    PBMPM_USER_VALUE = 9,      /**< 1 uint32: the host's own, which goes with the particle (a colour, an owner); 0 unless it was given. Only once one
                                    that is not 0 was given, or any was set: before, it takes no memory. */
    PBMPM_FIELD_FORCE32 = 0x7fffffff
} pbmpm_field;

/** A window on the world's own memory, which stays allocated until the world is destroyed: an expired view never faults. Once it has expired it shows a
 *  mix of old and new values, or 0. Of AFFINE_VELOCITY and DEFORMATION the values
 *  are arbitrary. Publish (async.h) or copy (pbmpm_particles_copy()) what is drawn later, or by another thread. Element (i, c) of the field is at
 *  (const char *)data + i * stride + c * component_stride. Read-only. */
typedef struct pbmpm_view {
    uint32_t size;             /**< sizeof(pbmpm_view), set by the caller */
    uint32_t count;            /**< particles */
    uint32_t components;       /**< values per particle */
    uint32_t component_stride; /**< bytes from one component to the next */
    uint64_t stride;           /**< bytes from one particle to the next */
    const void *data;          /**< null when count is 0 */
    uint64_t generation;       /**< valid while pbmpm_world_generation() returns this number; of a published state for longer, see async.h */
} pbmpm_view;

/** A view of a field. The order of particles is the same in all views of one generation and changes with steps; their
 *  identity is PBMPM_PARTICLE. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (no such field in this world), BUSY. */
PBMPM_API pbmpm_result pbmpm_particles_view(pbmpm_world_id world, pbmpm_field field, pbmpm_view *view);

/** What pbmpm_particles_copy() writes for each particle. Fill it with pbmpm_copy_def_init(), then change what differs. */
typedef struct pbmpm_copy_def {
    uint32_t size;             /**< sizeof(pbmpm_copy_def), set by pbmpm_copy_def_init() */
    uint32_t stride;           /**< bytes from one particle to the next, a multiple of 4; 0 (default): what offset and fields take */
    float alpha;               /**< time, from 0 (before the last step) to 1 (default: now). Positions are x - (1 - alpha) dt v with the
                                    duration dt of the last step. They err by up to 0.02 cells, by up to 0.045 where liquid is crowded. Other
                                    fields are those of now. */
    uint32_t field_count;      /**< of `fields`; 0 (default): POSITION, VELOCITY, MATERIAL */
    const pbmpm_field *fields; /**< one behind the other, without gaps; 4 bytes for each component */
    int32_t pads_vectors;      /**< 1: POSITION and VELOCITY take 3 floats in 2D too, the third is 0; 0 (default): d floats */
    uint32_t offset;           /**< bytes from the beginning of a record to the first field, a multiple of 4; default 0 */
} pbmpm_copy_def;

/** Writes the defaults, as pbmpm_particles_def_init() does. */
PBMPM_API pbmpm_result pbmpm_copy_def_init(pbmpm_copy_def *def, size_t size);

/** Copies all particles into the caller's memory, for rendering and for uploads to a GPU: it stays readable whatever the world does. `def` may be
 *  null: the defaults. *count is the number of particles; `capacity`: bytes of `buffer`, any alignment. The order is that of views.
 *
 *  Records for a GPU: with pads_vectors 1 they are the same in 2D and 3D. The default fields take 28 bytes without gaps: position (3 floats),
 *  velocity (3 floats), index of the material (uint32). So a structured buffer of HLSL has them. Fields POSITION, MATERIAL, VELOCITY with stride 32
 *  are {vec3, uint, vec3} of GLSL's std430. What is before `offset` and behind the last field of a record stays the host's.
 *
 *  A host that steps at a fixed rate draws between two states: `alpha` is the share of the way to the present one. So motion is even on any display.
 *  Expires no view. While a step runs in the background it copies the published state, see async.h.
 *  Errors: INVALID_ID; INVALID_ARGUMENT (null, a value out of range); UNSUPPORTED (size; a field that the world does not have); CAPACITY (the
 *  buffer is too small; nothing is written, *count is set); BUSY (also: a field that is not published, while a step runs). */
PBMPM_API pbmpm_result pbmpm_particles_copy(pbmpm_world_id world, const pbmpm_copy_def *def, void *buffer, uint64_t capacity, uint32_t *count);

/** Writes a field of some particles: count * components values, tightly packed: floats; USER_VALUE: uint32.
 *  Settable: POSITION (velocity stays), VELOCITY, AFFINE_VELOCITY, VOLUME_RATIO (liquid, in [0.05, 1.2]), PRESSURE (liquid, in
 *  [0, 1e30]: where the dual solver starts from), DEFORMATION (elastic, any finite matrix
 *  with entries up to 1e6), USER_VALUE (wakes nothing). With `ids` null the values are for all particles in storage order and `count` must be their number.
 *  All or nothing; expires views. Errors: INVALID_ID; INVALID_ARGUMENT (a value out of range, a field that cannot be set);
 *  UNSUPPORTED (a particle whose material has no such field); OUT_OF_MEMORY (room for PRESSURE or USER_VALUE); BUSY. */
PBMPM_API pbmpm_result pbmpm_particles_set(pbmpm_world_id world, pbmpm_field field, const pbmpm_particle_id *ids, uint32_t count,
                                           const void *values);

/** Where particles stand in the current storage order (the row in a view). Errors: INVALID_ID (no row is written), BUSY. */
PBMPM_API pbmpm_result pbmpm_particles_find(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count, uint32_t *rows);

/** Particles inside a shape, in storage order. Writes up to `capacity` identifiers; *count is the full number.
 *  `ids` may be null when capacity is 0. Errors: INVALID_ID, INVALID_ARGUMENT, OUT_OF_MEMORY (see query.h), BUSY. */
PBMPM_API pbmpm_result pbmpm_query_shape(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_particle_id *ids, uint32_t capacity,
                                         uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
