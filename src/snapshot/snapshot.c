#include "snapshot/snapshot.h"

#include <math.h>
#include <string.h>

#include "base/assertion.h"
#include "base/result.h"
#include "snapshot/payload.h"
#include "snapshot/snapshot_flow.h"
#include "snapshot/snapshot_particles.h"
#include "world/sleep_rows.h"
#include "world/sleep_wake.h"

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

enum { CHECKED_BEFORE = offsetof(Header, checksum) };
_Static_assert(sizeof(Header) % SNAPSHOT_WORD == 0 && sizeof(SectionHeader) % SNAPSHOT_WORD == 0 && CHECKED_BEFORE % SNAPSHOT_WORD == 0, "whole words");

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
    memcpy(&value, bytes + word * SNAPSHOT_WORD, SNAPSHOT_WORD);
    return value;
}

/* Each word goes into one of four chains, which a processor works on at once. Every link of a chain is a bijection, so a change
 * inside one word is always seen; others escape once in 2^64. The place of the sum itself is left out. */
static uint64_t checksum_of(const char *snapshot, uint64_t bytes)
{
    uint64_t lane[LANES] = {1, 2, 3, 4};
    for (uint64_t w = 0; w < CHECKED_BEFORE / SNAPSHOT_WORD; w++) lane[w % LANES] = mix_word(lane[w % LANES], word_at(snapshot, w));
    const char *rest = snapshot + sizeof(Header);
    const uint64_t words = (bytes - sizeof(Header)) / SNAPSHOT_WORD;
    uint64_t w = 0;
    for (; w + LANES <= words; w += LANES)
        for (int k = 0; k < LANES; k++) lane[k] = mix_word(lane[k], word_at(rest, w + (uint64_t)k));
    for (; w < words; w++) lane[w % LANES] = mix_word(lane[w % LANES], word_at(rest, w));
    return mix_word(mix_word(mix_word(lane[0], lane[1]), lane[2]), lane[3]);
}

/* ---- What the world is made of: compared, not loaded, but for the origin ---- */

typedef struct Made {
    int32_t dimension;
    float cell_size;
    int32_t domain_enabled;
    float domain_min[3], domain_max[3];
    float domain_friction;
    double origin[3];
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
    memcpy(made.origin, def->origin, sizeof made.origin);
    return made;
}

static void save_made(const World *world, SnapshotOut *out)
{
    const Made made = made_of(world);
    snapshot_put_part(out, &made, sizeof made);
}

static pbmpm_result check_made(World *world, SnapshotIn in)
{
    const Made own = made_of(world);
    Made made = own;
    if (!snapshot_take_part(&in, &made, sizeof made) || snapshot_goes_on(&in)) return snapshot_malformed();
    for (int a = 0; a < 3; a++)
        if (!isfinite(made.origin[a])) return snapshot_malformed();
    memcpy(made.origin, own.origin, sizeof made.origin); /* of an earlier place of the same world */
    if (in.restoring->keeps) made.domain_friction = own.domain_friction;
    if (made.dimension != own.dimension)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot is of a world in %dD, not %dD", made.dimension, own.dimension);
    if (made.cell_size != own.cell_size)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot's world has the cell size %g, not %g", (double)made.cell_size, (double)own.cell_size);
    if (memcmp(&made, &own, sizeof made) != 0) return fail(PBMPM_ERROR_FOREIGN, "the snapshot's world has another domain box");
    return PBMPM_OK;
}

static void load_origin(World *world, SnapshotIn in)
{
    Made made = made_of(world);
    snapshot_take_part(&in, &made, sizeof made);
    memcpy(world->def.origin, made.origin, sizeof made.origin);
}

static void load_nothing(World *world, SnapshotIn in)
{
    (void)world;
    (void)in;
}

static void save_materials(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (world->materials.generation[slot] == 0) continue;
        snapshot_put_name(out, slot, def->key);
        snapshot_put_part(out, def, sizeof *def);
    }
}

