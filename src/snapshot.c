#include "snapshot.h"

#include <math.h>
#include <string.h>

#include "result.h"
#include "snapshot_flow.h"
#include "snapshot_particles.h"

/* What a snapshot begins with. */
typedef struct Header {
    char magic[8];
    uint32_t version;
    uint32_t sections;
    uint64_t bytes; /* of the whole snapshot */
    uint64_t checksum;
} Header;

typedef struct SectionHeader {
    uint32_t tag;
    uint32_t reserved; /* 0 */
    uint64_t bytes;    /* of the payload, without padding */
} SectionHeader;

static const char MAGIC[8] = {'p', 'b', 'm', 'p', 'm', 'S', 'n', 'p'};

enum { WORD = 8, CHECKED_BEFORE = offsetof(Header, checksum) };
_Static_assert(sizeof(Header) % WORD == 0 && sizeof(SectionHeader) % WORD == 0 && CHECKED_BEFORE % WORD == 0, "whole words");

/* ---- Checksum ---- */

enum { LANES = 4 };

static uint64_t mix_word(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}

static uint64_t word_at(const char *bytes, uint64_t word)
{
    uint64_t value;
    memcpy(&value, bytes + word * WORD, WORD);
    return value;
}

/* Each word goes into one of four chains, which a processor works on at once. Every link of a chain is a bijection, so a change
 * inside one word is always seen; others escape once in 2^64. The place of the sum itself is left out. */
static uint64_t checksum_of(const char *snapshot, uint64_t bytes)
{
    uint64_t lane[LANES] = {1, 2, 3, 4};
    for (uint64_t w = 0; w < CHECKED_BEFORE / WORD; w++) lane[w % LANES] = mix_word(lane[w % LANES], word_at(snapshot, w));
    const char *rest = snapshot + sizeof(Header);
    const uint64_t words = (bytes - sizeof(Header)) / WORD;
    uint64_t w = 0;
    for (; w + LANES <= words; w += LANES)
        for (int k = 0; k < LANES; k++) lane[k] = mix_word(lane[k], word_at(rest, w + (uint64_t)k));
    for (; w < words; w++) lane[w % LANES] = mix_word(lane[w % LANES], word_at(rest, w));
    return mix_word(mix_word(mix_word(lane[0], lane[1]), lane[2]), lane[3]);
}

/* ---- Payloads ---- */

void snapshot_put(SnapshotOut *out, const void *data, size_t bytes)
{
    if (out->data && bytes) memcpy(out->data + out->at, data, bytes);
    out->at += bytes;
}

bool snapshot_take(SnapshotIn *in, void *data, size_t bytes)
{
    const bool enough = in->bytes - in->at >= bytes;
    if (enough && bytes) memcpy(data, in->data + in->at, bytes);
    if (!enough) memset(data, 0, bytes);
    in->at += enough ? bytes : 0;
    return enough;
}

pbmpm_result snapshot_take_slot(SnapshotIn *in, void *entry, size_t bytes, uint32_t slot, const char *things)
{
    if (snapshot_take(in, entry, bytes) && memcmp(entry, &slot, sizeof slot) == 0) return PBMPM_OK;
    return fail(PBMPM_ERROR_FOREIGN, "the snapshot has other %s than the world: not the one at index %u", things, slot);
}

pbmpm_result snapshot_at_end(const SnapshotIn *in, const char *things)
{
    return in->at == in->bytes ? PBMPM_OK : fail(PBMPM_ERROR_FOREIGN, "the snapshot has more %s than the world", things);
}

pbmpm_result snapshot_malformed(void)
{
    return fail(PBMPM_ERROR_FOREIGN, "a section of the snapshot is not laid out as this version writes it");
}

/* ---- What the world is made of: compared, not loaded ---- */

typedef struct Made {
    int32_t dimension;
    float cell_size;
    int32_t domain_enabled;
    float domain_min[3], domain_max[3];
    float domain_friction;
} Made;

static Made made_of(const World *world)
{
    const pbmpm_world_def *def = &world->def;
    Made made = {.dimension = def->dimension, .cell_size = def->cell_size, .domain_enabled = def->domain_enabled};
    for (int a = 0; a < def->dimension && def->domain_enabled; a++) {
        made.domain_min[a] = def->domain_min[a];
        made.domain_max[a] = def->domain_max[a];
    }
    if (def->domain_enabled) made.domain_friction = def->domain_friction;
    return made;
}

static void save_made(const World *world, SnapshotOut *out)
{
    const Made made = made_of(world);
    snapshot_put(out, &made, sizeof made);
}

