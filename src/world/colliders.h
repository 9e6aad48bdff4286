/* Obstacles: their motion, the nodes and particles near them, and what they do to both. */
#ifndef PBMPM_SRC_WORLD_COLLIDERS_H
#define PBMPM_SRC_WORLD_COLLIDERS_H

#include "contact/impulses.h"
#include "grid/grid.h"
#include "pbmpm/collider.h"
#include "pbmpm/material.h"
#include "shape/shapes.h"

typedef struct Collider {
    uint32_t generation; /* 0: free slot */
    pbmpm_collider_def def;
    pbmpm_shape shape; /* where it stands now */
    float target_position[3]; /* where the next step takes it */
    float target_rotation[4];
    bool moving;
    const DistanceGrid *grid; /* of a baked shape; else null */
    /* Bit n: material n touches it, as touches_find() finds now, and as it told last. */
    uint64_t touching[PBMPM_MAX_MATERIALS / 64], touched[PBMPM_MAX_MATERIALS / 64];
} Collider;

/* An obstacle during one substep: a collider, or a wall of the domain. */
typedef struct Obstacle {
    Solid start, end;
    double turn[9]; /* rotation from start to end */
    bool moves;
    bool wall; /* of the domain: particles are always put back inside at once */
    pbmpm_friction friction;
    float coefficient;
    bool measures;
    uint16_t place; /* of its impulse, see Impulses.sum */
    uint32_t meets; /* groups of materials; 0: all */
} Obstacle;

/* Whether what `meets` these groups acts on matter of those; see pbmpm_collider_def. */
static const uint32_t ALL_GROUPS = UINT32_MAX;
static inline bool groups_meet(uint32_t meets, uint32_t groups) { return meets == 0 || (meets & groups) != 0; }
static inline bool obstacle_meets(const Obstacle *obstacle, uint32_t groups) { return groups_meet(obstacle->meets, groups); }

/* A node that an obstacle may meet in this substep. Displacements and lengths in cells. */
typedef struct Contact {
    uint16_t node;     /* in its block */
    uint16_t obstacle; /* in this substep's list */
    pbmpm_friction friction;
    float coefficient;
    bool active; /* while the primal solver works: see holds_find() */
    uint8_t group; /* of the body's contacts with about this normal, and */
    float limit;   /* the most that friction gives [mass times displacement], both while the primal solver works: see holds_rub() */
    bool stays; /* the node goes where `surface` says, see joint.h */
    bool walled; /* the node is listed in walls, which books what it is given */
    float gap; /* how far the node may approach; 0 inside */
    float normal[3];
    float surface[3]; /* displacement of the obstacle's surface */
} Contact;

typedef struct Colliders {
    Collider *slot;
    uint32_t room;  /* of slots; and of obstacles, with the walls and one more */
    uint32_t used;  /* slots [used, room) were never taken */
    Obstacle *obstacle;
    int obstacle_count; /* behind them stands one that is nowhere, for nodes that are held */

    Array contact;       /* Contact */
    Array contact_begin; /* uint32_t per node block, and the end */
    uint32_t contacts;
    Array solid;         /* uint64_t per node block: see ContactFrame.solid */
    Array open;          /* float per node: the share that is open */
    Array groups;        /* uint32_t per node: those of the materials there; 0: none is */
    Array gap;           /* float per node with mass: how far [cells] the next surface is, negative inside; infinite where none is near */

    Impulses impulses;
    bool measures; /* an obstacle of this substep does */
} Colliders;

pbmpm_result colliders_init(Colliders *colliders, Memory *memory);
void colliders_free(Colliders *colliders, Memory *memory);

pbmpm_collider_def collider_defaults(void);
const char *collider_problem(const pbmpm_collider_def *def);
bool friction_known(pbmpm_friction friction);
/* `grid`: of a baked shape, else null. */
pbmpm_result colliders_add(Colliders *colliders, Memory *memory, const pbmpm_collider_def *def, const pbmpm_shape *shape, const DistanceGrid *grid,
                           uint32_t generation, pbmpm_collider_id *id);
/* `shape` null: it stays, and so does its way. On failure nothing has changed. */
pbmpm_result colliders_set(Colliders *colliders, Memory *memory, Collider *collider, const pbmpm_collider_def *def, const pbmpm_shape *shape,
                           const DistanceGrid *grid);
/* A material is new: nothing has touched it. */
void colliders_forget_material(Colliders *colliders, uint32_t material);
bool colliders_use(const Colliders *colliders, const DistanceGrid *grid);
Collider *colliders_find(const Colliders *colliders, pbmpm_collider_id id); /* null if not live */
void collider_place(Collider *collider, const float position[3], const float *rotation, bool at_once);

/* Whether it is there and an obstacle. */
static inline bool collider_acts(const Collider *collider) { return collider->generation != 0 && !collider->def.sensor; }

/* Whether the next step takes it to another pose. */
bool collider_moves(const Collider *collider);