static pbmpm_result compare_material(const World *world, int32_t place, const pbmpm_material_def *saved, bool keeps)
{
    const pbmpm_material_def *own = &world->materials.def[place];
    pbmpm_material_def same = *saved;
    same.size = own->size;
    same.key = own->key;
    same.user_data = own->user_data;
    if (saved->kind != own->kind || saved->density != own->density)
        return fail(PBMPM_ERROR_FOREIGN, "material %d has another kind or density than in the snapshot", place);
    if (!keeps && memcmp(&same, own, sizeof same) != 0)
        return fail(PBMPM_ERROR_FOREIGN, "material %d has other parameters than in the snapshot; PBMPM_RESTORE_KEEP_PARAMETERS keeps its own", place);
    return PBMPM_OK;
}

/* Fills in.restoring->material. */
static pbmpm_result check_materials(World *world, SnapshotIn in)
{
    Matched matched = {0};
    memset(in.restoring->material, -1, sizeof in.restoring->material);
    while (snapshot_goes_on(&in)) {
        int32_t place;
        uint32_t saved_slot;
        pbmpm_material_def saved = material_defaults();
        pbmpm_result result = snapshot_take_name(world, &in, KEYED_MATERIALS, &matched, &place, &saved_slot);
        if (result != PBMPM_OK) return result;
        if (!snapshot_take_part(&in, &saved, sizeof saved) || saved_slot >= PBMPM_MAX_MATERIALS) return snapshot_malformed();
        if (place < 0) continue;
        result = compare_material(world, place, &saved, in.restoring->keeps);
        if (result != PBMPM_OK) return result;
        in.restoring->material[saved_slot] = (int16_t)place;
    }
    return snapshot_all_matched(world, &in, KEYED_MATERIALS, &matched);
}

/* ---- Settings and counters ---- */

static void save_settings(const World *world, SnapshotOut *out) { snapshot_put_part(out, &world->settings, sizeof world->settings); }

static bool read_settings(SnapshotIn in, pbmpm_settings *settings)
{
    *settings = settings_defaults();
    const bool whole = snapshot_take_part(&in, settings, sizeof *settings) && !snapshot_goes_on(&in);
    settings->size = sizeof *settings;
    return whole;
}

static pbmpm_result check_settings(World *world, SnapshotIn in)
{
    pbmpm_settings settings;
    if (!read_settings(in, &settings)) return snapshot_malformed();
    const char *problem = settings_problem(&settings, world->def.dimension);
    return problem ? fail(PBMPM_ERROR_FOREIGN, "the snapshot's settings: %s", problem) : PBMPM_OK;
}

static void load_settings(World *world, SnapshotIn in)
{
    if (!in.restoring->keeps) read_settings(in, &world->settings);
}

typedef struct Counters {
    uint64_t step_count, deleted_total, clamped_total;
    double simulated_seconds;
    double slow_dt, slow_iterations;
    uint64_t strain_unchecked;
    double credit;
    EddyAccount eddy_account[ISLAND_GROUPS + 1];
    GranularState granular[ISLAND_GROUPS + 1];
    Stirred stirred;
} Counters;

static void save_counters(const World *world, SnapshotOut *out)
{
    Counters counters = {world->step_count,        world->deleted_total, world->clamped_total,
                         world->simulated_seconds, world->slow_dt,       world->slow_iterations,
                         world->strain_unchecked,  world->primal.credit, {{0.0, 0.0, 0}}, {{0.0, 0.0, 0, 0, 0, 0.0f, 0.0f}}, world->granular.stirred};
    memcpy(counters.eddy_account, world->dual.eddy_damping.account, sizeof counters.eddy_account);
    memcpy(counters.granular, world->granular.of, sizeof counters.granular);
    snapshot_put_part(out, &counters, sizeof counters);
}

static bool state_is_sound(const GranularState *state)
{
    return state->seconds >= 0.0 && isfinite(state->seconds) && state->flowed >= 0.0 && isfinite(state->flowed) && state->waited >= 0.0f && isfinite(state->waited + state->missing);
}

static pbmpm_result check_counters(World *world, SnapshotIn in)
{
    Counters counters = {0};
    (void)world;
    if (!snapshot_take_part(&in, &counters, sizeof counters) || snapshot_goes_on(&in)) return snapshot_malformed();
    bool fits = counters.simulated_seconds >= 0.0 && counters.slow_dt >= 0.0 && counters.slow_iterations >= 0.0 &&
                      isfinite(counters.simulated_seconds + counters.slow_dt + counters.slow_iterations) && isfinite(counters.credit);
    for (int a = 0; a < 3; a++) fits = fits && !isnan(counters.stirred.low[a]) && !isnan(counters.stirred.high[a]); /* planes have no bounds */
    for (int i = 0; i <= ISLAND_GROUPS; i++)
        fits = fits && isfinite(counters.eddy_account[i].debt + counters.eddy_account[i].left) && state_is_sound(&counters.granular[i]);
    return fits ? PBMPM_OK : snapshot_malformed();
}