static pbmpm_result check_made(World *world, SnapshotIn in)
{
    const Made own = made_of(world);
    Made made;
    if (in.bytes != sizeof made || !snapshot_take(&in, &made, sizeof made)) return snapshot_malformed();
    if (made.dimension != own.dimension)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot is of a world in %dD, not %dD", made.dimension, own.dimension);
    if (made.cell_size != own.cell_size)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot's world has the cell size %g, not %g", (double)made.cell_size, (double)own.cell_size);
    if (memcmp(&made, &own, sizeof made) != 0) return fail(PBMPM_ERROR_FOREIGN, "the snapshot's world has another domain box");
    return PBMPM_OK;
}

static void load_nothing(World *world, SnapshotIn in)
{
    (void)world;
    (void)in;
}

typedef struct SavedMaterial {
    uint32_t slot;
    pbmpm_material_def def;
} SavedMaterial;

static void save_materials(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->materials.generation[slot] == 0) continue;
        const SavedMaterial saved = {slot, world->materials.def[slot]};
        snapshot_put(out, &saved, sizeof saved);
    }
}

static pbmpm_result check_materials(World *world, SnapshotIn in)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->materials.generation[slot] == 0) continue;
        SavedMaterial saved;
        const pbmpm_result result = snapshot_take_slot(&in, &saved, sizeof saved, slot, "materials");
        if (result != PBMPM_OK) return result;
        if (memcmp(&saved.def, &world->materials.def[slot], sizeof saved.def) != 0)
            return fail(PBMPM_ERROR_FOREIGN, "material %u has other parameters than in the snapshot", slot);
    }
    return snapshot_at_end(&in, "materials");
}

/* ---- Settings and counters ---- */

static void save_settings(const World *world, SnapshotOut *out) { snapshot_put(out, &world->settings, sizeof world->settings); }

static pbmpm_result check_settings(World *world, SnapshotIn in)
{
    pbmpm_settings settings;
    if (in.bytes != sizeof settings || !snapshot_take(&in, &settings, sizeof settings)) return snapshot_malformed();
    const char *problem = settings_problem(&settings, world->def.dimension);
    return problem ? fail(PBMPM_ERROR_FOREIGN, "the snapshot's settings: %s", problem) : PBMPM_OK;
}

static void load_settings(World *world, SnapshotIn in) { snapshot_take(&in, &world->settings, sizeof world->settings); }

typedef struct Counters {
    uint64_t step_count, deleted_total, clamped_total;
    double simulated_seconds;
    double slow_dt, slow_iterations;
    uint64_t strain_unchecked;
    double credit;
} Counters;

static void save_counters(const World *world, SnapshotOut *out)
{
    const Counters counters = {world->step_count,        world->deleted_total, world->clamped_total,
                               world->simulated_seconds, world->slow_dt,       world->slow_iterations,
                               world->strain_unchecked,  world->primal.credit};
    snapshot_put(out, &counters, sizeof counters);
}

static pbmpm_result check_counters(World *world, SnapshotIn in)
{
    Counters counters;
    (void)world;
    if (in.bytes != sizeof counters || !snapshot_take(&in, &counters, sizeof counters)) return snapshot_malformed();
    const bool fits = counters.simulated_seconds >= 0.0 && counters.slow_dt >= 0.0 && counters.slow_iterations >= 0.0 &&
                      isfinite(counters.simulated_seconds + counters.slow_dt + counters.slow_iterations) && isfinite(counters.credit);
    return fits ? PBMPM_OK : snapshot_malformed();
}

static void load_counters(World *world, SnapshotIn in)
{
    Counters counters;
    snapshot_take(&in, &counters, sizeof counters);
    world->step_count = counters.step_count;
    world->deleted_total = counters.deleted_total;
    world->clamped_total = counters.clamped_total;
    world->simulated_seconds = counters.simulated_seconds;
    world->slow_dt = counters.slow_dt;
    world->slow_iterations = counters.slow_iterations;
    world->strain_unchecked = counters.strain_unchecked != 0;
    world->primal.credit = counters.credit;
}

/* ---- Colliders: matched by slot and kind; poses and targets are loaded ---- */

typedef struct SavedCollider {
    uint32_t slot, moving;
    pbmpm_collider_def def;
    float target_position[3], target_rotation[4];
} SavedCollider;

