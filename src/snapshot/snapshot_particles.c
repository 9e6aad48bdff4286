#include "snapshot/snapshot_particles.h"

#include <float.h>
#include <string.h>

#include "base/generations.h"
#include "base/result.h"

/* What the payload begins with. Then: a SavedField per field, their arrays component by component, the free identifiers. */
typedef struct Contents {
    uint32_t count;   /* particles */
    uint32_t fields;
    uint32_t touched; /* identifiers with an index below this have been used */
    uint32_t freed;   /* of those, how many are free again */
} Contents;

typedef struct SavedField {
    uint32_t tag;
    uint32_t bytes; /* per particle */
} SavedField;

/* ---- Fields ---- */

/* The status is 0 for all between steps. */
static bool is_saved(const Field *field) { return field->tag != FIELD_STATUS; }

static uint32_t field_bytes(const Particles *p, int class)
{
    return (uint32_t)(particles_components(p, class) * (int)particles_element_size(class));
}

uint32_t particles_section_bytes_each(const World *world)
{
    const Particles *p = &world->particles;
    uint32_t bytes = 0;
    for (int i = 0; i < p->field_count; i++)
        if (is_saved(&p->field[i])) bytes += field_bytes(p, p->field[i].class);
    return bytes;
}

/* ---- Identifiers: the stack of free indices decides which ones come next ---- */

/* Indices that were never used lie at the bottom of the stack, the highest first; only what lies above is saved. */
static uint32_t untouched(const Particles *p)
{
    uint32_t n = 0;
    while (n < p->free_count && p->free_slot[n] == p->capacity - 1 - n) n++;
    return n;
}

/* ---- Saving ---- */

static void save_particles(const World *world, SnapshotOut *out)
{
    const Particles *p = &world->particles;
    const uint32_t never_used = untouched(p);
    Contents contents = {.count = p->count, .touched = p->capacity - never_used, .freed = p->free_count - never_used};
    for (int i = 0; i < p->field_count; i++) contents.fields += is_saved(&p->field[i]);
    snapshot_put(out, &contents, sizeof contents);
    for (int i = 0; i < p->field_count; i++) {
        const SavedField saved = {p->field[i].tag, field_bytes(p, p->field[i].class)};
        if (is_saved(&p->field[i])) snapshot_put(out, &saved, sizeof saved);
    }
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        const size_t bytes = p->count * particles_element_size(field->class);
        for (int c = 0; c < particles_components(p, field->class) && is_saved(field); c++) snapshot_put(out, *field->component[c], bytes);
    }
    snapshot_put(out, p->free_slot + never_used, contents.freed * sizeof *p->free_slot);
}

/* ---- Reading the table of contents ---- */

typedef struct Reading {
    Contents contents;
    SavedField field[MAX_FIELDS];
    SnapshotIn arrays; /* at the first array */
} Reading;

static bool read_contents(SnapshotIn in, Reading *reading)
{
    Contents *contents = &reading->contents;
    if (!snapshot_take(&in, contents, sizeof *contents) || contents->fields > MAX_FIELDS) return false;
    uint64_t each = 0;
    for (uint32_t i = 0; i < contents->fields; i++) {
        if (!snapshot_take(&in, &reading->field[i], sizeof *reading->field)) return false;
        each += reading->field[i].bytes;
    }
    reading->arrays = in;
    return in.bytes - in.at == contents->count * each + contents->freed * (uint64_t)sizeof(uint32_t);
}

/* The place of a field's first array in the payload, or null. */
static const char *array_of(const Reading *reading, FieldTag tag)
{
    const char *at = reading->arrays.data + reading->arrays.at;
    for (uint32_t i = 0; i < reading->contents.fields; i++) {
        if (reading->field[i].tag == tag) return at;
        at += (uint64_t)reading->contents.count * reading->field[i].bytes;
    }
    return NULL;
}

static const char *free_indices(const Reading *reading)
{
    return reading->arrays.data + reading->arrays.bytes - reading->contents.freed * (uint64_t)sizeof(uint32_t);
}

static uint32_t u32_at(const char *array, uint64_t i)
{
    uint32_t value;
    memcpy(&value, array + i * sizeof value, sizeof value);
    return value;
}

static float float_at(const char *array, uint64_t i)
{
    float value;
    memcpy(&value, array + i * sizeof value, sizeof value);
    return value;
}

/* ---- Checking ---- */

/* Every field is known, has the size it has here, and occurs once; those that no world can be without are there. */
static bool fields_fit(const World *world, const Reading *reading)
{
    const Particles *p = &world->particles;
    for (uint32_t i = 0; i < reading->contents.fields; i++) {
        const int class = particles_class(reading->field[i].tag);
        if (class < 0 || reading->field[i].tag == FIELD_STATUS || reading->field[i].bytes != field_bytes(p, class)) return false;
        for (uint32_t k = 0; k < i; k++)
            if (reading->field[k].tag == reading->field[i].tag) return false;
    }
    static const FieldTag needed[] = {FIELD_CELL,         FIELD_FRACTION, FIELD_VELOCITY, FIELD_AFFINE,
                                      FIELD_VOLUME_RATIO, FIELD_MASS, FIELD_MATERIAL, FIELD_ID};
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!array_of(reading, needed[i])) return false;
    return true;
}