static void load_counters(World *world, SnapshotIn in)
{
    Counters counters = {0};
    snapshot_take_part(&in, &counters, sizeof counters);
    world->step_count = counters.step_count;
    world->deleted_total = counters.deleted_total;
    world->clamped_total = counters.clamped_total;
    world->simulated_seconds = counters.simulated_seconds;
    world->slow_dt = counters.slow_dt;
    world->slow_iterations = counters.slow_iterations;
    world->strain_unchecked = counters.strain_unchecked != 0;
    world->primal.credit = counters.credit;
    memcpy(world->dual.eddy_damping.account, counters.eddy_account, sizeof counters.eddy_account);
    memcpy(world->granular.of, counters.granular, sizeof counters.granular);
    world->granular.stirred = counters.stirred;
}

/* ---- Colliders: poses and targets are loaded ---- */

typedef struct ColliderMotion {
    uint32_t moving;
    float target_position[3], target_rotation[4];
    ImpulseSum impulse; /* of the last step, where it is measured: a body goes on with it */
    FreeBody body;
} ColliderMotion;

typedef struct SavedCollider {
    pbmpm_collider_def def;
    pbmpm_shape shape;
    ColliderMotion motion;
} SavedCollider;

static void save_colliders(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->colliders.used; slot++) {
        const Collider *collider = &world->colliders.slot[slot];
        if (collider->generation == 0) continue;
        ColliderMotion motion = {.moving = collider->moving, .body = collider->body ? *collider->body : (FreeBody){.ways = 0}};
        memcpy(motion.target_position, collider->target_position, sizeof motion.target_position);
        memcpy(motion.target_rotation, collider->target_rotation, sizeof motion.target_rotation);
        if (collider->def.measures_impulse) motion.impulse = world->colliders.impulses.sum[slot];
        snapshot_put_name(out, slot, collider->def.key);
        snapshot_put_part(out, &collider->def, sizeof collider->def);
        snapshot_put_part(out, &collider->shape, sizeof collider->shape);
        snapshot_put_part(out, &motion, sizeof motion);
    }
}

static bool all_are_finite(const double vector[3]) { return isfinite(vector[0]) && isfinite(vector[1]) && isfinite(vector[2]); }

static bool body_is_valid(const FreeBody *body)
{
    bool finite = true;
    for (int k = 0; k < FREE_BODY_WAYS; k++) finite = finite && all_are_finite(body->way[k]) && all_are_finite(body->way[k] + 3);
    for (int k = 0; k < 6; k += 3) finite = finite && all_are_finite(body->push + k) && all_are_finite(body->yielded + k) && all_are_finite(body->delayed + k);
    for (int k = 0; k < FREE_BODY_WAYS; k++) finite = finite && all_are_finite(body->open[k]) && all_are_finite(body->open[k] + 3) && isfinite(body->change[k]);
    for (int k = 0; k < 6; k += 3) finite = finite && all_are_finite(body->expected + k) && all_are_finite(body->expects + k);
    for (int k = 0; k < 6; k += 3) finite = finite && all_are_finite(body->went + k) && all_are_finite(body->pace + k);
    return finite && all_are_finite(body->centre) && all_are_finite(body->begins) && body->ways >= 0 && body->ways <= FREE_BODY_WAYS;
}

/* Whether it says something of the next step. */
static bool body_counts(const FreeBody *body)
{
    bool expects = body->ways > 0 || body->walled || body->met;
    for (int a = 0; a < 6; a++) expects = expects || body->expects[a] != 0.0;
    return expects;
}

