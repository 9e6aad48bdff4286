#include "matter/particles.h"

#include <math.h>
#include <string.h>

#include "base/assertion.h"
#include "base/pool.h"
#include "base/result.h"

enum { ROW_GRAIN = 8192 };

int particles_components(const Particles *p, int class)
{
    const int d = p->dimension;
    return class == CLASS_VECTOR ? d : class == CLASS_MATRIX ? d * d : 1;
}

size_t particles_element_size(int class) { return class == CLASS_ID ? sizeof(pbmpm_particle_id) : 4; }

int particles_class(uint32_t tag)
{
    switch (tag) {
    case FIELD_CELL:
    case FIELD_FRACTION:
    case FIELD_PAST_VELOCITY:
    case FIELD_PAST_WAY:
    case FIELD_VELOCITY: return CLASS_VECTOR;
    case FIELD_AFFINE:
    case FIELD_PAST_AFFINE:
    case FIELD_PAST_TURN:
    case FIELD_DEFORMATION: return CLASS_MATRIX;
    case FIELD_VOLUME_RATIO:
    case FIELD_MASS:
    case FIELD_MATERIAL:
    case FIELD_STATUS:
    case FIELD_PAST_DT:
    case FIELD_USER_VALUE:
    case FIELD_PRESSURE: return CLASS_SCALAR;
    case FIELD_ID: return CLASS_ID;
    default: return -1;
    }
}

static size_t field_bytes(const Particles *p, int class)
{
    return (size_t)particles_components(p, class) * p->array_bytes * (particles_element_size(class) / 4);
}

/* Points the components of a field into its memory. */
static void bind_field(const Particles *p, const Field *field)
{
    for (int c = 0; c < particles_components(p, field->class); c++) *field->component[c] = field->base + (size_t)c * p->array_bytes;
}

/* What hosts draw keeps to its own memory, so that a view which has expired shows nothing else. Matrices do not: theirs is a third of a world's. */
static bool is_drawn(FieldTag tag)
{
    return tag == FIELD_VELOCITY || tag == FIELD_VOLUME_RATIO || tag == FIELD_MATERIAL || tag == FIELD_ID || tag == FIELD_PRESSURE;
}

/* `pointers`: the first of the component pointers; those of a matrix stand in rows of three. */
static bool add_field(Particles *p, Memory *memory, FieldTag tag, void **pointers)
{
    const int class = particles_class(tag);
    Field *field = &p->field[p->field_count];
    *field = (Field){.base = memory_take(memory, field_bytes(p, class)), .class = class, .tag = tag};
    if (!field->base) return false;
    char **spare = is_drawn(tag) ? &field->other : &p->spare[class];
    if (!*spare && !(*spare = memory_take(memory, field_bytes(p, class)))) {
        memory_give(memory, field->base, field_bytes(p, class));
        return false;
    }
    for (int c = 0; c < particles_components(p, class); c++)
        field->component[c] = pointers + (class == CLASS_MATRIX ? c / p->dimension * 3 + c % p->dimension : c);
    bind_field(p, field);
    p->field_count++;
    return true;
}

static bool add_fields(Particles *p, Memory *memory)
{
    return add_field(p, memory, FIELD_CELL, (void **)p->cell) &&
           add_field(p, memory, FIELD_FRACTION, (void **)p->fraction) &&
           add_field(p, memory, FIELD_VELOCITY, (void **)p->velocity) &&
           add_field(p, memory, FIELD_AFFINE, (void **)p->affine) &&
           add_field(p, memory, FIELD_VOLUME_RATIO, (void **)&p->volume_ratio) &&
           add_field(p, memory, FIELD_MASS, (void **)&p->mass) &&
           add_field(p, memory, FIELD_MATERIAL, (void **)&p->material) &&
           add_field(p, memory, FIELD_STATUS, (void **)&p->status) &&
           add_field(p, memory, FIELD_ID, (void **)&p->id);
}

