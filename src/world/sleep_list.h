/* Sleeping: blocks at rest take no part in a step.
 *
 * A block is 4^d cells on a lattice that stands still while sleeping is on. It is in one of four stages:
 *
 *   awake    its particles move.
 *   drowsy   it has a neighbour that is awake. Its particles take part in the solution with their mass and their stress, as if they were
 *            awake, but they are not moved; what they would have done is looked at instead.
 *   leaving  as drowsy, without such a neighbour: this is its last substep in the grid.
 *   asleep   its particles are not in the grid. Nothing looks at them.
 *
 * So awake matter sees a ring of complete matter around it. Nodes that also belong to particles that are asleep have not all of their mass;
 * they are held where they are, as by an obstacle that matter sticks to. They are at least two nodes away from any particle that moves.
 *
 * Bodies sleep and wake as one, see sleep_waves.h: what is held still by a part that sleeps would tear off from what goes on.
 *
 * Falling asleep: the root mean square speed of the particles of the block and of each neighbour stays below sleep_speed for sleep_time.
 * That of a body does not count while a part of it is disturbed.
 * Waking: something enters, what a drowsy block would do says so (see sleep_judge()), or a call touches it.
 *
 * Rows of particles: those of blocks that are asleep stand first and stay where they are; those of leaving, drowsy and awake blocks follow and
 * are sorted in every substep. When blocks that are asleep are taken out, their rows change places with the last rows that stay asleep, so
 * that the work goes with what wakes, not with what sleeps. For that a block that is asleep may lie in several pieces. */
#ifndef PBMPM_SRC_WORLD_SLEEP_LIST_H
#define PBMPM_SRC_WORLD_SLEEP_LIST_H

#include "base/memory.h"
#include "pbmpm/base.h"

typedef enum SleepStage { SLEEP_AWAKE, SLEEP_DROWSY, SLEEP_LEAVING, SLEEP_ASLEEP } SleepStage;

typedef struct SleepBlock {
    int32_t place[3];  /* in blocks from the world's origin and the phase */
    SleepStage stage;
    uint32_t woken;    /* to be awake in the next substep */
    uint32_t moved;    /* while it is decided: particles of it have a velocity */
    uint32_t rows;     /* particles */
    uint32_t index;    /* while the list is changed: where it goes; else 0 */
    uint32_t disturbed; /* its particles are not at rest, or a call touched it: see sleep_waves.h */
    uint32_t joined;   /* of those, how many have come since it fell asleep */
    float quiet;       /* awake: for how long it has been quiet [s] */
    union {
        float gained[3]; /* drowsy: velocity that it would have got lately [m/s] */
        float crossing;  /* asleep: see sleep_crossing() */
    };
    float liquid_volume, liquid_mass; /* asleep: of its liquid particles, as Particles.mass counts */
} SleepBlock;

/* Blocks and a hash table of their places. */
typedef struct SleepList {
    Array block; /* SleepBlock */
    Array slot;  /* uint32_t: index + 1, or 0 */
    uint32_t count;
    uint32_t mask;
} SleepList;

/* Rows of one block that is asleep. */
typedef struct SleepPiece {
    uint32_t block; /* in the list of those that are asleep */
    uint32_t begin, count;
} SleepPiece;

typedef struct Sleep {
    bool on;
    bool stirred;     /* something is to wake */
    bool phased;      /* the lattice stands */
    int32_t phase[3]; /* in [0, 4): cells from the world's origin to the lattice */
    double dt;        /* [s] of the substeps that matter came to rest in */
    uint32_t rows;    /* particles that are asleep: the first ones */
    SleepList asleep;
    SleepList active; /* blocks of the last substep's grid, in its order: leaving, drowsy, awake */
    Array piece, piece_scratch; /* SleepPiece; in the order of the rows, they cover all that are asleep */
    uint32_t pieces;
    uint32_t still_rows, still_blocks; /* of the last substep: leaving and drowsy blocks that did not wake in it, and their particles */
    uint32_t woken_blocks; /* in this step */
    Array next, loud;     /* scratch of sleep_build(), per block in order of discovery: SleepBlock, float */
    Array pressure;       /* of still particles, before the solution */
    Array drift;          /* see KernelArgs */
    Array held;           /* uint64_t per node block: bit n, node n also belongs to particles that are asleep */
    bool holds;           /* there is such a node */
} Sleep;

/* ---- Lists ---- */

bool sleep_list_reserve(SleepList *list, Memory *memory, uint32_t blocks);
void sleep_list_index(SleepList *list); /* after a change */
SleepBlock *sleep_list_find(const SleepList *list, const int32_t place[3]); /* null: not in it */
static inline SleepBlock *sleep_list_block(const SleepList *list, uint32_t i) { return (SleepBlock *)list->block.data + i; }

/* Room for `blocks` in all lists together, and for what can become of `pieces` until the next substep. */
bool sleep_reserve(Sleep *sleep, Memory *memory, uint32_t blocks, uint32_t pieces);
/* The same for another state, which is to follow: what sleeps now is forgotten. On failure nothing has changed. */
bool sleep_renew(Sleep *sleep, Memory *memory, uint32_t blocks, uint32_t pieces);
void sleep_free(Sleep *sleep, Memory *memory);

/* Off: nothing sleeps. Memory stays. */
void sleep_end(Sleep *sleep);

/* The place of the block that holds a cell. */
void sleep_place(const Sleep *sleep, const int32_t cell[3], int dimension, int32_t place[3]);

#endif
