/* pbmpm: what a step cost, what state it left, and what happened in it. */
#ifndef PBMPM_STATS_H
#define PBMPM_STATS_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_EVENTS = 1024 /**< events that a world keeps until its next step */
};

/** Figures of the last step. Times are of the whole step (all substeps); state is that at its end. Momentum and angular momentum
 *  are relative to the world's origin; in 2D only component 2 of the angular momentum is used. In 2D all are per metre of depth. */
typedef struct pbmpm_stats {
    uint32_t size;                /**< sizeof(pbmpm_stats), set by the caller */
    uint32_t particle_count;      /**< live particles */
    uint64_t step_count;          /**< steps since creation */
    double simulated_seconds;     /**< since creation */
    uint64_t memory_bytes;        /**< held by the world */
    uint32_t particle_blocks;     /**< blocks of 4^d cells with particles; liquid that flies far from all else is in none */
    uint32_t node_blocks;         /**< blocks of 4^d grid nodes that these touch */
    uint32_t contacts;            /**< node-obstacle pairs in the last substep */
    uint32_t substeps;            /**< of the step */
    uint32_t iterations;          /**< per substep */
    uint32_t thread_count;        /**< threads, or tasks per enqueue, that share the work */
    float ms_total;               /**< wall time [ms] of the step */
    float ms_sort;                /**< ... of it for sorting particles into blocks */
    float ms_scatter;             /**< moving particle data to the grid, gravity and forces */
    float ms_contacts;            /**< finding nodes near obstacles */
    float ms_iterate;             /**< the solver's iterations */
    float ms_integrate;           /**< moving particles, and checking them */
    float volume_error_rms;       /**< root mean square of |PBMPM_VOLUME_RATIO - 1| over all particles */
    float volume_error_max;       /**< the largest of these */
    float max_speed;              /**< [m/s] */
    float max_displacement;       /**< largest particle displacement of the last substep [cells] (the Courant number) */
    double mass;                  /**< [kg] (2D: this and all below per metre of depth) */
    double momentum[3];           /**< [kg m/s] */
    double angular_momentum[3];   /**< about the origin [kg m^2/s], including the spin within particles (PBMPM_AFFINE_VELOCITY) */
    double kinetic_energy;        /**< of the particles' velocities [J] */
    double potential_energy;      /**< in gravity, relative to the origin [J] */
    float cell_changes;           /**< share of particles that left their cell in the last substep */
    float lane_occupancy;         /**< share of SIMD lanes that held a particle; 1 is perfect */
    uint64_t deleted_total;       /**< particles deleted by the library since creation (never by calls) */
    uint64_t clamped_total;       /**< times a particle was slowed to max_displacement since creation */
    pbmpm_solver solver;          /**< of the last substep; CONVERGENT: the joint solver, or several that differ. Of several groups
                                       of islands iterations_used, residual and predicted_error are maxima; energy_checks_failed
                                       is the sum */
    pbmpm_stop stop;              /**< what ended the iterations of the last substep */
    uint32_t iterations_used;     /**< in the last substep, with repeated passes; deep sand may exceed settings.iterations */
    float residual;               /**< [cells] Dual: rms change of the stresses in the last iteration, at least that of the
                                       displacements that they cause. Primal: see docs/method.md, End. Paper's, explicit: 0 */
    float predicted_error;        /**< predicted rms error of the displacements [cells]; 0 if residual is 0 */
    uint32_t energy_checks_failed; /**< primal, alone or with the dual: bodies whose first solution had gained energy in the last
                                        substep. They searched further, then paid with velocities, or began again from their rigid
                                        motion: docs/method.md, Pieces that gain energy */
    uint32_t particles_asleep;     /**< particles that the last substep did not move because they sleep */
    uint32_t blocks_asleep;        /**< blocks that took no part in the last substep; particle_blocks counts those that did */
    uint32_t blocks_drowsy;        /**< of particle_blocks, those that took part without being moved, beside awake blocks */
    uint32_t blocks_woken;         /**< blocks that woke in the last step, and by calls before it */
} pbmpm_stats;

/** All figures, of the last step and of the present state. The latter take a pass over the particles on the world's threads. Sums
 *  do not depend on the number of threads. Before the first step times and step counts are 0. `stats->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_stats(pbmpm_world_id world, pbmpm_stats *stats);

/** The figures that a step leaves behind, without a pass over anything: made to be asked in each frame. These need a pass and are
 *  0: volume_error_rms, volume_error_max, max_speed, mass, momentum, angular_momentum, kinetic_energy, potential_energy and
 *  lane_occupancy. While a background step runs they are those of the step before it, see async.h.
 *  Errors: as pbmpm_world_get_stats(). Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_step_stats(pbmpm_world_id world, pbmpm_stats *stats);

/** What an event tells. */
typedef enum pbmpm_event_kind {
    PBMPM_EVENT_DELETED_NOT_FINITE = 1,   /**< a particle's state was NaN or infinite; it was taken out before it touched others */
    PBMPM_EVENT_DELETED_OUT_OF_RANGE = 2, /**< a particle went beyond PBMPM_MAX_CELL */
    PBMPM_EVENT_DELETED_CONDITION = 3,    /**< a particle was strained too far, see PBMPM_STRAIN_DELETE */
    PBMPM_EVENT_SPEED_CLAMPED = 4,        /**< particles were slowed to max_displacement; count: how many; with one of them */
    PBMPM_EVENT_CAPACITY = 5,             /**< a call asked for more particles than fit; count: for how many; without one */
    PBMPM_EVENT_EMISSION_REFUSED = 6,     /**< an emitter had no space, no budget or no room for particles that were due; count: how
                                               many; without one, at the emitter's position */
    PBMPM_EVENT_KILLED = 7,               /**< particles left the kill bounds; count: how many; with the first of them */
    PBMPM_EVENT_KIND_FORCE32 = 0x7fffffff
} pbmpm_event_kind;

/** Something that happened and that the caller did not ask for. */
typedef struct pbmpm_event {
    uint32_t size;              /**< sizeof(pbmpm_event); set by the caller in the first element of an array */
    pbmpm_event_kind kind;      /**< what happened */
    uint32_t count;             /**< how many particles (deletions: always 1) */
    pbmpm_particle_id particle; /**< the particle, or one of several, see the kind; all zero: without one */
    float position[3];          /**< where it is [m], relative to the origin */
    uint32_t substep;           /**< substep of the step, from 0 */
    uint64_t step;              /**< steps completed before it: one less than pbmpm_stats.step_count after that step */
} pbmpm_event;

/** Events of the last step, and of calls since then. Writes up to `capacity` of them; *count is the number that the world keeps, at
 *  most PBMPM_MAX_EVENTS. *missed (may be null) counts those that it had no room to keep; pbmpm_stats has totals. `events` may be
 *  null when capacity is 0; otherwise events[0].size must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_events(pbmpm_world_id world, pbmpm_event *events, uint32_t capacity, uint32_t *count, uint32_t *missed);

#ifdef __cplusplus
}
#endif
#endif