static size_t table_bytes(const Particles *p) { return (size_t)p->capacity * sizeof(uint32_t); }

pbmpm_result particles_init(Particles *p, Memory *memory, int dimension, uint32_t capacity)
{
    const size_t padded = ((size_t)capacity + K_MAX_GANG + 15) / 16 * 16; /* whole cache lines */
    *p = (Particles){.capacity = capacity, .dimension = dimension, .array_bytes = padded * 4};
    const bool ok = add_fields(p, memory) && (p->positions = memory_take(memory, field_bytes(p, CLASS_VECTOR))) &&
                    (p->kilograms = memory_take(memory, field_bytes(p, CLASS_SCALAR))) && (p->slot_row = memory_take(memory, table_bytes(p))) &&
                    (p->slot_generation = memory_take(memory, table_bytes(p))) &&
                    (p->free_slot = memory_take(memory, table_bytes(p)));
    if (!ok) {
        particles_free(p, memory);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u particles", capacity);
    }
    p->free_count = capacity;
    for (uint32_t i = 0; i < capacity; i++) p->free_slot[i] = capacity - 1 - i;
    return PBMPM_OK;
}

static void free_field(Particles *p, Memory *memory, const Field *field)
{
    memory_give(memory, field->base, field_bytes(p, field->class));
    memory_give(memory, field->other, field_bytes(p, field->class));
}

void particles_free(Particles *p, Memory *memory)
{
    for (int i = 0; i < p->field_count; i++) free_field(p, memory, &p->field[i]);
    memory_give(memory, p->positions, field_bytes(p, CLASS_VECTOR));
    memory_give(memory, p->kilograms, field_bytes(p, CLASS_SCALAR));
    for (int class = 0; class < CLASS_COUNT; class++) memory_give(memory, p->spare[class], field_bytes(p, class));
    memory_give(memory, p->slot_row, table_bytes(p));
    memory_give(memory, p->slot_generation, table_bytes(p));
    memory_give(memory, p->free_slot, table_bytes(p));
    *p = (Particles){0};
}

pbmpm_result particles_enable_deformation(Particles *p, Memory *memory)
{
    if (p->deformation[0]) return PBMPM_OK;
    if (!add_field(p, memory, FIELD_DEFORMATION, (void **)p->deformation))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the deformation of %u particles", p->capacity);
    for (int r = 0; r < p->dimension; r++)
        for (uint32_t i = 0; i < p->capacity; i++) p->deformation[r * 4][i] = 1.0f;
    return PBMPM_OK;
}

pbmpm_result particles_enable_pressure(Particles *p, Memory *memory)
{
    if (p->pressure || add_field(p, memory, FIELD_PRESSURE, (void **)&p->pressure)) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the pressure of %u particles", p->capacity);
}

pbmpm_result particles_enable_user_values(Particles *p, Memory *memory)
{
    if (p->user_value) return PBMPM_OK;
    if (!add_field(p, memory, FIELD_USER_VALUE, (void **)&p->user_value))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the user values of %u particles", p->capacity);
    memset(p->user_value, 0, p->count * sizeof *p->user_value);
    return PBMPM_OK;
}

static pbmpm_result enable_past(Particles *p, Memory *memory, FieldTag tag, void **pointers)
{
    if (*pointers || add_field(p, memory, tag, pointers)) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the past of %u particles", p->capacity);
}

