#include "snapshot/payload.h"

#include <string.h>

#include "base/result.h"

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

void snapshot_put_part(SnapshotOut *out, const void *part, size_t bytes)
{
    static const char zeros[SNAPSHOT_WORD] = {0};
    const uint64_t length = bytes;
    snapshot_put(out, &length, sizeof length);
    snapshot_put(out, part, bytes);
    snapshot_put(out, zeros, snapshot_padded(bytes) - bytes);
}

bool snapshot_take_part(SnapshotIn *in, void *part, size_t bytes)
{
    uint64_t length;
    if (!snapshot_take(in, &length, sizeof length) || length > in->bytes - in->at || snapshot_padded(length) > in->bytes - in->at) return false;
    const char *data = in->data + in->at;
    in->at += snapshot_padded(length);
    memcpy(part, data, length < bytes ? length : bytes);
    for (uint64_t i = bytes; i < length; i++)
        if (data[i] != 0) return false;
    return true;
}

bool snapshot_goes_on(const SnapshotIn *in) { return in->at < in->bytes; }

/* ---- Lists of things ---- */

typedef struct Name {
    uint64_t key;
    uint32_t slot;
    uint32_t reserved; /* 0 */
} Name;

void snapshot_put_name(SnapshotOut *out, uint32_t slot, uint64_t key)
{
    const Name name = {.key = key, .slot = slot};
    snapshot_put(out, &name, sizeof name);
}

static int32_t place_of(const World *world, KeyedKind kind, const Name *name)
{
    const int32_t place = name->key ? keyed_find(world, kind, name->key) : -1;
    if (place >= 0) return place;
    return keyed_generation(world, kind, name->slot) != 0 ? (int32_t)name->slot : -1;
}

pbmpm_result snapshot_take_name(const World *world, SnapshotIn *in, KeyedKind kind, Matched *matched, int32_t *place, uint32_t *saved)
{
    Name name;
    const bool whole = snapshot_take(in, &name, sizeof name);
    *place = -1;
    if (saved) *saved = name.slot;
    if (!whole) return snapshot_malformed();
    *place = place_of(world, kind, &name);
    if (*place < 0 && in->restoring->keeps) return PBMPM_OK;
    if (*place < 0) return fail(PBMPM_ERROR_FOREIGN, "the snapshot has more %s than the world: that of index %u is not there", keyed_name(kind), name.slot);
    uint64_t *word = &matched->seen[*place / 64], bit = (uint64_t)1 << *place % 64;
    if (*word & bit) return fail(PBMPM_ERROR_FOREIGN, "two %s of the snapshot are the one at index %d of the world: give them keys", keyed_name(kind), *place);
    *word |= bit;
    return PBMPM_OK;
}

pbmpm_result snapshot_all_matched(const World *world, const SnapshotIn *in, KeyedKind kind, const Matched *matched)
{
    for (uint32_t slot = 0; slot < keyed_slots(world, kind) && !in->restoring->keeps; slot++)
        if (keyed_generation(world, kind, slot) != 0 && !(matched->seen[slot / 64] >> slot % 64 & 1))
            return fail(PBMPM_ERROR_FOREIGN, "the snapshot has not all %s of the world: that of index %u is not there", keyed_name(kind), slot);
    return PBMPM_OK;
}

pbmpm_shape snapshot_posed(const pbmpm_shape *shape, const pbmpm_shape *pose)
{
    pbmpm_shape posed = *shape;
    memcpy(posed.position, pose->position, sizeof posed.position);
    memcpy(posed.rotation, pose->rotation, sizeof posed.rotation);
    return posed;
}

pbmpm_result snapshot_malformed(void)
{
    return fail(PBMPM_ERROR_FOREIGN, "a section of the snapshot is not laid out as this version writes it");
}