/* What a step relies on without looking. All else it checks itself. */
static bool values_fit(const World *world, const Reading *reading)
{
    const int16_t *place = reading->arrays.restoring->material;
    const uint32_t count = reading->contents.count;
    const char *cell = array_of(reading, FIELD_CELL), *fraction = array_of(reading, FIELD_FRACTION);
    const char *material = array_of(reading, FIELD_MATERIAL), *mass = array_of(reading, FIELD_MASS);
    const bool deforms = array_of(reading, FIELD_DEFORMATION);
    for (uint64_t i = 0; i < (uint64_t)count * (uint64_t)world->def.dimension; i++) {
        const int32_t where = (int32_t)u32_at(cell, i);
        if (where < -CELL_LIMIT - 1 || where > CELL_LIMIT + 1) return false;
        if (!(float_at(fraction, i) >= -0.5f && float_at(fraction, i) <= 0.5f)) return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t slot = u32_at(material, i);
        if (slot >= PBMPM_MAX_MATERIALS || place[slot] < 0) return false;
        if (!deforms && material_is_solid(&world->materials, (uint32_t)place[slot])) return false;
        if (!(float_at(mass, i) > 0.0f && float_at(mass, i) <= FLT_MAX)) return false;
    }
    return true;
}

static bool generation_fits(uint32_t generation) { return generation > 0 && generation <= GENERATION_STORED_MAX; }

/* Used and free indices together are all that were ever touched, each once. */
static bool identifiers_fit(World *world, const Reading *reading)
{
    const Contents *contents = &reading->contents;
    const char *ids = array_of(reading, FIELD_ID), *freed = free_indices(reading);
    int32_t *mark = world->grid.block_of; /* scratch of the next sort */
    if ((uint64_t)contents->count + contents->freed != contents->touched) return false;
    memset(mark, 0, contents->touched * sizeof *mark);
    for (uint32_t i = 0; i < contents->touched; i++) {
        const bool live = i < contents->count;
        const uint32_t index = live ? u32_at(ids, 2 * (uint64_t)i) : u32_at(freed, i - contents->count);
        if (index >= contents->touched || mark[index] || (live && !generation_fits(u32_at(ids, 2 * (uint64_t)i + 1)))) return false;
        mark[index] = 1;
    }
    return true;
}

static pbmpm_result reserve_particles(World *world, SnapshotIn in)
{
    Particles *p = &world->particles;
    Reading reading;
    if (!read_contents(in, &reading)) return snapshot_malformed(); /* never: it was checked */
    const int before = p->field_count;
    for (uint32_t i = 0; i < reading.contents.fields; i++) {
        if (particles_field(p, reading.field[i].tag)) continue;
        const pbmpm_result result = particles_enable(p, &world->memory, reading.field[i].tag);
        if (result == PBMPM_OK) continue;
        particles_keep_fields(p, &world->memory, before);
        return result;
    }
    return PBMPM_OK;
}

static pbmpm_result check_particles(World *world, SnapshotIn in)
{
    Reading reading;
    if (!read_contents(in, &reading)) return snapshot_malformed();
    if (reading.contents.touched > world->particles.capacity)
        return fail(PBMPM_ERROR_CAPACITY, "the snapshot's %u particles have used %u identifiers; this world has room for %u",
                    reading.contents.count, reading.contents.touched, world->particles.capacity);
    if (!fields_fit(world, &reading) || !identifiers_fit(world, &reading) || !values_fit(world, &reading)) return snapshot_malformed();
    return PBMPM_OK;
}

/* ---- Loading ---- */

static void load_identifiers(Particles *p, const Reading *reading)
{
    const Contents *contents = &reading->contents;
    const uint32_t never_used = p->capacity - contents->touched;
    uint32_t newest = 0;
    memset(p->slot_generation, 0, p->capacity * sizeof *p->slot_generation);
    for (uint32_t i = 0; i < p->count; i++) {
        p->slot_generation[p->id[i].index] = p->id[i].generation;
        newest = p->id[i].generation > newest ? p->id[i].generation : newest;
    }
    for (uint32_t i = 0; i < never_used; i++) p->free_slot[i] = p->capacity - 1 - i;
    memcpy(p->free_slot + never_used, free_indices(reading), contents->freed * sizeof *p->free_slot);
    p->free_count = p->capacity - p->count;
    p->rows_valid = false;
    generation_skip_of_particles(newest);
}

static void load_particles(World *world, SnapshotIn in)
{
    Particles *p = &world->particles;
    Reading reading;
    if (!read_contents(in, &reading)) return; /* never: it was checked */
    p->count = reading.contents.count;
    for (int i = 0; i < p->field_count; i++) {
        const Field *field = &p->field[i];
        const size_t bytes = p->count * particles_element_size(field->class);
        const char *array = array_of(&reading, field->tag);
        if (!array) {
            particles_rest(p, field);
            continue;
        }
        for (int c = 0; c < particles_components(p, field->class); c++, array += bytes) memcpy(*field->component[c], array, bytes);
    }
    memset(p->of_material, 0, sizeof p->of_material);
    for (uint32_t i = 0; i < p->count; i++) {
        p->material[i] = (uint32_t)in.restoring->material[p->material[i]];
        p->of_material[p->material[i]]++;
    }
    load_identifiers(p, &reading);
    particles_changed(p);
}

const SnapshotSection particles_section = {6, save_particles, check_particles, reserve_particles, load_particles};