pbmpm_result particles_enable(Particles *p, Memory *memory, FieldTag tag)
{
    switch (tag) {
    case FIELD_DEFORMATION: return particles_enable_deformation(p, memory);
    case FIELD_PRESSURE: return particles_enable_pressure(p, memory);
    case FIELD_USER_VALUE: return particles_enable_user_values(p, memory);
    case FIELD_PAST_VELOCITY: return enable_past(p, memory, tag, (void **)p->past_velocity);
    case FIELD_PAST_AFFINE: return enable_past(p, memory, tag, (void **)p->past_affine);
    case FIELD_PAST_WAY: return enable_past(p, memory, tag, (void **)p->past_way);
    case FIELD_PAST_TURN: return enable_past(p, memory, tag, (void **)p->past_turn);
    case FIELD_PAST_DT: return enable_past(p, memory, tag, (void **)&p->past_dt);
    case FIELD_CELL:
    case FIELD_FRACTION:
    case FIELD_VELOCITY:
    case FIELD_AFFINE:
    case FIELD_VOLUME_RATIO:
    case FIELD_MASS:
    case FIELD_MATERIAL:
    case FIELD_STATUS:
    case FIELD_ID: break; /* are always there */
    }
    return fail(PBMPM_ERROR_UNSUPPORTED, "particles have no field %d", (int)tag);
}

void particles_keep_fields(Particles *p, Memory *memory, int count)
{
    while (p->field_count > count) {
        const Field *field = &p->field[--p->field_count];
        for (int c = 0; c < particles_components(p, field->class); c++) *field->component[c] = NULL;
        free_field(p, memory, field);
    }
}

const Field *particles_field(const Particles *p, FieldTag tag)
{
    for (int i = 0; i < p->field_count; i++)
        if (p->field[i].tag == tag) return &p->field[i];
    return NULL;
}

void particles_rest(Particles *p, const Field *field)
{
    for (int c = 0; c < particles_components(p, field->class); c++)
        memset(*field->component[c], 0, p->count * particles_element_size(field->class));
    for (int a = 0; a < p->dimension && field->tag == FIELD_DEFORMATION; a++)
        for (uint32_t i = 0; i < p->count; i++) p->deformation[a * 4][i] = 1.0f;
}

/* Sets one coordinate to `cell` + `place`. */
static void set_coordinate(Particles *p, uint32_t row, int axis, int32_t cell, double place)
{
    double node = floor(place + 0.5);
    float fraction = (float)(place - node);
    if (fraction >= 0.5f) { /* rounding can reach the far end of [-1/2, 1/2) */
        fraction -= 1.0f;
        node += 1.0;
    }
    p->cell[axis][row] = cell + (int32_t)node;
    p->fraction[axis][row] = fraction;
}

void particles_set_position(Particles *p, uint32_t row, const double position[3])
{
    for (int a = 0; a < p->dimension; a++) set_coordinate(p, row, a, 0, position[a]);
}

void particles_shift(Particles *p, uint32_t row, const double way[3])
{
    for (int a = 0; a < p->dimension; a++) set_coordinate(p, row, a, p->cell[a][row], (double)p->fraction[a][row] + way[a]);
}

double particles_coordinate(const Particles *p, uint32_t row, int axis)
{
    return (double)p->cell[axis][row] + (double)p->fraction[axis][row];
}

pbmpm_particle_id particles_append(Particles *p, const NewParticle *particle, uint32_t generation)
{
    const uint32_t row = p->count++;
    const uint32_t slot = p->free_slot[--p->free_count];
    particles_set_position(p, row, particle->position);
    for (int a = 0; a < p->dimension; a++) {
        p->velocity[a][row] = particle->velocity[a];
        for (int c = 0; c < p->dimension; c++) {
            p->affine[a * 3 + c][row] = 0.0f;
            if (p->deformation[0]) p->deformation[a * 3 + c][row] = a == c ? 1.0f : 0.0f;
        }
    }
    p->volume_ratio[row] = 1.0f;
    if (p->pressure) p->pressure[row] = 0.0f;
    if (p->user_value) p->user_value[row] = particle->user_value;
    particles_forget(p, row);
    p->mass[row] = particle->mass;
    p->material[row] = particle->material;
    p->of_material[particle->material]++;
    p->status[row] = K_ALIVE;
    p->id[row] = (pbmpm_particle_id){slot, generation};
    p->slot_row[slot] = row;
    p->slot_generation[slot] = generation;
    particles_changed(p);
    return p->id[row];
}

