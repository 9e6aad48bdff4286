/* Sources of particles. */
#ifndef PBMPM_SRC_WORLD_EMITTERS_H
#define PBMPM_SRC_WORLD_EMITTERS_H

#include <stdbool.h>

#include "base/memory.h"
#include "pbmpm/drain.h"
#include "pbmpm/emitter.h"

/* Of the bounds of an emitter; with its float per node that is 16 MB. A way in one part of a step that adds as many nodes is a jump. */
static const double EMITTER_CELLS_MAX = 4194304.0;

/* What changes as an emitter works. */
typedef struct EmitterState {
    double due;     /* particles and the fraction of one; 1/2 at the beginning */
    uint64_t drawn; /* places of the sequence that were used */
    uint64_t born;  /* particles that were due */
    uint64_t emitted, refused_full, refused_budget, refused_capacity;
    double emitted_mass; /* [kg] */
} EmitterState;

typedef struct Emitter {
    uint32_t generation; /* 0: free slot */
    pbmpm_emitter_def def;
    pbmpm_shape shape; /* where it stands now */
    float target_position[3]; /* where the next step takes it */
    float target_rotation[4];
    bool moving;
    EmitterState state;
} Emitter;

typedef struct Emitters {
    Emitter *slot; /* PBMPM_MAX_EMITTERS; null until there is one */
    uint32_t used; /* slots [used, PBMPM_MAX_EMITTERS) were never taken */
    Array occupancy;   /* float per node around one emitter: rest volume per cell */
} Emitters;

void emitters_free(Emitters *emitters, Memory *memory);

pbmpm_emitter_def emitter_defaults(void);
/* Null if valid, else what is wrong. */
const char *emitter_problem(const pbmpm_emitter_def *def, const pbmpm_shape *shape, int dimension, double cell_size);
pbmpm_result emitters_add(Emitters *emitters, Memory *memory, const pbmpm_emitter_def *def, const pbmpm_shape *shape, uint32_t generation,
                           pbmpm_emitter_id *id);
Emitter *emitters_find(const Emitters *emitters, pbmpm_emitter_id id); /* null if not live */
void emitter_set(Emitter *emitter, const pbmpm_emitter_def *def, const pbmpm_shape *shape);
/* The shape whose bounds hold the region: for a disc the ball around it. */
pbmpm_shape emitter_enclosing_shape(const pbmpm_emitter_def *def, const pbmpm_shape *shape);
void emitter_move(Emitter *emitter, const float position[3], const float *rotation);
/* It is where it is going to. */
void emitter_arrive(Emitter *emitter);
bool emitters_use(const Emitters *emitters, pbmpm_material_id material);
void emitter_report(const Emitter *emitter, pbmpm_emitter_status *status);

/* After the last part: the targets are reached. */
void emitters_end_step(Emitters *emitters);

#endif
