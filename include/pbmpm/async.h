/* pbmpm: steps that run while the host does something else. */
#ifndef PBMPM_ASYNC_H
#define PBMPM_ASYNC_H

#include "particles.h"
#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A step that was begun runs on a thread of the world's own. That thread shares its work with the world's threads or task hooks.
 *
 * If the hooks nest (base.h) the step is a task of the host instead. The world then has no such thread. pbmpm_world_step_begin()
 * enqueues one task. That task calls `enqueue` and `finish` for others. pbmpm_world_step_end() or pbmpm_world_destroy() calls
 * `finish` for the first task.
 *
 * A step computes what pbmpm_world_step() would have: results do not depend on how it was made. Until pbmpm_world_step_end() gives
 * another result than BUSY, all calls on this world return BUSY, except pbmpm_world_is_valid() and these:
 *
 *   pbmpm_world_step_end()        waits, or ends the step if it is done;
 *   pbmpm_world_step_done()       looks whether it is;
 *   pbmpm_particles_view()        of a published field: the state that the step began with;
 *   pbmpm_particles_copy()        of published fields of that state;
 *   pbmpm_particles_count()       of that state;
 *   pbmpm_world_generation()      of those views;
 *   pbmpm_world_get_def()
 *   pbmpm_world_get_step_stats()  of the step before
 *   pbmpm_world_destroy(), pbmpm_shutdown()  wait for the step; its result is lost.
 *
 * Any thread may make them. While one thread is in pbmpm_world_step_begin(), or waits in pbmpm_world_step_end(), calls of other
 * threads return BUSY. pbmpm_shutdown() must not be called then.
 *
 * Views taken before the begin have expired: their memory is what the step works on. Views taken while it runs show a copy, the
 * published state. The copy is made before anything else, by the step or by the first view that is asked for: that may take some
 * milliseconds for a million particles. Other views wait for it.
 *
 * A published state stays readable for a renderer that is a frame late: its views stay valid until the second next
 * pbmpm_world_step_begin(), or until the world is destroyed. Any thread may read it. When pbmpm_world_generation() has moved on
 * there is a newer state, and this one is still whole. A frame loop:
 *
 *   pbmpm_world_step_begin();          the state of now is published
 *   pbmpm_particles_view() ...         hand the views to the renderer; it may read them while the next frame's step runs, too
 *   pbmpm_world_step_end();            then edit the world, and begin again
 *
 * Memory: two copies of the published fields, for `particle_capacity` particles: 56 bytes per particle in 2D and 72 in 3D for the
 * default fields. The first begin takes it and a thread, and the world keeps both. A world that never begins a step has neither.
 *
 * The step calls the allocator, the task hooks and the log callback. It does so in the floating-point mode of the thread that began
 * it. One thread at a time calls the allocator of a world. The same holds for its hooks, except that a thread may wait in `finish`
 * for the step itself. Threads of the library block all signals but faults.
 * After a fork a step, in the background or not, goes on in the parent. The child cannot know how far it was: there, destroying
 * the world gives no memory back. */

/** Which fields can be viewed while a step runs: `count` of them, each once; 0: none. Default: POSITION, VELOCITY, MATERIAL and
 *  PARTICLE. A published field that the world does not have yet (PRESSURE, DEFORMATION) costs memory, too, though it cannot be
 *  viewed. Takes effect, and memory, with the next pbmpm_world_step_begin().
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null with a count, unknown or repeated field), OUT_OF_MEMORY, BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_publish(pbmpm_world_id world, const pbmpm_field *fields, uint32_t count);

/** Begins a step of `dt` seconds and returns. Expires all views but those of the state that the previous begin published: see
 *  above.
 *  Errors: INVALID_ID, INVALID_ARGUMENT and FORKED as pbmpm_world_step(); BUSY (also: a step is under way); OUT_OF_MEMORY (room
 *  for the published fields), THREAD (no thread for the step): then no step was begun and nothing has changed.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_step_begin(pbmpm_world_id world, float dt);

/** Ends a step that was begun, and gives its result: what pbmpm_world_step() would have given. With `wait` 0 it returns BUSY while
 *  the step runs; the log callback is not called. With another number it waits. The published state stays readable, see above.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (no step is under way), BUSY, FORKED; of the step: OUT_OF_MEMORY. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_step_end(pbmpm_world_id world, int32_t wait);

/** Whether the step that was begun is done, so that pbmpm_world_step_end() will not wait: *done is then 1, else 0. Ends nothing and
 *  waits for nothing; made to be asked in each frame. Where the step is a task of the host and no other thread runs tasks, it never
 *  says yes: there end the step with a wait.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null; no step is under way), BUSY, FORKED; *done is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_step_done(pbmpm_world_id world, int32_t *done);

#ifdef __cplusplus
}
#endif
#endif