/* A live collider during part `part` of `parts` of a step. */
Obstacle collider_obstacle(const Collider *collider, int dimension, int part, int parts);

/* The obstacles of part `part` of `parts` of a step. `domain` null: without its walls. */
void colliders_begin_substep(Colliders *colliders, const Domain *domain, int dimension, int part, int parts);
/* After the last part: the targets are reached. */
void colliders_end_step(Colliders *colliders);

/* Distance [m] of a point from an obstacle at the end of the substep, negative inside, and the outward normal. */
double obstacle_distance(const Obstacle *obstacle, const double point[3], double normal[3]);

/* Where the obstacle carries a point of its own in the substep [cells], at most `limit`. */
void obstacle_motion(const Obstacle *obstacle, const double point[3], double cell_size, float limit, float out[3]);

/* Lists the contacts of all blocks; needs node_reach of the predictor. */
typedef struct ContactFrame {
    Colliders *colliders;
    const Grid *grid;
    double cell_size;
    float max_displacement; /* cells */
    double fall; /* see gravity_fall() */
    const struct Walls *walls; /* nodes that follow others have no contacts, see walls.h; null: all have */
    const struct Walls *staying; /* nodes that these list stay where they are taken, see joint.h; null: none */
    const uint64_t *solid;       /* per node block: bit n, a solid reaches node n, see reach.h; null: nobody looked */
    bool apart;                  /* walls leave those nodes to contacts: the joint solver */
    const uint64_t *held;   /* per node block: bit n, node n stands still whatever happens; null: none does */
    const float *gap;            /* Colliders.gap once it is measured; null before */
    const pbmpm_material_def *material; /* of the world, where an obstacle does not act on all matter; null: each does */
    const uint32_t *groups;             /* Colliders.groups, likewise */
    uint32_t present;                   /* all groups of the matter that there is, likewise */
    const KernelMaterial *stays; /* per material: liquid that obstacles trap where they overlap stays there; null: it is put on one's surface */
} ContactFrame;

/* The groups of the matter at a node of the grid, at all nodes of a block, and of a particle; all where that does not matter. Where there is no matter any may come. */
static inline uint32_t contacts_node_groups(const ContactFrame *frame, size_t node)
{
    return !frame->groups ? ALL_GROUPS : frame->groups[node] ? frame->groups[node] : frame->present;
}

uint32_t contacts_block_groups(const ContactFrame *frame, int32_t block);

static inline uint32_t contacts_row_groups(const ContactFrame *frame, const Particles *particles, uint32_t row)
{
    return frame->material ? frame->material[particles->material[row]].groups : ALL_GROUPS;
}

/* Finds frame->gap, which the others need. */
pbmpm_result contacts_measure(ContactFrame *frame, Memory *memory, Pool *pool);
pbmpm_result contacts_find(const ContactFrame *frame, Memory *memory, Pool *pool);

/* Contacts of the last substep, without those of nodes that are held by nobody's obstacle. */
uint32_t colliders_contacts(const Colliders *colliders);

/* Where a node is, and the middle of a block's nodes [m]. */
void contacts_node_position(const ContactFrame *frame, int32_t block, int node, double point[3]);
void contacts_block_centre(const ContactFrame *frame, int32_t block, double centre[3]);

/* Makes the displacements of the nodes of the blocks [begin, end) obey their contacts. Books what that takes. */
void contacts_apply(const ContactFrame *frame, int32_t begin, int32_t end);

/* The same for nodes that walls list alone. */
void contacts_apply_walled(const ContactFrame *frame, int32_t begin, int32_t end);

/* Takes from the nodes of the blocks [begin, end) what would move them against the surfaces they are on or in: the linear part of
 * contacts_apply(). */
void contacts_hold(const ContactFrame *frame, int32_t begin, int32_t end);

/* kg m/s per mass times displacement as the kernels count them. */
double contacts_momentum_scale(const ContactFrame *frame, double dt);

/* Adds what the contacts booked in this substep of `dt` seconds to the impulses of their obstacles. */
void contacts_book(const ContactFrame *frame, double dt);

/* Takes the memory that contacts_push_out() books in. */
pbmpm_result contacts_prepare_push(const ContactFrame *frame, Memory *memory);

/* Before particles move: notes where those of the particle blocks [begin, end) are that may meet an obstacle, in a spare array, for
 * contacts_push_out(). */
void contacts_keep_places(const ContactFrame *frame, const Particles *particles, int32_t begin, int32_t end);

/* Last resort: holds back particles of the particle blocks [begin, end) that passed through an obstacle, and puts those that ended
 * inside one back to its surface. */
void contacts_push_out(const ContactFrame *frame, Particles *particles, float dt, int32_t begin, int32_t end);

/* In place of that, for a block whose particles did not move. */
void contacts_pass_over(const ContactFrame *frame, int32_t block);

/* After all blocks: finishes the blocks that had no room to book in, and adds what was booked to the impulses. */
void contacts_book_push(const ContactFrame *frame, Particles *particles, float dt);

#endif
