/* Colliders of a world, and the obstacles that they are in a substep. */
#ifndef PBMPM_SRC_WORLD_COLLIDERS_H
#define PBMPM_SRC_WORLD_COLLIDERS_H

#include "contact/contacts.h"

struct Collider {
    uint32_t generation; /* 0: free slot */
    pbmpm_collider_def def;
    pbmpm_shape shape; /* where it stands now */
    float target_position[3]; /* where the next step takes it */
    float target_rotation[4];
    bool moving;
    FreeBody *body; /* its motion as a rigid body; null: the host never advanced it as one */
    const DistanceGrid *grid; /* of a baked shape; else null */
    /* Bit n: material n touches it, as collider_touches_find() finds now, and as it told last. */
    uint64_t touching[PBMPM_MAX_MATERIALS / 64], touched[PBMPM_MAX_MATERIALS / 64];
};

pbmpm_result colliders_init(Colliders *colliders, Memory *memory);
void colliders_free(Colliders *colliders, Memory *memory);

pbmpm_collider_def collider_defaults(void);
const char *collider_problem(const pbmpm_collider_def *def);
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
/* Its motion as a rigid body; null: out of memory. */
FreeBody *collider_body(Collider *collider, Memory *memory);
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

#endif
