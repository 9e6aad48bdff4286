/* Contacts of nodes with obstacles: what they are, and obeying them. */
#ifndef PBMPM_SRC_CONTACT_CONTACTS_H
#define PBMPM_SRC_CONTACT_CONTACTS_H

#include "base/substep.h"
#include "contact/impulses.h"
#include "contact/obstacles.h"
#include "grid/grid.h"
#include "pbmpm/material.h"

/* A node that an obstacle may meet in this substep. Displacements and lengths in cells. */
typedef struct Contact {
    uint16_t node;     /* in its block */
    uint16_t obstacle; /* in this substep's list */
    pbmpm_friction friction;
    float coefficient;
    bool active; /* while the primal solver works: see constraints_find_active() */
    uint8_t group; /* of the body's contacts with about this normal, and */
    float limit;   /* the most that friction gives [mass times displacement], both while the primal solver works: see constraints_friction() */
    bool stays; /* the node goes where `surface` says, see joint.h; and */
    bool follows; /* that is where others lead it, see primal_followers.h */
    bool walled; /* the node is listed in walls, which books what it is given */
    float gap; /* how far the node may approach; 0 inside */
    float normal[3];
    float surface[3]; /* displacement of the obstacle's surface */
    float wall[3];    /* that of the wall, at a node that stays or follows */
} Contact;

/* A thing of the host's that is an obstacle, see colliders.h. */
typedef struct Collider Collider;

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
    Array anchored;      /* Obstacle: the same from the grid's anchor, see push_out.c */
    Array gap;           /* float per node with mass: how far [cells] the next surface is, negative inside; infinite where none is near */

    Impulses impulses;
    bool measures; /* an obstacle of this substep does */
} Colliders;

/* What contacts are found and obeyed with. */
typedef struct ContactFrame {
    Colliders *colliders;
    const Grid *grid;
    double cell_size;
    const Substep *substep;
    float max_displacement; /* cells */
    double fall; /* see gravity_fall() */
    const struct Walls *walls; /* nodes that follow others have no contacts, see walls.h; null: all have */
    const struct Walls *leaders; /* these lead nodes in the primal's parts, see joint.h; null: none */
    const uint64_t *solid;       /* per node block: bit n, a solid reaches node n, see reach.h; null: nobody looked */
    bool liquid;                 /* there is nothing but liquid */
    bool viscous;                /* some of it has a viscosity, which walls hold: see wall_shear.h */
    bool slips;                  /* near solids nodes behind walls have their motion along these themselves: the joint solver */
    const uint64_t *held;   /* per node block: bit n, node n stands still whatever happens; null: none does */
    const uint64_t *grabbed; /* likewise: node n goes where the predictor says, where no obstacle is within a cell; null: none does */
    struct ObstacleCache *cache;         /* what may be taken over from the last substep; null: nothing, and nothing is kept */
    const float *gap;            /* Colliders.gap once it is measured; null before */
    const pbmpm_material_def *material; /* of the world, where an obstacle does not act on all matter; null: each does */
    const uint32_t *groups;             /* Colliders.groups, likewise */
    uint32_t present;                   /* all groups of the matter that there is, likewise */
    const Particles *pressed;     /* what presses on walls; null: nothing does */
    const float *pressure;        /* its pressures, if the solver keeps them; else null */
    const KernelMaterial *kernel; /* per material, of what presses */
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
double contacts_momentum_scale(const ContactFrame *frame);

/* What a node that is grabbed gained in this substep from what grabs it [kg m/s]; false: it is not. */
bool contacts_held_gain(const ContactFrame *frame, int32_t block, int node, double gained[3]);

/* Adds what the contacts booked in this substep to the impulses of their obstacles. */
void contacts_book(const ContactFrame *frame);

#endif