/* The definition without its pose. */
static pbmpm_collider_def kind_of(const pbmpm_collider_def *def)
{
    pbmpm_collider_def kind = *def;
    memset(kind.shape.position, 0, sizeof kind.shape.position);
    memset(kind.shape.rotation, 0, sizeof kind.shape.rotation);
    kind.shape.baked.generation = 0; /* the same solid has another one in another world */
    return kind;
}

static void save_colliders(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->colliders.used; slot++) {
        const Collider *collider = &world->colliders.slot[slot];
        if (collider->generation == 0) continue;
        SavedCollider saved = {.slot = slot, .moving = collider->moving, .def = collider->def};
        memcpy(saved.target_position, collider->target_position, sizeof saved.target_position);
        memcpy(saved.target_rotation, collider->target_rotation, sizeof saved.target_rotation);
        snapshot_put(out, &saved, sizeof saved);
    }
}

static pbmpm_result check_colliders(World *world, SnapshotIn in)
{
    for (uint32_t slot = 0; slot < world->colliders.used; slot++) {
        const Collider *collider = &world->colliders.slot[slot];
        if (collider->generation == 0) continue;
        SavedCollider saved;
        const pbmpm_result result = snapshot_take_slot(&in, &saved, sizeof saved, slot, "colliders");
        if (result != PBMPM_OK) return result;
        const pbmpm_collider_def own = kind_of(&collider->def), other = kind_of(&saved.def);
        if (memcmp(&own, &other, sizeof own) != 0)
            return fail(PBMPM_ERROR_FOREIGN, "collider %u has another shape, friction or kind than in the snapshot", slot);
        saved.def.shape.baked = collider->def.shape.baked;
        pbmpm_shape target = saved.def.shape;
        memcpy(target.position, saved.target_position, sizeof target.position);
        memcpy(target.rotation, saved.target_rotation, sizeof target.rotation);
        if (shape_problem_among(&saved.def.shape, world->def.dimension, &world->baked) ||
            shape_problem_among(&target, world->def.dimension, &world->baked))
            return snapshot_malformed();
    }
    return snapshot_at_end(&in, "colliders");
}

static void load_colliders(World *world, SnapshotIn in)
{
    SavedCollider saved;
    while (snapshot_take(&in, &saved, sizeof saved)) {
        Collider *collider = &world->colliders.slot[saved.slot];
        saved.def.shape.baked = collider->def.shape.baked;
        collider->def = saved.def;
        collider->moving = saved.moving != 0;
        memcpy(collider->target_position, saved.target_position, sizeof saved.target_position);
        memcpy(collider->target_rotation, saved.target_rotation, sizeof saved.target_rotation);
    }
}

/* ---- The list ---- */

static const SnapshotSection made_section = {1, save_made, check_made, NULL, load_nothing};
static const SnapshotSection materials_section = {2, save_materials, check_materials, NULL, load_nothing};
static const SnapshotSection settings_section = {3, save_settings, check_settings, NULL, load_settings};
static const SnapshotSection counters_section = {4, save_counters, check_counters, NULL, load_counters};
static const SnapshotSection colliders_section = {5, save_colliders, check_colliders, NULL, load_colliders};

/* Particles and their sleep take memory. Sleep comes last: what it has now is lost when it makes room. */
static const SnapshotSection *const sections[] = {&made_section,      &materials_section, &settings_section, &counters_section,
                                                  &colliders_section, &emitters_section,  &drains_section,   &forces_section,
                                                  &flow_section,      &particles_section, &sleep_section};
enum { SECTIONS = sizeof sections / sizeof *sections };

static uint64_t padded(uint64_t bytes) { return (bytes + WORD - 1) / WORD * WORD; }

static uint64_t payload_bytes(const World *world, const SnapshotSection *section)
{
    SnapshotOut out = {0};
    section->save(world, &out);
    return out.at;
}

uint64_t snapshot_size(const World *world)
{
    uint64_t bytes = sizeof(Header);
    for (int i = 0; i < SECTIONS; i++) {
        const uint64_t payload = payload_bytes(world, sections[i]);
        if (payload) bytes += sizeof(SectionHeader) + padded(payload);
    }
    return bytes;
}

uint32_t snapshot_bytes_per_particle(const World *world) { return particles_section_bytes_each(world); }

/* ---- Saving ---- */