/* Moves the kept elements of one array to the front. */
static void compact_array(const Particles *p, uint32_t first, void *array, size_t size)
{
    char *data = array;
    size_t kept = first;
    for (uint32_t i = first; i < p->count; i++) {
        if (p->status[i] != K_ALIVE) continue;
        if (kept != i) memcpy(data + kept * size, data + i * size, size);
        kept++;
    }
}

void particles_compact(Particles *p, uint32_t first)
{
    uint32_t kept = first;
    for (uint32_t i = first; i < p->count; i++) {
        if (p->status[i] == K_ALIVE) {
            kept++;
            continue;
        }
        p->of_material[p->material[i]]--;
        p->slot_generation[p->id[i].index] = 0;
        p->free_slot[p->free_count++] = p->id[i].index;
    }
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        if (field->base == (char *)p->status) continue;
        for (int c = 0; c < particles_components(p, field->class); c++)
            compact_array(p, first, *field->component[c], particles_element_size(field->class));
    }
    memset(p->status + first, 0, (size_t)(p->count - first) * sizeof *p->status);
    p->count = kept;
    p->rows_valid = false;
    particles_changed(p);
}

/* One field, which goes from its own memory to other, or back. */
typedef struct Reorder {
    const uint32_t *order;
    char *from, *to;
    size_t array_bytes;
    uint32_t first;
    int class, components;
} Reorder;

static void reorder_4(const uint32_t *restrict order, const uint32_t *restrict from, uint32_t *restrict to, int32_t begin, int32_t end)
{
    for (int32_t i = begin; i < end; i++) to[i] = from[order[i]];
}

static void reorder_8(const uint32_t *restrict order, const uint64_t *restrict from, uint64_t *restrict to, int32_t begin, int32_t end)
{
    for (int32_t i = begin; i < end; i++) to[i] = from[order[i]];
}

static void reorder_field(void *context, int32_t begin, int32_t end)
{
    const Reorder *job = context;
    begin += (int32_t)job->first;
    end += (int32_t)job->first;
    if (job->class == CLASS_ID) {
        reorder_8(job->order, (const uint64_t *)(void *)job->from, (uint64_t *)(void *)job->to, begin, end);
        return;
    }
    for (int c = 0; c < job->components; c++) {
        const size_t array = (size_t)c * job->array_bytes;
        reorder_4(job->order, (const uint32_t *)(void *)(job->from + array), (uint32_t *)(void *)(job->to + array), begin, end);
    }
}

/* From where it was sorted to back to where it came from. */
static void copy_back(void *context, int32_t begin, int32_t end)
{
    const Reorder *job = context;
    const size_t size = particles_element_size(job->class), at = ((size_t)job->first + (size_t)begin) * size;
    for (int c = 0; c < job->components; c++) {
        const size_t array = (size_t)c * job->array_bytes + at; /* identifiers have one component */
        memcpy(job->from + array, job->to + array, (size_t)(end - begin) * size);
    }
}

/* The kernels load whole gangs, so behind the last particle there are K_MAX_GANG harmless ones: no mass, no motion, at rest volume.
 * What the spares held there may have been anything: a cell number of -1 reads as a NaN fraction. */
static void pad(const Particles *p)
{
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        const size_t size = particles_element_size(field->class);
        for (int c = 0; c < particles_components(p, field->class); c++)
            memset((char *)*field->component[c] + p->count * size, 0, K_MAX_GANG * size);
    }
    for (uint32_t i = p->count; i < p->count + K_MAX_GANG; i++) {
        p->volume_ratio[i] = 1.0f;
        for (int a = 0; a < p->dimension && p->deformation[0]; a++) p->deformation[a * 4][i] = 1.0f;
    }
}

