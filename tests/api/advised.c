#include "advised.h"

#include <string.h>

pbmpm_advice told[ROOM];
uint32_t told_count;

void ask_of(pbmpm_world_id world, float dt)
{
    told[0].size = sizeof told[0];
    OK(pbmpm_world_advice(world, dt, told, ROOM, &told_count));
    TEST_ASSERT_TRUE(told_count <= ROOM);
}

void ask(pbmpm_world_id world) { ask_of(world, DT); }

static const pbmpm_advice *find(pbmpm_advice_code code)
{
    for (uint32_t i = 0; i < told_count; i++)
        if (told[i].code == code) return &told[i];
    return NULL;
}

const pbmpm_advice *expect(pbmpm_world_id world, pbmpm_advice_code code)
{
    ask(world);
    const pbmpm_advice *found = find(code);
    TEST_ASSERT_NOT_NULL_MESSAGE(found, pbmpm_advice_name(code));
    TEST_ASSERT_EQUAL_UINT32(sizeof *found, found->size);
    TEST_ASSERT_TRUE(strlen(found->text) > 10);
    return found;
}

void expect_none(pbmpm_world_id world, pbmpm_advice_code code)
{
    ask(world);
    TEST_ASSERT_NULL_MESSAGE(find(code), pbmpm_advice_name(code));
}

void check_ignored(pbmpm_world_id world, const char *word)
{
    ask(world);
    for (uint32_t i = 0; i < told_count; i++)
        if (told[i].code == PBMPM_ADVICE_IGNORED && strncmp(told[i].text, word, strlen(word)) == 0) return;
    TEST_FAIL_MESSAGE(word);
}

bool tells(const char *words)
{
    for (uint32_t n = 0; n < told_count; n++)
        if (strstr(told[n].text, words)) return true;
    return false;
}

bool advised(pbmpm_world_id world, float dt, const char *words)
{
    ask_of(world, dt);
    for (uint32_t i = 0; i < told_count; i++)
        if (told[i].collider.generation != 0 && strstr(told[i].text, words)) return true;
    return false;
}

pbmpm_world_id falling_world(int32_t dimension, float cell_size)
{
    const pbmpm_world_def def = default_world(dimension, cell_size, 60000);
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    return world;
}

pbmpm_material_id add_material(pbmpm_world_id world, const pbmpm_material_def *def)
{
    pbmpm_material_id material;
    OK(pbmpm_material_create(world, def, &material));
    return material;
}

void create_body(pbmpm_world_id world, const pbmpm_shape *shape, float mass, bool advanced)
{
    pbmpm_collider_def def;
    pbmpm_rigid_def body;
    pbmpm_rigid_state state = {.size = sizeof state};
    pbmpm_collider_id collider;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = def.measures_impulse = 1;
    OK(pbmpm_collider_create(world, &def, shape, &collider));
    OK(pbmpm_rigid_def_init(&body, sizeof body));
    body.mass = mass;
    OK(pbmpm_rigid_begin(world, collider, &body, &state));
    if (advanced) OK(pbmpm_rigid_advance(world, collider, &body, &state, DT));
}