void snapshot_save(const World *world, void *buffer)
{
    char *data = buffer;
    Header header = {.version = PBMPM_SNAPSHOT_VERSION, .bytes = sizeof header};
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    for (int i = 0; i < SECTIONS; i++) {
        const SectionHeader section = {.tag = sections[i]->tag, .bytes = payload_bytes(world, sections[i])};
        if (section.bytes == 0) continue;
        memcpy(data + header.bytes, &section, sizeof section);
        header.bytes += sizeof section;
        SnapshotOut out = {.data = data + header.bytes};
        sections[i]->save(world, &out);
        memset(out.data + out.at, 0, padded(out.at) - out.at);
        header.bytes += padded(out.at);
        header.sections++;
    }
    memcpy(data, &header, sizeof header);
    snapshot_seal(data);
}

void snapshot_seal(void *snapshot)
{
    Header header;
    memcpy(&header, snapshot, sizeof header);
    header.checksum = checksum_of(snapshot, header.bytes);
    memcpy(snapshot, &header, sizeof header);
}

/* ---- Restoring ---- */

static pbmpm_result check_header(const char *snapshot, uint64_t bytes, Header *header)
{
    if (bytes < sizeof *header) return fail(PBMPM_ERROR_DAMAGED, "a snapshot has more than %llu bytes", (unsigned long long)bytes);
    memcpy(header, snapshot, sizeof *header);
    if (memcmp(header->magic, MAGIC, sizeof MAGIC) != 0) return fail(PBMPM_ERROR_DAMAGED, "this is not a snapshot");
    if (header->bytes > bytes || header->bytes < sizeof *header || header->bytes % WORD != 0)
        return fail(PBMPM_ERROR_DAMAGED, "the snapshot is truncated or damaged: it says %llu bytes, and there are %llu",
                    (unsigned long long)header->bytes, (unsigned long long)bytes);
    if (checksum_of(snapshot, header->bytes) != header->checksum)
        return fail(PBMPM_ERROR_DAMAGED, "the snapshot is damaged: its checksum is wrong");
    if (header->version != PBMPM_SNAPSHOT_VERSION)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot has version %u of the format; this library reads %u", header->version,
                    PBMPM_SNAPSHOT_VERSION);
    return PBMPM_OK;
}

static int section_index(uint32_t tag)
{
    for (int i = 0; i < SECTIONS; i++)
        if (sections[i]->tag == tag) return i;
    return -1;
}

/* Finds the payloads; those of sections that are not there stay empty. */
static pbmpm_result find_payloads(const char *snapshot, const Header *header, SnapshotIn found[SECTIONS])
{
    uint64_t at = sizeof *header;
    memset(found, 0, SECTIONS * sizeof *found);
    for (uint32_t n = 0; n < header->sections; n++) {
        SectionHeader section;
        if (header->bytes - at < sizeof section) return snapshot_malformed();
        memcpy(&section, snapshot + at, sizeof section);
        at += sizeof section;
        const int i = section_index(section.tag);
        if (i < 0) return fail(PBMPM_ERROR_FOREIGN, "the snapshot holds state that this version does not know (section %u)", section.tag);
        if (section.bytes == 0 || section.bytes > header->bytes - at || found[i].data) return snapshot_malformed();
        found[i] = (SnapshotIn){.data = snapshot + at, .bytes = section.bytes};
        at += padded(section.bytes); /* both ends are whole words, so this is not beyond the last */
    }
    return at == header->bytes ? PBMPM_OK : snapshot_malformed();
}

/* Each section takes all or nothing, so what is to be given back are the fields of the particles. */
static pbmpm_result reserve_all(World *world, const SnapshotIn found[SECTIONS])
{
    const int fields = world->particles.field_count;
    pbmpm_result result = PBMPM_OK;
    for (int i = 0; i < SECTIONS && result == PBMPM_OK; i++)
        if (sections[i]->reserve) result = sections[i]->reserve(world, found[i]);
    if (result != PBMPM_OK) particles_keep_fields(&world->particles, &world->memory, fields);
    return result;
}

pbmpm_result snapshot_restore(World *world, const void *snapshot, uint64_t bytes)
{
    Header header;
    SnapshotIn found[SECTIONS];
    pbmpm_result result = check_header(snapshot, bytes, &header);
    if (result == PBMPM_OK) result = find_payloads(snapshot, &header, found);
    for (int i = 0; i < SECTIONS && result == PBMPM_OK; i++) result = sections[i]->check(world, found[i]);
    if (result == PBMPM_OK) result = reserve_all(world, found);
    if (result != PBMPM_OK) return result;
    for (int i = 0; i < SECTIONS; i++) sections[i]->load(world, found[i]);
    sleep_check_rows(world);
    world->record = (StepRecord){0};
    events_clear(&world->events);
    grid_clear(&world->grid);
    world->islands.groups = 0;
    world_touch(world);
    return PBMPM_OK;
}
