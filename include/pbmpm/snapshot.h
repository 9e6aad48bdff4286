/* pbmpm: saving the state of a world and going back to it, for rollback, saved games and bug reports. */
#ifndef PBMPM_SNAPSHOT_H
#define PBMPM_SNAPSHOT_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_SNAPSHOT_VERSION = 4, /**< of the format that this library writes */
    PBMPM_SNAPSHOT_OLDEST = 4   /**< the first of the formats that it reads */
};

/** Flags of pbmpm_snapshot_restore(). */
typedef enum pbmpm_restore_flags {
    PBMPM_RESTORE_KEEP_PARAMETERS = 1, /**< for saves from before a game update: the world keeps its own parameters */
    PBMPM_RESTORE_FLAGS_FORCE32 = 0x7fffffff
} pbmpm_restore_flags;

/* A snapshot holds all that the next step depends on: the particles with their identifiers, in storage order and with all fields;
 * the settings; the origin; walls of the domain; poses, targets and measured impulses of colliders; emitters, drains, forces and
 * kill bounds with their definitions and counts; which blocks sleep; counters and totals. It does not hold what a world is made of:
 * its definition, the parameters of its materials, the shapes of its colliders. Of these it holds enough to refuse a world where
 * they differ.
 * It holds neither user_data nor states of rigid bodies (pbmpm_rigid_state).
 *
 * Materials, colliders, emitters, drains and forces are matched by the `key` of their definitions, whatever their order. One
 * without a key, or whose key is not there, is matched by the index of its identifier. Things that a game destroys and makes again
 * need keys.
 *
 * A world that was restored goes on bit for bit as the one that was saved. Library and instruction set must be the same; the number
 * of threads may differ. It need not be the same world: one that was made by the same calls will do, in another process too.
 *
 * Bytes per particle, in 2D / in 3D: 60 / 92. Add
 *   - 16 / 36 once the world had a particle that is not liquid;
 *   - 4 / 4 once it has pressures (see PBMPM_PRESSURE);
 *   - 4 / 4 once it has user values;
 *   - 52 / 100 once the primal solver was used with BDF2.
 * Beside them some hundred bytes for the world and for each material, collider, emitter, drain and force; 4 bytes per identifier
 * that was used and is free again; with sleeping some bytes for each block. Little-endian; a snapshot may be stored and sent as
 * it is. */

/** How large a snapshot is now. *bytes changes with particles, their fields, objects and sleeping blocks. `bytes_per_particle` (may
 *  be null): the part of *bytes that each particle takes.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_snapshot_size(pbmpm_world_id world, uint64_t *bytes, uint32_t *bytes_per_particle);

/** Writes a snapshot into the caller's memory, of any alignment. `capacity`: bytes there. *bytes (may be null) becomes the size of
 *  the snapshot, on success and on CAPACITY. Takes no memory of the world and expires no views.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), CAPACITY (less room than pbmpm_snapshot_size() says; nothing is written), BUSY,
 *  FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_snapshot_save(pbmpm_world_id world, void *buffer, uint64_t capacity, uint64_t *bytes);

/** Puts a world back into the state of a snapshot, of any alignment. `bytes`: as many as were written, or more. Everything is
 *  checked first: on failure nothing has changed. All particles of before are gone; identifiers of particles are those of the
 *  snapshot, and live in every world that it was restored into. Identifiers of all other objects stay the world's own. Views
 *  expire, events are cleared, and the figures of the last step are 0 until the next one. Rigid bodies: restore your own copies of
 *  pbmpm_rigid_state as well.
 *
 *  The world must have the snapshot's dimension, cell size, domain box and domain_friction; materials with equal parameters;
 *  colliders with equal shapes and definitions, except pose, key and user_data; the same emitters, drains and forces, by key or
 *  index; and room for the particles and their identifiers. Settings are the snapshot's: read them before and set them again to
 *  keep your own.
 *
 *  `flags`: 0, or PBMPM_RESTORE_KEEP_PARAMETERS. With it these may differ and stay the world's: settings, kill bounds,
 *  domain_friction, walls of the domain, colliders, and materials but for their kind and density; also the definitions of emitters,
 *  drains and forces. Poses, counts and which of them are enabled come from the snapshot. Objects that only the world has stay as
 *  they are. Objects that only the snapshot has are left out; a material that particles need must be there. All matter is awake.
 *
 *  Errors: DAMAGED (truncated, a byte has changed, or no snapshot at all); FOREIGN (a world that differs, or another version of
 *  the format); CAPACITY (particles or identifiers); OUT_OF_MEMORY (fields that the world has not used yet); INVALID_ID,
 *  INVALID_ARGUMENT (null, unknown flags), BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_snapshot_restore(pbmpm_world_id world, const void *snapshot, uint64_t bytes, uint32_t flags);

#ifdef __cplusplus
}
#endif
#endif