static bool take_collider(SnapshotIn *in, SavedCollider *saved)
{
    *saved = (SavedCollider){.def = collider_defaults(), .shape = shape_defaults()};
    return snapshot_take_part(in, &saved->def, sizeof saved->def) && snapshot_take_part(in, &saved->shape, sizeof saved->shape) &&
           snapshot_take_part(in, &saved->motion, sizeof saved->motion) && all_are_finite(saved->motion.impulse.linear) &&
           all_are_finite(saved->motion.impulse.angular) && body_is_valid(&saved->motion.body);
}

/* Whether it is the same but for its pose. */
static bool same_collider(const Collider *own, const SavedCollider *saved)
{
    pbmpm_collider_def def = saved->def;
    pbmpm_shape shape = snapshot_posed(&saved->shape, &own->shape);
    def.size = own->def.size;
    def.key = own->def.key;
    def.user_data = own->def.user_data;
    shape.size = own->shape.size;
    shape.baked.generation = own->shape.baked.generation; /* the same solid has another one in another world */
    return memcmp(&def, &own->def, sizeof def) == 0 && memcmp(&shape, &own->shape, sizeof shape) == 0;
}

static bool poses_fit(const World *world, const Collider *own, const SavedCollider *saved)
{
    const pbmpm_shape now = snapshot_posed(&own->shape, &saved->shape);
    pbmpm_shape target = now;
    memcpy(target.position, saved->motion.target_position, sizeof target.position);
    memcpy(target.rotation, saved->motion.target_rotation, sizeof target.rotation);
    return !shape_problem_among(&now, world->def.dimension, &world->baked) && !shape_problem_among(&target, world->def.dimension, &world->baked);
}

static pbmpm_result check_colliders(World *world, SnapshotIn in)
{
    Matched matched = {0};
    while (snapshot_goes_on(&in)) {
        int32_t place;
        SavedCollider saved;
        const pbmpm_result result = snapshot_take_name(world, &in, KEYED_COLLIDERS, &matched, &place, NULL);
        if (result != PBMPM_OK) return result;
        if (!take_collider(&in, &saved)) return snapshot_malformed();
        if (place < 0) continue;
        Collider *own = &world->colliders.slot[place];
        if (!in.restoring->keeps && !same_collider(own, &saved))
            return fail(PBMPM_ERROR_FOREIGN, "collider %d has another shape, friction or kind than in the snapshot; PBMPM_RESTORE_KEEP_PARAMETERS keeps its own",
                        place);
        if (!poses_fit(world, own, &saved)) return snapshot_malformed();
        if (body_counts(&saved.motion.body) && !collider_body(own, &world->memory))
            return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a rigid body");
    }
    return snapshot_all_matched(world, &in, KEYED_COLLIDERS, &matched);
}

static void load_colliders(World *world, SnapshotIn in)
{
    Matched matched = {0};
    int32_t place;
    SavedCollider saved;
    while (snapshot_goes_on(&in)) {
        snapshot_take_name(world, &in, KEYED_COLLIDERS, &matched, &place, NULL);
        take_collider(&in, &saved);
        if (place < 0) continue;
        Collider *collider = &world->colliders.slot[place];
        collider->shape = snapshot_posed(&collider->shape, &saved.shape);
        collider->moving = saved.motion.moving != 0 && collider->def.kinematic;
        memcpy(collider->target_position, saved.motion.target_position, sizeof saved.motion.target_position);
        memcpy(collider->target_rotation, saved.motion.target_rotation, sizeof saved.motion.target_rotation);
        if (!collider->def.measures_impulse) continue;
        world->colliders.impulses.sum[place] = saved.motion.impulse;
        if (collider->body) *collider->body = saved.motion.body; /* check_colliders() took the memory */
    }
}

/* ---- Walls of the domain, where one is not as the definition has it ---- */

static void save_walls(const World *world, SnapshotOut *out)
{
    for (int place = 0; place < 2 * world->def.dimension && domain_changed(&world->domain, &world->def); place++)
        snapshot_put_part(out, &world->domain.wall[place], sizeof(pbmpm_domain_wall));
}

/* Walls as the definition has them where the snapshot has none. */
static bool read_walls(const World *world, SnapshotIn in, Domain *domain)
{
    *domain = domain_of(&world->def);
    for (int place = 0; place < 2 * world->def.dimension && in.bytes; place++) {
        pbmpm_domain_wall wall = domain->wall[place];
        if (!snapshot_take_part(&in, &wall, sizeof wall) || domain_wall_problem(&wall) || !world->def.domain_enabled) return false;
        wall.size = sizeof wall;
        domain_set_wall(domain, &world->def, place, &wall);
    }
    return !snapshot_goes_on(&in);
}

