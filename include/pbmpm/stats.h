/* pbmpm: what a step cost, what state it left, and what happened in it. */
#ifndef PBMPM_STATS_H
#define PBMPM_STATS_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_EVENTS = 1024 /**< that a world keeps until its next step */
};

/** Figures of the last step. Times are of the whole step (all substeps); state is that at its end. Momentum and angular
 *  momentum are relative to the world's origin; in 2D only component 2 of the angular momentum is used. */
typedef struct pbmpm_stats {
    uint32_t size;                /**< sizeof(pbmpm_stats), set by the caller */
    uint32_t particle_count;      /**< live particles */
    uint64_t step_count;          /**< steps since creation */
    double simulated_seconds;     /**< since creation */
    uint64_t memory_bytes;        /**< held by the world */
    uint32_t particle_blocks;     /**< blocks of 4^d cells with particles; a liquid particle that flies free, far from all else, is in none */
    uint32_t node_blocks;         /**< blocks of 4^d nodes that they touch */
    uint32_t contacts;            /**< node-obstacle pairs in the last substep */
    uint32_t substeps;            /**< of the step */
    uint32_t iterations;          /**< per substep */
    uint32_t thread_count;        /**< shares the work was cut into */
    float ms_total;               /**< wall time [ms] of the step */
    float ms_sort;                /**< ... of which binning and reordering */
    float ms_scatter;             /**< first P2G and predictor */
    float ms_contacts;            /**< finding nodes near obstacles */
    float ms_iterate;             /**< N passes of G2P, projection, P2G and grid update */
    float ms_integrate;           /**< last G2P, integration, guards */
    float volume_error_rms;       /**< root mean square of |J - 1| over particles */
    float volume_error_max;       /**< largest |J - 1| */
    float max_speed;              /**< [m/s] */
    float max_displacement;       /**< largest particle displacement of the last substep [cells] (the Courant number) */
    double mass;                  /**< [kg] */
    double momentum[3];           /**< [kg m/s] */
    double angular_momentum[3];   /**< about the origin, with the affine part [kg m^2/s] */
    double kinetic_energy;        /**< translation of particles [J] */
    double potential_energy;      /**< in gravity, relative to the origin [J] */
    float cell_changes;           /**< share of particles that left their cell in the last substep */
    float lane_occupancy;         /**< share of SIMD lanes that held a particle; 1 is perfect */
    uint64_t deleted_total;       /**< particles deleted by the library since creation (never by calls) */
    uint64_t clamped_total;       /**< times a particle was slowed to max_displacement since creation */
    pbmpm_solver solver;          /**< of the last substep; PBMPM_SOLVER_CONVERGENT: several. Then iterations, residual and error below are
                                       the largest over the islands, and energy_checks_failed is the sum */
    pbmpm_stop stop;              /**< what ended its iterations */
    uint32_t iterations_used;     /**< by it; passes that a line search repeats and those that deep sand takes beyond the iterations set count too */
    float residual;               /**< its last change per iteration [cells], root mean square; 0 for the paper's and the explicit solver */
    float predicted_error;        /**< root mean square distance of its displacements from the converged ones [cells], as predicted
                                       from the residual; 0 where residual is */
    uint32_t energy_checks_failed; /**< primal, alone or with the dual: bodies whose unfinished solution would have gained energy in the last substep;
                                        they began again from their rigid motion */
    uint32_t particles_asleep;     /**< particles that the last substep did not move because they sleep */
    uint32_t blocks_asleep;        /**< blocks that took no part in it; particle_blocks counts those that did */
    uint32_t blocks_drowsy;        /**< of particle_blocks, those that took part without being moved: next to blocks that are awake */
    uint32_t blocks_woken;         /**< blocks that woke in the last step, and by calls before it */
} pbmpm_stats;

/** All figures, of the last step and of the present state. The latter take a pass over the particles on the world's threads. Sums do not
 *  depend on the number of threads. Before the first step times and step counts are 0. `stats->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY, FORKED. Any thread, together with others that read. */
PBMPM_API pbmpm_result pbmpm_world_get_stats(pbmpm_world_id world, pbmpm_stats *stats);

/** The figures that a step leaves behind, without a pass over anything: made to be asked in each frame. These need a pass and are 0:
 *  volume_error_rms, volume_error_max, max_speed, mass, momentum, angular_momentum, kinetic_energy, potential_energy and lane_occupancy.
 *  While a step runs in the background they are those of the step before it, see async.h.
 *  Errors: as pbmpm_world_get_stats(). Any thread, together with others that read. */
PBMPM_API pbmpm_result pbmpm_world_get_step_stats(pbmpm_world_id world, pbmpm_stats *stats);

/** What an event tells. */
typedef enum pbmpm_event_kind {
    PBMPM_EVENT_DELETED_NOT_FINITE = 1,   /**< a particle's state was NaN or infinite; it was taken out before it touched others */
    PBMPM_EVENT_DELETED_OUT_OF_RANGE = 2, /**< beyond PBMPM_MAX_CELL */
    PBMPM_EVENT_DELETED_CONDITION = 3,    /**< strain beyond condition_max */
    PBMPM_EVENT_SPEED_CLAMPED = 4,        /**< slowed to max_displacement */
    PBMPM_EVENT_CAPACITY = 5,             /**< a call asked for more particles than there is room for; count: how many */
    PBMPM_EVENT_EMISSION_REFUSED = 6,     /**< an emitter had no space, no budget or no room for particles that were due; count: how many; at
                                               the emitter's position */
    PBMPM_EVENT_KILLED = 7,               /**< left the kill bounds; count: how many; the first of them */
    PBMPM_EVENT_KIND_FORCE32 = 0x7fffffff
} pbmpm_event_kind;

/** Something that happened which the caller did not ask for. */
typedef struct pbmpm_event {
    uint32_t size;              /**< sizeof(pbmpm_event); set by the caller in the first element of an array */
    pbmpm_event_kind kind;      /**< what happened */
    uint32_t count;             /**< how many particles (deletions: always 1) */
    pbmpm_particle_id particle; /**< the particle, or the first one of several */
    float position[3];          /**< where [m] */
    uint32_t substep;           /**< in which substep of the step */
    uint64_t step;              /**< step_count when it happened */
} pbmpm_event;

/** Events of the last step, and of calls since then. Writes up to `capacity` of them; *count is the number that the world keeps, at most
 *  PBMPM_MAX_EVENTS; *missed (may be null) counts those that it had no room to keep: totals are in pbmpm_stats. `events` may be null when
 *  capacity is 0; otherwise events[0].size must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_events(pbmpm_world_id world, pbmpm_event *events, uint32_t capacity, uint32_t *count, uint32_t *missed);

#ifdef __cplusplus
}
#endif
#endif
