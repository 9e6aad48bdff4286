/* pbmpm: sleeping. Blocks of matter at rest take no part in a step until something wakes them.
 *
 * pbmpm_settings.sleeping switches it on. A block is 4^d cells. Its speed is the root mean square of its particles' speeds. It
 * falls asleep when this, and that of each neighbour, has been below sleep_speed for sleep_time. Its particles then stay where they
 * are, with a velocity of 0, and cost nothing; views, queries, snapshots and statistics show them as ever.
 * Blocks next to one that is awake are drowsy: they take part in the solution with their mass and stress, but are not moved. Beyond
 * them sleeping matter holds like a wall.
 * An elastic or visco body sleeps and wakes as a whole, with matter within two blocks. Sand sleeps and wakes together as far as a
 * stress wave gets in a substep.
 *
 * A block wakes when
 *   - a particle faster than sleep_speed enters it; or slower ones enter, more than 1/16 of the number it holds; or particles are
 *     added to it;
 *   - it is drowsy, and the solution would give one of its particles a speed above sleep_speed;
 *   - it is drowsy, and its mean velocity would have grown beyond sleep_speed within 0.03 s;
 *   - a collider that moves, turns, is teleported, created or destroyed is or was within two cells of it;
 *   - a force or a drain that reaches it is created, set or destroyed;
 *   - it is in the shape of a GRAB that moves or turns matter;
 *   - a call sets or removes particles in it;
 *   - pbmpm_world_wake() says so.
 * All blocks wake when a material, a wall of the domain or the kill bounds change. So they do when a setting changes, other than
 * sleeping, sleep_*, target_error and time_budget_ms. They also wake when the length of substeps has changed by more than a tenth
 * since they came to rest. Nothing else changes a block that sleeps, to the last bit. Blocks that touch a collider or a wall that
 * measures impulses stay awake.
 *
 * What sleeping does to the result: motion slower than sleep_speed is taken away with its momentum. Matter that sleeps ignores
 * accelerations up to sleep_speed / 0.03 s. Results depend neither on the number of threads nor on when others look.
 * A snapshot holds who sleeps; one of a world without sleeping wakes all. */
#ifndef PBMPM_SLEEP_H
#define PBMPM_SLEEP_H

#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Wakes all blocks within two cells of a shape, or all blocks of the world if `shape` is null. They stay awake for another
 *  sleep_time at least. Needed only where something happens that the library cannot know of. Does nothing in a world that does not
 *  sleep. `shape->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_wake(pbmpm_world_id world, const pbmpm_shape *shape);

#ifdef __cplusplus
}
#endif
#endif