static pbmpm_result check_walls(World *world, SnapshotIn in)
{
    Domain domain;
    return read_walls(world, in, &domain) ? PBMPM_OK : snapshot_malformed();
}

static void load_walls(World *world, SnapshotIn in)
{
    if (!in.restoring->keeps) read_walls(world, in, &world->domain);
}

/* ---- The list ---- */

static const SnapshotSection made_section = {1, save_made, check_made, NULL, load_origin};
static const SnapshotSection materials_section = {2, save_materials, check_materials, NULL, load_nothing};
static const SnapshotSection settings_section = {3, save_settings, check_settings, NULL, load_settings};
static const SnapshotSection counters_section = {4, save_counters, check_counters, NULL, load_counters};
static const SnapshotSection colliders_section = {5, save_colliders, check_colliders, NULL, load_colliders};
static const SnapshotSection walls_section = {12, save_walls, check_walls, NULL, load_walls};

/* Particles and their sleep take memory. Sleep comes last: what it has now is lost when it makes room. */
static const SnapshotSection *const sections[] = {&made_section,      &materials_section, &settings_section, &counters_section,
                                                  &colliders_section, &walls_section,     &emitters_section, &drains_section,
                                                  &forces_section,    &flow_section,      &particles_section, &sleep_section};
enum { SECTIONS = sizeof sections / sizeof *sections };

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
        if (payload) bytes += sizeof(SectionHeader) + snapshot_padded(payload);
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
        ASSERT(out.at == section.bytes);
        memset(out.data + out.at, 0, snapshot_padded(out.at) - out.at);
        header.bytes += snapshot_padded(out.at);
        header.sections++;
    }
    ASSERT(header.bytes == snapshot_size(world));
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
    if (header->bytes > bytes || header->bytes < sizeof *header || header->bytes % SNAPSHOT_WORD != 0)
        return fail(PBMPM_ERROR_DAMAGED, "the snapshot is truncated or damaged: it says %llu bytes, and there are %llu",
                    (unsigned long long)header->bytes, (unsigned long long)bytes);
    if (checksum_of(snapshot, header->bytes) != header->checksum)
        return fail(PBMPM_ERROR_DAMAGED, "the snapshot is damaged: its checksum is wrong");
    if (header->version < PBMPM_SNAPSHOT_OLDEST || header->version > PBMPM_SNAPSHOT_VERSION)
        return fail(PBMPM_ERROR_FOREIGN, "the snapshot has version %u of the format; this library reads %u to %u", header->version,
                    PBMPM_SNAPSHOT_OLDEST, PBMPM_SNAPSHOT_VERSION);
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
        at += snapshot_padded(section.bytes); /* both ends are whole words, so this is not beyond the last */
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

pbmpm_result snapshot_restore(World *world, const void *snapshot, uint64_t bytes, uint32_t flags)
{
    Header header;
    Restoring restoring = {.keeps = (flags & PBMPM_RESTORE_KEEP_PARAMETERS) != 0};
    SnapshotIn found[SECTIONS];
    pbmpm_result result = check_header(snapshot, bytes, &header);
    if (result == PBMPM_OK) result = find_payloads(snapshot, &header, found);
    for (int i = 0; i < SECTIONS && result == PBMPM_OK; i++) {
        found[i].restoring = &restoring;
        result = sections[i]->check(world, found[i]);
    }
    if (result == PBMPM_OK) result = reserve_all(world, found);
    if (result != PBMPM_OK) return result;
    for (int i = 0; i < SECTIONS; i++) sections[i]->load(world, found[i]);
    sleep_check_rows(world);
    if (restoring.keeps) sleep_wake_all(world); /* what sleeps came to rest with other parameters */
    world->record = (StepRecord){0};
    events_clear(&world->events);
    grid_clear(&world->grid);
    for (int kinds = 0; kinds <= ISLAND_GROUPS; kinds++) obstacle_cache_forget(&world->obstacle_cache[kinds]);
    world->islands.groups = 0;
    world_expire_views(world);
    return PBMPM_OK;
}
