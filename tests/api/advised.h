/* Advice to test: asked for, and looked through. */
#ifndef PBMPM_TESTS_API_ADVISED_H
#define PBMPM_TESTS_API_ADVISED_H

#include "pace.h"
#include "scenes.h"

/** What was told last. */
enum { ROOM = 32 };
extern pbmpm_advice told[ROOM];
extern uint32_t told_count;

/** Asks for all advice, of steps of DT, or of `dt`. */
void ask(pbmpm_world_id world);
void ask_of(pbmpm_world_id world, float dt);

/** Asks, and fails unless there is advice with that code; gives the first. */
const pbmpm_advice *expect(pbmpm_world_id world, pbmpm_advice_code code);

/** Asks, and fails if there is advice with that code. */
void expect_none(pbmpm_world_id world, pbmpm_advice_code code);

/** Asks, and fails unless a parameter whose name is `word` is said to do nothing. */
void check_ignored(pbmpm_world_id world, const char *word);

/** Whether what was told last has these words. */
bool tells(const char *words);

/** Asks, and tells whether advice of an obstacle has these words. */
bool advised(pbmpm_world_id world, float dt, const char *words);

/** With gravity and without walls. */
pbmpm_world_id falling_world(int32_t dimension, float cell_size);

/** A rigid body [kg]; `advanced`: by a step. */
void create_body(pbmpm_world_id world, const pbmpm_shape *shape, float mass, bool advanced);

pbmpm_material_id add_material(pbmpm_world_id world, const pbmpm_material_def *def);

#endif