typedef struct Adopt {
    Particles *particles;
    bool swaps;
} Adopt;

/* What was sorted into other memory becomes the fields, and what they were is where the next are sorted to. */
static void adopt(void *context, int32_t begin, int32_t end)
{
    const Adopt *job = context;
    Particles *p = job->particles;
    (void)begin;
    (void)end;
    for (int i = 0; i < p->field_count && job->swaps; i++) {
        Field *field = &p->field[i];
        char **other = field->other ? &field->other : &p->spare[field->class], *sorted = *other;
        *other = field->base;
        field->base = sorted;
        bind_field(p, field);
    }
    pad(p);
    p->rows_valid = false;
    particles_changed(p);
}

void particles_reorder(Particles *p, const uint32_t *order, uint32_t first, Loops *loops)
{
    const Adopt last = {p, first == 0};
    char *spare[CLASS_COUNT];
    memcpy(spare, p->spare, sizeof spare);
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        const int components = particles_components(p, field->class);
        const uint32_t count = p->count - first;
        char *other = field->other ? field->other : spare[field->class];
        const Reorder job = {order, field->base, other, p->array_bytes, first, field->class, components};
        const Span rows = {(int32_t)count, ROW_GRAIN, (int64_t)count * components};
        LOOPS_ADD(loops, rows, reorder_field, &job);
        if (first > 0)
            LOOPS_ADD(loops, rows, copy_back, &job);
        else if (!field->other)
            spare[field->class] = field->base;
    }
    LOOPS_ADD(loops, span_once(), adopt, &last);
}

void particles_swap(Particles *p, uint32_t a, uint32_t b, uint32_t count)
{
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        const size_t words = particles_element_size(field->class) / sizeof(uint32_t);
        for (int c = 0; c < particles_components(p, field->class); c++) {
            uint32_t *data = *field->component[c], *left = data + a * words, *right = data + b * words;
            for (size_t w = 0; w < count * words; w++) {
                const uint32_t kept = left[w];
                left[w] = right[w];
                right[w] = kept;
            }
        }
    }
    p->rows_valid = false;
    particles_changed(p);
}

void particles_find_rows(Particles *p)
{
    if (p->rows_valid) return; /* and not even that is written: readers look at it */
    for (uint32_t i = 0; i < p->count; i++) {
        ASSERT(p->id[i].index < p->capacity && p->id[i].generation != 0);
        p->slot_row[p->id[i].index] = i;
    }
    p->rows_valid = true;
}

bool particles_row(Particles *p, pbmpm_particle_id id, uint32_t *row)
{
    if (id.index >= p->capacity || id.generation == 0 || p->slot_generation[id.index] != id.generation) return false;
    particles_find_rows(p);
    *row = p->slot_row[id.index];
    return true;
}

typedef struct MakePositions {
    const Particles *particles;
    float *positions;
    double cell_size;
} MakePositions;

static void make_positions(void *context, int32_t begin, int32_t end)
{
    const MakePositions *job = context;
    const Particles *p = job->particles;
    const int d = p->dimension;
    for (int32_t i = begin; i < end; i++)
        for (int a = 0; a < d; a++)
            job->positions[(size_t)i * d + a] = (float)(particles_coordinate(p, (uint32_t)i, a) * job->cell_size);
}

const float *particles_positions(Particles *p, double cell_size, Pool *pool)
{
    MakePositions job = {p, p->positions, cell_size};
    if (!p->positions_made) pool_for(pool, (int32_t)p->count, ROW_GRAIN, make_positions, &job);
    p->positions_made = true;
    return p->positions;
}

const float *particles_kilograms(Particles *p, double cell_volume)
{
    for (uint32_t i = 0; i < p->count && !p->kilograms_made; i++) p->kilograms[i] = (float)((double)p->mass[i] * cell_volume);
    p->kilograms_made = true;
    return p->kilograms;
}
