/* Particle storage: structure of arrays, in sorted order after each substep, with stable identifiers. */
#ifndef PBMPM_SRC_MATTER_PARTICLES_H
#define PBMPM_SRC_MATTER_PARTICLES_H

#include "base/memory.h"
#include "base/pool.h"
#include "kernel_types.h"
#include "pbmpm/material.h"
#include "pbmpm/particles.h"

/* How far particles of fills and emitters are moved at random, as a share of their spacing: half of it to each side. Fills may say otherwise. */
static const float PLACE_JITTER = 0.5f;

/* Sizes of fields, as multiples of one array. */
enum { CLASS_SCALAR, CLASS_VECTOR, CLASS_MATRIX, CLASS_ID, CLASS_COUNT, MAX_FIELDS = 24, MAX_COMPONENTS = 9 };

/* What a field is. Snapshots name fields by these numbers, so none gets another meaning. */
typedef enum FieldTag {
    FIELD_CELL = 1,
    FIELD_FRACTION = 2,
    FIELD_VELOCITY = 3,
    FIELD_AFFINE = 4,
    FIELD_VOLUME_RATIO = 5,
    FIELD_MASS = 6,
    FIELD_MATERIAL = 7,
    FIELD_STATUS = 8,
    FIELD_ID = 9,
    FIELD_DEFORMATION = 10,
    FIELD_PRESSURE = 11,
    FIELD_PAST_VELOCITY = 12,
    FIELD_PAST_AFFINE = 13,
    FIELD_PAST_WAY = 14,
    FIELD_PAST_TURN = 15,
    FIELD_PAST_DT = 16,
    FIELD_USER_VALUE = 17,
} FieldTag;

/* A quantity of the particles: `components` arrays of equal length in one allocation. */
typedef struct Field {
    char *base;
    char *other; /* into which it is written in its new order, by turns; null: into the spare of its class */
    int class;
    FieldTag tag;
    void **component[MAX_COMPONENTS]; /* the pointers below that point into it */
} Field;

typedef struct Particles {
    uint32_t count;
    uint32_t capacity;
    int dimension;
    uint32_t of_material[PBMPM_MAX_MATERIALS]; /* how many have each material */
    /* Position = (cell + fraction) * dx: a scene that is shifted by whole cells moves bit for bit the same. */
    int32_t *cell[3];
    float *fraction[3];
    float *velocity[3];
    float *affine[9]; /* row-major, stride 3 */
    float *volume_ratio;
    float *mass; /* density * rest volume in cells [kg/m^d]; kg = mass * dx^d */
    float *deformation[9];
    float *pressure; /* the dual solver's multiplier; null until it is used */
    /* What BDF2 remembers, see multistep.h; null until it is used. Velocities before the last substep, and its displacement and gradient per
     * second; all hold for substeps of past_dt seconds, 0: there is no past. */
    float *past_velocity[3], *past_affine[9], *past_way[3], *past_turn[9], *past_dt;
    uint32_t *material; /* slot */
    uint32_t *user_value; /* null until there is one */
    int32_t *status;
    pbmpm_particle_id *id;

    Field field[MAX_FIELDS]; /* all of the above that exist; they move together */
    int field_count;
    char *spare[CLASS_COUNT]; /* fields without an `other` go round through it: each leaves its memory to the next */
    float *positions, *kilograms; /* for views */
    size_t array_bytes; /* from one component of a field to the next; twice as much for identifiers */

    bool positions_made, kilograms_made; /* until particles change */
    uint32_t *slot_row;        /* per identifier index: the particle's row; valid when rows_valid */
    uint32_t *slot_generation; /* per identifier index: its live generation, 0 if free */
    uint32_t *free_slot;       /* stack of free identifier indices */
    uint32_t free_count;
    bool rows_valid;
} Particles;

pbmpm_result particles_init(Particles *p, Memory *memory, int dimension, uint32_t capacity);
void particles_free(Particles *p, Memory *memory);

/* Makes room for F (identity); does nothing the second time. */
pbmpm_result particles_enable_deformation(Particles *p, Memory *memory);

/* Makes room for the dual solver's multiplier; does nothing the second time. */
pbmpm_result particles_enable_pressure(Particles *p, Memory *memory);

/* Makes room for numbers of the host's; does nothing the second time. */
pbmpm_result particles_enable_user_values(Particles *p, Memory *memory);

/* Makes room for any field that worlds get only when they need it; UNSUPPORTED for another tag. */
pbmpm_result particles_enable(Particles *p, Memory *memory, FieldTag tag);

/* Takes the newest fields away again: `count` of them stay. */
void particles_keep_fields(Particles *p, Memory *memory, int count);

/* The field, or null if the particles do not have it. */
const Field *particles_field(const Particles *p, FieldTag tag);

/* The class of any field that there can be, or -1. */
int particles_class(uint32_t tag);

/* Whether a field holds real numbers. */
static inline bool particles_is_real(FieldTag tag)
{
    return tag != FIELD_CELL && tag != FIELD_MATERIAL && tag != FIELD_STATUS && tag != FIELD_ID && tag != FIELD_USER_VALUE;
}

/* Sets a field to what it is in new particles: 0, F to the identity. */
void particles_rest(Particles *p, const Field *field);

/* Bytes per particle and component, and components, of a class of fields. */
size_t particles_element_size(int class);
int particles_components(const Particles *p, int class);

/* An array of one float per particle and some to pad a gang, free from the end of a reordering to the next: the i-th component of the spare
 * of a class of fields. */
static inline float *particles_spare(const Particles *p, int class, int i)
{
    return (float *)(void *)(p->spare[class] + (size_t)i * p->array_bytes);
}

/* What one new particle starts as. */
typedef struct NewParticle {
    double position[3]; /* in cells */
    float velocity[3];
    float mass;
    uint32_t material;
    uint32_t user_value; /* there is room for it if it is not 0 */
} NewParticle;

/* There is room, the values are valid. Returns its identifier. */
pbmpm_particle_id particles_append(Particles *p, const NewParticle *particle, uint32_t generation);

/* Removes the particles from row `first` on whose status is not K_ALIVE; the others keep their order. */
void particles_compact(Particles *p, uint32_t first);

/* Brings all fields into the order new[i] = old[order[i]], for the rows from `first` on. Adds its loops to others. */
void particles_reorder(Particles *p, const uint32_t *order, uint32_t first, Loops *loops);

/* Exchanges `count` rows from `a` on with those from `b` on; the two do not overlap. */
void particles_swap(Particles *p, uint32_t a, uint32_t b, uint32_t count);

/* Notes the rows of all particles, unless they are noted. */
void particles_find_rows(Particles *p);

/* The row of a live particle, or false. */
bool particles_row(Particles *p, pbmpm_particle_id id, uint32_t *row);

/* Sets the cell and fraction from a position in cells. */
void particles_set_position(Particles *p, uint32_t row, const double position[3]);
/* Moves a particle by a few cells: rounds like a number of that size, wherever the particle is. */
void particles_shift(Particles *p, uint32_t row, const double way[3]);
double particles_coordinate(const Particles *p, uint32_t row, int axis); /* in cells */

/* d floats [m] per particle, and kilograms, for views; right until the particles change. */
const float *particles_positions(Particles *p, double cell_size, Pool *pool);
const float *particles_kilograms(Particles *p, double cell_volume);

/* The motion of a particle is not what it would have been: its past does not count. */
static inline void particles_forget(Particles *p, uint32_t row)
{
    if (p->past_dt) p->past_dt[row] = 0.0f;
}

/* To be called when any particle has changed. */
static inline void particles_changed(Particles *p) { p->positions_made = p->kilograms_made = false; }

#endif
